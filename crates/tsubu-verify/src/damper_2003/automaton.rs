//! A-F11: response by the automaton, with its literal rules and with resting impulses; and by balls of several cells.

use super::{FIGURE_11, LUMP, of_fillings, peak, respond, response_claims, shaken};
use crate::bench::within;
use crate::case::Judged;
use crate::control::refused;
use crate::ensemble;
use crate::origin::{closed_form, own, printed};
use std::ops::RangeInclusive;
use tsubu::random::{Purpose, unit, words};
use tsubu::study::response::{CaseResult, peak as top};
use tsubu_frame::{Claim, Ensemble};

const COUNTS: [usize; 4] = [0, 10, 30, 50];
/// Frequencies of a curve.
const POINTS: usize = 31;
const SEEDS: RangeInclusive<u64> = 1..=20;
/// How often seeds are drawn again.
const DRAWS: u64 = 2000;

/// The curves of all numbers of balls, seed by seed: [m] at every frequency.
struct Curves {
    ratios: Vec<f64>,
    /// By number of balls and frequency.
    rms: Vec<Ensemble>,
}

impl Curves {
    /// At an amplitude of the base [mm].
    fn of(mode: &str, amplitude: f64, perturbation: f64) -> Result<Self, String> {
        let changes = [
            format!("response.vary.\"lattice.mode\"=[\"{mode}\"]"),
            format!("hosts.leaf-spring.base.sine.amplitude={amplitude} mm"),
            "response.seeds=1".to_owned(),
            // The empty box moves forty times as far as its base, and room costs nothing.
            "lattice.head-room=40".to_owned(),
        ];
        let found: [Ensemble; COUNTS.len() * POINTS] =
            ensemble::members(&format!("{mode}, {amplitude} mm"), SEEDS, |seed| {
                let mut changes = changes.to_vec();
                changes.push(format!("seed={seed}"));
                let cases = respond(FIGURE_11, &changes, perturbation)?;
                let mut values = [f64::NAN; COUNTS.len() * POINTS];
                for (values, count) in values.chunks_exact_mut(POINTS).zip(COUNTS) {
                    let rows = cases.iter().filter(|case| case.particles == count).flat_map(|case| &case.rows);
                    values.iter_mut().zip(rows).for_each(|(value, row)| *value = row.rms[0]);
                }
                Ok(values)
            })?;
        let ratios = (0..POINTS).map(|i| 0.85 + 0.01 * i as f64).collect();
        Ok(Self { ratios, rms: found.into() })
    }

    /// Where the mean curve of some seeds, by their places, has its top.
    fn place(&self, count: usize, seeds: &[usize]) -> f64 {
        let of_count = &self.rms[count * POINTS..(count + 1) * POINTS];
        let mean =
            of_count.iter().map(|rms| seeds.iter().map(|&seed| rms.members[seed]).sum::<f64>() / seeds.len() as f64);
        let curve: Vec<(f64, f64)> = self.ratios.iter().copied().zip(mean).collect();
        top(&curve).map_or(f64::NAN, |top| top.ratio)
    }

    /// Shift of the top of the mean curve from one number of balls to another, with the interval of seeds drawn again; that of single
    /// seeds beside it.
    fn shift(&self, [from, to]: [usize; 2]) -> (f64, Ensemble) {
        let seeds: Vec<u64> = SEEDS.collect();
        let size = seeds.len();
        let all: Vec<usize> = (0..size).collect();
        let drawn = |draw: u64, of: usize| -> Vec<usize> {
            let number = |i: usize| words(draw, Purpose::Lottery, (of * size + i) as u32, 0);
            (0..size).map(|i| (unit(number(i)[0], number(i)[1]) * size as f64) as usize).collect()
        };
        let mut shifts: Vec<f64> =
            (0..DRAWS).map(|draw| self.place(to, &drawn(draw, to)) - self.place(from, &drawn(draw, from))).collect();
        shifts.sort_unstable_by(f64::total_cmp);
        let quantile = |share: f64| shifts[(share * (DRAWS - 1) as f64).round() as usize];
        let members = all.iter().map(|&seed| self.place(to, &[seed]) - self.place(from, &[seed])).collect();
        let interval = vec![quantile(0.025), quantile(0.975)];
        (self.place(to, &all) - self.place(from, &all), Ensemble { seeds, members, interval })
    }
}

/// That the peak does not move down, as the paper's does not: the top of the mean curve of all seeds, with those of single seeds beside it.
fn not_down(mode: &str, amplitude: f64, perturbation: f64) -> Judged {
    let curves = Curves::of(mode, amplitude, perturbation)?;
    let source = printed(
        "figure 11: more balls, peak at a higher frequency (a defect of the model, says the paper); of the mean curve",
    )
    .after();
    let claim = |pair: [usize; 2]| {
        let (value, shift) = curves.shift(pair);
        let [from, to] = pair.map(|i| COUNTS[i]);
        let name = format!("automaton, {mode}, base {amplitude} mm: shift of the peak from {from} to {to} balls");
        Claim { value, ..Claim::judge_ensemble(name, shift, Some(0.0), None, source) }
    };
    Ok([[0, 1], [1, 2], [2, 3]].map(claim).to_vec())
}

