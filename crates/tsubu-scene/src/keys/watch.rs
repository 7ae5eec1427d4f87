//! Watches: what is looked at while a scene runs, and when.

use super::{Family, Key, Kind, Word, walls};
use crate::units::{AREA, DENSITY, LENGTH, NUMBER, SPEED, TIME};

/// A watch has exactly one of these tables.
pub(crate) const KINDS: &[&str] = &[
    "profile",
    "coarse-grain",
    "slope",
    "discharge",
    "hops",
    "bedload",
    "run-out",
    "coordination",
    "fabric",
    "forces",
    "contacts",
    "segregation",
    "wall-load",
    "stream",
    "track",
];

const fn kind(name: &'static str, keys: &'static [Key], about: &'static str) -> Key {
    Key::new(name, Kind::Table(keys), about).optional().rivals(KINDS)
}

pub(super) static WATCH: &[Key] = &[
    Key::new("from", Kind::Quantity(&TIME), "When the first look is taken").default("0").at_least(0.0),
    Key::new("until", Kind::Quantity(&TIME), "After this no look is taken").above(0.0).word("end"),
    Key::new("every", Kind::Quantity(&TIME), "Simulated time between looks, or \"step\": at every step")
        .above(0.0)
        .derived_or_word("`output.history-interval`; of `hops` every step", "step"),
    kind(
        "profile",
        PROFILE,
        "Averages in slices across an axis: solid fraction, velocity, temperature, coordination, spin",
    ),
    kind(
        "coarse-grain",
        COARSE_GRAIN,
        "Density, velocity, stress and granular temperature as smooth fields (Goldhirsch 2010); in the plane per area, not volume",
    ),
    kind("slope", SLOPE, "Slope of the free surface, and the angle of a heap, by least squares"),
    kind("discharge", DISCHARGE, "Grains and mass that have passed a plane, less those that came back, and the rate"),
    kind(
        "hops",
        HOPS,
        "Hops over a bed, from touch to touch: height, length, times, impact, restitution, contact time",
    ),
    kind("bedload", BEDLOAD, "Transport of grains along a bed, its fluctuation, and grains that start and stop"),
    kind("run-out", RUN_OUT, "Front, travel and fall of the centre of mass, and the deposit"),
    kind("coordination", COORDINATION, "Contacts per grain, with and without rattlers"),
    kind("fabric", FABRIC, "Fabric tensor of the contact normals, its deviator and principal direction"),
    kind("forces", FORCES, "Distribution of normal contact forces, and the share of contacts in force chains"),
    kind("contacts", CONTACTS, "Contacts one by one: who touches whom, where, with what force and overlap"),
    kind(
        "segregation",
        SEGREGATION,
        "How well two groups are mixed: Lacey index, and the height of one over the other",
    ),
    kind("wall-load", WALL_LOAD, "Force and torque of the grains on a wall, and its pressure"),
    kind(
        "stream",
        STREAM,
        "The water: shear velocity, Shields and Rouse numbers, discharge; velocity, shear, stress and share of water by layers",
    ),
    kind("track", TRACK, "Position, velocity and spin of some grains; positions go on across periodic ends"),
];

const REGION: Key = Key::new(
    "region",
    Kind::Table(walls::REGION),
    "Where: a box of space; it stands still, whatever walls are around it",
);
const WITHIN: Key =
    Key::new("region", Kind::Table(walls::REGION), "Only grains whose centres are inside; a box that stands still")
        .optional();
const INSIDE_THE_BOX: &str = "the inside of the box as drawn, where there is one box";
const WALLS: Key = Key::new("walls", Kind::Flag, "Whether contacts with walls count");

static X: Word = Word { name: "x", about: "to the right" };
static Y: Word = Word { name: "y", about: "into the picture, only in space" };
static Z: Word = Word { name: "z", about: "up" };
static AXES: &[Word] = &[X, Y, Z];
static ACROSS: &[Word] = &[X, Y];

