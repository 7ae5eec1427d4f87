//! Grains that fall, slide, stop and are knocked loose: a lattice gas for piles (after Karolyi and Kertesz 1998).
//!
//! A site holds at most one grain at rest and at most one flying in each direction; a grain at rest lies on what is straight
//! below it. Few grains fly at a time, so they are a list. They move from the lowest up, each once a step. Here is who
//! is where; `step.rs` has the rules.

mod step;

use super::sites::Sites;
use crate::about::About;
use crate::lattice::direction::Direction;

pub(crate) const ABOUT: About = About {
    key: "method.after-karolyi-kertesz",
    formula: "a flying grain is turned downward with probability `gravity`; one that hits stays low with `dissipation`; one that slides stops, and one that is hit holds, with the `friction` of its kind",
    symbols: "probabilities [-]",
    limits: "At most one grain at rest a site; slopes come out of probabilities, not out of a coefficient of friction.",
    reference: "after Karolyi and Kertesz 1998",
};

/// What happens how often.
#[derive(Clone, Debug, PartialEq)]
pub struct Habits {
    /// Probability that gravity turns a flying grain by 60 degrees downward in a step.
    pub gravity: f64,
    /// Probability that a grain which hits another or a wall stays low instead of leaping off.
    pub dissipation: f64,
    /// Probability that a grain which slides over others stops, in a step; that one which is hit holds; for each kind.
    pub friction: Vec<f64>,
}

/// Nobody is at rest in a site.
const NOBODY: u32 = u32::MAX;
/// The site is wall. Else the number of a grain.
const WALL: u32 = u32::MAX - 1;

/// A flying grain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Flyer {
    row: u32,
    column: u32,
    way: u8,
    who: u32,
}

/// Where a grain is: at rest in a site, or flying from there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// The site.
    pub site: usize,
    /// Where it flies; `None`: it rests.
    pub way: Option<Direction>,
}

/// A pile, and what flies around it.
#[derive(Clone, Debug)]
pub struct Pile {
    /// Who is next to whom.
    pub sites: Sites,
    habits: Habits,
    seed: u64,
    step: u64,
    /// Who is at rest in a site.
    rest: Vec<u32>,
    /// Directions in which somebody flies, by site.
    taken: Vec<u8>,
    flyers: Vec<Flyer>,
    /// Kind of every grain by its number.
    kinds: Vec<u32>,
    /// Grains that left the lattice or were cleared, removed since somebody took note, and from where.
    pub removed: Vec<(u32, Place)>,
    /// Grains at rest that were knocked loose or lost their ground.
    loosened: u64,
    /// How often each grain has crossed the high end of a periodic x, less how often the low one.
    pub laps: Vec<i32>,
}

impl Pile {
    /// An empty lattice without walls; grains that leave it at open sides or below are removed.
    pub fn new(sites: Sites, habits: Habits, seed: u64) -> Self {
        let (rest, taken) = (vec![NOBODY; sites.count()], vec![0; sites.count()]);
        let (flyers, kinds, laps) = (Vec::new(), Vec::new(), Vec::new());
        Self { sites, habits, seed, step: 0, rest, taken, flyers, kinds, removed: Vec::new(), loosened: 0, laps }
    }

    /// Makes a site a wall.
    pub fn set_wall(&mut self, column: usize, row: usize) {
        self.rest[self.sites.index(column, row)] = WALL;
    }

    /// Makes a wall a free site; whoever lay on it falls.
    pub fn free(&mut self, site: usize) {
        if self.rest[site] == WALL {
            self.rest[site] = NOBODY;
            let (column, row) = self.sites.column_and_row(site);
            self.fall_from_above(column, row);
        }
    }

    /// The kind of the grain at rest in a site.
    pub fn at_rest(&self, column: usize, row: usize) -> Option<usize> {
        self.who_rests(column, row).map(|who| self.kinds[who as usize] as usize)
    }

    /// The number of the grain at rest in a site.
    fn who_rests(&self, column: usize, row: usize) -> Option<u32> {
        let who = self.rest[self.sites.index(column, row)];
        (who != NOBODY && who != WALL).then_some(who)
    }

    /// Says of what kind a new grain is; its number. It is not there yet.
    pub fn announce(&mut self, kind: u32) -> u32 {
        self.kinds.push(kind);
        self.laps.push(0);
        self.kinds.len() as u32 - 1
    }

    /// Lets a new grain of a kind go at a site, downward; false if somebody is there.
    pub fn drop_at(&mut self, column: usize, row: usize, kind: u32) -> bool {
        let free = self.is_open(column, row);
        if free {
            let who = self.announce(kind);
            self.launch(column, row, Direction::S, who);
        }
        free
    }

    /// Lets an announced grain go at a site, downward; false if somebody is there.
    pub fn release(&mut self, site: usize, who: u32) -> bool {
        let (column, row) = self.sites.column_and_row(site);
        let free = self.is_open(column, row);
        if free {
            self.launch(column, row, Direction::S, who);
        }
        free
    }

    /// Whether a grain can be let go downward at a site.
    fn is_open(&self, column: usize, row: usize) -> bool {
        let site = self.sites.index(column, row);
        self.rest[site] == NOBODY && self.taken[site] & 1 << Direction::S as u8 == 0
    }

    /// Puts an announced grain to rest on a site, or lets it go if there is no ground below; from the lowest up.
    pub fn lay(&mut self, site: usize, who: u32) {
        let (column, row) = self.sites.column_and_row(site);
        self.stop(column, row, who);
    }

