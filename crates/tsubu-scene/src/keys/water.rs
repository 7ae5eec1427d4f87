//! The water that grains are in.

use super::{Key, Kind, Variant, Word};
use crate::units::{AREA as AREA_UNIT, AREA_RATE, DENSITY, LENGTH, NUMBER, SPEED, TIME};

pub(super) static WATER: &[Key] = &[
    Key::new("density", Kind::Quantity(&DENSITY), "Density of the water, or of any other liquid or gas")
        .default("'1000 kg/m^3'")
        .above(0.0),
    Key::new("viscosity", Kind::Quantity(&AREA_RATE), "Kinematic viscosity")
        .default("'1e-6 m^2/s'")
        .above(0.0)
        .may_change(),
    Key::new("surface", Kind::Quantity(&LENGTH), "Height z up to which there is water")
        .derived("zero-level + depth of a log-law with `depth`, `top` of `coupled` and `column`; otherwise there is water everywhere"),
    Key::new(
        "added-mass",
        Kind::Quantity(&NUMBER),
        "Water that moves along with a grain, as a share of what the grain displaces; 0.5 for a sphere, 0 for none",
    )
    .default("0.5")
    .at_least(0.0),
    Key::new("buoyancy", Kind::OneOf(BUOYANCY), "Which part of the stress in the water carries the grains")
        .default("'vertical'"),
    Key::new("float", Kind::Flag, "Grains may be lighter than the water").default("false"),
    Key::new("flow", Kind::Choice(FLOW), "How the water moves").default("{ still = {} }").may_change(),
    Key::new(
        "hindrance",
        Kind::Choice(HINDRANCE),
        "What neighbours add to the drag, by the share e that grains leave to the water in layers",
    )
    .default("{ none = {} }")
    .may_change(),
    Key::new("drag", Kind::Choice(DRAG), "Resistance to motion through the water, by the drag coefficient")
        .default("{ stokes-newton = {} }")
        .may_change(),
    Key::new("torque", Kind::Choice(TORQUE), "Resistance to spin; grains must spin, `contact.rotation`")
        .default("{ none = {} }"),
    Key::new("lift", Kind::SomeOf(LIFT), "Forces across the motion relative to the water").default("[]").may_change(),
    Key::new(
        "fluctuation",
        Kind::Table(FLUCTUATION),
        "Turbulence of a log-law or coupled stream as grains on their way see it: a velocity that wanders, drawn for each grain",
    )
    .optional(),
];

static FLUCTUATION: &[Key] = &[
    Key::new(
        "strength",
        Kind::Quantity(&NUMBER),
        "Root-mean-square velocity over U*, mean of the squares of the three directions; 1.78 at a rough bed",
    )
    .default("1")
    .above(0.0)
    .may_change(),
    Key::new("directions", Kind::OneOf(DIRECTIONS), "What each direction has of it").default("'even'"),
    Key::new("time", Kind::Quantity(&TIME), "Lagrangian time: how long the water around a grain keeps its velocity")
        .above(0.0)
        .derived("depth/(15 S^2 U*) below a surface, S the strength upwards: the diffusivity of a stream, 0.067 U* depth in the mean over the depth; of a coupled stream, whose strength falls towards the surface, twice that, from `bottom` to `top` at time 0, U* what drives it"),
];

static DIRECTIONS: &[Word] = &[
    Word { name: "even", about: "the same along, across and up" },
    Word {
        name: "stream",
        about: "as over a rough bed, 2.30 : 1.63 : 1.27 along, across and up (Nezu and Nakagawa 1993): `strength` times 1.29, 0.91, 0.71",
    },
];

static BUOYANCY: &[Word] = &[
    Word {
        name: "vertical",
        about: "pressure and shear stress of a uniform stream: upwards against gravity, - rho V g",
    },
    Word { name: "normal", about: "pressure alone: normal to a stream along x, nothing along it" },
];

