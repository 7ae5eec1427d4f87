//! The passive rule: walls and driven grains push, and grains move out of overlaps (C-5 of Sakaguchi 2001, after
//! Murakami et al.).
//!
//! The published text leaves choices open; they are, for a grain a and its causes c, the bodies that it shares points
//! with and that moved by u_c in their last move:
//!
//! - D_c = { d : O(a + d, c) < O(a, c) and d . u_c >= 0 }, O the number of shared points; allowed is what all D_c have in
//!   common, less what would enter a wall that stands still. If nothing is left, the grain rests.
//! - Of what is allowed: the direction of the last step, then the largest reduction, then a draw. New overlaps with
//!   others are not avoided: that is how a push goes on through the bed.
//! - A grain without causes follows the active rule under gravity, and rests without.
//! - The order is that of [`rank`]; on its turn a grain looks again.
//!
//! The number of shared points of a pair stands for the force between them.

use super::bed::{Bed, Motion, NOWHERE};
use super::order::{Pull, rank};
use crate::lattice::direction::{Direction, Vector};
use crate::lattice::grid::EMPTY;
use crate::random::{Purpose, words};
use rayon::prelude::*;
use std::collections::BTreeSet;

/// A wall that moves: the cells it covers now, and its last move.
#[derive(Clone, Debug, Default)]
pub struct Pusher {
    /// Number of the wall in the scene.
    pub wall: usize,
    /// One entry a cell of the lattice: whether the wall is there.
    pub cells: Vec<bool>,
    /// Where it moved in this step, in columns and half cells.
    pub moved: Vector,
    /// What it covered at its last few places: a wall that swings comes by again.
    known: Vec<(Vector, Vec<bool>)>,
}

/// Places of a moving wall that are remembered.
const KNOWN: usize = 64;

impl Pusher {
    /// The wall of that number; it has not stood anywhere yet.
    pub fn of(wall: usize) -> Self {
        Self { wall, ..Self::default() }
    }

    /// The wall stands `shift` from where it was drawn; `paint` tells which cells it covers there.
    pub fn stand(&mut self, shift: Vector, paint: impl FnOnce() -> Vec<bool>) {
        if let Some((_, cells)) = self.known.iter().find(|(known, _)| *known == shift) {
            self.cells.clone_from(cells);
            return;
        }
        self.cells = paint();
        if self.known.len() == KNOWN {
            self.known.clear();
        }
        self.known.push((shift, self.cells.clone()));
    }
}

/// A pair that shares points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shared {
    /// The grain.
    pub grain: usize,
    /// The other.
    pub other: Body,
    /// How many points.
    pub points: u32,
}

/// What a grain can overlap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Body {
    /// Another grain.
    Grain(usize),
    /// A wall that moves, by its place in the list.
    Pusher(usize),
}

/// Grains by the part of the lattice that they are in, and how many points two shapes share.
#[derive(Clone, Debug, Default)]
pub struct Passive {
    /// Points of every stencil, for quick asking.
    sets: Vec<BTreeSet<(i64, i64)>>,
    /// Points shared by two stencils at a distance, as a square table of half width `reach`.
    tables: Vec<Vec<u16>>,
    reach: i64,
    bins: Vec<Vec<u32>>,
    bin: usize,
    bins_across: usize,
}

impl Passive {
    /// Tables for the shapes of a bed.
    pub fn new(bed: &Bed) -> Self {
        let mut sets = Vec::new();
        for kind in &bed.kinds {
            let mut shape = kind.shape.clone();
            for _ in 0..kind.orientations {
                sets.push(shape.points().iter().map(|p| (p.h, p.k)).collect::<BTreeSet<_>>());
                shape = shape.turned();
            }
        }
        let half = sets.iter().flatten().map(|(h, k)| h.abs().max(k.abs())).max().unwrap_or(0);
        let reach = 2 * half + 2;
        let across = -reach..=reach;
        let shared = |a: &BTreeSet<(i64, i64)>, b: &BTreeSet<(i64, i64)>, h: i64, k: i64| {
            a.iter().filter(|p| b.contains(&(p.0 - h, p.1 - k))).count() as u16
        };
        let mut tables = Vec::new();
        for a in &sets {
            for b in &sets {
                let row = |h: i64| across.clone().map(move |k| (h, k));
                let places = across.clone().flat_map(row);
                tables.push(places.map(|(h, k)| if (h + k) % 2 == 0 { shared(a, b, h, k) } else { 0 }).collect());
            }
        }
        // A bin is so wide that what a grain can touch, also after both have moved, is in the next one at most.
        let bin = (reach as usize + 2).max(4);
        let bins_across = bed.grid.columns() / bin + 1;
        let bins = vec![Vec::new(); bins_across * (2 * bed.grid.rows() / bin + 2)];
        Self { sets, tables, reach, bins, bin, bins_across }
    }

