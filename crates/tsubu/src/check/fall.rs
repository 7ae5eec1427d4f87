//! How far grains may fall.

use glam::DVec3;
use tsubu_scene::plan::{GrainMotion, Plan, Shape, Start};

/// Height [m] from the highest place where free grains begin down to the lowest wall below it; 0 where nothing tells.
pub(super) fn height(plan: &Plan) -> f64 {
    let up = -DVec3::from_array(plan.gravity).normalize_or_zero();
    if up == DVec3::ZERO {
        return 0.0;
    }
    let places: Vec<DVec3> = begin(plan);
    let highest = places.iter().map(|place| place.dot(up)).fold(f64::NEG_INFINITY, f64::max);
    let mut deepest = 0.0f64;
    for wall in plan.walls.values() {
        let vector = DVec3::from_array;
        // How high the lowest point of a circle about an axis is.
        let circle = |centre: DVec3, axis: DVec3, radius: f64| {
            centre.dot(up) - radius * (1.0 - axis.dot(up).powi(2)).max(0.0).sqrt()
        };
        let lowest = match &wall.shape {
            // Straight down onto it, which is far where it is steep.
            Shape::Plane { point, normal } if vector(*normal).dot(up) > 0.5 => {
                let normal = vector(*normal);
                let over = places.iter().map(|place| (*place - vector(*point)).dot(normal) / normal.dot(up));
                deepest = deepest.max(over.fold(0.0, f64::max));
                continue;
            }
            Shape::Plane { .. } | Shape::Box { .. } | Shape::Cylinder { length: None, .. } => continue,
            Shape::Cylinder { point, axis, radius, length: Some(length) } => {
                let (point, axis) = (vector(*point), vector(*axis));
                circle(point, axis, *radius).min(circle(point + axis * *length, axis, *radius))
            }
            Shape::Cone { point, axis, radius, end_radius, length } => {
                let (point, axis) = (vector(*point), vector(*axis));
                circle(point, axis, *radius).min(circle(point + axis * *length, axis, *end_radius))
            }
            Shape::Sphere { centre, radius } => vector(*centre).dot(up) - radius,
            Shape::Mesh { triangles, .. } => {
                triangles.iter().flatten().map(|corner| vector(*corner).dot(up)).fold(f64::INFINITY, f64::min)
            }
        };
        deepest = deepest.max(highest - lowest);
    }
    if deepest.is_finite() { deepest } else { 0.0 }
}

/// Places and corners of regions where free grains begin.
fn begin(plan: &Plan) -> Vec<DVec3> {
    let free = plan.particles.values().filter(|group| matches!(group.motion, GrainMotion::Free {}) && group.count > 0);
    let mut places = Vec::new();
    for group in free {
        match &group.start {
            Start::At { position, .. } => places.extend(position.iter().map(|p| DVec3::from_array(*p))),
            Start::File { grains, .. } => places.extend(grains.position.iter().map(|p| DVec3::from_array(*p))),
            Start::Rows { region: Some(region), .. }
            | Start::Random { region: Some(region), .. }
            | Start::Stream { region, .. } => {
                let ends = [region.low, region.high];
                places.extend((0..8).map(|k| DVec3::new(ends[k & 1][0], ends[k >> 1 & 1][1], ends[k >> 2][2])));
            }
            Start::Rows { .. } | Start::Random { .. } | Start::Settled { .. } => {}
        }
    }
    places
}
