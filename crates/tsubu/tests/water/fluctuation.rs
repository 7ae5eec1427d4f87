//! Turbulence as a grain on its way sees it.

use super::GRAIN;
use super::coupled::{FLUME, stream};
use crate::dem::{self, open_text};
use std::f64::consts::{FRAC_PI_2, PI};
use tsubu::engine;
use tsubu::view::Wants;
use tsubu::water::{Fluctuation, Gust};
use tsubu_scene::plan;

const TIME: f64 = 0.05;
/// Time between two draws [s].
const INTERVAL: f64 = PI * PI / 8.0 * TIME;

fn told() -> Fluctuation {
    Fluctuation::new(&plan::Fluctuation { strength: 1.0, directions: plan::Directions::Even, time: TIME })
}

fn at(id: u32, time: f64) -> [f64; 3] {
    told().at(&mut Gust::default(), id, time)
}

/// Mean of a product over many grains.
fn mean(grains: u32, product: impl Fn(u32) -> f64) -> f64 {
    (0..grains).map(product).sum::<f64>() / f64::from(grains)
}

/// Correlation over a lag of x intervals.
fn correlation(x: f64) -> f64 {
    let angle = FRAC_PI_2 * x;
    if x < 2.0 { (1.0 - 0.5 * x) * angle.cos() + angle.sin() / PI } else { 0.0 }
}

/// Over many grains the numbers have mean 0 and variance 1 at every moment, their directions and those of different grains
/// nothing to do with each other, and the correlation over a lag is that of the text.
#[test]
fn variance_and_correlation_come_back() {
    let n = 40_000;
    for time in [0.0, 0.013, 1.0] {
        assert!(mean(n, |id| at(id, time)[0]).abs() < 0.02);
        for k in 0..3 {
            let variance = mean(n, |id| at(id, time)[k].powi(2));
            assert!((variance - 1.0).abs() < 0.03, "{time} {k}: {variance}");
        }
        assert!(mean(n, |id| at(id, time)[0] * at(id, time)[2]).abs() < 0.02);
        assert!(mean(n, |id| at(id, time)[0] * at(id + 1, time)[0]).abs() < 0.02);
        for x in [0.25, 0.75, 1.5, 2.5] {
            let found = mean(n, |id| at(id, time)[2] * at(id, time + x * INTERVAL)[2]);
            assert!((found - correlation(x)).abs() < 0.02, "{time} {x}: {found}");
        }
    }
}

/// What goes along with the water spreads as 2 T t after times t long against T (Taylor 1921), less what the begin lacks; the
/// Lagrangian time of the scene is the T of it. With the interval in its place the gate fails.
#[test]
fn the_lagrangian_time_is_that_of_dispersion() {
    let (n, span, parts) = (10_000, 40.0 * TIME, 800);
    let fluctuation = told();
    let spread = mean(n, |id| {
        let mut gust = Gust::default();
        let step = span / f64::from(parts);
        let moves = (0..parts).map(|k| step * fluctuation.at(&mut gust, id, (f64::from(k) + 0.5) * step)[0]);
        moves.sum::<f64>().powi(2)
    });
    let lags = || (0..2000).map(|k| (f64::from(k) + 0.5) * 1e-3);
    let moment = lags().map(|x| x * correlation(x) * 1e-3).sum::<f64>() * INTERVAL * INTERVAL;
    let ratio = |time: f64| spread / (2.0 * (time * span - moment));
    assert!((ratio(TIME) - 1.0).abs() < 0.05, "{}", ratio(TIME));
    assert!((ratio(INTERVAL) - 1.0).abs() > 0.1);
}

