//! Structures: loss factor by three ways, and the added mass of a bed that stays on the floor.

use super::bench;
use super::control::refused;
use crate::case::Judged;
use crate::origin::{closed_form, own};
use tsubu::interrupt::Interrupt;
use tsubu::study::response::{CaseResult, Point, bed, measure};
use tsubu::study::ring_down::ring_down;
use tsubu_frame::{Claim, State};
use tsubu_scene::plan::{Plan, Response, Signal};

const DAMPER: &str = include_str!("../../../scenes/damper.toml");

/// Mass, stiffness and damping of the structure in the damper scene.
const M: f64 = 0.086;
const C: f64 = 0.08;
const K: f64 = 123.4;

fn frequency() -> f64 {
    (K / M).sqrt() / std::f64::consts::TAU
}

pub(super) fn measured(plan: &Plan, wanted: &Response, bed: &State, frequency: f64) -> Result<Point, String> {
    let point = measure(plan, wanted, 0, bed, frequency, &[], &Interrupt::new()).map_err(|e| e.to_string())?;
    point.ok_or_else(|| "interrupted".to_owned())
}

/// The empty structure: half-power width, energy per cycle and ring-down give twice the damping ratio.
pub(super) fn loss_factor(perturbation: f64) -> Judged {
    let mut plan = bench::plan(DAMPER)?;
    set_count(&mut plan, 0);
    if let tsubu_scene::plan::Structure::Oscillator { damping, .. } = &mut structure(&mut plan)?.structure {
        *damping *= perturbation;
    }
    let expected = C / (K * M).sqrt();
    let wanted = plan.response.clone().ok_or("the damper scene has no response")?;
    let ratios: Vec<f64> = (0..=40).map(|i| 0.96 + 0.002 * f64::from(i)).collect();
    let mut points = Vec::new();
    let bed = bed(&plan, 0).map_err(|e| e.to_string())?;
    for ratio in ratios {
        points.push((ratio, measured(&plan, &wanted, &bed, ratio * frequency())?));
    }
    let points: Vec<(f64, &_)> = points.iter().map(|(ratio, p)| (*ratio, p)).collect();
    let case = CaseResult::new("empty", &plan, frequency(), &points);
    let half_power = case.peak.map_or(f64::NAN, |p| 2.0 * p.half_power_damping);
    let host = structure(&mut plan)?;
    host.base = None;
    host.displacement = 0.01;
    plan.duration = 4.0;
    let cycles = ring_down(&plan, 0.0).map_err(|e| e.to_string())?;
    // Energy falls by exp(-2 pi eta) a cycle.
    let decay = cycles.windows(2).map(|w| 2.0 * (w[0].amplitude / w[1].amplitude).ln() / std::f64::consts::TAU);
    let rung = decay.sum::<f64>() / (cycles.len() - 1) as f64;
    let source = closed_form("2 zeta = C / sqrt(K M)");
    let claim = |name: &str, value| {
        Claim::judge(
            format!("loss factor of the empty structure, {name}"),
            value,
            Some(0.98 * expected),
            Some(1.02 * expected),
            source,
        )
    };
    let peak = case.peak.map_or(f64::NAN, |p| p.rms * std::f64::consts::SQRT_2 / 0.5e-3);
    Ok(vec![
        claim("half-power width", half_power),
        claim("energy per cycle", case.loss_factor),
        claim("ring-down", rung),
        Claim::judge(
            "peak transmissibility of the empty structure",
            peak,
            Some(0.99 * 40.736),
            Some(1.01 * 40.736),
            closed_form("closed form"),
        ),
    ])
}

/// V-65 and: a bed that never leaves the floor rings with the structure at f0 / sqrt(1 + N m / M). The perturbation multiplies
/// the mass of the balls.
pub(super) fn added_mass(perturbation: f64) -> Judged {
    let mut claims = Vec::new();
    for count in [10usize, 30, 50] {
        let mut plan = bench::plan(DAMPER)?;
        set_count(&mut plan, count);
        for group in plan.particles.values_mut() {
            group.mass *= perturbation;
        }
        let mass = 0.2e-3 * count as f64;
        let sag = -mass * 10.0 / K;
        plan.dem.time_step = Some(1e-5);
        plan.duration = 2.0;
        let host = structure(&mut plan)?;
        host.base = None;
        host.displacement = sag + 1e-3;
        let cycles = ring_down(&plan, sag).map_err(|e| e.to_string())?;
        let period = cycles.iter().map(|c| c.period).sum::<f64>() / cycles.len() as f64;
        let ratio = 1.0 / (period * frequency());
        let limit = 1.0 / (1.0 + mass / M).sqrt();
        let source = closed_form("f / f0 = 1 / sqrt(1 + N m / M)");
        claims.push(Claim::judge(
            format!("frequency ratio with {count} balls at rest"),
            ratio,
            Some(limit - 1e-3),
            Some(limit + 1e-3),
            source,
        ));
    }
    Ok(claims)
}

/// With 30 balls that fly: the loss factor of a cycle of the ring-down is that of the driven structure at that amplitude.
pub(super) fn loss_factor_with_grains(_spoiler: f64) -> Judged {
    let mut plan = bench::plan(DAMPER)?;
    set_count(&mut plan, 30);
    plan.dem.time_step = Some(1e-5);
    let mut wanted = plan.response.clone().ok_or("the damper scene has no response")?;
    wanted.measure_periods = 20;
    let bed = bed(&plan, 0).map_err(|e| e.to_string())?;
    let peak = measured(&plan, &wanted, &bed, 0.9667 * frequency())?;
    let driven = peak.loss / (std::f64::consts::PI * K * peak.amplitude * peak.amplitude);
    let mass = 0.2e-3 * 30.0;
    let sag = -mass * 10.0 / K;
    let host = structure(&mut plan)?;
    host.base = None;
    host.displacement = sag + 1.15 * peak.amplitude;
    plan.duration = 1.5;
    let mut gate = |count: usize, seeds: std::ops::RangeInclusive<u64>| {
        set_count(&mut plan, count);
        let mut losses = Vec::new();
        for seed in seeds {
            plan.seed = seed;
            let cycles = ring_down(&plan, sag).map_err(|e| e.to_string())?;
            let near = |c: &&tsubu::study::ring_down::Cycle| (c.amplitude / peak.amplitude - 1.0).abs() < 0.1;
            losses.extend(
                cycles.iter().filter(near).map(|c| c.loss / (std::f64::consts::PI * K * c.amplitude * c.amplitude)),
            );
        }
        let rung = losses.iter().sum::<f64>() / losses.len() as f64;
        let source =
            own("two ways to one number: driven at the peak, and ringing down through the same amplitude").after();
        let name = "loss factor with 30 balls, ring-down over driven";
        Ok::<_, String>(Claim::judge(name, rung / driven, Some(0.8), Some(1.2), source))
    };
    let claim = gate(30, 1..=5)?;
    Ok(vec![claim, refused("half the balls while it rings down", &[gate(15, 1..=2)?], 1)])
}

fn set_count(plan: &mut Plan, count: usize) {
    for group in plan.particles.values_mut() {
        group.count = count;
    }
}

fn structure(plan: &mut Plan) -> Result<&mut tsubu_scene::plan::Host, String> {
    let host = plan.hosts.values_mut().next().ok_or("the damper scene has no host")?;
    debug_assert!(matches!(host.base, Some(Signal::Sine { .. }) | None), "the damper is shaken by a sine");
    Ok(host)
}
