//! The matrices of hosts: sizes, symmetry, definiteness.

use super::Parts;
use crate::complaint::Complaint;
use crate::plan::Structure;

pub(super) fn check(parts: &Parts<'_>, complaints: &mut Vec<Complaint>) {
    for (name, host) in &parts.hosts {
        let at = |keys: &[&str]| {
            let path: Vec<&str> = ["hosts", name.as_str(), "structure"].iter().chain(keys).copied().collect();
            parts.root.locate(&path)
        };
        match &host.structure {
            Structure::Oscillator { .. } => {}
            Structure::Modes { mode } => {
                if mode.is_empty() {
                    complaints.push(
                        Complaint::new(format!("the host `{name}` has no modes"))
                            .at(&at(&["modes"]), "the list is empty"),
                    );
                } else if mode.iter().all(|mode| mode.shape == 0.0) {
                    complaints.push(
                        Complaint::new(format!("no mode of the host `{name}` moves the walls"))
                            .at(&at(&["modes"]), "every `shape` is 0"),
                    );
                }
            }
            Structure::Matrices { mass, damping, stiffness, coordinate } => {
                let size = mass.len();
                for (key, matrix) in [("damping", damping), ("stiffness", stiffness)] {
                    if matrix.len() != size {
                        complaints.push(
                            Complaint::new(format!("`{key}` of the host `{name}` has another size than `mass`")).at(
                                &at(&["matrices", key]),
                                format!("{0} x {0}, but `mass` is {size} x {size}", matrix.len()),
                            ),
                        );
                    }
                }
                for (key, matrix, definite) in
                    [("mass", mass, true), ("damping", damping, false), ("stiffness", stiffness, true)]
                {
                    if let Some((i, j)) = asymmetry(matrix) {
                        complaints.push(Complaint::new(format!("`{key}` of the host `{name}` is not symmetric")).at(
                            &at(&["matrices", key]),
                            format!(
                                "row {}, column {} is {}, but mirrored {}",
                                i + 1,
                                j + 1,
                                matrix[i][j],
                                matrix[j][i]
                            ),
                        ));
                    } else if definite && !positive_definite(matrix) {
                        complaints.push(
                            Complaint::new(format!("`{key}` of the host `{name}` is not positive definite"))
                                .at(&at(&["matrices", key]), "some displacement would have no or negative energy"),
                        );
                    }
                }
                if *coordinate >= size {
                    complaints.push(Complaint::new(format!("the host `{name}` has no coordinate {coordinate}")).at(
                        &at(&["matrices", "coordinate"]),
                        format!("coordinates here: 0 to {}", size.saturating_sub(1)),
                    ));
                }
            }
        }
    }
}

/// The first pair of entries that differ by more than rounding in the typed digits.
fn asymmetry(matrix: &[Vec<f64>]) -> Option<(usize, usize)> {
    let pairs = (0..matrix.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    pairs.into_iter().find(|&(i, j)| {
        let (a, b) = (matrix[i][j], matrix[j][i]);
        (a - b).abs() > 1e-9 * a.abs().max(b.abs())
    })
}

/// Cholesky: it succeeds exactly for positive definite matrices.
fn positive_definite(matrix: &[Vec<f64>]) -> bool {
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
