//! Damping of the normal motion.

use crate::key::{Key, Kind, variants};
use crate::units::{DAMPING, DISC_DAMPING, RATE, SPEED};

const REFERENCE_SPEED: Key =
    Key::new("reference-speed", Kind::Quantity(&SPEED), "Impact speed at which the restitution is the materials'")
        .default("'1 m/s'")
        .above(0.0);

variants! {
    /// Damping of the normal motion for overlap d and overlap rate d'.
    Damping {
        None "none" "No damping, whatever the restitution" {}

        Sqrt "sqrt"
        "Visco-elastic spheres (Kuwabara and Kono 1987): the restitution falls slowly with the impact speed" {
            /// Impact speed at which the restitution is the materials' [m/s].
            reference_speed: f64 = REFERENCE_SPEED,
        }

        Quarter "quarter" "The same restitution at every impact speed, with Hertz (Tsuji, Tanaka and Ishida 1992)" {}

        Linear "linear"
        "A dashpot of constant strength: constant restitution with Hooke; with Hertz it is met at the reference speed" {
            /// Impact speed at which the restitution is the materials' [m/s].
            reference_speed: f64 = REFERENCE_SPEED,
        }

        Rate "rate"
        "A dashpot in proportion to the effective mass, one rate of decay for all sizes, whatever the restitution (`mass_velocity` of other codes)" {
            /// Damping coefficient over effective mass [1/s].
            rate: f64 = Key::new("rate", Kind::Quantity(&RATE), "Damping coefficient over effective mass").at_least(0.0),
        }

        Viscoelastic "viscoelastic"
        "`sqrt` told by its coefficient, whatever the restitution: a dashpot in proportion to effective mass and radius of the contact disc (`viscoelastic` and `gran/hertz/history` of LAMMPS)" {
            /// Damping coefficient over effective mass and radius of the contact disc [1/(m.s)].
            coefficient: f64 = Key::new(
                "coefficient",
                Kind::Quantity(&DISC_DAMPING),
                "Damping coefficient over effective mass and radius of the contact disc",
            )
            .at_least(0.0),
        }

        Dashpot "dashpot" "One dashpot for all contacts, whatever the restitution (Osada 2004)" {
            /// c [N.s/m].
            coefficient: f64 = Key::new("coefficient", Kind::Quantity(&DAMPING), "c").at_least(0.0),
        }
    }
}
