//! A chute on the square lattice, after Savage (spec of the review: ).
//!
//! The perturbation multiplies the chance of upward moves.

use super::bench::near;
use super::control::refused;
use super::ensemble;
use super::voids::slope;
use crate::case::Judged;
use crate::origin::{closed_form, own};
use tsubu::lattice::savage::{Chute, Moves};
use tsubu::lattice::sheet::{Layout, Sheet};
use tsubu::random::{Purpose, words};
use tsubu_frame::Claim;

const SMALL: Moves = Moves { down: 0.025, diagonal: 0.015, sideways: 0.05, up: 0.02 };
const COLUMNS: usize = 122;

/// A bed of 20 rows on a slope without end, half of the grains larger than the rest.
fn bed(ratio: f64, moves: Moves, seed: u64) -> (Chute, Vec<bool>) {
    let mut sheet = Sheet::new(Layout::Square, COLUMNS, 42);
    let count = sheet.fill(1, 21, 0);
    let large: Vec<bool> = (0..count as u32).map(|i| words(seed, Purpose::Size, i, 0)[0] < 1 << 31).collect();
    let sieve = large.iter().map(|large| if *large { ratio } else { 1.0 }).collect();
    (Chute::new(sheet, sieve, moves, 0.4, true, seed), large)
}

/// Grains and their rows.
fn seats(chute: &Chute) -> impl Iterator<Item = (usize, usize)> + '_ {
    let cells = chute.sheet.cells.iter().enumerate();
    cells.filter_map(|(site, &cell)| Some((usize::try_from(cell).ok()?, chute.sheet.column_and_row(site).1)))
}

/// Fall of ln n/(1-n) and of ln of the speed from row to row, both over that of the closed form.
fn profile(perturbation: f64, seed: u64) -> [f64; 2] {
    let (mut chute, _) = bed(1.0, Moves { up: SMALL.up * perturbation, ..SMALL }, seed);
    let rows = chute.sheet.rows();
    let (mut here, mut gone) = (vec![0.0; rows], vec![0.0; rows]);
    for step in 0..16000 {
        chute.advance();
        if step < 4000 || step % 5 != 0 {
            continue;
        }
        for (grain, row) in seats(&chute) {
            here[row] += 1.0;
            gone[row] += f64::from(chute.trail.during(grain, chute.step)[0]);
        }
    }
    let full = 2400.0 * (COLUMNS - 2) as f64;
    let fall = ((SMALL.down + SMALL.diagonal) / SMALL.up).ln();
    // Three rows over the three below them, where voids are few, but not too few to count: single rows scatter too much for a line.
    let three = |from: usize| (from..from + 3).map(|r| gone[r] / here[r]).sum::<f64>();
    let speed = (three(14) / three(11)).ln() / 3.0;
    let odds: Vec<(f64, f64)> = (8..26).map(|r| (r as f64, (here[r] / (full - here[r])).ln())).collect();
    [-slope(&odds) / fall, speed / fall]
}

/// Height of large grains over small ones, in rows, after every so many steps; and how far the mean grain has come,
/// in spacings.
fn sorted(ratio: f64, perturbation: f64, seed: u64) -> Vec<(f64, f64)> {
    let (mut chute, large) =
        bed(ratio, Moves { down: 0.5, diagonal: 0.3, sideways: 0.6, up: 0.3 * perturbation }, seed);
    let (mut way, mut found) = (0.0, Vec::new());
    for step in 1..=3000 {
        chute.advance();
        if step % 10 == 0 {
            // Half spacings in one of ten steps.
            let sum: i32 = (0..large.len()).map(|g| chute.trail.during(g, chute.step)[0]).sum();
            way += 5.0 * f64::from(sum) / large.len() as f64;
        }
        if step % 500 == 0 {
            let mean = |of: bool| {
                let rows: Vec<usize> = seats(&chute).filter(|(g, _)| large[*g] == of).map(|(_, row)| row).collect();
                rows.iter().sum::<usize>() as f64 / rows.len() as f64
            };
            found.push((way, mean(true) - mean(false)));
        }
    }
    found
}

/// the profile of the flow, and large grains that come to lie on top.
pub(super) fn chute(perturbation: f64) -> Judged {
    ensemble::drawn("chute", 1..=12, |seed| {
        let closed = closed_form(
            "closed form: n/(1-n) = exp((z0-z)/h), speed as exp(-(z0-z)/h), h = 1/ln(downward chances / upward)",
        );
        let falls = |[odds, speed]: [f64; 2]| {
            [
                near("chute after Savage: fall-off of voids with depth over closed form", odds, 1.0, 0.1, closed),
                near("chute after Savage: fall-off of speed with depth over closed form", speed, 1.0, 0.1, closed),
            ]
        };
        let mut claims = falls(profile(perturbation, seed)).to_vec();
        claims.push(refused("upward moves 20 % more likely", &falls(profile(1.2, seed)), 2));
        let gates = |found: &[(f64, f64)]| {
            let (first, last) = (found[0], found[found.len() - 1]);
            let source = own("inverse grading that grows on the way (kinetic sieving)").after();
            vec![
                Claim::judge(
                    "chute after Savage: large grains over small ones at the end, rows",
                    last.1,
                    Some(2.0),
                    None,
                    source,
                ),
                Claim::judge(
                    "chute after Savage: the same over that after a sixth of the way",
                    last.1 / first.1,
                    Some(1.5),
                    None,
                    source,
                ),
            ]
        };
        let (mixed, equal) = (sorted(0.6, perturbation, seed), sorted(1.0, perturbation, seed));
        claims.extend(gates(&mixed));
        let none = |found: &[(f64, f64)]| {
            let name = "chute after Savage: equal sizes, one colour over the other, rows";
            let source = closed_form("no sieving, no sorting; noise 0.25");
            Claim::judge(name, found[found.len() - 1].1, Some(-0.6), Some(0.6), source)
        };
        claims.push(none(&equal));
        claims.push(refused("equal sizes", &gates(&equal), 1));
        claims.push(refused("two sizes for one", &[none(&mixed)], 1));
        Ok(claims)
    })
}