static FLOW: &[Variant] = &[
    Variant { name: "still", about: "Water at rest", keys: &[] },
    Variant {
        name: "log-law",
        about: "A stream along x over a rough bed, by the logarithmic law",
        keys: &[
            Key::new("shear-velocity", Kind::Quantity(&SPEED), "Shear velocity U*")
                .above(0.0)
                .derived("from `discharge`, or from `depth` and the slope: sqrt(g sin(slope) depth)")
                .rivals(&["discharge"]),
            Key::new("discharge", Kind::Quantity(&AREA_RATE), "Discharge of water per width, from which U* follows")
                .above(0.0)
                .optional()
                .rivals(&["shear-velocity"]),
            Key::new("depth", Kind::Quantity(&LENGTH), "Depth of the stream above the zero level")
                .above(0.0)
                .optional(),
            Key::new("roughness", Kind::Quantity(&LENGTH), "Equivalent roughness k of the bed")
                .above(0.0)
                .derived("the mean diameter of the grains"),
            Key::new(
                "zero-level",
                Kind::Quantity(&LENGTH),
                "Height z where Z = 0: a quarter of a diameter below the crests of the bed",
            )
            .default("0"),
        ],
    },
    Variant {
        name: "table",
        about: "A stream along x by straight lines between given points, constant outside",
        keys: &[
            Key::new("height", Kind::Quantities(&LENGTH), "Heights z, rising"),
            Key::new("velocity", Kind::Quantities(&SPEED), "Velocities along x, as many"),
        ],
    },
    Variant {
        name: "coupled",
        about: "A stream along x in layers, driven by the slope, slowed by its turbulent and viscous stress and by the grains: what they gain it loses",
        keys: &[
            BOTTOM,
            TOP,
            LAYERS,
            AREA,
            Key::new("roughness", Kind::Quantity(&LENGTH), "Equivalent roughness k of the bottom")
                .above(0.0)
                .derived("the mean diameter of the grains"),
            Key::new(
                "shear-velocity",
                Kind::Quantity(&SPEED),
                "Shear velocity that the drive would hold without grains; without it the slope drives",
            )
            .above(0.0)
            .optional()
            .rivals(&["discharge"]),
            Key::new(
                "discharge",
                Kind::Quantity(&AREA_RATE),
                "Discharge of water per width: held below a rigid lid; with a free surface what comes in, and the slope drives",
            )
            .above(0.0)
            .optional()
            .rivals(&["shear-velocity"]),
            Key::new("lid", Kind::OneOf(LID), "What ends the stream above").default("'rigid'"),
            Key::new(
                "reach",
                Kind::Quantity(&LENGTH),
                "With a free surface and a `discharge`: length of the reach that it feeds, and that keeps what does not flow out",
            )
            .above(0.0)
            .derived("the length of the periodic world along x"),
            Key::new("start", Kind::OneOf(START), "The stream at time 0").default("'log-law'"),
        ],
    },
    Variant {
        name: "column",
        about: "Water that rises evenly through a column of grains",
        keys: &[
            BOTTOM,
            TOP,
            LAYERS,
            AREA,
            Key::new("velocity", Kind::Quantity(&SPEED), "Superficial velocity upwards: discharge over plan area"),
        ],
    },
];

static BOTTOM: Key = Key::new("bottom", Kind::Quantity(&LENGTH), "Height z where the water begins");

static TOP: Key = Key::new("top", Kind::Quantity(&LENGTH), "Height z where it ends");

static LAYERS: Key = Key::new("layers", Kind::Whole, "Number of layers")
    .at_least(2.0)
    .at_most(1e5)
    .derived("of a stream two for each mean diameter of the grains, of a column one for three diameters");

static AREA: Key =
    Key::new("area", Kind::Quantity(&AREA_UNIT), "Plan area of a layer, from which the share of the grains follows")
        .above(0.0)
        .derived("of the periodic world; in the plane its length times the mean diameter of the grains");

static LID: &[Word] = &[
    Word { name: "rigid", about: "a lid at `top` that stays there" },
    Word { name: "free", about: "a surface, at `top` at time 0, that rises and falls: the volume of water is kept" },
];

static START: &[Word] = &[
    Word { name: "log-law", about: "as the drive would have it without grains" },
    Word { name: "still", about: "at rest" },
];

static COEFFICIENT: Key =
    Key::new("coefficient", Kind::Quantity(&NUMBER), "Coefficient of large grains").default("0.4").at_least(0.0);

static HINDRANCE: &[Variant] = &[
    Variant { name: "none", about: "A grain alone", keys: &[] },
    Variant {
        name: "di-felice",
        about: "More drag in a crowd, by a power that depends on Re (Di Felice 1994)",
        keys: &[],
    },
    Variant {
        name: "richardson-zaki",
        about: "More drag in a crowd, by one power (Richardson and Zaki 1954)",
        keys: &[Key::new("exponent", Kind::Quantity(&NUMBER), "The exponent").default("3.1").at_least(0.0)],
    },
];

static DRAG: &[Variant] = &[
    Variant { name: "none", about: "No drag", keys: &[] },
    Variant { name: "constant", about: "One coefficient, as of large grains", keys: &[COEFFICIENT] },
    Variant {
        name: "stokes-newton",
        about: "Stokes's drag and that of large grains, added (Osada 2004)",
        keys: &[COEFFICIENT],
    },
    Variant { name: "schiller-naumann", about: "The measured drag of a sphere (Schiller and Naumann 1935)", keys: &[] },
    Variant {
        name: "gidaspow",
        about: "In a crowd: Ergun (1952) where grains leave less than 0.8 to the water, Wen and Yu (1966) above (Gidaspow 1994)",
        keys: &[],
    },
    Variant { name: "abraham", about: "One formula for all Re (Dalla Valle 1948; Abraham 1970)", keys: &[] },
    Variant {
        name: "haider-levenspiel",
        about: "The measured drag of bodies by their sphericity, spheres included (Haider and Levenspiel 1989)",
        keys: &[],
    },
];

static TORQUE: &[Variant] = &[
    Variant { name: "none", about: "No torque: only contacts change the spin (Osada et al. 2004)", keys: &[] },
    Variant { name: "stokes", about: "The torque of slow spin (Stokes 1845)", keys: &[] },
    Variant {
        name: "finite-reynolds",
        about: "The same, and that of a boundary layer where the spin is fast (Dennis, Singh and Ingham 1980)",
        keys: &[],
    },
];

static LIFT: &[Word] = &[
    Word { name: "saffman", about: "by shear, in slow flow (Saffman 1965)" },
    Word { name: "saffman-mei", about: "by shear, up to Re of 100 and more (Mei 1992); in place of `saffman`" },
    Word {
        name: "magnus",
        about: "by spin, in slow flow (Rubinow and Keller 1961); grains must spin, `contact.rotation`",
    },
    Word {
        name: "magnus-oesterle-dinh",
        about: "by spin, up to Re of 140 and more (Oesterle and Dinh 1998); in place of `magnus`",
    },
];
