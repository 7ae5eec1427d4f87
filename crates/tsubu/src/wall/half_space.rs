//! Half-spaces: what planes and boxes are made of.

use super::Pose;
use super::nearest::{Feature, Nearest};
use crate::about::About;
use glam::DVec3;
use tsubu_scene::plan::Shape;

pub(crate) const PLANE: About = About {
    key: "walls.NAME.shape.plane",
    formula: "d = r - (x - point) . normal, contact normal: the plane's",
    symbols: "x centre of the grain [m], r its radius [m], d overlap [m], point [m], normal unit vector towards the grains \
[-]",
    limits: "Endless. Grains behind it are overlapping: no free grain may begin there. A wall is a body of infinite radius; its \
mass is infinite, on a host the one that the host shows.",
    reference: "by definition",
};

pub(crate) const BOX: About = About {
    key: "walls.NAME.shape.box",
    formula: "six planes (in the plane four) with their normals inwards; d = r - distance to each of them",
    symbols: "x centre of the grain [m], r its radius [m], d overlap [m], distances [m]",
    limits: "Closed: grains are inside. In the plane the panes in front and behind are frictionless and ignored. A grain \
in a corner has a contact with every face.",
    reference: "by definition",
};

/// An endless plane with grains on the side of its normal; behind it, distances are negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    /// A point on the plane [m].
    pub point: DVec3,
    /// Unit normal, towards the grains.
    pub normal: DVec3,
}

impl HalfSpace {
    /// Signed distance along the normal, and the foot of the perpendicular.
    #[inline]
    pub(super) fn nearest(&self, centre: DVec3) -> Nearest {
        let distance = (centre - self.point).dot(self.normal);
        Nearest { distance, normal: self.normal, point: centre - self.normal * distance, feature: Feature::Face }
    }

    /// How much the distance of any point within `extent` of the centre of rotation may have changed [m]:
    /// d = n . (x - origin) - h changes by (n' - n) . (x - origin) - n' . (origin' - origin).
    pub(super) fn travel(&self, pose: &Pose, reference: &Pose, extent: f64) -> f64 {
        let normal = pose.direction(self.normal);
        let tilt = (normal - reference.direction(self.normal)).length();
        let along = normal.dot(pose.origin() - reference.origin()).abs();
        // An endless plane that does not tilt has no lever, however far the grains are.
        if tilt > 0.0 { along + tilt * extent } else { along }
    }
}

/// The planes of a box or plane. In the plane a box has no front and back.
pub(super) fn planes(shape: &Shape, dimension: u8) -> Vec<HalfSpace> {
    let plane = |point: DVec3, normal: DVec3| HalfSpace { point, normal };
    match shape {
        Shape::Plane { point, normal } => vec![plane(DVec3::from_array(*point), DVec3::from_array(*normal))],
        Shape::Box { width, height, depth, floor_centre } => {
            let c = DVec3::from_array(*floor_centre);
            let half = DVec3::new(0.5 * width, 0.5 * depth, 0.0);
            let mut planes = vec![
                plane(c - DVec3::X * half.x, DVec3::X),
                plane(c + DVec3::X * half.x, DVec3::NEG_X),
                plane(c, DVec3::Z),
                plane(c + DVec3::Z * *height, DVec3::NEG_Z),
            ];
            if dimension == 3 {
                planes.push(plane(c - DVec3::Y * half.y, DVec3::Y));
                planes.push(plane(c + DVec3::Y * half.y, DVec3::NEG_Y));
            }
            planes
        }
        Shape::Cylinder { .. } | Shape::Cone { .. } | Shape::Sphere { .. } | Shape::Mesh { .. } => Vec::new(),
    }
}
