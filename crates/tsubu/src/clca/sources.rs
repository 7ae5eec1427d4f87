//! Grains that come in by streams and go in removal regions.

use super::engine::{ClCaEngine, Rule};
use super::place::somewhere;
use crate::engine::Engine;
use crate::lattice::grid::EMPTY;
use crate::ledger::{Account, Ledger};
use crate::random::Purpose;

/// Attempts to find a free place for a grain of a stream in a step; the others wait for the next.
const ATTEMPTS: u64 = 40;

impl ClCaEngine {
    /// Grains of streams come in where there is room.
    pub(super) fn insert(&mut self, time: f64, ledger: &mut Ledger) {
        for stream in &mut self.streams {
            let due = ((time - stream.from) * stream.rate + 1.0).max(0.0) as usize;
            while stream.placed < due.min(stream.grains.len()) {
                let (grain, look) = (stream.grains[stream.placed], self.bed.step);
                let found = somewhere(&self.bed, grain, &stream.region, &self.stage, Purpose::Stream, look, ATTEMPTS);
                let Some(cell) = found else { break };
                self.bed.add(grain.kind, cell, grain.id);
                stream.placed += 1;
                let weight = self.bed.kinds[grain.kind].mass * self.gravity;
                ledger.post(Account::Exchange, weight * self.stage.position(self.bed.vector(cell)).z);
            }
        }
    }

    /// Grains in removal regions go.
    pub(super) fn remove(&mut self, ledger: &mut Ledger) {
        if self.removal.is_empty() {
            return;
        }
        let inside = |grain: &usize| {
            let position = self.position(*grain);
            self.bed.kind(*grain).free && self.removal.iter().any(|removal| removal.takes(position.to_array()))
        };
        let removed: Vec<usize> = self.bed.present().filter(inside).collect();
        for &grain in &removed {
            let height = self.position(grain).z;
            let (kinetic, momentum) = (self.kinetic(), self.momentum());
            if let Rule::Active(_) = self.rule {
                self.bed.paint(grain, EMPTY);
            }
            self.bed.remove(grain);
            let taken = self.bed.kind(grain).mass * self.gravity * height + kinetic - self.kinetic();
            ledger.post(Account::Exchange, -taken);
            let now = self.momentum();
            for (axis, impulse) in ledger.exchange_impulse.iter_mut().enumerate() {
                *impulse += now[axis] - momentum[axis];
            }
        }
        if let (Rule::Active(active), false) = (&mut self.rule, removed.is_empty()) {
            active.wake_all(&self.bed);
        }
    }
}
