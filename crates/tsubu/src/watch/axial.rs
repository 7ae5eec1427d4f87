//! Axes whose head and tail are alike: n and -n are the same, and the mean of their components says nothing.

use super::Axes;
use glam::DVec3;
use nalgebra::{Matrix3, SymmetricEigen, Vector3};

/// n n of an axis, the same for n and -n.
pub(super) fn dyad(axis: DVec3) -> Matrix3<f64> {
    let n = Vector3::from(axis.to_array());
    n * n.transpose()
}

/// The largest eigenvalue of a symmetric tensor and its unit vector, whose last entry is not negative.
pub(super) fn principal(tensor: Matrix3<f64>) -> (f64, DVec3) {
    let eigen = SymmetricEigen::new(tensor);
    let largest = eigen.eigenvalues.imax();
    let axis = DVec3::from_slice(eigen.eigenvectors.column(largest).as_slice());
    let up = [2, 1, 0].into_iter().map(|a| axis[a]).find(|x| x.abs() > 1e-12).unwrap_or(1.0);
    (eigen.eigenvalues[largest], axis * up.signum())
}

/// The mean of axes: the principal axis of the sum of their n n, to which the squares of the cosines are largest
/// (the order tensor of de Gennes and Prost 1993; Fisher, Lewis and Embleton 1987, section 3.2.4).
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MeanAxis {
    /// Where the components stand among the numbers of a watch.
    first: usize,
    axes: Axes,
    sum: Matrix3<f64>,
}

impl MeanAxis {
    /// Of the components that begin with number `first`.
    pub fn new(first: usize, axes: Axes) -> Self {
        Self { first, axes, sum: Matrix3::zeros() }
    }

    /// Whether a number is one of the components.
    pub fn has(&self, place: usize) -> bool {
        (self.first..self.first + self.axes.len()).contains(&place)
    }

    /// Takes the axis of a look; one that is no number is left out.
    pub fn take(&mut self, numbers: &[f64]) {
        let mut axis = DVec3::ZERO;
        for (&a, x) in self.axes.iter().zip(&numbers[self.first..]) {
            axis[a] = *x;
        }
        if axis.is_finite() {
            self.sum += dyad(axis);
        }
    }

    /// Puts the mean in place of the components; not numbers before there was an axis.
    pub fn put(&self, numbers: &mut [f64]) {
        let mean = if self.sum.trace() > 0.0 { principal(self.sum).1 } else { DVec3::NAN };
        for (&a, x) in self.axes.iter().zip(&mut numbers[self.first..]) {
            *x = mean[a];
        }
    }

    /// As plain numbers, for a checkpoint.
    pub fn numbers(&self) -> Vec<f64> {
        self.sum.as_slice().to_vec()
    }

    /// Takes them back; whether there are as many as it needs.
    pub fn load(&mut self, numbers: &[f64]) -> bool {
        let whole = numbers.len() == self.sum.len();
        if whole {
            self.sum = Matrix3::from_column_slice(numbers);
        }
        whole
    }
}
