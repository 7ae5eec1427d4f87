//! How the water moves: a velocity that depends on the height.

use super::coupled::{Coupled, Setting, Top};
use super::log_law::{PER_DECADE, log_law};
use super::{Layers, Parcel};
use crate::about::About;
use glam::DVec3;
use multiversion::multiversion;
use std::f64::consts::LN_10;
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;
use tsubu_scene::plan::{Flow, Lid, StreamStart, Water};

pub(super) const STILL: About = About {
    key: "water.flow.still",
    formula: "U = 0",
    symbols: "U velocity of the water [m/s]",
    limits: "Grains do not move the water.",
    reference: "by definition",
};

pub(super) const LOG_LAW: About = About {
    key: "water.flow.log-law",
    formula: "U = U* (8.5 + 5.75 log10(Z/k)), 0 where that is negative; Z = z - zero-level",
    symbols: "U velocity along x [m/s], U* shear velocity [m/s], k equivalent roughness [m], z height [m]",
    limits: "A steady, uniform, hydraulically rough stream. Grains take nothing from it; `coupled` is slowed by them.",
    reference: "Nikuradse (1933); Osada, Shimizu and Wakai (2004), equation 9",
};

pub(super) const TABLE: About = About {
    key: "water.flow.table",
    formula: "U(z): straight lines between the given points, constant outside",
    symbols: "U velocity along x [m/s], z height [m]",
    limits: "Grains take nothing from it.",
    reference: "by definition",
};

pub(super) const COLUMN: About = About {
    key: "water.flow.column",
    formula: "W = velocity/e",
    symbols: "W velocity upwards [m/s], `velocity` the superficial one, discharge over plan area [m/s], e share of a layer that \
grains leave to the water [-]",
    limits: "Even over the plan area: no channels, no bubbles smaller than a layer.",
    reference: "continuity",
};

/// A flow: along x, or upwards.
#[derive(Clone, Debug)]
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
    /// Layers that give to the grains and take from them.
    Coupled(Box<Coupled>),
    /// Upwards with a superficial velocity over the share that grains leave.
    Column {
        /// Where the layers are.
        layers: Layers,
        /// Superficial velocity [m/s].
        velocity: f64,
    },
}

impl Stream {
    /// The flow of a plan; `gravity` along x [m/s^2].
    pub(super) fn new(plan: &Water, gravity: f64) -> Self {
        match plan.flow.clone() {
            Flow::Still {} => Self::Still,
            Flow::LogLaw { shear_velocity, roughness, zero_level } => {
                Self::LogLaw { shear_velocity, roughness, zero_level }
            }
            Flow::Table { height, velocity } => Self::Table { height, velocity },
            Flow::Coupled { bottom, top, layers, area, roughness, shear_velocity, discharge, lid, reach, start } => {
                let end = match lid {
                    Lid::Rigid => Top::Lid { discharge },
                    Lid::Free => Top::Free { supply: discharge.zip(reach) },
                };
                let setting = Setting {
                    density: plan.density,
                    viscosity: plan.viscosity,
                    roughness,
                    gravity,
                    shear_velocity,
                    top: end,
                    still: start == StreamStart::Still,
                };
                Self::Coupled(Box::new(Coupled::new(Layers::new(bottom, top, layers, area), &setting)))
            }
            Flow::Column { bottom, top, layers, area, velocity } => {
                Self::Column { layers: Layers::new(bottom, top, layers, area), velocity }
            }
        }
    }

    /// Takes the state of an earlier flow of the same layers.
    pub(super) fn go_on_from(&mut self, earlier: Self) {
        match (self, earlier) {
            (Self::Coupled(now), Self::Coupled(earlier)) => now.go_on_from(*earlier),
            (Self::Column { layers, .. }, Self::Column { layers: earlier, .. }) => *layers = earlier,
            _ => {}
        }
    }

    /// The layers, where there are some.
    pub fn layers(&self) -> Option<&Layers> {
        match self {
            Self::Coupled(coupled) => Some(&coupled.layers),
            Self::Column { layers, .. } => Some(layers),
            Self::Still | Self::LogLaw { .. } | Self::Table { .. } => None,
        }
    }

    /// Velocities at the grains of a parcel; if it is a `crowd` the share that grains leave to the water there, and if it
    /// `rotates` the spins of the water: a stream along x that grows with z turns about y, from z to x.
    pub(super) fn fill(&self, parcel: &mut Parcel, crowd: bool, rotates: bool) {
        let n = parcel.rows();
        if let Some(layers) = self.layers().filter(|_| crowd) {
            for i in 0..n {
                parcel.porosity[i] = parcel.read(&layers.porosity, i);
            }
        }
        match self {
            Self::Still => {}
            Self::Column { velocity, .. } => {
                for i in 0..n {
                    parcel.flow[2][i] = velocity / parcel.porosity[i];
                }
            }
            Self::LogLaw { shear_velocity, roughness, zero_level } => {
                log_laws(parcel, *shear_velocity, 1.0 / roughness, *zero_level);
                for i in (0..n).filter(|_| rotates) {
                    let moves = parcel.flow[0][i] > 0.0;
                    let shear = shear_velocity * PER_DECADE / (LN_10 * (parcel.height[i] - zero_level));
                    parcel.flow_spin[1][i] = if moves { 0.5 * shear } else { 0.0 };
                }
            }
            Self::Table { height, velocity } => {
                for i in 0..n {
                    let (flow, shear) = between(height, velocity, parcel.height[i]);
                    parcel.flow[0][i] = flow;
                    if rotates {
                        parcel.flow_spin[1][i] = 0.5 * shear;
                    }
                }
            }
            Self::Coupled(coupled) => {
                let ahead = coupled.ahead();
                for i in 0..n {
                    parcel.flow[0][i] = parcel.read(ahead, i);
                }
                for i in (0..n).filter(|_| rotates) {
                    let k = parcel.layer[i] as usize;
                    parcel.flow_spin[1][i] = 0.5 * (ahead[k + 1] - ahead[k]) / coupled.layers.thickness;
                }
            }
        }
    }

