//! The matrices of a structure, row by row, and what is done with them.

use tsubu_scene::plan::Structure;

pub(super) type Matrices = (Vec<f64>, Vec<f64>, Vec<f64>, Vec<f64>, Vec<f64>);

/// M, C, K (row by row), w and r of a structure; C with the gyroscopic matrix of a rotor at its speed, its skew part.
pub(super) fn matrices(structure: &Structure) -> Matrices {
    match structure {
        Structure::Shaker {} => (vec![f64::INFINITY], vec![0.0], vec![0.0], vec![1.0], vec![1.0]),
        Structure::Oscillator { mass, stiffness, damping, cubic_stiffness: _ } => {
            (vec![*mass], vec![*damping], vec![*stiffness], vec![1.0], vec![1.0])
        }
        Structure::Matrices { mass, damping, stiffness, gyroscopic, speed, coordinate, participation } => {
            let n = mass.len();
            let mut rates = damping.concat();
            // The base does not tilt a rotor (the scene reader refuses it), so that G may see q' - r y' as C does.
            for (c, g) in rates.iter_mut().zip(gyroscopic.iter().flatten().flatten()) {
                *c += speed * g;
            }
            let seen = (0..n).map(|i| f64::from(u8::from(i == *coordinate))).collect();
            (mass.concat(), rates, stiffness.concat(), seen, participation.clone())
        }
        Structure::Modes { mode } => {
            let n = mode.len();
            let mut m = vec![0.0; n * n];
            let mut c = m.clone();
            let mut k = m.clone();
            for (i, mode) in mode.iter().enumerate() {
                let w = std::f64::consts::TAU * mode.frequency;
                m[i * n + i] = mode.mass;
                c[i * n + i] = 2.0 * mode.damping_ratio * mode.mass * w;
                k[i * n + i] = mode.mass * w * w;
            }
            (m, c, k, mode.iter().map(|m| m.shape).collect(), mode.iter().map(|m| m.participation).collect())
        }
        Structure::Pendulum { inertia, damping, arm, .. } => {
            (vec![*inertia], vec![*damping], vec![0.0], vec![*arm], vec![0.0])
        }
    }
}

/// Inverse of a positive definite matrix (the scene reader refuses others).
pub(super) fn inverse(matrix: &[f64], n: usize) -> Vec<f64> {
    if n == 1 {
        return vec![1.0 / matrix[0]];
    }
    let inverse = nalgebra::DMatrix::from_row_slice(n, n, matrix).try_inverse();
    inverse.map_or_else(|| vec![f64::NAN; n * n], |m| m.transpose().as_slice().to_vec())
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub(super) fn multiply(matrix: &[f64], x: &[f64], out: &mut [f64]) {
    let n = x.len();
    for (i, out) in out.iter_mut().enumerate() {
        *out = dot(&matrix[i * n..(i + 1) * n], x);
    }
}

pub(super) fn quadratic(matrix: &[f64], x: &[f64]) -> f64 {
    let n = x.len();
    (0..n).map(|i| x[i] * dot(&matrix[i * n..(i + 1) * n], x)).sum()
}
