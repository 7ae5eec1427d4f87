//! Who moves a wall: nobody, a motion given in advance, a host, or the grains themselves.

use super::{Body, Pose, Servo, Steered};
use crate::about::About;
use crate::motion::value_and_rate;
use crate::partner::{Hosts, Placed};
use glam::{DQuat, DVec3};
use tsubu_scene::plan::{self, Signal};

pub(crate) const MOTION: About = About {
    key: "walls.NAME.motion",
    formula: "x = x0 + direction s(t), v = direction ds/dt",
    symbols: "s displacement [m], direction unit vector [-], v velocity that friction and damping see [m/s]",
    limits: "Given in advance: grains do not slow it. Its work on the grains is in the ledger.",
    reference: "by definition",
};

pub(crate) const ROTATION: About = About {
    key: "walls.NAME.rotation",
    formula: "turned by angle(t) about the axis through `centre`; v = axis dangle/dt x (c - centre)",
    symbols: "angle [rad], axis unit vector [-], c point of contact [m], v velocity that friction and damping see [m/s]",
    limits: "Given in advance: grains do not slow it. May be had together with `motion`, which carries the axis along.",
    reference: "by definition",
};

pub(crate) const HOST: About = About {
    key: "walls.NAME.host",
    formula: "x = p + u + R (x0 - p), u = sum of t q, R = exp(sum of r q)\nM q'' + C (q' - g y') + K (q - g y) = w F + F_grains, \
F_grains = t . F + r . J^T T",
    symbols: "p drawn point of the interface [m], u its displacement [m], R its rotation, t and r translation and rotation a unit of each \
coordinate, q coordinates of a structure with matrices M, C, K, y(t) displacement of its base [m], g how the base drives each coordinate, \
F(t) applied force [N], w what the point at which it acts sees of each coordinate, F and T force [N] and torque about the interface [N.m] \
of the grains, J left Jacobian of the rotation vector. Without `interface`: t = w direction, and no rotation; on a pendulum r = axis and t = 0",
    limits: "Displacements are linear in the coordinates; rotations hold at any angle. In an impact the wall shows the mass of the \
structure at the interface, without its rotation. A host may carry several walls; its energy and what base and force do to it are in the \
ledger.",
    reference: "Komatsuzaki, Sato, Iwata and Morishita 2003, eq. (1), for one coordinate",
};

/// What displaces a wall.
#[derive(Clone, Debug)]
pub enum Mover {
    /// Nothing does.
    Still,
    /// A displacement along a direction, given in advance.
    Motion(DVec3, Signal),
    /// An interface of a host, both by number (see [`Hosts::list`]).
    Host {
        /// The host.
        host: usize,
        /// Its interface.
        interface: usize,
    },
    /// A constant force against the grains.
    Servo(Servo),
    /// The grains and gravity alone: a free body, which turns too.
    Body(Body),
    /// Somebody outside the program.
    Steered(Steered),
}

/// Turning about a fixed axis, given in advance.
#[derive(Clone, Debug)]
pub struct Turning {
    /// Unit direction of the axis.
    pub axis: DVec3,
    /// Angle [rad] against time.
    pub signal: Signal,
}

/// Energy that a servo exchanged with the outside in a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Exchange {
    /// Work of the constant force [J].
    pub work: f64,
    /// Lost in the damper [J].
    pub lost: f64,
}

impl Mover {
    /// The mover of a wall; `gravity` [m/s^2] pulls a body.
    pub fn new(wall: &plan::Wall, hosts: &Hosts, gravity: DVec3) -> Self {
        if let Some(host) = wall.host.as_deref().and_then(|name| hosts.index(name))
            && let Some(interface) = hosts.list[host].interface(wall.interface.as_deref())
        {
            return Self::Host { host, interface };
        }
        if let Some(servo) = &wall.servo {
            return Self::Servo(Servo::new(servo));
        }
        if let Some(body) = &wall.body {
            return Self::Body(Body::new(body, gravity));
        }
        match &wall.motion {
            Some(motion) => Self::Motion(DVec3::from_array(motion.direction), motion.signal.clone()),
            None => Self::Still,
        }
    }

    /// Displacement from the drawn place [m] and velocity [m/s] at `time`; a host's, servo's and body's are those it has now.
    pub fn displacement(&self, time: f64, hosts: &Hosts) -> (DVec3, DVec3) {
        let (direction, (value, rate)) = match self {
            Self::Still => return (DVec3::ZERO, DVec3::ZERO),
            Self::Motion(direction, signal) => (*direction, value_and_rate(signal, time)),
            Self::Host { host, interface } => {
                let placed = hosts.list[*host].placed(*interface);
                return (placed.offset, placed.velocity);
            }
            Self::Servo(servo) => (servo.direction, (servo.displacement(), servo.velocity())),
            Self::Body(body) => return (body.centre() - body.drawn_centre(), body.velocity()),
            Self::Steered(steered) => return steered.displacement(time),
        };
        (direction * value, direction * rate)
    }

    /// Puts displacement and velocity (of a body also rotation and spin) into a pose.
    pub(super) fn place(&self, time: f64, hosts: &Hosts, pose: &mut Pose) {
        if let Self::Host { host, interface } = self {
            return hang(pose, &hosts.list[*host].placed(*interface));
        }
        (pose.offset, pose.velocity) = self.displacement(time, hosts);
        if let Self::Body(body) = self {
            (pose.rotation, pose.spin) = (body.rotation(), body.spin());
        }
        if let Self::Steered(steered) = self {
            (pose.rotation, pose.spin) = steered.rotation(time);
        }
    }
}

/// Puts a wall where the interface that it hangs on has taken it.
fn hang(pose: &mut Pose, placed: &Placed) {
    (pose.offset, pose.velocity) = (placed.offset, placed.velocity);
    if let Some(rotation) = placed.rotation {
        let drawn = pose.centre - placed.point;
        let turned = rotation * drawn;
        pose.offset += turned - drawn;
        pose.velocity += placed.spin.cross(turned);
        (pose.rotation, pose.spin) = (rotation, placed.spin);
    }
}

impl Turning {
    pub(super) fn new(rotation: &plan::Rotation) -> Self {
        Self { axis: DVec3::from_array(rotation.axis), signal: rotation.signal.clone() }
    }

    /// Puts rotation and spin into a pose.
    pub(super) fn place(&self, time: f64, pose: &mut Pose) {
        let (angle, rate) = value_and_rate(&self.signal, time);
        pose.rotation = DQuat::from_axis_angle(self.axis, angle);
        pose.spin = self.axis * rate;
    }
}
