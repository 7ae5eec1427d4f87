//! Numbers for the particles of a gas, which has none of its own.
//!
//! Particles are alike: one that flies is known, and after a meeting nobody can say who is who. Those who come into a site go
//! on in the slots that are taken there afterwards, in the order of slots. So a number moves as one particle could have moved.

use super::collide::{REST, SLOTS};
use super::planes::Gas;
use super::sites::Sites;
use crate::lattice::direction::Direction;
use rayon::prelude::*;

/// Nobody is in the slot.
pub const NOBODY: u32 = u32::MAX;

/// Who is in the slots of a site.
pub type Crew = [u32; SLOTS];

/// An empty site.
pub const EMPTY: Crew = [NOBODY; SLOTS];

/// Who is in which slot, site by site, and how often he has left the lattice at one end to come in at the other.
#[derive(Clone, Debug)]
pub struct Numbers {
    sites: Sites,
    pub(super) crews: Vec<Crew>,
    pub(super) next: Vec<Crew>,
    /// How often each has crossed the high end of x and of z, less how often the low one.
    pub laps: Vec<[i32; 2]>,
}

impl Numbers {
    /// Numbers below `count` for particles of a lattice, none of them there yet.
    pub fn new(sites: Sites, count: usize) -> Self {
        let crews = vec![EMPTY; sites.count()];
        Self { sites, next: crews.clone(), crews, laps: vec![[0; 2]; count] }
    }

    /// Who is in the slots of a site.
    pub fn at(&self, site: usize) -> Crew {
        self.crews[site]
    }

    /// Puts a number into a slot, or takes it out ([`NOBODY`]).
    pub fn set(&mut self, site: usize, slot: usize, number: u32) {
        self.crews[site][slot] = number;
    }

    /// Nobody is in a site any more.
    pub fn clear(&mut self, site: usize) {
        self.crews[site] = EMPTY;
    }

    /// The slots of a site that are taken, bit by bit.
    pub fn state(&self, site: usize) -> u8 {
        (0..SLOTS).map(|slot| u8::from(self.crews[site][slot] != NOBODY) << slot).sum()
    }

    /// Counts who leaves at an end in the step to come.
    pub(super) fn cross(&mut self) {
        if self.sites.periodic == [false, false] {
            return;
        }
        for (column, row) in self.sites.edge() {
            let crew = self.crews[self.sites.index(column, row)];
            for way in Direction::ALL.into_iter().filter(|way| crew[*way as usize] != NOBODY) {
                self.lap(crew[way as usize], self.sites.crossing(column, row, way));
            }
        }
    }

    /// A particle crosses ends.
    pub(super) fn lap(&mut self, number: u32, [x, z]: [i32; 2]) {
        let laps = &mut self.laps[number as usize];
        *laps = [laps[0] + x, laps[1] + z];
    }

    /// Follows a gas through the step that it has just made.
    pub fn follow(&mut self, gas: &Gas) {
        self.cross();
        let (sites, crews) = (self.sites, &self.crews);
        self.next.par_chunks_mut(sites.rows).enumerate().for_each(|(column, next)| {
            for (row, next) in next.iter_mut().enumerate() {
                let mut came = EMPTY;
                came[REST] = crews[sites.index(column, row)][REST];
                for way in Direction::ALL {
                    if let Some((c, r)) = sites.neighbour(column, row, way.opposite()) {
                        came[way as usize] = crews[sites.index(c, r)][way as usize];
                    }
                }
                *next = if came == EMPTY { EMPTY } else { go_on(came, gas.site(column, row)) };
            }
        });
        std::mem::swap(&mut self.crews, &mut self.next);
    }
}

/// Who goes on in which slot of a site when those who came go on in the given slots.
#[inline]
pub(super) fn go_on(came: Crew, state: u8) -> Crew {
    let who = came.into_iter().filter(|who| *who != NOBODY);
    debug_assert_eq!(who.clone().count() as u32, state.count_ones(), "a particle was lost or made");
    let mut crew = EMPTY;
    for (slot, who) in (0..SLOTS).filter(|slot| state >> slot & 1 == 1).zip(who) {
        crew[slot] = who;
    }
    crew
}

#[cfg(test)]
mod tests {
    use super::super::collide::{Rules, SLOTS};
    use super::super::planes::Gas;
    use super::super::sites::Sites;
    use super::{NOBODY, Numbers};
    use crate::lattice::direction::{Direction, Vector};

    /// Numbers are where particles are, nobody's twice, and none jumps: with its laps every number has moved by one spacing
    /// or not at all.
    #[test]
    fn numbers_follow_a_gas() {
        let sites = Sites::new(20, 33, [true, true]);
        for rules in [Rules::One, Rules::Two, Rules::Three] {
            let mut gas = Gas::new(rules, 20, 33, [true, true], 5);
            (5..15).for_each(|column| gas.wall(column, 7, Some(1)));
            gas.scatter(|_, _, _| 0.3);
            gas.push([0.1, -0.2]);
            let mut numbers = Numbers::new(sites, gas.mass() as usize);
            let mut count = 0;
            for site in 0..sites.count() {
                let (column, row) = sites.column_and_row(site);
                for slot in (0..SLOTS).filter(|slot| gas.site(column, row) >> slot & 1 == 1) {
                    numbers.set(site, slot, count);
                    count += 1;
                }
            }
            let places = |numbers: &Numbers| {
                let mut places = vec![None; count as usize];
                for site in 0..sites.count() {
                    let (column, row) = sites.column_and_row(site);
                    for who in numbers.at(site).into_iter().filter(|who| *who != NOBODY) {
                        let [x, z] = numbers.laps[who as usize].map(i64::from);
                        let at = Vector { h: column as i64 + 20 * x, k: (2 * row + column % 2) as i64 + 66 * z };
                        assert!(places[who as usize].replace(at).is_none(), "{who} twice");
                    }
                }
                places
            };
            for _ in 0..60 {
                let before = places(&numbers);
                gas.step();
                numbers.follow(&gas);
                for site in 0..sites.count() {
                    let (column, row) = sites.column_and_row(site);
                    assert_eq!(numbers.state(site), gas.site(column, row));
                }
                for (from, to) in before.into_iter().zip(places(&numbers)) {
                    let (from, to) = (from.expect("there"), to.expect("there"));
                    let by = Vector { h: to.h - from.h, k: to.k - from.k };
                    let moves = by == Vector::default() || Direction::ALL.iter().any(|way| way.times(1) == by);
                    assert!(moves, "{by:?}");
                }
            }
            assert!(numbers.laps.iter().any(|laps| *laps != [0, 0]));
        }
    }
}
