//! Walls, and the ends of the world: their shapes, who moves them, where space repeats, where grains vanish.

use super::{Family, Key, Kind, Variant, signals};
use crate::plan::Region;
use crate::units::{AREA, DAMPING, FORCE, INERTIA, LENGTH, MASS, NUMBER, PRESSURE, SPEED, SPIN, TIME};

pub(super) static WALL: &[Key] = &[
    Key::new("material", Kind::Name(Family::Material), "Name of the material"),
    Key::new("shape", Kind::Choice(SHAPE), "Its geometry"),
    Key::new("host", Kind::Name(Family::Host), "The host that carries it")
        .optional()
        .rivals(&["motion", "rotation", "servo", "body", "until"]),
    Key::new(
        "interface",
        Kind::Text,
        "The interface of the host that it hangs on and turns with; none: it moves along the host's direction",
    )
    .optional(),
    Key::new("motion", Kind::Table(MOTION), "Prescribed motion, for example a shaker")
        .may_change()
        .optional()
        .rivals(&["host", "servo", "body"]),
    Key::new(
        "rotation",
        Kind::Table(ROTATION),
        "Prescribed turning about a fixed axis, alone or together with `motion`",
    )
    .may_change()
    .optional()
    .rivals(&["host", "servo", "body"]),
    Key::new("servo", Kind::Table(SERVO), "A mass on a guide that a constant force pushes against the grains")
        .may_change()
        .optional()
        .rivals(&["host", "motion", "rotation", "body", "until"]),
    Key::new("body", Kind::Table(BODY), "A free rigid body under gravity and the grains' forces")
        .optional()
        .rivals(&["host", "motion", "rotation", "servo", "until"]),
    Key::new("until", Kind::Quantity(&TIME), "When it vanishes: a gate; while grains settle before time 0 it is there")
        .may_change()
        .above(0.0)
        .optional()
        .rivals(&["host", "servo", "body"]),
];

const POINT: Key = Key::new("point", Kind::Vector(&LENGTH), "Centre of one end").default("'origin'");
const RADIUS: Key = Key::new("radius", Kind::Quantity(&LENGTH), "Radius").above(0.0);

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
    Variant {
        name: "cylinder",
        about: "The curved surface of a cylinder, open at the ends, touched from inside and outside; in the plane along y: a circle",
        keys: &[
            POINT,
            Key::new("axis", Kind::Axis, "Direction of the axis, from that end into the cylinder").default("'y'"),
            RADIUS,
            Key::new("length", Kind::Quantity(&LENGTH), "Length; left out: endless both ways").above(0.0).optional(),
        ],
    },
    Variant {
        name: "cone",
        about: "The curved surface of a cone or of a piece of one, open at the ends, touched from both sides",
        keys: &[
            POINT,
            Key::new("axis", Kind::Direction, "Direction of the axis, from that end to the other").default("'z'"),
            Key::new("radius", Kind::Quantity(&LENGTH), "Radius at that end").at_least(0.0),
            Key::new("end-radius", Kind::Quantity(&LENGTH), "Radius at the other end").at_least(0.0),
            Key::new("length", Kind::Quantity(&LENGTH), "Length along the axis").above(0.0),
        ],
    },
    Variant {
        name: "sphere",
        about: "A spherical shell, touched from both sides",
        keys: &[Key::new("centre", Kind::Vector(&LENGTH), "Centre").default("'origin'"), RADIUS],
    },
    Variant {
        name: "mesh",
        about: "Triangles from a file, touched from both sides",
        keys: &[
            Key::new("path", Kind::Text, "An STL (`.stl`) or OBJ (`.obj`) file, from the folder of the scene file"),
            Key::new("fingerprint", Kind::Text, "CRC-32 of the file in hex, to tell that it is still the same file")
                .derived("from the file"),
            Key::new("scale", Kind::Quantity(&NUMBER), "Factor on the file's coordinates; 0.001 for millimetres")
                .default("1")
                .above(0.0),
            Key::new("shift", Kind::Vector(&LENGTH), "Displacement after scaling").default("'origin'"),
        ],
    },
];

static MOTION: &[Key] = &[
    Key::new("direction", Kind::Direction, "Direction of the motion").default("'z'"),
    Key::new("signal", Kind::Choice(&signals::DISPLACEMENT), "Displacement against time"),
];

static ROTATION: &[Key] = &[
    Key::new("centre", Kind::Vector(&LENGTH), "A point on the axis").default("'origin'"),
    Key::new("axis", Kind::Axis, "Direction of the axis; the angle is right-handed about it").default("'y'"),
    Key::new("signal", Kind::Choice(&signals::TURN), "Angle against time"),
];

static SERVO: &[Key] = &[
    Key::new("direction", Kind::Direction, "Direction of the force and of the guide"),
    Key::new("force", Kind::Quantity(&FORCE), "Constant force F")
        .derived("`pressure` times `area`; one of the two ways is required")
        .rivals(&["pressure", "area"]),
    Key::new("pressure", Kind::Quantity(&PRESSURE), "Constant pressure, on `area` or on the face of a box of planes")
        .optional()
        .rivals(&["force"]),
    Key::new(
        "area",
        Kind::Quantity(&AREA),
        "Area on which the pressure acts; left out in a box of six planes along the axes: the face that the wall is, as large as it is \
at the time",
    )
    .above(0.0)
    .optional()
    .rivals(&["force"]),
    Key::new("mass", Kind::Quantity(&MASS), "Moving mass M").above(0.0),
    Key::new("damping", Kind::Quantity(&DAMPING), "Damping c of the guide").default("0").at_least(0.0),
];

static BODY: &[Key] = &[
    Key::new("mass", Kind::Quantity(&MASS), "Mass").above(0.0),
    Key::new(
        "inertia",
        Kind::Turning(&INERTIA),
        "Principal moments of inertia, about the scene's axes at time 0: in the plane one number (about y), in space three",
    ),
    Key::new("centre", Kind::Vector(&LENGTH), "Centre of mass at time 0"),
    Key::new("velocity", Kind::Vector(&SPEED), "Velocity of the centre at time 0").default("[0, 0, 0]"),
    Key::new("spin", Kind::Turning(&SPIN), "Spin at time 0: in the plane a number (about y), in space a vector")
        .default("[0, 0, 0]"),
];

pub(super) static PERIODIC: &[Key] = &[
    Key::new("x", Kind::Ends(&LENGTH), "Ends along x, low and high").optional(),
    Key::new("y", Kind::Ends(&LENGTH), "Ends along y; not in the plane").optional(),
    Key::new("z", Kind::Ends(&LENGTH), "Ends along z").optional(),
];

pub(super) static REMOVAL: &[Variant] = &[
    Variant {
        name: "inside",
        about: "Grains whose centres are inside a region of space",
        keys: &[Key::new(
            "region",
            Kind::Table(Region::ROUND_KEYS),
            "The region; it stands still, whatever walls are around it",
        )],
    },
    Variant {
        name: "behind",
        about: "Grains whose centres are behind a plane",
        keys: &[
            Key::new("point", Kind::Vector(&LENGTH), "A point on the plane, which stands still").default("'origin'"),
            Key::new("normal", Kind::Direction, "Direction away from where grains vanish").default("'z'"),
        ],
    },
];
