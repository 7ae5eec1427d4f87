//! Gates: walls that vanish at a time, between two steps.

use super::engine::DemEngine;
use crate::engine::Engine;
use crate::ledger::{Account, Ledger};

impl DemEngine {
    /// Whether walls vanish after step `step`. While grains settle they stay.
    pub(super) fn gate_due(&self, step: u64) -> bool {
        let time = self.clock.time_of(step);
        !self.clock.settling && self.walls.iter().any(|wall| !wall.vanished() && wall.goes_by(time))
    }

    /// Lets the walls vanish whose time has come. What their contacts held goes with them; motion and height of the grains
    /// do not change.
    pub(super) fn open_gates(&mut self, ledger: &mut Ledger) {
        let history = self.snapshot_history();
        let before = self.grain_energies().total();
        self.place_gates();
        self.rebuild_neighbours_with(history);
        // What the springs of those contacts held is in the difference below.
        self.contacts.released = 0.0;
        self.evaluate_at_rest();
        ledger.post(Account::Gates, self.grain_energies().total() - before);
    }

    /// Lets every wall be there or not, as the time of this step wants.
    pub(super) fn place_gates(&mut self) {
        let time = self.clock.time();
        for wall in &mut self.walls {
            wall.stand_or_go(time);
        }
    }
}
