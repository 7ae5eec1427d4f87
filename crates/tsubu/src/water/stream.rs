//! How the water moves where no grain disturbs it: a velocity along x that depends on the height.

use super::Parcel;
use std::f64::consts::LN_10;
use tsubu_scene::plan::Flow;

/// Slope and constant of the log law, U = U* (8.5 + 5.75 log10(Z/k)).
const CONSTANT: f64 = 8.5;
const PER_DECADE: f64 = 5.75;

/// A stream along x.
#[derive(Clone, Debug, PartialEq)]
pub enum Stream {
    /// Water at rest.
    Still,
    /// Over a rough bed: U = U* (8.5 + 5.75 log10(Z/k)), 0 where that is negative (Nikuradse 1933; Osada et al. 2004,
    /// equation 9).
    LogLaw {
        /// U* [m/s].
        shear_velocity: f64,
        /// k [m].
        roughness: f64,
        /// Height z where Z = 0 [m].
        zero_level: f64,
    },
    /// Straight lines between points, constant outside.
    Table {
        /// Heights z [m], rising.
        height: Vec<f64>,
        /// Velocities [m/s].
        velocity: Vec<f64>,
    },
}

impl Stream {
    pub(super) fn new(plan: &Flow) -> Self {
        match plan.clone() {
            Flow::Still {} => Self::Still,
            Flow::LogLaw { shear_velocity, roughness, zero_level } => {
                Self::LogLaw { shear_velocity, roughness, zero_level }
            }
            Flow::Table { height, velocity } => Self::Table { height, velocity },
        }
    }

    /// Velocity along x at height `z` [m/s].
    pub fn velocity(&self, z: f64) -> f64 {
        match self {
            Self::Still => 0.0,
            Self::LogLaw { shear_velocity, roughness, zero_level } => {
                // A height below zero has no logarithm; the velocity is zero well above it already.
                let depth = ((z - zero_level) / roughness).max(1e-3);
                (shear_velocity * (CONSTANT + PER_DECADE * depth.log10())).max(0.0)
            }
            Self::Table { height, velocity } => {
                let k = height.partition_point(|h| *h <= z);
                if k == 0 {
                    velocity[0]
                } else if k == height.len() {
                    velocity[k - 1]
                } else {
                    let share = (z - height[k - 1]) / (height[k] - height[k - 1]);
                    velocity[k - 1] + share * (velocity[k] - velocity[k - 1])
                }
            }
        }
    }

    /// Rate of shear dU/dz at height `z` [1/s]; at a kink that of the straight line above it.
    pub fn shear(&self, z: f64) -> f64 {
        match self {
            Self::Still => 0.0,
            Self::LogLaw { shear_velocity, zero_level, .. } => {
                let moves = self.velocity(z) > 0.0;
                if moves { shear_velocity * PER_DECADE / (LN_10 * (z - zero_level)) } else { 0.0 }
            }
            Self::Table { height, velocity } => {
                let k = height.partition_point(|h| *h <= z);
                let between = k > 0 && k < height.len();
                if between { (velocity[k] - velocity[k - 1]) / (height[k] - height[k - 1]) } else { 0.0 }
            }
        }
    }

    /// Spins of the water at the grains of a parcel: a stream along x that grows with z turns about y, from z to x.
    pub(super) fn fill_spin(&self, parcel: &mut Parcel) {
        if *self == Self::Still {
            return;
        }
        for i in 0..parcel.rows() {
            parcel.flow_spin[1][i] = 0.5 * self.shear(parcel.height[i]);
        }
    }

    /// Velocities at the grains of a parcel.
    pub(super) fn fill(&self, parcel: &mut Parcel) {
        if *self == Self::Still {
            return;
        }
        for i in 0..parcel.rows() {
            parcel.flow[0][i] = self.velocity(parcel.height[i]);
        }
    }

    /// Fastest water below a surface, or near the bed where there is none: ten grains of this diameter [m] above it [m/s].
    pub(super) fn fastest(&self, surface: f64, diameter: f64) -> f64 {
        match self {
            Self::Still => 0.0,
            Self::LogLaw { zero_level, .. } => {
                let near = zero_level + 10.0 * diameter;
                self.velocity(if surface.is_finite() { surface } else { near })
            }
            Self::Table { velocity, .. } => velocity.iter().fold(0.0, |most, v| v.abs().max(most)),
        }
    }

    /// Shear velocity [m/s], where there is one.
    pub fn shear_velocity(&self) -> Option<f64> {
        match self {
            Self::LogLaw { shear_velocity, .. } => Some(*shear_velocity),
            Self::Still | Self::Table { .. } => None,
        }
    }
}
