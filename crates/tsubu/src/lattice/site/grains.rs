//! The lattice grains of Gutt and Haff as a model of the engine.

use super::{Link, Model, Seat, section, wrong};
use crate::lattice::grid::EMPTY;
use crate::lattice::gutt_haff::{Grain, LatticeGrains};
use crate::view::Wants;
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;

/// A grain as it is, or as it went.
fn seat(grains: &[Grain], grain: usize) -> Seat {
    let Grain { node, offset, velocity, .. } = grains[grain];
    Seat { grain, site: node, offset, velocity, laps: [0; 2] }
}

impl Model for LatticeGrains {
    fn advance(&mut self) -> Result<(), String> {
        self.advance().map_err(|fast| {
            format!(
                "grain {} would fly {:.2} spacings in a step; shorten `gutt-haff.time-step`, at most one is allowed",
                fast.grain, fast.speed
            )
        })
    }

    fn step(&self) -> u64 {
        self.step
    }

    fn seats(&self, each: &mut dyn FnMut(Seat)) {
        for grain in (0..self.grains.len()).filter(|grain| !self.grains[*grain].removed) {
            each(seat(&self.grains, grain));
        }
    }

    fn removed(&mut self) -> Vec<Seat> {
        std::mem::take(&mut self.removed).into_iter().map(|grain| seat(&self.grains, grain)).collect()
    }

    fn free(&mut self, site: usize, outlet: bool) {
        self.grid.set(site, EMPTY);
        self.outlet[site] = outlet;
    }

    fn offers(&self) -> Wants {
        Wants::WALLS
    }

    fn links(&self) -> Vec<Link> {
        let link = |p: &crate::lattice::gutt_haff::Push| Link {
            from: self.grains[p.grain].node,
            to: p.node,
            force: p.impulse,
        };
        self.pushes.iter().map(link).collect()
    }

    fn contacts(&self) -> usize {
        self.contacts
    }

    fn save(&self, state: &mut State) {
        state.put_integer("nodes.step", vec![self.step as i64, self.contacts as i64]);
        let nodes = self.grains.iter().map(|g| if g.removed { -1 } else { g.node as i64 });
        state.put_integer("nodes.node", nodes.collect::<Vec<_>>());
        let numbers = self.grains.iter().flat_map(|g| [g.velocity[0], g.velocity[1], g.offset[0], g.offset[1]]);
        state.put_real("nodes.motion", numbers.collect::<Vec<_>>());
    }

    fn load(&mut self, state: &State) -> Result<(), MissingSection> {
        let count = self.grains.len();
        let nodes = section(state, "nodes.node", count)?;
        let motion = state.real("nodes.motion")?;
        let numbers = section(state, "nodes.step", 2)?;
        let cells = (self.grid.columns() * self.grid.rows()) as i64;
        if motion.len() != 4 * count || nodes.iter().any(|node| !(-1..cells).contains(node)) {
            return Err(wrong("nodes.node"));
        }
        for grain in self.grains.iter().filter(|grain| !grain.removed) {
            self.grid.set(grain.node, EMPTY);
        }
        for (index, grain) in self.grains.iter_mut().enumerate() {
            let m = &motion[4 * index..];
            (grain.velocity, grain.offset) = ([m[0], m[1]], [m[2], m[3]]);
            grain.removed = nodes[index] < 0;
            if !grain.removed {
                grain.node = nodes[index] as usize;
                self.grid.set(grain.node, index as i32);
            }
        }
        (self.step, self.contacts) = (numbers[0] as u64, numbers[1] as usize);
        self.pushes.clear();
        Ok(())
    }
}
