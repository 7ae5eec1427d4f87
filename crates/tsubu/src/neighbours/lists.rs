//! Neighbour lists: pairs that are near enough to touch before the lists are rebuilt (Verlet lists, with a skin).
//!
//! Grains are kept sorted in space and cut into blocks of [`BLOCK`]. Every block has its own list: pairs whose first grain
//! is in the block, in the order of that grain, with the second grain anywhere. Blocks depend on the grains alone, never
//! on the number of threads: whatever is added up block by block gives the same bits on any machine.
//!
//! The list holds every pair whose gap is below the skin; how long it is good is told by [`drift`](super::drift). Grains of
//! very different sizes are searched on several grids, one for each factor of two in size: a small grain looks for small
//! ones near it and for large ones farther away, never the other way round.

use super::block::{BLOCK, BlockList, Finder, NOT_IN_HALO, find_incoming};
use super::drift::Drifts;
use super::grid::{Grid, Image, Numbering, PRIMARY_IMAGE, PeriodicBounds, shift};
use super::joined::Joined;
use crate::state::Grains;
use crate::threads::{self, fill, piece, shares};
use crate::wall::{Pose, Wall};
use glam::DVec3;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Below this many grains all pairs are looked at: a grid would cost more than it saves, and nothing needs sorting.
const SMALL: usize = 96;

/// Up to this ratio of sizes one grid is faster than two.
const ONE_LEVEL: f64 = 2.5;

/// The neighbour lists of all blocks, and where everything was when they were made.
#[derive(Debug, Default)]
pub struct NeighbourLists {
    /// How the lists are made.
    pub search: Search,
    /// One list a block.
    pub lists: Vec<BlockList>,
    /// Positions at the time of the search.
    pub reference: Vec<DVec3>,
    /// Poses of the walls at the time of the search.
    pub wall_reference: Vec<Pose>,
    /// What every block has done since.
    pub drifts: Drifts,
    /// Shift of every image [m].
    pub shifts: Vec<DVec3>,
    /// Which grains are not to touch each other.
    pub joined: Joined,
    /// The blocks whose lists are made here; `None`: all. Others have none.
    pub part: Option<Range<usize>>,
    levels: Vec<Grid>,
    level_of: Vec<u8>,
    largest: Vec<f64>,
    finders: Vec<Mutex<Finder>>,
}

/// How neighbour lists are made.
#[derive(Clone, Copy, Debug, Default)]
pub struct Search {
    /// Verlet skin: gap below which a pair is in the list, less the law's reach [m].
    pub skin: f64,
    /// Gap at which bodies may still hold each other [m].
    pub reach: f64,
    /// Periodic axes.
    pub periodic: PeriodicBounds,
}

/// A box, and what of it comes round periodic ends.
struct Surroundings {
    low: DVec3,
    high: DVec3,
    periodic: PeriodicBounds,
}

impl Surroundings {
    fn holds(&self, p: DVec3) -> bool {
        (0..3).all(|axis| {
            let holds = |x: f64| x >= self.low[axis] && x <= self.high[axis];
            let round = |[low, high]: [f64; 2]| holds(p[axis] + (high - low)) || holds(p[axis] - (high - low));
            holds(p[axis]) || self.periodic[axis].is_some_and(round)
        })
    }
}

impl NeighbourLists {
    /// Empty lists.
    pub fn new(search: Search) -> Self {
        Self { search, ..Self::default() }
    }

    /// The same where some grains are not to touch each other.
    #[must_use]
    pub fn but(self, joined: Joined) -> Self {
        Self { joined, ..self }
    }

    /// The blocks whose lists are made here.
    pub fn own(&self) -> Range<usize> {
        self.part.clone().unwrap_or(0..self.lists.len())
    }

    /// Whether the lists may miss a touching pair.
    pub fn stale(&self, grains: &Grains, walls: &[Wall]) -> bool {
        self.reference.len() != grains.len()
            || self.drifts.stale(self.search.skin, self.drifts.walls_moved(walls, &self.wall_reference))
    }

    /// Estimates how much work a step is in each block, from how many contacts each has.
    pub fn estimate_work(&mut self, contacts: impl Iterator<Item = usize>) {
        for (list, contacts) in self.lists.iter_mut().zip(contacts) {
            list.estimate_work(contacts);
        }
    }

