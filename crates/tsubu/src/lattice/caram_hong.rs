//! After Caram and Hong (1991): many voids at once, each to a site.
//!
//! A void swaps with one of the two grains above it, with the left one with probability p. If only one of them is a grain
//! it swaps with that one; if none is, it waits. Two voids that want one grain draw lots, and the loser looks again. The
//! same rule makes the surface: a grain slides while a site below it is empty, so that slopes rest at 60 degrees, the
//! slope of the lattice.
//!
//! Rows take turns: in a step the voids of every other row look up. A void on its way is always in the row whose turn it
//! is, and moves one row a step; so does a grain that falls. The pairs of rows of a step share no site, hence the order
//! in which they are done, and by whom, is of no consequence. Within a pair of rows, 64 sites are done at once: a row is a
//! bit a site for "grain" and one for "void".

use super::sheet::{EMPTY, OUT, Sheet, Trail};
use crate::about::About;
use crate::random::{Purpose, words};

pub(crate) const ABOUT: About = About {
    key: "method.after-caram-hong",
    formula: "a void swaps with one of the two grains above it, with the left one with probability p; a grain slides while a site below it is empty",
    symbols: "p, rate of the outlet [-]; one row a step",
    limits: "Slopes rest at 60 degrees, the slope of the lattice. No inertia, no friction: a step is as long as `time-step` \
says, by itself the time in which a grain falls from rest to the next row.",
    reference: "after Caram and Hong 1991",
};

/// Chances of the rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chances {
    /// That a void between two grains takes the left one, p [-].
    pub left: f64,
    /// That an outlet site takes a grain when it is its turn, every other step [-].
    pub rate: f64,
}

/// A bed with outlets.
#[derive(Clone, Debug)]
pub struct CaramHong {
    /// Who sits where.
    pub sheet: Sheet,
    /// Chances of the rule.
    pub chances: Chances,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Steps done.
    pub step: u64,
    /// The last move of every grain.
    pub trail: Trail,
    bits: Bits,
    pair: Pair,
}

/// A bit a site.
#[derive(Clone, Debug)]
struct Bits {
    /// Words of a row.
    words: usize,
    grain: Vec<u64>,
    hole: Vec<u64>,
    out: Vec<u64>,
}

/// What the voids of one row do, a bit a site: scratch.
#[derive(Clone, Debug)]
struct Pair {
    takers: Vec<u64>,
    left: Vec<u64>,
    right: Vec<u64>,
}

impl Bits {
    fn new(sheet: &Sheet, words: usize) -> Self {
        let empty = || vec![0; words * sheet.rows()];
        let mut bits = Self { words, grain: empty(), hole: empty(), out: empty() };
        for (site, cell) in sheet.cells.iter().enumerate() {
            let (column, row) = sheet.column_and_row(site);
            let (word, bit) = (row * words + column / 64, 1 << (column % 64));
            match *cell {
                EMPTY => bits.hole[word] |= bit,
                OUT => bits.out[word] |= bit,
                0.. => bits.grain[word] |= bit,
                _ => {}
            }
        }
        bits
    }
}

impl CaramHong {
    /// A bed on a sheet.
    pub fn new(sheet: Sheet, chances: Chances, seed: u64) -> Self {
        let width = sheet.columns().div_ceil(64);
        let bits = Bits::new(&sheet, width);
        let scratch = || vec![0; width];
        let pair = Pair { takers: scratch(), left: scratch(), right: scratch() };
        let trail = Trail::new(&sheet);
        Self { sheet, chances, seed, step: 0, trail, bits, pair }
    }

    /// Reads the sheet anew, after somebody else has changed it.
    pub fn count_anew(&mut self) {
        self.bits = Bits::new(&self.sheet, self.bits.words);
    }

    /// One step; calls for every site at which a void arrives.
    pub fn advance(&mut self, arrives: &mut impl FnMut(usize)) {
        self.step += 1;
        let first = (self.step % 2) as usize;
        for row in (first..self.sheet.rows() - 1).step_by(2) {
            self.look_up(row, arrives);
        }
    }

    /// The voids of a row look up.
    fn look_up(&mut self, row: usize, arrives: &mut impl FnMut(usize)) {
        let w = self.bits.words;
        let (low, high) = (row * w, (row + 1) * w);
        for word in 0..w {
            let out = self.bits.out[low + word];
            let open = if out == 0 { 0 } else { out & self.coins(self.chances.rate, Purpose::Outlet, low + word, 0) };
            self.pair.takers[word] = self.bits.hole[low + word] | open;
        }
        for round in 0.. {
            if !self.choose(row, round) {
                break;
            }
            for word in 0..w {
                let (left, right) = (self.pair.left[word], self.pair.right[word]);
                self.bits.grain[high + word] &= !(left | right);
                self.bits.hole[high + word] |= left | right;
            }
            self.carry_down(row, arrives);
        }
    }

