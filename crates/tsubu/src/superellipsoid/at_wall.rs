//! Where a body touches walls: planes, sharp edges and corners, and surfaces of revolution from inside and outside.
//!
//! Along an edge and around an axis the directions that a normal can have lie on a circle, n(a). With c the centre of the body from a point of the edge or axis, and k the
//! distance of the surface from that along n,
//!
//! ```text
//! f(a) = h(n(a)) + n(a) . c - k
//! ```
//!
//! is how far the body reaches over the wall. Where it bulges towards the body they overlap by the least of it, inside a hollow surface by each of its greatest. Its slope n' . (c + p), with p the
//! farthest point, changes its sign there: the search halves an interval, and so always ends.

use super::touch::{Rounding, touch_point};
use super::{Form, Outline};
use glam::DVec3;

/// Rounds of a search around an axis; half of 2^-60 of an arc is rounding.
const ROUNDS: usize = 60;
/// Widest part of an arc in which one place is looked for [rad].
const PART: f64 = std::f64::consts::FRAC_PI_6;
/// Directions around an axis from which greatest ones are looked for.
const DIRECTIONS: usize = 48;

/// A contact with a wall.
#[derive(Clone, Copy, Debug)]
pub struct AtWall {
    /// Unit normal from the body to the wall.
    pub normal: DVec3,
    /// Overlap, below 0 where there is a gap [m].
    pub overlap: f64,
    /// What of the body reaches farthest along the normal, from its centre [m].
    pub point: DVec3,
    /// How round it is there [m].
    pub radius: f64,
    /// Force on the body, and torque about its centre, for each unit of the slope of the stored energy over the radius, see [`Rounding`].
    pub force: DVec3,
    /// The same [m].
    pub torque: DVec3,
}

impl AtWall {
    /// The place of the wall, from the centre of the body [m].
    pub fn foot(&self) -> DVec3 {
        self.point - self.normal * self.overlap
    }
}

/// Directions about an axis: n(a) = cos (u cos a + v sin a) + sin w.
#[derive(Clone, Copy, Debug)]
pub struct Ring {
    /// Two directions u and v across the axis.
    pub across: [DVec3; 2],
    /// The axis w.
    pub axis: DVec3,
    /// Cosine and sine of how far they lean towards it.
    pub lean: [f64; 2],
}

impl Ring {
    fn direction(&self, angle: f64) -> [DVec3; 3] {
        let ([u, v], (s, c), [cos, sin]) = (self.across, angle.sin_cos(), self.lean);
        let (out, on) = ((u * c + v * s) * cos, (v * c - u * s) * cos);
        [out + self.axis * sin, on, -out]
    }
}

impl Outline {
    /// At a plane, `distance` [m] from the centre along a normal towards it.
    pub fn at_plane(&self, normal: DVec3, distance: f64) -> AtWall {
        let (point, (radius, slope)) = (self.support(normal).point, self.roundness(normal));
        let overlap = normal.dot(point) - distance;
        AtWall { normal, overlap, point, radius, force: DVec3::ZERO, torque: normal.cross(slope) }
    }

    /// At a point from the centre [m], nearer than `reach` [m].
    pub fn at_point(&self, at: DVec3, reach: f64) -> Option<AtWall> {
        let touch = touch_point(self, at, reach)?;
        let Rounding { force, torques } = touch.rounding;
        let (point, radius) = (touch.points[0], touch.radii[0]);
        Some(AtWall { normal: touch.normal, overlap: touch.overlap, point, radius, force, torque: torques[0] })
    }

    /// Slope of f for the centre at `from`.
    fn slope(&self, ring: &Ring, from: DVec3, angle: f64) -> f64 {
        let [n, on, _] = ring.direction(angle);
        on.dot(from + self.support(n).point)
    }

