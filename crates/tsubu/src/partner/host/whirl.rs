//! The natural frequencies of a rotor at its speed.

use super::Host;
use nalgebra::DMatrix;

impl Host {
    /// Undamped frequencies of whirl [Hz], lowest first: (K + s W G + s^2 M) x = 0 with s = i w and the speed W. Nothing without
    /// gyroscopic terms. Over speed they are the lines of Campbell's diagram (Genta 2005, Dynamics of Rotating Systems).
    pub(super) fn whirl(&self) -> Option<Vec<f64>> {
        let n = self.n;
        let rates = DMatrix::from_row_slice(n, n, &self.damping);
        // C is symmetric.
        let gyroscopic = (&rates - rates.transpose()) * 0.5;
        if gyroscopic.iter().all(|g| *g == 0.0) {
            return None;
        }
        let inverse = DMatrix::from_row_slice(n, n, &self.mass_inverse);
        let stiffness = DMatrix::from_row_slice(n, n, &self.stiffness);
        let mut state = DMatrix::zeros(2 * n, 2 * n);
        state.view_mut((0, n), (n, n)).fill_with_identity();
        state.view_mut((n, 0), (n, n)).copy_from(&(-&inverse * stiffness));
        state.view_mut((n, n), (n, n)).copy_from(&(-inverse * gyroscopic));
        // K is positive definite: the eigenvalues are n pairs on the imaginary axis.
        let mut found: Vec<f64> = state.complex_eigenvalues().iter().map(|s| s.im / std::f64::consts::TAU).collect();
        found.sort_by(f64::total_cmp);
        Some(found.split_off(n))
    }
}