    /// Fills `left` and `right` with the grains of the row above (a bit where the grain is) that a void takes as its left
    /// and as its right one; whether there are any.
    fn choose(&mut self, row: usize, round: u64) -> bool {
        let w = self.bits.words;
        let (low, high) = (row * w, (row + 1) * w);
        let odd = row % 2 == 1;
        let mut any = 0;
        for word in 0..w {
            let taker = self.pair.takers[word];
            let above = &self.bits.grain[high..high + w];
            // Of an even row the left grain above has the column before, of an odd row the right one the column after.
            let (l, r) = if odd { (above[word], down(above, word)) } else { (up(above, word), above[word]) };
            let both = taker & l & r;
            let coin = if both == 0 { 0 } else { self.coins(self.chances.left, Purpose::Side, low + word, round) };
            self.pair.left[word] = taker & l & (!r | coin);
            self.pair.right[word] = taker & r & !self.pair.left[word];
            any |= self.pair.left[word] | self.pair.right[word];
        }
        if any == 0 {
            return false;
        }
        // From the void's column to the grain's.
        if odd {
            shift_up(&mut self.pair.right);
        } else {
            shift_down(&mut self.pair.left);
        }
        for word in 0..w {
            let both = self.pair.left[word] & self.pair.right[word];
            if both != 0 {
                let coin = self.coins(0.5, Purpose::Lottery, low + word, round);
                self.pair.left[word] &= !(both & coin);
                self.pair.right[word] &= !(both & !coin);
            }
        }
        true
    }

    /// Moves the chosen grains down.
    fn carry_down(&mut self, row: usize, arrives: &mut impl FnMut(usize)) {
        let w = self.bits.words;
        let columns = self.sheet.columns();
        let odd = row % 2;
        for word in 0..w {
            for (mut chosen, back, aside) in
                [(self.pair.left[word], 1 - odd, 1), (self.pair.right[word], usize::MAX * odd, -1)]
            {
                while chosen != 0 {
                    let column = 64 * word + chosen.trailing_zeros() as usize;
                    chosen &= chosen - 1;
                    // The left grain of a void in an even row stands one column before it, and so on.
                    let under = column.wrapping_add(back);
                    let (from, to) = ((row + 1) * columns + column, row * columns + under);
                    let grain = std::mem::replace(&mut self.sheet.cells[from], EMPTY);
                    self.trail.moves(grain, self.step, [aside, -1]);
                    arrives(from);
                    let (cell, bit) = (row * w + under / 64, 1 << (under % 64));
                    self.pair.takers[under / 64] &= !bit;
                    if self.bits.out[cell] & bit == 0 {
                        self.sheet.cells[to] = grain;
                        self.bits.grain[cell] |= bit;
                        self.bits.hole[cell] &= !bit;
                    } else {
                        self.sheet.removed.push((grain, to));
                    }
                }
            }
        }
    }

    /// 64 coins that show 1 with a probability, to 1/65536.
    fn coins(&self, chance: f64, purpose: Purpose, word: usize, round: u64) -> u64 {
        let share = (chance * 65536.0).round() as u32;
        if share == 0 || share >= 65536 {
            return if share == 0 { 0 } else { u64::MAX };
        }
        // From the last binary digit of the chance to the first: a digit 1 joins what the coin shows, a digit 0 cuts it.
        let mut coins = 0;
        let mut fresh = [0; 4];
        for (used, digit) in (share.trailing_zeros()..16).enumerate() {
            if used % 2 == 0 {
                let turn = (self.step << 12) | (round << 4) | (used as u64 / 2);
                fresh = words(self.seed, purpose, word as u32, turn);
            }
            let half = &fresh[used % 2 * 2..];
            let bits = u64::from(half[0]) << 32 | u64::from(half[1]);
            coins = if share >> digit & 1 == 1 { coins | bits } else { coins & bits };
        }
        coins
    }
}

/// A word of a row moved one site up: bit c shows column c - 1.
#[inline]
fn up(row: &[u64], word: usize) -> u64 {
    row[word] << 1 | if word > 0 { row[word - 1] >> 63 } else { 0 }
}

/// A word of a row moved one site down: bit c shows column c + 1.
#[inline]
fn down(row: &[u64], word: usize) -> u64 {
    row[word] >> 1 | if word + 1 < row.len() { row[word + 1] << 63 } else { 0 }
}

fn shift_up(row: &mut [u64]) {
    for word in (0..row.len()).rev() {
        row[word] = up(row, word);
    }
}

fn shift_down(row: &mut [u64]) {
    for word in 0..row.len() {
        row[word] = down(row, word);
    }
}
