//! Where a stream ends above, and how its water makes way for grains.
//!
//! Water moves along z as grains come, go and sink, with the velocity of the layer it comes from: momentum is carried, energy of mixing
//! is lost. Below a lid, water that is too much leaves at the top. A free surface stands as high as the water and the grains
//! below it need, S = integral of e dz, S volume of the water over the plan area; all layers stretch alike. Fed with a discharge q, a
//! reach of length L keeps what does not leave it: dS/dt = (q - discharge)/L, so the depth finds the one that carries q.

use super::{Coupled, Turnover};
use crate::water::Layers;
use glam::DVec3;

/// What a free surface may miss of the volume of water, over that volume.
const ROUND_OFF: f64 = 1e-14;

/// What ends a stream above.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Top {
    /// A lid that stays.
    Lid {
        /// Discharge per width that is held, by a pressure along the stream [m^2/s].
        discharge: Option<f64>,
    },
    /// A surface that finds its level.
    Free {
        /// Discharge per width that feeds the reach [m^2/s], and the length of the reach [m].
        supply: Option<(f64, f64)>,
    },
}

impl Top {
    /// The discharge that is asked for [m^2/s].
    pub(super) fn discharge(&self) -> Option<f64> {
        match *self {
            Self::Lid { discharge } => discharge,
            Self::Free { supply } => supply.map(|(discharge, _)| discharge),
        }
    }
}

impl Coupled {
    /// Whether its surface finds its level.
    pub fn is_free(&self) -> bool {
        matches!(self.top, Top::Free { .. })
    }

    /// Looks where the grains are, `seconds` [s] after the last look.
    #[expect(clippy::needless_range_loop, reason = "a grid: all columns at the same index")]
    pub fn look(&mut self, position: &[DVec3], radius: &[f64], seconds: f64) -> Turnover {
        let before = self.energy();
        let mut momentum: Vec<f64> = (0..self.layers.len()).map(|k| self.mass(k) * self.velocity[k]).collect();
        let held: Vec<f64> = (0..self.layers.len()).map(|k| self.layers.water(k)).collect();
        match self.top {
            Top::Lid { .. } => self.layers.porosity = self.layers.measure(position, radius),
            Top::Free { supply } => {
                let missing = supply.map_or(0.0, |(discharge, reach)| (discharge - self.discharge()) / reach);
                self.volume += seconds * missing;
                find_level(&mut self.layers, self.volume, position, radius);
            }
        }
        // Volume over plan area that goes up through the upper face of each layer.
        let mut up = 0.0;
        let mut turned = Turnover::default();
        for k in 0..momentum.len() {
            up += held[k] - self.layers.water(k);
            let inside = k + 1 < momentum.len();
            let donor = if up > 0.0 || !inside { k } else { k + 1 };
            let carried = self.density * up * self.velocity[donor];
            momentum[k] -= carried;
            if inside {
                momentum[k + 1] += carried;
            } else {
                // What leaves at the top, or comes in there, does so with the velocity of the top.
                self.impulses[0] -= carried * self.layers.area;
                turned.work = -0.5 * carried * self.velocity[k] * self.layers.area;
            }
        }
        for k in 0..momentum.len() {
            let now = momentum[k] / self.mass(k);
            self.ahead[k] += now - self.velocity[k];
            self.velocity[k] = now;
        }
        turned.lost = before + turned.work - self.energy();
        turned
    }
}

/// Stretches layers until they hold a volume of water over the plan area [m] beside the grains. What is missing is poured on top:
/// it never fills more than its own height, so the level comes up (or down) to where it belongs and not beyond.
fn find_level(layers: &mut Layers, volume: f64, position: &[DVec3], radius: &[f64]) {
    for _ in 0..200 {
        layers.porosity = layers.measure(position, radius);
        let missing = volume - layers.volume();
        if missing.abs() <= ROUND_OFF * volume {
            return;
        }
        layers.thickness += missing / layers.len() as f64;
    }
}
