//! Lattice gases of grains: FHP-II that loses energy, under gravity, between rough or smooth walls (after Peng and Herrmann
//! 1994, 1995). Site by site: every grain needs random numbers of its own, and heaps of rest grains have to be let hop.
//! Here is who is where; `step.rs` has the rules.

mod step;

use super::collide::{Rules, SLOTS, collide};
use super::numbers::{Crew, Numbers};
use super::sites::Sites;
use crate::about::About;
use crate::lattice::direction::{Direction, Vector};

pub(crate) const ABOUT: About = About {
    key: "method.after-peng-herrmann",
    formula: "FHP-II; in a step gravity turns a particle by 60 degrees downward with a probability; those of a collision stay with the probability `dissipation`; a wall sends back with `roughness`",
    symbols: "probabilities [-]",
    limits: "Speeds are 0 or 1: no temperature but by directions.",
    reference: "after Peng and Herrmann 1994, 1995",
};

/// What the grains do beside flying and colliding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Habits {
    /// Probability that gravity turns a grain by 60 degrees downward in a step, or lets one at rest go.
    pub gravity: f64,
    /// Probability that the grains of a collision, as FHP-II knows them, stay where they met.
    pub dissipation: f64,
    /// Probability that a wall sends a grain back where it came from instead of mirroring it.
    pub roughness: f64,
}

/// Grains that came to rest on a site whose place for one was taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Surplus {
    /// Where.
    pub site: u32,
    /// How many there are.
    pub count: u8,
    /// Their numbers, the first to go first.
    pub who: Crew,
}

/// A gas of grains.
#[derive(Clone, Debug)]
pub struct Grains {
    /// Who is next to whom.
    pub sites: Sites,
    habits: Habits,
    pub(super) seed: u64,
    pub(super) step: u64,
    /// After a collision: by chirality and state.
    table: [[u8; 1 << SLOTS]; 2],
    pub(super) state: Vec<u8>,
    next: Vec<u8>,
    /// 0: gas; 1: an upright wall; 2: a wall that lies flat; 3: one that sends back whatever its roughness.
    pub(super) wall: Vec<u8>,
    /// Grains at rest that found no place.
    surplus: Vec<Surplus>,
    /// Who is who, if anybody asked.
    pub(super) numbers: Option<Numbers>,
    /// Axis of every grain by its number; nothing for round grains.
    pub(super) axes: Vec<u8>,
    /// Momentum that gravity gave in the last step, in the basis (h, k).
    pulled: Vector,
}

impl Grains {
    /// No grains and no walls.
    ///
    /// # Panics
    ///
    /// Where columns of one kind would meet: a lattice periodic along x needs an even number of them.
    pub fn new(columns: usize, rows: usize, periodic: [bool; 2], habits: Habits, seed: u64) -> Self {
        let sites = Sites::new(columns, rows, periodic);
        let mut table = [[0; 1 << SLOTS]; 2];
        for (turn, table) in table.iter_mut().enumerate() {
            for (state, after) in table.iter_mut().enumerate() {
                let n = std::array::from_fn(|slot| (state >> slot & 1) as u64);
                let new = collide(Rules::Two, n, turn as u64);
                *after = (0..SLOTS).map(|slot| ((new[slot] & 1) as u8) << slot).sum();
            }
        }
        Self {
            sites,
            habits,
            seed,
            step: 0,
            table,
            state: vec![0; sites.count()],
            next: vec![0; sites.count()],
            wall: vec![0; sites.count()],
            surplus: Vec::new(),
            numbers: None,
            axes: Vec::new(),
            pulled: Vector::default(),
        }
    }

    /// Makes a site a wall; `mirror` is Some(0) for an upright one, Some(1) for one that lies flat, None for one that
    /// always sends back.
    pub fn set_wall(&mut self, column: usize, row: usize, mirror: Option<usize>) {
        self.wall[self.sites.index(column, row)] = mirror.map_or(3, |axis| 1 + axis as u8);
    }

    /// Makes a wall a site of the gas.
    pub fn free(&mut self, site: usize) {
        self.wall[site] = 0;
    }

    /// Whether a site is wall.
    pub fn is_wall(&self, column: usize, row: usize) -> bool {
        self.wall[self.sites.index(column, row)] > 0
    }

    /// Puts grains into a site: bit i for slot i. Not in a gas whose grains have numbers.
    pub fn set_site(&mut self, column: usize, row: usize, state: u8) {
        self.state[self.sites.index(column, row)] = state;
    }

