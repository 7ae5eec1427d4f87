//! Materials and the contact law: one file a family of parts, with what a scene may say of each. Formulas stand beside their
//! code: `tsubu explain`.

mod cohesion;
mod damping;
mod film;
mod normal;
mod rolling;
mod tangential;
mod twisting;

pub use cohesion::{Cohesion, Strength};
pub(crate) use cohesion::{READ_A_DENSITY, READ_A_FORCE};
pub use damping::Damping;
pub use film::Film;
pub use normal::Normal;
pub use rolling::Rolling;
pub use tangential::{MindlinForm, Tangential};
pub use twisting::Twisting;

use crate::key::Word;
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
    /// Whether a normal force that pulls carries friction, mu times its size.
    pub pulled_friction: bool,
    /// Whether grains spin.
    pub rotation: bool,
    /// Arm of the tangential force.
    pub slip_lever: SlipLever,
}

/// Arm at which spin moves the point of contact of a grain of radius R, and the tangential force turns it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SlipLever {
    /// R - d/2, to the middle of the overlap: angular momentum is kept.
    Middle,
    /// R, as in older styles of LAMMPS.
    Radius,
}

pub(crate) static SLIP_LEVER: &[Word] = &[
    Word { name: "middle", about: "R - d/2, to the middle of the overlap: angular momentum is kept" },
    Word { name: "radius", about: "R, as in `gran/hooke/history` and `gran/hertz/history` of LAMMPS" },
];
