//! Settings that one method alone reads.

use super::{Key, Kind, Variant, Word};
use crate::plan::Region;
use crate::units::{LENGTH, NUMBER, TIME};

pub(super) static DEM: &[Key] = &[
    Key::new(
        "time-step",
        Kind::Quantity(&TIME),
        "Time step; automatic: the shortest contact time over `steps-per-contact`",
    )
    .above(0.0)
    .word("automatic")
    .may_change(),
    Key::new(
        "steps-per-contact",
        Kind::Quantity(&NUMBER),
        "Steps per contact for the automatic time step; fewer than 10 is not safe",
    )
    .default("20")
    .at_least(1.0)
    .at_most(1e6)
    .may_change(),
    Key::new("integrator", Kind::OneOf(INTEGRATOR), "Time integration of the grains").default("'velocity-verlet'"),
    Key::new(
        "skin",
        Kind::Quantity(&NUMBER),
        "Extra reach of the candidate search over the smallest diameter; changes speed, and above 96 grains the last bits",
    )
    .default("0.3")
    .at_least(0.0)
    .at_most(10.0),
    Key::new("largest-overlap", Kind::Quantity(&NUMBER), "Overlap over diameter at which the run stops as blown up")
        .default("0.1")
        .above(0.0)
        .at_most(1.0)
        .may_change(),
    Key::new("orientation", Kind::Flag, "Follow how grains turn, and write it into frames").default("false"),
    Key::new(
        "energy-tolerance",
        Kind::Quantity(&NUMBER),
        "Energy residual over turned-over energy above which the run warns",
    )
    .default("1e-3")
    .above(0.0),
];

static INTEGRATOR: &[Word] = &[
    Word { name: "velocity-verlet", about: "second order" },
    Word { name: "symplectic-euler", about: "kick, then drift with the new velocity; first order, stable" },
    Word { name: "forward-euler", about: "drift with the old velocity, then kick; only to reproduce older work" },
];

pub(super) static LATTICE: &[Key] = &[
    Key::new("mode", Kind::OneOf(MODE), "Preset of rules").default("'extended'"),
    Key::new("time-step", Kind::Quantity(&TIME), "Time step").default("'0.1 ms'").above(0.0),
    Key::new("oblique-gravity", Kind::OneOf(OBLIQUE_GRAVITY), "Gravity along the oblique directions")
        .default("'projected'"),
    Key::new("collision", Kind::OneOf(COLLISION), "Who changes in a collision of two balls")
        .derived("pairwise in mode `extended`, literal in `literal`"),
    Key::new(
        "rebound-scatter",
        Kind::Flag,
        "Rebound straight back with probability 1/2, else to the two neighbours; false: straight back",
    )
    .default("true"),
    Key::new(
        "reset-when-blocked",
        Kind::Flag,
        "Forget the stored distance when a collision happens or a move is blocked",
    )
    .default("true"),
    Key::new("keep-remainder", Kind::Flag, "Keep the remainder of the stored distance after a move").default("true"),
    Key::new("resting-impulses", Kind::Flag, "Resting contacts pass their impulse to the host")
        .derived("true in mode `extended`, false in `literal`"),
    Key::new(
        "resting-threshold",
        Kind::Quantity(&NUMBER),
        "Collisions at or below this many g dt of relative speed are resting contacts",
    )
    .default("2")
    .at_least(0.0),
    Key::new("arithmetic", Kind::OneOf(ARITHMETIC), "Number representation of speeds").default("'fixed'"),
    Key::new("head-room", Kind::Whole, "Rows of free cells added above and below the travel of the box")
        .default("8")
        .at_least(0.0)
        .at_most(1e5),
    Key::new(
        "ball-radius",
        Kind::Whole,
        "Cells from the middle of a ball to its rim: 0, a ball is one cell; r, a hexagon of 3 r² + 3 r + 1 cells",
    )
    .default("0")
    .at_least(0.0)
    .at_most(10.0),
];

