//! What scenes with bodies that are no spheres cannot have yet.

use crate::engine::{Note, Refusal, Verdict};
use glam::DVec3;
use tsubu_scene::plan::{GrainShape, Integrator, Particles, Plan, Shape, Wall};

/// Refuses it by name.
pub(in crate::dem) fn refused(plan: &Plan) -> Result<(), Refusal> {
    if !plan.particles.values().any(|group| group.shape.is_clump()) {
        return Ok(());
    }
    let mut notes = Vec::new();
    let mut refuse =
        |key: String, text: &str| notes.push(Note { key, verdict: Verdict::Refused, text: text.to_owned() });
    if plan.dem.integrator != Integrator::VelocityVerlet {
        let text = "bodies that are no spheres are moved by `velocity-verlet` alone; leave the key out";
        refuse("dem.integrator".to_owned(), text);
    }
    one_piece(plan, refuse);
    if notes.is_empty() { Ok(()) } else { Err(Refusal { method: "dem", notes }) }
}

/// What goes with clumps, but not with superellipsoids, polyhedra and polygons.
fn one_piece(plan: &Plan, mut refuse: impl FnMut(String, &str)) {
    let round = |group: &Particles| matches!(group.shape, GrainShape::Superellipsoid { .. });
    let groups = || plan.particles.iter().filter(|(_, group)| round(group) || group.shape.is_polyhedron());
    let Some((_, first)) = groups().next() else { return };
    let plural = first.shape.plural();
    let superellipsoids = groups().find(|(_, group)| round(group)).map(|(_, group)| group.shape.plural());
    for (name, wall) in &plan.walls {
        let key = format!("walls.{name}.shape");
        if open_ends(plan, wall) {
            let text = format!(
                "{plural} do not touch the rims of open ends; close both by planes at right angles to the axis that stand still, leave `length` out, or write a mesh"
            );
            refuse(key, &text);
        } else if let (Shape::Sphere { .. }, Some(plural)) = (&wall.shape, superellipsoids) {
            refuse(key, &format!("{plural} do not touch shells yet; write a mesh"));
        }
    }
}

/// Whether a cylinder or cone has rims that grains may touch: ends without a plane that holds grains back from them for good.
fn open_ends(plan: &Plan, wall: &Wall) -> bool {
    let (point, axis, length) = match &wall.shape {
        Shape::Cylinder { point, axis, length: Some(length), .. } if plan.dimension == 3 || axis[1].abs() < 0.5 => {
            (point, axis, *length)
        }
        Shape::Cone { point, axis, length, .. } => (point, axis, *length),
        _ => return false,
    };
    let (point, axis) = (DVec3::from_array(*point), DVec3::from_array(*axis));
    let along = |direction: &[f64; 3]| DVec3::from_array(*direction).dot(axis);
    let still = |wall: &Wall| {
        let Wall { host, motion, rotation, servo, body, until, .. } = wall;
        let moved = host.is_some() || motion.is_some() || servo.is_some() || body.is_some() || until.is_some();
        !moved && rotation.as_ref().is_none_or(|rotation| along(&rotation.axis).abs() > 1.0 - 1e-9)
    };
    let closed = |end: DVec3, inwards: f64| {
        plan.walls.values().filter(|wall| still(wall)).any(|wall| match &wall.shape {
            Shape::Plane { point, normal } => {
                inwards * along(normal) > 1.0 - 1e-9
                    && inwards * (DVec3::from_array(*point) - end).dot(axis) >= -1e-9 * length
            }
            _ => false,
        })
    };
    !(still(wall) && closed(point, 1.0) && closed(point + axis * length, -1.0))
}
