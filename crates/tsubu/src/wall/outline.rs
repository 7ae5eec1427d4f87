//! What a wall looks like in pictures.

use super::frustum::Frustum;
use super::shell::SphericalShell;
use super::{Pose, Surface};
use glam::DVec3;
use std::f64::consts::{PI, TAU};
use tsubu_scene::plan::Shape;

/// Pieces of a full circle.
const PIECES: usize = 72;

/// Lines and triangles of a wall, for pictures only.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outline {
    /// Closed lines by their corners [m]; two corners are a straight line.
    pub lines: Vec<Vec<DVec3>>,
    /// Triangles [m].
    pub triangles: Vec<[DVec3; 3]>,
}

impl Outline {
    /// As drawn: lines in the plane, surfaces in space; boxes and planes are lines in both. Endless things are cut off:
    /// a plane is 1 m long, a cylinder four radii about the foot of its point.
    pub(super) fn new(shape: &Shape, surface: &Surface, dimension: u8) -> Self {
        match (surface, dimension) {
            (Surface::HalfSpaces { .. }, _) => Self { lines: edges(shape, dimension), triangles: Vec::new() },
            (Surface::Frustum(frustum), 2) => Self { lines: section(frustum, PIECES), triangles: Vec::new() },
            (Surface::Frustum(frustum), _) => Self { lines: Vec::new(), triangles: skin(frustum, PIECES) },
            (Surface::Shell(shell), 2) => {
                Self { lines: vec![circle(shell.centre, shell.radius, PIECES)], triangles: Vec::new() }
            }
            (Surface::Shell(shell), _) => Self { lines: Vec::new(), triangles: globe(shell, PIECES) },
            (Surface::Mesh(mesh), 2) => Self { lines: mesh.lines(), triangles: Vec::new() },
            (Surface::Mesh(mesh), _) => {
                Self { lines: Vec::new(), triangles: mesh.triangles().iter().map(|t| t.corners).collect() }
            }
        }
    }

    /// A piece of a plane about the foot of a point, `half` [m] to each side: a line in the plane, a square in space.
    pub(crate) fn of_plane(point: DVec3, normal: DVec3, about: DVec3, half: f64, in_space: bool) -> Self {
        let foot = about - normal * (about - point).dot(normal);
        let along = normal.cross(DVec3::Y);
        let along = if along.length_squared() > 1e-12 { along.normalize() } else { DVec3::X } * half;
        if !in_space {
            return Self { lines: vec![vec![foot - along, foot + along]], triangles: Vec::new() };
        }
        let across = normal.cross(along);
        let square = [foot - along - across, foot + along - across, foot + along + across, foot - along + across];
        let mut triangles = Vec::new();
        quad(&mut triangles, square);
        Self { lines: vec![square.to_vec()], triangles }
    }

    /// Where it is now.
    pub(super) fn placed(&self, pose: &Pose) -> Self {
        let place = |p: DVec3| pose.to_world(p);
        Self {
            lines: self.lines.iter().map(|line| line.iter().copied().map(place).collect()).collect(),
            triangles: self.triangles.iter().map(|t| t.map(place)).collect(),
        }
    }
}

/// Closed lines of a box or plane: round it in the plane, round every side in space.
fn edges(shape: &Shape, dimension: u8) -> Vec<Vec<DVec3>> {
    match shape {
        Shape::Plane { point, normal } => {
            let along = DVec3::from_array(*normal).cross(DVec3::Y);
            vec![[-0.5, 0.5].map(|s| DVec3::from_array(*point) + along * s).to_vec()]
        }
        Shape::Box { width, height, depth, floor_centre } => {
            let c = DVec3::from_array(*floor_centre);
            let half = DVec3::new(0.5 * width, if dimension == 3 { 0.5 * depth } else { 0.0 }, 0.5 * height);
            let at = |x: f64, y: f64, z: f64| c + DVec3::new(x, y, z + 1.0) * half;
            let round = |y: f64| vec![at(-1.0, y, -1.0), at(1.0, y, -1.0), at(1.0, y, 1.0), at(-1.0, y, 1.0)];
            if dimension == 2 {
                return vec![round(0.0)];
            }
            let side = |x: f64| vec![at(x, -1.0, -1.0), at(x, 1.0, -1.0), at(x, 1.0, 1.0), at(x, -1.0, 1.0)];
            vec![round(-1.0), round(1.0), side(-1.0), side(1.0)]
        }
        Shape::Cylinder { .. } | Shape::Cone { .. } | Shape::Sphere { .. } | Shape::Mesh { .. } => Vec::new(),
    }
}

