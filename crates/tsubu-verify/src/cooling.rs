//! A gas of inelastic grains that cools (V-30).

use crate::bench::Rig;
use crate::case::Judged;
use crate::ensemble;
use crate::origin::closed_form;
use std::f64::consts::PI;
use tsubu_frame::Claim;

/// Share of the volume (3-D) or area (2-D) that grains fill.
const FILLED: f64 = 0.1;

/// A periodic box of `count` grains of diameter 1 and mass 1 at temperature 1.
fn gas(dimension: u8, count: u32, restitution: f64, seed: u32, perturbation: f64) -> Result<Rig, String> {
    let space = dimension == 3;
    let density = if space { FILLED * 6.0 / PI } else { FILLED * 4.0 / PI };
    let half = 0.5 * (f64::from(count) / density).powf(1.0 / f64::from(dimension));
    let ends = |axis: &str| format!("periodic.{axis} = [{}, {half}]", -half);
    let periodic = if space { ["x", "y", "z"].map(ends).join("\n") } else { ["x", "z"].map(ends).join("\n") };
    let corner = |h: f64| if space { format!("[{h}, {h}, {h}]") } else { format!("[{h}, {h}]") };
    let text = format!(
        r#"
        title = "a cooling gas of grains"
        dimension = {dimension}
        seed = {seed}
        gravity = 0
        duration = 100
        speed-scale = 1
        {periodic}
        [materials.hard]
        young-modulus = 3e6
        restitution = {restitution}
        friction = 0
        [particles.gas]
        material = "hard"
        count = {count}
        diameter = 1
        mass = 1
        start.random = {{ speed = {speed}, region = {{ low = {low}, high = {high} }} }}
        [contact]
        tangential.none = {{}}
        rotation = false
        "#,
        speed = f64::from(dimension).sqrt(),
        low = corner(-half),
        high = corner(half),
    );
    Rig::new(&text, perturbation)
}

/// Mean kinetic energy a degree of freedom of the random motion, and for masses of 1 the temperature.
fn temperature(rig: &Rig, dimension: u8) -> f64 {
    let velocities = rig.vectors("velocity");
    let count = velocities.len() as f64;
    let mean = velocities.iter().sum::<glam::DVec3>() / count;
    velocities.iter().map(|v| (v - mean).length_squared()).sum::<f64>() / (f64::from(dimension) * (count - 1.0))
}

/// Collisions of a grain a second at temperature 1 (Carnahan and Starling, Henderson).
fn collisions(dimension: u8) -> f64 {
    if dimension == 3 {
        let n = FILLED * 6.0 / PI;
        4.0 * PI.sqrt() * n * (1.0 - 0.5 * FILLED) / (1.0 - FILLED).powi(3)
    } else {
        let n = FILLED * 4.0 / PI;
        2.0 * PI.sqrt() * n * (1.0 - 7.0 / 16.0 * FILLED) / (1.0 - FILLED).powi(2)
    }
}

/// Haff's time by the cooling of one gas.
fn time_of_haff(dimension: u8, count: u32, restitution: f64, seed: u32, perturbation: f64) -> Result<f64, String> {
    let mut rig = gas(dimension, count, restitution, seed, perturbation)?;
    // Five collisions make the equal speeds of the start Maxwell's.
    rig.until(5.0 / collisions(dimension))?;
    let (t, first) = (rig.engine.time(), temperature(&rig, dimension));
    rig.until(t + 1.5 * haffs(dimension, count, restitution))?;
    let cooled = (first / temperature(&rig, dimension)).sqrt() - 1.0;
    Ok((rig.engine.time() - t) * first.sqrt() / cooled)
}

/// Haff's time at temperature 1: of `count` grains each has `count` - 1 to meet, not `count`.
fn haffs(dimension: u8, count: u32, restitution: f64) -> f64 {
    let partners = f64::from(count - 1) / f64::from(count);
    2.0 * f64::from(dimension) / ((1.0 - restitution * restitution) * collisions(dimension) * partners)
}

/// Haff's times of a plane and a spatial gas. A gas is chaotic: means over seeds.
fn cooled(restitution: f64, perturbation: f64) -> Judged {
    let mut claims = Vec::new();
    for (dimension, count, seeds) in [(2, 50, 24), (3, 400, 6)] {
        let [times] = ensemble::members(&format!("{dimension}-D, restitution {restitution}"), 1..=seeds, |seed| {
            Ok([time_of_haff(dimension, count, restitution, u32::try_from(seed).unwrap_or(0), perturbation)?])
        })?;
        let name = format!("cooling gas, {dimension}-D, restitution {restitution}: Haff's time");
        let [low, high] = [0.95, 1.05].map(|share| Some(share * haffs(dimension, count, restitution)));
        claims.push(Claim::judge_ensemble(name, times, low, high, closed_form("Haff 1983")));
    }
    Ok(claims)
}

/// V-30: sqrt(T1/T2) - 1 grows as time over Haff's time, in boxes too small for clusters.
pub(super) fn haff(perturbation: f64) -> Judged {
    cooled(0.9, perturbation)
}

/// The same where a collision takes more: the gas cools 3 to 4 % more slowly than by molecular chaos, at a fifth of the step and a
/// hundred times the stiffness too. Neighbours come to move alike, and the box is near the size at which vortices grow.
pub(super) fn haff_inelastic(perturbation: f64) -> Judged {
    cooled(0.8, perturbation)
}
