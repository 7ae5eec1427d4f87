//! Convex polyhedra with rounded edges, and polygons in the plane: what they are, how they are turned, where two touch.
//!
//! A body is all that is nearer than its rounding radius to a convex core with flat faces. Two bodies touch where features of their cores are nearer to each other than both radii
//! (sphero-polyhedra: Pöschel and Buchholtz 1993, Alonso-Marroquín 2008, Galindo-Torres and Pedroso 2010): every corner of one with the whole core of the other, and every edge of
//! one with every edge of the other. Each is a contact of two spheres of the rounding radii. What it stores is a function of its distance alone, so that force and torque
//! are the slopes of an energy; and each distance has slopes without jumps, so that no force jumps as a contact wanders from one feature to another.

pub mod at_wall;
mod crossing;
mod nearest;
pub mod touch;
pub mod with_round;

use glam::{DMat3, DVec3};
use std::ops::Range;
use tsubu_scene::plan;

/// Corners of a body are kept in lots of so many.
const LANES: usize = 4;

/// A core of diameter 1 about its centre of mass, along its principal axes, and how round it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polyhedron {
    corners: Vec<DVec3>,
    normals: Vec<DVec3>,
    /// Distances of the faces from the centre.
    offsets: Vec<f64>,
    /// Corners of the faces, each face after the other, counter-clockwise from outside.
    round: Vec<u32>,
    /// Where those of each face are.
    faces: Vec<Range<usize>>,
    edges: Vec<[usize; 2]>,
    /// The faces on both sides of each edge.
    sides: Vec<[usize; 2]>,
    rounding: f64,
}

impl Polyhedron {
    /// Of a plan.
    pub fn new(plan: &plan::Polyhedron) -> Self {
        let mut round = Vec::new();
        let faces = plan.faces.iter().map(|face| {
            let start = round.len();
            round.extend(face.corners.iter().map(|corner| *corner as u32));
            start..round.len()
        });
        Self {
            faces: faces.collect(),
            corners: plan.corners.iter().map(|corner| DVec3::from_array(*corner)).collect(),
            normals: plan.faces.iter().map(|face| DVec3::from_array(face.normal)).collect(),
            offsets: plan.faces.iter().map(|face| face.offset).collect(),
            round,
            edges: plan.edges.clone(),
            sides: plan.edges.iter().map(|edge| sides(plan, edge)).collect(),
            rounding: plan.rounding,
        }
    }

    /// Rounding radius of a body of diameter 1.
    pub fn rounding(&self) -> f64 {
        self.rounding
    }

    /// Corners of the core of a body of diameter 1, along its principal axes.
    pub fn corners(&self) -> &[DVec3] {
        &self.corners
    }

    /// Faces of a body of diameter 1: unit normals, and distances from the centre.
    pub fn planes(&self) -> impl Iterator<Item = (DVec3, f64)> {
        self.normals.iter().zip(&self.offsets).map(|(normal, offset)| (*normal, offset + self.rounding))
    }
}

/// The faces on both sides of an edge.
fn sides(plan: &plan::Polyhedron, edge: &[usize; 2]) -> [usize; 2] {
    let mut of =
        (0..plan.faces.len()).filter(|face| edge.iter().all(|corner| plan.faces[*face].corners.contains(corner)));
    let first = of.next().unwrap_or_default();
    [first, of.next().unwrap_or(first)]
}

/// The core of a sphere: a point.
static POINT: Polyhedron = Polyhedron {
    corners: Vec::new(),
    normals: Vec::new(),
    offsets: Vec::new(),
    round: Vec::new(),
    faces: Vec::new(),
    edges: Vec::new(),
    sides: Vec::new(),
    rounding: 0.5,
};

/// A body as it is turned, about its centre.
#[derive(Clone, Copy, Debug)]
pub struct Turned<'a> {
    shape: &'a Polyhedron,
    /// Diameter [m].
    size: f64,
    /// Rounding radius [m].
    pub rounding: f64,
    /// Coordinates of the corners [m], the first once more up to whole lots.
    corners: [&'a [f64]; 3],
    /// Of these, how many are corners.
    count: usize,
    normals: &'a [DVec3],
}

