//! Symmetric matrices and vectors, alone and as rows of columns.

use glam::{DMat3, DVec3};

/// Rows of a column: what is worked on together stays in the first cache.
pub const ROWS: usize = 32;

/// A number of every row.
pub(crate) type Column = [f64; ROWS];
pub(crate) const ZERO: Column = [0.0; ROWS];
pub(crate) type Columns<const N: usize> = [Column; N];

/// A symmetric matrix.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Symmetric {
    /// xx, yy, zz.
    pub on: DVec3,
    /// yz, zx, xy.
    pub off: DVec3,
}

impl Symmetric {
    /// Times a vector.
    #[inline(always)]
    pub fn times(&self, v: DVec3) -> DVec3 {
        let (on, off) = (self.on, self.off);
        DVec3::new(
            on.x * v.x + off.z * v.y + off.y * v.z,
            off.z * v.x + on.y * v.y + off.x * v.z,
            off.y * v.x + off.x * v.y + on.z * v.z,
        )
    }

    /// Its inverse times its determinant.
    #[inline(always)]
    pub(super) fn adjugate(&self) -> Self {
        let (on, off) = (self.on, self.off);
        Self {
            on: DVec3::new(on.y * on.z - off.x * off.x, on.z * on.x - off.y * off.y, on.x * on.y - off.z * off.z),
            off: DVec3::new(off.y * off.z - on.x * off.x, off.z * off.x - on.y * off.y, off.x * off.y - on.z * off.z),
        }
    }

    /// (A - p p) / h: how an ellipsoid bends where it reaches h, at p.
    #[inline(always)]
    pub(super) fn bend(&self, point: DVec3, inverse_reach: f64) -> Self {
        let off = DVec3::new(point.y * point.z, point.z * point.x, point.x * point.y);
        Self { on: (self.on - point * point) * inverse_reach, off: (self.off - off) * inverse_reach }
    }

    #[inline(always)]
    pub(super) fn plus(&self, other: &Self) -> Self {
        Self { on: self.on + other.on, off: self.off + other.off }
    }

    #[inline(always)]
    pub(super) fn at(columns: &Columns<6>, i: usize) -> Self {
        let [xx, yy, zz, yz, zx, xy] = columns;
        Self { on: DVec3::new(xx[i], yy[i], zz[i]), off: DVec3::new(yz[i], zx[i], xy[i]) }
    }

    /// With these values along three directions at right angles.
    #[inline]
    pub fn along(values: DVec3, axes: &DMat3) -> Self {
        let mut sum = Self::default();
        for k in 0..3 {
            let axis = axes.col(k);
            let scaled = axis * values[k];
            sum.on += scaled * axis;
            sum.off += DVec3::new(scaled.y * axis.z, scaled.z * axis.x, scaled.x * axis.y);
        }
        sum
    }

    /// The same in nine numbers.
    pub fn full(&self) -> DMat3 {
        let (on, off) = (self.on, self.off);
        DMat3::from_cols_array(&[on.x, off.z, off.y, off.z, on.y, off.x, off.y, off.x, on.z])
    }

    #[inline(always)]
    pub(super) fn set(&self, columns: &mut Columns<6>, i: usize) {
        let [xx, yy, zz, yz, zx, xy] = columns;
        (xx[i], yy[i], zz[i]) = (self.on.x, self.on.y, self.on.z);
        (yz[i], zx[i], xy[i]) = (self.off.x, self.off.y, self.off.z);
    }
}

#[inline(always)]
pub(crate) fn vector(columns: &Columns<3>, i: usize) -> DVec3 {
    let [x, y, z] = columns;
    DVec3::new(x[i], y[i], z[i])
}

#[inline(always)]
pub(crate) fn set(columns: &mut Columns<3>, i: usize, v: DVec3) {
    let [x, y, z] = columns;
    (x[i], y[i], z[i]) = (v.x, v.y, v.z);
}
