//! Random loads on a lattice: the q-model (V-40).

use super::bench::within;
use crate::origin::{closed_form, other_program};
use tsubu::random::{Purpose, unit, words};
use tsubu_frame::Claim;

const WIDTH: usize = 40_000;
const DEPTH: u64 = 1500;

/// Loads after `DEPTH` rows over their mean: every grain gives its load and its own weight to the two below, in uniformly
/// random shares; `width` is how wide the shares are spread.
fn loads(width: f64) -> Vec<f64> {
    let mut row = vec![0.0; WIDTH];
    for depth in 0..DEPTH {
        let mut next = vec![0.0; WIDTH];
        for (i, load) in row.iter().enumerate() {
            let w = words(1, Purpose::Lottery, i as u32, depth);
            let share = 0.5 + width * (unit(w[0], w[1]) - 0.5);
            next[i] += share * (load + 1.0);
            next[(i + 1) % WIDTH] += (1.0 - share) * (load + 1.0);
        }
        row = next;
    }
    row
}

/// V-40: the distribution tends to 4 x exp(-2x). At depth 1500 its variance is 0.467 of the final 0.5.
#[expect(clippy::unnecessary_wraps, reason = "the type of all cases")]
pub(super) fn q_model(perturbation: f64) -> Result<Vec<Claim>, String> {
    let row = loads(perturbation);
    let total: f64 = row.iter().sum();
    let mean = DEPTH as f64;
    let source = other_program("Coppersmith, Liu, Majumdar, Narayan, Witten 1996, mean field; independent calculation");
    let name = "random loads: weight carried over weight";
    let mut claims =
        vec![within(name, total / (mean * WIDTH as f64), 1.0, 1e-12, closed_form("conservation of weight"))];
    let variance = row.iter().map(|x| (x / mean - 1.0).powi(2)).sum::<f64>() / WIDTH as f64;
    claims.push(within("random loads: variance at depth 1500 over mean squared", variance, 0.467, 0.012, source));
    for x in [0.5, 1.0, 2.0, 3.0] {
        let below = row.iter().filter(|load| **load < x * mean).count() as f64 / WIDTH as f64;
        let closed = 1.0 - (1.0 + 2.0 * x) * (-2.0 * x).exp();
        claims.push(within(format!("random loads: share below {x} of the mean"), below, closed, 0.02, source));
    }
    Ok(claims)
}