impl<'a> Turned<'a> {
    /// A sphere of a radius [m].
    pub fn sphere(radius: f64) -> Self {
        let corners = [&[0.0; LANES][..]; 3];
        Self { shape: &POINT, size: 2.0 * radius, rounding: radius, corners, count: 1, normals: &[] }
    }

    #[inline]
    fn corner(&self, i: usize) -> DVec3 {
        let [x, y, z] = self.corners;
        DVec3::new(x[i], y[i], z[i])
    }

    /// Corners of the core, each with its number [m].
    pub fn corners(self) -> impl Iterator<Item = (usize, DVec3)> + 'a {
        (0..self.count).map(move |i| (i, self.corner(i)))
    }

    /// How far a point is above a face [m].
    #[inline]
    fn above(&self, face: usize, point: DVec3) -> f64 {
        self.normals[face].dot(point) - self.shape.offsets[face] * self.size
    }

    /// How far the corner that reaches farthest against a direction does, below 0 [m].
    #[inline]
    fn lowest(&self, n: DVec3) -> f64 {
        let [x, y, z] = self.corners.map(|column| column.as_chunks::<LANES>().0);
        let mut low = [f64::INFINITY; LANES];
        for ((x, y), z) in x.iter().zip(y).zip(z) {
            for l in 0..LANES {
                let height = n.x * x[l] + n.y * y[l] + n.z * z[l];
                low[l] = if height < low[l] { height } else { low[l] };
            }
        }
        low.into_iter().fold(f64::INFINITY, f64::min)
    }
}

/// Many bodies as they are turned.
#[derive(Clone, Debug, Default)]
pub struct TurnedBodies {
    corners: [Vec<f64>; 3],
    normals: Vec<DVec3>,
    list: Vec<Option<Entry>>,
}

#[derive(Clone, Copy, Debug)]
struct Entry {
    shape: u32,
    size: f64,
    rounding: f64,
    corners: usize,
    normals: usize,
}

impl TurnedBodies {
    /// Forgets all.
    pub fn clear(&mut self) {
        self.corners.iter_mut().for_each(Vec::clear);
        self.normals.clear();
        self.list.clear();
    }

    /// Takes a body of one of these shapes, with a diameter [m], whose principal axes have these directions; `None`: no polyhedron.
    pub fn push(&mut self, shapes: &[Polyhedron], body: Option<(u32, f64, &DMat3)>) {
        let Some((number, size, axes)) = body else { return self.list.push(None) };
        let (shape, corners, normals) = (&shapes[number as usize], self.corners[0].len(), self.normals.len());
        self.list.push(Some(Entry { shape: number, size, rounding: shape.rounding * size, corners, normals }));
        let turned = |corner: &DVec3| *axes * (*corner * size);
        let missing = shape.corners.len().next_multiple_of(LANES) - shape.corners.len();
        for corner in shape.corners.iter().chain(shape.corners.iter().take(1).cycle().take(missing)).map(turned) {
            for (column, x) in self.corners.iter_mut().zip(corner.to_array()) {
                column.push(x);
            }
        }
        self.normals.extend(shape.normals.iter().map(|normal| *axes * *normal));
    }

    /// Rounding radius of body number `k` [m]; `None`: no polyhedron.
    pub fn rounding(&self, k: usize) -> Option<f64> {
        self.list[k].map(|entry| entry.rounding)
    }

    /// Body number `k`, with the shapes it was taken with; `None`: no polyhedron.
    pub fn at<'a>(&'a self, k: usize, shapes: &'a [Polyhedron]) -> Option<Turned<'a>> {
        let Entry { shape, size, rounding, corners, normals } = self.list[k]?;
        let shape = &shapes[shape as usize];
        let (count, first) = (shape.corners.len(), corners);
        let lots = first..first + count.next_multiple_of(LANES);
        Some(Turned {
            shape,
            size,
            rounding,
            corners: [0, 1, 2].map(|axis| &self.corners[axis][lots.clone()]),
            count,
            normals: &self.normals[normals..normals + shape.normals.len()],
        })
    }
}
