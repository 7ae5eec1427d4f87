//! The top of a scene, and its materials.

use super::{Key, Kind, Word, bonds, contact, gases, grains, hosts, methods, sites, stage, study, walls, watch, water};
use crate::units::{DENSITY, NUMBER, PRESSURE, SPEED, SURFACE_ENERGY, TIME};

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
    .default("'9.8 m/s^2'")
    .may_change(),
    Key::new(
        "slope",
        Kind::Slope,
        "Slope of the x axis, positive downwards, as an angle or in percent: turns a gravity that is given as a number",
    )
    .optional()
    .may_change(),
    Key::new("duration", Kind::Quantity(&TIME), "Simulated time").above(0.0),
    Key::new(
        "speed-scale",
        Kind::Quantity(&SPEED),
        "Typical fastest relative speed, for the time step and the verdict of `check`",
    )
    .above(0.0)
    .word("automatic")
    .may_change(),
    Key::new("materials", Kind::Named(MATERIAL, "A material, referred to by its name"), "The materials").default("{}"),
    Key::new(
        "material-pair",
        Kind::Many(MATERIAL_PAIR),
        "Exceptions for two materials, to the mixing rule (geometric mean) and to the contact law",
    )
    .default("[]"),
    Key::new("particles", Kind::Named(grains::PARTICLES, "A group of grains of one material"), "The grains")
        .default("{}"),
    Key::new(
        "walls",
        Kind::Named(walls::WALL, "A wall: still, moved, pushed, free, or carried by a host"),
        "The walls",
    )
    .default("{}"),
    Key::new("periodic", Kind::Table(walls::PERIODIC), "Axes along which the world repeats itself").default("{}"),
    Key::new(
        "removal",
        Kind::NamedChoice(walls::REMOVAL, "Where grains vanish; a grain may go a little way in before it does"),
        "Regions in which grains vanish",
    )
    .default("{}")
    .may_change(),
    Key::new(
        "hosts",
        Kind::Named(hosts::HOST, "A vibrating structure: M q'' + C (q' - y') + K (q - y) = F"),
        "The vibrating structures",
    )
    .default("{}"),
    Key::new("water", Kind::Table(water::WATER), "The water that the grains are in").optional(),
    Key::new("contact", Kind::Table(contact::CONTACT), "The contact law, a stack of parts").default("{}").may_change(),
    Key::new("bond", Kind::Many(bonds::BOND), "Beams that hold grains together until they break").default("[]"),
    Key::new("dem", Kind::Table(methods::DEM), "What only the discrete element method reads").default("{}"),
    Key::new("lattice", Kind::Table(methods::LATTICE), "What only the lattice automaton reads").default("{}"),
    Key::new("cl-ca", Kind::Table(methods::CL_CA), "What only CL-CA reads: grains made of lattice points")
        .default("{}"),
    Key::new("litwiniszyn", Kind::Table(sites::LITWINISZYN), "What only Litwiniszyn's model of voids reads").default("{}"),
    Key::new("after-caram-hong", Kind::Table(sites::AFTER_CARAM_HONG), "What only the voids after Caram and Hong read")
        .default("{}"),
    Key::new("after-savage", Kind::Table(sites::AFTER_SAVAGE), "What only the chute after Savage reads").default("{}"),
    Key::new("gutt-haff", Kind::Table(sites::GUTT_HAFF), "What only the lattice grains of Gutt and Haff read")
        .default("{}"),
    Key::new(
        "after-hemmingsson-herrmann",
        Kind::Table(sites::AFTER_HEMMINGSSON_HERRMANN),
        "What only the forces in a pile after Hemmingsson and Herrmann read",
    )
    .default("{}"),
    Key::new("fhp", Kind::Table(gases::FHP), "What only the lattice gases FHP read").default("{}"),
    Key::new(
        "after-peng-herrmann",
        Kind::Table(gases::AFTER_PENG_HERRMANN),
        "What only the gas of grains after Peng and Herrmann reads",
    )
    .default("{}"),
    Key::new(
        "after-baxter-behringer",
        Kind::Table(gases::AFTER_BAXTER_BEHRINGER),
        "What only the gas of elongated grains after Baxter and Behringer reads",
    )
    .default("{}"),
    Key::new(
        "after-karolyi-kertesz",
        Kind::Table(gases::AFTER_KAROLYI_KERTESZ),
        "What only the piles after Karolyi and Kertesz read",
    )
    .default("{}"),
    Key::new("response", Kind::Table(study::RESPONSE), "What `tsubu response` reads: a sweep over frequency")
        .optional(),
    Key::new("atlas", Kind::Table(study::ATLAS), "What `tsubu atlas` reads: the grains of a host's walls alone, shaken")
        .optional(),
    Key::new("design", Kind::Table(study::DESIGN), "What `tsubu design` reads: a search for the damper that serves best")
        .optional(),
    Key::new("calibrate", Kind::Table(study::CALIBRATE), "What `tsubu calibrate` reads: which values of keys fit what was measured")
        .optional(),
    Key::new("sweep", Kind::Table(study::SWEEP), "What `tsubu sweep` reads: every combination of values is a run")
        .optional(),
    Key::new(
        "watch",
        Kind::Named(
            watch::WATCH,
            "What is looked at while `tsubu run` (or a case of a sweep or comparison) goes on; exactly one of the tables below `every`",
        ),
        "What is measured on the way",
    )
    .default("{}")
    .may_change(),
    Key::new("output", Kind::Table(study::OUTPUT), "What is written, and how often").default("{}"),
    Key::new(
        "start-from",
        Kind::Text,
        "The folder of another run, from the folder of the scene file: this run goes on from its last checkpoint, with the same grains, \
        contacts and clock; what no stage may change must be as it was there",
    )
    .optional(),
    Key::new(
        "start-fingerprint",
        Kind::Text,
        "CRC-32 of the checkpoint of `start-from` in hex, to tell that the run there has not gone on since",
    )
    .optional(),
    Key::new(
        "start-at-zero",
        Kind::Flag,
        "With `start-from`: the clock begins at 0 and the books are opened anew; motions of walls, drives of hosts and streams begin then, \
        from where things stand",
    )
    .optional(),
    Key::new("stage", Kind::Many(stage::STAGE), "Stages of the run, one after the other, instead of `duration`").default("[]"),
    Key::new("claim", Kind::Many(study::CLAIM), "Results that must lie in a range").default("[]"),
];

