//! Where two edges cross.
//!
//! The points on two straight edges that are nearest to each other run from end to end as the edges become parallel, and with them a torque. So edges are crowned, as rollers
//! of bearings are: towards its ends an edge lies back, by s^2 q at the share s of its length from its middle. Then
//!
//! ```text
//! D^2 = least of |a(s) - b(t)|^2 + q (s^2 + t^2)        -1/2 <= s, t <= 1/2,   q = 8 c r^2
//! ```
//!
//! with r the sum of both rounding radii has one least whatever the edges do, and slopes without jumps. Its slope over the places of the edges is (a - b) / D at these s and t (the
//! envelope theorem), as if nothing depended on s and t. At its ends an edge lies back by c r: there the corners bear.

use glam::DVec3;

/// How far an edge lies back at its ends, over the sum of both rounding radii.
pub(super) const CROWN: f64 = 0.02;

/// An edge.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Edge {
    /// Its number.
    pub number: usize,
    /// Its middle [m].
    pub middle: DVec3,
    /// From its one end to its other [m].
    pub way: DVec3,
    /// Squared length [m^2].
    pub squared: f64,
}

/// Where two edges are nearest to each other: the points on both, and D^2 [m^2]. `back` is q [m^2].
#[inline]
pub(super) fn nearest(a: &Edge, b: &Edge, back: f64) -> ([DVec3; 2], f64) {
    let from = a.middle - b.middle;
    let (aa, bb, ab) = (a.squared + back, b.squared + back, a.way.dot(b.way));
    let (ra, rb) = (a.way.dot(from), b.way.dot(from));
    let s_for = |t: f64| ((ab * t - ra) / aa).clamp(-0.5, 0.5);
    let mut s = ((ab * rb - bb * ra) / (aa * bb - ab * ab)).clamp(-0.5, 0.5);
    let mut t = (ab * s + rb) / bb;
    if t.abs() > 0.5 {
        t = t.clamp(-0.5, 0.5);
        s = s_for(t);
    }
    let points = [a.middle + a.way * s, b.middle + b.way * t];
    (points, (points[0] - points[1]).length_squared() + back * (s * s + t * t))
}
