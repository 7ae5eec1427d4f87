//! Grains in water by their outcome.

pub mod bodies;
mod coupled;
mod float;
mod fluctuation;
mod free;
mod lift;
mod rise;
mod settle;
mod spin;
mod step;
mod stream;
mod watch;

use crate::dem::open_text;
use glam::DVec3;
use tsubu::engine::{self, Engine};
use tsubu::ledger::Ledger;
use tsubu::view::Wants;

/// One grain of quartz in space, at rest, in still water.
const GRAIN: &str = r#"
dimension = 3
duration = "10 s"
speed-scale = "1 m/s"
[materials.quartz]
young-modulus = "5 MPa"
density = "2650 kg/m^3"
[particles.grain]
material = "quartz"
diameter = "2 mm"
start.at = { position = [[0, 0, 0]] }
[water]
"#;

/// A scene after `seconds`: the engine, its books, and what they miss of the energy turned over.
fn after(text: &str, changes: &[&str], seconds: f64) -> (Box<dyn Engine>, Ledger, f64) {
    let (mut engine, mut hosts, mut ledger) = open_text(text, changes);
    let steps = (seconds / engine.time_step()).round() as u64;
    engine.advance(steps, &mut hosts, &mut ledger).unwrap();
    let missing = ledger.residual_relative(&engine::energies(&*engine, &hosts)).abs();
    (engine, ledger, missing)
}

/// Spin of grain 0.
fn spin(engine: &dyn Engine) -> DVec3 {
    let view = engine.view(Wants::GRAINS);
    let i = view.grains.id.iter().position(|id| *id == 0).unwrap();
    view.grains.spin[i]
}

/// Place and velocity of grain 0.
fn grain(engine: &dyn Engine) -> (DVec3, DVec3) {
    let view = engine.view(Wants::GRAINS);
    let i = view.grains.id.iter().position(|id| *id == 0).unwrap();
    (view.grains.position[i], view.grains.velocity[i])
}
