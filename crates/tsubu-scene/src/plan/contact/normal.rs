//! Elastic normal force.

use crate::key::{Key, Kind, variants};
use crate::units::{NUMBER, STIFFNESS};

variants! {
    /// Elastic normal force for overlap d.
    Normal {
        Hertz "hertz"
        "Elastic contact of smooth spheres, or of a sphere and a plane, as stiff as the materials make it (Hertz 1882)" {}

        Hooke "hooke"
        "Linear spring, one stiffness for all contacts; the contact time does not depend on the impact speed" {
            /// k [N/m].
            stiffness: f64 = Key::new("stiffness", Kind::Quantity(&STIFFNESS), "k").above(0.0),
        }

        Luding "luding"
        "Linear spring that yields and holds on: stiffer when let go, so that a dent stays while the bodies touch, and pulling before they part (Luding 2008)" {
            /// k1 [N/m].
            stiffness: f64 = Key::new("stiffness", Kind::Quantity(&STIFFNESS), "k1 of first loading").above(0.0),
            /// K over k1 [-].
            unloading_ratio: f64 = Key::new(
                "unloading-ratio",
                Kind::Quantity(&NUMBER),
                "Stiffness k2 of the deepest dents over k1; shallower ones are softer in proportion to their depth",
            )
            .above(1.0),
            /// kc over k1 [-].
            adhesion_ratio: f64 =
                Key::new("adhesion-ratio", Kind::Quantity(&NUMBER), "Stiffness kc of the pull, -kc d at most, over k1")
                    .default("0")
                    .at_least(0.0),
            /// phi_f [-].
            plasticity_depth: f64 = Key::new(
                "plasticity-depth",
                Kind::Quantity(&NUMBER),
                "Depth of the deepest dent over 2 R*, R* the effective radius; pressed deeper than makes it, the contact is elastic",
            )
            .above(0.0),
        }
    }
}

impl Normal {
    /// Stiffness in loading that the scene tells, its key `stiffness` [N/m]; `None`: it follows from the materials and the overlap.
    pub const fn stiffness(&self) -> Option<f64> {
        match *self {
            Self::Hertz {} => None,
            Self::Hooke { stiffness } | Self::Luding { stiffness, .. } => Some(stiffness),
        }
    }

    /// Whether it gives back what it takes and never pulls: what it loses is then a matter of the restitution, which every method
    /// knows.
    pub const fn elastic(&self) -> bool {
        match self {
            Self::Hertz {} | Self::Hooke { .. } => true,
            Self::Luding { .. } => false,
        }
    }
}
