//! The room that a cavity takes: the upright box that just holds the walls of a host, their thickness left out.

use tsubu_scene::plan::{Shape, Vector, Wall};
use tsubu_scene::{Plan, mesh};

/// How far a plane may be from square to an axis and still be an end of the box.
const SQUARE: f64 = 1e-9;

/// Ends along x, y and z [m].
type Ends = [[f64; 2]; 3];

/// The sides of the box along x, y and z [m]: it holds every wall of the host that has an end, and ends at its planes that are square to an
/// axis. In words why there is none.
pub(super) fn sides(plan: &Plan, host: &str) -> Result<[f64; 3], String> {
    let walls: Vec<&Wall> = plan.walls.values().filter(|wall| wall.host.as_deref() == Some(host)).collect();
    if walls.is_empty() {
        return Err(format!("no wall hangs on the host `{host}`, so that nothing takes room: add `host = \"{host}\"`"));
    }
    let ends = ends(&walls);
    let endless = (0..3).find(|axis| ends[*axis].iter().any(|end| !end.is_finite()));
    if let Some(axis) = endless {
        return Err(format!(
            "along {} nothing ends the walls of the host `{host}`, so that the room they take is not known: give them a length, or planes that close them",
            ["x", "y", "z"][axis]
        ));
    }
    Ok(ends.map(|[low, high]| (high - low).max(0.0)))
}

fn ends(walls: &[&Wall]) -> Ends {
    let mut ends = [[f64::INFINITY, f64::NEG_INFINITY]; 3];
    for own in walls.iter().filter_map(|wall| of_shape(&wall.shape)) {
        for (all, own) in ends.iter_mut().zip(own) {
            *all = [all[0].min(own[0]), all[1].max(own[1])];
        }
    }
    // Planes alone: endless until they end it.
    for axis in ends.iter_mut().filter(|axis| axis[0] > axis[1]) {
        *axis = [f64::NEG_INFINITY, f64::INFINITY];
    }
    for wall in walls {
        let Shape::Plane { point, normal } = &wall.shape else { continue };
        for (axis, all) in ends.iter_mut().enumerate() {
            if normal[axis] > 1.0 - SQUARE {
                all[0] = all[0].max(point[axis]);
            } else if normal[axis] < SQUARE - 1.0 {
                all[1] = all[1].min(point[axis]);
            }
        }
    }
    ends
}

/// Ends of a wall; nothing for a plane.
fn of_shape(shape: &Shape) -> Option<Ends> {
    match shape {
        Shape::Box { width, height, depth, floor_centre: [x, y, z] } => {
            Some([[x - width / 2.0, x + width / 2.0], [y - depth / 2.0, y + depth / 2.0], [*z, z + height]])
        }
        Shape::Plane { .. } => None,
        Shape::Cylinder { point, axis, radius, length } => {
            Some(round(*point, *axis, [*radius; 2], length.unwrap_or(f64::INFINITY), length.is_none()))
        }
        Shape::Cone { point, axis, radius, end_radius, length } => {
            Some(round(*point, *axis, [*radius, *end_radius], *length, false))
        }
        Shape::Sphere { centre, radius } => Some(centre.map(|x| [x - radius, x + radius])),
        Shape::Mesh { triangles, .. } => {
            let [low, high] = mesh::ends(triangles);
            Some([0, 1, 2].map(|axis| [low[axis], high[axis]]))
        }
    }
}

/// Ends of two circles about an axis: a circle of radius r reaches r sqrt(1 - a^2) along an axis with which its own has the cosine a.
fn round(point: Vector, axis: Vector, radii: [f64; 2], length: f64, both_ways: bool) -> Ends {
    std::array::from_fn(|i| {
        let across = (1.0 - axis[i] * axis[i]).max(0.0).sqrt();
        if axis[i].abs() < SQUARE {
            let reach = radii[0].max(radii[1]) * across;
            return [point[i] - reach, point[i] + reach];
        }
        let other = point[i] + axis[i] * length;
        let mut ends = [f64::INFINITY, f64::NEG_INFINITY];
        for (centre, radius) in [(point[i], radii[0]), (other, radii[1])] {
            ends = [ends[0].min(centre - radius * across), ends[1].max(centre + radius * across)];
        }
        if both_ways { [f64::NEG_INFINITY, f64::INFINITY] } else { ends }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A disc of radius 1 about an axis at 45 degrees reaches 1/sqrt 2 beyond the ends of an axis of length 2: sides of sqrt 2 + sqrt 2, 2 and
    /// 2 sqrt 2. An endless one has none along its axis, but between two planes. Control: the sphere of that radius is smaller.
    #[test]
    fn round_walls_have_the_ends_of_their_circles() {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let shape = |length| Shape::Cylinder { point: [0.0; 3], axis: [half, 0.0, half], radius: 1.0, length };
        let sides = |shape: &Shape| of_shape(shape).expect("no plane").map(|[low, high]| high - low);
        let expected = [4.0 * half, 2.0, 4.0 * half];
        assert!(sides(&shape(Some(2.0))).iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12));
        assert_eq!(sides(&shape(None)), [f64::INFINITY, 2.0, f64::INFINITY]);
        let ball = sides(&Shape::Sphere { centre: [3.0, 0.0, 1.0], radius: 1.0 });
        assert!(ball == [2.0; 3] && ball[0] < expected[0]);
        let cone = Shape::Cone { point: [0.0; 3], axis: [0.0, 0.0, 1.0], radius: 0.5, end_radius: 2.0, length: 3.0 };
        assert_eq!(sides(&cone), [4.0, 4.0, 3.0]);
    }
}
