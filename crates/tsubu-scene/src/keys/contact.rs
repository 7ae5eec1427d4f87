//! The contact law: one choice for each part of the stack.

use super::{Key, Kind, Variant};
use crate::units::{SPEED, STIFFNESS};

pub(super) static CONTACT: &[Key] = &[
    Key::new("normal", Kind::Choice(NORMAL), "Elastic normal force for overlap d").default("{ hertz = {} }"),
    Key::new(
        "damping",
        Kind::Choice(DAMPING),
        "Damping of the normal motion; its coefficient is found from the restitution",
    )
    .default("{ quarter = {} }"),
    Key::new("attraction", Kind::Flag, "Let damping make the normal force attractive instead of cutting it at zero")
        .default("false"),
    Key::new("tangential", Kind::Choice(TANGENTIAL), "Tangential force").default("{ mindlin = {} }"),
    Key::new("rolling", Kind::Choice(ROLLING), "Rolling resistance").default("{ none = {} }"),
    Key::new("rotation", Kind::Flag, "Whether grains spin").default("true"),
];

static NORMAL: &[Variant] = &[
    Variant { name: "hertz", about: "k d^(3/2), k from the materials", keys: &[] },
    Variant {
        name: "hooke",
        about: "k d, one k for all contacts",
        keys: &[Key::new("stiffness", Kind::Quantity(&STIFFNESS), "k").above(0.0)],
    },
];

const REFERENCE_SPEED: Key =
    Key::new("reference-speed", Kind::Quantity(&SPEED), "Impact speed at which the restitution is the materials'")
        .default("'1 m/s'")
        .above(0.0);

static DAMPING: &[Variant] = &[
    Variant { name: "none", about: "No damping, whatever the restitution", keys: &[] },
    Variant {
        name: "sqrt",
        about: "c d^(1/2) d' (visco-elastic, Kuwabara-Kono): restitution falls slowly with speed",
        keys: &[REFERENCE_SPEED],
    },
    Variant { name: "quarter", about: "c d^(1/4) d' (Tsuji 1992): constant restitution with Hertz", keys: &[] },
    Variant {
        name: "linear",
        about: "c d': constant restitution with Hooke; with Hertz it is met at the reference speed",
        keys: &[REFERENCE_SPEED],
    },
];

static TANGENTIAL: &[Variant] = &[
    Variant { name: "none", about: "No tangential force", keys: &[] },
    Variant {
        name: "coulomb",
        about: "Sliding friction without a spring, smoothed near zero sliding speed; heaps creep",
        keys: &[Key::new("smoothing-speed", Kind::Quantity(&SPEED), "Sliding speed below which friction fades")
            .default("'1 mm/s'")
            .above(0.0)],
    },
    Variant { name: "mindlin", about: "Spring with history, capped at the friction limit", keys: &[] },
];

static ROLLING: &[Variant] = &[
    Variant { name: "none", about: "No rolling resistance", keys: &[] },
    Variant {
        name: "constant",
        about: "Torque of rolling friction times radius times normal force, against the relative rolling",
        keys: &[Key::new("smoothing-speed", Kind::Quantity(&SPEED), "Rolling speed below which the torque fades")
            .default("'1 mm/s'")
            .above(0.0)],
    },
];