    /// Where every grain is; `None`: not there.
    pub fn places(&self) -> Vec<Option<Place>> {
        let mut places = vec![None; self.kinds.len()];
        for (site, &who) in self.rest.iter().enumerate().filter(|(_, who)| **who < WALL) {
            places[who as usize] = Some(Place { site, way: None });
        }
        for flyer in &self.flyers {
            let site = self.sites.index(flyer.column as usize, flyer.row as usize);
            places[flyer.who as usize] = Some(Place { site, way: Some(Direction::from_index(flyer.way.into())) });
        }
        places
    }

    /// Puts announced grains where they were at another time, and goes on from the steps done then.
    pub fn restore(&mut self, places: &[Option<Place>], step: u64) {
        self.rest.iter_mut().filter(|who| **who != WALL).for_each(|who| *who = NOBODY);
        self.taken.fill(0);
        self.flyers.clear();
        for (who, place) in places.iter().enumerate() {
            match *place {
                Some(Place { site, way: Some(way) }) => {
                    let (column, row) = self.sites.column_and_row(site);
                    self.launch(column, row, way, who as u32);
                }
                Some(Place { site, way: None }) => self.rest[site] = who as u32,
                None => {}
            }
        }
        self.step = step;
    }

    /// Takes everybody from some sites who is there; on walls nobody is.
    pub fn clear(&mut self, sites: &[bool]) {
        let Self { sites: lattice, taken, removed, .. } = self;
        self.flyers.retain(|flyer| {
            let site = lattice.index(flyer.column as usize, flyer.row as usize);
            if sites[site] {
                taken[site] &= !(1 << flyer.way);
                removed.push((flyer.who, Place { site, way: Some(Direction::from_index(usize::from(flyer.way))) }));
            }
            !sites[site]
        });
        for site in (0..sites.len()).filter(|site| sites[*site]) {
            if self.rest[site] < WALL {
                if self.rest[site] != NOBODY {
                    self.removed.push((self.rest[site], Place { site, way: None }));
                }
                self.rest[site] = NOBODY;
                let (column, row) = self.sites.column_and_row(site);
                self.fall_from_above(column, row);
            }
        }
    }

    /// Steps done.
    pub fn steps(&self) -> u64 {
        self.step
    }

    /// Number of grains that fly.
    pub fn flying(&self) -> usize {
        self.flyers.len()
    }

    /// How many grains at rest have been knocked loose or have lost their ground so far.
    pub fn loosened(&self) -> u64 {
        self.loosened
    }

    /// Number of grains, at rest and flying.
    pub fn grains(&self) -> u64 {
        let resting = self.rest.iter().filter(|&&who| who < WALL).count();
        (resting + self.flyers.len()) as u64
    }

    /// Height of the pile in a column: one row above its highest grain at rest.
    pub fn height(&self, column: usize) -> usize {
        (0..self.sites.rows).rev().find(|&row| self.at_rest(column, row).is_some()).map_or(0, |row| row + 1)
    }

    fn launch(&mut self, column: usize, row: usize, way: Direction, who: u32) {
        self.taken[self.sites.index(column, row)] |= 1 << way as u8;
        self.flyers.push(Flyer { row: row as u32, column: column as u32, way: way as u8, who });
    }

    /// Whether a grain finds room next to a site: nobody rests there. Beyond the lattice there is room.
    fn room(&self, column: usize, row: usize, way: Direction) -> bool {
        self.sites.neighbour(column, row, way).is_none_or(|(c, r)| self.rest[self.sites.index(c, r)] == NOBODY)
    }
}

#[cfg(test)]
mod tests {
    use super::super::sites::Sites;
    use super::{Habits, Pile};
    use proptest::prelude::*;

    proptest! {
        /// Grains that were dropped rest, fly, or are removed; who rests lies on something.
        #[test]
        fn grains_are_kept(g in 0.1..1.0_f64, d in 0.3..1.0_f64, rough in 0.0..0.9_f64, edge in 0_usize..6) {
            let habits = Habits { gravity: g, dissipation: d, friction: vec![0.1, rough] };
            let mut pile = Pile::new(Sites::new(31, 60, [false, false]), habits, 7);
            (edge..31 - edge).for_each(|column| pile.set_wall(column, 0));
            let mut dropped = 0;
            for step in 0..400 {
                dropped += u64::from(pile.drop_at(10 + step % 12, 55, step as u32 % 2));
                pile.step();
                prop_assert_eq!(pile.grains() + pile.removed.len() as u64, dropped);
            }
        }

        /// In a closed box that is filled to its lid nobody gets into the walls or is lost.
        #[test]
        fn a_box_holds_its_grains(d in 0.0..1.0_f64, rough in 0.0..1.0_f64, wraps: bool) {
            let habits = Habits { gravity: 0.5, dissipation: d, friction: vec![rough] };
            let sites = Sites::new(8, 12, [wraps, false]);
            let mut pile = Pile::new(sites, habits, 3);
            for column in 0..8 {
                let side = !wraps && column % 7 == 0;
                (0..12).filter(|row| side || row % 11 == 0).for_each(|row| pile.set_wall(column, row));
            }
            pile.set_wall(4, 6);
            let mut dropped = 0;
            for step in 0..600 {
                dropped += u64::from(pile.drop_at(1 + step % 6, 10, 0));
                pile.step();
                let places = pile.places();
                prop_assert_eq!(places.iter().flatten().count(), dropped as usize);
                let inside = |site: usize| (1..11).contains(&(site % 12)) && (wraps || (1..7).contains(&(site / 12)));
                prop_assert!(places.iter().flatten().all(|p| inside(p.site) && p.site != 4 * 12 + 6));
            }
        }
    }
}
