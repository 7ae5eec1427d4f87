//! Groups of grains: what they are, how large, where they begin, who moves them.

use super::{Family, Key, Kind, Variant, Word, methods, signals};
use crate::plan::Region;
use crate::units::{LENGTH, MASS, NUMBER, RATE, SPEED, SPIN, TIME};

pub(crate) static PARTICLES: &[Key] = &[
    Key::new("material", Kind::Name(Family::Material), "Name of the material"),
    Key::new("count", Kind::Whole, "Number of grains; 0 leaves the box empty")
        .at_least(0.0)
        .at_most(1e8)
        .derived("with `start.at` and `start.file` the number of positions, otherwise required"),
    Key::new("diameter", Kind::Quantity(&LENGTH), "Diameter")
        .above(0.0)
        .derived("the mean of `size` or of the diameters in the file, or that of the circle that holds `shape.cells`, otherwise required"),
    Key::new("mass", Kind::Quantity(&MASS), "Mass of a grain of that diameter; others scale with their volume")
        .above(0.0)
        .derived("sphere or disc of the material's density"),
    Key::new("shape", Kind::Choice(SHAPE), "What a grain is").default("{ sphere = {} }"),
    Key::new("size", Kind::Choice(SIZE), "How the diameters are distributed").default("{ equal = {} }"),
    Key::new("start", Kind::Choice(START), "Where the grains begin").default("{ settled = {} }"),
    Key::new("motion", Kind::Choice(MOTION), "Who moves the grains").default("{ free = {} }"),
];

static SHAPE: &[Variant] = &[
    Variant { name: "sphere", about: "Mass pi/6 rho d^3, moment of inertia 2/5 m r^2", keys: &[] },
    Variant {
        name: "disc",
        about: "Mass pi/4 rho d^2 h, moment of inertia 1/2 m r^2; only in the plane",
        keys: &[Key::new("thickness", Kind::Quantity(&LENGTH), "Thickness h along y").above(0.0)],
    },
    Variant {
        name: "clump",
        about: "Spheres that are one body, scaled so that it just fits a sphere of the grain's `diameter` about its centre of mass; what overlaps counts once",
        keys: &[
            Key::new("centre", Kind::Vectors(&NUMBER), "Centres of the spheres, in any unit"),
            Key::new("diameter", Kind::Quantities(&NUMBER), "Their diameters in the same unit, one for each centre")
                .above(0.0),
            TURNED,
        ],
    },
    Variant {
        name: "clump-file",
        about: "The same, its spheres from a file of CLUMP, YADE, LAMMPS, LIGGGHTS or MercuryDPM; one that lies within another is left out",
        keys: &[
            Key::new(
                "path",
                Kind::Text,
                "Rows x y z r between blanks or commas, with a header or the line `#format` of YADE, or a molecule of LAMMPS, told apart by how they begin; from the folder of the scene file",
            ),
            FINGERPRINT,
            TURNED,
        ],
    },
    Variant {
        name: "clump-mesh",
        about: "Spheres within a closed mesh, with the mass and moments of inertia of what it encloses; the mesh just fits a sphere of the grain's `diameter` about its centre of mass; only in space",
        keys: &[
            Key::new(
                "path",
                Kind::Text,
                "An STL (`.stl`) or OBJ (`.obj`) file in any unit, from the folder of the scene file",
            ),
            FINGERPRINT,
            Key::new(
                "spheres",
                Kind::Whole,
                "How many spheres at most; `tsubu check` says how well they stand for the mesh",
            )
            .default("60")
            .at_least(1.0)
            .at_most(1000.0),
            TURNED,
        ],
    },
    Variant {
        name: "superellipsoid",
        about: "(|x/a|^r + |y/b|^r)^(p/r) + |z/c|^p = 1, scaled so that it just fits a sphere of the grain's `diameter`; in the plane as deep as its shorter semi-axis. A contact is that of two spheres as round as the bodies are there, sqrt(R1 R2) of both radii of curvature, at most ten times half the `diameter` where a place is flat; the place of contact of two flat faces is not unique",
        keys: &[
            Key::new("semi-axes", Kind::Vector(&NUMBER), "Semi-axes a, b and c, in any unit; in the plane a and c"),
            Key::new(
                "exponents",
                Kind::Quantities(&NUMBER),
                "Exponents p of the profile and r of the equator; [2, 2] is an ellipsoid, [8, 2] nearly a cylinder about z, [8, 8] nearly a box",
            )
            .default("[2, 2]")
            .at_least(2.0)
            .at_most(8.0),
            TURNED,
        ],
    },
    Variant {
        name: "polyhedron",
        about: "A convex body with rounded edges, scaled so that it just fits a sphere of the grain's `diameter` about its centre of mass; only in space. Bodies touch where a corner of one comes near the other and where two edges cross, each a contact of two spheres of the rounding radii",
        keys: &[
            Key::new("corners", Kind::Vectors(&NUMBER), "Corners before edges are rounded, in any unit and any order"),
            ROUNDING,
            TURNED,
        ],
    },
    Variant {
        name: "polyhedron-mesh",
        about: "The same, its faces from a closed convex mesh",
        keys: &[
            Key::new(
                "path",
                Kind::Text,
                "An STL (`.stl`) or OBJ (`.obj`) file in any unit, from the folder of the scene file",
            ),
            FINGERPRINT,
            ROUNDING,
            TURNED,
        ],
    },
    Variant {
        name: "polygon",
        about: "A convex polygon with rounded corners, scaled so that it just fits a circle of the grain's `diameter` about its centre of mass; only in the plane",
        keys: &[
            Key::new("corners", Kind::Vectors(&NUMBER), "Corners one after the other, in any unit"),
            ROUNDING,
            Key::new("thickness", Kind::Quantity(&LENGTH), "Thickness along y").above(0.0),
            TURNED,
        ],
    },
    Variant {
        name: "cells",
        about: "Cells of a triangular lattice that are one body, with their mass and moment of inertia; only in the plane. CL-CA moves the cells; DEM takes their outline, as a polygon with rounded corners where it has no bays, otherwise as discs of the cells at its rim",
        keys: &[
            Key::new("outline", Kind::Choice(methods::SHAPES), "Which cells"),
            Key::new("spacing", Kind::Quantity(&LENGTH), "Distance of the middles of neighbouring cells").above(0.0),
            Key::new(
                "rounding",
                Kind::Quantity(&NUMBER),
                "Radius of the rounded corners of the polygon, in spacings; sides stay where they are. Discs do not read it",
            )
            .default("0.3")
            .above(0.0),
            Key::new("thickness", Kind::Quantity(&LENGTH), "Thickness along y").above(0.0),
            Key::new(
                "orientation",
                Kind::OneOf(ORIENTATION),
                "How each grain is turned at first; by CL-CA to one of six directions",
            )
            .default("'random'"),
        ],
    },
];

