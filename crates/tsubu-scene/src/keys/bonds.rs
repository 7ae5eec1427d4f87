//! Bonds between grains.

use super::{Family, Key, Kind};
use crate::units::{NUMBER, PRESSURE, TIME};

pub(super) static BOND: &[Key] = &[
    Key::new(
        "particles",
        Kind::Names(Family::Group),
        "Groups whose grains are bonded, each with those of all of these groups that are near; without it all groups",
    )
    .optional(),
    Key::new("at", Kind::Quantity(&TIME), "When they are made; at 0 after grains have settled")
        .default("0")
        .at_least(0.0),
    Key::new(
        "gap",
        Kind::Quantity(&NUMBER),
        "Widest gap between surfaces that is bonded, over the radius of the smaller grain; superellipsoids, polyhedra and polygons have that of a sphere of their volume, or disc of their area",
    )
    .default("0.01")
    .at_least(0.0)
    .at_most(1.0),
    Key::new("radius", Kind::Quantity(&NUMBER), "Radius of the bond, a round beam from centre to centre, over that of the smaller grain as for `gap`")
        .default("1")
        .above(0.0)
        .at_most(2.0),
    Key::new("young-modulus", Kind::Quantity(&PRESSURE), "Young's modulus of the bond").above(0.0),
    Key::new("poisson-ratio", Kind::Quantity(&NUMBER), "Poisson's ratio of the bond").default("0.3").above(-1.0).below(0.5),
    Key::new(
        "damping",
        Kind::Quantity(&NUMBER),
        "Damping of the stretching of a bond, over the critical; slower vibrations are damped less, in proportion to their frequency",
    )
    .default("0")
    .at_least(0.0)
    .at_most(1.0),
    Key::new("tensile-strength", Kind::Quantity(&PRESSURE), "Largest tension in its section at which the bond breaks; without it none")
        .above(0.0)
        .optional(),
    Key::new("shear-strength", Kind::Quantity(&PRESSURE), "Largest shear stress in its section at which the bond breaks; without it none")
        .above(0.0)
        .optional(),
    Key::new(
        "weibull-modulus",
        Kind::Quantity(&NUMBER),
        "Scatter of both strengths from bond to bond (Weibull 1951): the strengths are means; without it all bonds are alike",
    )
    .above(0.5)
    .optional(),
];
