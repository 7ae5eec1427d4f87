//! Walls: shapes that do not fit the dimension or the motion, bodies that cannot be.

use super::Parts;
use crate::complaint::Complaint;
use crate::mesh_check;
use crate::plan::{Body, Rotation, Shape, Vector, Wall, box_of_planes};

/// How far from parallel two unit vectors may be: typed digits end somewhere.
const PARALLEL: f64 = 1e-9;

pub(super) fn check(parts: &Parts<'_>, complaints: &mut Vec<Complaint>) {
    for (name, wall) in &parts.walls {
        shape(parts, name, wall, complaints);
        if let Some(rotation) = &wall.rotation {
            turning(parts, name, wall, rotation, complaints);
        }
        if wall.servo.as_ref().is_some_and(|servo| servo.pressure.is_some()) {
            pressed(parts, name, complaints);
        }
        if let Some(body) = &wall.body {
            free(parts, name, wall, body, complaints);
        }
    }
}

fn shape(parts: &Parts<'_>, name: &str, wall: &Wall, complaints: &mut Vec<Complaint>) {
    let at = |keys: &[&str]| parts.root.locate(&[&["walls", name, "shape"], keys].concat());
    match &wall.shape {
        Shape::Cylinder { axis, length: Some(_), .. } if !parts.space() && parallel(*axis, [0.0, 1.0, 0.0]) => {
            complaints.push(
                Complaint::new(format!("the cylinder `{name}` is a circle in the plane and has no length there"))
                    .at(&at(&["cylinder", "length"]), "the axis is y, out of the plane")
                    .hint("leave `length` out"),
            );
        }
        Shape::Cone { radius, end_radius, .. } if *radius == 0.0 && *end_radius == 0.0 => complaints.push(
            Complaint::new(format!("the cone `{name}` is only a line"))
                .at(&at(&["cone", "end-radius"]), "both radii are 0"),
        ),
        Shape::Mesh { path, triangles, .. } => {
            let place = at(&["mesh", "path"]);
            let broken = |what: &str, found: &mesh_check::Found, hint: &str| {
                Complaint::new(format!("the mesh `{path}` has {what}"))
                    .at(&place, format!("{found}"))
                    .hint(hint.to_string())
            };
            let diagnosis = mesh_check::broken(triangles);
            if !diagnosis.not_finite.is_empty() {
                complaints.push(broken(
                    "corners that are no finite numbers",
                    &diagnosis.not_finite,
                    "write the mesh again, or take a smaller `scale`",
                ));
            } else if !diagnosis.degenerate.is_empty() {
                complaints.push(broken(
                    "triangles without area",
                    &diagnosis.degenerate,
                    "merge double corners and remove such triangles in a mesh editor",
                ));
            }
        }
        _ => {}
    }
}

fn turning(parts: &Parts<'_>, name: &str, wall: &Wall, rotation: &Rotation, complaints: &mut Vec<Complaint>) {
    let place = parts.root.locate(&["walls", name, "rotation", "axis"]);
    if !parts.space() && !parallel(rotation.axis, [0.0, 1.0, 0.0]) {
        complaints.push(
            Complaint::new(format!("the wall `{name}` would turn out of the plane"))
                .at(&place, "in the plane a wall turns about y")
                .hint("write axis = \"y\" or \"-y\", or set dimension = 3"),
        );
        return;
    }
    let (what, hint) = match &wall.shape {
        Shape::Plane { normal, .. } if !parallel(*normal, rotation.axis) => {
            ("an endless plane", "an endless plane can turn about its normal only; a `mesh` of two triangles can tilt")
        }
        Shape::Cylinder { axis, length: None, .. } if !parallel(*axis, rotation.axis) => {
            ("an endless cylinder", "give the cylinder a `length`, or turn it about an axis parallel to its own")
        }
        _ => return,
    };
    complaints.push(
        Complaint::new(format!("the wall `{name}` is {what}, which cannot turn about this axis"))
            .at(&place, "far away it would move without limit")
            .also(&parts.root.locate(&["walls", name, "shape"]), "this shape")
            .hint(hint),
    );
}

/// A pressure without an area acts on the face of a box of planes.
fn pressed(parts: &Parts<'_>, name: &str, complaints: &mut Vec<Complaint>) {
    let planes = box_of_planes(&parts.walls, true).filter(|_| parts.space()).unwrap_or_default();
    let number = parts.walls.keys().position(|known| known == name);
    if parts.incomplete || planes.iter().any(|(_, ends)| ends.iter().any(|end| Some(*end) == number)) {
        return;
    }
    complaints.push(
        Complaint::new(format!("the force of the wall `{name}` is not known"))
            .at(&parts.root.locate(&["walls", name, "servo"]), "`pressure` needs an `area`")
            .hint("force = \"20 N\"")
            .hint("or pressure = \"10 kPa\" and area = \"20 cm^2\"")
            .hint("or pressure alone on a face of a box of six planes, two along each of x, y and z"),
    );
}

fn free(parts: &Parts<'_>, name: &str, wall: &Wall, body: &Body, complaints: &mut Vec<Complaint>) {
    let at = |key: &str| parts.root.locate(&["walls", name, "body", key]);
    let endless = match wall.shape {
        Shape::Box { .. } => Some("a box, which holds the grains in"),
        Shape::Plane { .. } => Some("an endless plane"),
        // In the plane a circle.
        Shape::Cylinder { length: None, axis, .. } if parts.space() || !parallel(axis, [0.0, 1.0, 0.0]) => {
            Some("an endless cylinder")
        }
        Shape::Cylinder { .. } | Shape::Cone { .. } | Shape::Sphere { .. } | Shape::Mesh { .. } => None,
    };
    if let Some(what) = endless {
        complaints.push(
            Complaint::new(format!("the wall `{name}` is {what}; it cannot be a free body"))
                .at(&parts.root.locate(&["walls", name, "shape"]), "this shape")
                .also(&parts.root.locate(&["walls", name, "body"]), "free here")
                .hint("free bodies are `sphere`, `cylinder` with a length, `cone` and `mesh`"),
        );
    }
    let [x, y, z] = body.inertia;
    let positive = if parts.space() { x > 0.0 && y > 0.0 && z > 0.0 } else { y > 0.0 };
    if !positive {
        complaints.push(
            Complaint::new(format!("the moments of inertia of `{name}` must be above 0"))
                .at(&at("inertia"), "no mass has this"),
        );
    } else if parts.space() && 2.0 * x.max(y).max(z) > (x + y + z) * (1.0 + PARALLEL) {
        complaints.push(
            Complaint::new(format!("no body has the moments of inertia of `{name}`"))
                .at(&at("inertia"), "the largest is above the sum of the other two")
                .hint("is a unit wrong?"),
        );
    }
}

fn parallel(a: Vector, b: Vector) -> bool {
    let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    cross.iter().all(|x| x.abs() < PARALLEL)
}
