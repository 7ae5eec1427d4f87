//! A lattice gas in bit planes.
//!
//! A column of sites is a row of bits, 64 sites a word, and every slot of a site (six directions and rest) has a plane of its
//! own. Columns run along gravity and odd ones stand half a spacing higher, as in [`crate::lattice::grid`].

use super::bits::WIDE;
use super::chance::Odds;
use super::collide::{Rules, SLOTS};
use super::step::{BLOCK, Spec, at, close};
use super::sweep::{Field, Sweep};
use crate::lattice::direction::{Direction, Vector};
use crate::random::{Purpose, unit, words};
use rayon::prelude::*;

/// A lattice gas.
#[derive(Clone, Debug)]
pub struct Gas {
    columns: usize,
    rows: usize,
    periodic: [bool; 2],
    spec: Spec,
    now: Vec<u64>,
    sweep: Sweep,
    solid: Vec<u64>,
    smooth: [Vec<u64>; 2],
}

impl Gas {
    /// An empty gas without walls.
    ///
    /// # Panics
    ///
    /// Where columns of one kind would meet: a lattice periodic along x needs an even number of them.
    pub fn new(rules: Rules, columns: usize, rows: usize, periodic: [bool; 2], seed: u64) -> Self {
        assert!(!periodic[0] || columns.is_multiple_of(2), "odd columns stand higher");
        let blocks = rows.div_ceil(64 * WIDE).next_multiple_of(2);
        let length = (blocks + 2) * BLOCK;
        let spec = Spec { rules, blocks, seed, step: 0, force: [Odds::default(); 2], negative: [false; 2] };
        // What lies beyond the last row is wall, so that nothing is done there.
        let mut solid = vec![0; columns * blocks * WIDE];
        for column in solid.chunks_exact_mut(blocks * WIDE) {
            for (word, bits) in column.iter_mut().enumerate().skip(rows / 64) {
                *bits = if word == rows / 64 { !0 << (rows % 64) } else { !0 };
            }
        }
        Self {
            columns,
            rows,
            periodic,
            spec,
            now: vec![0; columns * length],
            sweep: Sweep::new(columns, blocks),
            solid,
            smooth: [Vec::new(), Vec::new()],
        }
    }

