//! Vibrating structures.

use super::signals::{DISPLACEMENT, LOAD};
use super::study::KEEP;
use super::{Key, Kind, Variant, Word};
use crate::units::{
    ANGLE, CUBIC_STIFFNESS, DAMPING, DENSITY, FREQUENCY, INERTIA, LENGTH, MASS, NUMBER, PRESSURE, RATE, SPEED, SPIN,
    STIFFNESS, TIME, TURN_DAMPING, TURN_PER_LENGTH,
};

pub(super) static HOST: &[Key] = &[
    Key::new("structure", Kind::Choice(STRUCTURE), "Its matrices"),
    Key::new("direction", Kind::Direction, "Direction of its motion").default("'z'"),
    Key::new(
        "interface",
        Kind::Named(INTERFACE, "A point of the structure that walls hang on, with its motion in six directions"),
        "Points of the structure that walls hang on",
    )
    .default("{}"),
    Key::new("at", Kind::Text, "The interface whose displacement along `direction` is told, and where `force` acts")
        .derived("the only interface"),
    Key::new(
        "copies",
        Kind::Quantity(&NUMBER),
        "How many cavities like those of the scene it carries: the scene simulates one, or a periodic slice of a large one, and its share of the structure; \
masses, forces and energies that are told are those of that share",
    )
    .default("1")
    .at_least(1.0),
    Key::new("base", Kind::Choice(&DISPLACEMENT), "Displacement of the base against time").optional().may_change(),
    Key::new("force", Kind::Choice(&LOAD), "Applied force against time").optional().may_change(),
    Key::new("dwell", Kind::Table(DWELL), "Sine dwell: the frequency of the sine that drives it follows its resonance")
        .optional(),
    Key::new("displacement", Kind::Quantity(&LENGTH), "Displacement of every coordinate at time 0").default("0"),
    Key::new("velocity", Kind::Quantity(&SPEED), "Velocity of every coordinate at time 0").default("0"),
];

static DWELL: &[Key] = &[
    Key::new(
        "lag",
        Kind::Quantity(&ANGLE),
        "How far the answer, against the base, lags behind the drive: at a quarter of a turn is the undamped resonance",
    )
    .default("'90 deg'")
    .above(0.0)
    .below(std::f64::consts::PI),
    Key::new(
        "gain",
        Kind::Quantity(&NUMBER),
        "Relative change of the frequency a period, for each radian that the lag is off",
    )
    .above(0.0)
    .at_most(1.0)
    .derived("pi/2 times the square of the structure's damping ratio, of 0.002 at least"),
    Key::new("keep", Kind::OneOf(KEEP), "What of the base motion stays the same at all frequencies")
        .derived("what its sine is given by: `amplitude`, `velocity` or `acceleration`"),
];

static INTERFACE: &[Key] = &[
    Key::new("point", Kind::Vector(&LENGTH), "Where it is as drawn").derived("from `along` on a beam"),
    Key::new("along", Kind::Quantity(&LENGTH), "Distance from the root of a beam").at_least(0.0).optional(),
    Key::new("node", Kind::Whole, "Number of its node in files of matrices").at_least(1.0).at_most(1e9).optional(),
    Key::new(
        "translation",
        Kind::Vectors(&NUMBER),
        "Its displacement [x, y, z] for a unit of each coordinate: mode shapes, or rows of ones and zeros",
    )
    .derived("from the beam, the table of modes, or the node"),
    Key::new(
        "rotation",
        Kind::Turnings(&TURN_PER_LENGTH),
        "Its rotation for a unit of each coordinate: in the plane a number (about y), in space a vector",
    )
    .derived("from the beam, the table of modes, or the node; otherwise it does not turn"),
];