const ROUNDING: Key = Key::new(
    "rounding",
    Kind::Quantity(&NUMBER),
    "Radius of the rounded edges in the same unit: faces stay where they are, edges and corners are as if a ball had been rolled inside",
)
.above(0.0);

const TURNED: Key =
    Key::new("orientation", Kind::OneOf(ORIENTATION), "How each grain is turned at first").default("'random'");

const FINGERPRINT: Key =
    Key::new("fingerprint", Kind::Text, "CRC-32 of the file in hex, to tell that it is still the same file")
        .derived("from the file");

static ORIENTATION: &[Word] = &[
    Word { name: "random", about: "any orientation as likely as another; in the plane any angle" },
    Word { name: "as-drawn", about: "as the centres, corners or the file say, or a, b and c along x, y and z" },
];

const CUT: Key = Key::new("cut", Kind::Quantity(&NUMBER), "Where the tails are cut on both sides, in deviations")
    .default("3")
    .above(0.0);

static SIZE: &[Variant] = &[
    Variant { name: "equal", about: "All have the group's `diameter`", keys: &[] },
    Variant {
        name: "uniform",
        about: "Every diameter between two is as likely",
        keys: &[
            Key::new("smallest", Kind::Quantity(&LENGTH), "Smallest diameter").above(0.0),
            Key::new("largest", Kind::Quantity(&LENGTH), "Largest diameter").above(0.0),
        ],
    },
    Variant {
        name: "normal",
        about: "Normal distribution of diameters, its tails cut",
        keys: &[
            Key::new("mean", Kind::Quantity(&LENGTH), "Mean diameter").above(0.0),
            Key::new("deviation", Kind::Quantity(&LENGTH), "Standard deviation").above(0.0),
            CUT,
        ],
    },
    Variant {
        name: "log-normal",
        about: "ln d is normal around ln(median), its tails cut",
        keys: &[
            Key::new("median", Kind::Quantity(&LENGTH), "Median diameter").above(0.0),
            Key::new("deviation", Kind::Quantity(&NUMBER), "Standard deviation of ln d").above(0.0).at_most(3.0),
            CUT,
        ],
    },
    Variant {
        name: "sieve",
        about: "A sieve curve, straight between sieves",
        keys: &[
            Key::new("diameter", Kind::Quantities(&LENGTH), "Sieve openings, rising").above(0.0),
            Key::new("passing", Kind::Quantities(&NUMBER), "Share of the mass that passes, rising from 0 to 1")
                .at_least(0.0)
                .at_most(1.0),
        ],
    },
];

