//! Vibrating structures and the signals that drive them.

use super::{Key, Kind, Variant};
use crate::units::{
    ACCELERATION, ANGLE, DAMPING, FORCE, FREQUENCY, LENGTH, LOAD_RATE, MASS, NUMBER, SPEED, SPIN, STIFFNESS, TIME,
};

pub(super) static HOST: &[Key] = &[
    Key::new("structure", Kind::Choice(STRUCTURE), "Its matrices"),
    Key::new("direction", Kind::Direction, "Direction of its motion").default("'z'"),
    Key::new("base", Kind::Choice(&DISPLACEMENT), "Displacement of the base against time").optional().may_change(),
    Key::new("force", Kind::Choice(&LOAD), "Applied force against time").optional().may_change(),
    Key::new("displacement", Kind::Quantity(&LENGTH), "Displacement of every coordinate at time 0").default("0"),
    Key::new("velocity", Kind::Quantity(&SPEED), "Velocity of every coordinate at time 0").default("0"),
];

static STRUCTURE: &[Variant] = &[
    Variant {
        name: "oscillator",
        about: "One degree of freedom",
        keys: &[
            Key::new("mass", Kind::Quantity(&MASS), "M, without the grains").above(0.0),
            Key::new("stiffness", Kind::Quantity(&STIFFNESS), "K").above(0.0),
            Key::new("damping", Kind::Quantity(&DAMPING), "C")
                .at_least(0.0)
                .derived("from `damping-ratio`; one of the two is required")
                .rivals(&["damping-ratio"]),
            Key::new("damping-ratio", Kind::Quantity(&NUMBER), "C over its critical value 2 sqrt(K M)")
                .at_least(0.0)
                .optional()
                .rivals(&["damping"]),
        ],
    },
    Variant {
        name: "matrices",
        about: "n degrees of freedom by their matrices",
        keys: &[
            Key::new("mass", Kind::Matrix(&MASS), "M, symmetric and positive definite"),
            Key::new("damping", Kind::Matrix(&DAMPING), "C, symmetric"),
            Key::new("stiffness", Kind::Matrix(&STIFFNESS), "K, symmetric and positive definite"),
            Key::new(
                "coordinate",
                Kind::Whole,
                "Index (from 0) of the coordinate that carries the walls and takes the force",
            )
            .default("0")
            .at_least(0.0)
            .at_most(1e4),
        ],
    },
    Variant {
        name: "modes",
        about: "n degrees of freedom by a list of modes",
        keys: &[Key::new("mode", Kind::Many(MODE), "The modes")],
    },
];

static MODE: &[Key] = &[
    Key::new("frequency", Kind::Quantity(&FREQUENCY), "Natural frequency").above(0.0),
    Key::new("damping-ratio", Kind::Quantity(&NUMBER), "Damping over critical damping").at_least(0.0),
    Key::new("mass", Kind::Quantity(&MASS), "Modal mass").above(0.0),
    Key::new("shape", Kind::Quantity(&NUMBER), "Mode shape where the walls are").default("1"),
    Key::new("participation", Kind::Quantity(&NUMBER), "Participation of the base motion").default("1"),
];

const FREQUENCY_OF_A_SINE: Key = Key::new("frequency", Kind::Quantity(&FREQUENCY), "Frequency").above(0.0);
const PHASE: Key = Key::new("phase", Kind::Quantity(&ANGLE), "Phase at time 0").default("0");

/// A sine, by its amplitude.
macro_rules! sine {
    ($what:expr) => {
        &[Key::new("amplitude", Kind::Quantity($what), "Amplitude").at_least(0.0), FREQUENCY_OF_A_SINE, PHASE]
    };
}

/// Displacements are known by their acceleration too.
static SHAKEN: &[Key] = &[
    Key::new("amplitude", Kind::Quantity(&LENGTH), "Amplitude")
        .at_least(0.0)
        .derived("from `acceleration`; one of the two is required")
        .rivals(&["acceleration"]),
    Key::new(
        "acceleration",
        Kind::Quantity(&ACCELERATION),
        "Amplitude of the acceleration: amplitude (2 pi frequency)^2; `g` is a unit",
    )
    .at_least(0.0)
    .optional()
    .rivals(&["amplitude"]),
    FREQUENCY_OF_A_SINE,
    PHASE,
];

/// The same signals for displacements, angles and forces.
macro_rules! signals {
    ($what:expr, $rate:expr, $sine:expr) => {
        [
            Variant {
                name: "sine",
                about: "amplitude sin(2 pi frequency t + phase)",
                keys: $sine,
            },
            Variant {
                name: "sine-sweep",
                about: "Sine of constant amplitude whose frequency runs linearly in time; silent afterwards",
                keys: &[
                    Key::new("amplitude", Kind::Quantity($what), "Amplitude").at_least(0.0),
                    Key::new("from", Kind::Quantity(&FREQUENCY), "First frequency").above(0.0),
                    Key::new("to", Kind::Quantity(&FREQUENCY), "Last frequency").above(0.0),
                    Key::new("duration", Kind::Quantity(&TIME), "Length").above(0.0),
                ],
            },
            Variant {
                name: "impact",
                about: "Half-sine pulse",
                keys: &[
                    Key::new("peak", Kind::Quantity($what), "Height"),
                    Key::new("duration", Kind::Quantity(&TIME), "Length").above(0.0),
                    Key::new("at", Kind::Quantity(&TIME), "Begin").default("0").at_least(0.0),
                ],
            },
            Variant {
                name: "steady",
                about: "rate t: steady motion, turning or loading from 0 on",
                keys: &[Key::new("rate", Kind::Quantity($rate), "Rate")],
            },
            Variant {
                name: "table",
                about: "Straight lines between given points, constant outside",
                keys: &[
                    Key::new("file", Kind::Text, "CSV file with columns time and value, beside the scene; header cells may carry units: `time [ms]`")
                        .optional()
                        .rivals(&["time", "value"]),
                    Key::new("time", Kind::Quantities(&TIME), "Times, rising").derived("from `file`").rivals(&["file"]),
                    Key::new("value", Kind::Quantities($what), "Values, one for each time").derived("from `file`").rivals(&["file"]),
                ],
            },
        ]
    };
}

/// Displacements against time.
pub(super) static DISPLACEMENT: [Variant; 5] = signals!(&LENGTH, &SPEED, SHAKEN);
/// Angles against time.
pub(super) static TURN: [Variant; 5] = signals!(&ANGLE, &SPIN, sine!(&ANGLE));
/// Forces against time.
pub(super) static LOAD: [Variant; 5] = signals!(&FORCE, &LOAD_RATE, sine!(&FORCE));
