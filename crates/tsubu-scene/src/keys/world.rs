//! The method-neutral part of a scene: materials, grains, walls.

use super::{Family, Key, Kind, Variant, Word, contact, hosts, methods, study};
use crate::units::{DENSITY, LENGTH, MASS, NUMBER, PRESSURE, SPEED, TIME};

/// The keys at the top of a scene, in the order of the plan.
pub static SCENE: &[Key] = &[
    Key::new("title", Kind::Text, "One line for people").default("''"),
    Key::new("method", Kind::OneOf(METHOD), "The method that `tsubu run` uses").default("'dem'"),
    Key::new("dimension", Kind::Whole, "2: the plane (x to the right, z up), 3: space")
        .default("2")
        .at_least(2.0)
        .at_most(3.0),
    Key::new("seed", Kind::Whole, "Seed of every random number of the run").default("1").at_least(0.0),
    Key::new(
        "gravity",
        Kind::Gravity,
        "Gravitational acceleration: a number points down (along -z), a vector where it says",
    )
    .default("'9.8 m/s^2'"),
    Key::new("duration", Kind::Quantity(&TIME), "Simulated time").above(0.0),
    Key::new(
        "speed-scale",
        Kind::Quantity(&SPEED),
        "Typical fastest relative speed, for the time step and the verdict of `check`",
    )
    .above(0.0)
    .word("automatic"),
    Key::new("materials", Kind::Named(MATERIAL, "A material, referred to by its name"), "The materials").default("{}"),
    Key::new(
        "material-pair",
        Kind::Many(MATERIAL_PAIR),
        "Exceptions to the mixing rule (geometric mean) for two materials",
    )
    .default("[]"),
    Key::new("particles", Kind::Named(PARTICLES, "A group of equal spheres"), "The grains").default("{}"),
    Key::new("walls", Kind::Named(WALL, "A wall: still, moved, or carried by a host"), "The walls").default("{}"),
    Key::new(
        "hosts",
        Kind::Named(hosts::HOST, "A vibrating structure: M q'' + C (q' - y') + K (q - y) = F"),
        "The vibrating structures",
    )
    .default("{}"),
    Key::new("contact", Kind::Table(contact::CONTACT), "The contact law, a stack of parts").default("{}"),
    Key::new("dem", Kind::Table(methods::DEM), "What only the discrete element method reads").default("{}"),
    Key::new("lattice", Kind::Table(methods::LATTICE), "What only the lattice automaton reads").default("{}"),
    Key::new("response", Kind::Table(study::RESPONSE), "What `tsubu response` reads: a sweep over frequency")
        .optional(),
    Key::new("sweep", Kind::Table(study::SWEEP), "What `tsubu sweep` reads: every combination of values is a run")
        .optional(),
    Key::new("output", Kind::Table(study::OUTPUT), "What is written, and how often").default("{}"),
    Key::new("claim", Kind::Many(study::CLAIM), "Results that must lie in a range").default("[]"),
];

static METHOD: &[Word] = &[
    Word { name: "dem", about: "discrete element method" },
    Word { name: "lattice", about: "cellular automaton on the triangular lattice" },
];

static MATERIAL: &[Key] = &[
    Key::new("young-modulus", Kind::Quantity(&PRESSURE), "Young's modulus E").above(0.0),
    Key::new("poisson-ratio", Kind::Quantity(&NUMBER), "Poisson's ratio").default("0.3").above(-1.0).below(0.5),
    Key::new(
        "restitution",
        Kind::Quantity(&NUMBER),
        "Coefficient of restitution against the same material; 1 is elastic",
    )
    .default("0.9")
    .above(0.0)
    .at_most(1.0),
    Key::new("friction", Kind::Quantity(&NUMBER), "Coulomb friction coefficient against the same material")
        .default("0.5")
        .at_least(0.0),
    Key::new("rolling-friction", Kind::Quantity(&NUMBER), "Rolling friction coefficient against the same material")
        .default("0")
        .at_least(0.0),
    Key::new("density", Kind::Quantity(&DENSITY), "Density; needed where a group of grains gives no mass")
        .above(0.0)
        .optional(),
];

