//! The six directions of a triangular lattice with gravity along one of its axes.
//!
//! Vectors are written in the oblique-free basis (h, k): x = h sqrt(3)/2, z = k/2, in units of the cell spacing. Every
//! direction then has whole components (N = (0, 2), NE = (1, 1), ...), the scalar product is (3 h h' + k k') / 4, and no
//! rule ever needs the square root: all comparisons are exact in integers, hence the same on every machine.

/// A lattice direction; `N` points against gravity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Direction {
    /// Straight up.
    N = 0,
    /// 30 degrees above horizontal, to the right.
    NE = 1,
    /// 30 degrees below horizontal, to the right.
    SE = 2,
    /// Straight down.
    S = 3,
    /// 30 degrees below horizontal, to the left.
    SW = 4,
    /// 30 degrees above horizontal, to the left.
    NW = 5,
}

/// A vector in the basis (h, k), in speed units or in cells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Vector {
    /// x = h sqrt(3)/2.
    pub h: i64,
    /// z = k/2.
    pub k: i64,
}

impl Vector {
    /// Four times the square of its length: 3 h^2 + k^2.
    #[inline]
    pub fn square4(self) -> i64 {
        3 * self.h * self.h + self.k * self.k
    }

    /// The sum of two vectors.
    #[inline]
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self { h: self.h + other.h, k: self.k + other.k }
    }
}

impl Direction {
    /// All directions, clockwise from N.
    pub const ALL: [Self; 6] = [Self::N, Self::NE, Self::SE, Self::S, Self::SW, Self::NW];

    /// The direction with that index, counted round the clock (so 6 is N again).
    #[inline]
    pub fn from_index(index: usize) -> Self {
        Self::ALL[index % 6]
    }

    /// Horizontal component h: 0, 1 or -1.
    #[inline]
    pub fn h(self) -> i64 {
        const H: [i64; 6] = [0, 1, 1, 0, -1, -1];
        H[self as usize]
    }

    /// Vertical component k: 2 for N, 1 for NE and NW, and their negatives.
    #[inline]
    pub fn k(self) -> i64 {
        const K: [i64; 6] = [2, 1, -1, -2, -1, 1];
        K[self as usize]
    }

    /// This direction times a length.
    #[inline]
    pub fn times(self, length: i64) -> Vector {
        Vector { h: self.h() * length, k: self.k() * length }
    }

    /// Whether it is N or S.
    #[inline]
    pub fn is_vertical(self) -> bool {
        matches!(self, Self::N | Self::S)
    }

    /// Straight back.
    #[inline]
    #[must_use]
    pub fn opposite(self) -> Self {
        Self::from_index(self as usize + 3)
    }

    /// The next direction clockwise.
    #[inline]
    #[must_use]
    pub fn clockwise(self) -> Self {
        Self::from_index(self as usize + 1)
    }

    /// The next direction counter-clockwise.
    #[inline]
    #[must_use]
    pub fn counter_clockwise(self) -> Self {
        Self::from_index(self as usize + 5)
    }

    /// Twice the cosine of the angle between two directions: 2, 1, -1 or -2.
    #[inline]
    pub fn twice_cosine(self, other: Self) -> i64 {
        const TURN: [i64; 6] = [2, 1, -1, -2, -1, 1];
        TURN[(self as usize + 6 - other as usize) % 6]
    }

    /// Four times the component of a vector along this direction: 3 h h' + k k'.
    #[inline]
    pub fn along4(self, vector: Vector) -> i64 {
        3 * self.h() * vector.h + self.k() * vector.k
    }

    /// The direction nearest to a vector; ties (and the null vector) go to the first clockwise from S, so that a ball at
    /// rest looks down.
    pub fn nearest(vector: Vector) -> Self {
        let mut best = Self::S;
        for index in 4..9 {
            let other = Self::from_index(index);
            if other.along4(vector) > best.along4(vector) {
                best = other;
            }
        }
        best
    }

    /// Unit vector in space (x to the right, z up).
    pub fn unit(self) -> [f64; 3] {
        [self.h() as f64 * 0.75_f64.sqrt(), 0.0, 0.5 * self.k() as f64]
    }
}

#[cfg(test)]
mod tests {
    use super::{Direction, Vector};

    /// The whole-number products are those of the real vectors, and neighbours are 60 degrees apart.
    #[test]
    fn products_agree_with_geometry() {
        for a in Direction::ALL {
            for b in Direction::ALL {
                let (u, v) = (a.unit(), b.unit());
                let cosine = u[0] * v[0] + u[2] * v[2];
                assert!((2.0 * cosine - a.twice_cosine(b) as f64).abs() < 1e-12, "{a:?} {b:?}");
                assert_eq!(a.along4(b.times(1)), 2 * a.twice_cosine(b));
            }
            assert_eq!(a.twice_cosine(a.opposite()), -2);
            assert_eq!(a.clockwise().counter_clockwise(), a);
            assert_eq!(a.twice_cosine(a.clockwise()), 1);
        }
    }

    #[test]
    fn nearest_is_within_thirty_degrees() {
        for degree in 0..360 {
            let angle = f64::from(degree).to_radians();
            let vector = Vector { h: (1e6 * angle.cos() / 0.75_f64.sqrt()) as i64, k: (2e6 * angle.sin()) as i64 };
            let unit = Direction::nearest(vector).unit();
            let cosine = unit[0] * angle.cos() + unit[2] * angle.sin();
            assert!(cosine > 30.0_f64.to_radians().cos() - 1e-5, "{degree}: {cosine}");
        }
        assert_eq!(Direction::nearest(Vector::default()), Direction::S);
    }
}
