//! The neighbour list of one block of grains.

use super::grid::{Image, Nearby, PRIMARY_IMAGE};
use crate::threads;
use crate::wall::Wall;
use glam::DVec3;
use rayon::prelude::*;
use std::ops::Range;

/// Grains of a block.
pub const BLOCK: usize = 512;

/// How many blocks of so many grains a thread takes at once, at least.
pub fn blocks_at_once(grains: usize) -> usize {
    threads::piece(grains).div_ceil(BLOCK)
}

/// Two grains that may touch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Pair {
    /// Local index of the first grain, an own one.
    pub first: u32,
    /// Local index of the second grain: own grains first, then the halo.
    pub second: u32,
}

/// A wall element near a grain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct WallCandidate {
    /// Grain, counted from the first of the block.
    pub own: u32,
    /// Number of the wall.
    pub wall: u32,
    /// Element of the wall.
    pub element: u32,
}

/// Where another block has gathered forces on a grain of this one.
#[derive(Clone, Copy, Debug)]
pub struct Incoming {
    /// Grain, counted from the first of this block.
    pub own: u32,
    /// The other block.
    pub block: u32,
    /// Its local index in the other block.
    pub local: u32,
}

/// The neighbour list of one block.
#[derive(Clone, Debug, Default)]
pub struct BlockList {
    /// Index of its first grain.
    pub first: usize,
    /// Number of its grains.
    pub own: usize,
    /// First pair of every own grain; one more than grains.
    pub start: Vec<u32>,
    /// In the order of their first grains.
    pub pairs: Vec<Pair>,
    /// What appears in `pairs` besides own grains: grains of other blocks, and images across a periodic end; rising.
    pub halo: Vec<Image>,
    /// Index of the grain with each local index.
    pub grain_at: Vec<u32>,
    /// Wall elements near own grains, sorted.
    pub walls: Vec<WallCandidate>,
    /// What other blocks hold for own grains, by grain and then in the order of the blocks.
    pub incoming: Vec<Incoming>,
    /// How much work a step is, in contacts: threads share by it.
    pub work: usize,
}

/// Grains that follow one another in the halo of a block and are all in one other block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct HaloRun {
    /// Where the grains are.
    home: u32,
    /// In whose halo.
    block: u32,
    /// From and to in the halo.
    halo: [u32; 2],
}

/// Tells the blocks `own` what others of them hold for their grains; on as many threads as there are `shares`.
pub(super) fn find_incoming(lists: &mut [BlockList], own: Range<usize>, shares: usize) {
    let mut runs: Vec<(Vec<HaloRun>, usize)> = own.clone().map(|block| (Vec::new(), block)).collect();
    threads::each(&mut runs, shares, |(runs, block)| {
        let homes = lists[*block].halo.chunk_by(|a, b| a.grain as usize / BLOCK == b.grain as usize / BLOCK);
        let mut end = 0;
        runs.extend(homes.map(|grains| {
            let first = end;
            end += grains.len() as u32;
            HaloRun { home: grains[0].grain / BLOCK as u32, block: *block as u32, halo: [first, end] }
        }));
    });
    let mut runs: Vec<HaloRun> = runs.into_iter().flat_map(|(runs, _)| runs).collect();
    runs.par_sort_unstable();
    let taken = |list: &mut BlockList| (std::mem::take(&mut list.incoming), list.first / BLOCK);
    let mut all: Vec<(Vec<Incoming>, usize)> = lists[own.clone()].iter_mut().map(taken).collect();
    threads::each(&mut all, shares, |(incoming, home)| {
        let here = runs.partition_point(|run| (run.home as usize) < *home);
        let here = runs[here..].iter().take_while(|run| run.home as usize == *home);
        incoming.reserve_exact(here.clone().map(|run| (run.halo[1] - run.halo[0]) as usize).sum());
        for run in here {
            let BlockList { own, halo, .. } = &lists[run.block as usize];
            let grains = (run.halo[0]..run.halo[1]).map(|h| (h, halo[h as usize].grain));
            incoming.extend(grains.map(|(h, grain)| Incoming {
                own: grain % BLOCK as u32,
                block: run.block,
                local: *own as u32 + h,
            }));
        }
        // Stable: what several blocks hold for a grain stays in the order of the blocks.
        incoming.sort_by_key(|i| i.own);
    });
    for (list, (incoming, _)) in lists[own].iter_mut().zip(all) {
        list.incoming = incoming;
    }
}

