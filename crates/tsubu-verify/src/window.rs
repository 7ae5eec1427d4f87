//! A window: a periodic slice of a large cavity, of which the structure has so many copies, against the whole cavity.

use super::bench;
use super::control::refused;
use super::ensemble;
use super::host::measured;
use crate::case::Judged;
use crate::origin::own;
use tsubu::partner::Hosts;
use tsubu::study::response::bed;
use tsubu_frame::{Claim, Ensemble};
use tsubu_scene::plan::Plan;

/// Frequencies over the natural frequency: at the top, where grains count, and beside it.
const RATIOS: [f64; 3] = [0.99, 1.0, 1.01];

/// A machine with a box of steel balls, 36 x 60 mm across and this deep [mm], between planes; its ends are walls, or it is periodic.
fn scene(depth: f64, balls: usize, closed: bool, copies: f64) -> String {
    let wall = |name: &str, point: [f64; 3], normal: &str| {
        format!(
            "[walls.{name}]\nmaterial = \"steel\"\nhost = \"machine\"\nshape.plane = {{ point = {point:?}, normal = \"{normal}\" }}\n"
        )
    };
    let half = 0.5e-3 * depth;
    let mut walls = wall("floor", [0.0; 3], "z") + &wall("ceiling", [0.0, 0.0, 0.06], "-z");
    walls += &(wall("left", [-0.018, 0.0, 0.0], "x") + &wall("right", [0.018, 0.0, 0.0], "-x"));
    let ends = if closed {
        wall("front", [0.0, -half, 0.0], "y") + &wall("back", [0.0, half, 0.0], "-y")
    } else {
        format!("[periodic]\ny = [{}, {half}]\n", -half)
    };
    format!(
        r#"
method = "dem"
dimension = 3
gravity = "9.81 m/s^2"
duration = "0.5 s"
[materials.steel]
young-modulus = "0.2 GPa"
poisson-ratio = 0.3
density = "7800 kg/m^3"
restitution = 0.7
friction = 0.2
[particles.balls]
material = "steel"
count = {balls}
diameter = "6 mm"
start.random.region = {{ low = [-0.018, {}, 0], high = [0.018, {half}, 0.06] }}
{walls}{ends}
[hosts.machine]
copies = {copies}
structure.oscillator = {{ mass = "12 kg", stiffness = "153.5 kN/m", damping = "27.14 N s/m" }}
base.sine = {{ acceleration = "0.5 g", frequency = "18 Hz" }}
[response]
frequency-ratio = [1]
measure-periods = 60
"#,
        -half
    )
}

/// Root mean square displacements at each ratio [m].
fn heard(plan: &Plan, seed: u64) -> Result<[f64; 3], String> {
    let plan = Plan { seed, ..plan.clone() };
    let wanted = plan.response.clone().ok_or("the scene has no response")?;
    let bed = bed(&plan, 0).map_err(|e| e.to_string())?;
    let natural = Hosts::new(&plan.hosts).list[0].natural_frequencies()[0];
    let mut rms = [0.0; 3];
    for (rms, ratio) in rms.iter_mut().zip(RATIOS) {
        *rms = measured(&plan, &wanted, &bed, ratio * natural)?.rms;
    }
    Ok(rms)
}

/// 400 balls in a box 16 diameters deep, and 100 of them in a periodic slice of four diameters.
pub(super) fn window(_spoiler: f64) -> Judged {
    let whole = bench::plan(&scene(96.0, 400, true, 1.0))?;
    let over = |what: &str, copies: f64, seeds: u64| -> Result<[Ensemble; 3], String> {
        let slice = bench::plan(&scene(24.0, 100, false, copies))?;
        ensemble::members(what, 1..=seeds, |seed| {
            let (slice, whole) = (heard(&slice, seed)?, heard(&whole, seed)?);
            Ok(std::array::from_fn(|i| slice[i] / whole[i]))
        })
    };
    let source = own("asked for before it was computed: within 5 %");
    let judge = |(ratio, found): (f64, Ensemble)| {
        Claim::judge_ensemble(
            format!("displacement over that with the whole cavity, at {ratio} of the natural frequency"),
            found,
            Some(0.95),
            Some(1.05),
            source,
        )
    };
    let mut claims: Vec<Claim> = RATIOS.into_iter().zip(over("window", 4.0, 12)?).map(judge).collect();
    let wrong: Vec<Claim> = RATIOS.into_iter().zip(over("half of the copies", 2.0, 3)?).map(judge).collect();
    claims.push(refused("half of the copies", &wrong, 3));
    Ok(claims)
}
