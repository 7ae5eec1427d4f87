//! density waves of grains that fall through a pipe, after Peng and Herrmann.

use super::super::bench::within;
use super::super::control::refused;
use super::super::ensemble;
use super::fhp::slope;
use crate::case::Judged;
use crate::origin::{closed_form, own};
use std::f64::consts::TAU;
use tsubu::lattice::gas::collide::Rules;
use tsubu::lattice::gas::grains::{Grains, Habits};
use tsubu::lattice::gas::planes::Gas;
use tsubu::random::{Purpose, unit, words};
use tsubu_frame::{Claim, Source};

const SOURCE: Source = own("Peng and Herrmann 1994, abstract; rules after them").after();
const LENGTH: usize = 512;
const WIDTH: usize = 10;

/// A pipe that is closed in itself, with `density` grains a site in it.
fn pipe(density: f64, habits: Habits, seed: u64) -> Grains {
    let mut grains = Grains::new(WIDTH + 2, LENGTH, [true, true], habits, seed);
    for row in 0..LENGTH {
        grains.set_wall(0, row, Some(0));
        grains.set_wall(WIDTH + 1, row, Some(0));
        for column in 1..=WIDTH {
            let there = |slot: &u64| {
                let w = words(seed, Purpose::Placement, (column * LENGTH + row) as u32, *slot);
                unit(w[0], w[1]) < density / 7.0
            };
            grains.set_site(column, row, (0..7).filter(there).map(|slot| 1 << slot).sum());
        }
    }
    grains
}

/// Grains of every row.
fn rows(grains: &Grains) -> Vec<f64> {
    let row = |r: usize| (0..WIDTH + 2).map(|c| f64::from(grains.site(c, r).count_ones())).sum();
    (0..LENGTH).map(row).collect()
}

/// Power of a series at a frequency [rounds over its length].
fn power(series: &[f64], frequency: usize) -> f64 {
    let turn = |i: usize| TAU * (frequency * i) as f64 / series.len() as f64;
    let (re, im) =
        series.iter().enumerate().fold((0.0, 0.0), |(re, im), (i, x)| (re + x * turn(i).cos(), im + x * turn(i).sin()));
    re * re + im * im
}

/// How much more the density varies over the eight longest waves of the pipe than if every grain were on its own, in the mean of
/// steps 3000 to 6000.
fn waves(density: f64, dissipation: f64, roughness: f64, seed: u64) -> f64 {
    let mut grains = pipe(density, Habits { gravity: 0.1, dissipation, roughness }, seed);
    let (mut sum, mut looks) = (0.0, 0.0);
    while grains.steps() < 6000 {
        grains.step();
        if grains.steps() > 3000 && grains.steps().is_multiple_of(50) {
            let rows = rows(&grains);
            let total: f64 = rows.iter().sum();
            sum += (1..=8).map(|k| power(&rows, k) / total).sum::<f64>() / 8.0;
            looks += 1.0;
        }
    }
    sum / looks
}

/// At most that far from lone grains: no wave.
fn none(name: &str, value: f64) -> Claim {
    Claim::judge(name, value, Some(0.0), Some(3.0), SOURCE)
}

/// Waves come with dissipation and a density that is neither low nor high; what smooth walls do says [`pipe_smooth`].
pub(crate) fn pipe_waves(perturbation: f64) -> Judged {
    ensemble::drawn("pipe waves", 1..=5, |seed| {
        let wave = waves(0.25, perturbation.min(1.0).powi(20), 1.0, seed);
        let is = |name: &str, value: f64| Claim::judge(name, value, Some(8.0), None, SOURCE);
        let mut claims = vec![is("pipe: variance of the density over that of lone grains", wave)];
        let without = [
            ("pipe: the same without dissipation", waves(0.25, 0.0, 1.0, seed)),
            ("pipe: the same at density 0.1", waves(0.1, 1.0, 1.0, seed)),
            ("pipe: the same at density 1", waves(1.0, 1.0, 1.0, seed)),
        ];
        claims.extend(without.map(|(name, value)| none(name, value)));
        let gates = without.map(|(name, value)| is(name, value));
        claims.push(refused("a wave where there is none", &gates, 3));
        Ok(claims)
    })
}

/// The abstract says that waves need rough walls.
pub(crate) fn pipe_smooth(perturbation: f64) -> Judged {
    ensemble::drawn("pipe smooth", 1..=5, |seed| {
        let name = "pipe, smooth walls: variance of the density over that of lone grains";
        let rough = none(name, waves(0.25, perturbation.min(1.0).powi(20), 1.0, seed));
        Ok(vec![none(name, waves(0.25, 1.0, 0.0, seed)), refused("rough walls", &[rough], 1)])
    })
}

