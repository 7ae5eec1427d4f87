//! viscosity of the lattice gases from the decay of shear waves, in a gas that forgets whom it met and in the gas as it is.

use super::super::bench::near;
use super::super::control::{refused, refused_number};
use super::super::ensemble;
use super::fhp::{ALL, FRISCH, formula, slope};
use crate::case::Judged;
use crate::origin::{other_program, own};
use std::f64::consts::TAU;
use std::ops::RangeInclusive;
use tsubu::lattice::direction::Direction;
use tsubu::lattice::gas::collide::{REST, Rules};
use tsubu::lattice::gas::planes::{Gas, momentum};
use tsubu::lattice::grid::COLUMN_SPACING;
use tsubu_frame::{Claim, Ensemble, Source};

/// A shear wave that decays in a gas.
#[derive(Clone, Copy, Debug)]
struct Wave {
    rules: Rules,
    /// Mean occupation.
    density: f64,
    /// Its length, and that of its crests.
    columns: usize,
    rows: usize,
    /// Of the occupations, in shares of their mean.
    amplitude: f64,
    /// Whether particles forget after every step whom they met.
    forgetful: bool,
    seed: u64,
}

impl Wave {
    /// A weak one, of so many columns, with crests of so many rows.
    const fn new(rules: Rules, density: f64, [columns, rows]: [usize; 2]) -> Self {
        Self { rules, density, columns, rows, amplitude: 0.05, forgetful: false, seed: 1 }
    }

    /// Viscosity over the formula.
    fn viscosity(&self) -> f64 {
        let Self { rules, density, columns, rows, .. } = *self;
        let k = TAU / (columns as f64 * COLUMN_SPACING);
        let wave: Vec<f64> = (0..columns).map(|c| (TAU * c as f64 / columns as f64).cos()).collect();
        let up = |slot: usize| if slot == REST { 0.0 } else { Direction::from_index(slot).k() as f64 };
        let mut gas = Gas::new(rules, columns, rows, [true, true], self.seed);
        gas.scatter(|column, _, slot| density * (1.0 + self.amplitude * up(slot) * wave[column]));
        let expected = formula(rules, density) * k * k;
        // The stress needs some steps to follow the flow.
        let (begin, end) = ((0.15 / expected).max(30.0) as u64, (0.9 / expected) as u64);
        let (mut times, mut logs) = (Vec::new(), Vec::new());
        while gas.steps() < end {
            if self.forgetful {
                gas.step();
                gas.forget();
            } else {
                gas.steps_on((8 - gas.steps() % 8).min(end - gas.steps()));
            }
            if gas.steps() >= begin && gas.steps().is_multiple_of(8) {
                let amplitude: f64 = (0..columns).map(|c| momentum(&gas.counts(c)).k as f64 * wave[c]).sum();
                times.push(gas.steps() as f64);
                logs.push(amplitude.ln());
            }
        }
        -slope(&times, &logs) / expected
    }
}

/// Viscosity from shear waves, in a gas that forgets whom it met and in the gas as it is.
#[expect(clippy::unnecessary_wraps, reason = "the type of all cases")]
pub(crate) fn viscosity(perturbation: f64) -> Judged {
    let (mut claims, mut gates) = (Vec::new(), Vec::new());
    let wave = Wave { amplitude: 0.2, forgetful: true, ..Wave::new(Rules::One, 0.15 * perturbation, [192, 32_768]) };
    // At d = 0.15 the closed forms of all three are steep, and a wrong density is seen.
    for (rules, name) in ALL {
        // Short waves see that particles fly some spacings before they meet, most of all in FHP-I.
        let columns = if rules == Rules::One { 192 } else { 96 };
        let value = Wave { rules, columns, ..wave }.viscosity() * formula(rules, wave.density);
        let text = format!("{name}: viscosity of a shear wave without correlations, d = 0.15");
        claims.push(near(text, value, formula(rules, 0.15), 0.03, FRISCH));
        gates.push(near(name, value, formula(other(rules), 0.15), 0.03, FRISCH));
        gates.push(near(name, value, formula(rules, 0.15 * 0.9), 0.03, FRISCH));
    }
    claims.push(refused_number("viscosity of another form, or of a gas 10 % thinner", &gates, 6));
    for (rules, name, d, columns) in [(Rules::One, "FHP-I", 0.35, 64), (Rules::Three, "FHP-III", 0.5, 32)] {
        let wave = Wave { amplitude: 0.2, ..Wave::new(rules, d * perturbation, [columns, 65_536]) };
        let gate = |over: f64| {
            let text = format!("{name}: viscosity of a shear wave over the formula, d = {d}, {columns} columns");
            near(text, over, 1.0, 0.03, FRISCH)
        };
        claims.push(gate(wave.viscosity()));
        // The same collisions but for those of a particle at rest and a mover, or of three that meet.
        let wrong = Wave { rules: Rules::Two, rows: 16_384, ..wave };
        let over = wrong.viscosity() * formula(Rules::Two, wave.density) / formula(rules, d);
        claims.push(refused(&format!("the collisions of FHP-II for those of {name}"), &[gate(over)], 1));
    }
    Ok(claims)
}