static METHOD: &[Word] = &[
    Word { name: "dem", about: "discrete element method" },
    Word { name: "lattice", about: "cellular automaton on the triangular lattice, for balls in a shaken box" },
    Word { name: "cl-ca", about: "grains made of many lattice points that move where there is room" },
    Word { name: "litwiniszyn", about: "voids that walk up from outlets at random, one after the other" },
    Word { name: "after-caram-hong", about: "many voids at once, one to a site, and a surface that slides" },
    Word { name: "after-savage", about: "a square lattice: flow down a chute that sorts by size" },
    Word { name: "gutt-haff", about: "one grain a node, with velocity and offset; contacts are collisions" },
    Word { name: "after-hemmingsson-herrmann", about: "forces handed down through a pile at rest, row by row" },
    Word { name: "fhp", about: "a lattice gas: particles of one speed that flow like a liquid" },
    Word {
        name: "after-peng-herrmann",
        about: "a lattice gas of grains that fall and lose energy: density waves in a pipe",
    },
    Word { name: "after-baxter-behringer", about: "the same with elongated grains that lie along their way" },
    Word {
        name: "after-karolyi-kertesz",
        about: "grains that fall, slide, stop and are knocked loose: piles, avalanches",
    },
];

static MATERIAL: &[Key] = &[
    Key::new("young-modulus", Kind::Quantity(&PRESSURE), "Young's modulus E").above(0.0).may_change(),
    Key::new("poisson-ratio", Kind::Quantity(&NUMBER), "Poisson's ratio")
        .default("0.3")
        .above(-1.0)
        .below(0.5)
        .may_change(),
    Key::new(
        "restitution",
        Kind::Quantity(&NUMBER),
        "Coefficient of restitution against the same material; 1 is elastic",
    )
    .may_change()
    .default("0.9")
    .at_least(1e-6)
    .at_most(1.0),
    Key::new("friction", Kind::Quantity(&NUMBER), "Coulomb friction coefficient against the same material")
        .may_change()
        .default("0.5")
        .at_least(0.0),
    Key::new(
        "rolling-friction",
        Kind::Quantity(&NUMBER),
        "Rolling friction coefficient against the same material; with `contact.rolling.contact-width` the factor f'",
    )
    .may_change()
    .default("0")
    .at_least(0.0),
    Key::new("twisting-friction", Kind::Quantity(&NUMBER), "Twisting friction coefficient against the same material")
        .may_change()
        .default("0")
        .at_least(0.0),
    Key::new(
        "surface-energy",
        Kind::Quantity(&SURFACE_ENERGY),
        "Surface energy gamma of one face, for `contact.cohesion.dmt` and `jkr`",
    )
    .may_change()
    .default("0")
    .at_least(0.0),
    Key::new(
        "cohesion",
        Kind::Cohesion,
        "Attraction to the same material: the force of `contact.cohesion.constant`, the energy density of `sjkr`",
    )
    .may_change()
    .default("0")
    .at_least(0.0),
    Key::new("density", Kind::Quantity(&DENSITY), "Density; needed where a group of grains gives no mass")
        .above(0.0)
        .optional(),
];

static MATERIAL_PAIR: &[Key] = &[
    Key::new("between", Kind::NamePair, "The two materials"),
    Key::new("restitution", Kind::Quantity(&NUMBER), "Coefficient of restitution of the pair")
        .may_change()
        .at_least(1e-6)
        .at_most(1.0)
        .optional(),
    Key::new("friction", Kind::Quantity(&NUMBER), "Friction coefficient of the pair")
        .at_least(0.0)
        .optional()
        .may_change(),
    Key::new("rolling-friction", Kind::Quantity(&NUMBER), "Rolling friction coefficient of the pair")
        .may_change()
        .at_least(0.0)
        .optional(),
    Key::new("twisting-friction", Kind::Quantity(&NUMBER), "Twisting friction coefficient of the pair")
        .may_change()
        .at_least(0.0)
        .optional(),
    Key::new("surface-energy", Kind::Quantity(&SURFACE_ENERGY), "Surface energy gamma of the pair's interface")
        .may_change()
        .at_least(0.0)
        .optional(),
    Key::new("cohesion", Kind::Cohesion, "Attraction of the pair, in the unit of the cohesion part")
        .may_change()
        .at_least(0.0)
        .optional(),
    Key::new(
        "contact",
        Kind::Table(contact::OF_A_PAIR),
        "The pair's own contact law: what is named here takes the place of what `[contact]` says",
    )
    .optional(),
];
