//! Keys that several watches have.

use crate::key::{Family, Key, Kind};
use crate::plan::Region;
use crate::units::LENGTH;

pub(super) const REGION: Key = Key::new(
    "region",
    Kind::Table(Region::KEYS),
    "Where: a box of space; it stands still, whatever walls are around it",
)
.derived("the inside of the box as drawn, where there is one box");
pub(super) const STAYS: Key =
    Key::new("region", Kind::Table(Region::ROUND_KEYS), "Where; it stands still, whatever walls are around it")
        .derived("the inside of the box as drawn, where there is one box");
pub(super) const WITHIN: Key =
    Key::new("region", Kind::Table(Region::ROUND_KEYS), "Only grains whose centres are inside; it stands still")
        .optional();
pub(super) const SIZES: Key = Key::new(
    "sizes",
    Kind::Quantities(&LENGTH),
    "Diameters, rising: it is told for the grains below, between and from them on, too",
)
.above(0.0)
.optional();
pub(super) const WALLS: Key = Key::new("walls", Kind::Flag, "Whether contacts with walls count");
pub(super) const GROUP: Key = Key::new("group", Kind::Name(Family::Group), "Only the grains of this group").optional();
