//! Which candidates of a block touch.
//!
//! Centres and radii of a block's own grains and of its halo are put side by side first, images across a periodic end
//! where they are met: the sieve then reads few cache lines, knows nothing of periods, and has no branch that a processor
//! would have to guess (guessing wrong took a third of the time of a settled bed).

use crate::contact::Table;
use crate::find::candidates::{List, Pair};
use crate::find::grid::HERE;
use crate::state::Grains;
use glam::DVec3;
use multiversion::multiversion;

/// Every grain that a block sees, by place.
#[derive(Clone, Debug, Default)]
pub(super) struct Spheres {
    /// Centre and radius [m].
    places: Vec<[f64; 4]>,
}

impl Spheres {
    /// Takes the grains of a block.
    pub fn place(&mut self, grains: &Grains, list: &List, shifts: &[DVec3]) {
        let own = list.first..list.first + list.own;
        let (p, r) = (&grains.position, &grains.radius);
        self.places.clear();
        self.places.extend(p[own.clone()].iter().zip(&r[own]).map(|(p, r)| [p.x, p.y, p.z, *r]));
        self.places.extend(list.halo.iter().map(|h| {
            let mut p = p[h.grain as usize];
            if h.image != HERE {
                p += shifts[h.image as usize];
            }
            [p.x, p.y, p.z, r[h.grain as usize]]
        }));
    }

    /// Centre and radius at a place [m].
    #[inline]
    pub fn at(&self, place: u32) -> [f64; 4] {
        self.places[place as usize]
    }
}

/// A touching pair.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Hit {
    /// First grain, counted from the first of the block.
    pub own: u32,
    /// Number of the candidate.
    pub candidate: u32,
}

/// Touching pairs of a block, in the order of the candidates.
#[derive(Clone, Debug, Default)]
pub(super) struct Hits {
    room: Vec<Hit>,
    count: usize,
    /// The same by law, where there are several.
    parted: Vec<Vec<Hit>>,
}

impl Hits {
    /// Finds the pairs whose gap is below `reach` [m].
    pub fn sieve(&mut self, list: &List, spheres: &Spheres, reach: f64) {
        if self.room.len() < list.pairs.len() + 1 {
            self.room.resize(list.pairs.len() + 1, Hit::default());
        }
        self.count = sieve(&list.pairs, &spheres.places, reach, &mut self.room);
    }

    /// Parts what was found by the law of the pair. What is beyond the reach of its own law goes: laws that end with the overlap
    /// are not asked about pairs that do not touch.
    pub fn part(&mut self, grains: &Grains, list: &List, spheres: &Spheres, table: &Table, reaches: &[f64]) {
        self.parted.resize_with(reaches.len(), Vec::new);
        self.parted.iter_mut().for_each(Vec::clear);
        for hit in &self.room[..self.count] {
            let place = list.pairs[hit.candidate as usize].place;
            let material = |place: u32| grains.material[list.at[place as usize] as usize];
            let law = table.law(table.index(material(hit.own), material(place)));
            if near(&spheres.at(hit.own), &spheres.at(place), reaches[law]) {
                self.parted[law].push(*hit);
            }
        }
    }

    /// What was found under a law.
    pub fn under(&self, law: usize) -> &[Hit] {
        self.parted.get(law).map_or(&self.room[..self.count], Vec::as_slice)
    }
}

/// Whether the gap of two spheres is below `reach` [m]: what `sieve` asks, with the same rounding.
#[inline]
fn near(a: &[f64; 4], b: &[f64; 4], reach: f64) -> bool {
    let (dx, dy, dz, limit) = (b[0] - a[0], b[1] - a[1], b[2] - a[2], b[3] + (a[3] + reach));
    dx * dx + dy * dy + dz * dz < limit * limit
}

#[multiversion(targets = "simd")]
fn sieve(pairs: &[Pair], spheres: &[[f64; 4]], reach: f64, hits: &mut [Hit]) -> usize {
    let mut count = 0;
    for (k, pair) in pairs.iter().enumerate() {
        let ([x, y, z, r], other) = (spheres[pair.own as usize], &spheres[pair.place as usize]);
        let (dx, dy, dz, limit) = (other[0] - x, other[1] - y, other[2] - z, other[3] + (r + reach));
        let touching = dx * dx + dy * dy + dz * dz < limit * limit;
        hits[count] = Hit { own: pair.own, candidate: k as u32 };
        count += usize::from(touching);
    }
    count
}
