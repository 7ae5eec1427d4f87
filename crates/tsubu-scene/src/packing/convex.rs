//! The faces of a convex body that a closed mesh encloses.

use super::polyhedron::{closed, measured};
use crate::complaint::Complaint;
use crate::mesh_check;
use crate::plan::Vector;
use crate::polyhedron::{MOST_FACES, Plane, size};
use nalgebra::Vector3;

/// How far a corner may stand before a face, over the size of the body: what single precision leaves of corners that were meant to be on it.
const TOLERANCE: f64 = 2e-6;
/// Normals of triangles of one face differ by less.
const ONE_FACE: f64 = 1e-5;

/// Unit normal and distance from the origin of each face. The complaint has yet to be placed.
pub(crate) fn faces(triangles: &[[Vector; 3]]) -> Result<Vec<(Vector, f64)>, Complaint> {
    closed(&mesh_check::diagnose(triangles))?;
    let triangles: Vec<[Vector3<f64>; 3]> =
        mesh_check::welded(triangles).into_iter().map(|triangle| triangle.map(Vector3::from)).collect();
    measured(&triangles)?;
    let corners: Vec<Vector3<f64>> = triangles.iter().flatten().copied().collect();
    let tolerance = TOLERANCE * size(&corners);
    let mut largest_first = triangles.clone();
    let normal = |[a, b, c]: &[Vector3<f64>; 3]| (b - a).cross(&(c - a));
    largest_first.sort_by(|a, b| normal(b).norm().total_cmp(&normal(a).norm()));
    let mut planes: Vec<Plane> = Vec::new();
    for triangle in &largest_first {
        let normal = normal(triangle).normalize();
        let plane = Plane { normal, offset: normal.dot(&triangle[0]) };
        let known = |other: &Plane| {
            (other.normal - normal).norm() < ONE_FACE || triangle.iter().all(|c| other.above(c).abs() <= tolerance)
        };
        if planes.iter().any(known) {
            continue;
        }
        if let Some(before) = corners.iter().find(|corner| plane.above(corner) > tolerance) {
            let [x, y, z] = [before.x, before.y, before.z];
            return Err(Complaint::new(format!(
                "the mesh is not convex, or crosses itself: its corner ({x}, {y}, {z}) stands {:.3e} before one of its faces",
                plane.above(before)
            ))
            .hint("make a concave body of spheres: shape.clump-mesh packs them into the same file"));
        }
        planes.push(plane);
    }
    if planes.len() > MOST_FACES {
        return Err(Complaint::new(format!("the mesh has {} faces, more than {MOST_FACES}", planes.len()))
            .hint("simplify it, or write shape.clump-mesh, or shape.superellipsoid for a round body"));
    }
    Ok(planes.iter().map(|plane| (plane.normal.into(), plane.offset)).collect())
}
