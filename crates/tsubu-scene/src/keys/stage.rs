//! Stages of a run.

use super::{Key, Kind};
use crate::units::{ENERGY, NUMBER, TIME};

pub(super) static STAGE: &[Key] = &[
    Key::new("name", Kind::Text, "Its name: results are told as NAME.RESULT"),
    Key::new("duration", Kind::Quantity(&TIME), "How long it lasts").above(0.0).optional(),
    Key::new(
        "until",
        Kind::Table(UNTIL),
        "What ends it instead, looked at whenever a row of the history is due; where several are \
given, all must hold at once",
    )
    .optional(),
    Key::new("at-most", Kind::Quantity(&TIME), "How long it lasts where `until` does not come true")
        .above(0.0)
        .optional(),
    Key::new("set", Kind::Set, "Keys that have another value from this stage on, written as in a scene").default("{}"),
];

static UNTIL: &[Key] = &[
    Key::new(
        "kinetic-energy",
        Kind::Quantity(&ENERGY),
        "The kinetic energy, spin included, over the number of all grains is below this; frozen and driven grains, and each sphere of a clump, are counted",
    )
    .above(0.0)
    .optional(),
    Key::new(
        "kinetic-over-potential",
        Kind::Quantity(&NUMBER),
        "The kinetic energy of all grains over their potential energy from z = 0 is below this",
    )
    .above(0.0)
    .optional(),
    Key::new(
        "host-steady",
        Kind::Quantity(&NUMBER),
        "The rms displacement of each host that a sine drives differs by less than this share from that of the period before",
    )
    .above(0.0)
    .optional(),
    Key::new(
        "result",
        Kind::Text,
        "A column of history.csv by its name, without the unit; goes with `above` or `below`",
    )
    .optional(),
    Key::new("above", Kind::Quantity(&NUMBER), "It is above this, in SI units").optional(),
    Key::new("below", Kind::Quantity(&NUMBER), "It is below this, in SI units").optional(),
    Key::new("inserted", Kind::Whole, "So many grains of streams have come since the begin of the run")
        .at_least(1.0)
        .at_most(1e9)
        .optional(),
    Key::new("removed", Kind::Whole, "So many grains have been removed since the begin of the run")
        .at_least(1.0)
        .at_most(1e9)
        .optional(),
];
