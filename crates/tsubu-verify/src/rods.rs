//! A gas of smooth rods: how its energy is shared, and how it cools.

use crate::bench::Rig;
use crate::case::Judged;
use crate::control::refused;
use crate::ensemble;
use crate::origin::closed_form;
use tsubu_frame::{Claim, Ensemble};

/// Rods in the box.
const COUNT: u32 = 400;

/// Rods in a unit of volume; each is twice as long as thick, so they fill a twelfth of it. A rod is hit about once in a unit of time.
const DENSITY: f64 = 0.06;

/// When the gas has forgotten how it began.
const MIXED: f64 = 15.0;

/// Rods of three spheres, mass 1, thickness 1, in a periodic box; they fly at temperature 1 and do not turn yet.
fn gas(restitution: f64, seed: u64) -> Result<Rig, String> {
    let half = 0.5 * (f64::from(COUNT) / DENSITY).cbrt();
    let text = format!(
        r#"
        title = "a gas of rods"
        dimension = 3
        seed = {seed}
        gravity = 0
        duration = 1000
        speed-scale = 1
        periodic.x = [-{half}, {half}]
        periodic.y = [-{half}, {half}]
        periodic.z = [-{half}, {half}]
        [materials.hard]
        young-modulus = 1e5
        restitution = {restitution}
        friction = 0
        [particles.rods]
        material = "hard"
        count = {COUNT}
        diameter = 2
        mass = 1
        shape.clump = {{ centre = [[-0.5, 0, 0], [0, 0, 0], [0.5, 0, 0]], diameter = [1, 1, 1] }}
        start.random = {{ speed = {speed}, region = {{ low = [-{half}, -{half}, -{half}], high = [{half}, {half}, {half}] }} }}
        [contact]
        tangential.none = {{}}
        "#,
        speed = 3f64.sqrt(),
    );
    Rig::new(&text, 1.0)
}

/// Energy of a degree of freedom: of the three of moving, and of the two of turning that a smooth rod has.
fn temperatures(rig: &Rig) -> [f64; 2] {
    let (energies, count) = (rig.engine.grain_energies(), f64::from(COUNT));
    let drift: f64 = rig.engine.momentum().iter().map(|p| p * p).sum::<f64>() / (2.0 * count);
    [2.0 * (energies.kinetic - drift) / (3.0 * (count - 1.0)), 2.0 * energies.rotational / (2.0 * count)]
}

/// The temperature of turning over that of moving, in the mean over a while from a time on.
fn shares(from: f64) -> Result<Ensemble, String> {
    let [shares] = ensemble::members(&format!("rods without loss from {from}"), 1..=6, |seed| {
        let mut rig = gas(1.0, seed)?;
        let mut sum = 0.0;
        for look in 0..20 {
            rig.until(from * (1.0 + 0.2 * f64::from(look)))?;
            let [moving, turning] = temperatures(&rig);
            sum += turning / moving;
        }
        Ok([sum / 20.0])
    })?;
    Ok(shares)
}

fn equal(shares: Ensemble) -> Claim {
    let source = closed_form("equipartition: each degree of freedom has as much");
    let name = "rods without loss: temperature of turning over that of moving";
    Claim::judge_ensemble(name, shares, Some(0.97), Some(1.03), source)
}

/// How much T to a negative power grows in a second stretch of time over the first: 1 by Haff's law for the power 1/2.
fn growth(temperatures: [f64; 3], power: f64) -> f64 {
    let [first, middle, last] = temperatures.map(|t| t.powf(-power));
    (last - middle) / (middle - first)
}

fn haff(growths: Ensemble) -> Claim {
    let source = closed_form(
        "Haff 1983, found for rods by Rubio-Largo and others 2016: one over the root of the temperature grows evenly",
    );
    let name = "rods that lose: growth of one over the root of the temperature, second stretch over first";
    Claim::judge_ensemble(name, growths, Some(0.9), Some(1.1), source)
}

/// Without loss moving and turning share evenly; with loss both cool by Haff's law.
pub(super) fn cool(_: f64) -> Judged {
    let mut claims = vec![equal(shares(MIXED)?)];
    let cooled = ensemble::members("rods of restitution 0.9", 1..=6, |seed| {
        let mut rig = gas(0.9, seed)?;
        let mut seen = [0.0; 3];
        for (seen, time) in seen.iter_mut().zip([MIXED, 4.0 * MIXED, 7.0 * MIXED]) {
            rig.until(time)?;
            let [moving, turning] = temperatures(&rig);
            *seen = (3.0 * moving + 2.0 * turning) / 5.0;
        }
        Ok([growth(seen, 0.5), growth(seen, 1.0)])
    })?;
    let [even, inverse] = cooled;
    claims.push(haff(even));
    claims.push(refused("rods that few have hit yet", &[equal(shares(0.05)?)], 1));
    claims.push(refused("a temperature that falls as one over the time", &[haff(inverse)], 1));
    Ok(claims)
}
