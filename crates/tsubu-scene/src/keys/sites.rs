//! Settings of the models with one grain a site.

use super::{Key, Kind, Word};
use crate::units::{NUMBER, TIME};

const STEP: Key = Key::new(
    "time-step",
    Kind::Quantity(&TIME),
    "Time step; automatic: the time in which a grain falls from rest to the next row",
)
.above(0.0)
.word("automatic");

pub(super) const fn chance(name: &'static str, default: &'static str, about: &'static str) -> Key {
    Key::new(name, Kind::Quantity(&NUMBER), about).default(default).at_least(0.0).at_most(1.0)
}

const LEFT: Key = chance("left", "0.5", "Probability that a void takes the grain to its upper left, not right");

pub(super) static LITWINISZYN: &[Key] =
    &[LEFT, chance("rate", "1", "Voids that set out from each outlet site in a step"), STEP];

pub(super) static AFTER_CARAM_HONG: &[Key] = &[
    LEFT,
    chance("rate", "1", "Probability that an outlet site takes a grain when its turn comes, every other step"),
    STEP,
];

pub(super) static AFTER_SAVAGE: &[Key] = &[
    chance("down", "0.5", "Chance of a grain of the smallest size to use a free site straight below, in a step"),
    chance("diagonal", "0.3", "The same for the two sites below and aside, together"),
    chance("sideways", "0.6", "The same for the two sites beside, together"),
    chance(
        "up",
        "0.2",
        "The same for the site above: how much flow disturbs the bed; at most `down` and `diagonal` together",
    ),
    STEP,
];

pub(super) static GUTT_HAFF: &[Key] = &[Key::new(
    "time-step",
    Kind::Quantity(&TIME),
    "Time step; automatic: a fall through the whole height makes 0.02 of a spacing in the last step",
)
.above(0.0)
.word("automatic")];

pub(super) static AFTER_HEMMINGSSON_HERRMANN: &[Key] = &[
    Key::new("split", Kind::OneOf(SPLIT), "How a grain shares its load between the two below").default("'balance'"),
    Key::new("friction", Kind::Quantity(&NUMBER), "Friction coefficient between grains").default("0").at_least(0.0),
    chance("arching", "0", "Probability that a grain gives all its load to the outer one of the two below"),
];

static SPLIT: &[Word] = &[
    Word { name: "balance", about: "as the balance of forces asks for" },
    Word { name: "random", about: "in random shares of the weight alone: the q-model" },
];
