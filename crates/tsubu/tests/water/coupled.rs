//! Streams and columns of water in layers.

use super::after;
use crate::dem::open_text;
use std::f64::consts::PI;
use tsubu::engine::{self, Engine};
use tsubu::view::Wants;
use tsubu::water::{Coupled, Layers, Stream};

/// A flume without end: a glued row, a bed of 96 grains, a stream down a slope that carries some of them.
pub const FLUME: &str = r#"
slope = "3 deg"
duration = "1 s"
speed-scale = "0.4 m/s"
[materials.sand]
young-modulus = "5 MPa"
density = "2650 kg/m^3"
restitution = 0.5
[particles.base]
material = "sand"
count = 24
diameter = "2 mm"
motion.frozen = {}
start.rows = { spacing = 1, jitter = 0, region = { low = [0, 0], high = ["48 mm", "2 mm"] } }
[particles.sand]
material = "sand"
count = 96
diameter = "2 mm"
start.rows = { spacing = 1.05, jitter = 0.5, speed = 0.05, region = { low = [0, "2 mm"], high = ["48 mm", "30 mm"] } }
[periodic]
x = [0, "48 mm"]
[water]
drag.stokes-newton = {}
hindrance.richardson-zaki = {}
flow.coupled = { bottom = 0, top = "30 mm" }
"#;

/// The stream of a scene.
pub fn stream(engine: &dyn Engine) -> Coupled {
    let view = engine.view(Wants::GRAINS);
    match &view.water.unwrap().stream {
        Stream::Coupled(coupled) => (**coupled).clone(),
        other => panic!("{other:?}"),
    }
}

/// What the grains gain the water loses: the momentum of grains, of the water that moves along with them and of the stream is what
/// gravity, the bottom and the walls gave, to 1e-12 after thousands of steps. Energy to 1e-3 at the default step.
#[test]
fn what_the_grains_gain_the_water_loses() {
    let (mut engine, mut hosts, mut ledger) = open_text(FLUME, &[]);
    let begin = stream(&*engine).momentum();
    engine.advance(4000, &mut hosts, &mut ledger).unwrap();
    let stream = stream(&*engine);
    let [drive, bottom, grains] = stream.impulses;
    let missing = stream.momentum() - begin - drive - bottom + grains;
    assert!(missing.abs() < 1e-12 * stream.momentum(), "{missing:e}");
    // The glued row has its part of it.
    assert!(ledger.water_impulse[0] < grains);
    assert!(grains > 1e-3 * stream.momentum(), "the grains take part: {grains:e} of {:e}", stream.momentum());
    let missing = ledger.momentum_residual(engine.momentum());
    assert!(missing[0].abs() < 1e-12 * stream.momentum(), "{missing:?}");
    let coarse = ledger.residual_relative(&engine::energies(&*engine, &hosts)).abs();
    assert!(coarse < 1e-3, "{coarse:e}");
    // The control: without the reaction the stream would have kept what the grains gained.
    assert!((stream.momentum() - begin - drive - bottom).abs() > 1e-4 * stream.momentum());
}

/// Where all grains are free, the impulse that the stream gave is the one that the grains had from the water.
#[test]
fn what_the_stream_gives_the_grains_have() {
    let text = FLUME.replace("motion.frozen = {}\n", "");
    let (mut engine, mut hosts, mut ledger) = open_text(&text, &[]);
    engine.advance(1000, &mut hosts, &mut ledger).unwrap();
    let (given, had) = (stream(&*engine).impulses[2], ledger.water_impulse[0]);
    assert!((given - had).abs() < 1e-12 * had.abs() && had > 0.0, "{given} {had}");
}

/// Water that would run freely between glued grains is slowed by them: in the row on the bottom it stands nearly, less than a
/// tenth of the mean. Where only free grains slow the stream it ran there with a fifth of it.
#[test]
fn glued_grains_slow_the_stream() {
    let (engine, ..) = after(FLUME, &[], 0.2);
    let stream = stream(&*engine);
    let mean = stream.velocity.iter().sum::<f64>() / stream.velocity.len() as f64;
    assert!(stream.velocity[..2].iter().all(|u| *u < 0.1 * mean), "{:?}", stream.velocity);
}

/// Layers cut spheres exactly: a sphere across three layers leaves what the formula of the spherical cap says, and all layers
/// together leave the whole volume but the sphere's.
#[test]
fn layers_cut_spheres_exactly() {
    let layers = Layers::new(0.0, 5.0, 5, 8.0);
    let open = layers.measure(&[glam::DVec3::new(0.0, 0.0, 2.4)], &[0.9]);
    let cap = |h: f64| PI * h * h * (0.9 - h / 3.0);
    // From z = 1.5 to 3.3: a cap of 0.5 in layer 1, one of 0.3 in layer 3.
    assert!(
        (1.0 - open[1] - cap(0.5) / 8.0).abs() < 1e-12 && (1.0 - open[3] - cap(0.3) / 8.0).abs() < 1e-12,
        "{open:?}"
    );
    let whole: f64 = open.iter().map(|e| 8.0 * (1.0 - e)).sum();
    assert!((whole - 4.0 / 3.0 * PI * 0.9f64.powi(3)).abs() < 1e-12);
    assert_eq!((open[0], open[4]), (1.0, 1.0));
}
