//! Narrow phase: which pairs of a neighbour list touch.
//!
//! Centres and radii of a block's own grains and of its halo are put side by side first, images across a periodic end
//! where they are met: the loop then reads few cache lines, knows nothing of periods, and has no branch that a processor
//! would have to guess (guessing wrong took a third of the time of a settled bed).

use crate::contact::Table;
use crate::neighbours::block::{BlockList, Pair};
use crate::neighbours::grid::PRIMARY_IMAGE;
use crate::state::Grains;
use glam::DVec3;
use multiversion::multiversion;

/// Every grain that a block sees, by local index.
#[derive(Clone, Debug, Default)]
pub(super) struct Spheres {
    /// Centre and radius [m].
    spheres: Vec<[f64; 4]>,
}

impl Spheres {
    /// Takes the grains of a block.
    pub fn load(&mut self, grains: &Grains, list: &BlockList, shifts: &[DVec3]) {
        let own = list.first..list.first + list.own;
        let (p, r) = (&grains.position, &grains.radius);
        self.spheres.clear();
        self.spheres.extend(p[own.clone()].iter().zip(&r[own]).map(|(p, r)| [p.x, p.y, p.z, *r]));
        self.spheres.extend(list.halo.iter().map(|h| {
            let mut p = p[h.grain as usize];
            if h.image != PRIMARY_IMAGE {
                p += shifts[h.image as usize];
            }
            [p.x, p.y, p.z, r[h.grain as usize]]
        }));
    }

    /// Centre and radius of a grain by its local index [m].
    #[inline]
    pub fn at(&self, local: u32) -> [f64; 4] {
        self.spheres[local as usize]
    }
}

/// A touching pair.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct TouchingPair {
    /// Local index of the first grain.
    pub first: u32,
    /// Number of the pair in the neighbour list.
    pub pair: u32,
}

/// Touching pairs of a block, in the order of the list.
#[derive(Clone, Debug, Default)]
pub(super) struct TouchingPairs {
    room: Vec<TouchingPair>,
    count: usize,
    /// The same by law, where there are several.
    by_law: Vec<Vec<TouchingPair>>,
}

impl TouchingPairs {
    /// Finds the pairs whose gap is below `reach` [m].
    pub fn find(&mut self, list: &BlockList, spheres: &Spheres, reach: f64) {
        if self.room.len() < list.pairs.len() + 1 {
            self.room.resize(list.pairs.len() + 1, TouchingPair::default());
        }
        self.count = touching(&list.pairs, &spheres.spheres, reach, &mut self.room);
    }

    /// Leaves out what `touches` says does not touch after all.
    pub fn keep(&mut self, mut touches: impl FnMut(&TouchingPair) -> bool) {
        let mut kept = 0;
        for k in 0..self.count {
            let pair = self.room[k];
            self.room[kept] = pair;
            kept += usize::from(touches(&pair));
        }
        self.count = kept;
    }

    /// The same of what was parted by the law of the pair.
    pub fn keep_by_law(&mut self, mut touches: impl FnMut(usize, &TouchingPair) -> bool) {
        for (law, pairs) in self.by_law.iter_mut().enumerate() {
            pairs.retain(|pair| touches(law, pair));
        }
    }

    /// Parts what was found by the law of the pair. What is beyond the reach of its own law goes: laws that end with the overlap
    /// are not asked about pairs that do not touch.
    pub fn group_by_law(
        &mut self,
        grains: &Grains,
        list: &BlockList,
        spheres: &Spheres,
        table: &Table,
        reaches: &[f64],
    ) {
        self.by_law.resize_with(reaches.len(), Vec::new);
        self.by_law.iter_mut().for_each(Vec::clear);
        for touching in &self.room[..self.count] {
            let local = list.pairs[touching.pair as usize].second;
            let material = |local: u32| grains.material[list.grain_at[local as usize] as usize];
            let law = table.law(table.index(material(touching.first), material(local)));
            if near(&spheres.at(touching.first), &spheres.at(local), reaches[law]) {
                self.by_law[law].push(*touching);
            }
        }
    }

    /// What was found under any law.
    pub fn all(&self) -> &[TouchingPair] {
        &self.room[..self.count]
    }

    /// What was found under a law.
    pub fn under(&self, law: usize) -> &[TouchingPair] {
        self.by_law.get(law).map_or(self.all(), Vec::as_slice)
    }
}

/// Whether the gap of two spheres is below `reach` [m]: what `touching` asks, with the same rounding.
#[inline]
fn near(a: &[f64; 4], b: &[f64; 4], reach: f64) -> bool {
    let (dx, dy, dz, limit) = (b[0] - a[0], b[1] - a[1], b[2] - a[2], b[3] + (a[3] + reach));
    dx * dx + dy * dy + dz * dz < limit * limit
}

#[multiversion(targets = "simd")]
fn touching(pairs: &[Pair], spheres: &[[f64; 4]], reach: f64, found: &mut [TouchingPair]) -> usize {
    let mut count = 0;
    for (k, pair) in pairs.iter().enumerate() {
        let ([x, y, z, r], other) = (spheres[pair.first as usize], &spheres[pair.second as usize]);
        let (dx, dy, dz, limit) = (other[0] - x, other[1] - y, other[2] - z, other[3] + (r + reach));
        let touch = dx * dx + dy * dy + dz * dz < limit * limit;
        found[count] = TouchingPair { first: pair.first, pair: k as u32 };
        count += usize::from(touch);
    }
    count
}
