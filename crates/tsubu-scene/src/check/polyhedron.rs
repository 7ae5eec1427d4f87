//! Corners and rounding radii that are no polyhedron and no polygon.

use super::Parts;
use crate::complaint::Complaint;
use crate::plan::{GrainShape, Particles, Vector, planes_of_cells};
use crate::polyhedron::{Flaw, MOST_CORNERS, Plane, core, crossing, faces, largest_rounding};
use nalgebra::Vector3;

pub(super) fn check(parts: &Parts<'_>, name: &str, group: &Particles, complaints: &mut Vec<Complaint>) {
    let space = !group.shape.is_flat();
    if !group.shape.is_polyhedron() {
        return;
    }
    let Some(choice) = group.shape.clump_key() else { return };
    let at = |keys: &[&str]| parts.root.locate(&[&["particles", name, "shape", choice], keys].concat());
    if space != parts.space() {
        let (what, has, hint) = if space {
            ("polyhedra", "space", "set dimension = 3, or write shape.polygon")
        } else {
            ("polygons", "the plane", "set dimension = 2, or write shape.polyhedron")
        };
        complaints.push(
            Complaint::new(format!("the grains `{name}` are {what}, which only {has} has"))
                .at(&at(&[]), format!("the scene has dimension {}", if parts.space() { 3 } else { 2 }))
                .hint(hint),
        );
        return;
    }
    let (planes, rounding) = match &group.shape {
        GrainShape::Polyhedron { corners, rounding, .. } | GrainShape::Polygon { corners, rounding, .. } => {
            match of_corners(corners, space) {
                Ok(planes) => (planes, *rounding),
                Err((index, what, hint)) => {
                    let number = index.map(|index| index.to_string());
                    let place = match &number {
                        Some(number) => at(&["corners", number]),
                        None => at(&["corners"]),
                    };
                    let (body, means) = if space { ("polyhedron", "a body") } else { ("polygon", "an area") };
                    let title = format!("the corners of the {body} `{name}` are not those of {means} without bays");
                    complaints.push(Complaint::new(title).at(&place, what).hint(hint));
                    return;
                }
            }
        }
        GrainShape::PolyhedronMesh { faces, rounding, .. } => {
            let plane = |(normal, offset): &(Vector, f64)| Plane { normal: Vector3::from(*normal), offset: *offset };
            (faces.iter().map(plane).collect(), *rounding)
        }
        GrainShape::Cells { rounding, .. } => {
            (group.shape.cells().and_then(|cells| planes_of_cells(&cells)).unwrap_or_default(), *rounding)
        }
        _ => return,
    };
    // A file that could not be read is complained about already.
    if !planes.is_empty() && core(&planes, rounding, space).is_none() {
        let most = largest_rounding(&planes, space);
        complaints.push(
            Complaint::new(format!("the rounding radius of `{name}` leaves nothing of the body"))
                .at(
                    &at(&["rounding"]),
                    format!("{rounding} is not below {most:.4}, the radius of what just fits into it"),
                )
                .hint(format!("one tenth of that is a good beginning: {:.3}", 0.1 * most)),
        );
    }
}

/// What is wrong with corners: which one, what to say of it, and what to do.
type Wrong = (Option<usize>, String, &'static str);

fn of_corners(corners: &[Vector], space: bool) -> Result<Vec<Plane>, Wrong> {
    let points: Vec<Vector3<f64>> = corners.iter().map(|corner| Vector3::from(*corner)).collect();
    if points.len() > MOST_CORNERS {
        let what = format!("{} corners, at most {MOST_CORNERS}", points.len());
        return Err((None, what, "leave out what matters least; shape.superellipsoid is for round bodies"));
    }
    let concave = "a body with bays is made of spheres: shape.clump or shape.clump-mesh";
    let planes = faces(&points, space).map_err(|flaw| match flaw {
        Flaw::Few(count) => {
            let needs = if space { 4 } else { 3 };
            (None, format!("{count} corners, needs {needs} or more"), "add corners")
        }
        Flaw::Flat if space => {
            (None, "all are in one plane".to_owned(), "a body needs some thickness; in the plane write shape.polygon")
        }
        Flaw::Flat => (None, "all are on one line".to_owned(), "an area needs some width"),
        Flaw::Twice(first, second) => (Some(second), format!("corner {} once more", first + 1), "leave it out"),
        Flaw::Within(index) => (Some(index), "lies within the others, on a face or on an edge".to_owned(), concave),
    })?;
    match crossing(&points).filter(|_| !space) {
        Some(index) => Err((
            Some(index),
            "the way from corner to corner crosses itself here".to_owned(),
            "write them one after the other, all the way round",
        )),
        None => Ok(planes),
    }
}