const VELOCITY: Key = Key::new("velocity", Kind::Vector(&SPEED), "Velocity of all").default("[0, 0, 0]");
const SPEED_ADDED: Key = Key::new("speed", Kind::Quantity(&SPEED), "Speed of each grain in a random direction, added")
    .default("0")
    .at_least(0.0);

static START: &[Variant] = &[
    Variant {
        name: "settled",
        about: "Dropped into the box in loose random rows and left to come to rest before time 0",
        keys: &[Key::new(
            "time",
            Kind::Quantity(&TIME),
            "Longest settling time, gone through in pieces of 10 ms; a bed that still moves then ends the run. Without settling: `rows`",
        )
        .default("'1 s'")
        .above(0.0)],
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
            Key::new("region", Kind::Table(Region::ROUND_KEYS), "Where, instead of the inside of the box").optional(),
        ],
    },
    Variant {
        name: "random",
        about: "Anywhere in a region, without overlap",
        keys: &[
            Key::new(
                "region",
                Kind::Table(Region::ROUND_KEYS),
                "Where, instead of the inside of the box; grains lie wholly in it",
            )
            .optional(),
            VELOCITY,
            SPEED_ADDED,
        ],
    },
    Variant {
        name: "stream",
        about: "Not there at first: put into a region one after the other, where there is room",
        keys: &[
            Key::new("region", Kind::Table(Region::ROUND_KEYS), "Where; grains lie wholly in it").may_change(),
            Key::new("rate", Kind::Quantity(&RATE), "Grains per second").above(0.0).may_change(),
            VELOCITY.may_change(),
            SPEED_ADDED.may_change(),
            Key::new("from", Kind::Quantity(&TIME), "When the first comes").default("0").at_least(0.0).may_change(),
        ],
    },
    Variant {
        name: "file",
        about: "Places, and where the file has them diameters, velocities and spins, from a file",
        keys: &[
            Key::new(
                "path",
                Kind::Text,
                "A CSV (`.csv`), extended XYZ (`.xyz`), LAMMPS data (`.data`), LAMMPS dump (`.lammpstrj`, its last snapshot) or VTK PolyData (`.vtp`: a frame of a run) file, from the folder of the scene file",
            ),
            Key::new(
                "kind",
                Kind::Whole,
                "Which atom type of a LAMMPS file, or group of a `.vtp` from 1; left out: all of them",
            )
            .optional()
            .at_least(1.0)
            .at_most(1e9),
            FINGERPRINT,
        ],
    },
    Variant {
        name: "at",
        about: "Given places",
        keys: &[
            Key::new("position", Kind::Vectors(&LENGTH), "Centres"),
            Key::new("velocity", Kind::Vectors(&SPEED), "Velocities, one for each position; empty: at rest")
                .default("[]"),
            Key::new(
                "spin",
                Kind::Turnings(&SPIN),
                "Spins, one for each position (in the plane a number, about y); empty: none",
            )
            .default("[]"),
        ],
    },
];

static MOTION: &[Variant] = &[
    Variant { name: "free", about: "Forces do", keys: &[] },
    Variant {
        name: "frozen",
        about: "Nobody: they stay where they are, of infinite mass to others; velocities in a file are passed over",
        keys: &[],
    },
    Variant {
        name: "driven",
        about: "A displacement from their places given in advance; they do not spin, of infinite mass to others; velocities in a file are passed over",
        keys: &[
            Key::new("direction", Kind::Direction, "Direction of the motion").default("'z'"),
            Key::new("signal", Kind::Choice(&signals::DISPLACEMENT), "Displacement against time"),
        ],
    },
];
