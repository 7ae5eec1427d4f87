//! Signals against time: what drives hosts, walls and groups of grains.

use super::study::KEEP;
use super::{Key, Kind, Variant, Word};
use crate::units::{
    ACCELERATION, ACCELERATION_DENSITY, ANGLE, FORCE, FORCE_DENSITY, FREQUENCY, LENGTH, LOAD_RATE, NUMBER, SPEED, SPIN,
    TIME,
};

const FREQUENCY_OF_A_SINE: Key = Key::new("frequency", Kind::Quantity(&FREQUENCY), "Frequency").above(0.0);
const PHASE: Key = Key::new("phase", Kind::Quantity(&ANGLE), "Phase at time 0").default("0");

const FROM: Key = Key::new("from", Kind::Quantity(&FREQUENCY), "First frequency").above(0.0);
const TO: Key = Key::new("to", Kind::Quantity(&FREQUENCY), "Last frequency, above or below the first").above(0.0);
const DURATION: Key = Key::new("duration", Kind::Quantity(&TIME), "Length").above(0.0);
const SCALE: Key = Key::new("scale", Kind::OneOf(SCALES), "How the frequency runs in time").default("'linear'");

static SCALES: &[Word] = &[
    Word { name: "linear", about: "So many Hz a second" },
    Word { name: "logarithmic", about: "So many octaves a second, as shakers do" },
];

/// A sine, by its amplitude.
macro_rules! sine {
    ($what:expr) => {
        &[Key::new("amplitude", Kind::Quantity($what), "Amplitude").at_least(0.0), FREQUENCY_OF_A_SINE, PHASE]
    };
}

/// A sweep of constant amplitude.
macro_rules! sweep {
    ($what:expr) => {
        &[Key::new("amplitude", Kind::Quantity($what), "Amplitude").at_least(0.0), FROM, TO, DURATION, SCALE]
    };
}

// Displacements are known by their velocity and acceleration too.
const AMPLITUDE: Key = Key::new("amplitude", Kind::Quantity(&LENGTH), "Amplitude")
    .at_least(0.0)
    .derived("from `velocity` or `acceleration`; one of the three is required")
    .rivals(&["velocity", "acceleration"]);
const VELOCITY: Key =
    Key::new("velocity", Kind::Quantity(&SPEED), "Amplitude of the velocity: amplitude 2 pi frequency")
        .at_least(0.0)
        .optional()
        .rivals(&["amplitude", "acceleration"]);
const ACCELERATION_OF_A_SINE: Key = Key::new(
    "acceleration",
    Kind::Quantity(&ACCELERATION),
    "Amplitude of the acceleration: amplitude (2 pi frequency)^2; `g` is a unit",
)
.at_least(0.0)
.optional()
.rivals(&["amplitude", "velocity"]);

static SHAKEN: &[Key] = &[AMPLITUDE, VELOCITY, ACCELERATION_OF_A_SINE, FREQUENCY_OF_A_SINE, PHASE];
static SWEPT: &[Key] = &[
    AMPLITUDE,
    VELOCITY,
    ACCELERATION_OF_A_SINE,
    FROM,
    TO,
    DURATION,
    SCALE,
    Key::new("keep", Kind::OneOf(KEEP), "What stays the same at all frequencies; an `amplitude` is that at the first")
        .derived("what it is given by: `amplitude`, `velocity` or `acceleration`"),
];

/// The same signals for displacements, angles and forces.
macro_rules! signals {
    ($what:expr, $rate:expr, $sine:expr, $sweep:expr $(, $own:expr)*) => {
        [
            Variant {
                name: "sine",
                about: "amplitude sin(2 pi frequency t + phase)",
                keys: $sine,
            },
            Variant {
                name: "sine-sweep",
                about: "Sine whose frequency runs from one to another; silent afterwards",
                keys: $sweep,
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
            $($own,)*
            Variant {
                name: "sines",
                about: "Sum of sines: offset + amplitude sin(2 pi frequency t + phase) + ...",
                keys: &[
                    Key::new("amplitude", Kind::Quantities($what), "Their amplitudes").at_least(0.0),
                    Key::new("frequency", Kind::Quantities(&FREQUENCY), "Their frequencies, one for each amplitude").above(0.0),
                    Key::new("phase", Kind::Quantities(&ANGLE), "Their phases at time 0").derived("0 each"),
                    Key::new("offset", Kind::Quantity($what), "Added to their sum").default("0"),
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

/// A shock as a table drops it: of displacements alone.
const SHOCK: Variant = Variant {
    name: "shock",
    about: "Half-sine pulse of acceleration; without compensation it goes on at the speed gained, 2 acceleration duration / pi",
    keys: &[
        Key::new("acceleration", Kind::Quantity(&ACCELERATION), "Peak of the acceleration; `g` is a unit"),
        Key::new("duration", Kind::Quantity(&TIME), "Length of the pulse").above(0.0),
        Key::new("at", Kind::Quantity(&TIME), "Begin").default("0").at_least(0.0),
        Key::new(
            "compensation",
            Kind::Quantity(&NUMBER),
            "Peak of two longer pulses of the other sign, before and after it, over its own: they bring the base back to rest where it was; 0: none",
        )
        .default("0")
        .at_least(0.0)
        .at_most(0.5),
    ],
};

/// Random vibration, of whatever has the spectral density.
macro_rules! random {
    ($density:expr, $of:expr, $begins:expr, $unit:expr) => {
        Variant {
            name: "random",
            about: concat!("Random vibration by the power spectral density of ", $of, ": a sum of sines with random frequencies and phases", $begins),
            keys: &[
                Key::new("file", Kind::Text, concat!("CSV file with columns frequency and density, beside the scene; header cells may carry units: `psd [", $unit, "]`"))
                    .optional()
                    .rivals(&["frequency", "psd"]),
                Key::new("frequency", Kind::Quantities(&FREQUENCY), "Frequencies of the table, rising")
                    .above(0.0)
                    .optional()
                    .rivals(&["file"]),
                Key::new(
                    "psd",
                    Kind::Quantities($density),
                    concat!("One-sided power spectral density of ", $of, " at each of them; between them it is straight in logarithms of both, outside 0"),
                )
                .above(0.0)
                .optional()
                .rivals(&["file"]),
                Key::new("lines", Kind::Whole, "Number of sines, one in each of as many bands of the same ratio of frequencies")
                    .default("400")
                    .at_least(1.0)
                    .at_most(1e5),
                Key::new("seed", Kind::Whole, "Which of all such vibrations").derived("that of the scene").at_least(0.0),
            ],
        }
    };
}

/// Displacements against time.
pub(super) static DISPLACEMENT: [Variant; 8] = signals!(
    &LENGTH,
    &SPEED,
    SHAKEN,
    SWEPT,
    SHOCK,
    random!(&ACCELERATION_DENSITY, "the acceleration", ", from 0 at time 0", "g^2/Hz")
);
/// Angles against time.
pub(super) static TURN: [Variant; 6] = signals!(&ANGLE, &SPIN, sine!(&ANGLE), sweep!(&ANGLE));
/// Forces against time.
pub(super) static LOAD: [Variant; 7] =
    signals!(&FORCE, &LOAD_RATE, sine!(&FORCE), sweep!(&FORCE), random!(&FORCE_DENSITY, "the force", "", "N^2/Hz"));