static STRUCTURE: &[Variant] = &[
    Variant {
        name: "shaker",
        about: "No structure: its walls move as `base` says, whatever grains do to them; what it takes to move them is told",
        keys: &[],
    },
    Variant {
        name: "oscillator",
        about: "One degree of freedom",
        keys: &[
            Key::new("mass", Kind::Quantity(&MASS), "M, without the grains").above(0.0),
            Key::new("stiffness", Kind::Quantity(&STIFFNESS), "K").above(0.0),
            Key::new(
                "cubic-stiffness",
                Kind::Quantity(&CUBIC_STIFFNESS),
                "k3 of the spring force K s + k3 s^3: a spring that hardens (Duffing 1918)",
            )
            .at_least(0.0)
            .default("0"),
            Key::new("damping", Kind::Quantity(&DAMPING), "C")
                .at_least(0.0)
                .derived("from `damping-ratio`; one of the two is required")
                .rivals(&["damping-ratio"]),
            Key::new("damping-ratio", Kind::Quantity(&NUMBER), "C over its critical value 2 sqrt(K M)")
                .at_least(0.0)
                .optional()
                .rivals(&["damping"]),
        ],
    },
    Variant {
        name: "matrices",
        about: "n degrees of freedom by their matrices",
        keys: &[
            Key::new("mass", Kind::Matrix(&MASS), "M, symmetric and positive definite"),
            Key::new("damping", Kind::Matrix(&DAMPING), "C, symmetric")
                .derived("from `rayleigh`; one of the two is required")
                .rivals(&["rayleigh"]),
            Key::new("rayleigh", Kind::Table(RAYLEIGH), "C = alpha M + beta K, in place of `damping`")
                .optional()
                .rivals(&["damping"]),
            Key::new("stiffness", Kind::Matrix(&STIFFNESS), "K, symmetric and positive definite"),
            Key::new(
                "gyroscopic",
                Kind::Matrix(&MASS),
                "G of a rotor, skew: the force -speed G q' that its spin puts on coordinates that tilt it",
            )
            .optional(),
            Key::new("speed", Kind::Quantity(&SPIN), "Spin of the rotor about its shaft; needs `gyroscopic`")
                .default("0"),
            Key::new(
                "coordinate",
                Kind::Whole,
                "Index (from 0) of the coordinate that carries the walls and takes the force",
            )
            .default("0")
            .at_least(0.0)
            .at_most(1e4),
            Key::new("participation", Kind::Quantities(&NUMBER), "How the motion of the base drives each coordinate")
                .derived("1 each"),
        ],
    },
    Variant {
        name: "modes",
        about: "n degrees of freedom by a list of modes",
        keys: &[Key::new("mode", Kind::Many(MODE), "The modes")],
    },
    Variant {
        name: "modal-table",
        about: "n degrees of freedom by a table of modes, as programs for finite elements give them",
        keys: &[Key::new(
            "file",
            Kind::Text,
            "CSV file beside the scene with a line for each mode: `frequency [Hz]`, `damping ratio`, `mass [kg]` (1 without that column), \
`participation` (0), and for each interface NAME the columns `NAME x`, `NAME y`, `NAME z`, `NAME rx`, `NAME ry`, `NAME rz`",
        )],
    },
    Variant {
        name: "matrix-files",
        about: "n degrees of freedom by matrices in files: Matrix Market, Nastran (DMIG), Abaqus, or CalculiX",
        keys: &[
            Key::new("mass", Kind::Text, "File of M beside the scene, symmetric and positive definite"),
            Key::new("stiffness", Kind::Text, "File of K, symmetric and positive definite; it may be that of M"),
            Key::new("units", Kind::OneOf(UNITS), "Units that the files are in, which tell none themselves"),
            Key::new("damping", Kind::Text, "File of C, symmetric: all coordinates are kept").optional().rivals(&[
                "damping-ratio",
                "rayleigh",
                "modes",
            ]),
            Key::new(
                "damping-ratio",
                Kind::Quantity(&NUMBER),
                "Damping of each mode over critical damping, in place of `damping`",
            )
            .at_least(0.0)
            .optional()
            .rivals(&["damping", "rayleigh"]),
            Key::new(
                "rayleigh",
                Kind::Table(RAYLEIGH),
                "Damping of each mode by alpha M + beta K, in place of `damping`",
            )
            .optional()
            .rivals(&["damping", "damping-ratio"]),
            Key::new("modes", Kind::Whole, "Number of modes that are kept, lowest first; not with `damping`")
                .at_least(1.0)
                .at_most(400.0)
                .derived("10, or as many as there are")
                .rivals(&["damping"]),
            Key::new("nodes", Kind::Text, "File of CalculiX (`.dof`) with node and direction of each coordinate")
                .optional(),
            Key::new(
                "coordinate",
                Kind::Whole,
                "Index (from 0) of the coordinate that is told and takes the force, without an interface",
            )
            .default("0")
            .at_least(0.0)
            .at_most(1e4),
        ],
    },
    Variant {
        name: "beam",
        about: "A beam clamped at its root, which bends along the host's direction (Euler and Bernoulli)",
        keys: &[
            Key::new("length", Kind::Quantity(&LENGTH), "Free length").above(0.0),
            Key::new("section", Kind::Choice(SECTION), "Its cross section"),
            Key::new("young-modulus", Kind::Quantity(&PRESSURE), "Young's modulus").above(0.0),
            Key::new("density", Kind::Quantity(&DENSITY), "Density").above(0.0),
            Key::new("damping-ratio", Kind::Quantity(&NUMBER), "Damping of each mode over critical damping")
                .at_least(0.0),
            Key::new("modes", Kind::Whole, "Number of its modes, lowest first").default("3").at_least(1.0).at_most(8.0),
            Key::new("root", Kind::Vector(&LENGTH), "Where it is clamped").default("'origin'"),
            Key::new("axis", Kind::Direction, "Direction from the root to the tip, across the host's direction")
                .default("'x'"),
        ],
    },
    Variant {
        name: "pendulum",
        about: "A rigid body that swings about an axis, at any angle; its walls are drawn where it begins",
        keys: &[
            Key::new("pivot", Kind::Vector(&LENGTH), "A point on the axis").default("'origin'"),
            Key::new("axis", Kind::Axis, "Direction of the axis").default("'y'"),
            Key::new("mass", Kind::Quantity(&MASS), "Mass of the body, without the grains").above(0.0),
            Key::new("centre", Kind::Quantity(&LENGTH), "Distance of its centre of mass from the axis").at_least(0.0),
            Key::new("inertia", Kind::Quantity(&INERTIA), "Moment of inertia about the axis").above(0.0),
            Key::new("damping", Kind::Quantity(&TURN_DAMPING), "Torque over spin").at_least(0.0).default("0"),
            Key::new(
                "arm",
                Kind::Quantity(&LENGTH),
                "Distance from the axis whose displacement along the arc is told, and where `force` acts",
            )
            .above(0.0),
            Key::new("angle", Kind::Quantity(&ANGLE), "Angle at time 0 from gravity to the line to its centre of mass")
                .default("0"),
        ],
    },
];

