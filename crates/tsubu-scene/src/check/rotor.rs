//! The gyroscopic matrices of rotors: size, skew symmetry, and a base that does not tilt them.

use super::Parts;
use crate::complaint::Complaint;
use crate::plan::{Host, Structure};

pub(super) fn check(parts: &Parts<'_>, name: &str, host: &Host, complaints: &mut Vec<Complaint>) {
    let Structure::Matrices { mass, gyroscopic, speed, participation, .. } = &host.structure else { return };
    let at = |key: &str| parts.root.locate(&["hosts", name, "structure", "matrices", key]);
    let Some(matrix) = gyroscopic else {
        if *speed != 0.0 {
            complaints.push(
                Complaint::new(format!("the host `{name}` spins, but has no `gyroscopic` matrix"))
                    .at(&at("speed"), format!("{speed} rad/s"))
                    .hint("add `gyroscopic`, the skew matrix G of the force -speed G q'"),
            );
        }
        return;
    };
    if matrix.len() != mass.len() {
        complaints.push(
            Complaint::new(format!("`gyroscopic` of the host `{name}` has another size than `mass`"))
                .at(&at("gyroscopic"), format!("{0} x {0}, but `mass` is {1} x {1}", matrix.len(), mass.len())),
        );
        return;
    }
    if let Some((i, j)) = not_skew(matrix) {
        complaints.push(
            Complaint::new(format!("`gyroscopic` of the host `{name}` is not skew"))
                .at(
                    &at("gyroscopic"),
                    format!("row {}, column {} is {}, but mirrored {}", i + 1, j + 1, matrix[i][j], matrix[j][i]),
                )
                .hint("mirrored entries have opposite signs and the diagonal is 0: a gyroscopic force does no work"),
        );
    }
    let tilts = |row: &Vec<f64>| row.iter().zip(participation).any(|(g, r)| *g != 0.0 && *r != 0.0);
    if host.base.is_some() && matrix.iter().any(tilts) {
        complaints.push(
            Complaint::new(format!("the base would drive gyroscopic coordinates of the host `{name}`"))
                .at(&at("gyroscopic"), "its spin acts on coordinates that `participation` says the base drives")
                .hint(
                    "a base shifts a rotor and does not tilt it: write `participation` 0 for the coordinates that tilt",
                ),
        );
    }
}

/// The first pair of entries that are not opposite, beyond rounding in the typed digits.
fn not_skew(matrix: &[Vec<f64>]) -> Option<(usize, usize)> {
    let pairs = (0..matrix.len()).flat_map(|i| (0..=i).map(move |j| (i, j)));
    pairs.into_iter().find(|&(i, j)| {
        let (a, b) = (matrix[i][j], matrix[j][i]);
        (a + b).abs() > 1e-9 * a.abs().max(b.abs())
    })
}
