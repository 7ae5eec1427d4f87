//! Who acts from outside the program: forces on grains beside those of contacts, gravity and water.
//!
//! Nobody does in a run of a scene. A door, as that to Python, may hand an [`Action`] to an engine: its forces join those of the
//! contacts in every step, and the engine posts their work to [`Account::Outside`](crate::ledger::Account::Outside).

use crate::state::Grains;
use glam::DVec3;

/// A moment at which somebody is asked for forces: positions are those of the end of a step, velocities are predicted for it.
#[derive(Debug)]
pub struct Moment<'a> {
    /// Simulated time [s].
    pub time: f64,
    /// Number of the step.
    pub step: u64,
    /// The grains. Nobody may change a value; whoever keeps a column beyond the call [renews](Grains::renew) it.
    pub grains: &'a mut Grains,
}

/// Forces and torques on grains, in the order that the grains have at the moment.
#[derive(Clone, Debug, Default)]
pub struct Push {
    /// Forces [N].
    pub force: Vec<DVec3>,
    /// Torques [N.m]; empty: none.
    pub torque: Vec<DVec3>,
}

/// What is to be done after somebody was asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Heed {
    /// The forces are there, a row a grain, or there are none: nothing in both columns.
    Act,
    /// The forces are those of the last time, and the run is to stop when this step is done.
    Stop,
}

/// Somebody who acts on grains.
pub trait Action: Send {
    /// Says what forces act at this moment, into `push`, which holds nothing before.
    fn act(&mut self, moment: Moment<'_>, push: &mut Push) -> Heed;
}
