//! Cylinders and cones: the curved surface of a frustum, open at the ends, touched from inside and outside.
//!
//! With s along the axis and x across it, in the plane through the axis and the grain's centre (s_c, x_c >= 0), the
//! surface is two straight lines: the *near* one at x = r(s), where the nearest point of the whole surface lies, and
//! the *far* one at x = -r(s). A grain that plugs a funnel or sits on the mouth of a pipe is held by both. Each is an
//! element: 0 near, 1 far. With both, the force across the axis passes through zero smoothly where near and far change
//! places.

use super::Pose;
use super::nearest::{Feature, Nearest};
use crate::about::About;
use glam::{DVec2, DVec3};

pub(crate) const CYLINDER: About = About {
    key: "walls.NAME.shape.cylinder",
    formula: "d = r - |radius - x_c|, x_c the distance of the grain from the axis",
    symbols: "x centre of the grain [m], r its radius [m], d overlap [m], radius, length and x_c [m]",
    limits: "The curved surface alone, open at the ends, touched from both sides; no length: no end. In the plane along \
y: a circle. A grain that plugs it is held by the near and the far line of the surface.",
    reference: "by definition",
};

pub(crate) const CONE: About = About {
    key: "walls.NAME.shape.cone",
    formula: "d = r - distance to the surface x = radius + (end-radius - radius) s/length, 0 <= s <= length",
    symbols: "x centre of the grain [m], r its radius [m], d overlap [m], s along the axis [m], x from the axis [m], \
radius, end-radius, length [m]",
    limits: "The curved surface alone, open at the ends, touched from both sides. A grain that plugs a funnel is held by the near and the far line of the surface.",
    reference: "by definition",
};

/// Element that holds the nearest point of the surface.
const NEAR: u32 = 0;

/// A piece of a cone, or a cylinder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frustum {
    /// Centre of one end [m].
    pub point: DVec3,
    /// Unit direction of the axis, towards the other end.
    pub axis: DVec3,
    /// Radii at the two ends [m].
    pub radius: [f64; 2],
    /// Length along the axis [m]; `None`: an endless cylinder.
    pub length: Option<f64>,
}

impl Frustum {
    /// Near and far line.
    pub const ELEMENTS: usize = 2;

    /// Nearest point of the near (0) or far (1) line; nothing if the near line hides the far one from the grain.
    pub(super) fn nearest(&self, element: u32, centre: DVec3) -> Nearest {
        let from_end = centre - self.point;
        let s = from_end.dot(self.axis);
        let across = from_end - self.axis * s;
        let x = across.length();
        // On the axis rounding would choose a direction; take one that lies in the plane of 2-D scenes.
        let on_axis = x <= 1e-14 * (s.abs() + self.radius[0] + self.radius[1]);
        let (x, radial) = if on_axis { (0.0, self.across_axis()) } else { (x, across / x) };
        let place = DVec2::new(s, x);
        let side = if element == NEAR { 1.0 } else { -1.0 };
        let (at, signed, feature) = self.in_meridian(DVec2::new(s, side * x));
        if element != NEAR && self.hides(place, DVec2::new(at.foot.x, -at.foot.y)) {
            return Nearest::nothing(centre);
        }
        let radial = radial * side;
        let to_space = |v: DVec2| self.axis * v.x + radial * v.y;
        match feature {
            Feature::Face => Nearest::face(centre, to_space(at.normal), signed),
            _ => Nearest::border(centre, self.point + to_space(at.foot), to_space(at.normal), feature),
        }
    }

