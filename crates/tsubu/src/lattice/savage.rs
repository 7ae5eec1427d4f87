//! After Savage (1993): grains on a square lattice that flow down a chute and sort themselves by size.
//!
//! A site holds one grain or none. In a step every grain tries, in an order drawn anew, to go straight down, down to
//! either side, to either side, and up, each if the site there is empty and with a chance of its own; it moves once at
//! most. On a slope both sideways chances lean downstream by the sine s of its angle, (1 + s)/2 to (1 - s)/2, so that
//! the flow is as fast as voids are many. Moves up stand for the disturbance of a bed that is sheared: without them voids
//! rise, the bed closes and only its surface flows. They leave, at rest and in flow, the share n of full sites
//!
//! ```text
//! n / (1 - n) = exp((z0 - z) / h),    h = 1 / ln(all downward chances / upward chance)      sites
//! ```
//!
//! and so a speed that falls as exp(-(z0 - z)/h) with depth. Sieving: a large grain cannot use every void that a small one
//! can; it goes down with the chance of the smallest times the ratio of diameters.
//!
//! A set of moves has one direction and one parity: no grain of it waits for another, and no two want one site. So the
//! order of grains is of no consequence.

use super::sheet::{EMPTY, OUT, Sheet, Trail};
use crate::about::About;
use crate::random::{Purpose, unit, words};

pub(crate) const ABOUT: About = About {
    key: "method.after-savage",
    formula: "on a square lattice a grain tries down, down to a side, to a side, up, each with a chance of its own; downstream chances (1 + s)/2, upstream (1 - s)/2\n\
n/(1 - n) = exp((z0 - z)/h), h = 1/ln(all downward chances over the upward one)",
    symbols: "s sine of the slope [-], n share of full sites [-], z height, h, z0 [sites]",
    limits: "Kinematic: no forces. Large grains go down with the chance of the smallest times the ratio of diameters.",
    reference: "after Savage 1993",
};

/// Chances of a grain of the smallest size to use an empty site [-].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moves {
    /// Straight down, p_d.
    pub down: f64,
    /// Down to either side, p_s: the two together.
    pub diagonal: f64,
    /// To either side, p_h: the two together.
    pub sideways: f64,
    /// Straight up.
    pub up: f64,
}

/// Grains on a chute.
#[derive(Clone, Debug)]
pub struct Chute {
    /// Who sits where.
    pub sheet: Sheet,
    /// Smallest diameter over that of every grain [-].
    pub sieve: Vec<f64>,
    /// Chances.
    pub moves: Moves,
    /// Sine of the angle of the slope, positive where it falls to the right.
    pub slope: f64,
    /// Whether the first column follows the last.
    pub wraps: bool,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Steps done.
    pub step: u64,
    /// The last move of every grain.
    pub trail: Trail,
}

const WAYS: [[isize; 2]; 6] = [[0, -1], [-1, -1], [1, -1], [-1, 0], [1, 0], [0, 1]];

impl Chute {
    /// Grains on a sheet.
    pub fn new(sheet: Sheet, sieve: Vec<f64>, moves: Moves, slope: f64, wraps: bool, seed: u64) -> Self {
        let trail = Trail::new(&sheet);
        Self { sheet, sieve, moves, slope, wraps, seed, step: 0, trail }
    }

    /// One step.
    pub fn advance(&mut self) {
        let mut order: [usize; 12] = std::array::from_fn(|k| k);
        for (last, coin) in (1..12).rev().zip((0..3).flat_map(|k| words(self.seed, Purpose::Order, k, self.step))) {
            order.swap(last, ((u64::from(coin) * (last as u64 + 1)) >> 32) as usize);
        }
        self.step += 1;
        for set in order {
            let way = WAYS[set / 2];
            let chance = self.chance(way);
            if chance > 0.0 {
                self.go(way, set % 2, chance);
            }
        }
    }

    fn chance(&self, way: [isize; 2]) -> f64 {
        let lean = 0.5 * (1.0 + self.slope * way[0] as f64);
        match way {
            [0, -1] => self.moves.down,
            [0, _] => self.moves.up,
            [_, -1] => lean * self.moves.diagonal,
            _ => lean * self.moves.sideways,
        }
    }

    /// All moves of one direction by grains of one parity.
    fn go(&mut self, way: [isize; 2], parity: usize, chance: f64) {
        let set = (way[0] + 1 + 3 * (way[1] + 1)) as u64;
        let (columns, rows) = (self.sheet.columns(), self.sheet.rows());
        // Along a row every other site is of the set, across rows every other row.
        let (across, along) = if way[1] == 0 { (1, 2) } else { (2, 1) };
        let first = |least: usize| least + (least + parity) % 2;
        for row in (if across == 2 { first(1) } else { 1 }..rows - 1).step_by(across) {
            for column in (if along == 2 { first(1) } else { 1 }..columns - 1).step_by(along) {
                let site = row * columns + column;
                let cell = self.sheet.cells[site];
                if cell < 0 {
                    continue;
                }
                let to = self.to(site, column, way);
                let there = self.sheet.cells[to];
                if there == EMPTY || there == OUT {
                    self.try_move(cell, site, to, way, set, chance);
                }
            }
        }
    }

    /// A grain moves with its chance, if it has not moved in this step.
    fn try_move(&mut self, cell: i32, site: usize, to: usize, way: [isize; 2], set: u64, chance: f64) {
        let grain = cell as usize;
        let chance = if way[1] < 0 { chance * self.sieve[grain] } else { chance };
        let coin = words(self.seed, Purpose::Side, cell as u32, self.step << 4 | set);
        if self.trail.0[grain].0 == self.step || unit(coin[0], coin[1]) >= chance {
            return;
        }
        self.sheet.cells[site] = EMPTY;
        if self.sheet.cells[to] == EMPTY {
            self.sheet.cells[to] = cell;
        } else {
            self.sheet.removed.push((cell, to));
        }
        self.trail.moves(cell, self.step, [2 * way[0] as i32, way[1] as i32]);
    }

    /// The site that way; the one on the other side where columns wrap.
    fn to(&self, site: usize, column: usize, way: [isize; 2]) -> usize {
        let columns = self.sheet.columns() as isize;
        let to = site.wrapping_add_signed(way[0] + way[1] * columns);
        let beyond = column.wrapping_add_signed(way[0]);
        if !self.wraps || (1..self.sheet.columns() - 1).contains(&beyond) {
            to
        } else {
            to.wrapping_add_signed(-way[0] * (columns - 2))
        }
    }
}
