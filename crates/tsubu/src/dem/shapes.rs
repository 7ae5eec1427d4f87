//! Contacts of superellipsoids.
//!
//! Neighbour lists and the narrow phase see the sphere that holds a body. What touches there is looked at again: where the surfaces meet, and how
//! round each is. The law then gets two spheres that are as round, with the centres that such spheres have; forces and torques on these are
//! carried over to the bodies. Scenes without superellipsoids pass all of this by.

use super::contact_batch::ContactBatch;
use super::contact_forces::ForceInput;
use super::narrow_phase::{Spheres, TouchingPair, TouchingPairs};
use crate::contact::Law;
use crate::contact::chunk::{Chunk, Column};
use crate::neighbours::lists::BlockList;
use crate::superellipsoid::Outline;
use crate::superellipsoid::touch::{Rounding, Touch, touch};
use crate::wall;
use glam::DVec3;

/// A pair of which one at least is no sphere.
#[derive(Clone, Copy, Debug)]
struct Shaped {
    /// Number in the neighbour list.
    pair: u32,
    touch: Touch,
}

/// The pairs of a block of which one at least is no sphere, in the order of the list.
#[derive(Clone, Debug, Default)]
pub(super) struct PairShapes {
    found: Vec<Shaped>,
    outlines: Vec<Option<Outline>>,
}

impl PairShapes {
    /// Looks at the pairs whose spheres touch, and leaves out those whose bodies are apart by more than a law reaches.
    pub fn find(&mut self, pairs: &mut TouchingPairs, input: &ForceInput, list: &BlockList, spheres: &Spheres) {
        self.found.clear();
        if !input.bodies.shaped() {
            return;
        }
        let own = list.first..list.first + list.own;
        let halo = list.halo.iter().map(|halo| halo.grain as usize);
        self.outlines.clear();
        self.outlines.extend(own.chain(halo).map(|i| input.bodies.outline(i)));
        let Self { found, outlines } = self;
        pairs.keep(|pair| {
            let second = list.pairs[pair.pair as usize].second;
            let Some([a, b]) = pair_outlines(outlines, spheres, [pair.first, second]) else { return true };
            let [p, q] = [pair.first, second].map(|local| spheres.at(local));
            let touch = touch([&a, &b], DVec3::new(q[0] - p[0], q[1] - p[1], q[2] - p[2]), input.laws.reach());
            found.extend(touch.map(|touch| Shaped { pair: pair.pair, touch }));
            touch.is_some()
        });
    }

    /// Leaves out what is beyond the reach of its own law.
    pub fn part(&self, pairs: &mut TouchingPairs, reaches: &[f64]) {
        if !self.found.is_empty() {
            pairs.keep_by_law(|law, pair| self.of(pair.pair).is_none_or(|touch| touch.overlap > -reaches[law]));
        }
    }

    /// Where a pair of the list touches; `None`: both are spheres.
    pub fn of(&self, pair: u32) -> Option<&Touch> {
        let k = self.found.binary_search_by_key(&pair, |shaped| shaped.pair).ok()?;
        Some(&self.found[k].touch)
    }

    /// Puts the spheres that stand for bodies into the rows of a batch.
    pub fn gather(&self, batch: &mut ContactBatch, touching: &[TouchingPair]) {
        batch.shifted = !self.found.is_empty();
        if !batch.shifted {
            return;
        }
        for (r, pair) in touching.iter().enumerate() {
            let Some(Touch { normal, overlap, points, radii, .. }) = self.of(pair.pair) else {
                (0..2).for_each(|body| batch.set_shift(body, r, DVec3::ZERO));
                continue;
            };
            let shifts = [points[0] - *normal * radii[0], points[1] + *normal * radii[1]];
            let spin = [0, 1].map(|body| Chunk::vector(&batch.spin[body], r));
            let relative = Chunk::vector(&batch.relative_velocity, r);
            let relative = relative + spin[0].cross(shifts[0]) - spin[1].cross(shifts[1]);
            Chunk::set(&mut batch.relative_velocity, r, relative);
            Chunk::set(&mut batch.branch, r, *normal * (radii[0] + radii[1] - overlap));
            for body in 0..2 {
                batch.radius[body][r] = radii[body];
                batch.set_shift(body, r, shifts[body]);
            }
        }
    }
}

