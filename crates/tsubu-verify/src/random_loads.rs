//! Random loads on a lattice: the q-model (V-40), by the engine of piles that hands loads on in random shares.

use super::control::refused;
use super::ensemble;
use super::pile_stress::{BALANCE, base};
use crate::case::Judged;
use crate::origin::closed_form;
use tsubu::lattice::hemmingsson_herrmann::{Rule, Split};
use tsubu::lattice::sheet::{Layout, Sheet};
use tsubu_frame::{Claim, Ensemble};

/// Rows of grains, and grains in the lowest of which the side walls, felt no further than the root of the rows, are left out.
const DEPTH: usize = 400;
const WIDTH: usize = 6000;
const MARGIN: usize = 100;
/// Loads over the mean below which shares of grains are counted.
const BELOW: [f64; 4] = [0.5, 1.0, 2.0, 3.0];

/// Variance of the load over its mean squared in an endless bed of random shares, at a depth: a recursion for the second
/// moments S_k of loads k sites apart, own weights included. With shares q even between 0 and 1, <q^2> = 1/3 and
/// <q (1 - q)> = 1/6.
fn exact_variance(depth: usize) -> f64 {
    let mut moment = vec![1.0; depth + 3];
    let mut mean = 1.0;
    for _ in 1..depth {
        let s = &moment;
        let mut below = vec![mean * mean; s.len()];
        below[0] = 2.0 / 3.0 * s[0] + 0.5 * s[1];
        below[1] = s[0] / 6.0 + 0.5 * s[1] + 0.25 * s[2];
        for k in 2..s.len() - 1 {
            below[k] = 0.25 * (2.0 * s[k] + s[k + 1] + s[k - 1]);
        }
        moment = below.iter().map(|b| b + 2.0 * mean + 1.0).collect();
        mean += 1.0;
    }
    moment[0] / (mean * mean) - 1.0
}

/// Of the loads under a wide bed over the weight of a column: mean, variance, and the shares of grains that carry less than [`BELOW`].
fn loads(split: Split, seed: u64, perturbation: f64) -> [f64; 2 + BELOW.len()] {
    let mut sheet = Sheet::new(Layout::Triangular, WIDTH + 2 * MARGIN, DEPTH + 2);
    sheet.fill(1, DEPTH + 1, 0);
    let loads = base(sheet, Rule { split, ..BALANCE }, seed, perturbation).0;
    let inner: Vec<f64> = loads[MARGIN..loads.len() - MARGIN].iter().map(|load| load[1] / DEPTH as f64).collect();
    let mean = |of: &dyn Fn(f64) -> f64| inner.iter().map(|load| of(*load)).sum::<f64>() / inner.len() as f64;
    let shares = BELOW.map(|x| mean(&|load| f64::from(load < x)));
    let average = mean(&|load| load);
    [average, mean(&|load| (load / average - 1.0).powi(2)), shares[0], shares[1], shares[2], shares[3]]
}

/// What is claimed of the loads, by the mean of eight beds.
fn gates(split: Split, perturbation: f64) -> Judged {
    let found = ensemble::members(&format!("{split:?}"), 1..=8, |seed| Ok(loads(split, seed, perturbation)))?;
    let [mean, variance, shares @ ..] = found;
    let gate = |what: &str, found: Ensemble, wanted: f64, distance: f64, source: &str| {
        let (low, high) = (Some(wanted - distance), Some(wanted + distance));
        Claim::judge_ensemble(format!("random shares: {what}"), found, low, high, closed_form(source))
    };
    let moments = "closed recursion for second moments; the limit 1/2 is reached slowly (Coppersmith and others 1996)";
    let mut claims = vec![
        gate("mean load over rows of weight", mean, 1.0, 0.01, "balance of forces"),
        gate(&format!("variance of the load at depth {DEPTH}"), variance, exact_variance(DEPTH), 0.02, moments),
    ];
    for (x, share) in BELOW.into_iter().zip(shares) {
        let closed = 1.0 - (1.0 + 2.0 * x) * (-2.0 * x).exp();
        let name = format!("share of grains below {x} of the mean load");
        claims.push(gate(&name, share, closed, 0.02, "P(x) = 4 x exp(-2x), the limit of deep beds"));
    }
    Ok(claims)
}

/// V-40: the distribution tends to 4 x exp(-2x).
pub(super) fn q_model(perturbation: f64) -> Judged {
    let mut claims = gates(Split::Random, perturbation)?;
    claims.push(refused("loads that balance as forces do", &gates(Split::Vector, perturbation)?, 4));
    Ok(claims)
}
