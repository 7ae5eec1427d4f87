//! Bonds between grains.

use serde::{Deserialize, Serialize};

/// Beams that hold grains together, made at one time between all grains of some groups that are near each other.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Bond {
    /// Groups whose grains are bonded; `None`: all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub particles: Option<Vec<String>>,
    /// When they are made [s].
    pub at: f64,
    /// Widest gap between surfaces that is bonded, over the radius of the smaller grain, or of the sphere (disc) of its volume (area) [-].
    pub gap: f64,
    /// Radius of the beam over the same [-].
    pub radius: f64,
    /// Young's modulus [Pa].
    pub young_modulus: f64,
    /// Poisson's ratio [-].
    pub poisson_ratio: f64,
    /// Damping of the stretching over the critical [-].
    pub damping: f64,
    /// Largest tension before it breaks [Pa].
    pub tensile_strength: Option<f64>,
    /// Largest shear stress before it breaks [Pa].
    pub shear_strength: Option<f64>,
    /// Weibull modulus of the strengths [-]; `None`: no scatter.
    pub weibull_modulus: Option<f64>,
}

impl Bond {
    /// Whether the grains of a group are among those that are bonded.
    pub fn joins(&self, group: &str) -> bool {
        self.particles.as_ref().is_none_or(|groups| groups.iter().any(|name| name == group))
    }

    /// Whether it can break.
    pub fn breaks(&self) -> bool {
        self.tensile_strength.is_some() || self.shear_strength.is_some()
    }
}
