//! How far a point is from the curved walls that are given by a formula.

use crate::plan::{Shape, Vector};

/// The distance to the nearest point of the wall; `None` for boxes, planes and meshes.
pub(super) fn distance(shape: &Shape, place: Vector) -> Option<f64> {
    match shape {
        Shape::Cylinder { point, axis, radius, length } => {
            let (along, from_axis) = cylindrical(place, *point, *axis);
            Some(match length {
                None => (from_axis - radius).abs(),
                Some(length) => to_segment([along, from_axis], [0.0, *radius], [*length, *radius]),
            })
        }
        Shape::Cone { point, axis, radius, end_radius, length } => {
            let (along, from_axis) = cylindrical(place, *point, *axis);
            Some(to_segment([along, from_axis], [0.0, *radius], [*length, *end_radius]))
        }
        Shape::Sphere { centre, radius } => {
            let from_centre = (0..3).map(|i| (place[i] - centre[i]).powi(2)).sum::<f64>().sqrt();
            Some((from_centre - radius).abs())
        }
        Shape::Box { .. } | Shape::Plane { .. } | Shape::Mesh { .. } => None,
    }
}

/// Distance along the axis, and from it.
fn cylindrical(place: Vector, point: Vector, axis: Vector) -> (f64, f64) {
    let offset = [0, 1, 2].map(|i| place[i] - point[i]);
    let along: f64 = (0..3).map(|i| offset[i] * axis[i]).sum();
    let from_axis = (0..3).map(|i| (offset[i] - along * axis[i]).powi(2)).sum::<f64>().sqrt();
    (along, from_axis)
}

/// In the half plane of length and radius the wall is a straight line.
fn to_segment(place: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let edge = [b[0] - a[0], b[1] - a[1]];
    let offset = [place[0] - a[0], place[1] - a[1]];
    let share = (offset[0] * edge[0] + offset[1] * edge[1]) / (edge[0] * edge[0] + edge[1] * edge[1]);
    let share = share.clamp(0.0, 1.0);
    (offset[0] - share * edge[0]).hypot(offset[1] - share * edge[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_those_of_a_drawing() {
        let [x, z] = [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        let endless = Shape::Cylinder { point: [0.0; 3], axis: z, radius: 2.0, length: None };
        let piece = Shape::Cylinder { point: [0.0; 3], axis: x, radius: 2.0, length: Some(3.0) };
        let cone = Shape::Cone { point: [0.0; 3], axis: z, radius: 0.0, end_radius: 1.0, length: 1.0 };
        let sphere = Shape::Sphere { centre: [1.0, 1.0, 1.0], radius: 1.0 };
        let cases = [
            (&endless, [1.0, 0.0, 9.0], 1.0),
            (&endless, [0.0, 5.0, -9.0], 3.0),
            (&piece, [1.0, 0.0, 0.0], 2.0),
            (&piece, [6.0, 6.0, 0.0], 5.0),
            (&cone, [0.0, 0.0, 1.0], 0.5_f64.sqrt()),
            (&cone, [0.0, 0.0, -2.0], 2.0),
            (&sphere, [1.0, 1.0, 1.5], 0.5),
            (&sphere, [1.0, 4.0, 1.0], 2.0),
        ];
        for (shape, place, expected) in cases {
            let found = distance(shape, place).expect("a shell");
            assert!((found - expected).abs() < 1e-12, "{shape:?} {place:?}: {found}");
        }
    }
}
