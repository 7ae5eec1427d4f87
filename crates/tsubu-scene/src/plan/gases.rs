//! Settings of the lattice gases.

use serde::{Deserialize, Serialize};

/// Settings of the lattice gases of Frisch, Hasslacher and Pomeau.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Fhp {
    /// Which collisions there are.
    pub rules: FhpRules,
    /// Probability that gravity turns a particle that can be turned, in a step [-].
    pub gravity: f64,
    /// What walls do.
    pub walls: GasWalls,
    /// Distance of neighbouring sites [m]; `None`: the mean diameter of the grains.
    pub spacing: Option<f64>,
    /// Time step [s]; `None`: grains gain in the mean what gravity gives.
    pub time_step: Option<f64>,
}

/// Collisions of a lattice gas FHP.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FhpRules {
    /// FHP-I.
    One,
    /// FHP-II.
    Two,
    /// FHP-III.
    Three,
}

/// What the walls of a lattice gas do with who comes in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum GasWalls {
    /// They send him back.
    Rough,
    /// They mirror him where they are upright or level.
    Smooth,
}

/// Settings of the gas of grains after Peng and Herrmann (1994).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct PengHerrmann {
    /// Probability that gravity turns a grain or lets one at rest go, in a step [-].
    pub gravity: f64,
    /// Probability that grains which collide come to rest [-].
    pub dissipation: f64,
    /// Probability that a wall sends a grain back instead of mirroring it [-].
    pub roughness: f64,
    /// Distance of neighbouring sites [m]; `None`: the mean diameter of the grains.
    pub spacing: Option<f64>,
    /// Time step [s]; `None`: grains gain in the mean what gravity gives.
    pub time_step: Option<f64>,
}

/// Settings of the gas of elongated grains after Baxter and Behringer (1990).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct BaxterBehringer {
    /// Probability that gravity turns a grain or lets one at rest go, in a step [-].
    pub gravity: f64,
    /// Probability that grains which collide come to rest [-].
    pub dissipation: f64,
    /// Probability that a wall sends a grain back instead of mirroring it [-].
    pub roughness: f64,
    /// What a grain saves by lying like one of its neighbours [-].
    pub neighbours: f64,
    /// What a flying grain saves by lying along its way [-].
    pub way: f64,
    /// Temperature of the Metropolis rule, in the same unit [-].
    pub temperature: f64,
    /// Distance of neighbouring sites [m]; `None`: the mean diameter of the grains.
    pub spacing: Option<f64>,
    /// Time step [s]; `None`: grains gain in the mean what gravity gives.
    pub time_step: Option<f64>,
}

/// Settings of piles after Karolyi and Kertesz (1998).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct KarolyiKertesz {
    /// Probability that gravity turns a flying grain downward, in a step [-].
    pub gravity: f64,
    /// Probability that a grain which hits another or a wall stays low instead of leaping off [-].
    pub dissipation: f64,
    /// Distance of neighbouring sites [m]; `None`: the mean diameter of the grains.
    pub spacing: Option<f64>,
    /// Time step [s]; `None`: grains gain in the mean what gravity gives.
    pub time_step: Option<f64>,
}
