//! Stages of a run.

use serde::{Deserialize, Serialize};

/// A piece of a run with values of its own.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Stage {
    /// Its name: results are told as `NAME.RESULT`.
    pub name: String,
    /// How long it lasts [s]; `None`: see `until`.
    pub duration: Option<f64>,
    /// What ends it.
    pub until: Option<Until>,
    /// How long it lasts where that does not come true [s].
    pub at_most: Option<f64>,
    /// The keys that it sets, as typed.
    #[serde(default)]
    pub set: toml::Table,
}

/// What ends a stage: all that is given, at once.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Until {
    /// The kinetic energy, spin included, over the number of all grains, frozen and driven ones and each sphere of a clump counted, is below this [J].
    pub kinetic_energy: Option<f64>,
    /// The kinetic energy of all grains over their potential energy from z = 0 is below this [-].
    pub kinetic_over_potential: Option<f64>,
    /// The rms displacement of each host that a sine drives differs by less than this share from that of the period before.
    pub host_steady: Option<f64>,
    /// A column of the history, without its unit.
    pub result: Option<String>,
    /// Its value is above this.
    pub above: Option<f64>,
    /// Its value is below this.
    pub below: Option<f64>,
    /// So many grains of streams have come.
    pub inserted: Option<u64>,
    /// So many grains have been removed.
    pub removed: Option<u64>,
}
