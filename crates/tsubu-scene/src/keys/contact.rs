//! The contact law: one choice for each part of the stack.

use super::{Key, Kind, Variant, Word};
use crate::units::{DAMPING as DASHPOT, FORCE, LENGTH, NUMBER, RATE, SLOWNESS, SPEED, SPIN, STIFFNESS, VISCOSITY};

pub(super) static CONTACT: &[Key] = &[
    NORMAL_FORCE.default("{ hertz = {} }"),
    NORMAL_DAMPING.default("{ quarter = {} }"),
    ATTRACTION.default("false"),
    TANGENTIAL_FORCE.default("{ mindlin = {} }"),
    ROLLING_RESISTANCE.default("{ none = {} }"),
    TWISTING_RESISTANCE.default("{ none = {} }"),
    COHESIVE_FORCE.default("{ none = {} }"),
    FILM_BETWEEN.default("{ none = {} }"),
    Key::new("rotation", Kind::Flag, "Whether grains spin").default("true"),
];

/// The same for a pair of materials; whether grains spin is no matter of a pair.
pub(super) static OF_A_PAIR: &[Key] = &[
    NORMAL_FORCE.derived(AS_IN_THE_SCENE),
    NORMAL_DAMPING.derived(AS_IN_THE_SCENE),
    ATTRACTION.derived(AS_IN_THE_SCENE),
    TANGENTIAL_FORCE.derived(AS_IN_THE_SCENE),
    ROLLING_RESISTANCE.derived(AS_IN_THE_SCENE),
    TWISTING_RESISTANCE.derived(AS_IN_THE_SCENE),
    COHESIVE_FORCE.derived(AS_IN_THE_SCENE),
    FILM_BETWEEN.derived(AS_IN_THE_SCENE),
];

const AS_IN_THE_SCENE: &str = "as in `[contact]`";

const NORMAL_FORCE: Key = Key::new("normal", Kind::Choice(NORMAL), "Elastic normal force for overlap d");
const NORMAL_DAMPING: Key = Key::new(
    "damping",
    Kind::Choice(DAMPING),
    "Damping of the normal motion; unless a form says otherwise, its coefficient is found from the restitution",
);
const ATTRACTION: Key =
    Key::new("attraction", Kind::Flag, "Let damping make the normal force attractive instead of cutting it at zero");
const TANGENTIAL_FORCE: Key = Key::new("tangential", Kind::Choice(TANGENTIAL), "Tangential force");
const ROLLING_RESISTANCE: Key = Key::new("rolling", Kind::Choice(ROLLING), "Rolling resistance");
const TWISTING_RESISTANCE: Key =
    Key::new("twisting", Kind::Choice(TWISTING), "Resistance against turning about the normal");
const COHESIVE_FORCE: Key = Key::new("cohesion", Kind::Choice(COHESION), "Attraction between bodies in contact");
const FILM_BETWEEN: Key = Key::new("film", Kind::Choice(FILM), "Liquid between bodies that are near, touching or not");

static NORMAL: &[Variant] = &[
    Variant {
        name: "hertz",
        about: "Elastic contact of smooth spheres, or of a sphere and a plane, as stiff as the materials make it (Hertz 1882)",
        keys: &[],
    },
    Variant {
        name: "hooke",
        about: "Linear spring, one stiffness for all contacts; the contact time does not depend on the impact speed",
        keys: &[Key::new("stiffness", Kind::Quantity(&STIFFNESS), "k").above(0.0)],
    },
];

const REFERENCE_SPEED: Key =
    Key::new("reference-speed", Kind::Quantity(&SPEED), "Impact speed at which the restitution is the materials'")
        .default("'1 m/s'")
        .above(0.0);