    /// Puts grains back between the periodic ends and sorts them by cell, but for the columns of these names. Without effect on a small run.
    pub fn sort_grains(&mut self, grains: &mut Grains, but: &[&str]) {
        let search = self.search;
        for (axis, end) in search.periodic.iter().enumerate() {
            let Some([low, high]) = *end else { continue };
            let piece = piece(grains.len());
            let places = grains.position.par_iter_mut().zip(&mut grains.unwrap_offset).with_min_len(piece);
            places.for_each(|(position, offset)| {
                let x = position[axis];
                let periods = ((x - low) / (high - low)).floor();
                if periods != 0.0 {
                    position[axis] = x - periods * (high - low);
                    offset[axis] += periods * (high - low);
                }
            });
        }
        if grains.len() <= SMALL {
            self.levels.clear();
            return;
        }
        let mean = grains.radius.iter().sum::<f64>() / grains.len() as f64;
        let size = 2.0 * mean + search.skin;
        // The memory of a level, which is filled anew afterwards.
        self.levels.resize_with(self.levels.len().max(1), Grid::default);
        let order = &mut self.levels[0];
        order.lay(Numbering::Lumps, &grains.position, |_| true, size, &search.periodic);
        order.sort(&grains.position, |_| true);
        grains.permute(order.order(), but);
    }

    /// Where every grain was before it was sorted, until the lists are made; empty where it is where it was.
    pub fn order(&self) -> &[u32] {
        self.levels.first().map_or(&[], Grid::order)
    }

    /// Makes the lists for the present positions.
    pub fn rebuild(&mut self, grains: &Grains, walls: &[Wall]) {
        self.reference.resize(grains.len(), DVec3::ZERO);
        fill(&mut self.reference, |i| grains.position[i]);
        self.wall_reference.clear();
        self.wall_reference.extend(walls.iter().map(|w| w.pose));
        self.build(grains, walls);
    }

    /// Makes the lists as they were made at the remembered positions: after a resume nothing may differ. `walls` stand
    /// where they stood then.
    pub fn build(&mut self, grains: &Grains, walls: &[Wall]) {
        let search = self.search;
        let n = grains.len();
        if self.shifts.is_empty() {
            self.shifts = (0..27).map(|image| shift(&search.periodic, image)).collect();
        }
        let small = n <= SMALL && search.periodic.iter().all(Option::is_none);
        if !small {
            self.fill_levels(grains);
        }
        self.lists.resize_with(n.div_ceil(BLOCK), BlockList::default);
        for (block, list) in self.lists.iter_mut().enumerate() {
            list.first = block * BLOCK;
            list.own = BLOCK.min(n - list.first);
            list.clear();
        }
        self.finders.resize_with(self.finders.len().max(rayon::current_num_threads()), Mutex::default);
        let own = self.own();
        let mut lists = std::mem::take(&mut self.lists);
        threads::each(&mut lists[own.clone()], shares(n), |list| {
            let mine = rayon::current_thread_index().unwrap_or(0);
            // Nobody else has this thread's finder, so the lock is free.
            let mut finder = self.finders[mine].lock().unwrap_or_else(PoisonError::into_inner);
            let finder = &mut *finder;
            finder.seconds.clear();
            finder.local_of.resize(n, NOT_IN_HALO);
            list.start.reserve_exact(list.own);
            for own in 0..list.own {
                let i = list.first + own;
                if small {
                    self.neighbours_of_few(finder, grains, i);
                } else {
                    self.neighbours(finder, grains, i);
                }
                if !self.joined.is_empty() {
                    self.forget_joined(finder, grains, i, list.start[own] as usize);
                }
                list.start.push(finder.seconds.len() as u32);
                let reach = grains.radius[i] + search.skin + search.reach;
                let moves = grains.inverse_mass[i] > 0.0;
                list.near_walls(walls, own as u32, self.reference[i], reach, moves, &mut finder.elements);
            }
            list.number_locally(finder);
        });
        find_incoming(&mut lists, own, shares(n));
        self.lists = lists;
        // Steps do not look at the grids, which take some 70 bytes for each grain of this part.
        self.levels = Vec::new();
        self.drifts.reset(&self.lists, &self.reference, grains, walls, search.skin, &search.periodic);
    }