/// A form of another viscosity.
fn other(rules: Rules) -> Rules {
    if rules == Rules::Two { Rules::Three } else { Rules::Two }
}

/// Draws of a gas.
const SEEDS: RangeInclusive<u64> = 1..=16;

/// The same where the gas as it is is not the formula: FHP-II and III away from half filling. Particles that have met meet
/// again, the more so the larger the box; where they forget each other the formula holds.
pub(crate) fn viscosity_plain(perturbation: f64) -> Judged {
    let mut claims = Vec::new();
    // What the other program gives for 64 columns at this amplitude, within 0.01.
    for (rules, name, d, elsewhere) in [(Rules::Two, "FHP-II", 0.25, 1.12), (Rules::Three, "FHP-III", 0.3, 1.16)] {
        let waves = |forgetful: bool| {
            let kind = if forgetful { "without correlations" } else { "as it is" };
            ensemble::members(&format!("{name}, {kind}"), SEEDS, |seed| {
                let of = |columns: usize| {
                    // Sites enough for an interval within the range; the longest waves take their time.
                    let rows = match columns {
                        _ if forgetful => 262_144,
                        128 => 32_768,
                        _ => 65_536,
                    };
                    let wave = Wave::new(rules, d * perturbation, [columns, rows]);
                    Wave { forgetful, seed, ..wave }.viscosity() * formula(rules, wave.density) / formula(rules, d)
                };
                let (short, middle) = (of(32), of(64));
                let long = if forgetful { middle } else { of(128) };
                Ok([middle, long - short])
            })
        };
        let gate = |what: &str, found: &Ensemble, low: Option<f64>, high: Option<f64>, source: Source<'_>| {
            let name = format!("{name}, d = {d}: {what}");
            Claim::judge_ensemble(name, found.clone(), low, high, source)
        };
        let forgets = |found: &Ensemble| {
            gate("viscosity over the formula, 64 columns, without correlations", found, Some(0.99), Some(1.01), FRISCH)
        };
        let remembers = |[middle, gain]: &[Ensemble; 2]| {
            let program = other_program("another program of the same rules");
            let grows = own("it is correlation: viscosity grows with the box (Kadanoff, McNamara and Zanetti 1989)");
            [
                gate(
                    "viscosity over the formula, 64 columns",
                    middle,
                    Some(elsewhere - 0.02),
                    Some(elsewhere + 0.02),
                    program,
                ),
                gate("viscosity gained from 32 to 128 columns, over the formula", gain, Some(0.0), None, grows),
            ]
        };
        let (plain, chaos) = (waves(false)?, waves(true)?);
        claims.push(forgets(&chaos[0]));
        claims.push(gate(
            "viscosity of the gas as it is over the formula, 64 columns",
            &plain[0],
            Some(0.97),
            Some(1.03),
            FRISCH,
        ));
        claims.extend(remembers(&plain));
        claims.push(refused(
            &format!("{name} that remembers, by the gate of one that forgets"),
            &[forgets(&plain[0])],
            1,
        ));
        claims.push(refused(
            &format!("{name} that forgets, by the gates of one that remembers"),
            &remembers(&chaos),
            2,
        ));
    }
    Ok(claims)
}
