//! Forces in a pile at rest, after Hemmingsson, Herrmann and Roux (spec of the review: R-5).
//!
//! The perturbation multiplies what the grains weigh below the middle of the pile.

use super::bench::within;
use super::control::{refused, refused_number};
use crate::origin::{closed_form, own};
use tsubu::lattice::hemmingsson_herrmann::{Pile, Rule, Split};
use tsubu::lattice::sheet::{Layout, Sheet, WALL};
use tsubu_frame::Claim;

pub(super) const BALANCE: Rule = Rule { split: Split::Vector, friction: 0.0, arching: 0.0 };

/// A pile of 60 degrees over `base` grains.
fn triangle(base: usize) -> Sheet {
    let mut sheet = Sheet::new(Layout::Triangular, base + 4, base + 2);
    let mut grain = 0;
    for row in 1..=base {
        // Rows begin half a site further right than the one below; odd rows are shifted already.
        let first = sheet.index(2 + row / 2, row);
        for cell in &mut sheet.cells[first..first + base + 1 - row] {
            *cell = grain;
            grain += 1;
        }
    }
    sheet
}

/// Loads of the base grains, left to right, and the sum of what walls got.
pub(super) fn base(sheet: Sheet, rule: Rule, seed: u64, perturbation: f64) -> (Vec<[f64; 2]>, [f64; 2]) {
    let count = sheet.grains();
    let weight = (0..count).map(|grain| if grain < count / 2 { perturbation } else { 1.0 }).collect();
    let mut pile = Pile::new(sheet, rule, weight, seed);
    let mut floor = [0.0; 2];
    let walls: Vec<bool> = pile.sheet.cells.iter().map(|&cell| cell == WALL).collect();
    for _ in 0..pile.rows() {
        pile.advance(&mut |passed| {
            if walls[passed.to] {
                floor[0] += passed.force[0];
                floor[1] += passed.force[1];
            }
        });
    }
    let row = (0..pile.sheet.columns()).map(|c| pile.sheet.index(c, 1)).filter(|&s| pile.sheet.cells[s] >= 0);
    (row.map(|s| pile.load[s]).collect(), floor)
}

/// Gates on the base of a pile without friction.
fn flat(name: &str, loads: &[[f64; 2]]) -> Vec<Claim> {
    let size = loads.len() as f64;
    let source = closed_form("closed form: (N+1) w/2 down, (N+1-2i) w/2 tan 30 outwards");
    let down = loads.iter().map(|l| (l[1] / (0.5 * (size + 1.0)) - 1.0).abs()).fold(0.0, f64::max);
    let level = |i: usize, x: f64| (x + 0.5 * (size - 1.0 - 2.0 * i as f64) / 3.0_f64.sqrt()).abs();
    let out = loads.iter().enumerate().map(|(i, l)| level(i, l[0])).fold(0.0, f64::max);
    vec![
        within(format!("{name}: load of base grains, worst"), down, 0.0, 1e-12, source),
        within(format!("{name}: level force of base grains, worst, over w"), out, 0.0, 1e-11, source),
    ]
}

/// How far the mean load of the five middle base grains lies below the largest mean of five, over the mean of all.
fn dip(rule: Rule, perturbation: f64) -> f64 {
    let size = 61;
    let mut mean = vec![0.0; size];
    for seed in 0..100 {
        for (sum, load) in mean.iter_mut().zip(base(triangle(size), rule, seed, perturbation).0) {
            *sum += load[1];
        }
    }
    let fives: Vec<f64> = mean.windows(5).map(|five| five.iter().sum::<f64>()).collect();
    let most = fives.iter().copied().fold(0.0, f64::max);
    (most - fives[28]) / (5.0 * mean.iter().sum::<f64>() / size as f64)
}

/// the five closed forms, the q-model among them, and the dip by arching.
#[expect(clippy::unnecessary_wraps, reason = "the type of all cases")]
pub(super) fn pile(perturbation: f64) -> Result<Vec<Claim>, String> {
    let size = 40;
    let total = triangle(size).grains() as f64;
    let carried = |rule: Rule| base(triangle(size), rule, 1, 1.0).1[1] / total;
    let arch = Rule { arching: 0.3, ..BALANCE };
    let mut claims = Vec::new();
    for (name, rule) in [
        ("frictionless", BALANCE),
        ("friction 0.3 and arching 0.3", Rule { friction: 0.3, ..arch }),
        ("random shares", Rule { split: Split::Random, ..BALANCE }),
    ] {
        claims.push(within(
            format!("pile, {name}: base load over weight"),
            carried(rule),
            1.0,
            1e-12,
            closed_form("balance of forces"),
        ));
    }
    claims.extend(flat("pile, frictionless", &base(triangle(size), BALANCE, 1, perturbation).0));
    claims.push(refused("arching in the flat pile", &flat("", &base(triangle(size), arch, 1, 1.0).0), 2));
    claims.extend(q_model(perturbation));
    let gate = |dip| {
        Claim::judge(
            "pile, arching 0.5: dip below the axis over the mean load",
            dip,
            Some(0.2),
            None,
            own("arching carries load outwards").after(),
        )
    };
    let none = dip(BALANCE, perturbation);
    claims.push(gate(dip(Rule { arching: 0.5, ..BALANCE }, 1.0)));
    claims.push(within("pile, no arching: dip", none, 0.0, 1e-12, closed_form("closed form: flat")));
    claims.push(refused("no arching", &[gate(none)], 1));
    Ok(claims)
}

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

/// Random shares: loads under a wide bed. P(x) = 4 x exp(-2 x) is the limit; its variance 1/2 is reached slowly.
fn q_model(perturbation: f64) -> Vec<Claim> {
    let (depth, width) = (200, 6000);
    let mut sheet = Sheet::new(Layout::Triangular, width, depth + 2);
    sheet.fill(1, depth + 1, 0);
    let rule = Rule { split: Split::Random, ..BALANCE };
    let loads = base(sheet, rule, 1, perturbation).0;
    // Side walls take load; they are felt no further than sqrt(depth).
    let inner: Vec<f64> = loads[100..loads.len() - 100].iter().map(|l| l[1]).collect();
    let mean = inner.iter().sum::<f64>() / inner.len() as f64;
    let variance = inner.iter().map(|x| (x / mean - 1.0).powi(2)).sum::<f64>() / inner.len() as f64;
    let source = closed_form(
        "closed recursion for second moments; the limit 1/2 is reached slowly (Coppersmith and others 1996)",
    );
    let mut claims = vec![
        within(
            "pile, random shares: mean load over rows of weight",
            mean / depth as f64,
            1.0,
            0.01,
            closed_form("balance of forces"),
        ),
        within("pile, random shares: variance at depth 200", variance, exact_variance(depth), 0.02, source),
    ];
    let share = |x: f64, of: &[f64]| of.iter().filter(|load| **load < x * mean).count() as f64 / of.len() as f64;
    let gates = |of: &[f64]| -> Vec<Claim> {
        [0.5, 1.0, 2.0, 3.0]
            .map(|x: f64| {
                let closed = 1.0 - (1.0 + 2.0 * x) * (-2.0 * x).exp();
                let name = format!("pile, random shares: share of grains below {x} of the mean load");
                within(name, share(x, of), closed, 0.03, closed_form("closed form: P(x) = 4 x exp(-2x)"))
            })
            .to_vec()
    };
    claims.extend(gates(&inner));
    claims.push(refused_number("equal shares", &gates(&vec![mean; 100]), 3));
    claims
}