    /// Nearest point of the line x = r(s) to a point of the meridian plane, with the signed distance outwards.
    fn in_meridian(&self, p: DVec2) -> (Foot, f64, Feature) {
        let [r0, r1] = self.radius;
        let Some(length) = self.length else {
            return (Foot { foot: DVec2::new(p.x, r0), normal: DVec2::Y }, p.y - r0, Feature::Face);
        };
        let along = DVec2::new(length, r1 - r0);
        let size = along.length();
        let from_start = p - DVec2::new(0.0, r0);
        let t = from_start.dot(along) / (size * size);
        let normal = DVec2::new(-along.y, along.x) / size;
        let end = |k: usize| if self.radius[k] > 0.0 { Feature::Edge(k as u8) } else { Feature::Corner(k as u8) };
        let (foot, feature) = if t <= 0.0 {
            (DVec2::new(0.0, r0), end(0))
        } else if t >= 1.0 {
            (DVec2::new(length, r1), end(1))
        } else {
            (DVec2::new(0.0, r0) + along * t, Feature::Face)
        };
        (Foot { foot, normal }, from_start.dot(normal), feature)
    }

    /// Whether the near line lies between the grain's centre and a foot on the far line, or the foot is a tip, which
    /// belongs to both lines.
    fn hides(&self, centre: DVec2, foot: DVec2) -> bool {
        let [r0, r1] = self.radius;
        let Some(length) = self.length else { return centre.y > r0 };
        if foot.y >= 0.0 {
            return true;
        }
        let (start, end) = (DVec2::new(0.0, r0), DVec2::new(length, r1));
        let side = |a: DVec2, b: DVec2, p: DVec2| (b - a).perp_dot(p - a);
        side(start, end, centre) * side(start, end, foot) < 0.0
            && side(centre, foot, start) * side(centre, foot, end) < 0.0
    }

    /// Whether a point lies within; `None` before and behind the open ends.
    pub(super) fn encloses(&self, point: DVec3) -> Option<bool> {
        let from_end = point - self.point;
        let s = from_end.dot(self.axis);
        let [r0, r1] = self.radius;
        let radius = match self.length {
            None => r0,
            Some(length) if (0.0..=length).contains(&s) => r0 + (r1 - r0) * s / length,
            Some(_) => return None,
        };
        Some((from_end - self.axis * s).length() < radius)
    }

    /// Cosine and sine of the angle by which it widens along the axis, and how far its surface is from `point` [m]: what is x from the axis and s along it is cos x - sin s - that
    /// above it.
    pub fn slope(&self) -> ([f64; 2], f64) {
        let [r0, r1] = self.radius;
        let Some(length) = self.length else { return ([1.0, 0.0], r0) };
        let slant = length.hypot(r1 - r0);
        ([length / slant, (r1 - r0) / slant], r0 * length / slant)
    }

    /// A direction across the axis.
    pub fn across_axis(&self) -> DVec3 {
        let across = self.axis.cross(DVec3::Y);
        if across.length_squared() > 1e-12 { across.normalize() } else { DVec3::X }
    }

    /// How far any point of the surface may have moved [m]. Turning about its own axis moves nothing; a swing of the
    /// axis a to a' moves the circle at an end e by |e' - e| + r |a' - a| at most, and the surface is straight between
    /// its ends.
    pub(super) fn travel(&self, pose: &Pose, reference: &Pose, extent: f64) -> f64 {
        let axis = pose.direction(self.axis);
        let swing = (axis - reference.direction(self.axis)).length();
        let moved = |p: DVec3| pose.to_world(p) - reference.to_world(p);
        let Some(length) = self.length else {
            // Taken abreast of the centre of rotation, from which the extent counts.
            let foot = self.point + self.axis * (pose.centre - self.point).dot(self.axis);
            let moved = moved(foot);
            let across = (moved - axis * moved.dot(axis)).length();
            return if swing > 0.0 { across + swing * (extent + self.radius[0]) } else { across };
        };
        let ends = [self.point, self.point + self.axis * length];
        (0..2).map(|k| moved(ends[k]).length() + self.radius[k] * swing).fold(0.0, f64::max)
    }
}

/// A point on a line of the meridian plane and the line's normal there, outwards.
struct Foot {
    foot: DVec2,
    normal: DVec2,
}
