//! Settings of the lattice gases.

use super::sites::chance;
use super::{Key, Kind, Word};
use crate::units::{LENGTH, NUMBER, TIME};

const SPACING: Key = Key::new(
    "spacing",
    Kind::Quantity(&LENGTH),
    "Distance of neighbouring sites; automatic: the mean diameter of the grains; several grains may be on one",
)
.above(0.0)
.word("automatic");

const STEP: Key = Key::new(
    "time-step",
    Kind::Quantity(&TIME),
    "Time step, in which grains fly one spacing; automatic: grains gain in the mean what the scene's gravity gives",
)
.above(0.0)
.word("automatic");

/// A probability to be turned by gravity; none at all would leave the time step open.
const fn gravity(default: &'static str, about: &'static str) -> Key {
    Key::new("gravity", Kind::Quantity(&NUMBER), about).default(default).above(0.0).at_most(1.0)
}

const fn falls(default: &'static str) -> Key {
    gravity(default, "Probability that gravity turns a grain by 60 degrees downward or lets one at rest go, in a step")
}

const fn dissipation(default: &'static str) -> Key {
    chance("dissipation", default, "Probability that grains which collide come to rest where they met")
}

const ROUGHNESS: Key = chance(
    "roughness",
    "1",
    "Probability that a wall sends a grain back where it came from instead of mirroring it (where it is upright or level)",
);

pub(super) static FHP: &[Key] = &[
    Key::new("rules", Kind::OneOf(RULES), "Which collisions there are").default("'three'"),
    gravity(
        "0.001",
        "Probability that gravity turns a particle that can be turned, in a step; small, or the flow is as fast as particles",
    ),
    Key::new("walls", Kind::OneOf(WALLS), "What walls do with who comes in").default("'rough'"),
    SPACING,
    STEP,
];

pub(super) static AFTER_PENG_HERRMANN: &[Key] = &[falls("0.1"), dissipation("1"), ROUGHNESS, SPACING, STEP];

pub(super) static AFTER_BAXTER_BEHRINGER: &[Key] = &[
    falls("0.2"),
    dissipation("0.3"),
    ROUGHNESS,
    Key::new(
        "neighbours",
        Kind::Quantity(&NUMBER),
        "What a grain saves by lying like a grain of the six sites around, in units of energy",
    )
    .default("0.5"),
    Key::new("way", Kind::Quantity(&NUMBER), "What a flying grain saves by lying along its way, in the same unit")
        .default("1"),
    Key::new(
        "temperature",
        Kind::Quantity(&NUMBER),
        "Temperature at which axes are shaken, in the same unit: a turn that costs E is made with probability exp(-E/T)",
    )
    .default("1")
    .above(0.0),
    SPACING,
    STEP,
];

pub(super) static AFTER_KAROLYI_KERTESZ: &[Key] = &[
    gravity("0.5", "Probability that gravity turns a flying grain by 60 degrees downward, in a step"),
    chance(
        "dissipation",
        "0.8",
        "Probability that a grain which hits another or a wall stays low instead of leaping off",
    ),
    SPACING,
    STEP,
];

static RULES: &[Word] = &[
    Word { name: "one", about: "FHP-I: six velocities; head-on pairs and symmetric triples" },
    Word { name: "two", about: "FHP-II: particles at rest as well" },
    Word { name: "three", about: "FHP-III: every state that another one shares mass and momentum with changes" },
];

static WALLS: &[Word] = &[
    Word { name: "rough", about: "send back: the flow is at rest there" },
    Word { name: "smooth", about: "mirror, where they are upright or level; send back elsewhere" },
];