impl PairShapes {
    /// After the law: adds what moves and turns bodies to where they are less round, see [`Rounding`].
    pub fn round(&self, batch: &mut ContactBatch, touching: &[TouchingPair], law: &Law) {
        if !batch.shifted {
            return;
        }
        for (r, pair) in touching.iter().enumerate() {
            let Some(Touch { rounding: Rounding { force, torques }, .. }) = self.of(pair.pair) else { continue };
            let slope = law.energy_slope(&batch.chunk, r);
            // The torque of this force about the centre of the body is in the torque already.
            let torques = [torques[0] - batch.shift(0, r).cross(*force), torques[1] + batch.shift(1, r).cross(*force)];
            add(&mut batch.force, r, *force * slope);
            for (column, torque) in batch.torque.iter_mut().zip(torques) {
                add(column, r, torque * slope);
            }
        }
    }
}

fn add(column: &mut [Column; 3], r: usize, more: DVec3) {
    let sum = Chunk::vector(column, r) + more;
    Chunk::set(column, r, sum);
}

/// What both grains of a pair are; nothing where both are spheres.
fn pair_outlines(outlines: &[Option<Outline>], spheres: &Spheres, pair: [u32; 2]) -> Option<[Outline; 2]> {
    let either = pair.iter().any(|local| outlines[*local as usize].is_some());
    let outline = |local: u32| outlines[local as usize].unwrap_or_else(|| Outline::sphere(spheres.at(local)[3]));
    either.then(|| pair.map(outline))
}

/// Where a body that is no sphere touches a wall.
#[derive(Clone, Copy, Debug)]
pub(super) struct WallShape {
    pub overlap: f64,
    pub radius: f64,
    /// Centre of the sphere that stands for the body, from that of the body [m].
    pub shift: DVec3,
    /// Which feature of a polyhedron it is, in the upper half; 0 for others.
    pub patch: u32,
    /// Torque on the body, its opposite on the wall, for each unit of the slope of energy over radius [m]; see [`Rounding`].
    pub rounding: DVec3,
}

/// Where one grain touches the elements of a wall.
#[derive(Clone, Debug, Default)]
pub(super) struct WallShapes {
    /// Of each touch; empty where they are those of a sphere.
    pub found: Vec<WallShape>,
    /// [`WallShape::rounding`] of the rows of a batch.
    rounding: Vec<DVec3>,
}

impl WallShapes {
    /// Of all that the sphere of a body touches, keeps what the body touches within `reach` [m].
    pub fn find(&mut self, outline: &Outline, touching: &mut Vec<wall::Touch>, reach: f64) {
        self.found.clear();
        touching.retain(|touch| {
            let shape = against_plane(outline, touch);
            let near = shape.overlap > -reach;
            self.found.extend(near.then_some(shape));
            near
        });
    }

    /// Of the touch with that number; `None`: it is a sphere that touches.
    pub fn of(&self, touch: usize) -> Option<WallShape> {
        self.found.get(touch).copied()
    }

    /// Takes a row of a batch.
    pub fn push(&mut self, batch: &mut ContactBatch, r: usize, shape: &WallShape) {
        batch.set_shift(0, r, shape.shift);
        self.rounding.push(shape.rounding);
    }

    /// After the law: adds what turns bodies to where they are less round.
    pub fn round(&mut self, batch: &mut ContactBatch, law: &Law) {
        if batch.shifted {
            for (r, rounding) in self.rounding.drain(..).enumerate() {
                let torque = rounding * law.energy_slope(&batch.chunk, r);
                add(&mut batch.torque[0], r, torque);
                // The wall hears of the torques of the law.
                add(&mut batch.chunk.torque, r, torque);
            }
        }
    }
}

impl WallShape {
    /// Of a sphere.
    pub fn sphere(radius: f64, distance: f64) -> Self {
        Self { overlap: radius - distance, radius, shift: DVec3::ZERO, patch: 0, rounding: DVec3::ZERO }
    }
}

/// Against a plane, which is as far from the centre of the body as the touch of its sphere says.
fn against_plane(outline: &Outline, touch: &wall::Touch) -> WallShape {
    let normal = -touch.nearest.normal;
    let (point, (radius, slope)) = (outline.support(normal).point, outline.roundness(normal));
    WallShape {
        overlap: normal.dot(point) - touch.nearest.distance,
        radius,
        shift: point - normal * radius,
        patch: 0,
        rounding: normal.cross(slope),
    }
}