static RAYLEIGH: &[Key] = &[
    Key::new(
        "alpha",
        Kind::Quantity(&RATE),
        "Damping over mass: a mode of angular frequency w has the ratio alpha / 2 w + beta w / 2",
    )
    .default("0")
    .at_least(0.0),
    Key::new("beta", Kind::Quantity(&TIME), "Damping over stiffness").default("0").at_least(0.0),
];

static UNITS: &[Word] = &[
    Word { name: "m-kg-s", about: "SI: m, kg, s, N" },
    Word { name: "mm-t-s", about: "mm, tonnes, s, N" },
    Word { name: "in-lbf-s", about: "inches, lbf s^2/in, s, lbf" },
];

static SECTION: &[Variant] = &[
    Variant {
        name: "rectangle",
        about: "A rectangle",
        keys: &[
            Key::new("width", Kind::Quantity(&LENGTH), "Across the host's direction").above(0.0),
            Key::new("height", Kind::Quantity(&LENGTH), "Along the host's direction").above(0.0),
        ],
    },
    Variant {
        name: "round",
        about: "A full circle",
        keys: &[Key::new("diameter", Kind::Quantity(&LENGTH), "Diameter").above(0.0)],
    },
];

static MODE: &[Key] = &[
    Key::new("frequency", Kind::Quantity(&FREQUENCY), "Natural frequency").above(0.0),
    Key::new("damping-ratio", Kind::Quantity(&NUMBER), "Damping over critical damping").at_least(0.0),
    Key::new("mass", Kind::Quantity(&MASS), "Modal mass").above(0.0),
    Key::new("shape", Kind::Quantity(&NUMBER), "Mode shape where the walls are").default("1"),
    Key::new("participation", Kind::Quantity(&NUMBER), "Participation of the base motion").default("1"),
];
