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

/// Corners and normals of a body are kept in lots of so many.
const LANES: usize = 4;

/// What is lower by this is so however it is rounded, over the diameter.
const SURE: f64 = 1e-6;

/// A core of diameter 1 about its centre of mass, along its principal axes, and how round it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polyhedron {
    corners: Vec<DVec3>,
    normals: Vec<DVec3>,
    /// Corners and normals as columns, the first once more up to whole lots.
    columns: [[Vec<f64>; 3]; 2],
    /// Length of these columns.
    lots: [usize; 2],
    /// How many corners there are.
    count: usize,
    /// Distances of the faces from the centre.
    offsets: Vec<f64>,
    /// Squared radii of the discs on the faces about the feet of the centre, see [`Turned::is_amid`].
    discs: Vec<f64>,
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
        let corners: Vec<DVec3> = plan.corners.iter().map(|corner| DVec3::from_array(*corner)).collect();
        let normals: Vec<DVec3> = plan.faces.iter().map(|face| DVec3::from_array(face.normal)).collect();
        Self {
            faces: faces.collect(),
            columns: [columns(&corners), columns(&normals)],
            lots: [corners.len(), normals.len()].map(|count| count.next_multiple_of(LANES)),
            count: corners.len(),
            corners,
            normals,
            offsets: plan.faces.iter().map(|face| face.offset).collect(),
            discs: (0..plan.faces.len()).map(|face| disc(plan, face)).collect(),
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

/// Vectors as columns, the first once more up to whole lots.
fn columns(vectors: &[DVec3]) -> [Vec<f64>; 3] {
    let more = vectors.len().next_multiple_of(LANES) - vectors.len();
    let lots = vectors.iter().chain(vectors.iter().take(1).cycle().take(more));
    [0, 1, 2].map(|axis| lots.clone().map(|vector| vector[axis]).collect())
}

/// The squared radius of the disc on a face about the foot of the centre that lies lower than all other faces, and surely so; 0 where there is none, and on a side of a polygon.
fn disc(plan: &plan::Polyhedron, face: usize) -> f64 {
    let own = &plan.faces[face];
    let normal = DVec3::from_array(own.normal);
    let others = plan.faces.iter().enumerate().filter(|(other, _)| *other != face && own.corners.len() > 2);
    let radius = others.map(|(_, other)| {
        let along = normal.dot(DVec3::from_array(other.normal));
        // How far the foot is below the other, and how fast that rises away from it.
        let (below, rise) = (other.offset - along * own.offset - SURE, (1.0 - along * along).max(0.0).sqrt());
        if below > 0.0 { below / rise } else { 0.0 }
    });
    radius.reduce(f64::min).unwrap_or_default().powi(2)
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
    columns: [const { [const { Vec::new() }; 3] }; 2],
    lots: [LANES, 0],
    count: 1,
    offsets: Vec::new(),
    discs: Vec::new(),
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
    /// Corners [m] and normals as columns, see [`Polyhedron::lots`].
    columns: &'a [f64],
}

impl<'a> Turned<'a> {
    /// A sphere of a radius [m].
    pub fn sphere(radius: f64) -> Self {
        Self { shape: &POINT, size: 2.0 * radius, rounding: radius, columns: &[0.0; 3 * LANES] }
    }

    #[inline]
    fn corner(&self, i: usize) -> DVec3 {
        self.vector(i, self.shape.lots[0])
    }

    /// A vector that begins in one column of some length, and goes on in the next two.
    #[inline]
    fn vector(&self, i: usize, length: usize) -> DVec3 {
        DVec3::new(self.columns[i], self.columns[i + length], self.columns[i + 2 * length])
    }

    /// Corners of the core, each with its number [m].
    pub fn corners(self) -> impl Iterator<Item = (usize, DVec3)> + 'a {
        (0..self.shape.count).map(move |i| (i, self.corner(i)))
    }

    /// How many faces it has.
    #[inline]
    fn faces(&self) -> usize {
        self.shape.offsets.len()
    }

    #[inline]
    fn normal(&self, face: usize) -> DVec3 {
        let [corners, normals] = self.shape.lots;
        self.vector(3 * corners + face, normals)
    }

    /// How far a point is above a face [m].
    #[inline]
    fn above(&self, face: usize, point: DVec3) -> f64 {
        self.normal(face).dot(point) - self.shape.offsets[face] * self.size
    }

    /// Whether a point is so near to the axis of a face that it lies straight above that for sure; above the face, no other is as far below it.
    #[inline]
    fn is_amid(&self, face: usize, point: DVec3) -> bool {
        let along = self.normal(face).dot(point);
        point.length_squared() - along * along < self.shape.discs[face] * (self.size * self.size)
    }

    /// How far the corner that reaches farthest against a direction does, below 0 [m].
    #[inline]
    fn lowest(&self, n: DVec3) -> f64 {
        let (x, others) = self.columns.split_at(self.shape.lots[0]);
        let (y, others) = others.split_at(x.len());
        let [x, y, z] = [x, y, &others[..x.len()]];
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
    /// The columns of its corners and of its normals, one after the other; room for those of any shape.
    columns: Box<[f64]>,
}

impl TurnedBody {
    /// A body of one of these shapes, with a diameter [m], along its principal axes.
    pub fn new(shape: u32, size: f64, shapes: &[Polyhedron]) -> Self {
        let room = shapes.iter().map(|shape| 3 * (shape.lots[0] + shape.lots[1])).max().unwrap_or_default();
        let rounding = shapes[shape as usize].rounding * size;
        let mut body = Self { shape, size, rounding, columns: vec![0.0; room].into() };
        body.turn(shapes, &DMat3::IDENTITY);
        body
    }

    /// Rounding radius [m].
    pub fn rounding(&self) -> f64 {
        self.rounding
    }

    /// Each gets the memory of the other; what that holds is to be found anew.
    pub fn swap_memory(&mut self, other: &mut Self) {
        std::mem::swap(&mut self.columns, &mut other.columns);
    }

    /// Turns it so that its principal axes have these directions.
    pub fn turn(&mut self, shapes: &[Polyhedron], axes: &DMat3) {
        let Polyhedron { columns: [corners, normals], lots, .. } = &shapes[self.shape as usize];
        let (of_corners, others) = self.columns.split_at_mut(3 * lots[0]);
        turn(corners, self.size, axes, of_corners);
        turn(normals, 1.0, axes, &mut others[..3 * lots[1]]);
    }

    /// As it is turned.
    #[inline]
    pub fn at<'a>(&'a self, shapes: &'a [Polyhedron]) -> Turned<'a> {
        let Self { shape, size, rounding, ref columns } = *self;
        Turned { shape: &shapes[shape as usize], size, rounding, columns }
    }
}

/// Vectors of a body of some size from those of diameter 1.
#[multiversion(targets = "simd")]
fn turn([x, y, z]: &[Vec<f64>; 3], size: f64, axes: &DMat3, vectors: &mut [f64]) {
    let [x, y, z] = [x, y, z].map(|column| column.as_chunks::<LANES>().0);
    let columns = axes.to_cols_array_2d();
    for (row, turned) in vectors.chunks_exact_mut(vectors.len() / 3).enumerate() {
        let [a, b, c] = [columns[0][row], columns[1][row], columns[2][row]];
        for (turned, ((x, y), z)) in turned.as_chunks_mut::<LANES>().0.iter_mut().zip(x.iter().zip(y).zip(z)) {
            for l in 0..LANES {
                turned[l] = a * (x[l] * size) + b * (y[l] * size) + c * (z[l] * size);
            }
        }
    }
}
