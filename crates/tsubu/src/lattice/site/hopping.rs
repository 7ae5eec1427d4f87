//! Models whose grains only hop on a sheet, voids and the chute, as models of the engine.

use super::{Model, Seat, section, wrong};
use crate::lattice::caram_hong::CaramHong;
use crate::lattice::litwiniszyn::Litwiniszyn;
use crate::lattice::savage::Chute;
use crate::lattice::sheet::{EMPTY, OUT, ROW_SPACING, Sheet, Trail};
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;

/// Grains that hop on a sheet.
pub(super) trait Hopping: Send {
    /// Distance of its rows [spacings].
    const ROW: f64;

    /// One step.
    fn hop(&mut self);

    /// How far a grain goes in a step at most [spacings].
    fn reach(&self) -> f64;

    /// Who sits where, the last moves, and steps done.
    fn seen(&self) -> (&Sheet, &Trail, u64);

    /// The same, to be changed.
    fn parts(&mut self) -> (&mut Sheet, &mut Trail, &mut u64);

    /// Somebody else has changed the sheet.
    fn look_anew(&mut self) {}
}

/// A grain that has just moved as the trail says, or not at all.
fn seat<H: Hopping>(grain: usize, site: usize, trail: &Trail, step: u64) -> Seat {
    let [half, rows] = trail.during(grain, step);
    let velocity = [0.5 * f64::from(half), H::ROW * f64::from(rows)];
    Seat { grain, site, offset: [0.0; 2], velocity, laps: [0; 2] }
}

impl<H: Hopping> Model for H {
    fn advance(&mut self) -> Result<(), String> {
        self.hop();
        Ok(())
    }

    fn step(&self) -> u64 {
        self.seen().2
    }

    fn seats(&self, each: &mut dyn FnMut(Seat)) {
        let (sheet, trail, step) = self.seen();
        for (site, &cell) in sheet.cells.iter().enumerate() {
            if let Ok(grain) = usize::try_from(cell) {
                each(seat::<H>(grain, site, trail, step));
            }
        }
    }

    fn free(&mut self, site: usize, outlet: bool) {
        self.parts().0.cells[site] = if outlet { OUT } else { EMPTY };
        self.look_anew();
    }

    fn limits(&self) -> (usize, f64) {
        (1, self.reach())
    }

    fn removed(&mut self) -> Vec<Seat> {
        let removed = std::mem::take(&mut self.parts().0.removed);
        let (_, trail, step) = self.seen();
        removed.into_iter().map(|(grain, site)| seat::<H>(grain as usize, site, trail, step)).collect()
    }

    fn save(&self, state: &mut State) {
        let (sheet, trail, step) = self.seen();
        state.put_integer("sites.cells", sheet.cells.iter().map(|&cell| i64::from(cell)).collect::<Vec<_>>());
        state.put_integer("sites.step", vec![step as i64]);
        state.put_integer("sites.moved", trail.0.iter().map(|(step, _)| *step as i64).collect::<Vec<_>>());
        let ways = trail.0.iter().flat_map(|(_, way)| way.map(i64::from));
        state.put_integer("sites.ways", ways.collect::<Vec<_>>());
    }

    fn load(&mut self, state: &State) -> Result<(), MissingSection> {
        let (sheet, trail, step) = self.parts();
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
        *step = section(state, "sites.step", 1)?[0] as u64;
        self.look_anew();
        Ok(())
    }
}

impl Hopping for Litwiniszyn {
    const ROW: f64 = ROW_SPACING;

    fn hop(&mut self) {
        self.advance(&mut |_| ());
    }

    /// Voids of several outlets may meet the same grain.
    fn reach(&self) -> f64 {
        f64::INFINITY
    }

    fn seen(&self) -> (&Sheet, &Trail, u64) {
        (&self.sheet, &self.trail, self.step)
    }

    fn parts(&mut self) -> (&mut Sheet, &mut Trail, &mut u64) {
        (&mut self.sheet, &mut self.trail, &mut self.step)
    }

    fn look_anew(&mut self) {
        self.find_outlets();
    }
}

impl Hopping for CaramHong {
    const ROW: f64 = ROW_SPACING;

    fn hop(&mut self) {
        self.advance(&mut |_| ());
    }

    fn reach(&self) -> f64 {
        1.0
    }

    fn seen(&self) -> (&Sheet, &Trail, u64) {
        (&self.sheet, &self.trail, self.step)
    }

    fn parts(&mut self) -> (&mut Sheet, &mut Trail, &mut u64) {
        (&mut self.sheet, &mut self.trail, &mut self.step)
    }

    fn look_anew(&mut self) {
        self.count_anew();
    }
}

/// The chute after Savage.
impl Hopping for Chute {
    const ROW: f64 = 1.0;

    fn hop(&mut self) {
        self.advance();
    }

    /// Across the seam of columns that wrap it is the whole width.
    fn reach(&self) -> f64 {
        if self.wraps { f64::INFINITY } else { std::f64::consts::SQRT_2 }
    }

    fn seen(&self) -> (&Sheet, &Trail, u64) {
        (&self.sheet, &self.trail, self.step)
    }

    fn parts(&mut self) -> (&mut Sheet, &mut Trail, &mut u64) {
        (&mut self.sheet, &mut self.trail, &mut self.step)
    }
}