static QUANTITIES: &[Word] = &[
    Word { name: "solid-fraction", about: "share of the volume that grains fill, in the plane of the area" },
    Word { name: "velocity", about: "mean velocity, by mass" },
    Word { name: "granular-temperature", about: "mean square of a component of the velocity about the mean" },
    Word { name: "coordination", about: "contacts per grain, those with walls among them" },
    Word { name: "spin", about: "mean spin, by moment of inertia" },
];

static KERNEL: &[Word] = &[
    Word { name: "gaussian", about: "exp(-r^2 / 2 w^2), cut where nothing is left at 8 w" },
    Word { name: "lucy", about: "(1 + 3 r/w) (1 - r/w)^3, zero from w on" },
];

static PROFILE: &[Key] = &[
    Key::new("axis", Kind::OneOf(AXES), "Axis along which the slices follow each other").default("'z'"),
    Key::new("bins", Kind::Whole, "Number of slices").default("20").at_least(1.0).at_most(1e5),
    Key::new("quantities", Kind::SomeOf(QUANTITIES), "What is averaged")
        .default("['solid-fraction', 'velocity', 'granular-temperature']"),
    REGION.derived(INSIDE_THE_BOX),
];

static COARSE_GRAIN: &[Key] = &[
    Key::new("kernel", Kind::OneOf(KERNEL), "How a grain is smeared out").default("'lucy'"),
    Key::new(
        "width",
        Kind::Quantity(&LENGTH),
        "Width w of the kernel: standard deviation of the Gaussian, reach of Lucy's",
    )
    .above(0.0),
    Key::new(
        "axes",
        Kind::SomeOf(AXES),
        "Axes along which fields vary; along the others they are averaged over the region",
    )
    .default("['z']"),
    Key::new("points", Kind::Wholes, "Points along each of these axes, evenly spaced in the region")
        .at_least(1.0)
        .at_most(1e5),
    REGION.derived(INSIDE_THE_BOX),
];

static SLOPE: &[Key] = &[
    Key::new("axis", Kind::OneOf(ACROSS), "Horizontal axis of the slope").default("'x'"),
    Key::new("bins", Kind::Whole, "Columns in which the highest grain is looked for")
        .default("20")
        .at_least(4.0)
        .at_most(1e5),
    Key::new("share", Kind::Quantity(&NUMBER), "Middle share of the width that the lines are laid through")
        .default("0.8")
        .above(0.0)
        .at_most(1.0),
    Key::new("centre", Kind::Quantity(&LENGTH), "Where the top of a heap is, along the axis")
        .derived("the middle of the region"),
    Key::new("touching", Kind::Flag, "Whether grains must touch something to count: those in flight are no surface")
        .default("true"),
    REGION.derived(INSIDE_THE_BOX),
];

static DISCHARGE: &[Key] = &[
    Key::new("point", Kind::Vector(&LENGTH), "A point on the plane").default("'origin'"),
    Key::new("normal", Kind::Direction, "Direction in which grains pass").default("'-z'"),
    Key::new("group", Kind::Name(Family::Group), "Only the grains of this group").optional(),
];

static BED: &[Word] = &[
    Word { name: "walls", about: "walls of any shape" },
    Word { name: "fixed-grains", about: "frozen and driven grains" },
    Word { name: "free-grains", about: "grains that forces move" },
];

static HOPS: &[Key] = &[
    Key::new("bed", Kind::SomeOf(BED), "What a grain must touch to be on the bed").default("['walls', 'fixed-grains']"),
    Key::new("group", Kind::Name(Family::Group), "Only the grains of this group").optional(),
    Key::new("along", Kind::Direction, "Direction in which hops are long").default("'x'"),
    Key::new("up", Kind::Direction, "Direction in which hops are high, away from the bed").default("'z'"),
    Key::new("lowest", Kind::Quantity(&LENGTH), "Lower hops are not counted").default("0").at_least(0.0),
    Key::new("most", Kind::Whole, "After so many hops nothing is counted any more")
        .at_least(1.0)
        .at_most(1e9)
        .optional(),
];

