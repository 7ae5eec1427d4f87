//! A point of a response curve, of one bed.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What one run at one frequency gives.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Frequency [Hz].
    pub frequency: f64,
    /// Root mean square displacement, mean removed [m].
    pub rms: f64,
    /// Largest displacement from the mean [m].
    pub peak: f64,
    /// Amplitude of the displacement at the driving frequency [m].
    pub amplitude: f64,
    /// Of a base that moves, that over its amplitude there; of a force, the force on the base over it [-]. 0 where nothing drives.
    pub transmissibility: f64,
    /// Amplitude of the force of structure and grains on the base, there [N].
    pub base_force: f64,
    /// Mean displacement [m].
    pub mean: f64,
    /// In-phase part of the grains' force over acceleration: the mass the grains add [kg].
    pub apparent_mass: f64,
    /// Energy lost per cycle, grains and structure [J].
    pub loss: f64,
    /// Energy of every account per cycle [J], in the order of [`Account::ALL`](crate::ledger::Account::ALL).
    pub flows: Vec<f64>,
    /// Change of the root mean square from the first to the second half of the measured time, relative.
    pub drift: f64,
    /// What watches told in the mean over the measured periods, by its column; without those that saw nothing.
    pub watched: BTreeMap<String, f64>,
    /// Energy residual over turned-over energy.
    pub residual: f64,
    /// Periods before the measured ones.
    pub discarded: u32,
    /// Computing time [s].
    pub wall: f64,
}
