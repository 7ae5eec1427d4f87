//! A-F9, A-F10: the box moved by hand; when the bed leaves the floor and when it comes back.

use crate::engine;
use crate::ledger::Ledger;
use crate::partner::Hosts;
use tsubu_frame::Claim;
use tsubu_scene::Scene;

const SCENE: &str = include_str!("../../../../../../studies/damper-2003/fig9-shaken.toml");
const BINS: usize = 60;

/// Vertical force of the box on the bed over its weight, against the phase of the box, mean of ten periods.
fn force_by_phase(method: &str, count: usize) -> Result<[f64; BINS], String> {
    let changes = [format!("method={method}"), format!("particles.balls.count={count}")];
    let scene = Scene::parse("study scene", SCENE, std::path::Path::new("."), &changes).map_err(|c| c.to_string())?;
    let plan = scene.plan();
    let mut hosts = Hosts::new(&plan.hosts);
    let mut engine = engine::open(plan, &hosts).map_err(|e| e.to_string())?;
    let mut ledger = Ledger::open(engine::stocks(&*engine, &hosts), engine.momentum());
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

/// Phase at the middle of the push, weighted by the force: where the bed as a whole is thrown.
fn push_phase(force: &[f64; BINS]) -> f64 {
    let (mut sin, mut cos) = (0.0, 0.0);
    for (bin, f) in force.iter().enumerate() {
        let angle = std::f64::consts::TAU * (bin as f64 + 0.5) / BINS as f64;
        sin += f * angle.sin();
        cos += f * angle.cos();
    }
    sin.atan2(cos) / std::f64::consts::TAU
}

/// A-F9/F10. A fully inelastic lump on this floor lands and leaves at phase 0.071 of the period and touches the floor only
/// briefly; a bed of balls spreads that in time.
pub(in crate::study::verify) fn figure_9(_spoiler: f64) -> Result<Vec<Claim>, String> {
    let mut claims = Vec::new();
    for method in ["dem", "lattice"] {
        for count in [20, 40] {
            let force = force_by_phase(method, count)?;
            let (landing, lift_off, flight) = events(&force);
            let name = format!("shaken box, {method}, {count} balls");
            let lump = "an inelastic lump lands and leaves at phase 0.071 (A-6.4)";
            let push = push_phase(&force);
            claims.push(Claim::judge(format!("{name}: phase of the push"), push, Some(0.0), Some(0.142), lump));
            let order = "figures 9 and 10: pushed up, separates in mid-air, re-forms on the floor";
            claims.push(Claim::judge(
                format!("{name}: lift-off after landing"),
                lift_off - landing,
                Some(0.0),
                Some(0.5),
                order,
            ));
            claims.push(Claim::judge(format!("{name}: phase of lift-off"), lift_off, Some(0.0), Some(0.25), order));
            claims.push(Claim::judge(
                format!("{name}: share of the period in the air"),
                flight,
                Some(0.5),
                Some(1.0),
                order,
            ));
        }
    }
    Ok(claims)
}
