//! Grains that come, go, or are moved as told.

use super::open_text;
use std::path::Path;
use tsubu::engine;
use tsubu::interrupt::Interrupt;
use tsubu::interrupt::Watcher;
use tsubu::run::run;
use tsubu_frame::{Existing, Kind, Table};
use tsubu_scene::Scene;

/// Two balls meet obliquely between a wall and nothing; where the middle of the impact is, the first vanishes.
const STRUCK: &str = r#"
title = "struck"
dimension = 3
gravity = [0, 0, -9.81]
duration = "1 s"
speed-scale = "1 m/s"
[materials.rubber]
density = "1200 kg/m^3"
young-modulus = "1 MPa"
restitution = 0.9
friction = 0.6
[particles.both]
material = "rubber"
diameter = "6 mm"
start.at = { position = [[0, 0, 0], ["6.01 mm", 0, "0.8 mm"]], velocity = [[1, 0, 0.4], [0, 0, 0]] }
[removal.middle.inside]
region = { low = ["0.2 mm", "-1 mm", "-1 mm"], high = ["1 mm", "1 mm", "1 mm"] }
[contact]
tangential.mindlin = {}
[dem]
time-step = "1e-7 s"
"#;

/// A grain that went in the middle of an impact took its motion and its height along in the books, but the energy that the
/// contact held, and the last half step of its force, were missing there.
#[test]
fn a_grain_takes_along_what_its_contacts_hold() {
    let (mut engine, mut hosts, mut ledger) = open_text(STRUCK, &[]);
    assert_eq!(engine.grains(), 2);
    let mut elastic = 0.0;
    while engine.grains() == 2 {
        elastic = engine.grain_energies().elastic;
        engine.advance(1, &mut hosts, &mut ledger).unwrap();
        assert!(engine.time() < 1e-3);
    }
    engine.advance(100, &mut hosts, &mut ledger).unwrap();
    assert_eq!(engine.grain_energies().elastic, 0.0);
    let energies = engine::energies(&*engine, &hosts);
    let residual = ledger.residual(&energies).abs();
    assert!(elastic > 1e-6, "nothing to lose: {elastic:e}");
    assert!(residual < 1e-4 * elastic, "{residual:e} of {elastic:e}");
    let momentum = ledger.momentum_residual(engine.momentum()).map(f64::abs);
    let scale = ledger.exchange_impulse[0].abs();
    assert!(momentum.iter().all(|p| *p < 1e-12 * scale), "{momentum:?} of {scale:e}");
}

/// A grain in the middle of a row goes: forces on it cancel, but it held both of its neighbours.
#[test]
fn a_grain_squeezed_from_both_sides_is_missed_by_both() {
    let changes = [
        "gravity=0",
        "particles.both.start.at={ position = [['-6.001 mm', 0, 0], [0, 0, 0], ['6.001 mm', 0, 0]], velocity = [[1, 0, 0], [0, 0, 0], [-1, 0, 0]] }",
        "removal.middle.inside.region.low=['-1 mm', '-1 mm', '-1 mm']",
        "dem.time-step='2e-6 s'",
    ];
    let (mut engine, mut hosts, mut ledger) = open_text(STRUCK, &changes);
    engine.advance(49, &mut hosts, &mut ledger).unwrap();
    let elastic = engine.grain_energies().elastic;
    assert!(elastic > 1e-6 && engine.grains() == 3, "{elastic:e}");
    engine.advance(51, &mut hosts, &mut ledger).unwrap();
    assert_eq!(engine.grains(), 2);
    let residual = ledger.residual(&engine::energies(&*engine, &hosts)).abs();
    assert!(residual < 1e-3 * elastic, "{residual:e} of {elastic:e}");
}

/// Powder that touches when the books open: what snapping together set free was half in and half out of the books.
#[test]
fn bodies_that_stick_at_time_zero_are_in_the_books() {
    let changes = [
        "gravity=0",
        "materials.rubber.surface-energy=0.5",
        "contact.cohesion.jkr={}",
        "particles.both.start.at={ position = [[0, 0, 0], ['6 mm', 0, 0]] }",
        "removal.middle.inside.region.high=['0.5 mm', '-0.9 mm', '1 mm']",
        "dem.time-step='1e-6 s'",
    ];
    let (mut engine, mut hosts, mut ledger) = open_text(STRUCK, &changes);
    let opening = engine.grain_energies().elastic;
    assert!(opening.abs() > 1e-9 && engine.contacts() == 0, "{opening:e}");
    engine.advance(5000, &mut hosts, &mut ledger).unwrap();
    assert_eq!(engine.contacts(), 1, "they have not pulled each other together");
    let residual = ledger.residual(&engine::energies(&*engine, &hosts)).abs();
    assert!(residual < 1e-3 * opening.abs(), "{residual:e} of {opening:e}");
}

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
        let interrupt = Interrupt::new();
        if interrupted {
            interrupt.ask();
        }
        run(&scene, into, existing, &Watcher { interrupt: &interrupt, progress: &|_| {} }).unwrap()
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

/// Driven grains began where they were placed, whatever their signal said of time 0: a wall with the same signal stood
/// elsewhere. Now they are where signal and place say, after a bed has settled and at any time.
#[test]
fn driven_grains_are_where_walls_of_the_same_motion_are() {
    let scene = r#"
title = "rough plate"
duration = "1 s"
gravity = 10
[materials.glass]
density = "2500 kg/m^3"
young-modulus = "5 MPa"
restitution = 0.7
[particles.bed]
material = "glass"
count = 5
diameter = "6 mm"
[particles.row]
material = "glass"
diameter = "6 mm"
motion.driven = { direction = "z", signal.sine = { amplitude = "3 mm", frequency = "20 Hz", phase = "90 deg" } }
start.at.position = [[0, 0, "80 mm"]]
[walls.box]
material = "glass"
shape.box = { width = "40 mm", height = "100 mm" }
"#;
    let (mut engine, mut hosts, mut ledger) = open_text(scene, &[]);
    for steps in [0, 1, 100, 1000] {
        engine.advance(steps, &mut hosts, &mut ledger).unwrap();
        let frame = engine.frame(&hosts);
        let driven = frame.integers(Kind::Grain, "group").iter().position(|group| *group == 1).unwrap();
        let z = frame.vectors(Kind::Grain, "position")[driven][2];
        let asked = 0.08 + 0.003 * (std::f64::consts::TAU * 20.0 * engine.time()).cos();
        assert!((z - asked).abs() < 1e-12, "{z} {asked} after {steps} steps");
    }
}
