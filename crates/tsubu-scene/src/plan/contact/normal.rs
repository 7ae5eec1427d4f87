//! Elastic normal force.

use crate::key::{Key, Kind, variants};
use crate::units::STIFFNESS;

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
    }
}

impl Normal {
    /// Stiffness in loading that the scene tells, its key `stiffness` [N/m]; `None`: it follows from the materials and the overlap.
    pub const fn stiffness(&self) -> Option<f64> {
        match *self {
            Self::Hertz {} => None,
            Self::Hooke { stiffness } => Some(stiffness),
        }
    }

    /// Whether it gives back what it takes and never pulls: what it loses is then a matter of the restitution, which every method
    /// knows.
    pub const fn elastic(&self) -> bool {
        match self {
            Self::Hertz {} | Self::Hooke { .. } => true,
        }
    }
}
