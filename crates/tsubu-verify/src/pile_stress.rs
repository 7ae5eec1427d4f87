//! Forces in a pile at rest, after Hemmingsson, Herrmann and Roux (spec of the review: R-5).
//!
//! The perturbation multiplies what the grains weigh below the middle of the pile.

use super::bench::within;
use super::control::refused;
use super::ensemble;
use crate::case::Judged;
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

/// Of a set of a hundred draws: how far the mean load of the five middle base grains lies below the largest mean of five, over the mean of all.
fn dip(rule: Rule, set: u64, perturbation: f64) -> f64 {
    let size = 61;
    let mut mean = vec![0.0; size];
    for seed in 100 * set..100 * (set + 1) {
        for (sum, load) in mean.iter_mut().zip(base(triangle(size), rule, seed, perturbation).0) {
            *sum += load[1];
        }
    }
    let fives: Vec<f64> = mean.windows(5).map(|five| five.iter().sum::<f64>()).collect();
    let most = fives.iter().copied().fold(0.0, f64::max);
    (most - fives[28]) / (5.0 * mean.iter().sum::<f64>() / size as f64)
}

/// the closed forms but for the q-model, which is a case of its own, and the dip by arching.
pub(super) fn pile(perturbation: f64) -> Judged {
    ensemble::drawn("piles", 0..=7, |set| {
        let size = 40;
        let total = triangle(size).grains() as f64;
        let carried = |rule: Rule| base(triangle(size), rule, 1, perturbation).1[1] / total;
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
        let gate = |dip| {
            Claim::judge(
                "pile, arching 0.5: dip below the axis over the mean load",
                dip,
                Some(0.2),
                None,
                own("arching carries load outwards").after(),
            )
        };
        let none = dip(BALANCE, set, perturbation);
        claims.push(gate(dip(Rule { arching: 0.5, ..BALANCE }, set, 1.0)));
        claims.push(within("pile, no arching: dip", none, 0.0, 1e-12, closed_form("closed form: flat")));
        claims.push(refused("no arching", &[gate(none)], 1));
        Ok(claims)
    })
}