    /// Who is in a site.
    pub fn site(&self, column: usize, row: usize) -> u8 {
        self.state[self.sites.index(column, row)]
    }

    /// Steps done.
    pub fn steps(&self) -> u64 {
        self.step
    }

    /// Who is who, if the grains have numbers.
    pub fn numbers(&self) -> Option<&Numbers> {
        self.numbers.as_ref()
    }

    /// Grains at rest that found no place, in the order in which they look for one.
    pub fn surplus(&self) -> &[Surplus] {
        &self.surplus
    }

    /// Gives the grains of a gas the numbers of another time, where they were then, and the steps done.
    pub fn restore(&mut self, numbers: Numbers, surplus: Vec<Surplus>, step: u64) {
        (self.surplus, self.step) = (surplus, step);
        for (site, state) in self.state.iter_mut().enumerate() {
            *state = numbers.state(site);
        }
        self.numbers = Some(numbers);
    }

    /// Puts a grain with a number into a slot of a site; false if somebody is there.
    pub fn put(&mut self, site: usize, slot: usize, number: u32) -> bool {
        let free = self.wall[site] == 0 && self.state[site] >> slot & 1 == 0;
        if free {
            self.state[site] |= 1 << slot;
            if let Some(numbers) = &mut self.numbers {
                numbers.set(site, slot, number);
            }
        }
        free
    }

    /// Takes everybody from a site who is there; on walls nobody is removed.
    pub fn clear(&mut self, site: usize) {
        if self.wall[site] > 0 {
            return;
        }
        if self.state[site] > 0 {
            self.state[site] = 0;
            if let Some(numbers) = &mut self.numbers {
                numbers.clear(site);
            }
        }
        self.surplus.retain(|waiting| waiting.site as usize != site);
    }

    /// Momentum that gravity gave in the last step, in the basis (h, k).
    pub fn pulled(&self) -> Vector {
        self.pulled
    }

    /// Number of grains.
    pub fn mass(&self) -> u64 {
        let there: u64 = self.state.iter().map(|s| u64::from(s.count_ones())).sum();
        there + self.surplus.iter().map(|waiting| u64::from(waiting.count)).sum::<u64>()
    }

    /// Momentum in the basis (h, k).
    pub fn momentum(&self) -> Vector {
        let mut sum = Vector::default();
        for state in &self.state {
            for way in Direction::ALL {
                sum = sum.plus(way.times(i64::from(state >> way as u8 & 1)));
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::{Grains, Habits};
    use crate::lattice::direction::Vector;
    use proptest::prelude::*;

    fn scattered(habits: Habits, walls: bool, thinning: u32) -> Grains {
        let mut grains = Grains::new(10, 40, [true, !walls], habits, 4);
        for row in 0..40 {
            for column in 0..10 {
                if walls && (row % 39 == 0 || (column == 3 && row < 20)) {
                    grains.set_wall(column, row, Some(usize::from(row % 39 == 0)));
                } else {
                    let drawn =
                        crate::random::words(4, crate::random::Purpose::Placement, (column * 40 + row) as u32, 0);
                    grains.set_site(
                        column,
                        row,
                        (drawn[0] & drawn[1] & drawn[2] & drawn[3].rotate_left(thinning)) as u8 & 0x7F,
                    );
                }
            }
        }
        grains
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(40))]
        /// Nobody is lost, whatever the grains do, and walls keep them.
        #[test]
        fn grains_are_kept(g in 0.0..1.0_f64, d in 0.0..1.0_f64, r in 0.0..1.0_f64, walls: bool, thinning in 0_u32..32) {
            let habits = Habits { gravity: g, dissipation: d, roughness: r };
            let mut grains = scattered(habits, walls, thinning);
            let mass = grains.mass();
            for _ in 0..30 {
                grains.step();
                prop_assert_eq!(grains.mass(), mass);
            }
        }

        /// Without walls and dissipation momentum changes by what gravity gives.
        #[test]
        fn gravity_gives_all_momentum(g in 0.0..1.0_f64) {
            let mut grains = scattered(Habits { gravity: g, dissipation: 0.0, roughness: 1.0 }, false, 28);
            for _ in 0..20 {
                let Vector { h, k } = grains.momentum();
                grains.step();
                let given = grains.pulled();
                prop_assert_eq!(grains.momentum(), Vector { h: h + given.h, k: k + given.k });
            }
        }
    }
}
