//! Whether a matrix is what a structure needs.

/// The first pair of entries that differ by more than rounding in the typed digits.
pub(crate) fn asymmetry(matrix: &[Vec<f64>]) -> Option<(usize, usize)> {
    let pairs = (0..matrix.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    pairs.into_iter().find(|&(i, j)| {
        let (a, b) = (matrix[i][j], matrix[j][i]);
        let scale = (matrix[i][i] * matrix[j][j]).abs().sqrt();
        (a - b).abs() > 1e-9 * a.abs().max(b.abs()) + 1e-12 * scale
    })
}

/// Cholesky: it succeeds exactly for positive definite matrices.
pub(crate) fn positive_definite(matrix: &[Vec<f64>]) -> bool {
    let n = matrix.len();
    let mut lower = vec![vec![0.0; n]; n];
    for i in 0..n {
        for j in 0..=i {
            let known: f64 = (0..j).map(|k| lower[i][k] * lower[j][k]).sum();
            let rest: f64 = matrix[i][j] - known;
            if i == j {
                // A pivot of pure rounding error means a singular matrix.
                if rest.is_nan() || rest <= 1e-12 * matrix[i][i].abs() {
                    return false;
                }
                lower[i][i] = rest.sqrt();
            } else {
                lower[i][j] = rest / lower[j][j];
            }
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn definiteness_is_told_apart() {
        assert!(positive_definite(&[vec![2.0, -1.0], vec![-1.0, 2.0]]));
        assert!(
            !positive_definite(&[vec![1.0, -1.0], vec![-1.0, 1.0]]),
            "a free body has a rigid motion without energy"
        );
        assert!(!positive_definite(&[vec![1.0, 2.0], vec![2.0, 1.0]]));
        assert!(!positive_definite(&[vec![0.0]]));
    }
}
