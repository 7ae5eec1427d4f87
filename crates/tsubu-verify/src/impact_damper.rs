//! The single-ball impact damper (V-60).

use super::bench;
use super::control::refused;
use crate::case::Judged;
use crate::origin::closed_form;
use tsubu::engine;
use tsubu::ledger::Ledger;
use tsubu::methods;
use tsubu::partner::Hosts;
use tsubu_frame::Claim;

const SCENE: &str = include_str!("../../../scenes/impact-damper.toml");

/// Two symmetric impacts a cycle: peak, root mean square and number of impacts of the last twenty periods.
pub(super) fn symmetric(perturbation: f64) -> Judged {
    let mut claims = driven(SCENE, 40.0, perturbation)?.to_vec();
    let long = driven(&SCENE.replace("46 mm", "126 mm"), 15.0, perturbation)?;
    claims.push(refused("three times the clearance", &long, 3));
    Ok(claims)
}

/// Gates on the last twenty periods of a run of the scene for some time [s].
fn driven(scene: &str, duration: f64, perturbation: f64) -> Result<[Claim; 3], String> {
    let mut plan = bench::plan(scene)?;
    bench::spoil(&mut plan, perturbation);
    // The closed form knows no contact time: 50 GPa brings it to 0.03 % of a period.
    for material in plan.materials.values_mut() {
        material.young_modulus *= 100.0;
    }
    plan.duration = duration;
    let mut hosts = Hosts::new(&plan.hosts);
    let mut engine = methods::open(&plan, &hosts).map_err(|e| e.to_string())?;
    let mut ledger = Ledger::open(engine::energies(&*engine, &hosts), engine.momentum());
    let period = 1.0 / hosts.list[0].natural_frequencies().first().copied().unwrap_or(f64::NAN);
    let periods = 20.0;
    let steps = |time: f64| (time / engine.time_step()).round() as u64;
    let (settle, measure) = (steps(plan.duration - periods * period), steps(periods * period));
    engine.advance(settle, &mut hosts, &mut ledger).map_err(|e| e.to_string())?;
    let (mut peak, mut squares, mut impacts, mut touching): (f64, f64, f64, bool) = (0.0, 0.0, 0.0, false);
    for _ in 0..measure {
        engine.advance(1, &mut hosts, &mut ledger).map_err(|e| e.to_string())?;
        let x = hosts.list[0].displacement();
        peak = peak.max(x.abs());
        squares += x * x;
        let touches = engine.contacts() > 0;
        impacts += f64::from(u8::from(touches && !touching));
        touching = touches;
    }
    let rms = (squares / measure as f64).sqrt();
    let source = closed_form("closed form of two symmetric impacts per cycle, after Masri and Caughey");
    let near = |value: f64, share: f64| (Some(value * (1.0 - share)), Some(value * (1.0 + share)));
    let ((a, b), (c, d)) = (near(4.08361e-3, 0.005), near(2.86894e-3, 0.005));
    Ok([
        Claim::judge("impact damper: peak m", peak, a, b, source),
        Claim::judge("impact damper: rms m", rms, c, d, source),
        Claim::judge("impact damper: impacts per cycle", impacts / periods, Some(2.0), Some(2.0), source),
    ])
}