static DAMPING: &[Variant] = &[
    Variant { name: "none", about: "No damping, whatever the restitution", keys: &[] },
    Variant {
        name: "sqrt",
        about: "Visco-elastic spheres (Kuwabara and Kono 1987): the restitution falls slowly with the impact speed",
        keys: &[REFERENCE_SPEED],
    },
    Variant {
        name: "quarter",
        about: "The same restitution at every impact speed, with Hertz (Tsuji, Tanaka and Ishida 1992)",
        keys: &[],
    },
    Variant {
        name: "linear",
        about: "A dashpot of constant strength: constant restitution with Hooke; with Hertz it is met at the reference speed",
        keys: &[REFERENCE_SPEED],
    },
    Variant {
        name: "rate",
        about: "A dashpot in proportion to the reduced mass, one rate of decay for all sizes, whatever the restitution (`mass_velocity` of other codes)",
        keys: &[Key::new("rate", Kind::Quantity(&RATE), "Damping coefficient over reduced mass").at_least(0.0)],
    },
    Variant {
        name: "dashpot",
        about: "One dashpot for all contacts, whatever the restitution (Osada 2004)",
        keys: &[Key::new("coefficient", Kind::Quantity(&DASHPOT), "c").at_least(0.0)],
    },
];

const SLIDING_FADES: Key =
    Key::new("smoothing-speed", Kind::Quantity(&SPEED), "Sliding speed below which friction fades")
        .default("'1 mm/s'")
        .above(0.0);

static TANGENTIAL: &[Variant] = &[
    Variant { name: "none", about: "No tangential force", keys: &[] },
    Variant {
        name: "coulomb",
        about: "Sliding friction without a spring, fading below a small sliding speed; heaps creep",
        keys: &[SLIDING_FADES],
    },
    Variant {
        name: "mindlin",
        about: "Elastic tangential contact of spheres: a spring with history that slides at the friction limit; with `normal.hertz`",
        keys: &[
            Key::new("form", Kind::OneOf(MINDLIN_FORM), "How force and slip belong together").default("'incremental'"),
            Key::new(
                "damping",
                Kind::Quantity(&NUMBER),
                "Tangential over normal dashpot; automatic: equal damping ratios",
            )
            .at_least(0.0)
            .word("automatic"),
        ],
    },
    Variant {
        name: "spring",
        about: "Linear spring with history and a dashpot that slide at the friction limit, with cohesion between grains (Cundall and Strack 1979; Osada 2004); with `normal.hooke`",
        keys: &[
            Key::new("ratio", Kind::Quantity(&NUMBER), "Tangential over normal stiffness")
                .default("0.2857142857142857")
                .above(0.0),
            Key::new("damping", Kind::Quantity(&NUMBER), "Tangential over normal dashpot").default("0").at_least(0.0),
            Key::new(
                "cohesion",
                Kind::Quantity(&FORCE),
                "Grain-level cohesion: the tangential force may reach mu f_n plus this",
            )
            .default("0")
            .at_least(0.0),
        ],
    },
];

static MINDLIN_FORM: &[Word] = &[
    Word {
        name: "incremental",
        about: "by steps of the slip, scaled down on unloading (Thornton, Cummins, Cleary 2013)",
    },
    Word { name: "secant", about: "by the whole slip since first touch (Chung and Ooi 2011)" },
];

const ROLLING_FADES: Key =
    Key::new("smoothing-speed", Kind::Quantity(&SPEED), "Rolling speed below which the torque fades")
        .default("'1 mm/s'")
        .above(0.0);

