//! Convex polyhedra with rounded edges, and polygons in the plane: what they are, how they are turned, where two touch.
//!
//! A body is all that is nearer than its rounding radius to a convex core with flat faces. Two bodies touch where features of their cores are nearer to each other than both radii
//! (sphero-polyhedra: Pöschel and Buchholtz 1993, Alonso-Marroquín 2008, Galindo-Torres and Pedroso 2010): every corner of one with the whole core of the other, and every edge of
//! one with every edge of the other. Each is a contact of two spheres of the rounding radii. What it stores is a function of its distance alone, so that force and torque
//! are the slopes of an energy; and each distance has slopes without jumps, so that no force jumps as a contact wanders from one feature to another.

pub mod at_wall;
mod crossing;
mod cut;
pub mod near;
mod nearest;
pub mod touch;
pub mod with_round;

use glam::{DMat3, DVec3};
use multiversion::multiversion;
use std::ops::Range;
use tsubu_scene::plan;

/// Corners of a body are kept in lots of so many.
const LANES: usize = 4;

/// A core of diameter 1 about its centre of mass, along its principal axes, and how round it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polyhedron {
    corners: Vec<DVec3>,
    /// The same as columns, the first once more up to whole lots.
    columns: [Vec<f64>; 3],
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
        let more = plan.corners.len().next_multiple_of(LANES) - plan.corners.len();
        let lots = plan.corners.iter().chain(plan.corners.iter().take(1).cycle().take(more));
        Self {
            faces: faces.collect(),
            columns: [0, 1, 2].map(|axis| lots.clone().map(|corner| corner[axis]).collect()),
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
    columns: [const { Vec::new() }; 3],
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
        let [x, y, z] = self.corners;
        let [x, y, z] = [x.as_chunks::<LANES>().0, y.as_chunks::<LANES>().0, z.as_chunks::<LANES>().0];
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

/// The memory of a body as it is turned.
#[derive(Clone, Debug)]
pub struct TurnedBody {
    /// The number of its shape.
    pub shape: u32,
    /// Diameter [m].
    pub size: f64,
    rounding: f64,
    /// A column of x after the other, then y, then z.
    corners: Box<[f64]>,
    normals: Box<[DVec3]>,
}

impl TurnedBody {
    /// A body of one of these shapes, with a diameter [m], along its principal axes.
    pub fn new(shape: u32, size: f64, shapes: &[Polyhedron]) -> Self {
        let of = &shapes[shape as usize];
        let (corners, normals) = (3 * of.columns[0].len(), of.normals.len());
        let mut body = Self {
            shape,
            size,
            rounding: of.rounding * size,
            corners: vec![0.0; corners].into(),
            normals: vec![DVec3::ZERO; normals].into(),
        };
        body.turn(shapes, &DMat3::IDENTITY);
        body
    }

    /// Rounding radius [m].
    pub fn rounding(&self) -> f64 {
        self.rounding
    }

    /// Turns it so that its principal axes have these directions.
    pub fn turn(&mut self, shapes: &[Polyhedron], axes: &DMat3) {
        let shape = &shapes[self.shape as usize];
        turn(&shape.columns, self.size, axes, &mut self.corners);
        for (turned, normal) in self.normals.iter_mut().zip(&shape.normals) {
            *turned = *axes * *normal;
        }
    }

    /// As it is turned.
    #[inline]
    pub fn at<'a>(&'a self, shapes: &'a [Polyhedron]) -> Turned<'a> {
        let shape = &shapes[self.shape as usize];
        let (x, others) = self.corners.split_at(self.corners.len() / 3);
        let (y, z) = others.split_at(x.len());
        let (count, corners) = (shape.corners.len(), [x, y, z]);
        Turned { shape, size: self.size, rounding: self.rounding, corners, count, normals: &self.normals }
    }
}

/// Corners of a body of some size from those of diameter 1.
#[multiversion(targets = "simd")]
fn turn([x, y, z]: &[Vec<f64>; 3], size: f64, axes: &DMat3, corners: &mut [f64]) {
    let [x, y, z] = [x, y, z].map(|column| column.as_chunks::<LANES>().0);
    let columns = axes.to_cols_array_2d();
    for (row, turned) in corners.chunks_exact_mut(corners.len() / 3).enumerate() {
        let [a, b, c] = [columns[0][row], columns[1][row], columns[2][row]];
        for (turned, ((x, y), z)) in turned.as_chunks_mut::<LANES>().0.iter_mut().zip(x.iter().zip(y).zip(z)) {
            for l in 0..LANES {
                turned[l] = a * (x[l] * size) + b * (y[l] * size) + c * (z[l] * size);
            }
        }
    }
}
