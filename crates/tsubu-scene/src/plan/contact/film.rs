//! Liquid between bodies that are near.

use crate::key::{Key, Kind, variants};
use crate::units::{LENGTH, VISCOSITY};

variants! {
    /// Liquid between bodies that are near.
    Film {
        None "none" "No film" {}

        Lubrication "lubrication"
        "Liquid that must be pushed out before bodies touch, and drawn in when they part (Reynolds 1886)" {
            /// Gap at which it grows no more [m].
            roughness: f64 = Key::new("roughness", Kind::Quantity(&LENGTH), "Gap below which the film gets no stiffer")
                .above(0.0)
                .derived("a thousandth of the smallest mean diameter of a group"),
            /// Gap beyond which it is not counted [m].
            reach: f64 = Key::new("reach", Kind::Quantity(&LENGTH), "Gap beyond which the film is not counted")
                .above(0.0)
                .derived("a tenth of the smallest mean diameter of a group"),
            /// mu [Pa.s].
            viscosity: f64 = Key::new("viscosity", Kind::Quantity(&VISCOSITY), "Viscosity mu of the liquid")
                .above(0.0)
                .derived("density times viscosity of `[water]`"),
            /// Whether it goes on while the bodies touch.
            in_contact: bool =
                Key::new("in-contact", Kind::Flag, "Let the film go on, at the roughness, while the bodies touch")
                    .default("false"),
        }
    }
}