/// Memory of one thread that makes lists.
#[derive(Debug, Default)]
pub(super) struct Finder {
    pub nearby: Nearby,
    /// Second grains of all pairs of the block.
    pub seconds: Vec<Image>,
    /// Those of them that are not in the block.
    halo: Vec<Image>,
    /// Local index of every grain in the halo of the block; [`NOT_IN_HALO`] between blocks.
    pub local_of: Vec<u32>,
    /// Wall elements near a grain.
    pub elements: Vec<u32>,
}

/// The local index of what is not in the halo.
pub(super) const NOT_IN_HALO: u32 = u32::MAX;

impl BlockList {
    /// Estimates the work from what is near and how many `contacts` there are, as measured with beds at rest.
    pub(super) fn estimate_work(&mut self, contacts: usize) {
        self.work = self.own / 2 + self.pairs.len() / 4 + self.walls.len() + contacts;
    }

    pub(super) fn clear(&mut self) {
        self.pairs.clear();
        self.walls.clear();
        self.halo.clear();
        self.incoming.clear();
        self.start.clear();
        self.start.push(0);
    }

    /// Walls near a grain; of a grain that nothing moves those that grains can move: what neither gives way in need not be
    /// watched, and may lie in the other.
    pub(super) fn near_walls(
        &mut self,
        walls: &[Wall],
        own: u32,
        centre: DVec3,
        reach: f64,
        moves: bool,
        elements: &mut Vec<u32>,
    ) {
        for (k, wall) in walls.iter().enumerate().filter(|(_, wall)| moves || wall.inverse_mass > 0.0) {
            elements.clear();
            wall.near(centre, reach, elements);
            self.walls.extend(elements.iter().map(|&element| WallCandidate { own, wall: k as u32, element }));
        }
    }

    /// Gives every second grain its local index.
    pub(super) fn number_locally(&mut self, finder: &mut Finder) {
        let Finder { seconds, halo, local_of, .. } = finder;
        halo.clear();
        let inside = self.first as u32..(self.first + self.own) as u32;
        let own = |c: &Image| c.image == PRIMARY_IMAGE && inside.contains(&c.grain);
        for second in seconds.iter().filter(|c| !own(c)) {
            // What is nearby across a periodic end is rare, and may be nearby as several images.
            if second.image != PRIMARY_IMAGE {
                halo.push(*second);
            } else if local_of[second.grain as usize] == NOT_IN_HALO {
                halo.push(*second);
                local_of[second.grain as usize] = 0;
            }
        }
        halo.sort_unstable();
        halo.dedup();
        // Room for what there is: memory that grows by itself doubles.
        self.halo.reserve_exact(halo.len());
        self.halo.extend_from_slice(halo);
        for (local, h) in (self.own as u32..).zip(&self.halo).filter(|(_, h)| h.image == PRIMARY_IMAGE) {
            local_of[h.grain as usize] = local;
        }
        self.grain_at.clear();
        self.grain_at.reserve_exact(self.own + halo.len());
        self.grain_at.extend(inside.clone().chain(self.halo.iter().map(|h| h.grain)));
        let local = |c: &Image| match c {
            c if own(c) => c.grain - inside.start,
            c if c.image == PRIMARY_IMAGE => local_of[c.grain as usize],
            c => self.own as u32 + self.halo.partition_point(|h| h < c) as u32,
        };
        self.pairs.reserve_exact(seconds.len());
        for (grain, ends) in (0..).zip(self.start.windows(2)) {
            let seconds = &seconds[ends[0] as usize..ends[1] as usize];
            self.pairs.extend(seconds.iter().map(|second| Pair { first: grain, second: local(second) }));
        }
        for h in &self.halo {
            local_of[h.grain as usize] = NOT_IN_HALO;
        }
    }
}
