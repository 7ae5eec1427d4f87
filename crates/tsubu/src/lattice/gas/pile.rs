//! Grains that fall, slide, stop and are knocked loose: a lattice gas for piles (after Karolyi and Kertesz 1998).
//!
//! A site holds at most one grain at rest and at most one flying in each direction; a grain at rest lies on what is straight
//! below it. Few grains fly at a time, so they are a list. They move from the lowest up, each once a step.

use crate::lattice::direction::Direction;
use crate::random::{Purpose, unit, words};

/// What happens how often.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Habits {
    /// Probability that gravity turns a flying grain by 60 degrees downward in a step.
    pub gravity: f64,
    /// Probability that a grain which hits another or a wall stays low instead of leaping off.
    pub dissipation: f64,
    /// Probability that a grain which slides over others stops, in a step; that one which is hit holds; for each kind.
    pub friction: [f64; 2],
}

/// What is at rest in a site: nobody, a grain of kind 0 or 1, or wall.
const NOBODY: u8 = 0;
const WALL: u8 = 3;

/// A flying grain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Flyer {
    row: u32,
    column: u32,
    way: u8,
    kind: u8,
}

/// A pile, and what flies around it.
#[derive(Clone, Debug)]
pub struct Pile {
    columns: usize,
    rows: usize,
    habits: Habits,
    seed: u64,
    step: u64,
    rest: Vec<u8>,
    /// Directions in which somebody flies, by site.
    taken: Vec<u8>,
    flyers: Vec<Flyer>,
    /// Grains that left the lattice, by kind.
    gone: [u64; 2],
    /// Grains at rest that were knocked loose or lost their ground.
    loosened: u64,
}

impl Pile {
    /// An empty lattice without walls; grains that leave it at the sides or below are gone.
    pub fn new(columns: usize, rows: usize, habits: Habits, seed: u64) -> Self {
        let sites = columns * rows;
        let (rest, taken) = (vec![NOBODY; sites], vec![0; sites]);
        Self { columns, rows, habits, seed, step: 0, rest, taken, flyers: Vec::new(), gone: [0; 2], loosened: 0 }
    }

    /// Makes a site a wall.
    pub fn set_wall(&mut self, column: usize, row: usize) {
        self.rest[column * self.rows + row] = WALL;
    }

    /// The kind of the grain at rest in a site.
    pub fn at_rest(&self, column: usize, row: usize) -> Option<usize> {
        let who = self.rest[column * self.rows + row];
        (who != NOBODY && who != WALL).then(|| usize::from(who) - 1)
    }

    /// Lets a grain of a kind go at a site, downward; false if somebody is there.
    pub fn drop_at(&mut self, column: usize, row: usize, kind: usize) -> bool {
        let site = column * self.rows + row;
        let free = self.rest[site] == NOBODY && self.taken[site] & 1 << Direction::S as u8 == 0;
        if free {
            self.launch(column, row, Direction::S, kind as u8);
        }
        free
    }

    /// Steps done.
    pub fn steps(&self) -> u64 {
        self.step
    }

    /// Number of grains that fly.
    pub fn flying(&self) -> usize {
        self.flyers.len()
    }

    /// Grains that left, by kind.
    pub fn gone(&self) -> [u64; 2] {
        self.gone
    }

    /// How many grains at rest have been knocked loose or have lost their ground so far.
    pub fn loosened(&self) -> u64 {
        self.loosened
    }

    /// Number of grains, at rest and flying.
    pub fn grains(&self) -> u64 {
        let resting = self.rest.iter().filter(|&&who| who != NOBODY && who != WALL).count();
        (resting + self.flyers.len()) as u64
    }

    /// Height of the pile in a column: one row above its highest grain at rest.
    pub fn height(&self, column: usize) -> usize {
        (0..self.rows).rev().find(|&row| self.at_rest(column, row).is_some()).map_or(0, |row| row + 1)
    }

    fn launch(&mut self, column: usize, row: usize, way: Direction, kind: u8) {
        self.taken[column * self.rows + row] |= 1 << way as u8;
        self.flyers.push(Flyer { row: row as u32, column: column as u32, way: way as u8, kind });
    }

    /// The neighbour of a site; `None` beyond the lattice.
    fn neighbour(&self, column: usize, row: usize, way: Direction) -> Option<(usize, usize)> {
        let to = usize::try_from(column as i64 + way.h()).ok().filter(|c| *c < self.columns)?;
        let row = (2 * row as i64 + (column % 2) as i64 + way.k() - (to % 2) as i64) >> 1;
        Some((to, usize::try_from(row).ok().filter(|r| *r < self.rows)?))
    }

    /// Whether a grain finds room next to a site: nobody rests there. Beyond the lattice there is room.
    fn room(&self, column: usize, row: usize, way: Direction) -> bool {
        self.neighbour(column, row, way).is_none_or(|(c, r)| self.rest[c * self.rows + r] == NOBODY)
    }

    /// One step: every flying grain moves, stops, or takes another direction.
    pub fn step(&mut self) {
        let mut flyers = std::mem::take(&mut self.flyers);
        flyers.sort_unstable();
        for flyer in flyers {
            self.fly(flyer);
        }
        self.step += 1;
    }

