//! Settings of the models with one grain a site.

use serde::{Deserialize, Serialize};

/// Settings of the void models: Litwiniszyn, and after Caram and Hong (1991).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Voids {
    /// Probability that a void takes the grain to its upper left [-].
    pub left: f64,
    /// Voids from each outlet site: a step (Litwiniszyn), or whenever its turn comes [-].
    pub rate: f64,
    /// Time step [s]; `None`: a grain falls from rest to the next row.
    pub time_step: Option<f64>,
}

/// Chances of a chute after Savage (1993), in a step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Savage {
    /// Straight down [-].
    pub down: f64,
    /// Down and aside, both sides together [-].
    pub diagonal: f64,
    /// Aside, both sides together [-].
    pub sideways: f64,
    /// Straight up [-].
    pub up: f64,
    /// Time step [s]; `None`: a grain falls from rest to the next row.
    pub time_step: Option<f64>,
}

/// Settings of the lattice grains of Gutt and Haff.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct GuttHaff {
    /// Time step [s]; `None`: from the speed of a fall through the whole height.
    pub time_step: Option<f64>,
}

/// Settings of forces in a pile after Hemmingsson and Herrmann (1997).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Heap {
    /// How loads are shared.
    pub split: Split,
    /// Friction coefficient between grains [-].
    pub friction: f64,
    /// Probability that a grain gives all its load to the outer one below [-].
    pub arching: f64,
}

/// How a grain shares its load between the two below.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Split {
    /// As forces balance.
    Balance,
    /// In random shares of the weight.
    Random,
}
