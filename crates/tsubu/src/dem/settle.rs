//! Settling: the bed that a run begins with is made by the same engine, with everything that moves held still.

use super::engine::DemEngine;
use crate::engine::{Engine, Fault};
use crate::ledger::Ledger;
use crate::partner::Hosts;
use crate::wall::Pose;
use glam::DVec3;

/// Kinetic energy over the energy of a fall by one diameter below which a bed is at rest.
const AT_REST: f64 = 1e-6;

impl DemEngine {
    /// Lets the grains fall for at most `time` [s] with all walls still, then sets the clock back to zero.
    pub(super) fn settle(&mut self, time: f64) -> Result<(), Fault> {
        let poses: Vec<Pose> = self.walls.iter().map(|w| w.pose).collect();
        for wall in &mut self.walls {
            (wall.pose.velocity, wall.pose.spin) = (DVec3::ZERO, DVec3::ZERO);
        }
        self.walls_held = true;
        // Driven grains stand as walls do; they get their velocity back when the run begins.
        for (velocity, inverse_mass) in self.grains.velocity.iter_mut().zip(&self.grains.inverse_mass) {
            if *inverse_mass == 0.0 {
                *velocity = DVec3::ZERO;
            }
        }
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
        for (wall, pose) in self.walls.iter_mut().zip(poses) {
            wall.pose = pose;
        }
        self.walls_held = false;
        (self.step, self.grain_steps) = (0, 0);
        self.grains.velocity.fill(DVec3::ZERO);
        self.grains.spin.fill(DVec3::ZERO);
        result
    }
}
