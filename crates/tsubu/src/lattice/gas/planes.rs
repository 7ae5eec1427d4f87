//! A lattice gas in bit planes.
//!
//! A column of sites is a row of bits, 64 sites a word, and every slot of a site (six directions and rest) has a plane of its
//! own. Columns run along gravity and odd ones stand half a spacing higher, as in [`crate::lattice::grid`].

use super::bits::WIDE;
use super::chance::Odds;
use super::collide::{Rules, SLOTS};
use super::step::{BLOCK, Spec};
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

/// Where a word of a slot's plane is in its column.
#[inline]
fn at(slot: usize, word: usize) -> usize {
    (1 + word / WIDE) * BLOCK + slot * WIDE + word % WIDE
}

/// Empties what lies beyond the last row and, where the ends of a column meet, shows each end what waits at the other.
pub(super) fn close(column: &mut [u64], blocks: usize, rows: usize, periodic: bool) {
    for slot in 0..SLOTS {
        let end = rows / 64;
        if !rows.is_multiple_of(64) {
            column[at(slot, end)] &= (1 << (rows % 64)) - 1;
        }
        for word in rows.div_ceil(64)..blocks * WIDE {
            column[at(slot, word)] = 0;
        }
        if periodic {
            let top = column[at(slot, (rows - 1) / 64)] >> ((rows - 1) % 64) & 1;
            column[slot * WIDE + WIDE - 1] = top << 63;
            column[at(slot, end)] |= (column[at(slot, 0)] & 1) << (rows % 64);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Gas;
    use crate::lattice::direction::{Direction, Vector};
    use crate::lattice::gas::bits::WIDE;
    use crate::lattice::gas::chance::fair;
    use crate::lattice::gas::collide::{REST, Rules, SLOTS, collide};
    use crate::lattice::gas::step::MIRRORED;
    use crate::random::Purpose;

    /// A box with one smooth and three rough sides, or walls on two sides, or none.
    fn filled(rules: Rules, columns: usize, rows: usize, periodic: [bool; 2]) -> Gas {
        let mut gas = Gas::new(rules, columns, rows, periodic, 9);
        for row in (0..rows).filter(|_| !periodic[0]) {
            gas.wall(0, row, Some(0));
            gas.wall(columns - 1, row, None);
        }
        for column in (0..columns).filter(|_| !periodic[1]) {
            gas.wall(column, 0, Some(1));
            gas.wall(column, rows - 1, None);
        }
        gas.scatter(|_, _, _| 0.4);
        gas
    }

    /// One step site by site, as the rules are told.
    fn plain(gas: &Gas) -> Vec<u8> {
        let [columns, rows] = gas.size();
        let mut next = Vec::new();
        for column in 0..columns {
            for row in 0..rows {
                let half = 2 * row as i64 + column as i64 % 2;
                let mut n = [0_u64; SLOTS];
                for (slot, n) in n.iter_mut().enumerate() {
                    let way = if slot == REST { Vector::default() } else { Direction::from_index(slot).times(1) };
                    let wrap = |at: i64, size: usize, ends: bool| {
                        if ends {
                            Some(at.rem_euclid(size as i64))
                        } else {
                            (0..size as i64).contains(&at).then_some(at)
                        }
                    };
                    let from = wrap(column as i64 - way.h, columns, gas.periodic[0]).and_then(|c| {
                        let row = (half - way.k - c % 2).div_euclid(2);
                        wrap(row, rows, gas.periodic[1]).map(|r| gas.site(c as usize, r as usize))
                    });
                    *n = u64::from(from.unwrap_or(0) >> slot & 1);
                }
                let pairs = gas.spec.blocks / 2;
                let place = column * pairs + row / (128 * WIDE);
                let word = row / 64;
                let turn =
                    fair(9, Purpose::Turn, place as u32, gas.steps())[word / WIDE % 2].0[word % WIDE] >> (row % 64);
                let (at, bit) = (column * gas.spec.blocks * WIDE + word, row % 64);
                let smooth = (0..2).find(|&a: &usize| gas.smooth[a].get(at).is_some_and(|w| w >> bit & 1 == 1));
                let mut new = if gas.is_wall(column, row) { n } else { collide(gas.spec.rules, n, turn) };
                for (slot, new) in
                    new.iter_mut().enumerate().filter(|(slot, _)| *slot != REST && gas.is_wall(column, row))
                {
                    *new = n[smooth.map_or((slot + 3) % 6, |axis| MIRRORED[axis][slot])];
                }
                next.push((0..SLOTS).map(|slot| ((new[slot] & 1) as u8) << slot).sum());
            }
        }
        next
    }

    fn sites(gas: &Gas) -> Vec<u8> {
        let [columns, rows] = gas.size();
        (0..columns).flat_map(|c| (0..rows).map(move |r| (c, r))).map(|(c, r)| gas.site(c, r)).collect()
    }

    /// 64 sites at once do what one site after the other would do; particles are kept, and momentum where nothing stands in
    /// the way.
    #[test]
    fn words_do_what_sites_do() {
        for rules in [Rules::One, Rules::Two, Rules::Three] {
            for (columns, rows, periodic) in
                [(6, 64, [true, true]), (40, 131, [true, true]), (7, 90, [false, false]), (9, 1100, [false, true])]
            {
                let mut gas = filled(rules, columns, rows, periodic);
                let (mass, momentum) = (gas.mass(), gas.momentum());
                for _ in 0..4 {
                    let wanted = plain(&gas);
                    gas.step();
                    assert!(sites(&gas) == wanted, "{rules:?} {columns} x {rows}");
                    assert_eq!(gas.mass(), mass);
                }
                if periodic == [true, true] {
                    assert_eq!(gas.momentum(), momentum);
                } else {
                    assert_ne!(gas.momentum(), momentum);
                }
            }
        }
    }

    /// Two steps at once do what two steps do: over the borders of strips, at walls, at ends that meet and under a force.
    #[test]
    fn two_at_once_are_two() {
        for (columns, rows, periodic) in
            [(640, 2000, [true, true]), (637, 1100, [false, true]), (150, 90, [false, false]), (2, 64, [true, true])]
        {
            let mut gas = filled(Rules::Three, columns, rows, periodic);
            gas.push([0.01, -0.02]);
            let mut pushed = [Vector::default(); 2];
            let mut other = gas.clone();
            for _ in 0..3 {
                gas.steps_on(2);
                pushed[0] = pushed[0].plus(gas.pushed());
                for _ in 0..2 {
                    other.step();
                    pushed[1] = pushed[1].plus(other.pushed());
                }
                assert!(sites(&gas) == sites(&other), "{columns} x {rows}");
            }
            assert_eq!((pushed[0], gas.steps()), (pushed[1], other.steps()));
        }
    }

    /// The same bits for any number of threads: strips do not see each other.
    #[test]
    fn same_bits_on_any_number_of_threads() {
        let run = |threads: usize| {
            let mut gas = filled(Rules::Three, 640, 2000, [true, true]);
            gas.push([0.01, -0.02]);
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            pool.install(|| (0..10).for_each(|_| gas.step()));
            assert!(gas.sweep.strips() > 2);
            sites(&gas)
        };
        let one = run(1);
        assert!(one == run(2) && one == run(7));
    }

    /// What a force gives is what the momentum gains.
    #[test]
    fn pushes_are_counted() {
        let mut gas = filled(Rules::Two, 20, 200, [true, true]);
        gas.push([0.2, -0.1]);
        for _ in 0..5 {
            let before = gas.momentum();
            gas.step();
            assert_eq!(gas.momentum(), before.plus(gas.pushed()));
            assert!(gas.pushed().h > 0 && gas.pushed().k < 0);
        }
    }
}
