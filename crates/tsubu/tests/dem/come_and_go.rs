//! Grains that come, go, or are moved as told.

use super::open_text;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use tsubu::run::{Watcher, run};
use tsubu_frame::{Existing, Kind, Table};
use tsubu_scene::Scene;

/// Grains of many sizes rise without gravity, and one after the other goes.
const RISING: &str = r#"
title = "rising"
gravity = 0
duration = "40 ms"
speed-scale = "1 m/s"
[materials.glass]
density = "2500 kg/m^3"
young-modulus = "5 MPa"
restitution = 0.7
[particles.balls]
material = "glass"
count = 30
size.uniform = { smallest = "2 mm", largest = "6 mm" }
start.random = { region = { low = [0, 0, 0], high = ["60 mm", 0, "60 mm"] }, velocity = [0, 0, 1] }
[particles.floor]
material = "glass"
diameter = "6 mm"
motion.frozen = {}
start.at.position = [["30 mm", 0, "-50 mm"]]
[removal.top.behind]
point = [0, 0, "55 mm"]
normal = "-z"
[output]
history-interval = "5 ms"
frame-interval = "5 ms"
"#;

/// Both were found from the plan: the centre of mass from the mass of a grain of nominal size times the number at first, and
/// the speed as if the grains that were left at the end had been all there ever were.
#[test]
fn height_and_speed_are_those_of_the_grains_there_are() {
    let folder = tempfile::tempdir().unwrap();
    let whole = folder.path().join("whole");
    let scene = Scene::parse("rising", RISING, Path::new("."), &[]).unwrap_or_else(|c| panic!("{c}"));
    let go = |into: &Path, existing, interrupted: bool| {
        let interrupted = AtomicBool::new(interrupted);
        run(&scene, into, existing, &Watcher { interrupted: &interrupted, progress: &|_| {} }).unwrap()
    };
    let summary = go(&whole, Existing::Refuse, false);
    let heights = Table::read(&whole.join("history.csv")).unwrap().numbers("centre of mass height").unwrap();
    let frames = tsubu_frame::snapshots(&whole).unwrap();
    assert_eq!(heights.len(), frames.len());
    for (height, snapshot) in heights.iter().zip(&frames) {
        let frame = tsubu_frame::read_frame(&snapshot.path).unwrap();
        let moved = |i: &usize| frame.integers(Kind::Grain, "group")[*i] == 0;
        let mass = frame.scalars(Kind::Grain, "mass");
        let all: Vec<usize> = (0..mass.len()).filter(moved).collect();
        let z = |i: &usize| frame.vectors(Kind::Grain, "position")[*i][2];
        let mean = all.iter().map(|i| mass[*i] * z(i)).sum::<f64>() / all.iter().map(|i| mass[*i]).sum::<f64>();
        assert!((height / mean - 1.0).abs() < 1e-12, "{height} {mean}");
    }
    let (mut engine, mut hosts, mut ledger) = open_text(RISING, &[]);
    let mut counted = 0;
    for _ in 0..summary.steps {
        counted += engine.grains();
        engine.advance(1, &mut hosts, &mut ledger).unwrap();
    }
    assert!((summary.particles as usize) < 20, "{}", summary.particles);
    let told = summary.particle_steps_per_second * summary.wall_seconds;
    assert!((told / counted as f64 - 1.0).abs() < 1e-12, "{told} {counted}");
    // The same for a run that was cut and went on.
    let cut = folder.path().join("cut");
    go(&cut, Existing::Refuse, true);
    let summary = go(&cut, Existing::Resume, false);
    let told = summary.particle_steps_per_second * summary.wall_seconds;
    assert!((told / counted as f64 - 1.0).abs() < 1e-12, "{told} {counted}");
}