    fn bin_of(&self, at: Vector) -> usize {
        at.k as usize / self.bin * self.bins_across + at.h as usize / self.bin
    }

    fn sort(&mut self, bed: &Bed) {
        for bin in &mut self.bins {
            bin.clear();
        }
        for grain in bed.present() {
            let bin = self.bin_of(bed.vector(bed.grains.cell[grain] as usize));
            self.bins[bin].push(grain as u32);
        }
    }

    /// Points that a grain standing at `at` shares with another.
    #[inline]
    fn shared(&self, bed: &Bed, grain: usize, at: Vector, other: usize) -> u32 {
        let cell = bed.grains.cell[other];
        if cell == NOWHERE {
            return 0;
        }
        let there = bed.vector(cell as usize);
        let (h, k) = (there.h - at.h, there.k - at.k);
        if h.abs() > self.reach || k.abs() > self.reach {
            return 0;
        }
        let number = |i: usize| bed.kind(i).stencil + bed.grains.turn[i] as usize;
        let table = &self.tables[number(grain) * self.sets.len() + number(other)];
        u32::from(table[((h + self.reach) * (2 * self.reach + 1) + k + self.reach) as usize])
    }

    /// Calls for every other grain in the bins around.
    fn around(&self, bed: &Bed, grain: usize, mut call: impl FnMut(usize)) {
        let at = bed.vector(bed.grains.cell[grain] as usize);
        let (column, row) = (at.h as usize / self.bin, at.k as usize / self.bin);
        for r in row.saturating_sub(1)..=row + 1 {
            for c in column.saturating_sub(1)..=(column + 1).min(self.bins_across - 1) {
                for &other in self.bins.get(r * self.bins_across + c).into_iter().flatten() {
                    if other as usize != grain {
                        call(other as usize);
                    }
                }
            }
        }
    }

    /// One step. `driven` says how driven grains, which have moved already, and walls moved in it.
    pub fn step(&mut self, bed: &mut Bed, pull: Option<Pull>, pushers: &[Pusher], driven: &[Vector]) -> usize {
        self.sort(bed);
        let this = &*self;
        let around = Around { passive: this, pull, pushers, driven };
        let grains: Vec<u32> = bed.present().filter(|&i| bed.kind(i).free).map(|i| i as u32).collect();
        let shown = &*bed;
        let wishes = grains.par_iter().with_min_len(64).map(|&grain| {
            let word = words(shown.seed, Purpose::Move, grain, shown.step);
            let wish = around.wish(shown, grain as usize, word, &shown.grains.last)?;
            Some((rank(wish, shown.grains.last[grain as usize], pull) << 32 | u64::from(word[0]), grain))
        });
        let mut turns: Vec<(u64, u32)> = wishes.flatten().collect();
        turns.sort_unstable();
        // What others did in the last step is what they show to all in this one.
        let before = bed.grains.last.clone();
        bed.motion.fill(Motion::default());
        let mut moves = 0;
        let mut went = vec![None; bed.len()];
        for &(_, grain) in &turns {
            let i = grain as usize;
            let word = words(bed.seed, Purpose::Move, grain, bed.step);
            let Some(direction) = around.wish(bed, i, word, &before) else { continue };
            let cell = bed.grains.cell[i] as usize;
            bed.grains.cell[i] = bed.grid.neighbour(cell, bed.odd(cell), direction) as u32;
            went[i] = Some(direction);
            moves += 1;
        }
        for &grain in &grains {
            bed.note(grain as usize, went[grain as usize]);
        }
        bed.step += 1;
        moves
    }

    /// All pairs that share points, each once; grains in the order of their numbers.
    pub fn overlaps(&mut self, bed: &Bed, pushers: &[Pusher]) -> Vec<Shared> {
        self.sort(bed);
        let mut found = Vec::new();
        for grain in bed.present() {
            let at = bed.vector(bed.grains.cell[grain] as usize);
            let first = found.len();
            self.around(bed, grain, |other| {
                let points = self.shared(bed, grain, at, other);
                if other > grain && points > 0 {
                    found.push(Shared { grain, other: Body::Grain(other), points });
                }
            });
            found[first..].sort_by_key(|s| if let Body::Grain(other) = s.other { other } else { 0 });
            for (number, pusher) in pushers.iter().enumerate() {
                let points = covered(bed, grain, bed.grains.cell[grain] as usize, &pusher.cells);
                if points > 0 && bed.kind(grain).free {
                    found.push(Shared { grain, other: Body::Pusher(number), points });
                }
            }
        }
        found
    }
}