/// Mean velocities of 300 small grains as heavy as water at a height in the log law of U* = 0.01 m/s, and their spread, along the
/// stream and up [m/s]. Books close.
fn spread(fluctuation: &str, z: f64) -> [(f64, f64); 2] {
    let n = 300;
    let places = |z: f64| {
        let places: Vec<String> = (0..n).map(|k| format!("[{},0,{z}]", f64::from(k) * 1e-3)).collect();
        format!("particles.grain.start.at.position=[{}]", places.join(","))
    };
    let changes = [
        places(z).as_str(),
        "particles.grain.diameter=1e-4",
        "gravity=0",
        "water.density=2650",
        "water.float=true",
        "water.flow.log-law={shear-velocity=0.01,roughness=2e-3}",
        fluctuation,
        "speed-scale=0.1",
    ]
    .map(str::to_owned);
    let (mut engine, mut hosts, mut ledger) = open_text(GRAIN, &changes.each_ref().map(String::as_str));
    let steps = (0.1 / engine.time_step()) as u64;
    engine.advance(steps, &mut hosts, &mut ledger).unwrap();
    let missing = ledger.residual_relative(&engine::energies(&*engine, &hosts)).abs();
    assert!(missing < 1e-3, "{missing:e}");
    let view = engine.view(Wants::GRAINS);
    let of = |k: usize| {
        let v: Vec<f64> = view.grains.velocity.iter().map(|v| v[k]).collect();
        let mean = v.iter().sum::<f64>() / v.len() as f64;
        (mean, (v.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / v.len() as f64).sqrt())
    };
    [of(0), of(2)]
}

/// Small grains take part in it: velocities about the stream's with the strength that was asked for; at the bed, where the stream
/// ends, they rest.
#[test]
fn small_grains_take_part() {
    let told = "water.fluctuation={strength=1.5,time='50 ms'}";
    let [(along, x), (up, z)] = spread(told, 0.5);
    let stream = 0.01 * (8.5 + 5.75 * 250f64.log10());
    assert!((along / stream - 1.0).abs() < 0.03 && up.abs() < 0.003, "{along} {stream} {up}");
    for rms in [x, z] {
        assert!((rms / 0.015 - 1.0).abs() < 0.1, "{rms}");
    }
    assert_eq!(spread(told, 0.0), [(0.0, 0.0); 2]);
}

/// As a stream over a rough bed has it, 2.30 U* go along and 1.27 up (Nezu and Nakagawa 1993); an even fluctuation of the same energy
/// is refused.
#[test]
fn a_stream_fluctuates_most_along_itself() {
    let misses = |told: &str| {
        let [(_, x), (_, z)] = spread(told, 0.5);
        (x / 0.0230 - 1.0).abs().max((z / 0.0127 - 1.0).abs())
    };
    let stream = misses("water.fluctuation={strength=1.78,directions='stream',time='50 ms'}");
    assert!(stream < 0.12, "{stream}");
    let even = misses("water.fluctuation={strength=1.78,time='50 ms'}");
    assert!(even > 0.2, "{even}");
}

/// In a coupled stream small grains take part with the shear velocity of their own height, sqrt(1 - z/h) of that of the bottom, in
/// each direction; that of the bottom would be refused near the surface.
#[test]
fn the_strength_is_that_of_the_layer() {
    let places: Vec<String> =
        (0..400).map(|k| format!("[{},0,{}]", f64::from(k) * 1e-3, if k % 2 == 0 { 0.2 } else { 0.8 })).collect();
    let changes = [
        format!("particles.grain.start.at.position=[{}]", places.join(",")),
        "particles.grain.diameter=1e-4".to_owned(),
        "gravity=0".to_owned(),
        "water.density=2650".to_owned(),
        "water.float=true".to_owned(),
        "water.flow.coupled={bottom=0,top=1,layers=20,area=1,roughness=2e-3,shear-velocity=0.01}".to_owned(),
        "water.fluctuation={strength=1.5,time='50 ms'}".to_owned(),
        "speed-scale=0.1".to_owned(),
    ];
    let (mut engine, mut hosts, mut ledger) = open_text(GRAIN, &changes.each_ref().map(String::as_str));
    engine.advance((0.1 / engine.time_step()) as u64, &mut hosts, &mut ledger).unwrap();
    let view = engine.view(Wants::GRAINS);
    let rms = |high: bool, axis: usize| {
        let ours = view.grains.velocity.iter().zip(view.grains.position.iter()).filter(|(_, p)| (p.z > 0.5) == high);
        let v: Vec<f64> = ours.map(|(v, _)| v[axis]).collect();
        let mean = v.iter().sum::<f64>() / v.len() as f64;
        (v.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / v.len() as f64).sqrt()
    };
    for axis in 0..3 {
        for (high, z) in [(false, 0.2), (true, 0.8)] {
            let found = rms(high, axis) / (0.015 * f64::sqrt(1.0 - z));
            assert!((found - 1.0).abs() < 0.15, "{axis} {z}: {found}");
        }
        assert!((rms(true, axis) / 0.015 - 1.0).abs() > 0.15);
    }
}

