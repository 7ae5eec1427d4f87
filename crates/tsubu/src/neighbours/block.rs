//! The neighbour list of one block of grains.

use super::grid::{Image, Nearby, PRIMARY_IMAGE};
use crate::wall::Wall;
use glam::DVec3;

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

/// Memory of one thread that makes lists.
#[derive(Debug, Default)]
pub(super) struct Finder {
    pub nearby: Nearby,
    /// Second grains of all pairs of the block.
    pub seconds: Vec<Image>,
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
        let Finder { seconds, local_of, .. } = finder;
        let inside = self.first as u32..(self.first + self.own) as u32;
        let own = |c: &Image| c.image == PRIMARY_IMAGE && inside.contains(&c.grain);
        for second in seconds.iter().filter(|c| !own(c)) {
            // What is nearby across a periodic end is rare, and may be nearby as several images.
            if second.image != PRIMARY_IMAGE {
                self.halo.push(*second);
            } else if local_of[second.grain as usize] == NOT_IN_HALO {
                self.halo.push(*second);
                local_of[second.grain as usize] = 0;
            }
        }
        self.halo.sort_unstable();
        self.halo.dedup();
        for (local, h) in (self.own as u32..).zip(&self.halo).filter(|(_, h)| h.image == PRIMARY_IMAGE) {
            local_of[h.grain as usize] = local;
        }
        self.grain_at.clear();
        self.grain_at.extend(inside.clone().chain(self.halo.iter().map(|h| h.grain)));
        let local = |c: &Image| match c {
            c if own(c) => c.grain - inside.start,
            c if c.image == PRIMARY_IMAGE => local_of[c.grain as usize],
            c => self.own as u32 + self.halo.partition_point(|h| h < c) as u32,
        };
        for (grain, ends) in (0..).zip(self.start.windows(2)) {
            let seconds = &seconds[ends[0] as usize..ends[1] as usize];
            self.pairs.extend(seconds.iter().map(|second| Pair { first: grain, second: local(second) }));
        }
        for h in &self.halo {
            local_of[h.grain as usize] = NOT_IN_HALO;
        }
    }
}
