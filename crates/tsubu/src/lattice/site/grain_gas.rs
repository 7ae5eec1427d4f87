//! The gases of grains after Peng and Herrmann, and after Baxter and Behringer, as models of the engine.

use super::{Model, Seat, fhp, section, wrong};
use crate::lattice::direction::Direction;
use crate::lattice::gas::collide::REST;
use crate::lattice::gas::elongated::Alignment;
use crate::lattice::gas::grains::{Grains, Surplus};
use crate::lattice::gas::numbers::{EMPTY, Numbers};
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;

/// Grains with numbers.
#[derive(Clone, Debug)]
pub struct GrainGas {
    grains: Grains,
    /// What lying alike is worth to elongated grains.
    alignment: Option<Alignment>,
    /// Sites where grains vanish, unless they are wall.
    outlets: Vec<usize>,
    /// Those who have vanished since somebody asked.
    removed: Vec<Seat>,
}

/// Grains at rest that wait at a site for a place.
fn waiting_seats(Surplus { site, count, who }: &Surplus, numbers: &Numbers, each: &mut dyn FnMut(Seat)) {
    for &who in &who[..usize::from(*count)] {
        each(fhp::seat(numbers, who as usize, *site as usize, REST));
    }
}

impl GrainGas {
    /// Grains with numbers; those to be aligned have axes.
    pub fn new(grains: Grains, alignment: Option<Alignment>, outlets: Vec<usize>) -> Self {
        Self { grains, alignment, outlets, removed: Vec::new() }
    }

    /// Takes note of those on an outlet, unless it is wall.
    fn note_gone(&mut self, site: usize) {
        let (column, row) = self.grains.sites.column_and_row(site);
        if self.grains.is_wall(column, row) {
            return;
        }
        let mut removed = std::mem::take(&mut self.removed);
        let numbers = self.numbers();
        fhp::seats_at(&numbers, site, &mut |seat| removed.push(seat));
        for waiting in self.grains.surplus().iter().filter(|waiting| waiting.site as usize == site) {
            waiting_seats(waiting, &numbers, &mut |seat| removed.push(seat));
        }
        self.removed = removed;
    }

    /// Who is who; nobody where nobody has a number.
    fn numbers(&self) -> std::borrow::Cow<'_, Numbers> {
        use std::borrow::Cow::{Borrowed, Owned};
        self.grains.numbers().map_or_else(|| Owned(Numbers::new(self.grains.sites, 0)), Borrowed)
    }
}

impl Model for GrainGas {
    fn advance(&mut self) -> Result<(), String> {
        self.grains.step();
        for index in 0..self.outlets.len() {
            let site = self.outlets[index];
            self.note_gone(site);
            self.grains.clear(site);
        }
        if let Some(alignment) = self.alignment {
            self.grains.align(alignment);
        }
        Ok(())
    }

    fn step(&self) -> u64 {
        self.grains.steps()
    }

    fn seats(&self, each: &mut dyn FnMut(Seat)) {
        let numbers = self.numbers();
        fhp::seats(&numbers, self.grains.sites.count(), each);
        for waiting in self.grains.surplus() {
            waiting_seats(waiting, &numbers, each);
        }
    }

    fn free(&mut self, site: usize, _outlet: bool) {
        let Self { grains, .. } = self;
        grains.free(site);
        let sites = grains.sites;
        let is_wall = |site: usize| {
            let (column, row) = sites.column_and_row(site);
            grains.is_wall(column, row)
        };
        for (column, row, mirror) in sites.walls_beside(site, is_wall) {
            grains.set_wall(column, row, mirror);
        }
    }

    /// Surplus grains hop on until they find room.
    fn limits(&self) -> (usize, f64) {
        (usize::MAX, f64::INFINITY)
    }

    fn removed(&mut self) -> Vec<Seat> {
        std::mem::take(&mut self.removed)
    }

    fn enter(&mut self, grain: usize, site: usize) -> Option<Seat> {
        let free = self.grains.put(site, Direction::S as usize, grain as u32);
        free.then(|| fhp::seat(&self.numbers(), grain, site, Direction::S as usize))
    }

    fn axis(&self, grain: usize) -> Option<[f64; 2]> {
        let way = Direction::from_index(usize::from(*self.grains.axes().get(grain)?)).unit();
        Some([way[0], way[2]])
    }

    fn save(&self, state: &mut State) {
        fhp::save(&self.numbers(), self.grains.sites.count(), self.grains.steps(), state);
        let waiting = self.grains.surplus().iter().map(|waiting| (waiting, usize::from(waiting.count)));
        let rows = waiting.flat_map(|(Surplus { site, count, who }, many)| {
            [i64::from(*site), i64::from(*count)].into_iter().chain(who[..many].iter().map(|who| i64::from(*who)))
        });
        state.put_integer("gas.waiting", rows.collect::<Vec<_>>());
        let axes = self.grains.axes().iter().map(|axis| i64::from(*axis));
        state.put_integer("gas.axes", axes.collect::<Vec<_>>());
    }

    fn load(&mut self, state: &State) -> Result<(), MissingSection> {
        let (sites, count) = (self.grains.sites, self.numbers().laps.len());
        let (numbers, step) = fhp::load(sites, count, state)?;
        let mut surplus = Vec::new();
        let mut rows = state.integer("gas.waiting")?;
        while let [site, many, rest @ ..] = rows {
            let (many, inside) = (*many as usize, (0..sites.count() as i64).contains(site));
            if !inside || many > rest.len().min(EMPTY.len()) || rest[..many].iter().any(|who| *who as usize >= count) {
                return Err(wrong("gas.waiting"));
            }
            let mut waiting = Surplus { site: *site as u32, count: many as u8, who: EMPTY };
            waiting.who.iter_mut().zip(rest).take(many).for_each(|(to, who)| *to = *who as u32);
            surplus.push(waiting);
            rows = &rest[many..];
        }
        let axes = section(state, "gas.axes", self.grains.axes().len())?;
        if axes.iter().any(|axis| !(0..3).contains(axis)) {
            return Err(wrong("gas.axes"));
        }
        self.grains.set_axes(axes.iter().map(|axis| *axis as u8).collect());
        self.grains.restore(numbers, surplus, step);
        Ok(())
    }
}
