//! The contact law: one choice for each part of the stack. The choices stand in the plan, a file a family.

use super::{Key, Kind};
use crate::plan::{Cohesion, Damping, Film, Normal, Rolling, SLIP_LEVER, Tangential, Twisting};

pub(super) static CONTACT: &[Key] = &[
    NORMAL_FORCE.default("{ hertz = {} }"),
    NORMAL_DAMPING.default("{ quarter = {} }"),
    ATTRACTION.default("false"),
    TANGENTIAL_FORCE.default("{ mindlin = {} }"),
    ROLLING_RESISTANCE.default("{ none = {} }"),
    TWISTING_RESISTANCE.default("{ none = {} }"),
    COHESIVE_FORCE.default("{ none = {} }"),
    FILM_BETWEEN.default("{ none = {} }"),
    PULLED_FRICTION.default("false"),
    Key::new("rotation", Kind::Flag, "Whether grains spin").default("true"),
    Key::new(
        "slip-lever",
        Kind::OneOf(SLIP_LEVER),
        "Arm at which spin moves the point of contact, and friction turns the grain",
    )
    .default("'middle'"),
];

/// The same for a pair of materials; whether grains spin, and by which arm, is no matter of a pair.
pub(super) static OF_A_PAIR: &[Key] = &[
    NORMAL_FORCE.derived(AS_IN_THE_SCENE),
    NORMAL_DAMPING.derived(AS_IN_THE_SCENE),
    ATTRACTION.derived(AS_IN_THE_SCENE),
    TANGENTIAL_FORCE.derived(AS_IN_THE_SCENE),
    ROLLING_RESISTANCE.derived(AS_IN_THE_SCENE),
    TWISTING_RESISTANCE.derived(AS_IN_THE_SCENE),
    COHESIVE_FORCE.derived(AS_IN_THE_SCENE),
    FILM_BETWEEN.derived(AS_IN_THE_SCENE),
    PULLED_FRICTION.derived(AS_IN_THE_SCENE),
];

const AS_IN_THE_SCENE: &str = "as in `[contact]`";

const NORMAL_FORCE: Key = Key::new("normal", Kind::Choice(Normal::CHOICES), "Elastic normal force for overlap d");
const NORMAL_DAMPING: Key = Key::new(
    "damping",
    Kind::Choice(Damping::CHOICES),
    "Damping of the normal motion; unless a form says otherwise, its coefficient is found from the restitution",
);
const ATTRACTION: Key =
    Key::new("attraction", Kind::Flag, "Let damping make the normal force attractive instead of cutting it at zero");
const PULLED_FRICTION: Key =
    Key::new("pulled-friction", Kind::Flag, "Let a normal force that pulls carry friction, mu times its size");
const TANGENTIAL_FORCE: Key = Key::new("tangential", Kind::Choice(Tangential::CHOICES), "Tangential force");
const ROLLING_RESISTANCE: Key = Key::new("rolling", Kind::Choice(Rolling::CHOICES), "Rolling resistance");
const TWISTING_RESISTANCE: Key =
    Key::new("twisting", Kind::Choice(Twisting::CHOICES), "Resistance against turning about the normal");
const COHESIVE_FORCE: Key =
    Key::new("cohesion", Kind::Choice(Cohesion::CHOICES), "Attraction between bodies in contact");
const FILM_BETWEEN: Key = Key::new(
    "film",
    Kind::Choice(Film::CHOICES),
    "Liquid between bodies that are near; while they touch only if told (`in-contact`)",
);
