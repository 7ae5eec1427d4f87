//! Studies, what is written, and what is claimed.

use crate::units::{ACCELERATION, Dimension, ENERGY, FORCE, LENGTH, MASS, NUMBER};
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
    /// What of a base motion stays the same at all frequencies.
    pub keep: Keep,
    /// Whether each frequency begins anew, or in the state that the one before has left.
    pub path: Path,
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

/// What of a base motion stays the same while its frequency changes; forces keep their amplitude.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Keep {
    /// Its amplitude.
    Displacement,
    /// Amplitude times angular frequency.
    Velocity,
    /// Amplitude times the square of the angular frequency.
    Acceleration,
}

impl Keep {
    /// The power of the frequency over which the amplitude stays the same.
    pub fn power(self) -> i32 {
        match self {
            Self::Displacement => 0,
            Self::Velocity => 1,
            Self::Acceleration => 2,
        }
    }

    /// The amplitude at one frequency over that at another.
    pub fn amplitude(self, at: f64, over_that_at: f64) -> f64 {
        (over_that_at / at).powi(self.power())
    }
}

/// How a response goes through its frequencies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Path {
    /// Each from the bed, by itself.
    Apart,
    /// From the lowest to the highest, each in the state that the one before has left.
    Up,
    /// From the highest to the lowest.
    Down,
    /// Both ways, two curves.
    UpAndDown,
}

impl Response {
    /// About how many runs a case has, over all seeds.
    pub fn runs_of_case(&self) -> usize {
        /// What is added about a peak, as a rule.
        const MORE: usize = 8;
        let more = self.peak_within.map_or(0, |_| MORE);
        let ways = if self.path == Path::UpAndDown { 2 } else { 1 };
        (self.frequency_ratio.len() + more) * self.seeds as usize * ways
    }

    /// About how many periods a run with grains has.
    pub fn periods(&self) -> f64 {
        /// What it takes to be steady, as a rule.
        const SETTLING: u32 = 12;
        f64::from(self.discard_periods.unwrap_or(SETTLING) + self.measure_periods)
    }
}

/// The grains of a host's walls alone, shaken at many frequencies and accelerations.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Atlas {
    /// The host whose walls are shaken along its direction, in its stead.
    pub host: String,
    /// Lowest and highest frequency [Hz].
    pub frequency: [f64; 2],
    /// Lowest and highest amplitude of the acceleration [m/s^2].
    pub acceleration: [f64; 2],
    /// How far a point may lie off the line between its neighbours, over the mass of the grains [-].
    pub within: f64,
    /// Points of a case, at most.
    pub at_most: u32,
    /// Periods measured at each point, at most.
    pub measure_periods: u32,
    /// Number of random seeds, from the scene's seed upwards.
    pub seeds: u32,
    /// Scene keys and the values they take; every combination is a cavity of the atlas.
    pub vary: BTreeMap<String, Vec<toml::Value>>,
}

impl Atlas {
    /// About how many points a case has.
    pub fn points(&self) -> u32 {
        /// As a rule.
        const POINTS: u32 = 80;
        self.at_most.min(POINTS)
    }

    /// About how many periods a run has: what it takes to be steady, and to be measured, as a rule.
    pub fn periods(&self) -> f64 {
        const SETTLING: u32 = 15;
        const MEASURED: u32 = 30;
        f64::from(SETTLING + self.measure_periods.min(MEASURED))
    }
}

/// A search for the damper that serves best.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Design {
    /// Scene keys and the values they may take; every combination is a candidate.
    pub vary: BTreeMap<String, Vec<toml::Value>>,
    /// What is to be low.
    pub goal: Goal,
    /// Factors of the drive's amplitude; the worst answer over its factor counts.
    pub levels: Vec<f64>,
    /// Mass of all grains, at most [kg].
    pub mass_limit: Option<f64>,
    /// Displacement of the host from its mean, at most [m].
    pub stroke_limit: Option<f64>,
    /// Volume of the upright box that just holds the walls of the host, at most [m^3].
    pub space_limit: Option<f64>,
    /// Sides of that box, at most.
    pub envelope: Option<Envelope>,
    /// Cost of all grains, at most, in the unit of `cost`.
    pub cost_limit: Option<f64>,
    /// What grains cost, by the name of their material.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub cost: BTreeMap<String, Cost>,
    /// Runs at one frequency each, at most.
    pub runs: u32,
    /// The method that tells where the scene's own is worth its time.
    pub cheap: Option<super::Method>,
    /// Expected gains below this share do not count: the search looks where nothing was measured instead [-].
    pub within: f64,
    /// It ends where nothing is expected to be better by this share and the best is known as well [-]; `None`: by `runs` alone.
    pub until: Option<f64>,
    /// Random seeds that confirm.
    pub seeds: u32,
}