    /// Columns and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.columns, self.rows]
    }

    /// Steps done.
    pub fn steps(&self) -> u64 {
        self.spec.step
    }

    /// Goes on as if so many steps had been done.
    pub fn set_steps(&mut self, steps: u64) {
        self.spec.step = steps;
    }

    /// Puts a force: the mean number of turns that a site which can make one makes in a step, along x and z, with the sign
    /// of the force.
    pub fn push(&mut self, odds: [f64; 2]) {
        self.spec.force = odds.map(|o| Odds::new(o.abs()));
        self.spec.negative = odds.map(|o| o < 0.0);
    }

    /// The word of a plane that a row is in, and its bit there.
    #[inline]
    fn word(row: usize) -> (usize, u64) {
        (row / 64, 1 << (row % 64))
    }

    /// Words of a column.
    #[inline]
    fn length(&self) -> usize {
        (self.spec.blocks + 2) * BLOCK
    }

    /// Makes a site a wall; `smooth` is Some(0) for an upright smooth one, Some(1) for one that lies flat.
    pub fn wall(&mut self, column: usize, row: usize, smooth: Option<usize>) {
        let (word, bit) = Self::word(row);
        let at = column * self.spec.blocks * WIDE + word;
        self.solid[at] |= bit;
        for plane in self.smooth.iter_mut().filter(|plane| !plane.is_empty()) {
            plane[at] &= !bit;
        }
        if let Some(axis) = smooth {
            let length = self.solid.len();
            self.smooth[axis].resize(length, 0);
            self.smooth[axis][at] |= bit;
        }
    }

    /// Makes a wall a site of the gas.
    pub fn free(&mut self, column: usize, row: usize) {
        let (word, bit) = Self::word(row);
        self.solid[column * self.spec.blocks * WIDE + word] &= !bit;
    }

    /// Whether a site is wall.
    pub fn is_wall(&self, column: usize, row: usize) -> bool {
        let (word, bit) = Self::word(row);
        self.solid[column * self.spec.blocks * WIDE + word] & bit != 0
    }

    /// Who is in a site: bit i for slot i.
    pub fn site(&self, column: usize, row: usize) -> u8 {
        let (word, bit) = Self::word(row);
        (0..SLOTS).map(|slot| u8::from(self.now[self.at(column, slot, word)] & bit != 0) << slot).sum()
    }

    /// Puts somebody into a site.
    pub fn set_site(&mut self, column: usize, row: usize, state: u8) {
        let (word, bit) = Self::word(row);
        for slot in 0..SLOTS {
            let at = self.at(column, slot, word);
            self.now[at] = self.now[at] & !bit | if state >> slot & 1 == 1 { bit } else { 0 };
        }
        self.close(column);
    }

    /// Fills every free site at random; `share` tells for a column, row and slot how likely it is taken.
    pub fn scatter(&mut self, share: impl Fn(usize, usize, usize) -> f64) {
        let slots = if self.spec.rules == Rules::One { 6 } else { SLOTS };
        for column in 0..self.columns {
            for row in 0..self.rows {
                if self.is_wall(column, row) {
                    continue;
                }
                let mut state = 0;
                for slot in 0..slots {
                    let entity = (column * self.rows + row) as u32;
                    let w = words(self.spec.seed, Purpose::Placement, entity, slot as u64);
                    state |= u8::from(unit(w[0], w[1]) < share(column, row, slot)) << slot;
                }
                let (word, bit) = Self::word(row);
                for slot in 0..slots {
                    let at = self.at(column, slot, word);
                    self.now[at] = self.now[at] & !bit | if state >> slot & 1 == 1 { bit } else { 0 };
                }
            }
            self.close(column);
        }
    }

    #[inline]
    fn at(&self, column: usize, slot: usize, word: usize) -> usize {
        column * self.length() + at(slot, word)
    }

    fn close(&mut self, column: usize) {
        let length = self.length();
        let planes = &mut self.now[column * length..(column + 1) * length];
        close(planes, self.spec.blocks, self.rows, self.periodic[1]);
    }

    /// One step.
    pub fn step(&mut self) {
        self.go(false);
    }

    /// So many steps, two in a sweep: the same as one after the other, but the memory is read and written once for both.
    pub fn steps_on(&mut self, count: u64) {
        (0..count / 2).for_each(|_| self.go(true));
        if count % 2 == 1 {
            self.go(false);
        }
    }

    fn go(&mut self, two: bool) {
        let Self { columns: _, rows, periodic, spec, now, sweep, solid, smooth } = self;
        let field = Field { spec: *spec, solid, smooth: [&smooth[0], &smooth[1]], rows: *rows, periodic: *periodic };
        sweep.run(&field, now, two);
        spec.step += if two { 2 } else { 1 };
    }

    /// How many there are in each slot of a column, walls included.
    pub fn counts(&self, column: usize) -> [u64; SLOTS] {
        let mut counts = [0; SLOTS];
        let length = self.length();
        let column = &self.now[column * length..(column + 1) * length];
        for block in column[BLOCK..length - BLOCK].chunks_exact(BLOCK) {
            for (count, words) in counts.iter_mut().zip(block.chunks_exact(WIDE)) {
                *count += words.iter().map(|w| u64::from(w.count_ones())).sum::<u64>();
            }
        }
        if self.periodic[1] && self.rows / 64 < self.spec.blocks * WIDE {
            // What waits beyond the last row is there already, in the first.
            for (slot, count) in counts.iter_mut().enumerate() {
                *count -= column[at(slot, self.rows / 64)] >> (self.rows % 64) & 1;
            }
        }
        counts
    }

    /// Molecular chaos: shifts every slot of every column along the column by its own random number of words. Sums over
    /// columns stay, and nobody remembers whom he met.
    ///
    /// # Panics
    ///
    /// Unless columns are closed in themselves and of whole words.
    pub fn forget(&mut self) {
        assert!(self.periodic[1] && self.rows.is_multiple_of(64), "words move as a whole");
        let (count, length) = (self.rows / 64, self.length());
        let Spec { seed, step, .. } = self.spec;
        self.now.par_chunks_exact_mut(length).enumerate().for_each(|(number, column)| {
            let mut plane = vec![0; count];
            for slot in 0..SLOTS {
                let drawn = words(seed, Purpose::Order, (number * SLOTS + slot) as u32, step)[0];
                let by = ((u64::from(drawn) * count as u64) >> 32) as usize;
                for (word, kept) in plane.iter_mut().enumerate() {
                    *kept = column[at(slot, word)];
                }
                for (word, kept) in plane.iter().enumerate() {
                    column[at(slot, (word + by) % count)] = *kept;
                }
            }
        });
        (0..self.columns).for_each(|column| self.close(column));
    }

    /// What the force gave in the last sweep, of one step or of two, in the basis (h, k).
    pub fn pushed(&self) -> Vector {
        let turns = self.sweep.turns().map(|turns| turns as i64);
        let sign = self.spec.negative.map(|n| if n { -1 } else { 1 });
        Vector { h: 2 * sign[0] * turns[0], k: 4 * sign[1] * turns[1] }
    }

    /// Number of particles.
    pub fn mass(&self) -> u64 {
        (0..self.columns).flat_map(|c| self.counts(c)).sum()
    }

    /// Momentum in the basis (h, k).
    pub fn momentum(&self) -> Vector {
        (0..self.columns).fold(Vector::default(), |sum, c| sum.plus(momentum(&self.counts(c))))
    }
}

/// Momentum of so many particles in each slot, in the basis (h, k).
pub fn momentum(counts: &[u64; SLOTS]) -> Vector {
    Direction::ALL.iter().zip(counts).fold(Vector::default(), |sum, (d, n)| sum.plus(d.times(*n as i64)))
}

#[cfg(test)]
mod tests;