static MATERIAL_PAIR: &[Key] = &[
    Key::new("between", Kind::NamePair, "The two materials"),
    Key::new("restitution", Kind::Quantity(&NUMBER), "Coefficient of restitution of the pair")
        .above(0.0)
        .at_most(1.0)
        .optional(),
    Key::new("friction", Kind::Quantity(&NUMBER), "Friction coefficient of the pair").at_least(0.0).optional(),
    Key::new("rolling-friction", Kind::Quantity(&NUMBER), "Rolling friction coefficient of the pair")
        .at_least(0.0)
        .optional(),
];

static PARTICLES: &[Key] = &[
    Key::new("material", Kind::Name(Family::Material), "Name of the material"),
    Key::new("count", Kind::Whole, "Number of grains; 0 leaves the box empty")
        .at_least(0.0)
        .at_most(1e8)
        .derived("with `start.at` the number of positions, otherwise required"),
    Key::new("diameter", Kind::Quantity(&LENGTH), "Diameter").above(0.0),
    Key::new("mass", Kind::Quantity(&MASS), "Mass of one grain").above(0.0).derived("sphere of the material's density"),
    Key::new("start", Kind::Choice(START), "Where the grains begin").default("{ settled = {} }"),
];

static START: &[Variant] = &[
    Variant {
        name: "settled",
        about: "Dropped into the box in loose random rows and left to come to rest before time 0",
        keys: &[Key::new("time", Kind::Quantity(&TIME), "Longest settling time").default("'1 s'").at_least(0.0)],
    },
    Variant {
        name: "rows",
        about: "Rows from the floor up",
        keys: &[
            Key::new("spacing", Kind::Quantity(&NUMBER), "Distance of centres over diameter")
                .default("1.05")
                .at_least(1.0),
            Key::new("jitter", Kind::Quantity(&NUMBER), "Random displacement over the free gap")
                .default("0.5")
                .at_least(0.0)
                .at_most(1.0),
            Key::new("speed", Kind::Quantity(&SPEED), "Speed of each grain, in a random direction")
                .default("0")
                .at_least(0.0),
        ],
    },
    Variant {
        name: "at",
        about: "Given places",
        keys: &[
            Key::new("position", Kind::Vectors(&LENGTH), "Centres"),
            Key::new("velocity", Kind::Vectors(&SPEED), "Velocities, one for each position; empty: at rest")
                .default("[]"),
            Key::new("spin", Kind::Spins, "Spins, one for each position (in the plane a number, about y); empty: none")
                .default("[]"),
        ],
    },
];

static WALL: &[Key] = &[
    Key::new("material", Kind::Name(Family::Material), "Name of the material"),
    Key::new("shape", Kind::Choice(SHAPE), "Its geometry"),
    Key::new("host", Kind::Name(Family::Host), "The host that carries it").optional().rivals(&["motion"]),
    Key::new("motion", Kind::Table(MOTION), "Prescribed motion, for example a shaker").optional().rivals(&["host"]),
];

static SHAPE: &[Variant] = &[
    Variant {
        name: "box",
        about: "A closed box with the grains inside; in the plane its front and back panes are frictionless and ignored",
        keys: &[
            Key::new("width", Kind::Quantity(&LENGTH), "Inner size along x").above(0.0),
            Key::new("height", Kind::Quantity(&LENGTH), "Inner size along z").above(0.0),
            Key::new("depth", Kind::Quantity(&LENGTH), "Inner size along y")
                .above(0.0)
                .derived("in the plane the largest diameter, in space required"),
            Key::new("floor-centre", Kind::Vector(&LENGTH), "Centre of the floor").default("'origin'"),
        ],
    },
    Variant {
        name: "plane",
        about: "An endless plane",
        keys: &[
            Key::new("point", Kind::Vector(&LENGTH), "A point on it").default("'origin'"),
            Key::new("normal", Kind::Direction, "Direction towards the grains").default("'z'"),
        ],
    },
];

static MOTION: &[Key] = &[
    Key::new("direction", Kind::Direction, "Direction of the motion").default("'z'"),
    Key::new("signal", Kind::Choice(&hosts::DISPLACEMENT), "Displacement against time"),
];
