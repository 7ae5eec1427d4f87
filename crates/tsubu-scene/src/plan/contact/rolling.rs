//! Rolling resistance.

use crate::key::{Key, Kind, variants};
use crate::units::{DAMPING, NUMBER, SLOWNESS, SPEED, STIFFNESS};

const FADES: Key = Key::new("smoothing-speed", Kind::Quantity(&SPEED), "Rolling speed below which the torque fades")
    .default("'1 mm/s'")
    .above(0.0);

variants! {
    /// Rolling resistance.
    Rolling {
        None "none" "No rolling resistance" {}

        Constant "constant"
        "Torque in proportion to the normal force, against the rolling, fading below a small speed (model A of Ai 2011)" {
            /// Rolling speed below which the torque fades [m/s].
            smoothing_speed: f64 = FADES,
        }

        Viscous "viscous" "Torque that grows with the rolling speed, without a limit (model B of Ai 2011)" {
            /// Torque over (mu_r R f_n) at a rolling speed of 1 m/s [s/m].
            coefficient: f64 = Key::new(
                "coefficient",
                Kind::Quantity(&SLOWNESS),
                "Torque over (mu_r R f_n) at a rolling speed of 1 m/s",
            )
            .at_least(0.0),
        }

        Epsd "epsd"
        "Elastic-plastic spring and dashpot on the angle of rolling: holds a grain at rest (model C of Ai 2011)" {
            /// 2.25 in space, 3 in the plane [-].
            ratio: f64 = Key::new("ratio", Kind::Quantity(&NUMBER), "Rolling stiffness over k_n (mu_r R)^2")
                .above(0.0)
                .derived("2.25 in space, 3 in the plane"),
            /// Damping ratio of the rolling spring [-].
            damping_ratio: f64 = Key::new("damping-ratio", Kind::Quantity(&NUMBER), "Damping ratio of the rolling spring")
                .default("0.3")
                .at_least(0.0),
        }

        Epsd2 "epsd2"
        "The same without a dashpot, as stiff in rolling as the contact is in shear; with a tangential spring" {}

        Spring "spring"
        "Spring, dashpot and slider on the rolling displacement, a force that acts as a torque alone (Luding 2008)" {
            /// k [N/m].
            stiffness: f64 = Key::new("stiffness", Kind::Quantity(&STIFFNESS), "k").above(0.0),
            /// c [N.s/m].
            damping: f64 = Key::new("damping", Kind::Quantity(&DAMPING), "c").default("0").at_least(0.0),
        }

        ContactWidth "contact-width"
        "A bump ahead of the contact: the normal force has an arm in proportion to the width of the overlap (Osada 2004)" {
            /// Rolling speed below which the torque fades [m/s].
            smoothing_speed: f64 = FADES,
        }
    }
}