/// Lower peaks with more balls, and that the gates refuse higher ones.
fn lower(mode: &str, cases: &[CaseResult]) -> Vec<Claim> {
    let mut claims = falling(mode, cases, COUNTS);
    let [none, few, many, most] = COUNTS;
    let turned = falling(mode, cases, [most, many, few, none]);
    claims.push(refused(&format!("automaton, {mode}, with more and fewer balls changed for each other"), &turned, 1));
    claims
}

/// Peaks that fall in an order of numbers of balls.
fn falling(mode: &str, cases: &[CaseResult], counts: [usize; 4]) -> Vec<Claim> {
    let source = printed("figure 11: more balls, lower peak");
    let claim = |pair: &[usize]| {
        let ratio = peak(cases, pair[1]).1 / peak(cases, pair[0]).1;
        let name = format!("automaton, {mode}: peak with {} over peak with {}", pair[1], pair[0]);
        Claim::judge(name, ratio, Some(0.0), Some(1.0), source)
    };
    counts.windows(2).map(claim).collect()
}

/// The response with changed keys.
fn cases(mode: &str, changes: &[&str], perturbation: f64) -> Result<Vec<CaseResult>, String> {
    let mut all = vec![format!("response.vary.\"lattice.mode\"=[\"{mode}\"]")];
    all.extend(changes.iter().map(|change| (*change).to_owned()));
    respond(FIGURE_11, &all, perturbation)
}

/// A-F11, literal: the peak falls and does not move down, which the authors name as the defect of their model. The paper gives no
/// amplitude: the shift is told at four.
pub(crate) fn figure_11_literal(perturbation: f64) -> Judged {
    let mut claims = lower("literal", &cases("literal", &["response.seeds=20"], perturbation)?);
    for amplitude in [0.25, 0.5, 1.0, 2.0] {
        claims.extend(not_down("literal", amplitude, perturbation)?);
    }
    claims.push(refused("resting impulses in the literal automaton", &not_down("extended", 0.5, perturbation)?, 1));
    Ok(claims)
}

/// A-F11, extended: with resting impulses the shift has the sign of nature.
pub(crate) fn figure_11_extended(perturbation: f64) -> Judged {
    ensemble::drawn("responses", 1..=5, |seed| extended_of(seed, perturbation))
}

/// The same of one draw.
fn extended_of(seed: u64, perturbation: f64) -> Judged {
    let drawn = format!("seed={seed}");
    let down = |mode: &str, cases: &[CaseResult]| -> Vec<Claim> {
        let source = own("resting impulses bring the shift down").after();
        let claim = |pair: &[usize]| {
            let shift = peak(cases, pair[1]).0 - peak(cases, pair[0]).0;
            let name = format!("automaton, {mode}: shift of the peak from {} to {} balls", pair[0], pair[1]);
            Claim::judge(name, shift, None, Some(-0.001), source)
        };
        COUNTS.windows(2).map(claim).collect()
    };
    let found = cases("extended", &[&drawn], perturbation)?;
    let mut claims = lower("extended", &found);
    claims.extend(down("extended", &found));
    let literal = cases("literal", &[&drawn], perturbation)?;
    claims.push(refused("the automaton without resting impulses", &down("literal", &literal), 1));
    claims.extend(small("extended", "extended", &[&drawn], perturbation)?);
    let literal = small("literal", "literal", &[&drawn], perturbation)?;
    claims.push(refused("the automaton without resting impulses, at 0.05 mm", &literal, 1));
    Ok(claims)
}

/// Where the peak is if the base hardly moves: the balls move with the box.
fn small(what: &str, mode: &str, changes: &[&str], perturbation: f64) -> Judged {
    let gentle = [
        "hosts.leaf-spring.base.sine.amplitude=0.05 mm",
        "response.seeds=1",
        "response.frequency-ratio={ from = 0.9, to = 1.04, step = 0.005 }",
    ];
    let found = cases(mode, &[&gentle, changes].concat(), perturbation)?;
    let claim = |&count: &usize| {
        let limit = 1.0 / (1.0 + 0.2e-3 * count as f64 / 0.086_f64).sqrt();
        let name = format!("automaton, {what}, 0.05 mm, {count} balls: peak frequency ratio");
        within(name, peak(&found, count).0, limit, 0.01, closed_form("added-mass limit at small amplitude"))
    };
    Ok(COUNTS[1..].iter().map(claim).collect())
}

/// A-9, the authors' remedy for a locked packing: balls of several cells. What is asked of DEM is asked of them.
pub(crate) fn hexagons(perturbation: f64) -> Judged {
    const HEXAGONS: [&str; 2] = ["lattice.ball-radius=2", "lattice.head-room=200"];
    let source = printed("figure 11: more balls, lower peak");
    let extended = [&["response.vary.\"lattice.mode\"=[\"extended\"]"], HEXAGONS.as_slice()].concat();
    let mut claims = of_fillings("balls of 19 cells", FIGURE_11, &extended, source, perturbation)?;
    let single = ["response.vary.\"lattice.mode\"=[\"literal\"]".to_owned()];
    let gates = response_claims("", &respond(FIGURE_11, &single, 1.0)?, &LUMP, source);
    claims.push(refused("the published automaton, one cell a ball", &gates, 3));
    claims.extend(small("balls of 19 cells", "extended", &HEXAGONS, perturbation)?);
    let literal = small("balls of 19 cells", "literal", &HEXAGONS, perturbation)?;
    claims.push(refused("balls of 19 cells without resting impulses, at 0.05 mm", &literal, 2));
    claims.extend(shaken::hexagons(&HEXAGONS)?);
    Ok(claims)
}
