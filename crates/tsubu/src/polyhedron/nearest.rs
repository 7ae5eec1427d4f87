//! How far a point is from a core.

use super::Turned;
use glam::DVec3;

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
        let (mut nearest, mut away) = (f64::INFINITY, DVec3::ZERO);
        for k in (0..self.faces()).filter(|k| self.above(*k, point) > 0.0) {
            self.sides(k, |a, side| {
                let arm = point - a;
                let share = (arm.dot(side) / side.length_squared()).clamp(0.0, 1.0);
                let from = arm - side * share;
                let squared = from.length_squared();
                if squared < nearest {
                    (nearest, away) = (squared, from);
                }
                true
            });
        }
        let distance = nearest.sqrt();
        if distance < cut { Ok((distance, away / distance)) } else { Err(distance - cut) }
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
