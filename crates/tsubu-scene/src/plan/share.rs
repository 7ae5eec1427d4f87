//! What of a structure one of several cavities carries.

use super::{Host, Signal, Structure};

impl Host {
    /// The share of one of its `copies`: matrices, modal masses and forces divided by their number, so that it moves under the grains of one as the whole
    /// does under those of all. A base, which has no mass, stays.
    #[must_use]
    pub fn share(&self) -> Self {
        let share = 1.0 / self.copies;
        let mut host = self.clone();
        host.copies = 1.0;
        let scale = |values: &mut [f64]| {
            for value in values {
                *value *= share;
            }
        };
        match &mut host.structure {
            Structure::Shaker {} => {}
            Structure::Oscillator { mass, stiffness, damping, cubic_stiffness } => {
                for value in [mass, stiffness, damping, cubic_stiffness] {
                    *value *= share;
                }
            }
            Structure::Matrices { mass, damping, stiffness, gyroscopic, .. } => {
                for row in
                    [Some(mass), Some(damping), Some(stiffness), gyroscopic.as_mut()].into_iter().flatten().flatten()
                {
                    scale(row);
                }
            }
            Structure::Modes { mode } => {
                for mode in mode {
                    mode.mass *= share;
                }
            }
            Structure::Pendulum { inertia, damping, moment, .. } => {
                for value in [inertia, damping, moment] {
                    *value *= share;
                }
            }
        }
        if let Some(force) = &mut host.force {
            weaken(force, share);
        }
        host
    }
}

/// So many times the signal.
fn weaken(signal: &mut Signal, share: f64) {
    match signal {
        Signal::Sine { amplitude, .. } | Signal::SineSweep { amplitude, .. } => *amplitude *= share,
        Signal::Impact { peak, .. } => *peak *= share,
        Signal::Shock { acceleration, .. } => *acceleration *= share,
        Signal::Sines { amplitude, offset, .. } => {
            for value in amplitude.iter_mut().chain([offset]) {
                *value *= share;
            }
        }
        Signal::Steady { rate } => *rate *= share,
        Signal::Table { value, .. } => {
            for value in value {
                *value *= share;
            }
        }
    }
}
