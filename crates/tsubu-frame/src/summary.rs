//! The summary of a run, `summary.json`: the keys that users and notebooks build on.
//!
//! A not-a-number is written as `null` and read back as not-a-number.

use std::io::Write as _;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::FileError;
use crate::claim::Claim;
use crate::named::Named;
use crate::not_a_number::{real, reals};
use crate::whole::write_atomically;

/// How a run ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// It came to its end.
    #[default]
    Finished,
    /// It was stopped and can be resumed.
    Interrupted,
    /// It went wrong; what was computed so far is kept.
    Failed,
}

impl Status {
    /// The word in the file.
    pub fn word(self) -> &'static str {
        match self {
            Self::Finished => "finished",
            Self::Interrupted => "interrupted",
            Self::Failed => "failed",
        }
    }
}

/// One result: a number or a list of numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum ResultValue {
    /// A number.
    Number(#[serde(deserialize_with = "real")] f64),
    /// A list.
    List(#[serde(deserialize_with = "reals")] Vec<f64>),
}

impl From<f64> for ResultValue {
    fn from(x: f64) -> Self {
        Self::Number(x)
    }
}

impl From<Vec<f64>> for ResultValue {
    fn from(list: Vec<f64>) -> Self {
        Self::List(list)
    }
}

/// The books at the end of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Energy {
    /// Each term [J].
    #[serde(flatten)]
    pub terms: Named<Joule>,
    /// Energy residual, relative to the energy turned over.
    #[serde(deserialize_with = "real")]
    pub residual_relative: f64,
}

/// An energy [J].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Joule(#[serde(deserialize_with = "real")] pub f64);

impl From<f64> for Joule {
    fn from(x: f64) -> Self {
        Self(x)
    }
}

/// Everything a run says about itself in numbers.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Version of the program.
    pub tsubu_version: String,
    /// How the run ended.
    pub status: Status,
    /// `dem`, `lattice`, ...
    pub method: String,
    /// 2 or 3.
    pub dimension: u32,
    /// Number of grains.
    pub particles: u64,
    /// Steps made.
    pub steps: u64,
    /// Time step [s].
    #[serde(deserialize_with = "real")]
    pub time_step: f64,
    /// Simulated time [s].
    #[serde(deserialize_with = "real")]
    pub simulated_seconds: f64,
    /// Computing time [s].
    #[serde(deserialize_with = "real")]
    pub wall_seconds: f64,
    /// Threads used.
    pub threads: u32,
    /// The ranks that made the run together, where there were several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ranks: Option<RanksSummary>,
    /// Grains times steps per second of computing time.
    #[serde(deserialize_with = "real")]
    pub particle_steps_per_second: f64,
    /// Mean number of touching pairs.
    #[serde(deserialize_with = "real")]
    pub contacts_mean: f64,
    /// The books.
    pub energy: Energy,
    /// Hash of the final state, in hex.
    pub state_hash: String,
    /// What came out: what the scene asks to be watched first, in its order.
    pub results: Named<ResultValue>,
    /// SI unit of each result that has one.
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    pub units: Named<String>,
    /// The stages of a run that has several, as far as it has come.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stages: Vec<StageSpan>,
    /// Values held against their ranges.
    pub claims: Vec<Claim>,
    /// What the reader should know.
    pub warnings: Vec<String>,
}

/// How ranks have shared a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RanksSummary {
    /// How many there were.
    pub count: u32,
    /// Work of the busiest over the mean of all; 1 where all have worked as long.
    #[serde(deserialize_with = "real")]
    pub imbalance: f64,
}

/// A stage of a run that is over.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StageSpan {
    /// Its name; its results are called `NAME.RESULT`.
    pub name: String,
    /// Simulated time at its begin [s].
    #[serde(deserialize_with = "real")]
    pub begin: f64,
    /// The same at its end [s].
    #[serde(deserialize_with = "real")]
    pub end: f64,
    /// Its steps.
    pub steps: u64,
    /// What ended it: `duration`, `until` or `at-most`.
    pub ended: String,
}

impl Summary {
    /// Takes over the results and warnings of a part of the run, called `NAME.RESULT` where the part has a name.
    pub fn take(&mut self, name: Option<&str>, part: Self) {
        let called = |result: &str| name.map_or_else(|| result.to_owned(), |name| format!("{name}.{result}"));
        for (result, value) in part.results.iter() {
            self.give(called(result), part.unit(result), value.clone());
        }
        let told = |warning| name.map_or_else(|| String::clone(&warning), |name| format!("stage `{name}`: {warning}"));
        self.warnings.extend(part.warnings.into_iter().map(told));
    }

    /// Adds a result with its SI unit, `-` for none.
    pub fn give(&mut self, name: impl Into<String>, unit: &str, value: impl Into<ResultValue>) {
        let name = name.into();
        if unit != "-" {
            self.units.insert(name.as_str(), unit);
        }
        self.results.insert(name, value);
    }

    /// The SI unit of a result, `-` for none.
    pub fn unit(&self, result: &str) -> &str {
        self.units.get(result).map_or("-", String::as_str)
    }

    /// The results as a reader wants them: first those that the scene claims something about, then as they were given.
    pub fn results_in_order(&self) -> Vec<(&str, &ResultValue)> {
        let mut results: Vec<_> = self.results.iter().collect();
        results.sort_by_key(|(name, _)| {
            self.claims.iter().position(|claim| claim.name == *name).unwrap_or(self.claims.len())
        });
        results
    }

    /// Writes the file, whole or not at all.
    pub fn write(&self, path: &Path) -> Result<(), FileError> {
        write_json(path, self)
    }

    /// Reads the file.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        read_json(path)
    }
}

/// The mean that a result of a watch goes with, if it is one of what is told beside a mean: its spread, the ends between which
/// the number was, and the last one.
pub fn mean_beside(result: &str) -> Option<&str> {
    [" spread", " least", " largest", " final"].iter().find_map(|what| result.strip_suffix(what))
}

/// Writes any value as indented JSON, whole or not at all.
pub fn write_json(path: &Path, value: &impl Serialize) -> Result<(), FileError> {
    let text = json(path, value)?;
    write_atomically(path, |out| out.write_all(text.as_bytes()))
}

/// A value as indented JSON, for the file `path`.
pub(crate) fn json(path: &Path, value: &impl Serialize) -> Result<String, FileError> {
    let text = serde_json::to_string_pretty(value).map_err(|e| FileError::content(path, e.to_string()))?;
    Ok(text + "\n")
}

/// Reads a value from JSON.
pub fn read_json<T: for<'de> Deserialize<'de>>(path: &Path) -> Result<T, FileError> {
    let text = std::fs::read_to_string(path).map_err(FileError::read(path))?;
    serde_json::from_str(&text).map_err(|e| FileError::content(path, e.to_string()))
}
