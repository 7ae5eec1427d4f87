//! Who moves a wall: nobody, a motion given in advance, or a host.

use crate::motion::value_and_rate;
use crate::partner::Hosts;
use glam::DVec3;
use tsubu_scene::plan::{Signal, Wall};

/// What a wall hangs on.
#[derive(Clone, Debug)]
pub enum Carrier {
    /// Stands still.
    Still,
    /// Moves along a direction as told.
    Motion(DVec3, Signal),
    /// Moves with a host (index into [`Hosts::list`]) along the host's direction.
    Host(usize, DVec3),
}

impl Carrier {
    /// The carrier of a wall.
    pub fn new(wall: &Wall, hosts: &Hosts) -> Self {
        if let Some(index) = wall.host.as_deref().and_then(|name| hosts.index(name)) {
            return Self::Host(index, DVec3::from_array(hosts.list[index].direction));
        }
        match &wall.motion {
            Some(motion) => Self::Motion(DVec3::from_array(motion.direction), motion.signal.clone()),
            None => Self::Still,
        }
    }

    /// Displacement from the drawn place [m] and velocity [m/s] at `time`; a host's are those it has now.
    pub fn place(&self, time: f64, hosts: &Hosts) -> (DVec3, DVec3) {
        match self {
            Self::Still => (DVec3::ZERO, DVec3::ZERO),
            Self::Motion(direction, signal) => {
                let (value, rate) = value_and_rate(signal, time);
                (*direction * value, *direction * rate)
            }
            Self::Host(index, direction) => {
                let host = &hosts.list[*index];
                (*direction * host.displacement(), *direction * host.velocity())
            }
        }
    }
}