static ROLLING: &[Variant] = &[
    Variant { name: "none", about: "No rolling resistance", keys: &[] },
    Variant {
        name: "constant",
        about: "Torque in proportion to the normal force, against the rolling, fading below a small speed (model A of Ai 2011)",
        keys: &[ROLLING_FADES],
    },
    Variant {
        name: "viscous",
        about: "Torque that grows with the rolling speed, without a limit (model B of Ai 2011)",
        keys: &[Key::new(
            "coefficient",
            Kind::Quantity(&SLOWNESS),
            "Torque over (mu_r R f_n) at a rolling speed of 1 m/s",
        )
        .at_least(0.0)],
    },
    Variant {
        name: "epsd",
        about: "Elastic-plastic spring and dashpot on the angle of rolling: holds a grain at rest (model C of Ai 2011)",
        keys: &[
            Key::new("ratio", Kind::Quantity(&NUMBER), "Rolling stiffness over k_n (mu_r R)^2")
                .above(0.0)
                .derived("2.25 in space, 3 in the plane"),
            Key::new("damping-ratio", Kind::Quantity(&NUMBER), "Damping ratio of the rolling spring")
                .default("0.3")
                .at_least(0.0),
        ],
    },
    Variant {
        name: "epsd2",
        about: "The same without a dashpot, as stiff in rolling as the contact is in shear; with a tangential spring",
        keys: &[],
    },
    Variant {
        name: "spring",
        about: "Spring, dashpot and slider on the rolling displacement, a force that acts as a torque alone (Luding 2008)",
        keys: &[
            Key::new("stiffness", Kind::Quantity(&STIFFNESS), "k").above(0.0),
            Key::new("damping", Kind::Quantity(&DASHPOT), "c").default("0").at_least(0.0),
        ],
    },
    Variant {
        name: "contact-width",
        about: "A bump ahead of the contact: the normal force has an arm in proportion to the width of the overlap (Osada 2004)",
        keys: &[ROLLING_FADES],
    },
];

static TWISTING: &[Variant] = &[
    Variant { name: "none", about: "No twisting resistance", keys: &[] },
    Variant {
        name: "sliding",
        about: "Friction of a disc of contact that turns as a whole, fading below a small spin (Marshall 2009)",
        keys: &[Key::new("smoothing-spin", Kind::Quantity(&SPIN), "Relative spin below which the torque fades")
            .default("'1 rad/s'")
            .above(0.0)],
    },
    Variant {
        name: "spring",
        about: "An elastic disc of contact that twists, and turns as a whole where its friction ends (Marshall 2009); with a tangential spring",
        keys: &[],
    },
];

static COHESION: &[Variant] = &[
    Variant { name: "none", about: "No attraction", keys: &[] },
    Variant {
        name: "dmt",
        about: "Adhesion of stiff spheres: Hertz under a constant pull (Derjaguin, Muller, Toporov 1975); with `normal.hertz`",
        keys: &[],
    },
    Variant {
        name: "jkr",
        about: "Adhesion of soft spheres, in place of Hertz: holds on beyond the overlap until pull-off (Johnson, Kendall, Roberts 1971); with `normal.hertz`",
        keys: &[],
    },
    Variant {
        name: "sjkr",
        about: "Attraction by the materials' `cohesion`, an energy density, times the area in which the spheres overlap",
        keys: &[],
    },
    Variant {
        name: "constant",
        about: "One attraction in every contact, whatever the sizes: the materials' `cohesion`, a force",
        keys: &[],
    },
];

static FILM: &[Variant] = &[
    Variant { name: "none", about: "No film", keys: &[] },
    Variant {
        name: "lubrication",
        about: "Liquid that must be pushed out before bodies touch, and drawn in when they part (Reynolds 1886)",
        keys: &[
            Key::new("roughness", Kind::Quantity(&LENGTH), "Gap below which the film gets no stiffer")
                .above(0.0)
                .derived("a thousandth of the smallest diameter"),
            Key::new("reach", Kind::Quantity(&LENGTH), "Gap beyond which the film is not counted")
                .above(0.0)
                .derived("a tenth of the smallest diameter"),
            Key::new("viscosity", Kind::Quantity(&VISCOSITY), "Viscosity mu of the liquid")
                .above(0.0)
                .derived("density times viscosity of `[water]`"),
            Key::new("in-contact", Kind::Flag, "Let the film go on, at the roughness, while the bodies touch")
                .default("false"),
        ],
    },
];
