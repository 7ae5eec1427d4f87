//! Settling: the bed that a run begins with is made by the same engine, with everything that moves held still.

use super::engine::DemEngine;
use crate::engine::{Engine, Fault};
use crate::ledger::Ledger;
use crate::partner::Hosts;
use glam::DVec3;

/// Kinetic energy over the energy of a fall by one diameter below which a bed is at rest.
const AT_REST: f64 = 1e-6;

impl DemEngine {
    /// Lets the grains fall for at most `time` [s] with all walls still, then sets the clock back to zero.
    pub(super) fn settle(&mut self, time: f64) -> Result<(), Fault> {
        let velocities: Vec<DVec3> =
            self.planes.iter_mut().map(|p| std::mem::replace(&mut p.velocity, DVec3::ZERO)).collect();
        self.walls_held = true;
        let (mut hosts, mut ledger) = (Hosts::default(), Ledger::default());
        let block = (1e-2 / self.dt).ceil() as u64;
        let fall = self.total_mass * self.gravity.length() * self.smallest_diameter;
        let mut result = Ok(());
        while self.time() < time && result.is_ok() {
            result = self.advance(block, &mut hosts, &mut ledger);
            let stocks = self.grain_stocks();
            if stocks.kinetic + stocks.rotational <= AT_REST * fall {
                break;
            }
        }
        for (plane, velocity) in self.planes.iter_mut().zip(velocities) {
            plane.velocity = velocity;
        }
        self.walls_held = false;
        self.step = 0;
        self.grains.velocity.fill(DVec3::ZERO);
        self.grains.spin.fill(DVec3::ZERO);
        result
    }
}
