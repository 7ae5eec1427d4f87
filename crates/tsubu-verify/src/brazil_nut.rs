//! Segregation under vertical shaking (V-38).

use super::beds::{law, mean, sampled};
use super::bench::{Rig, within};
use super::control::refused;
use super::ensemble;
use crate::case::Judged;
use crate::origin::own;
use tsubu_frame::Claim;

/// Acceleration of the shaken box over gravity, at an amplitude of one diameter.
const SHAKEN: f64 = 2.9;
/// Shakes until the bed is looked at, and until the end.
const SHAKES: [f64; 2] = [90.0, 150.0];
/// Grains that the control follows: those that the lowest row has at the start.
const LOWEST: usize = 19;

/// A box of 20 diameters, shaken as a whole, so that its walls drag the bed into rolls; one grain of its own size begins in the
/// middle at a height, on the floor as a rule.
fn bed(size: f64, height: f64, seed: u64, perturbation: f64) -> Result<Rig, String> {
    let text = format!(
        r#"
        title = "one large grain in a shaken bed"
        seed = {seed}
        gravity = 1
        duration = 2000
        {law}
        [particles.a-single]
        material = "grain"
        diameter = {size}
        mass = {mass}
        start.at.position = [[0, {height}]]
        [particles.b-bed]
        material = "grain"
        count = 320
        size.uniform = {{ smallest = 0.85, largest = 1.15 }}
        mass = 1
        start.random.region = {{ low = [-10, {above}], high = [10, 36] }}
        [walls.box]
        material = "grain"
        shape.box = {{ width = 20, height = 50 }}
        motion.signal.sine = {{ amplitude = 1, frequency = {frequency} }}
        "#,
        // The mass of a disc of the bed's density; all are spheres held in the plane.
        mass = size * size,
        above = size + 0.04,
        frequency = 1.0 / period(),
        law = law(5e3, 0.5, 0.6),
    );
    Rig::new(&text, perturbation)
}

/// Height of the centre of a grain on the floor.
fn on_floor(size: f64) -> f64 {
    0.5 * size + 0.02
}

/// Of a shake, in sqrt(d/g).
fn period() -> f64 {
    std::f64::consts::TAU / SHAKEN.sqrt()
}

/// Of every grain.
fn all_heights(rig: &Rig) -> Vec<f64> {
    rig.vectors("position").iter().map(|p| p.z).collect()
}

/// Mean height of grains over that of all: at the start, and in the mean over the looks.
fn heights(
    size: f64,
    seed: u64,
    perturbation: f64,
    followed: impl Fn(&[f64]) -> Vec<usize>,
) -> Result<[f64; 2], String> {
    let mut rig = bed(size, on_floor(size), seed, perturbation)?;
    let start = all_heights(&rig);
    let grains = followed(&start);
    let over = |z: &[f64]| grains.iter().map(|&i| z[i]).sum::<f64>() / grains.len() as f64 / mean(z).0;
    let looks = sampled(&mut rig, [SHAKES[0] * period(), SHAKES[1] * period(), 0.25 * period()], |rig| {
        over(&all_heights(rig))
    })?;
    Ok([over(&start), mean(&looks).0])
}

/// The gates, for a large grain and for what must fail them.
fn rises(what: &str, [start, end]: [f64; 2]) -> [Claim; 2] {
    let source = own("Rosato et al. 1987, Knight et al. 1993: large grains rise and stay on top").after();
    // A grain that goes everywhere alike is at 1 on average; one on top of the bed at nearly 2.
    [
        Claim::judge(format!("{what}: height over the bed's mean at the start"), start, None, Some(0.4), source),
        Claim::judge(format!("{what}: the same after 90 shakes"), end, Some(1.25), None, source),
    ]
}

/// V-38: a grain of four diameters comes up from the floor and stays on top; grains of the bed's own size go everywhere.
pub(super) fn brazil_nut(perturbation: f64) -> Judged {
    ensemble::drawn("shaken beds", 1..=5, |seed| {
        let found = heights(4.0, seed, perturbation, |_| vec![0])?;
        let mut claims = rises("shaken bed, a grain of 4 diameters", found).to_vec();
        let lowest = |z: &[f64]| {
            let mut order: Vec<usize> = (0..z.len()).collect();
            order.sort_by(|&a, &b| z[a].total_cmp(&z[b]));
            order.truncate(LOWEST);
            order
        };
        let control = heights(1.0, seed, perturbation, lowest)?;
        let source = own("grains of equal size have no reason to rise").after();
        let name = "shaken bed, the 19 lowest of equal grains: height over the bed's mean after 90 shakes";
        claims.push(within(name, control[1], 1.0, 0.25, source));
        claims.push(refused("a grain of 4 diameters for equal ones", &[within(name, found[1], 1.0, 0.25, source)], 1));
        let on_top = all_heights(&bed(4.0, 40.0, seed, perturbation)?);
        let above = rises("", [on_top[0] / mean(&on_top).0, f64::NAN]);
        claims.push(refused("the grain above the bed at the start", &above[..1], 1));
        claims.push(refused("the grain no larger than the others", &rises("", control)[1..], 1));
        Ok(claims)
    })
}
