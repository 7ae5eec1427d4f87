//! The void models, and sheets of grains that only hop, as models of the engine.

use super::{Model, Seat, section, wrong};
use crate::lattice::caram_hong::CaramHong;
use crate::lattice::litwiniszyn::Litwiniszyn;
use crate::lattice::sheet::{EMPTY, OUT, ROW_SPACING, Sheet, Trail};
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;

/// Grains of a sheet, with the moves of the last step; rows are `row` spacings apart.
pub(super) fn seats(sheet: &Sheet, trail: &Trail, step: u64, row: f64, each: &mut dyn FnMut(Seat)) {
    for (site, &cell) in sheet.cells.iter().enumerate() {
        if let Ok(grain) = usize::try_from(cell) {
            let [half, rows] = trail.during(grain, step);
            let velocity = [0.5 * f64::from(half), row * f64::from(rows)];
            each(Seat { grain, site, offset: [0.0; 2], velocity, laps: [0; 2] });
        }
    }
}

/// Writes who sits where, and the last moves.
pub(super) fn save(sheet: &Sheet, trail: &Trail, step: u64, state: &mut State) {
    state.put_integer("sites.cells", sheet.cells.iter().map(|&cell| i64::from(cell)).collect::<Vec<_>>());
    state.put_integer("sites.step", vec![step as i64]);
    state.put_integer("sites.moved", trail.0.iter().map(|(step, _)| *step as i64).collect::<Vec<_>>());
    let ways = trail.0.iter().flat_map(|(_, way)| way.map(i64::from));
    state.put_integer("sites.ways", ways.collect::<Vec<_>>());
}

/// Takes them back; the step.
pub(super) fn load(sheet: &mut Sheet, trail: &mut Trail, state: &State) -> Result<u64, MissingSection> {
    let grains = trail.0.len() as i64;
    let cells = section(state, "sites.cells", sheet.cells.len())?;
    if cells.iter().any(|cell| !(i64::from(OUT)..grains).contains(cell)) {
        return Err(wrong("sites.cells"));
    }
    for (cell, value) in sheet.cells.iter_mut().zip(cells) {
        *cell = *value as i32;
    }
    let moved = section(state, "sites.moved", trail.0.len())?;
    let ways = section(state, "sites.ways", 2 * trail.0.len())?;
    for (index, entry) in trail.0.iter_mut().enumerate() {
        *entry = (moved[index] as u64, [ways[2 * index] as i32, ways[2 * index + 1] as i32]);
    }
    Ok(section(state, "sites.step", 1)?[0] as u64)
}

impl Model for Litwiniszyn {
    fn advance(&mut self) -> Result<(), String> {
        self.advance(&mut |_| ());
        Ok(())
    }

    fn step(&self) -> u64 {
        self.step
    }

    fn seats(&self, each: &mut dyn FnMut(Seat)) {
        seats(&self.sheet, &self.trail, self.step, ROW_SPACING, each);
    }

    fn free(&mut self, site: usize) {
        self.sheet.cells[site] = EMPTY;
    }

    fn save(&self, state: &mut State) {
        save(&self.sheet, &self.trail, self.step, state);
    }

    fn load(&mut self, state: &State) -> Result<(), MissingSection> {
        self.step = load(&mut self.sheet, &mut self.trail, state)?;
        Ok(())
    }
}

impl Model for CaramHong {
    fn advance(&mut self) -> Result<(), String> {
        self.advance(&mut |_| ());
        Ok(())
    }

    fn step(&self) -> u64 {
        self.step
    }

    fn seats(&self, each: &mut dyn FnMut(Seat)) {
        seats(&self.sheet, &self.trail, self.step, ROW_SPACING, each);
    }

    fn free(&mut self, site: usize) {
        self.sheet.cells[site] = EMPTY;
        self.count_anew();
    }

    fn save(&self, state: &mut State) {
        save(&self.sheet, &self.trail, self.step, state);
    }

    fn load(&mut self, state: &State) -> Result<(), MissingSection> {
        self.step = load(&mut self.sheet, &mut self.trail, state)?;
        self.count_anew();
        Ok(())
    }
}
