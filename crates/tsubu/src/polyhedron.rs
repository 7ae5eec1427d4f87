//! Convex polyhedra with rounded edges, and polygons in the plane: what they are, how they are turned, where two touch.
//!
//! A body is all that is nearer than its rounding radius to a convex core with flat faces. Two bodies touch where features of their cores are nearer to each other than both radii
//! (sphero-polyhedra: Pöschel and Buchholtz 1993, Alonso-Marroquín 2008, Galindo-Torres and Pedroso 2010): every corner of one with the whole core of the other, and every edge of
//! one with every edge of the other. Each is a contact of two spheres of the rounding radii. What it stores is a function of its distance alone, so that force and torque
//! are the slopes of an energy; and each distance has slopes without jumps, so that no force jumps as a contact wanders from one feature to another.

pub mod at_wall;
pub mod awake;
pub mod contact;
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

/// Corners are kept in lots of so many, too.
const LANES: usize = 4;

/// What is lower by this is so however it is rounded, over the diameter.
const SURE: f64 = 1e-6;

/// A core of diameter 1 about its centre of mass, along its principal axes, and how round it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polyhedron {
    corners: Vec<DVec3>,
    normals: Vec<DVec3>,
    /// Corners as columns, the first once more up to whole lots.
    columns: [Vec<f64>; 3],
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
    /// The ends of each edge as those faces go round it.
    ways: Vec<[[usize; 2]; 2]>,
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
            columns: columns(&corners),
            count: corners.len(),
            corners,
            normals,
            offsets: plan.faces.iter().map(|face| face.offset).collect(),
            discs: (0..plan.faces.len()).map(|face| disc(plan, face)).collect(),
            round,
            edges: plan.edges.clone(),
            sides: plan.edges.iter().map(|edge| sides(plan, edge)).collect(),
            ways: plan.edges.iter().map(|edge| sides(plan, edge).map(|face| way(plan, edge, face))).collect(),
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

/// The ends of an edge as one of its faces goes round it.
fn way(plan: &plan::Polyhedron, [a, b]: &[usize; 2], face: usize) -> [usize; 2] {
    let round = &plan.faces[face].corners;
    let goes = round.iter().zip(round.iter().cycle().skip(1)).any(|ends| ends == (a, b));
    if goes { [*a, *b] } else { [*b, *a] }
}

/// The core of a sphere: a point.
static POINT: Polyhedron = Polyhedron {
    corners: Vec::new(),
    normals: Vec::new(),
    columns: [const { Vec::new() }; 3],
    count: 1,
    offsets: Vec::new(),
    discs: Vec::new(),
    round: Vec::new(),
    faces: Vec::new(),
    edges: Vec::new(),
    sides: Vec::new(),
    ways: Vec::new(),
    rounding: 0.5,
};

/// A body as it is turned, about its centre. Its corners and normals are turned when they are asked for: that is less work than to fetch them from memory.
#[derive(Clone, Copy, Debug)]
pub struct Turned<'a> {
    shape: &'a Polyhedron,
    /// Diameter [m].
    size: f64,
    /// Rounding radius [m].
    pub rounding: f64,
    /// Its principal axes.
    axes: DMat3,
}

impl<'a> Turned<'a> {
    /// A sphere of a radius [m].
    pub fn sphere(radius: f64) -> Self {
        Self { shape: &POINT, size: 2.0 * radius, rounding: radius, axes: DMat3::IDENTITY }
    }

    #[inline]
    fn corner(&self, i: usize) -> DVec3 {
        // Of a sphere its centre.
        self.turned(self.shape.corners.get(i).map_or(DVec3::ZERO, |corner| *corner * self.size))
    }

    /// A vector along the principal axes as it is turned.
    #[inline]
    fn turned(&self, v: DVec3) -> DVec3 {
        let DMat3 { x_axis, y_axis, z_axis } = self.axes;
        x_axis * v.x + y_axis * v.y + z_axis * v.z
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

    /// Whether it is no sphere.
    #[inline]
    pub fn is_faceted(&self) -> bool {
        self.faces() > 0
    }

    #[inline]
    fn normal(&self, face: usize) -> DVec3 {
        self.turned(self.shape.normals[face])
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
        if self.shape.corners.is_empty() { 0.0 } else { lowest(&self.shape.columns, self.size, &self.axes, n) }
    }
}

/// The least height along a direction of corners of diameter 1, of a body of some size as it is turned.
#[multiversion(targets = "simd")]
fn lowest(columns: &[Vec<f64>; 3], size: f64, axes: &DMat3, n: DVec3) -> f64 {
    // Plain loops: here the compiler leaves iterators as calls.
    let [x, y, z] = columns;
    let (x, y, z) = (x.as_chunks::<LANES>().0, y.as_chunks::<LANES>().0, z.as_chunks::<LANES>().0);
    let DMat3 { x_axis: a, y_axis: b, z_axis: c } = *axes;
    let mut low = [f64::INFINITY; LANES];
    for k in 0..x.len().min(y.len()).min(z.len()) {
        for l in 0..LANES {
            let (x, y, z) = (x[k][l] * size, y[k][l] * size, z[k][l] * size);
            let corner = a * x + b * y + c * z;
            let height = n.x * corner.x + n.y * corner.y + n.z * corner.z;
            low[l] = if height < low[l] { height } else { low[l] };
        }
    }
    low.into_iter().fold(f64::INFINITY, f64::min)
}

/// Which polyhedron a body is.
#[derive(Clone, Copy, Debug)]
pub struct Faceted {
    /// The number of its shape.
    pub shape: u32,
    /// Diameter [m].
    pub size: f64,
    rounding: f64,
}

impl Faceted {
    /// A body of one of these shapes, with a diameter [m].
    pub fn new(shape: u32, size: f64, shapes: &[Polyhedron]) -> Self {
        Self { shape, size, rounding: shapes[shape as usize].rounding * size }
    }

    /// Rounding radius [m].
    pub fn rounding(&self) -> f64 {
        self.rounding
    }

    /// As it is turned, so that its principal axes have these directions.
    #[inline]
    pub fn at<'a>(&self, shapes: &'a [Polyhedron], axes: &DMat3) -> Turned<'a> {
        let Self { shape, size, rounding } = *self;
        Turned { shape: &shapes[shape as usize], size, rounding, axes: *axes }
    }
}
