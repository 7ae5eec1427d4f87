//! A pile after Hemmingsson and Herrmann as a model of the engine: a step is a row, and nothing moves.

use super::{ForceUnit, Link, Model, Seat, section, wrong};
use crate::lattice::hemmingsson_herrmann::{Passed, Pile};
use crate::view::Wants;
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;

/// A pile and the forces known so far.
#[derive(Clone, Debug)]
pub struct Stack {
    /// The pile.
    pub pile: Pile,
    /// Forces, in the order in which they were found.
    pub passed: Vec<Passed>,
}

impl Model for Stack {
    fn advance(&mut self) -> Result<(), String> {
        let Self { pile, passed } = self;
        pile.advance(&mut |force| passed.push(force));
        Ok(())
    }

    fn step(&self) -> u64 {
        self.pile.step
    }

    fn seats(&self, each: &mut dyn FnMut(Seat)) {
        for (site, &cell) in self.pile.sheet.cells.iter().enumerate() {
            if let Ok(grain) = usize::try_from(cell) {
                each(Seat { grain, site, offset: [0.0; 2], velocity: [0.0; 2], laps: [0; 2] });
            }
        }
    }

    fn removed(&mut self) -> Vec<Seat> {
        Vec::new()
    }

    fn free(&mut self, _site: usize, _outlet: bool) {}

    fn offers(&self) -> Wants {
        Wants::CONTACTS.and(Wants::WALLS)
    }

    fn links(&self) -> Vec<Link> {
        self.passed.iter().map(|p| Link { from: p.from, to: p.to, force: [p.force[0], -p.force[1]] }).collect()
    }

    fn contacts(&self) -> usize {
        self.passed.len()
    }

    fn force_unit(&self) -> ForceUnit {
        ForceUnit::Newton
    }

    fn save(&self, state: &mut State) {
        let pile = &self.pile;
        state.put_integer("pile.step", vec![pile.step as i64]);
        state.put_real("pile.load", pile.load.iter().flatten().copied().collect::<Vec<_>>());
        state.put_real("pile.open", vec![pile.unbalanced, pile.falling]);
        let sites = self.passed.iter().flat_map(|p| [p.from as i64, p.to as i64]);
        state.put_integer("pile.pairs", sites.collect::<Vec<_>>());
        state.put_real("pile.forces", self.passed.iter().flat_map(|p| p.force).collect::<Vec<_>>());
    }

    fn load(&mut self, state: &State) -> Result<(), MissingSection> {
        let (load, open) = (state.real("pile.load")?, state.real("pile.open")?);
        let (pairs, forces) = (state.integer("pile.pairs")?, state.real("pile.forces")?);
        let sites = self.pile.sheet.cells.len();
        let inside = pairs.iter().all(|&site| (0..sites as i64).contains(&site));
        if load.len() != 2 * sites || open.len() != 2 || pairs.len() != forces.len() || !inside {
            return Err(wrong("pile.load"));
        }
        for (to, from) in self.pile.load.iter_mut().zip(load.chunks_exact(2)) {
            *to = [from[0], from[1]];
        }
        (self.pile.unbalanced, self.pile.falling) = (open[0], open[1]);
        self.pile.step = section(state, "pile.step", 1)?[0] as u64;
        let passed = pairs.chunks_exact(2).zip(forces.chunks_exact(2));
        self.passed = passed
            .map(|(pair, force)| Passed { from: pair[0] as usize, to: pair[1] as usize, force: [force[0], force[1]] })
            .collect();
        Ok(())
    }
}
