//! Which candidates of a block touch.
//!
//! Centres and radii of a block's own grains and of its halo are put side by side first, images across a periodic end
//! where they are met: the sieve then reads few cache lines, knows nothing of periods, and has no branch that a processor
//! would have to guess (guessing wrong took a third of the time of a settled bed).

use crate::find::candidates::List;
use crate::find::grid::HERE;
use crate::state::Grains;
use glam::DVec3;
use multiversion::multiversion;

/// Centre and radius of every grain that a block sees, by place [m].
#[derive(Clone, Debug, Default)]
pub(super) struct Spheres(Vec<[f64; 4]>);

impl Spheres {
    /// Takes the grains of a block.
    pub fn place(&mut self, grains: &Grains, list: &List, shifts: &[DVec3]) {
        let own = list.first..list.first + list.own;
        self.0.clear();
        let (positions, radii) = (&grains.position[own.clone()], &grains.radius[own]);
        self.0.extend(positions.iter().zip(radii).map(|(p, r)| [p.x, p.y, p.z, *r]));
        self.0.extend(list.halo.iter().map(|h| {
            let mut p = grains.position[h.grain as usize];
            if h.image != HERE {
                p += shifts[h.image as usize];
            }
            [p.x, p.y, p.z, grains.radius[h.grain as usize]]
        }));
    }

    /// The sphere at a place.
    #[inline(always)]
    pub fn at(&self, place: u32) -> [f64; 4] {
        self.0[place as usize]
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
}

impl Hits {
    /// Finds the pairs whose gap is below `reach` [m].
    pub fn sieve(&mut self, list: &List, spheres: &Spheres, reach: f64) {
        if self.room.len() < list.pairs.len() + 1 {
            self.room.resize(list.pairs.len() + 1, Hit::default());
        }
        self.count = sieve(&list.start, &list.pairs, &spheres.0, reach, &mut self.room);
    }

    /// What was found.
    pub fn found(&self) -> &[Hit] {
        &self.room[..self.count]
    }
}

#[multiversion(targets = "simd")]
fn sieve(start: &[u32], pairs: &[u32], spheres: &[[f64; 4]], reach: f64, hits: &mut [Hit]) -> usize {
    let mut count = 0;
    for (own, ends) in start.windows(2).enumerate() {
        let [x, y, z, r] = spheres[own];
        let r = r + reach;
        for k in ends[0] as usize..ends[1] as usize {
            let other = &spheres[pairs[k] as usize];
            let (dx, dy, dz, limit) = (other[0] - x, other[1] - y, other[2] - z, other[3] + r);
            let touching = dx * dx + dy * dy + dz * dz < limit * limit;
            hits[count] = Hit { own: own as u32, candidate: k as u32 };
            count += usize::from(touching);
        }
    }
    count
}
