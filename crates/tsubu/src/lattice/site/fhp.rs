//! The lattice gases FHP as models of the engine, and what all gases in slots share: seats, and places in a checkpoint.

use super::{Model, Seat, section, wrong};
use crate::lattice::direction::Direction;
use crate::lattice::gas::collide::{REST, SLOTS};
use crate::lattice::gas::numbers::{NOBODY, Numbers};
use crate::lattice::gas::planes::Gas;
use crate::lattice::gas::sites::Sites;
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;

/// A gas whose particles have numbers.
#[derive(Clone, Debug)]
pub struct Fhp {
    gas: Gas,
    sites: Sites,
    numbers: Numbers,
    /// Sites where particles vanish, unless they are wall.
    outlets: Vec<usize>,
    /// Whether walls mirror.
    smooth: bool,
    /// Those who have vanished since somebody asked.
    removed: Vec<Seat>,
}

impl Fhp {
    /// A gas with the particles of `numbers`, on whose walls nobody is yet.
    pub fn new(gas: Gas, sites: Sites, numbers: Numbers, outlets: Vec<usize>, smooth: bool) -> Self {
        let mut fhp = Self { gas, sites, numbers, outlets, smooth, removed: Vec::new() };
        fhp.fill();
        fhp
    }

    /// The gas itself.
    pub fn gas(&self) -> &Gas {
        &self.gas
    }

    /// Gives the gas the particles of the numbers.
    fn fill(&mut self) {
        for site in 0..self.sites.count() {
            let (column, row) = self.sites.column_and_row(site);
            let state = self.numbers.state(site);
            if state != self.gas.site(column, row) {
                self.gas.set_site(column, row, state);
            }
        }
    }
}

impl Model for Fhp {
    fn advance(&mut self) -> Result<(), String> {
        self.gas.step();
        self.numbers.follow(&self.gas);
        for &site in &self.outlets {
            let (column, row) = self.sites.column_and_row(site);
            if self.numbers.state(site) != 0 && !self.gas.is_wall(column, row) {
                seats_at(&self.numbers, site, &mut |seat| self.removed.push(seat));
                self.gas.set_site(column, row, 0);
                self.numbers.clear(site);
            }
        }
        Ok(())
    }

    fn step(&self) -> u64 {
        self.gas.steps()
    }

    fn seats(&self, each: &mut dyn FnMut(Seat)) {
        seats(&self.numbers, self.sites.count(), each);
    }

    fn free(&mut self, site: usize, _outlet: bool) {
        let Self { gas, sites, smooth, .. } = self;
        let (column, row) = sites.column_and_row(site);
        gas.free(column, row);
        let is_wall = |site: usize| {
            let (column, row) = sites.column_and_row(site);
            gas.is_wall(column, row)
        };
        if *smooth {
            for (column, row, mirror) in sites.walls_beside(site, is_wall) {
                gas.wall(column, row, mirror);
            }
        }
    }

    fn limits(&self) -> (usize, f64) {
        (SLOTS, 1.0)
    }

    fn removed(&mut self) -> Vec<Seat> {
        std::mem::take(&mut self.removed)
    }

    fn enter(&mut self, grain: usize, site: usize) -> Option<Seat> {
        let (column, row) = self.sites.column_and_row(site);
        let state = self.numbers.state(site);
        let free = state >> Direction::S as u8 & 1 == 0 && !self.gas.is_wall(column, row);
        if free {
            self.gas.set_site(column, row, state | 1 << Direction::S as u8);
            self.numbers.set(site, Direction::S as usize, grain as u32);
        }
        free.then(|| seat(&self.numbers, grain, site, Direction::S as usize))
    }

    fn save(&self, state: &mut State) {
        save(&self.numbers, self.sites.count(), self.gas.steps(), state);
    }

    fn load(&mut self, state: &State) -> Result<(), MissingSection> {
        let (numbers, step) = load(self.sites, self.numbers.laps.len(), state)?;
        self.numbers = numbers;
        self.gas.set_steps(step);
        self.fill();
        Ok(())
    }
}

/// Grains of a gas in slots.
pub(super) fn seats(numbers: &Numbers, sites: usize, each: &mut dyn FnMut(Seat)) {
    (0..sites).for_each(|site| seats_at(numbers, site, each));
}

/// Those of one site.
pub(super) fn seats_at(numbers: &Numbers, site: usize, each: &mut dyn FnMut(Seat)) {
    for (slot, who) in numbers.at(site).into_iter().enumerate().filter(|(_, who)| *who != NOBODY) {
        each(seat(numbers, who as usize, site, slot));
    }
}

/// A grain in a slot of a site.
pub(super) fn seat(numbers: &Numbers, grain: usize, site: usize, slot: usize) -> Seat {
    let way = if slot == REST { [0.0; 3] } else { Direction::from_index(slot).unit() };
    Seat { grain, site, offset: [0.0; 2], velocity: [way[0], way[2]], laps: numbers.laps[grain] }
}

/// Writes where everybody is: site and slot in one number.
pub(super) fn save(numbers: &Numbers, sites: usize, step: u64, state: &mut State) {
    let mut places = vec![-1; numbers.laps.len()];
    for site in 0..sites {
        for (slot, who) in numbers.at(site).into_iter().enumerate().filter(|(_, who)| *who != NOBODY) {
            places[who as usize] = (site * SLOTS + slot) as i64;
        }
    }
    state.put_integer("gas.places", places);
    state.put_integer("gas.laps", numbers.laps.iter().flatten().map(|lap| i64::from(*lap)).collect::<Vec<_>>());
    state.put_integer("gas.step", vec![step as i64]);
}

/// Takes it back.
pub(super) fn load(sites: Sites, count: usize, state: &State) -> Result<(Numbers, u64), MissingSection> {
    let mut numbers = Numbers::new(sites, count);
    for (who, &place) in section(state, "gas.places", count)?.iter().enumerate() {
        if let Ok(place) = usize::try_from(place) {
            let (site, slot) = (place / SLOTS, place % SLOTS);
            if site >= sites.count() || numbers.at(site)[slot] != NOBODY {
                return Err(wrong("gas.places"));
            }
            numbers.set(site, slot, who as u32);
        }
    }
    let laps = section(state, "gas.laps", 2 * count)?;
    numbers.laps = laps.chunks_exact(2).map(|lap| [lap[0] as i32, lap[1] as i32]).collect();
    Ok((numbers, section(state, "gas.step", 1)?[0] as u64))
}