/// A flume with a free surface whose stream fluctuates as fast as it flows: momentum to 1e-12, energy to 1e-3.
#[test]
fn books_close_in_turbulence() {
    let changes =
        ["water.fluctuation={strength=3,time='20 ms'}", "water.flow.coupled={bottom=0,top='30 mm',lid='free'}"];
    let (mut engine, mut hosts, mut ledger) = open_text(FLUME, &changes);
    let begin = stream(&*engine).momentum();
    engine.advance(4000, &mut hosts, &mut ledger).unwrap();
    let stream = stream(&*engine);
    let [drive, bottom, grains] = stream.impulses;
    let missing = stream.momentum() - begin - drive - bottom + grains;
    assert!(missing.abs() < 1e-12 * stream.momentum(), "{missing:e}");
    let missing = ledger.momentum_residual(engine.momentum());
    assert!(missing[0].abs() < 1e-12 * stream.momentum(), "{missing:?}");
    let missing = ledger.residual_relative(&engine::energies(&*engine, &hosts)).abs();
    assert!(missing < 1e-3, "{missing:e}");
}

/// 2,500 grains, enough for threads to be worth it, in a stream that draws anew every 2.5 ms.
const MANY: &str = r#"
gravity = 10
duration = "1 s"
speed-scale = "1 m/s"
[materials.glass]
young-modulus = "10 MPa"
restitution = 0.6
friction = 0.5
density = "2500 kg/m^3"
[particles.balls]
material = "glass"
count = 2500
diameter = "1 mm"
start.rows = { spacing = 1.2, jitter = 0.8, speed = 0.1 }
[walls.box]
material = "glass"
shape.box = { width = "80 mm", height = "120 mm" }
[water]
torque.stokes = {}
flow.log-law = { shear-velocity = "0.1 m/s", roughness = "1 mm" }
fluctuation.time = "2 ms"
[dem]
time-step = "1e-5 s"
"#;

fn hash(changes: &[&str], threads: usize, resume: bool) -> String {
    dem::hash(
        || open_text(MANY, changes),
        [400, 500],
        threads,
        resume,
        |engine, hosts, ledger| {
            let missing = dem::missing(engine, hosts, ledger);
            assert!(missing < 1e-3, "{missing:e}");
        },
    )
    .0
}

/// What is drawn depends on the grain and the moment, not on who asks first, where the grain is stored, or whether the run was
/// interrupted; another seed is other water.
#[test]
fn threads_and_resume_change_no_bit() {
    let coupled =
        "water.flow={coupled={bottom=0,top='80 mm',area='80 mm^2',shear-velocity=0.1,roughness='1 mm',lid='free'}}";
    let one = hash(&[], 1, false);
    for changes in [&[] as &[&str], &[coupled]] {
        let one = hash(changes, 1, false);
        for (threads, resume) in [(2, false), (7, false), (2, true)] {
            assert_eq!(one, hash(changes, threads, resume), "{threads} {resume}");
        }
    }
    assert_ne!(one, hash(&["seed=2"], 1, false));
}
