//! A measured particle damper: the mass that a vibrated box seems to carry, and the loss factor of its beads (Masmoudi et al. 2016, as
//! Ferreyra et al. 2020 tell it).

use super::bench::Rig;
use super::control::refused;
use super::ensemble::{self, members};
use crate::case::Judged;
use crate::origin::{closed_form, printed};
use std::f64::consts::{PI, TAU};
use std::ops::RangeInclusive;
use tsubu_frame::{Claim, Ensemble};

/// Gravity [m/s^2], frequency [Hz], beads, and diameter [m] and density [kg/m^3] of one.
const GRAVITY: f64 = 9.8;
const FREQUENCY: f64 = 50.0;
const BEADS: usize = 120;
const DIAMETER: f64 = 3e-3;
const DENSITY: f64 = 7800.0;
/// Side of the box [m].
const SIDE: f64 = 15e-3;
/// Periods that are left out, and that are measured.
const PERIODS: [u32; 2] = [15, 30];
/// Looks in a period.
const LOOKS: u32 = 40;
/// Accelerations over gravity: one below which the beads lie, and those of the powers.
const AT_REST: f64 = 0.5;
const LEVELS: [f64; 6] = [1.5, 2.2, 3.3, 5.0, 8.0, 12.0];
/// Draws.
const SEEDS: RangeInclusive<u64> = 1..=15;

/// Beads in a high box that a sine shakes up and down.
fn shaken(level: f64, restitution: f64, gravity: f64, seed: u64, perturbation: f64) -> Result<Rig, String> {
    let amplitude = level * GRAVITY / (TAU * FREQUENCY).powi(2);
    let half = 0.5 * SIDE;
    let text = format!(
        r#"
        title = "beads in a shaken box"
        dimension = 3
        seed = {seed}
        gravity = {gravity}
        duration = 10
        speed-scale = 1
        [materials.steel]
        young-modulus = "100 MPa"
        density = {DENSITY}
        restitution = {restitution}
        friction = 0.3
        [particles.beads]
        material = "steel"
        count = {BEADS}
        diameter = {DIAMETER}
        start.rows = {{ spacing = 1.02, jitter = 0.5, region = {{ low = [-{half}, -{half}, 0], high = [{half}, {half}, 0.1] }} }}
        [walls.box]
        material = "steel"
        shape.box = {{ width = {SIDE}, depth = {SIDE}, height = 0.5 }}
        motion.signal.sine = {{ amplitude = {amplitude:e}, frequency = {FREQUENCY} }}
        "#
    );
    Rig::new(&text, perturbation)
}

/// Momentum of the beads over the velocity of the box, at the frequency of the shaking, over the mass of the beads: the part in phase is
/// the mass that the box seems to carry, the other one the loss of a cycle over 2 pi times their energy at the speed of the box.
fn response(level: f64, restitution: f64, gravity: f64, seed: u64, perturbation: f64) -> Result<[f64; 2], String> {
    let mut rig = shaken(level, restitution, gravity, seed, perturbation)?;
    let period = FREQUENCY.recip();
    rig.until(f64::from(PERIODS[0]) * period)?;
    let (mut along, mut across) = (0.0, 0.0);
    for look in 1..=PERIODS[1] * LOOKS {
        rig.until((f64::from(PERIODS[0]) + f64::from(look) / f64::from(LOOKS)) * period)?;
        let momentum = rig.engine.momentum()[2];
        // Where the box is at amplitude times sin(w t), its velocity goes as the cosine.
        let (sin, cos) = (TAU * FREQUENCY * rig.engine.time()).sin_cos();
        along += momentum * cos;
        across += momentum * sin;
    }
    let speed = level * GRAVITY / (TAU * FREQUENCY);
    let mass = BEADS as f64 * DENSITY * PI / 6.0 * DIAMETER.powi(3);
    let scale = 2.0 / f64::from(PERIODS[1] * LOOKS) / (speed * mass);
    Ok([along * scale, across * scale])
}

/// Of draws: powers of the acceleration in the mass up to 3.3 g and in the loss from there on; mass and loss at one at which beads lie.
fn responses(of: &str, rest: f64, restitution: f64, gravity: f64, perturbation: f64) -> Result<[Ensemble; 4], String> {
    members(of, SEEDS, |seed| {
        let found = LEVELS.map(|level| response(level, restitution, gravity, seed, perturbation));
        let found = found.into_iter().collect::<Result<Vec<_>, _>>()?;
        let power = |part: usize, levels: std::ops::Range<usize>| {
            let points: Vec<(f64, f64)> = levels.map(|k| (LEVELS[k].ln(), found[k][part].abs().ln())).collect();
            super::beds::line(&points).0
        };
        let [mass, loss] = response(rest, restitution, gravity, seed, perturbation)?;
        Ok([power(0, 0..3), power(1, 2..LEVELS.len()), mass, loss])
    })
}

/// The gates, for beads and for what is none.
fn gates(found: &[Ensemble; 4]) -> Vec<Claim> {
    let told = "Masmoudi et al. 2016, as Ferreyra et al. 2020 tell it";
    let (mass, loss) = (format!("measured: power -2 ({told})"), format!("measured: power -1 ({told})"));
    let judge = |what: &str, found: &Ensemble, low: f64, high: f64, source| {
        Claim::judge_ensemble(format!("beads in a shaken box: {what}"), found.clone(), Some(low), Some(high), source)
    };
    let lies = closed_form("beads that lie on the floor go with the box");
    vec![
        // Which levels are moderate was chosen after the first run: from 8 g on the mass changes its sign, which Ferreyra et al. tell too.
        judge("power of the acceleration in the mass, 1.5 to 3.3 g", &found[0], -2.5, -1.5, printed(&mass).after()),
        judge("power of the acceleration in the loss factor, 3.3 to 12 g", &found[1], -1.2, -0.8, printed(&loss)),
        judge("mass that the box carries over theirs, below 1 g", &found[2], 0.98, 1.02, lies),
        judge("loss factor, below 1 g", &found[3], -0.02, 0.02, lies),
    ]
}

/// The measured powers, by beads of steel; the size of the box and the number of beads are not the paper's.
pub(super) fn measured(perturbation: f64) -> Judged {
    let mut claims = gates(&responses("beads", AT_REST, 0.5, GRAVITY, perturbation)?);
    let adrift = gates(&responses("no gravity", AT_REST, 0.5, 0.0, perturbation)?);
    claims.push(refused("no gravity", &adrift[..3], 3));
    let seeds: Vec<u64> = SEEDS.collect();
    let thrown = seeds.iter().map(|&seed| Ok(response(3.0, 0.5, GRAVITY, seed, perturbation)?[1]));
    let thrown = ensemble::of(&seeds, thrown.collect::<Result<Vec<_>, String>>()?);
    let three = [thrown.clone(), thrown.clone(), thrown.clone(), thrown];
    claims.push(refused("beads that are thrown, as ones that lie", &gates(&three)[3..], 1));
    Ok(claims)
}
