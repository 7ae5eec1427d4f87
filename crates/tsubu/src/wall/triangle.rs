//! The nearest point of a triangle (Ericson, Real-Time Collision Detection, 2005, section 5.1.5).

use super::nearest::{Feature, Nearest};
use glam::DVec3;

/// A triangle, touched from both sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// Corners [m].
    pub corners: [DVec3; 3],
    /// Unit normal, right-handed about the corners.
    pub normal: DVec3,
}

impl Triangle {
    /// From its corners, which must not lie on one line.
    pub fn new(corners: [DVec3; 3]) -> Self {
        let [a, b, c] = corners;
        Self { corners, normal: (b - a).cross(c - a).normalize_or_zero() }
    }

    /// Nearest point, by the region of space (of a corner, an edge, the face) in which the centre lies.
    pub fn nearest(&self, centre: DVec3) -> Nearest {
        let [a, b, c] = self.corners;
        let (ab, ac, ap) = (b - a, c - a, centre - a);
        let corner = |k: u8| Nearest::border(centre, self.corners[usize::from(k)], self.normal, Feature::Corner(k));
        let edge = |k: u8, start: DVec3, along: DVec3, t: f64| {
            Nearest::border(centre, start + along * t, self.normal, Feature::Edge(k))
        };
        let (d1, d2) = (ab.dot(ap), ac.dot(ap));
        if d1 <= 0.0 && d2 <= 0.0 {
            return corner(0);
        }
        let bp = centre - b;
        let (d3, d4) = (ab.dot(bp), ac.dot(bp));
        if d3 >= 0.0 && d4 <= d3 {
            return corner(1);
        }
        let vc = d1 * d4 - d3 * d2;
        if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
            return edge(0, a, ab, d1 / (d1 - d3));
        }
        let cp = centre - c;
        let (d5, d6) = (ab.dot(cp), ac.dot(cp));
        if d6 >= 0.0 && d5 <= d6 {
            return corner(2);
        }
        let vb = d5 * d2 - d1 * d6;
        if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
            return edge(2, c, a - c, d6 / (d6 - d2));
        }
        let va = d3 * d6 - d5 * d4;
        if va <= 0.0 && d4 >= d3 && d5 >= d6 {
            let t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
            return edge(1, b, c - b, t);
        }
        Nearest::face(centre, self.normal, ap.dot(self.normal))
    }

    /// How far along `way` from a point the triangle is crossed, in lengths of `way` (Moller and Trumbore 1997).
    pub(super) fn crossing(&self, point: DVec3, way: DVec3) -> Option<f64> {
        let [a, b, c] = self.corners;
        let (ab, ac, from) = (b - a, c - a, point - a);
        let (p, q) = (way.cross(ac), from.cross(ab));
        let volume = ab.dot(p);
        if volume == 0.0 {
            return None;
        }
        let (u, v, t) = (from.dot(p) / volume, way.dot(q) / volume, ac.dot(q) / volume);
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
    }

    /// Whether a point lies on the triangle, give or take `tolerance` [m].
    pub fn holds(&self, point: DVec3, tolerance: f64) -> bool {
        (point - self.corners[0]).dot(self.normal).abs() <= tolerance && self.nearest(point).distance <= tolerance
    }

    /// Smallest height over area-giving sides [m]: how far from a line the triangle is.
    pub fn height(&self) -> f64 {
        let [a, b, c] = self.corners;
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        if longest > 0.0 { (b - a).cross(c - a).length() / longest } else { 0.0 }
    }
}
