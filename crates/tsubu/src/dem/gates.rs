//! Gates: walls that vanish at a time, between two steps.

use super::engine::DemEngine;
use crate::engine::Engine;
use crate::ledger::{Account, Ledger};

impl DemEngine {
    /// Whether walls vanish after step `step`. While grains settle they stay.
    pub(super) fn opens(&self, step: u64) -> bool {
        let time = step as f64 * self.dt;
        !self.walls_held && self.walls.iter().any(|wall| !wall.gone() && wall.goes_by(time))
    }

    /// Lets the walls vanish whose time has come. What their contacts held goes with them; motion and height of the grains
    /// do not change.
    pub(super) fn open_gates(&mut self, ledger: &mut Ledger) {
        let kept = self.kept();
        let before = self.grain_stocks().total();
        self.place_gates();
        self.find_with(kept);
        // What the springs of those contacts held is in the difference below.
        self.released = 0.0;
        self.stand();
        ledger.post(Account::Gates, self.grain_stocks().total() - before);
    }

    /// Lets every wall be there or not, as the time of this step wants.
    pub(super) fn place_gates(&mut self) {
        let time = self.time();
        for wall in &mut self.walls {
            wall.stand_or_go(time);
        }
    }
}