    fn fly(&mut self, flyer: Flyer) {
        let Flyer { row, column, way, kind } = flyer;
        let (row, column) = (row as usize, column as usize);
        let site = column * self.rows + row;
        self.taken[site] &= !(1 << way);
        let draw = words(self.seed, Purpose::Rebound, site as u32, self.step << 3 | u64::from(way));
        let chance = |index: usize| unit(draw[index], draw[(index + 1) % 4]);
        let left = draw[3] & 1 == 0;
        let mut way = Direction::from_index(usize::from(way));
        if way != Direction::S && self.room(column, row, Direction::S) && chance(0) < self.habits.gravity {
            way = match way {
                Direction::N if left => Direction::NW,
                Direction::N => Direction::NE,
                Direction::NE => Direction::SE,
                Direction::NW => Direction::SW,
                _ => Direction::S,
            };
        }
        if self.room(column, row, way) {
            let Some((c, r)) = self.neighbour(column, row, way) else {
                if way.k() < 0 || way.h() != 0 {
                    self.gone[usize::from(kind)] += 1;
                    return;
                }
                return self.turn(column, row, &[Direction::S], kind);
            };
            if self.taken[c * self.rows + r] & 1 << way as u8 != 0 {
                return self.turn(column, row, &[way], kind);
            }
            let slides = way.h() != 0 && way.k() < 0 && !self.room(c, r, Direction::S);
            if slides && chance(1) < self.habits.friction[usize::from(kind)] {
                return self.stop(c, r, kind);
            }
            return self.turn(c, r, &[way], kind);
        }
        self.knock(column, row, way, chance(2));
        let mirrored = |way: Direction| Direction::from_index((6 - way as usize) % 6);
        let sides = if left { [Direction::SW, Direction::SE] } else { [Direction::SE, Direction::SW] };
        if chance(1) >= self.habits.dissipation {
            let off = match way {
                Direction::S | Direction::N => [sides[0].opposite(), sides[1].opposite()],
                other => [mirrored(other), other.opposite()],
            };
            return self.turn(column, row, &off, kind);
        }
        let lower: Vec<Direction> = sides.into_iter().filter(|side| self.room(column, row, *side)).collect();
        if self.room(column, row, Direction::S) {
            self.turn(column, row, &[Direction::S, Direction::SW, Direction::SE], kind);
        } else if lower.is_empty() || chance(3) < self.habits.friction[usize::from(kind)] {
            self.stop(column, row, kind);
        } else {
            self.turn(column, row, &lower, kind);
        }
    }

    /// Goes on from a site in the first of some directions that nobody has, or in any other.
    fn turn(&mut self, column: usize, row: usize, ways: &[Direction], kind: u8) {
        let taken = self.taken[column * self.rows + row];
        let free = |way: &&Direction| taken & 1 << **way as u8 == 0;
        match ways.iter().find(free).or_else(|| Direction::ALL.iter().find(free)) {
            Some(way) => self.launch(column, row, *way, kind),
            None => self.stop(column, row, kind),
        }
    }

    /// Comes to rest at a site, or at the first one above it where nobody is; falls on if there is no ground.
    fn stop(&mut self, column: usize, mut row: usize, kind: u8) {
        while row + 1 < self.rows && self.rest[column * self.rows + row] != NOBODY {
            row += 1;
        }
        if self.room(column, row, Direction::S) && self.taken[column * self.rows + row] & 1 << Direction::S as u8 == 0 {
            return self.launch(column, row, Direction::S, kind);
        }
        self.rest[column * self.rows + row] = kind + 1;
    }

    /// The grain at rest that is in the way may be knocked loose; whoever lay on it falls.
    fn knock(&mut self, column: usize, row: usize, way: Direction, chance: f64) {
        let Some((c, r)) = self.neighbour(column, row, way) else { return };
        let Some(kind) = self.at_rest(c, r) else { return };
        if chance < self.habits.friction[kind] {
            return;
        }
        let sides = [Direction::SE, Direction::SW];
        let Some(side) = sides.into_iter().find(|side| self.room(c, r, *side)) else { return };
        self.rest[c * self.rows + r] = NOBODY;
        self.loosened += 1;
        self.turn(c, r, &[side], kind as u8);
        let mut above = r + 1;
        while above < self.rows
            && self.at_rest(c, above).is_some()
            && self.taken[c * self.rows + above] & 1 << Direction::S as u8 == 0
        {
            let who = self.rest[c * self.rows + above] - 1;
            self.rest[c * self.rows + above] = NOBODY;
            self.loosened += 1;
            self.launch(c, above, Direction::S, who);
            above += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Habits, Pile};
    use proptest::prelude::*;

    proptest! {
        /// Grains that were dropped rest, fly, or are gone; who rests lies on something.
        #[test]
        fn grains_are_kept(g in 0.1..1.0_f64, d in 0.3..1.0_f64, rough in 0.0..0.9_f64, edge in 0_usize..6) {
            let mut pile = Pile::new(31, 60, Habits { gravity: g, dissipation: d, friction: [0.1, rough] }, 7);
            (edge..31 - edge).for_each(|column| pile.set_wall(column, 0));
            let mut dropped = 0;
            for step in 0..400 {
                dropped += u64::from(pile.drop_at(10 + step % 12, 55, step % 2));
                pile.step();
                prop_assert_eq!(pile.grains() + pile.gone().iter().sum::<u64>(), dropped);
            }
        }
    }
}
