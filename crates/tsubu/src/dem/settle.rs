//! Settling: the bed that a run begins with is made by the same engine, with everything that moves held still.

use super::engine::DemEngine;
use crate::engine::{Engine, Fault};
use crate::ledger::Ledger;
use crate::partner::Hosts;
use crate::wall::Pose;
use glam::DVec3;

/// Kinetic energy over the energy of a fall by one diameter below which a bed is at rest.
const AT_REST: f64 = 1e-6;
/// The same, above which it is not: after the longest time that it may take, what still moves a little is stopped.
const IN_MOTION: f64 = 1e-2;
/// More steps than any bed takes: where steps are as short as that, it would never come to rest.
const MOST_STEPS: u64 = 100_000_000;

impl DemEngine {
    /// Lets the grains fall for at most `time` [s] with all walls still, then sets the clock back to zero. Grains that have not
    /// come to rest by then are a fault.
    pub(super) fn settle(&mut self, time: f64) -> Result<(), Fault> {
        let poses: Vec<Pose> = self.walls.iter().map(|w| w.pose).collect();
        for wall in &mut self.walls {
            (wall.pose.velocity, wall.pose.spin) = (DVec3::ZERO, DVec3::ZERO);
        }
        self.clock.settling = true;
        // Driven grains stand as walls do; they get their velocity back when the run begins.
        for (velocity, inverse_mass) in self.grains.velocity.iter_mut().zip(&self.grains.inverse_mass) {
            if *inverse_mass == 0.0 {
                *velocity = DVec3::ZERO;
            }
        }
        let (mut hosts, mut ledger) = (Hosts::default(), Ledger::default());
        let block = (1e-2 / self.clock.dt).ceil() as u64;
        let fall = self.books.moved_mass * self.integration.gravity.length() * self.limits.smallest_diameter;
        let mut result = Ok(());
        let (mut left, mut at_rest) = (0.0, false);
        while self.clock.time() < time && self.clock.step < MOST_STEPS && result.is_ok() && !at_rest {
            let steps = block.min(MOST_STEPS - self.clock.step);
            result = self.advance(steps, &mut hosts, &mut ledger);
            let energies = self.grain_energies();
            left = energies.kinetic + energies.rotational;
            // Shortly after they are let go all grains are slow.
            at_rest = left <= AT_REST * fall && steps == block;
        }
        if result.is_ok() && !at_rest && (left > IN_MOTION * fall || self.clock.time() < time) {
            result = Err(self.unsettled(left / fall));
        }
        for (wall, pose) in self.walls.iter_mut().zip(poses) {
            wall.pose = pose;
        }
        self.clock.settling = false;
        (self.clock.step, self.clock.grain_steps) = (0, 0);
        self.grains.velocity.fill(DVec3::ZERO);
        self.grains.spin.fill(DVec3::ZERO);
        self.integration.bodies.stop();
        result
    }

    fn unsettled(&self, share: f64) -> Fault {
        let speeds = self.grains.velocity.iter().map(|velocity| velocity.length());
        let (fastest, speed) = speeds.enumerate().fold((0, 0.0), |most, one| if one.1 > most.1 { one } else { most });
        let grain = self.grains.id.get(fastest).map_or(0, |id| *id as usize);
        Fault::Unsettled { step: self.clock.step, time: self.clock.time(), grain, speed, share }
    }
}
