//! The modes of a mass and a stiffness matrix.

use nalgebra::{Cholesky, DMatrix, DVector, SymmetricEigen};

/// A mode x with K x = w^2 M x and x M x = 1.
pub(in crate::resolve) struct Mode {
    /// Natural frequency [Hz].
    pub frequency: f64,
    /// A number for each coordinate [1/sqrt(kg)]; the largest is positive.
    pub shape: Vec<f64>,
}

/// All modes, lowest first, of symmetric matrices that are given row by row: with M = L L', those of L^-1 K L'^-1. `None` where M
/// is not positive definite. Motion without stiffness has the frequency 0, or nearly.
pub(in crate::resolve) fn modes(mass: &[Vec<f64>], stiffness: &[Vec<f64>]) -> Option<Vec<Mode>> {
    let n = mass.len();
    let matrix = |rows: &[Vec<f64>]| DMatrix::from_fn(n, n, |row, column| rows[row][column]);
    let lower = Cholesky::new(matrix(mass))?.unpack();
    let half = lower.solve_lower_triangular(&matrix(stiffness))?;
    let reduced = lower.solve_lower_triangular(&half.transpose())?;
    let eigen = SymmetricEigen::new((&reduced + reduced.transpose()) * 0.5);
    let mode = |index: usize| {
        let vector: DVector<f64> = eigen.eigenvectors.column(index).into_owned();
        let shape = lower.transpose().solve_upper_triangular(&vector)?;
        let sign = shape[shape.iamax()].signum();
        Some(Mode {
            frequency: eigen.eigenvalues[index].max(0.0).sqrt() / std::f64::consts::TAU,
            shape: shape.iter().map(|value| value * sign).collect(),
        })
    };
    let mut all = (0..n).map(mode).collect::<Option<Vec<Mode>>>()?;
    all.sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
    Some(all)
}

#[cfg(test)]
mod tests {
    use super::modes;

    /// Two masses on three springs: sqrt(k/m) and sqrt(3 k/m), (1, 1) and (1, -1) over sqrt(2 m).
    #[test]
    fn those_of_two_masses() {
        let (m, k) = (0.5, 200.0);
        let found = modes(&[vec![m, 0.0], vec![0.0, m]], &[vec![2.0 * k, -k], vec![-k, 2.0 * k]]).expect("modes");
        for (mode, (square, other)) in found.iter().zip([(k / m, 1.0), (3.0 * k / m, -1.0)]) {
            assert!((mode.frequency * std::f64::consts::TAU / f64::sqrt(square) - 1.0).abs() < 1e-12);
            assert!((mode.shape[0].abs() - 1.0 / f64::sqrt(2.0 * m)).abs() < 1e-12);
            assert!((mode.shape[1] / mode.shape[0] - other).abs() < 1e-12);
        }
        assert!(modes(&[vec![0.0]], &[vec![1.0]]).is_none());
    }
}
