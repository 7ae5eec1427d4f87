//! A-F9, A-F10: the box moved by hand; when the bed leaves the floor and when it comes back.

use crate::case::Judged;
use crate::control::refused;
use crate::ensemble;
use crate::origin::{closed_form, own};
use std::ops::RangeInclusive;
use tsubu::engine;
use tsubu::ledger::Ledger;
use tsubu::methods;
use tsubu::partner::Hosts;
use tsubu_frame::{Claim, Ensemble, Source};
use tsubu_scene::Scene;

const SCENE: &str = include_str!("../../../../studies/damper-2003/fig9-shaken.toml");
const BINS: usize = 60;
/// Fillings of the box.
const SEEDS: RangeInclusive<u64> = 1..=12;

/// The floor never falls faster than the balls.
const GENTLE: [&str; 1] = ["walls.box.motion.signal.sine.amplitude=5.5 mm"];

/// Neither friction nor loss; such balls never settle.
const ELASTIC: [&str; 5] = [
    "particles.balls.start={ rows = {} }",
    "materials.acrylic.restitution=1",
    "materials.casing.restitution=1",
    "materials.acrylic.friction=0",
    "materials.casing.friction=0",
];

/// Vertical force of the box on the bed over its weight, against the phase of the box, mean of ten periods.
fn force_by_phase(method: &str, count: usize, seed: u64, changes: &[&str]) -> Result<[f64; BINS], String> {
    let mut changes: Vec<String> = changes.iter().map(|&change| change.to_owned()).collect();
    changes.extend([format!("method={method}"), format!("particles.balls.count={count}"), format!("seed={seed}")]);
    let scene = Scene::parse("study scene", SCENE, std::path::Path::new("."), &changes).map_err(|c| c.to_string())?;
    let plan = scene.plan();
    let mut hosts = Hosts::new(&plan.hosts);
    let mut engine = methods::open(plan, &hosts).map_err(|e| e.to_string())?;
    let mut ledger = Ledger::open(engine::energies(&*engine, &hosts), engine.momentum());
    let period = 1.0 / 6.0;
    let weight = 0.2e-3 * count as f64 * 10.0;
    let mut impulse = [0.0; BINS];
    let advance = |time: f64| (time / engine.time_step()).round() as u64;
    let (begin, periods) = (advance(2.0 * period), 10);
    engine.advance(begin, &mut hosts, &mut ledger).map_err(|e| e.to_string())?;
    let mut before = ledger.wall_impulse[2];
    for bin in 0..periods * BINS {
        let target = ((2.0 + (bin + 1) as f64 / BINS as f64) * period / engine.time_step()).round() as u64;
        engine.advance(target - engine.steps(), &mut hosts, &mut ledger).map_err(|e| e.to_string())?;
        impulse[bin % BINS] += ledger.wall_impulse[2] - before;
        before = ledger.wall_impulse[2];
    }
    Ok(impulse.map(|j| j / f64::from(periods as u32) / (weight * period / BINS as f64)))
}

/// Phases (of a period) at which the force rises above and falls below the bed's weight around its largest pulse, and the
/// share of the period with less than a tenth of the weight.
fn events(force: &[f64; BINS]) -> (f64, f64, f64) {
    let top = (0..BINS).max_by(|&a, &b| force[a].total_cmp(&force[b])).unwrap_or(0);
    let back = (0..BINS).find(|k| force[(top + BINS - k) % BINS] < 1.0).unwrap_or(0);
    let ahead = (0..BINS).find(|k| force[(top + k) % BINS] < 0.1).unwrap_or(0);
    let phase = |k: usize| {
        let p = (k % BINS) as f64 / BINS as f64;
        if p > 0.5 { p - 1.0 } else { p }
    };
    let flight = force.iter().filter(|f| **f < 0.1).count() as f64 / BINS as f64;
    (phase(top + BINS - back + 1), phase(top + ahead), flight)
}

/// A-F9/F10. The floor falls away faster than gravity from phase asin(1 / Gamma) / 2 pi = 0.046 on: no bed leaves earlier.
/// A fully inelastic lump lands and leaves at 0.071; a bed lands no later, its loose balls earlier. It touches the
/// floor for less than half of the period.
pub(crate) fn figure_9(_spoiler: f64) -> Judged {
    let mut claims = Vec::new();
    for method in ["dem", "lattice"] {
        for count in [20, 40] {
            claims.extend(gates(method, method, count, &[])?);
        }
    }
    for method in ["dem", "lattice"] {
        let gentle = gates(method, method, 20, &GENTLE)?;
        claims.push(refused(&format!("a box shaken with 0.8 of gravity, by {method}"), &gentle, 3));
    }
    let elastic = gates("dem", "dem", 40, &ELASTIC)?;
    claims.push(refused("balls without friction that lose nothing", &elastic, 1));
    Ok(claims)
}

/// The same of balls of 19 cells, made so by changes of the scene.
pub(super) fn hexagons(changes: &[&str]) -> Judged {
    let balls = "balls of 19 cells";
    let mut claims = Vec::new();
    for count in [20, 40] {
        claims.extend(gates("lattice", balls, count, changes)?);
    }
    let gentle = gates("lattice", balls, 20, &[changes, &GENTLE].concat())?;
    claims.push(refused("balls of 19 cells shaken with 0.8 of gravity", &gentle, 3));
    let elastic = gates("lattice", balls, 40, &[changes, &ELASTIC].concat())?;
    claims.push(refused("balls of 19 cells without friction that lose nothing", &elastic, 2));
    Ok(claims)
}

/// What is claimed of a bed of such balls, by the mean over [`SEEDS`] fillings.
fn gates(method: &str, balls: &str, count: usize, changes: &[&str]) -> Judged {
    let [landing, lift_off, flight] =
        ensemble::members(&format!("{method}, {count} balls {changes:?}"), SEEDS, |seed| {
            let (landing, lift_off, flight) = events(&force_by_phase(method, count, seed, changes)?);
            Ok([landing, lift_off, flight])
        })?;
    // The phases come in steps of 1/60.
    let lump = closed_form("no later than an inelastic lump");
    let gravity = closed_form("floor acceleration below -g");
    let air = own("figures 9 and 10: separates in mid-air").after();
    let claim = |what: &str, found: Ensemble, low: f64, high: f64, source: Source<'_>| {
        let name = format!("shaken box, {balls}, {count} balls: {what}");
        Claim::judge_ensemble(name, found, Some(low), Some(high), source)
    };
    Ok(vec![
        claim("phase of landing", landing, -0.25, 0.071 + 0.017, lump).beside(0.071),
        claim("phase of lift-off", lift_off, 0.046 - 0.017, 0.25, gravity).beside(0.046),
        claim("share of the period in the air", flight, 0.5, 1.0, air),
    ])
}