/// Points of a grain, standing in a cell, that are in a set of cells.
fn covered(bed: &Bed, grain: usize, cell: usize, cells: &[bool]) -> u32 {
    let points = &bed.stencil(grain).points[bed.odd(cell)];
    points.iter().filter(|&&offset| cells[cell.wrapping_add_signed(offset)]).count() as u32
}

/// Points of a grain, standing in a cell, that are in walls that stand still.
fn walled(bed: &Bed, grain: usize, cell: usize) -> u32 {
    let points = &bed.stencil(grain).points[bed.odd(cell)];
    points.iter().filter(|&&offset| bed.grid.at(cell.wrapping_add_signed(offset)) != EMPTY).count() as u32
}

/// All that a grain looks at.
struct Around<'a> {
    passive: &'a Passive,
    pull: Option<Pull>,
    pushers: &'a [Pusher],
    /// Last move of every grain that is driven; zero for others.
    driven: &'a [Vector],
}

impl Around<'_> {
    /// Where a grain wants to go from where it and the others are now; `before` is where all went in the last step.
    fn wish(&self, bed: &Bed, grain: usize, word: [u32; 4], before: &[Option<Direction>]) -> Option<Direction> {
        let here = bed.grains.cell[grain] as usize;
        let odd = bed.odd(here);
        let there = |d: Direction| bed.grid.neighbour(here, odd, d);
        // Every direction: points shared with causes, points newly shared with others, points in walls.
        let mut kept = [0_u32; 6];
        let mut new = [0_u32; 6];
        let mut allowed = [true; 6];
        // The same for walls that move alone: they cannot be held up.
        let mut from_walls = [true; 6];
        let mut causes = 0;
        let mut meet = |now: u32, then: [u32; 6], moved: Vector, wall: bool| {
            if now == 0 {
                (0..6).for_each(|d| new[d] += then[d]);
                return;
            }
            causes += 1;
            for d in Direction::ALL {
                let i = d as usize;
                kept[i] += then[i];
                let away = then[i] < now && d.along4(moved) >= 0;
                allowed[i] &= away;
                from_walls[i] &= away || !wall;
            }
        };
        let at = bed.vector(here);
        self.passive.around(bed, grain, |other| {
            let now = self.passive.shared(bed, grain, at, other);
            let then = Direction::ALL.map(|d| self.passive.shared(bed, grain, at.plus(d.times(1)), other));
            if now > 0 || then.iter().any(|&n| n > 0) {
                let moved = match before[other] {
                    Some(direction) => direction.times(1),
                    None => self.driven.get(other).copied().unwrap_or_default(),
                };
                meet(now, then, moved, false);
            }
        });
        for pusher in self.pushers {
            let now = covered(bed, grain, here, &pusher.cells);
            let then = Direction::ALL.map(|d| covered(bed, grain, there(d), &pusher.cells));
            meet(now, then, pusher.moved, true);
        }
        let in_walls = walled(bed, grain, here);
        let open = |d: Direction| walled(bed, grain, there(d)) <= in_walls;
        if causes == 0 {
            let lean = bed.grains.past[grain].lean(bed.memory);
            let free = |d: &Direction| new[*d as usize] == 0 && open(*d);
            return self.pull?.preference(lean, word[1] & 1 == 1).into_iter().find(free);
        }
        let last = before[grain];
        let walls_alone =
            from_walls != [true; 6] && !Direction::ALL.into_iter().any(|d| allowed[d as usize] && open(d));
        let allowed = if walls_alone { from_walls } else { allowed };
        let candidates = || Direction::ALL.into_iter().filter(|&d| allowed[d as usize] && open(d));
        let worth = |d: Direction| (last != Some(d), kept[d as usize]);
        let best = candidates().map(worth).min()?;
        let alike = || candidates().filter(|&d| worth(d) == best);
        // Each of those that are alike is drawn as often as any other.
        alike().nth(((u64::from(word[1]) * alike().count() as u64) >> 32) as usize)
    }
}