/// Without gravity and dissipation the grains are FHP-II, site by site.
#[expect(clippy::unnecessary_wraps, reason = "the type of all cases")]
pub(crate) fn pipe_limit(perturbation: f64) -> Judged {
    let differing = |dissipation: f64, thief: bool| {
        let mut grains = pipe(2.0, Habits { gravity: 0.0, dissipation, roughness: 1.0 }, 1);
        let mut gas = Gas::new(Rules::Two, WIDTH + 2, LENGTH, [true, true], 1);
        for row in 0..LENGTH {
            for column in 0..WIDTH + 2 {
                if column % (WIDTH + 1) == 0 {
                    gas.wall(column, row, None);
                } else {
                    gas.set_site(column, row, grains.site(column, row));
                }
            }
        }
        let before = grains.mass();
        for step in 0..200 {
            grains.step();
            gas.step();
            if thief && step == 100 {
                (0..LENGTH).for_each(|row| grains.set_site(WIDTH / 2, row, 0));
            }
        }
        let sites = (0..WIDTH + 2).flat_map(|c| (0..LENGTH).map(move |r| (c, r)));
        let differ = sites.filter(|(c, r)| grains.site(*c, *r) != gas.site(*c, *r)).count();
        (differ as f64, before.abs_diff(grains.mass()) as f64)
    };
    let (differ, _) = differing(1.0 - perturbation.min(1.0), false);
    let (wrong, lost) = differing(0.01, false);
    let keeps =
        |lost: f64| within("pipe: grains lost in 200 dissipating steps", lost, 0.0, 0.0, closed_form("conservation"));
    let name = "pipe without dissipation and gravity: sites that differ from FHP-II after 200 steps";
    Ok(vec![
        within(name, differ, 0.0, 0.0, closed_form("without loss it is FHP-II")),
        refused(
            "one collision in a hundred loses its energy",
            &[within(name, wrong, 0.0, 0.0, closed_form("without loss it is FHP-II"))],
            1,
        ),
        keeps(lost),
        refused("a column that is swept empty", &[keeps(differing(0.01, true).1)], 1),
    ])
}

/// Exponent of the power spectrum of the grains in sixteenths of the pipe, between periods of 25 and 1000 steps.
fn exponent(dissipation: f64, seed: u64) -> f64 {
    const LOOKS: usize = 16_384;
    const STRIDE: usize = 2;
    let mut grains = pipe(0.25, Habits { gravity: 0.1, dissipation, roughness: 1.0 }, seed);
    (0..3000).for_each(|_| grains.step());
    let mut series = vec![Vec::new(); 16];
    for look in 0..LOOKS {
        (0..STRIDE).for_each(|_| grains.step());
        let rows = rows(&grains);
        // A bell over the series keeps its ends from ringing.
        let bell = 0.5 - 0.5 * (TAU * look as f64 / LOOKS as f64).cos();
        let mean = rows.iter().sum::<f64>() / 32.0;
        for (part, series) in series.iter_mut().enumerate() {
            let inside: f64 = rows[32 * part..32 * part + 16].iter().sum();
            series.push(bell * (inside - mean));
        }
    }
    let (mut x, mut y) = (Vec::new(), Vec::new());
    let mut frequency = (LOOKS * STRIDE) as f64 / 1000.0;
    while frequency < (LOOKS * STRIDE) as f64 / 25.0 {
        let near = frequency as usize..frequency as usize + 6;
        let sum: f64 = near.flat_map(|f| series.iter().map(move |s| power(s, f))).sum();
        x.push(frequency.ln());
        y.push(sum.ln());
        frequency *= 1.3;
    }
    -slope(&x, &y)
}

/// The spectrum falls as a power near 4/3.
pub(crate) fn pipe_spectrum(perturbation: f64) -> Judged {
    ensemble::drawn("spectra", 1..=5, |seed| {
        let name = "pipe: exponent of the power spectrum of the density, periods of 25 to 1000 steps";
        let gate = |dissipation: f64| Claim::judge(name, exponent(dissipation, seed), Some(1.1), Some(1.5), SOURCE);
        Ok(vec![gate(perturbation.min(1.0).powi(20)), refused("no dissipation", &[gate(0.0)], 1)])
    })
}
