//! What of a polyhedron lies below a plane.

use super::Turned;
use glam::DVec3;

impl Turned<'_> {
    /// How far it reaches along a unit direction, from its centre to its low and its high end [m].
    pub fn ends(&self, n: DVec3) -> [f64; 2] {
        [self.lowest(n) - self.rounding, self.rounding - self.lowest(-n)]
    }

    /// Share of its volume, of a polygon of its area, below a plane across a unit direction, `height` [m] above its centre: that of its core, exactly, stretched along
    /// the direction to the ends of the body.
    pub fn below(&self, n: DVec3, height: f64) -> f64 {
        let [low, high] = self.ends(n);
        if height <= low {
            return 0.0;
        }
        if height >= high {
            return 1.0;
        }
        let [bottom, top] = [low + self.rounding, high - self.rounding];
        self.core_below(n, bottom + (height - low) * ((top - bottom) / (high - low))) / self.core_below(n, top)
    }

    /// Volume of the core below a plane, times 3; area, times 2. Seen from a point of the plane every face is the base of a pyramid, and the cut has no height.
    fn core_below(&self, n: DVec3, height: f64) -> f64 {
        let point = n * height;
        (0..self.faces()).map(|face| -self.above(face, point) * self.face_below(face, n, height)).sum()
    }

    /// Area of a face of the core below a plane, or length of a side.
    fn face_below(&self, face: usize, n: DVec3, height: f64) -> f64 {
        let corners = &self.shape.round[self.shape.faces[face].clone()];
        let corner = |k: usize| self.corner(corners[k % corners.len()] as usize);
        let mut below = Vec::with_capacity(2 * corners.len());
        for k in 0..corners.len() {
            let (a, b) = (corner(k), corner(k + 1));
            let (from, to) = (n.dot(a) - height, n.dot(b) - height);
            if from <= 0.0 {
                below.push(a);
            }
            if from * to < 0.0 {
                below.push(a + (b - a) * (from / (from - to)));
            }
        }
        let Some(first) = below.first() else { return 0.0 };
        if corners.len() == 2 {
            // There and back.
            return below.iter().map(|p| p.distance(*first)).fold(0.0, f64::max);
        }
        let twice: DVec3 = below.windows(2).map(|pair| (pair[0] - first).cross(pair[1] - first)).sum();
        0.5 * twice.dot(self.normal(face))
    }
}