/// A circle in the plane (x, z).
pub(super) fn circle(centre: DVec3, radius: f64, pieces: usize) -> Vec<DVec3> {
    let at = |k: usize| TAU * k as f64 / pieces as f64;
    (0..pieces).map(|k| centre + radius * DVec3::new(at(k).cos(), 0.0, at(k).sin())).collect()
}

/// Centres of both ends of a frustum.
fn ends(frustum: &Frustum) -> [DVec3; 2] {
    match frustum.length {
        Some(length) => [frustum.point, frustum.point + frustum.axis * length],
        None => [-2.0, 2.0].map(|s| frustum.point + frustum.axis * (s * frustum.radius[0])),
    }
}

/// Where the plane (x, z) cuts a frustum: a circle, or two straight lines.
pub(super) fn section(frustum: &Frustum, pieces: usize) -> Vec<Vec<DVec3>> {
    let across = frustum.axis.cross(DVec3::Y);
    if across.length_squared() < 1e-12 {
        return vec![circle(frustum.point, frustum.radius[0], pieces)];
    }
    let across = across.normalize();
    let [start, end] = ends(frustum);
    let [r0, r1] = frustum.radius;
    [1.0, -1.0].map(|side| vec![start + across * (side * r0), end + across * (side * r1)]).to_vec()
}

/// The curved surface in strips from end to end.
pub(super) fn skin(frustum: &Frustum, pieces: usize) -> Vec<[DVec3; 3]> {
    let u = frustum.across_axis();
    let v = frustum.axis.cross(u);
    let [start, end] = ends(frustum);
    let [r0, r1] = frustum.radius;
    let around = |k: usize| {
        // The last piece ends where the first begins, to the last bit.
        let (sin, cos) = (TAU * (k % pieces) as f64 / pieces as f64).sin_cos();
        u * cos + v * sin
    };
    let mut triangles = Vec::new();
    for k in 0..pieces {
        let (a, b) = (around(k), around(k + 1));
        quad(&mut triangles, [start + a * r0, start + b * r0, end + b * r1, end + a * r1]);
    }
    triangles
}

/// A sphere by longitude and latitude, of an even number of pieces.
pub(super) fn globe(shell: &SphericalShell, pieces: usize) -> Vec<[DVec3; 3]> {
    let at = |i: usize, j: usize| {
        let (sin, cos) = (TAU * (i % pieces) as f64 / pieces as f64).sin_cos();
        let (sin_height, cos_height) = (TAU * j as f64 / pieces as f64 - 0.5 * PI).sin_cos();
        shell.centre + shell.radius * DVec3::new(cos * cos_height, sin * cos_height, sin_height)
    };
    let mut triangles = Vec::new();
    for j in 0..pieces / 2 {
        for i in 0..pieces {
            quad(&mut triangles, [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    triangles
}

/// Two triangles; one or none where corners fall together at a tip or pole.
fn quad(triangles: &mut Vec<[DVec3; 3]>, [a, b, c, d]: [DVec3; 4]) {
    let halves = [[a, b, c], [a, c, d]];
    let tiny = 1e-12 * a.distance_squared(c);
    triangles.extend(halves.into_iter().filter(|[a, b, c]| (*b - *a).cross(*c - *a).length() > tiny));
}
