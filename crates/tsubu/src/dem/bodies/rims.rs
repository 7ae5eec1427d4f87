//! Curved walls whose rims bodies touch that are neither spheres nor made of them.

use crate::check::length;
use crate::engine::{Note, Verdict};
use crate::wall::{Faceted, Wall};
use glam::DVec3;
use tsubu_scene::plan::{self, GrainShape, Particles, Plan, Shape};

/// Share of the smallest radius by which facets may be off.
const OFF: f64 = 0.005;

/// Puts meshes in the place of cylinders and cones with open ends, and for superellipsoids of spheres, and tells so. `smallest`: diameter
/// of the smallest grain [m].
pub(in crate::dem) fn facet(plan: &Plan, walls: &mut [Wall], smallest: f64) -> Vec<Note> {
    let round = |group: &Particles| matches!(group.shape, GrainShape::Superellipsoid { .. });
    let mut groups = plan.particles.values().filter(|group| round(group) || group.shape.is_polyhedron());
    let Some(first) = groups.next() else { return Vec::new() };
    let superellipsoids = round(first) || groups.any(round);
    let mut notes = Vec::new();
    for ((name, of), wall) in plan.walls.iter().zip(walls) {
        let as_mesh = open_ends(plan, name, of) || superellipsoids && matches!(of.shape, Shape::Sphere { .. });
        if as_mesh
            && let Some(Faceted { facets, off }) = wall.facet(0.5 * OFF * smallest)
            && off > 0.0
        {
            let text =
                format!("grains touch it as a mesh of {facets} facets round a circle, off by {} at most", length(off));
            notes.push(Note { key: format!("walls.{name}.shape"), verdict: Verdict::Approximated, text });
        }
    }
    notes
}

/// Whether a cylinder or cone has rims that grains may touch: ends without a plane that holds grains back from them for good.
fn open_ends(plan: &Plan, name: &str, wall: &plan::Wall) -> bool {
    let (point, axis, length) = match &wall.shape {
        Shape::Cylinder { point, axis, length: Some(length), .. } if plan.dimension == 3 || axis[1].abs() < 0.5 => {
            (point, axis, *length)
        }
        Shape::Cone { point, axis, length, .. } => (point, axis, *length),
        _ => return false,
    };
    let (point, axis) = (DVec3::from_array(*point), DVec3::from_array(*axis));
    let along = |direction: &[f64; 3]| DVec3::from_array(*direction).dot(axis);
    let still = |name: &str, wall: &plan::Wall| {
        let plan::Wall { host, motion, rotation, servo, body, until, .. } = wall;
        let moved = host.is_some() || motion.is_some() || servo.is_some() || body.is_some() || until.is_some();
        !moved
            && !moves_later(plan, name)
            && rotation.as_ref().is_none_or(|rotation| along(&rotation.axis).abs() > 1.0 - 1e-9)
    };
    let closed = |end: DVec3, inwards: f64| {
        plan.walls.iter().filter(|(name, wall)| still(name, wall)).any(|(_, wall)| match &wall.shape {
            Shape::Plane { point, normal } => {
                inwards * along(normal) > 1.0 - 1e-9
                    && inwards * (DVec3::from_array(*point) - end).dot(axis) >= -1e-9 * length
            }
            _ => false,
        })
    };
    !(still(name, wall) && closed(point, 1.0) && closed(point + axis * length, -1.0))
}

/// Whether a stage sets a wall in motion that may stand still before.
fn moves_later(plan: &Plan, name: &str) -> bool {
    let told = |set: &toml::Table| {
        let wall = set.get("walls").and_then(|walls| walls.get(name));
        wall.is_some_and(|wall| ["motion", "rotation", "servo", "until"].iter().any(|key| wall.get(key).is_some()))
    };
    plan.stage.iter().any(|stage| told(&stage.set))
}
