//! Resistance against turning about the normal.

use crate::key::{Key, Kind, variants};
use crate::units::SPIN;

variants! {
    /// Resistance against relative spin about the normal.
    Twisting {
        None "none" "No twisting resistance" {}

        Sliding "sliding" "Friction of a disc of contact that turns as a whole, fading below a small spin (Marshall 2009)" {
            /// Spin below which the torque fades [rad/s].
            smoothing_spin: f64 =
                Key::new("smoothing-spin", Kind::Quantity(&SPIN), "Relative spin below which the torque fades")
                    .default("'1 rad/s'")
                    .above(0.0),
        }

        Spring "spring"
        "An elastic disc of contact that twists, and turns as a whole where its friction ends (Marshall 2009); with a tangential spring" {}
    }
}