/// Sides of an upright box, at most [m].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Envelope {
    /// Along x.
    pub width: Option<f64>,
    /// Along y.
    pub depth: Option<f64>,
    /// Along z.
    pub height: Option<f64>,
}

/// What grains of a material cost, in any one unit of money.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Cost {
    /// Of a kilogram.
    pub per_kilogram: f64,
    /// Of a grain, beside that.
    pub per_grain: f64,
}

/// What of a response is to be low.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Goal {
    /// Its peak.
    Peak,
    /// Its root mean square over the frequencies that are asked for.
    Band,
}

/// Which values of keys fit what was measured.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Calibrate {
    /// Scene keys with the least and the largest value of each.
    pub vary: BTreeMap<String, Vec<toml::Value>>,
    /// What a run of the scene should give; with a curve, what its response should.
    pub measured: Vec<Measured>,
    /// A measured response curve.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub curve: Option<Curve>,
    /// Runs, at most, beside the checks.
    pub runs: u32,
    /// How near the results must be known, over the uncertainties of what was measured [-].
    pub within: f64,
    /// Runs that check what was found.
    pub checks: u32,
}

/// A measured result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Measured {
    /// Name of the result, as in `results` of `summary.json`.
    pub result: String,
    /// What was measured, in the unit of the result.
    pub value: f64,
    /// Its standard uncertainty, in the same unit.
    pub uncertainty: f64,
    /// Where it was measured.
    pub source: String,
}

/// A measured response curve.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Curve {
    /// What was measured.
    pub quantity: Responded,
    /// Where [Hz], rising.
    pub frequency: Vec<f64>,
    /// What it was there, in SI units.
    pub value: Vec<f64>,
    /// Its standard uncertainties.
    pub uncertainty: Vec<f64>,
    /// Where it was measured.
    pub source: String,
}

/// What a response tells at every frequency.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Responded {
    /// Root mean square of the displacement, mean removed.
    RmsDisplacement,
    /// Largest displacement from the mean.
    PeakDisplacement,
    /// Amplitude of the acceleration at the driving frequency.
    Acceleration,
    /// That of the displacement over that of the base; of a force, of the force on the base over it.
    Transmissibility,
    /// Amplitude of the force on the base.
    BaseForce,
    /// The mass that the grains add.
    ApparentMass,
    /// Energy lost per cycle.
    LossPerCycle,
}

impl Responded {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::RmsDisplacement,
        Self::PeakDisplacement,
        Self::Acceleration,
        Self::Transmissibility,
        Self::BaseForce,
        Self::ApparentMass,
        Self::LossPerCycle,
    ];

    /// The word of a scene.
    pub fn name(self) -> String {
        self.column().replace(' ', "-")
    }

    /// The column of `response.csv`, without its unit.
    pub fn column(self) -> &'static str {
        match self {
            Self::RmsDisplacement => "rms displacement",
            Self::PeakDisplacement => "peak displacement",
            Self::Acceleration => "acceleration",
            Self::Transmissibility => "transmissibility",
            Self::BaseForce => "base force",
            Self::ApparentMass => "apparent mass",
            Self::LossPerCycle => "loss per cycle",
        }
    }

    /// What its numbers measure.
    pub(crate) fn dimension(self) -> &'static Dimension {
        match self {
            Self::RmsDisplacement | Self::PeakDisplacement => &LENGTH,
            Self::Acceleration => &ACCELERATION,
            Self::Transmissibility => &NUMBER,
            Self::BaseForce => &FORCE,
            Self::ApparentMass => &MASS,
            Self::LossPerCycle => &ENERGY,
        }
    }

    /// Its SI unit, `-` for none.
    pub fn unit(self) -> &'static str {
        Some(self.dimension().si).filter(|unit| !unit.is_empty()).unwrap_or("-")
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
