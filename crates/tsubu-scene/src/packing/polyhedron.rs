//! Volume, centre of mass and moments of inertia of what triangles enclose.

use crate::clump::{Integrals, Solid};
use crate::complaint::Complaint;
use crate::mesh_check::Diagnosis;
use nalgebra::{Matrix3, Vector3};

/// Volume over surface and width below which a body is a sheet.
const THIN: f64 = 1e-6;

/// Refuses what encloses nothing: the complaint has yet to be placed.
pub(super) fn closed(found: &Diagnosis) -> Result<(), Complaint> {
    // A body's mesh is in any unit.
    let refuse = |what: String, hint: &str| Err(Complaint::new(what.trim_end_matches(" m")).hint(hint));
    if !found.not_finite.is_empty() {
        return refuse(
            format!("the mesh has corners that are no finite numbers: {}", found.not_finite.count),
            "repair it",
        );
    }
    if !found.degenerate.is_empty() {
        let hint = "remove them from the mesh file and close what is left";
        return refuse(format!("the mesh has triangles without area: {}", found.degenerate), hint);
    }
    if !found.open_edges.is_empty() {
        let hint = "a body needs a closed surface: close it in the mesh file";
        return refuse(format!("the mesh is open: edges with one triangle: {}", found.open_edges), hint);
    }
    for (what, found, hint) in [
        ("has triangles twice", &found.duplicated, "remove one of each from the mesh file"),
        (
            "has edges that more than two triangles share",
            &found.crowded_edges,
            "part it into one file a body, or join the bodies",
        ),
        ("turns inside out along edges", &found.flipped_edges, "turn the triangles so that all normals point outwards"),
    ] {
        if !found.is_empty() {
            return refuse(format!("the mesh {what}: {found}"), hint);
        }
    }
    Ok(())
}

/// The solid and its surface. By the divergence theorem integrals over a polyhedron are sums over its triangles (Mirtich 1996); here over the
/// tetrahedra, with their signs, from a point to each triangle: of 1, x and x x' they are exact.
pub(super) fn measured(triangles: &[[Vector3<f64>; 3]]) -> Result<(Solid, f64), Complaint> {
    // From a point near by, or digits are lost.
    let count = 3.0 * triangles.len() as f64;
    let origin = triangles.iter().flatten().sum::<Vector3<f64>>() / count;
    let extent = triangles.iter().flatten().map(|corner| (corner - origin).norm()).fold(0.0, f64::max);
    let (mut sum, mut surface) = (Integrals::default(), 0.0);
    for triangle in triangles {
        let [a, b, c] = triangle.map(|corner| corner - origin);
        let volume = a.dot(&b.cross(&c)) / 6.0;
        let total = a + b + c;
        let squares: Matrix3<f64> = [a, b, c, total].iter().map(|v| v * v.transpose()).sum();
        sum.add(&Integrals { volume, first: total * (volume / 4.0), second: squares * (volume / 20.0) });
        surface += 0.5 * (b - a).cross(&(c - a)).norm();
    }
    if sum.volume.abs() <= THIN * surface * extent {
        return Err(Complaint::new("the mesh is flat: it encloses no volume")
            .hint("a clump needs a body with some thickness everywhere"));
    }
    if sum.volume < 0.0 {
        return Err(Complaint::new("the mesh is inside out: its volume is negative")
            .hint("turn its triangles in the mesh file, so that all normals point outwards"));
    }
    let mut solid = sum.solid();
    solid.centre = (Vector3::from(solid.centre) + origin).into();
    Ok((solid, surface))
}
