//! Tangential force.

use crate::key::{Key, Kind, Word, variants};
use crate::units::{FORCE, NUMBER, SPEED};
use serde::{Deserialize, Serialize};

variants! {
    /// Tangential force.
    Tangential {
        None "none" "No tangential force" {}

        Coulomb "coulomb" "Sliding friction without a spring, fading below a small sliding speed; heaps creep" {
            /// v_eps [m/s].
            smoothing_speed: f64 =
                Key::new("smoothing-speed", Kind::Quantity(&SPEED), "Sliding speed below which friction fades")
                    .default("'1 mm/s'")
                    .above(0.0),
        }

        Mindlin "mindlin"
        "Elastic tangential contact of spheres: a spring with history that slides at the friction limit; with `normal.hertz`" {
            /// How force and slip belong together.
            form: MindlinForm =
                Key::new("form", Kind::OneOf(MINDLIN_FORM), "How force and slip belong together").default("'incremental'"),
            /// Tangential over normal dashpot [-]; `None`: equal damping ratios.
            damping: Option<f64> = Key::new(
                "damping",
                Kind::Quantity(&NUMBER),
                "Tangential over normal dashpot; automatic: equal damping ratios",
            )
            .at_least(0.0)
            .word("automatic"),
        }

        Spring "spring"
        "Linear spring with history and a dashpot that slide at the friction limit, with cohesion between grains (Cundall and Strack 1979; Osada 2004); not with `normal.hertz`" {
            /// k_t over the stiffness of the normal force [-].
            ratio: f64 = Key::new("ratio", Kind::Quantity(&NUMBER), "Tangential over normal stiffness")
                .default("0.2857142857142857")
                .above(0.0),
            /// Tangential over normal dashpot [-].
            damping: f64 =
                Key::new("damping", Kind::Quantity(&NUMBER), "Tangential over normal dashpot").default("0").at_least(0.0),
            /// Grain-level cohesion c: the tangential force may reach mu f_n plus this [N].
            cohesion: f64 = Key::new(
                "cohesion",
                Kind::Quantity(&FORCE),
                "Grain-level cohesion: the tangential force may reach mu f_n plus this",
            )
            .default("0")
            .at_least(0.0),
        }
    }
}

impl Tangential {
    /// Whether it has a spring, whose stiffness other parts may take.
    pub const fn sprung(&self) -> bool {
        match self {
            Self::None {} | Self::Coulomb { .. } => false,
            Self::Mindlin { .. } | Self::Spring { .. } => true,
        }
    }
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

static MINDLIN_FORM: &[Word] = &[
    Word {
        name: "incremental",
        about: "by steps of the slip, scaled down on unloading (Thornton, Cummins, Cleary 2013)",
    },
    Word { name: "secant", about: "by the whole slip since first touch (Chung and Ooi 2011)" },
];
