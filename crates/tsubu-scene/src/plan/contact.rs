//! Materials and the contact law. What the choices are stands in the table of keys and beside their code: `tsubu explain`.

use serde::{Deserialize, Serialize};

/// Bulk properties of a material.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Material {
    /// Young's modulus E [Pa].
    pub young_modulus: f64,
    /// Poisson's ratio [-].
    pub poisson_ratio: f64,
    /// Coefficient of restitution e against the same material [-], 0 < e <= 1.
    pub restitution: f64,
    /// Coulomb friction coefficient against the same material [-].
    pub friction: f64,
    /// Rolling friction coefficient against the same material [-]; for `contact.rolling.contact-width` the factor f'.
    pub rolling_friction: f64,
    /// Twisting friction coefficient against the same material [-].
    pub twisting_friction: f64,
    /// Surface energy gamma of one face [J/m^2]: two like bodies part at 4 pi gamma R* (DMT), 3 pi gamma R* (JKR).
    pub surface_energy: f64,
    /// Attraction of the constant and of the area kinds of cohesion: force [N] or energy density [Pa], as the part says.
    pub cohesion: f64,
    /// Density [kg/m^3]; needed where a grain group gives no mass.
    pub density: Option<f64>,
}

/// Values for one pair of materials that replace the mixing rule (geometric mean of restitution and friction).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct MaterialPair {
    /// The two material names.
    pub between: [String; 2],
    /// Coefficient of restitution [-].
    pub restitution: Option<f64>,
    /// Friction coefficient [-].
    pub friction: Option<f64>,
    /// Rolling friction coefficient [-].
    pub rolling_friction: Option<f64>,
    /// Twisting friction coefficient [-].
    pub twisting_friction: Option<f64>,
    /// Surface energy gamma of one face [J/m^2].
    pub surface_energy: Option<f64>,
    /// Cohesion, in the unit of the cohesion part.
    pub cohesion: Option<f64>,
    /// The contact law of the pair, where it is another than the scene's; whether grains spin is the same in all.
    pub contact: Option<Contact>,
}

/// The contact law as a stack of parts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Contact {
    /// Elastic normal force.
    pub normal: Normal,
    /// Normal damping; its coefficient is found so that the materials' restitution comes back.
    pub damping: Damping,
    /// Whether damping may make the normal force attractive (Komatsuzaki 2003, literally); otherwise the force is cut at zero.
    pub attraction: bool,
    /// Tangential force.
    pub tangential: Tangential,
    /// Rolling resistance.
    pub rolling: Rolling,
    /// Resistance against turning about the normal.
    pub twisting: Twisting,
    /// Attraction.
    pub cohesion: Cohesion,
    /// Liquid between bodies that are near.
    pub film: Film,
    /// Whether grains spin.
    pub rotation: bool,
}

/// Elastic normal force for overlap d.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Normal {
    /// `contact.normal.hertz`.
    Hertz {},
    /// `contact.normal.hooke`.
    Hooke {
        /// k [N/m].
        stiffness: f64,
    },
}

/// Damping of the normal motion for overlap d and overlap rate d'.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Damping {
    /// `contact.damping.none`.
    None {},
    /// `contact.damping.sqrt`.
    Sqrt {
        /// Impact speed at which the restitution is the materials' [m/s].
        reference_speed: f64,
    },
    /// `contact.damping.quarter`.
    Quarter {},
    /// `contact.damping.linear`.
    Linear {
        /// Impact speed at which the restitution is the materials' [m/s].
        reference_speed: f64,
    },
    /// `contact.damping.rate`.
    Rate {
        /// Damping coefficient over reduced mass [1/s].
        rate: f64,
    },
    /// `contact.damping.dashpot`.
    Dashpot {
        /// c [N.s/m].
        coefficient: f64,
    },
}

/// Tangential force.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Tangential {
    /// `contact.tangential.none`.
    None {},
    /// `contact.tangential.coulomb`.
    Coulomb {
        /// v_eps [m/s].
        smoothing_speed: f64,
    },
    /// `contact.tangential.mindlin`.
    Mindlin {
        /// How force and slip belong together.
        form: MindlinForm,
        /// Tangential over normal dashpot [-]; `None`: equal damping ratios.
        damping: Option<f64>,
    },
    /// `contact.tangential.spring`.
    Spring {
        /// k_t over the stiffness of `contact.normal.hooke` [-].
        ratio: f64,
        /// Tangential over normal dashpot [-].
        damping: f64,
        /// Grain-level cohesion c: the tangential force may reach mu f_n plus this [N].
        cohesion: f64,
    },
}

/// Which reading of Mindlin's no-slip solution is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MindlinForm {
    /// dF = -k_t(d) dx, F scaled down on unloading (Thornton, Cummins, Cleary 2013).
    Incremental,
    /// F = -k_t(d) x, x the whole slip (the form behind the curves of Chung and Ooi 2011).
    Secant,
}

/// Rolling resistance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Rolling {
    /// `contact.rolling.none`.
    None {},
    /// `contact.rolling.constant`.
    Constant {
        /// Rolling speed below which the torque fades [m/s].
        smoothing_speed: f64,
    },
    /// `contact.rolling.viscous`.
    Viscous {
        /// Torque over (mu_r R f_n) at a rolling speed of 1 m/s [s/m].
        coefficient: f64,
    },
    /// `contact.rolling.epsd`.
    Epsd {
        /// 2.25 in space, 3 in the plane [-].
        ratio: f64,
        /// Damping ratio of the rolling spring [-].
        damping_ratio: f64,
    },
    /// `contact.rolling.epsd2`.
    Epsd2 {},
    /// `contact.rolling.spring`.
    Spring {
        /// k [N/m].
        stiffness: f64,
        /// c [N.s/m].
        damping: f64,
    },
    /// `contact.rolling.contact-width`.
    ContactWidth {
        /// Rolling speed below which the torque fades [m/s].
        smoothing_speed: f64,
    },
}

/// Resistance against relative spin about the normal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Twisting {
    /// `contact.twisting.none`.
    None {},
    /// `contact.twisting.sliding`.
    Sliding {
        /// Spin below which the torque fades [rad/s].
        smoothing_spin: f64,
    },
    /// `contact.twisting.spring`.
    Spring {},
}

/// Attraction between bodies in contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Cohesion {
    /// `contact.cohesion.none`.
    None {},
    /// `contact.cohesion.dmt`.
    Dmt {},
    /// `contact.cohesion.jkr`.
    Jkr {},
    /// `contact.cohesion.sjkr`.
    Sjkr {},
    /// `contact.cohesion.constant`.
    Constant {},
}

/// Liquid between bodies that are near.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Film {
    /// `contact.film.none`.
    None {},
    /// `contact.film.lubrication`.
    Lubrication {
        /// Gap at which it grows no more [m].
        roughness: f64,
        /// Gap beyond which it is not counted [m].
        reach: f64,
        /// mu [Pa.s].
        viscosity: f64,
        /// Whether it goes on while the bodies touch.
        in_contact: bool,
    },
}