static BEDLOAD: &[Key] = &[
    Key::new("axis", Kind::OneOf(ACROSS), "Horizontal axis of the transport").default("'x'"),
    REGION.derived(INSIDE_THE_BOX),
    Key::new("group", Kind::Name(Family::Group), "Only the grains of this group").optional(),
    Key::new(
        "width",
        Kind::Quantity(&LENGTH),
        "In the plane: the grains are spheres in a bed of this width; without it they are discs",
    )
    .above(0.0)
    .optional(),
    Key::new("moving-speed", Kind::Quantity(&SPEED), "A grain that is faster begins to move")
        .default("'10 mm/s'")
        .above(0.0),
    Key::new("resting-speed", Kind::Quantity(&SPEED), "A moving grain that is slower has come to rest")
        .at_least(0.0)
        .derived("half of `moving-speed`"),
    Key::new("fluid-density", Kind::Quantity(&DENSITY), "Density of the fluid; gives the Einstein number")
        .above(0.0)
        .optional(),
];

static STREAM: &[Key] =
    &[Key::new("group", Kind::Name(Family::Group), "Shields and Rouse numbers are of the grains of this group")
        .optional()];

static HEADINGS: &[Word] = &[
    Word { name: "x", about: "to the right" },
    Word { name: "-x", about: "to the left" },
    Word { name: "y", about: "into the picture, only in space" },
    Word { name: "-y", about: "out of the picture, only in space" },
];

static RUN_OUT: &[Key] = &[
    Key::new("direction", Kind::OneOf(HEADINGS), "Where the grains run").default("'x'"),
    Key::new("share", Kind::Quantity(&NUMBER), "Share of the mass that is behind the mass front")
        .default("0.99")
        .above(0.0)
        .at_most(1.0),
    Key::new("bins", Kind::Whole, "Columns of the deposit").default("40").at_least(1.0).at_most(1e5),
    Key::new("group", Kind::Name(Family::Group), "Only the grains of this group").optional(),
    REGION.derived(INSIDE_THE_BOX),
];

static COORDINATION: &[Key] = &[
    Key::new("fewest", Kind::Whole, "Grains with fewer contacts are rattlers; taken out until none is left")
        .default("2")
        .at_least(1.0)
        .at_most(12.0),
    WALLS.default("true"),
    WITHIN,
];

static FABRIC: &[Key] = &[WALLS.default("false"), WITHIN];

static FORCES: &[Key] = &[
    Key::new("bins", Kind::Whole, "Bins of the histogram").default("30").at_least(1.0).at_most(1e5),
    Key::new("largest", Kind::Quantity(&NUMBER), "Upper end of the histogram, in mean forces").default("6").above(1.0),
    WALLS.default("false"),
    WITHIN,
];

static SEGREGATION: &[Key] = &[
    Key::new("groups", Kind::Names(Family::Group), "The two groups").derived("the two groups, where there are two"),
    Key::new("cell", Kind::Quantity(&LENGTH), "Edge of the cells in which grains are counted").above(0.0),
    WITHIN,
];

static FACES: &[Word] = &[
    Word { name: "left", about: "at the low end of x" },
    Word { name: "right", about: "at the high end of x" },
    Word { name: "front", about: "at the low end of y, only in space" },
    Word { name: "back", about: "at the high end of y, only in space" },
    Word { name: "floor", about: "at the low end of z" },
    Word { name: "lid", about: "at the high end of z" },
];

static CONTACTS: &[Key] = &[WALLS.default("true"), WITHIN];

static WALL_LOAD: &[Key] = &[
    Key::new("wall", Kind::Name(Family::Wall), "The wall"),
    Key::new("face", Kind::OneOf(FACES), "Only this face of a box that does not turn; without torque").optional(),
    Key::new("area", Kind::Quantity(&AREA), "Area for the pressure; in the plane times the depth that is meant")
        .above(0.0)
        .optional(),
    Key::new("direction", Kind::Direction, "Direction in which the pressure acts on the wall")
        .derived("of a plane against its normal; else required with `area`"),
];

static TRACK: &[Key] = &[
    Key::new("ids", Kind::Wholes, "Numbers of the grains, from 0 in the order of the groups' names")
        .at_least(0.0)
        .at_most(4e9),
    Key::new("group", Kind::Name(Family::Group), "The group that the numbers count in, from its first grain")
        .optional(),
];