    /// Sorts grains into one grid for each factor of two in size.
    fn fill_levels(&mut self, grains: &Grains) {
        let search = self.search;
        let nothing = || (f64::INFINITY, 0.0f64);
        let ends = |radii: &[f64]| radii.iter().fold(nothing(), |(l, h), &r| (l.min(r), h.max(r)));
        let pieces = grains.radius.par_chunks(piece(grains.len())).map(ends);
        let ends = pieces.reduce(nothing, |a, b| (a.0.min(b.0), a.1.max(b.1)));
        self.level_of.clear();
        if ends.1 < ONE_LEVEL * ends.0 {
            self.level_of.resize(grains.len(), 0);
        } else {
            let level = |r: &f64| (r / (0.5 * ONE_LEVEL * ends.0)).log2().floor().max(0.0) as u8;
            self.level_of.extend(grains.radius.iter().map(level));
        }
        let count = self.level_of.iter().copied().max().map_or(0, |l| usize::from(l) + 1);
        self.levels.resize_with(count, Grid::default);
        self.largest.clear();
        self.largest.resize(count, 0.0);
        if let [largest] = &mut self.largest[..] {
            *largest = ends.1;
        } else {
            for (r, level) in grains.radius.iter().zip(&self.level_of) {
                let largest = &mut self.largest[usize::from(*level)];
                *largest = largest.max(*r);
            }
        }
        let part = self.part_and_around(grains);
        let seen = |i: u32| part.as_ref().is_none_or(|part| part.holds(self.reference[i as usize]));
        for (level, grid) in self.levels.iter_mut().enumerate() {
            let all = |i: u32| usize::from(self.level_of[i as usize]) == level;
            let size = 2.0 * self.largest[level] + search.skin + search.reach;
            let spheres = (&self.reference[..], &grains.radius[..]);
            grid.fill(spheres, all, |i| all(i) && seen(i), size, &search.periodic);
        }
    }

    /// What may be near the blocks whose lists are made here; `None`: all.
    fn part_and_around(&self, grains: &Grains) -> Option<Surroundings> {
        let part = self.part.clone()?;
        let own = (part.start * BLOCK).min(grains.len())..(part.end * BLOCK).min(grains.len());
        let (low, high) = self.reference[own]
            .iter()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(*p), high.max(*p)));
        let reach = 2.0 * self.largest.iter().fold(0.0f64, |a, b| a.max(*b)) + self.search.skin + self.search.reach;
        Some(Surroundings { low: low - reach, high: high + reach, periodic: self.search.periodic })
    }

    /// Finds the grains that are paired with grain `i` in its list: those of its size in half of the directions, since the
    /// other half finds it, and larger ones in all.
    #[inline]
    fn neighbours(&self, finder: &mut Finder, grains: &Grains, i: usize) {
        let level = usize::from(self.level_of[i]);
        let reach = grains.radius[i] + self.search.skin + self.search.reach;
        let moves = grains.inverse_mass[i] > 0.0;
        for (higher, grid) in self.levels.iter().enumerate().skip(level) {
            finder.nearby.clear();
            if higher > level {
                grid.near(self.reference[i], reach, &self.shifts, &mut finder.nearby);
            } else {
                grid.ahead(i as u32, self.reference[i], reach, &self.shifts, &mut finder.nearby);
            }
            // Two grains that nothing moves need not be watched, nor a grain and its own image.
            let watched = |m: &&Image| (moves || grains.inverse_mass[m.grain as usize] > 0.0) && m.grain as usize != i;
            finder.seconds.extend(finder.nearby.found().iter().filter(watched));
        }
    }

    /// Drops, of the pairs from `first` on, those that are not to touch each other.
    fn forget_joined(&self, finder: &mut Finder, grains: &Grains, i: usize, first: usize) {
        let mut kept = first;
        for k in first..finder.seconds.len() {
            let second = finder.seconds[k];
            if !self.joined.are(grains.id[i], grains.id[second.grain as usize]) {
                finder.seconds[kept] = second;
                kept += 1;
            }
        }
        finder.seconds.truncate(kept);
    }

    /// The same for few grains, without a grid.
    fn neighbours_of_few(&self, finder: &mut Finder, grains: &Grains, i: usize) {
        for j in i + 1..grains.len() {
            let limit = grains.radius[i] + grains.radius[j] + self.search.skin + self.search.reach;
            let near = self.reference[i].distance_squared(self.reference[j]) < limit * limit;
            if near && grains.inverse_mass[i] + grains.inverse_mass[j] > 0.0 {
                finder.seconds.push(Image { grain: j as u32, image: PRIMARY_IMAGE });
            }
        }
    }
}
