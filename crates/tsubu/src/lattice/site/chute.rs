//! The chute after Savage as a model of the engine.

use super::{Model, Seat, voids};
use crate::lattice::savage::Chute;
use crate::lattice::sheet::EMPTY;
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;

impl Model for Chute {
    fn advance(&mut self) -> Result<(), String> {
        self.advance();
        Ok(())
    }

    fn step(&self) -> u64 {
        self.step
    }

    fn seats(&self, each: &mut dyn FnMut(Seat)) {
        voids::seats(&self.sheet, &self.trail, self.step, 1.0, each);
    }

    fn free(&mut self, site: usize) {
        self.sheet.cells[site] = EMPTY;
    }

    fn save(&self, state: &mut State) {
        voids::save(&self.sheet, &self.trail, self.step, state);
    }

    fn load(&mut self, state: &State) -> Result<(), MissingSection> {
        self.step = voids::load(&mut self.sheet, &mut self.trail, state)?;
        Ok(())
    }
}
