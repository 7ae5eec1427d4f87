//! Studies, what is written, and what is claimed.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A frequency-response sweep.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Response {
    /// The host whose displacement is measured; its base (or force) must be a sine, whose frequency is varied.
    pub host: String,
    /// Frequency over the host's first undamped natural frequency [-].
    pub frequency_ratio: Vec<f64>,
    /// How near the frequencies beside the highest must be to it, as ratios: others are added until they are. `None`: no others.
    pub peak_within: Option<f64>,
    /// Periods thrown away before measuring, with grains; `None`: until the motion is steady.
    pub discard_periods: Option<u32>,
    /// Periods thrown away for the empty host; `None`: until the motion is steady.
    pub discard_periods_empty: Option<u32>,
    /// Periods measured.
    pub measure_periods: u32,
    /// Number of random seeds, from the scene's seed upwards.
    pub seeds: u32,
    /// Scene keys and the values they take; every combination is a case.
    pub vary: BTreeMap<String, Vec<toml::Value>>,
}

impl Response {
    /// About how many runs a case has, over all seeds.
    pub fn runs_of_case(&self) -> usize {
        /// What is added about a peak, as a rule.
        const MORE: usize = 8;
        let more = self.peak_within.map_or(0, |_| MORE);
        (self.frequency_ratio.len() + more) * self.seeds as usize
    }

    /// About how many periods a run with grains has.
    pub fn periods(&self) -> f64 {
        /// What it takes to be steady, as a rule.
        const SETTLING: u32 = 12;
        f64::from(self.discard_periods.unwrap_or(SETTLING) + self.measure_periods)
    }
}

/// A parameter sweep: every combination of the values is a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Sweep {
    /// Scene keys and the values they take.
    pub vary: BTreeMap<String, Vec<toml::Value>>,
}

/// What is written.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Output {
    /// Simulated time between rows of `history.csv` [s].
    pub history_interval: f64,
    /// Simulated time between frames [s]; `None`: no frames.
    pub frame_interval: Option<f64>,
    /// Simulated time between checkpoints [s].
    pub checkpoint_interval: f64,
    /// Write contacts into frames.
    pub contacts: bool,
    /// Also write extended XYZ.
    pub xyz: bool,
    /// Also write LAMMPS dump files.
    pub lammps: bool,
}

/// A result that must lie in a range.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Claim {
    /// Name of the result, as in `results` of `summary.json`.
    pub result: String,
    /// Lower end of the accepted range.
    pub low: Option<f64>,
    /// Upper end of the accepted range.
    pub high: Option<f64>,
    /// Where the number comes from.
    pub source: String,
}