static MODE: &[Word] = &[
    Word { name: "literal", about: "the nearest reading of Komatsuzaki et al. (2003)" },
    Word { name: "extended", about: "with resting impulses, which give the bed its weight" },
];

static OBLIQUE_GRAVITY: &[Word] = &[
    Word { name: "projected", about: "the component along the direction (one half)" },
    Word { name: "unit", about: "as if vertical" },
];

static COLLISION: &[Word] = &[
    Word { name: "pairwise", about: "both balls change, momentum is conserved along the line" },
    Word { name: "literal", about: "each ball updates only itself" },
];

static ARITHMETIC: &[Word] = &[
    Word { name: "fixed", about: "fixed point, 1/1024 of g dt" },
    Word {
        name: "integer",
        about: "whole multiples of g dt, of half of it with projected gravity, truncated toward zero",
    },
];

pub(super) static CL_CA: &[Key] = &[
    Key::new(
        "spacing",
        Kind::Quantity(&LENGTH),
        "Distance of lattice points; automatic: the smallest grains become hexagons of 7 points",
    )
    .above(0.0)
    .word("automatic"),
    Key::new(
        "fall-height",
        Kind::Quantity(&LENGTH),
        "A grain falls this far in the time of free fall, which sets the time step; automatic: the height of the lattice, that is of `region`, or of walls and grains",
    )
    .above(0.0)
    .word("automatic"),
    Key::new("region", Kind::Table(Region::KEYS), "The piece of the lattice that grains can reach; left out: around walls and grains")
        .optional(),
    Key::new("rule", Kind::OneOf(RULE), "How grains find room").default("'automatic'"),
    Key::new("memory", Kind::Whole, "Steps of the past whose sideways moves choose the side; 1: the last alone")
        .default("1")
        .at_least(1.0)
        .at_most(32.0),
    Key::new("turning", Kind::Flag, "Grains that cannot move turn by 60 degrees where that lets them move on")
        .derived("`contact.rotation` where grains have `shape.cells`, else false"),
    Key::new("gravity-switch", Kind::Table(GRAVITY_SWITCH), "Shaking: gravity points up and down in turn").optional(),
    Key::new(
        "shapes",
        Kind::NamedChoice(SHAPES, "The shape of the grains of a group, by its name"),
        "Shapes of groups for this method alone; without one, and without `shape.cells`, a grain is the hexagon whose area is nearest",
    )
    .default("{}"),
];

static RULE: &[Word] = &[
    Word { name: "automatic", about: "passive where a wall or a driven group moves, else active" },
    Word { name: "active", about: "a grain moves if there is room" },
    Word { name: "passive", about: "walls and driven grains push; grains move out of overlaps" },
];

static GRAVITY_SWITCH: &[Key] = &[
    Key::new("down", Kind::Whole, "Steps with gravity down").at_least(1.0).at_most(1e6),
    Key::new("up", Kind::Whole, "Steps with gravity up, which come first").at_least(1.0).at_most(1e6),
];

pub(super) static SHAPES: &[Variant] = &[
    Variant {
        name: "hexagon",
        about: "A hexagon: 7, 19, 37, 61 points for radius 1 to 4",
        keys: &[Key::new("radius", Kind::Whole, "Spacings from its centre to a corner").at_least(0.0).at_most(12.0)],
    },
    Variant {
        name: "polygon",
        about: "All lattice points on or inside a closed line along the lattice",
        keys: &[Key::new(
            "corners",
            Kind::Vectors(&NUMBER),
            "Corners one after the other, in whole numbers [column, half spacings up]; their sum is even",
        )],
    },
    Variant {
        name: "points",
        about: "The lattice points of the grain, one by one; they must hang together",
        keys: &[Key::new(
            "at",
            Kind::Vectors(&NUMBER),
            "Points in whole numbers [column, half spacings up]; their sum is even",
        )],
    },
];