    /// Shear velocity of the turbulence around the grains of a parcel.
    pub(super) fn fill_turbulence(&self, parcel: &mut Parcel) {
        let n = parcel.rows();
        if let Self::Coupled(coupled) = self {
            for i in 0..n {
                parcel.turbulence[i] = parcel.read(coupled.turbulence(), i);
            }
        } else {
            parcel.turbulence[..n].fill(self.most_turbulent());
        }
    }

    /// Largest shear velocity of its turbulence [m/s].
    pub(super) fn most_turbulent(&self) -> f64 {
        match self {
            Self::LogLaw { shear_velocity, .. } => *shear_velocity,
            Self::Coupled(coupled) => coupled.most_turbulent(),
            Self::Still | Self::Table { .. } | Self::Column { .. } => 0.0,
        }
    }

    /// The way it goes, as a unit vector; none where it stands still.
    pub(super) fn direction(&self) -> Option<DVec3> {
        let strongest =
            |velocity: &[f64]| velocity.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(0.0);
        let (axis, velocity) = match self {
            Self::Still => (DVec3::X, 0.0),
            Self::LogLaw { shear_velocity, .. } => (DVec3::X, *shear_velocity),
            Self::Table { velocity, .. } => (DVec3::X, strongest(velocity)),
            Self::Coupled(coupled) => (DVec3::X, strongest(&coupled.velocity)),
            Self::Column { velocity, .. } => (DVec3::Z, *velocity),
        };
        (velocity != 0.0).then(|| velocity.signum() * axis)
    }

    /// Fastest water below a surface, or near the bed where there is none: ten grains of this diameter [m] above it [m/s].
    pub(super) fn fastest(&self, surface: f64, diameter: f64) -> f64 {
        match self {
            Self::Still => 0.0,
            Self::Column { layers, velocity } => {
                let least = layers.porosity.iter().copied().fold(1.0, f64::min);
                velocity.abs() / least
            }
            Self::Coupled(coupled) => coupled.velocity.iter().fold(0.0, |most, v| v.abs().max(most)),
            Self::LogLaw { shear_velocity, roughness, zero_level } => {
                let height = if surface.is_finite() { surface - zero_level } else { 10.0 * diameter };
                log_law(height, *shear_velocity, 1.0 / roughness)
            }
            Self::Table { velocity, .. } => velocity.iter().fold(0.0, |most, v| v.abs().max(most)),
        }
    }

    /// Writes what the next step depends on into a checkpoint.
    pub(crate) fn save(&self, state: &mut State) {
        match self {
            Self::Coupled(coupled) => coupled.save(state),
            Self::Column { layers, .. } => state.put_real("water.stream", layers.porosity.clone()),
            Self::Still | Self::LogLaw { .. } | Self::Table { .. } => {}
        }
    }

    /// Takes it back.
    pub(crate) fn load(&mut self, state: &State) -> Result<(), MissingSection> {
        match self {
            Self::Coupled(coupled) => coupled.load(state),
            Self::Column { layers, .. } => {
                let porosity = state.real("water.stream")?;
                if porosity.len() != layers.len() {
                    return Err(MissingSection { name: "water.stream".to_owned(), kind: "real" });
                }
                layers.porosity.copy_from_slice(porosity);
                Ok(())
            }
            Self::Still | Self::LogLaw { .. } | Self::Table { .. } => Ok(()),
        }
    }

    /// Shear velocity [m/s], where there is one.
    pub fn shear_velocity(&self) -> Option<f64> {
        match self {
            Self::LogLaw { shear_velocity, .. } => Some(*shear_velocity),
            Self::Coupled(coupled) => Some(coupled.bottom_shear_velocity()),
            Self::Still | Self::Table { .. } | Self::Column { .. } => None,
        }
    }
}

/// Velocity [m/s] and rate of shear [1/s] at height `z` between points; at a kink those of the line above it.
fn between(height: &[f64], velocity: &[f64], z: f64) -> (f64, f64) {
    let k = height.partition_point(|h| *h <= z);
    if k == 0 {
        (velocity[0], 0.0)
    } else if k == height.len() {
        (velocity[k - 1], 0.0)
    } else {
        let shear = (velocity[k] - velocity[k - 1]) / (height[k] - height[k - 1]);
        (velocity[k - 1] + (z - height[k - 1]) * shear, shear)
    }
}

#[multiversion(targets = "simd")]
fn log_laws(p: &mut Parcel, shear_velocity: f64, per_roughness: f64, zero_level: f64) {
    for i in 0..p.rows() {
        p.flow[0][i] = log_law(p.height[i] - zero_level, shear_velocity, per_roughness);
    }
}
