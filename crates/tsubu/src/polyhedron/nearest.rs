//! How far a point is from a core.

use super::{SURE, Turned};
use glam::DVec3;

/// What is far enough is so but for this share, for rounding.
const SHARE: f64 = 0.999;

/// The nearest of some edges.
struct Nearest {
    /// Squared distance [m^2].
    squared: f64,
    /// The way from there [m].
    away: DVec3,
}

impl Nearest {
    const NONE: Self = Self { squared: f64::INFINITY, away: DVec3::ZERO };

    /// Looks at another, by the way from its one end to the point, and to its other end [m].
    #[inline]
    fn look(&mut self, arm: DVec3, side: DVec3) {
        let share = (arm.dot(side) / side.length_squared()).clamp(0.0, 1.0);
        let away = arm - side * share;
        let squared = away.length_squared();
        if squared < self.squared {
            *self = Self { squared, away };
        }
    }

    /// As [`Turned::distance`] tells it.
    fn within(&self, cut: f64) -> Result<(f64, DVec3), f64> {
        let distance = self.squared.sqrt();
        if distance < cut { Ok((distance, self.away / distance)) } else { Err(distance - cut) }
    }
}

impl Turned<'_> {
    /// Distance of a point from the core [m], and the unit direction from it; within the core the distance from the nearest face, below 0. An error where it is `cut` [m] or farther, with how far beyond at least.
    ///
    /// The slope of the distance is that direction, which turns without a jump as the nearest feature changes; the core is convex.
    pub(super) fn distance(&self, point: DVec3, cut: f64) -> Result<(f64, DVec3), f64> {
        self.distance_at(self.highest(point), point, cut)
    }

    /// The same, faster where the nearest face is the one that it was; and tells which it is.
    #[inline]
    pub(super) fn distance_from(&self, face: &mut u32, point: DVec3, cut: f64) -> Result<(f64, DVec3), f64> {
        let last = *face as usize;
        if !self.is_amid(last, point) || self.above(last, point) <= 0.0 {
            *face = self.highest(point) as u32;
        }
        self.distance_at(*face as usize, point, cut)
    }

    /// The same of a point that is straight above, or below, a face, and no other is nearer.
    #[inline]
    pub(super) fn distance_over(&self, face: usize, point: DVec3, cut: f64) -> Result<(f64, DVec3), f64> {
        let height = self.above(face, point);
        if height < cut { Ok((height, self.normal(face))) } else { Err(height - cut) }
    }

    /// The same of a point that an edge is nearest to, and surely so: that edge as each of its faces goes round it.
    pub(super) fn distance_beside(&self, edge: usize, point: DVec3, cut: f64) -> Result<(f64, DVec3), f64> {
        let mut nearest = Nearest::NONE;
        for (face, ends) in self.shape.sides[edge].into_iter().zip(self.shape.ways[edge]) {
            if self.above(face, point) > 0.0 {
                let [a, b] = ends.map(|corner| self.corner(corner));
                nearest.look(point - a, b - a);
            }
        }
        nearest.within(cut)
    }

    /// How far bodies may go, at least, until a point that is highest above a face may be no more, or not straight above it [m]; below 0 where it is not.
    pub(super) fn slack(&self, face: usize, point: DVec3) -> f64 {
        // A side of a polygon has no sides.
        if self.shape.faces[face].len() < 3 {
            return f64::NEG_INFINITY;
        }
        let (normal, height) = (self.normal(face), self.above(face, point));
        let mut slack = f64::INFINITY;
        self.sides(face, |a, side| {
            slack = slack.min(normal.dot(side.cross(point - a)) / side.length());
            slack > 0.0
        });
        for other in (0..self.faces()).filter(|other| *other != face) {
            slack = slack.min(0.5 * (height - self.above(other, point)));
        }
        self.surely(slack, point)
    }

    /// The edge that is nearest to a point outside the core, and how far bodies may go, at least, until another may be, or the middle of a face [m]; below 0 where a corner is nearest.
    pub(super) fn beside(&self, point: DVec3) -> (usize, f64) {
        let (mut edge, mut least, mut next) = (0, f64::INFINITY, f64::INFINITY);
        for number in 0..self.shape.edges.len() {
            let [a, b] = self.ends_of_edge(number);
            let mut nearest = Nearest::NONE;
            nearest.look(point - a, b - a);
            let distance = nearest.squared.sqrt();
            if distance < least {
                (edge, least, next) = (number, distance, least);
            } else {
                next = next.min(distance);
            }
        }
        let Some(faces) = self.shape.sides.get(edge) else { return (edge, f64::NEG_INFINITY) };
        let mut slack = least.min(0.5 * (next - least));
        for (face, ends) in faces.iter().zip(self.shape.ways[edge]) {
            let [a, b] = ends.map(|corner| self.corner(corner));
            let side = b - a;
            slack = slack.min(-self.normal(*face).dot(side.cross(point - a)) / side.length());
        }
        (edge, self.surely(slack, point))
    }

    /// How far bodies may go so that a point surely goes no farther than some way [m].
    fn surely(&self, way: f64, point: DVec3) -> f64 {
        let way = way - SURE * self.size;
        // What a path bounds is as far from the centre as the body reaches.
        SHARE * way / (2.0 * (point.length() + way.abs()) / self.size).max(1.0)
    }

    /// The face that a point is highest above.
    fn highest(&self, point: DVec3) -> usize {
        let (mut face, mut height) = (0, f64::NEG_INFINITY);
        for k in 0..self.faces() {
            let above = self.above(k, point);
            if above > height {
                (face, height) = (k, above);
            }
        }
        face
    }

    /// The distance of a point that is highest above a face.
    #[inline]
    fn distance_at(&self, face: usize, point: DVec3, cut: f64) -> Result<(f64, DVec3), f64> {
        let height = self.above(face, point);
        if height >= cut {
            return Err(height - cut);
        }
        if height <= 0.0 || self.is_over(face, point) {
            return Ok((height, self.normal(face)));
        }
        self.distance_from_sides(point, cut)
    }

    /// The distance of a point that is straight above no face.
    fn distance_from_sides(&self, point: DVec3, cut: f64) -> Result<(f64, DVec3), f64> {
        let mut nearest = Nearest::NONE;
        for k in (0..self.faces()).filter(|k| self.above(*k, point) > 0.0) {
            self.sides(k, |a, side| {
                nearest.look(point - a, side);
                true
            });
        }
        nearest.within(cut)
    }

    /// Whether a point lies straight above a face; a side of a polygon has no answer to that.
    #[inline]
    pub(super) fn is_over(&self, face: usize, point: DVec3) -> bool {
        self.is_amid(face, point) || self.shape.faces[face].len() > 2 && self.is_within(face, point)
    }

    /// Whether a point is on the inner side of all sides of a face.
    fn is_within(&self, face: usize, point: DVec3) -> bool {
        let normal = self.normal(face);
        self.sides(face, |a, side| normal.dot(side.cross(point - a)) >= 0.0)
    }

    /// Walks round a face as long as `goes_on` with the start and the way of each side [m].
    fn sides(&self, face: usize, mut goes_on: impl FnMut(DVec3, DVec3) -> bool) -> bool {
        let round = &self.shape.round[self.shape.faces[face].clone()];
        let Some(last) = round.last() else { return true };
        let mut a = self.corner(*last as usize);
        for corner in round {
            let b = self.corner(*corner as usize);
            if !goes_on(a, b - a) {
                return false;
            }
            a = b;
        }
        true
    }
}