    /// Where the slope goes through zero, below it at `low` and above it at `high` or, with `falls`, the other way.
    fn turning_point(&self, ring: &Ring, from: DVec3, [mut low, mut high]: [f64; 2], falls: bool) -> f64 {
        for _ in 0..ROUNDS {
            let middle = 0.5 * (low + high);
            if (self.slope(ring, from, middle) > 0.0) == falls {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }

    /// The contact at an angle where the slope of f is zero.
    fn at_angle(&self, ring: &Ring, from: DVec3, k: f64, angle: f64) -> AtWall {
        let [normal, on, bend] = ring.direction(angle);
        let (support, (radius, slope)) = (self.support(normal), self.roundness(normal));
        let point = support.point;
        // How fast the angle goes as the body moves, and with it the radius.
        let along = support.second * on;
        let second = on.dot(along) + bend.dot(from + point);
        let rate = if second.abs() > 1e-9 * self.flattest { slope.dot(on) / second } else { 0.0 };
        AtWall {
            normal,
            overlap: normal.dot(from + point) - k,
            point,
            radius,
            force: on * rate,
            torque: normal.cross(slope) + (point.cross(on) - normal.cross(along)) * rate,
        }
    }

    /// At an edge through a point from the centre [m], with normals between two angles.
    pub fn at_edge(&self, at: DVec3, ring: &Ring, arc: [f64; 2]) -> Option<AtWall> {
        // Where it meets a face rounding must not lose it between both.
        let none = 1e-12 * self.flattest;
        // Over a wide arc the slope of an elongated body turns more than once: of several places the nearest.
        let parts = ((arc[1] - arc[0]) / PART).ceil().max(1.0);
        let end = |k: f64| if k < parts { arc[0] + (arc[1] - arc[0]) * k / parts } else { arc[1] };
        let mut found: Option<AtWall> = None;
        let (mut k, mut low) = (0.0, self.slope(ring, -at, arc[0]));
        while k < parts {
            let high = self.slope(ring, -at, end(k + 1.0));
            if low <= none && high >= -none {
                let angle = self.turning_point(ring, -at, [end(k), end(k + 1.0)], false);
                let contact = self.at_angle(ring, -at, 0.0, angle);
                // In a bent hollow the edge lies a little within the body, whose centre is on the other side: it is blunt towards there.
                let before = contact.normal.dot(at) > 0.0;
                if before && found.is_none_or(|found| contact.overlap < found.overlap) {
                    found = Some(contact);
                }
            }
            (k, low) = (k + 1.0, high);
        }
        found
    }

    /// Around an axis, the centre at `from` [m]: inside of it at all places that are nearer than `reach` [m], otherwise at the nearest one.
    pub fn around(&self, from: DVec3, ring: &Ring, (k, hollow): (f64, bool), reach: f64, found: &mut Vec<AtWall>) {
        let start = found.len();
        let angle = |i: usize| std::f64::consts::TAU * i as f64 / DIRECTIONS as f64;
        let mut last = self.slope(ring, from, 0.0);
        for i in 0..DIRECTIONS {
            let next = self.slope(ring, from, angle((i + 1) % DIRECTIONS));
            let turns = if hollow { last > 0.0 && next <= 0.0 } else { last < 0.0 && next >= 0.0 };
            last = next;
            if turns {
                let at = self.turning_point(ring, from, [angle(i), angle(i + 1)], hollow);
                let contact = self.at_angle(ring, from, k, at);
                if contact.overlap > -reach || !hollow {
                    found.push(contact);
                }
            }
        }
        if !hollow {
            let least = found[start..].iter().copied().min_by(|a, b| a.overlap.total_cmp(&b.overlap));
            found.truncate(start);
            found.extend(least.filter(|least| least.overlap > -reach));
        }
    }

    /// Whether a point from the centre lies within [m].
    pub fn holds(&self, point: DVec3) -> bool {
        match &self.form {
            Form::Sphere(radius) => point.length() <= *radius,
            Form::Ellipsoid(_) => point.dot(self.squared.inverse() * point) <= 1.0,
            Form::Superellipsoid(body, axes) => {
                let own = (axes.transpose() * point / body.semi_axes).abs();
                let [p, r] = body.exponents;
                (own.x.powf(r) + own.y.powf(r)).powf(p / r) + own.z.powf(p) <= 1.0
            }
        }
    }
}
