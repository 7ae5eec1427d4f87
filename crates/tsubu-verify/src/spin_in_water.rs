//! A grain that spins in water (V-54).

use super::bench::{Rig, near};
use super::control::{refused, refused_number};
use super::water::quartz;
use crate::case::Judged;
use crate::origin::{closed_form, printed};
use std::f64::consts::{LN_10, PI};

/// Of the grain, 2 mm of quartz, and of water.
const R: f64 = 1e-3;
const SIGMA: f64 = 2650.0;
const RHO: f64 = 1000.0;
const NU: f64 = 1e-6;
/// Spin at the begin [rad/s].
const SPIN: f64 = 900.0;
/// Time scale of Stokes's torque, sigma r^2/(15 mu) [s].
const STOKES: f64 = SIGMA * R * R / (15.0 * RHO * NU);

/// Spin about y that is left after about `seconds` of one that begins at `spin`, and how many seconds it was.
fn left(spin: f64, water: &str, seconds: f64, perturbation: f64) -> Result<(f64, f64), String> {
    let start = format!("position = [[0, 0, 0]], spin = [[0, {spin}, 0]]");
    let text = quartz(2.0 * R, "stokes-newton = {}", water)
        .replace("position = [[0, 0, 0]]", &start)
        .replace("dimension = 3", "dimension = 3\ngravity = 0");
    let mut rig = Rig::new(&text, perturbation)?;
    rig.until(seconds)?;
    Ok((rig.vector("spin", 0).y, rig.engine.time()))
}

/// Of I w' = - b w - a w^(3/2), which the law for all spins is above Re = 32, begun at `SPIN`: the spin after a time. The
/// Reynolds number is w `square`/nu.
fn decayed(seconds: f64, square: f64) -> f64 {
    let inertia = 8.0 / 15.0 * PI * SIGMA * R.powi(5);
    let strength = 0.5 * RHO * R.powi(5) / inertia;
    let (b, a) = (strength * 128.4 * NU / square, strength * 12.9 * (NU / square).sqrt());
    let growth = (0.5 * b * seconds).exp();
    ((1.0 / SPIN.sqrt() + a / b) * growth - a / b).powi(-2)
}

/// V-54: spins die away as the torque of the water says, and end at half the shear rate of a stream.
pub(super) fn spin(perturbation: f64) -> Judged {
    let (slow, passed) = left(SPIN, "torque.stokes = {}", STOKES, perturbation)?;
    let time = passed / (SPIN / slow).ln();
    let gate = |wanted: f64| {
        near(
            "2 mm of quartz spins down by Stokes's torque: time scale [s]",
            time,
            wanted,
            1e-3,
            closed_form("sigma r^2/(15 mu)"),
        )
    };
    // The inertia of a disc is 5/4 of that of a sphere.
    let mut claims = vec![gate(STOKES), refused_number("the inertia of a disc", &[gate(1.25 * STOKES)], 1)];

    for seconds in [1e-3, 0.02, 0.1] {
        let (found, passed) = left(SPIN, "torque.finite-reynolds = {}", seconds, perturbation)?;
        let gate = |square: f64| {
            let name = format!("the same from 900 rad/s by the law for all spins, {seconds} s: spin left [rad/s]");
            near(name, found, decayed(passed, square), 1e-3, printed("Dennis, Singh and Ingham 1980"))
        };
        claims.push(gate(4.0 * R * R));
        claims.push(refused_number("the radius for the diameter in the Reynolds number", &[gate(R * R)], 1));
    }

    // Held in the stream by its own fall is no grain: it rests at z = 0, without weight, and drifts along x only.
    let stream = |shear_velocity: f64| {
        let flow = format!("shear-velocity = {shear_velocity}, roughness = 2e-3, zero-level = -4e-3");
        let water = format!("torque.stokes = {{}}\nflow.log-law = {{ {flow} }}");
        Ok::<_, String>(left(0.0, &water, 10.0 * STOKES, perturbation)?.0)
    };
    let shear = 0.1 * 5.75 / LN_10 / 4e-3;
    let gate = |end: f64, rate: f64| {
        near(
            "drifting in a log-law stream: spin in the end [rad/s]",
            end,
            rate,
            1e-3,
            closed_form("half the shear rate"),
        )
    };
    let end = stream(0.1)?;
    claims.push(gate(end, 0.5 * shear));
    claims.push(refused("a stream 5 % faster", &[gate(stream(0.105)?, 0.5 * shear)], 1));
    claims.push(refused_number("the shear rate, not half of it", &[gate(end, shear)], 1));
    Ok(claims)
}
