//! Vibrating structures, and signals against time.

use super::{Keep, Vector};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A quantity given against time: displacement [m] or force [N], as the place says.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Signal {
    /// amplitude sin(2 pi frequency t + phase).
    Sine {
        /// Amplitude [m] or [N].
        amplitude: f64,
        /// Frequency [Hz].
        frequency: f64,
        /// Phase [rad].
        phase: f64,
    },
    /// Sine whose frequency runs from one to another; silent afterwards.
    SineSweep {
        /// Amplitude at the first frequency [m] or [N].
        amplitude: f64,
        /// First frequency [Hz].
        from: f64,
        /// Last frequency [Hz].
        to: f64,
        /// Length [s].
        duration: f64,
        /// How the frequency runs.
        scale: Scale,
        /// What of a displacement stays the same; angles and forces keep their amplitude.
        #[serde(default = "amplitude")]
        keep: Keep,
    },
    /// Half-sine pulse.
    Impact {
        /// Height [m] or [N].
        peak: f64,
        /// Length [s].
        duration: f64,
        /// Begin [s].
        at: f64,
    },
    /// Half-sine pulse of acceleration; afterwards it goes on at the speed gained, or two weaker pulses take that away.
    Shock {
        /// Peak of the acceleration [m/s^2].
        acceleration: f64,
        /// Length of the pulse [s].
        duration: f64,
        /// Begin [s].
        at: f64,
        /// Peak of a pulse of the other sign before it, and of one after it, over its own; 0: none.
        compensation: f64,
    },
    /// offset + sum of amplitude sin(2 pi frequency t + phase). What a scene gives as `random` is realised as these.
    Sines {
        /// Amplitudes [m] or [N].
        amplitude: Vec<f64>,
        /// Frequencies [Hz].
        frequency: Vec<f64>,
        /// Phases [rad].
        phase: Vec<f64>,
        /// Added to their sum [m] or [N].
        offset: f64,
    },
    /// rate t: steady translation or turning.
    Steady {
        /// Rate [m/s] or [rad/s] (or [N/s]).
        rate: f64,
    },
    /// Straight lines between given points, constant outside. Read from a CSV file (`file`), kept here as numbers.
    Table {
        /// Times [s], rising.
        time: Vec<f64>,
        /// Values [m] or [N].
        value: Vec<f64>,
    },
}

fn amplitude() -> Keep {
    Keep::Displacement
}

/// How the frequency of a sweep runs in time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Scale {
    /// So many Hz a second.
    Linear,
    /// So many octaves a second.
    Logarithmic,
}

/// A vibrating structure: M q'' + C (q' - r y') + K (q - r y) = w F(t) + w F_grains. The displacement that walls see is
/// w . q along `direction`; y is the base motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Host {
    /// M, C, K.
    pub structure: Structure,
    /// Unit direction of its motion.
    pub direction: Vector,
    /// Points of the structure that walls can hang on, each with its motion in six directions; where there are none, walls move along
    /// `direction`.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub interface: BTreeMap<String, Interface>,
    /// The interface whose displacement along `direction` is told, and where the force acts; `None` where there are none.
    pub at: Option<String>,
    /// How many cavities like those of the scene it carries, all moving alike.
    #[serde(default = "one")]
    pub copies: f64,
    /// Base displacement y(t) [m].
    pub base: Option<Signal>,
    /// Applied force F(t) [N].
    pub force: Option<Signal>,
    /// How the frequency of its sine follows its resonance.
    pub dwell: Option<Dwell>,
    /// Displacement at time 0 of every coordinate [m].
    pub displacement: f64,
    /// Velocity at time 0 of every coordinate [m/s].
    pub velocity: f64,
}

fn one() -> f64 {
    1.0
}

/// A sine whose frequency follows the resonance, by the phase of the answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Dwell {
    /// How far the answer is to lag behind the drive [rad].
    pub lag: f64,
    /// Relative change of frequency a period, for an error of one radian [-]; `None`: by the damping of the structure.
    pub gain: Option<f64>,
    /// What of a base motion stays the same.
    pub keep: Keep,
}

/// A point of a structure that moves and turns with it: displacement u = sum of translation times coordinate, rotation vector
/// sum of rotation times coordinate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Interface {
    /// Where it is as drawn [m].
    pub point: Vector,
    /// Displacement a unit of each coordinate [-].
    pub translation: Vec<Vector>,
    /// Rotation vector a unit of each coordinate [rad/m]; empty where it does not turn.
    pub rotation: Vec<Vector>,
}

/// The matrices of a host.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Structure {
    /// What moves as its base does, whatever grains do to it.
    Shaker {},
    /// One degree of freedom.
    Oscillator {
        /// M [kg], without the grains.
        mass: f64,
        /// K [N/m].
        stiffness: f64,
        /// C [N.s/m].
        damping: f64,
        /// k3 [N/m^3] of the spring force K s + k3 s^3.
        cubic_stiffness: f64,
    },
    /// n degrees of freedom.
    Matrices {
        /// M [kg].
        mass: Vec<Vec<f64>>,
        /// C [N.s/m].
        damping: Vec<Vec<f64>>,
        /// K [N/m].
        stiffness: Vec<Vec<f64>>,
        /// G [kg] of a rotor, skew: its spin puts -speed G q' on the coordinates.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        gyroscopic: Option<Vec<Vec<f64>>>,
        /// Spin of the rotor [rad/s].
        #[serde(default)]
        speed: f64,
        /// Index (from 0) of the coordinate that carries the walls and takes the force.
        coordinate: usize,
        /// How the motion of the base drives each coordinate [-].
        participation: Vec<f64>,
    },
    /// A list of modes.
    Modes {
        /// The modes.
        mode: Vec<Mode>,
    },
    /// A rigid body that swings about an axis, at any angle: I a'' + c a' + m g b sin(a) = torque of the grains, with the angle a
    /// between gravity and the line from the axis to its centre of mass. It is drawn where it begins.
    Pendulum {
        /// A point on the axis [m].
        pivot: Vector,
        /// Unit direction of the axis.
        axis: Vector,
        /// I about the axis [kg.m^2].
        inertia: f64,
        /// c [N.m.s].
        damping: f64,
        /// m g b [N.m]: mass, gravity across the axis, distance of the centre of mass from the axis.
        moment: f64,
        /// Distance from the axis whose displacement along the arc is told, and where the force acts [m].
        arm: f64,
        /// Angle at time 0 [rad].
        angle: f64,
    },
}

/// One vibration mode.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Mode {
    /// Natural frequency [Hz].
    pub frequency: f64,
    /// Damping ratio [-].
    pub damping_ratio: f64,
    /// Modal mass [kg].
    pub mass: f64,
    /// Mode shape where the walls are [-].
    pub shape: f64,
    /// Participation of the base motion [-].
    pub participation: f64,
}

impl Host {
    /// Whether walls without an interface turn with it.
    pub fn turns(&self) -> bool {
        matches!(self.structure, Structure::Pendulum { .. })
    }

    /// Whether it moves as its base does, whatever grains do to it.
    pub fn is_shaker(&self) -> bool {
        matches!(self.structure, Structure::Shaker {})
    }

    /// The shortest period of the sines that drive it [s].
    pub fn period(&self) -> Option<f64> {
        let periods = [&self.base, &self.force].into_iter().flatten().filter_map(|signal| match signal {
            Signal::Sine { frequency, .. } => Some(1.0 / frequency),
            _ => None,
        });
        periods.reduce(f64::min)
    }
}
