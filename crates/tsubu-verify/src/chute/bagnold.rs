//! Flows of several heights down several slopes, in a small world with soft springs.

use super::{Flow, Slope, World, grows, quicker};
use crate::bench::within;
use crate::case::Judged;
use crate::control::refused;
use crate::ensemble;
use crate::origin::own;
use tsubu_frame::Claim;

/// Length and width of the periodic world.
pub(super) const SIZE: [f64; 2] = [8.0, 6.0];
/// Stiffness of the springs, in m g/d.
pub(super) const STIFFNESS: f64 = 5e3;

/// V-36: at rest below, steady flow of constant density with Bagnold's profile above the angle of repose.
pub fn bagnold(perturbation: f64) -> Judged {
    ensemble::drawn("slopes", 1..=5, |seed| of_a_bed(seed, perturbation))
}

/// The same of one base and the layers on it.
fn of_a_bed(seed: u64, perturbation: f64) -> Judged {
    let world = World::new(SIZE, STIFFNESS, seed, perturbation)?;
    let slope = |degrees: f64, layers: f64, start: f64| Slope::new(&world, degrees, layers, start);
    let still = slope(17.0, 12.0, 1.0).flow([200.0, 220.0], perturbation)?;
    let mut claims = vec![still.rests()];
    let gentle = slope(22.0, 24.0, 5.0).flow([250.0, 450.0], perturbation)?;
    let steep = slope(25.0, 24.0, 12.0).flow([250.0, 450.0], perturbation)?;
    claims.extend(gentle.gates());
    claims.extend(steep.gates());
    claims.push(quicker(&steep, &gentle));
    let thin = slope(25.0, 12.0, 5.0).flow([200.0, 400.0], perturbation)?;
    let thick = slope(25.0, 40.0, 25.0).flow([400.0, 600.0], perturbation)?;
    claims.extend([grows(&steep, &thin), grows(&thick, &steep)]);
    let name = "chute at 25 degrees, 40 layers: speed in the first half of the time over that of all";
    claims.push(within(name, thick.early, 1.0, 0.1, own("steady").after()));
    claims.push(refused("chute, a slope below the angle of repose", &still.gates()[..1], 1));
    claims.push(refused("chute, a base that is a plane", &on_a_plane(&world, 22.0, 12.0)?.gates(), 1));
    let slippery = Slope { friction: 0.0, ..slope(22.0, 12.0, 5.0) }.flow([50.0, 150.0], 1.0)?;
    claims.push(refused("chute, grains without friction", &slippery.gates(), 1));
    claims.push(refused("chute, grains without friction on a plane", &slides(&world)?, 3));
    Ok(claims)
}

/// What nothing holds back: it slides at 17 degrees, at 25 hardly faster than at 22, and in a high layer as in a low one.
fn slides(world: &World) -> Result<[Claim; 3], String> {
    let slide = |degrees: f64, layers: f64| slide(world, degrees, layers);
    let [below, gentle, steep] = [slide(17.0, 12.0)?, slide(22.0, 12.0)?, slide(25.0, 12.0)?];
    Ok([below.rests(), quicker(&steep, &gentle), grows(&slide(25.0, 24.0)?, &steep)])
}

/// A layer on a base without grains.
pub(super) fn on_a_plane(world: &World, degrees: f64, layers: f64) -> Result<Flow, String> {
    Slope { rough: false, ..Slope::new(world, degrees, layers, 5.0) }.flow([50.0, 150.0], 1.0)
}

/// The same without friction.
pub(super) fn slide(world: &World, degrees: f64, layers: f64) -> Result<Flow, String> {
    Slope { friction: 0.0, rough: false, ..Slope::new(world, degrees, layers, 5.0) }.flow([20.0, 60.0], 1.0)
}
