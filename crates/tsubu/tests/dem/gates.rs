//! Gates: walls that vanish at a time.

use super::{open_text, run_text};
use std::path::Path;
use tsubu::engine::{self, Engine};
use tsubu::ledger::{Account, Ledger};
use tsubu::partner::Hosts;
use tsubu::view::Wants;
use tsubu_frame::Kind;
use tsubu_scene::Scene;

/// A ball on a floor is pulled along x and leans on a gate, which is soft, so that the contact holds energy.
const LEANING: &str = r#"
title = "leaning"
gravity = [2, -10]
duration = "1 s"
speed-scale = "1 m/s"
[materials.glass]
density = "2500 kg/m^3"
young-modulus = "5 MPa"
restitution = 0.5
friction = 0.5
[particles.ball]
material = "glass"
diameter = "10 mm"
start.at.position = [[0, "5 mm"]]
[walls.floor]
material = "glass"
shape.plane = {}
[walls.gate]
material = "glass"
shape.plane = { point = ["5 mm", 0], normal = "-x" }
until = "0.3 s"
[contact]
normal.hooke.stiffness = "500 N/m"
damping.linear = {}
tangential.spring = {}
"#;

/// Where a scene takes its ball after some seconds, and the books.
fn after(seconds: f64, changes: &[&str]) -> (Box<dyn Engine>, Hosts, Ledger) {
    let (mut engine, mut hosts, mut ledger) = open_text(LEANING, changes);
    let steps = (seconds / engine.time_step()).round() as u64;
    engine.advance(steps, &mut hosts, &mut ledger).unwrap();
    (engine, hosts, ledger)
}

fn x(engine: &dyn Engine) -> f64 {
    engine.frame(&Hosts::default()).vectors(Kind::Grain, "position")[0][0]
}

/// A ball that starts rolling without slip goes 5/7 of the way that a sliding one would. A gate that stays does not let it.
#[test]
fn a_ball_rolls_away_when_its_gate_has_gone() {
    let rolled = |until: &str| {
        let start = x(&*after(0.3, &[until]).0);
        x(&*after(0.5, &[until]).0) - start
    };
    let expected = 0.5 * 5.0 / 7.0 * 2.0 * 0.2f64.powi(2);
    let right = |way: f64| (way / expected - 1.0).abs() < 0.01;
    let way = rolled("walls.gate.until='0.3 s'");
    assert!(right(way), "{way} {expected}");
    assert!(!right(rolled("walls.gate.until='0.6 s'")), "a gate that stays lets it go");
    assert!(!right(rolled("walls.gate.until='0.25 s'")), "a gate that goes early does as well");
}

/// What the contact with the gate held, (m g)^2 / 2 k, goes with it; the books say so, and close.
#[test]
fn the_books_tell_what_a_gate_takes_with_it() {
    let (mut engine, mut hosts, mut ledger) = after(0.299, &["materials.glass.friction=0"]);
    let residual =
        |engine: &dyn Engine, hosts: &Hosts, ledger: &Ledger| ledger.residual(&engine::energies(engine, hosts));
    let before = residual(&*engine, &hosts, &ledger);
    let steps = (0.002 / engine.time_step()) as u64;
    engine.advance(steps, &mut hosts, &mut ledger).unwrap();
    let weight = 2500.0 * std::f64::consts::PI / 6.0 * 0.01f64.powi(3) * 2.0;
    let held = weight * weight / (2.0 * 500.0);
    let taken = -ledger.flow(Account::Gates);
    assert!((taken / held - 1.0).abs() < 1e-3, "{taken:e} of {held:e}");
    let missing = residual(&*engine, &hosts, &ledger) - before;
    let closes = |missing: f64| missing.abs() < 1e-3 * held;
    assert!(closes(missing), "{missing:e} of {held:e}");
    assert!(!closes(missing - taken), "books without what the gate takes would close as well");
    let momentum = ledger.momentum_residual(engine.momentum());
    assert!(momentum.iter().all(|p| p.abs() < 1e-12), "{momentum:?}");
}

/// The same with a friction spring on the gate: the ball hangs on it by friction.
#[test]
fn a_gate_takes_along_what_friction_held() {
    let steep = [
        "gravity=[2, -1]",
        "contact.rotation=false",
        "materials.glass.friction=0.8",
        "walls.floor.shape.plane.point=[0, '-50 mm']",
    ];
    let place = |seconds: f64| after(seconds, &steep).0.frame(&Hosts::default()).vectors(Kind::Grain, "position")[0];
    let hanging = place(0.29);
    assert!(hanging[2] > 0.0045, "it does not hang: {hanging:?}");
    let (engine, hosts, ledger) = after(0.35, &steep);
    assert!(x(&*engine) > hanging[0] + 1e-3);
    let residual = ledger.residual_relative(&engine::energies(&*engine, &hosts));
    assert!(residual.abs() < 1e-3, "{residual:e}");
}

/// Nothing of a gate is left: no load, no line in pictures.
#[test]
fn nobody_sees_a_gate_that_has_gone() {
    for (seconds, there) in [(0.29, true), (0.31, false)] {
        let (engine, hosts, _) = after(seconds, &[]);
        let load = engine.view(Wants::WALLS).walls[1].force.x;
        assert_eq!(load > 1e-3, there, "{load} after {seconds} s");
        let drawn = engine.frame(&hosts).integers(Kind::Surface, "wall").contains(&1);
        assert_eq!(drawn, there, "after {seconds} s");
    }
}

/// Meshes and walls that move can be gates as well; a gate holds while grains settle, however long that takes.
#[test]
fn gates_of_every_kind_hold_and_open() {
    let folder = tempfile::tempdir().unwrap();
    let text = "v 0.005 -1 -1\nv 0.005 1 -1\nv 0.005 1 1\nv 0.005 -1 1\nf 1 2 3\nf 1 3 4\n";
    std::fs::write(folder.path().join("gate.obj"), text).unwrap();
    let mesh = ["walls.gate.shape={ mesh = { path = 'gate.obj' } }", "dimension=3", "gravity=[2, 0, -10]"];
    let mesh = [&mesh[..], &["particles.ball.start.at.position=[[0, 0, '5 mm']]"]].concat();
    let moving = ["walls.gate.motion={ direction = 'x', signal = { steady = { rate = '10 mm/s' } } }"];
    let settled = [
        "walls.gate.shape={ box = { width = '20 mm', height = '20 mm', depth = '20 mm' } }",
        "walls.gate.until='0.1 s'",
        "particles.ball.start={ settled = { time = '2 s' } }",
        "particles.ball.count=1",
    ];
    for (name, changes, gate) in [("mesh", &mesh[..], 0.3), ("moving", &moving, 0.3), ("settled", &settled, 0.1)] {
        let (mut engine, mut hosts, mut ledger) = run_text(LEANING, folder.path(), changes);
        let mut to = |time: f64| {
            let steps = (time / engine.time_step()).round() as u64 - engine.steps();
            engine.advance(steps, &mut hosts, &mut ledger).unwrap();
            (x(&*engine), ledger.residual_relative(&engine::energies(&*engine, &hosts)))
        };
        let before = to(gate - 0.01).0;
        assert!(before < 0.0101, "{name}: {before}");
        let (later, residual) = to(gate + 0.4);
        assert!(later > before + 0.05, "{name}: {before} {later}");
        assert!(residual.abs() < 1e-3, "{name}: {residual:e}");
    }
}

/// 2,200 balls lean on a gate, enough for threads to be worth it.
const DAM: &str = r#"
title = "dam"
gravity = 10
duration = "1 s"
[materials.glass]
young-modulus = "10 MPa"
restitution = 0.6
friction = 0.5
rolling-friction = 0.05
[particles.balls]
material = "glass"
count = 2200
diameter = "2 mm"
mass = "0.01 g"
start.rows = { spacing = 1.01, jitter = 0.8, speed = 0.3, region = { low = ["-110 mm", 0], high = [0, "400 mm"] } }
[walls.floor]
material = "glass"
shape.plane = {}
[walls.left]
material = "glass"
shape.plane = { point = ["-110 mm", 0], normal = "x" }
[walls.gate]
material = "glass"
shape.plane = { point = [0, 0], normal = "-x" }
until = "10 ms"
[contact]
rolling.constant = {}
[dem]
time-step = "1e-5 s"
"#;

/// Number of the step after which the gate goes.
const GOES: u64 = 1000;

fn hash(threads: usize, resume: Option<u64>) -> String {
    let first = resume.unwrap_or(GOES / 2);
    super::hash(
        || open_text(DAM, &[]),
        [first, GOES + 700 - first],
        threads,
        resume.is_some(),
        |engine, hosts, ledger| {
            assert!(ledger.flow(Account::Gates) < 0.0, "the gate held nothing");
            let missing = super::missing(engine, hosts, ledger);
            assert!(missing < 1e-3, "{missing:e}");
        },
    )
    .0
}

/// Resumed before the gate goes, at the very step, and after it.
#[test]
fn threads_and_resume_change_no_bit_of_a_dam_break() {
    let one = hash(1, None);
    assert_eq!(one, hash(2, None));
    assert_eq!(one, hash(7, None));
    for step in [GOES - 50, GOES, GOES + 350] {
        assert_eq!(one, hash(2, Some(step)), "resumed after step {step}");
    }
}

/// What would have to go on without its wall, or has books of its own, cannot be a gate; nor can one that is never there.
#[test]
fn carried_pushed_and_free_walls_are_no_gates() {
    let plane = r#"shape.plane = { point = ["5 mm", 0], normal = "-x" }"#;
    let sphere = r#"shape.sphere = { centre = ["20 mm", "5 mm"], radius = "5 mm" }"#;
    let complaint = |shape: &str, mover: &str| {
        let text = LEANING.replace(plane, &format!("{shape}\n{mover}"));
        assert_ne!(text, LEANING);
        Scene::parse("gate", &text, Path::new("."), &[]).err().map_or_else(String::new, |c| c.to_string())
    };
    let servo = r#"servo = { direction = "-x", force = "1 N", mass = "1 kg" }"#;
    let body = r#"body = { mass = "1 g", inertia = 1e-8, centre = ["20 mm", "5 mm"] }"#;
    for (shape, mover, rival) in [(plane, servo, "`servo`"), (sphere, body, "`body`")] {
        let text = complaint(shape, mover);
        assert!(text.contains("`until`") && text.contains(rival), "{rival}: {text}");
    }
    assert_eq!(complaint(plane, ""), "");
    let early = Scene::parse("gate", LEANING, Path::new("."), &["walls.gate.until=0".to_owned()]).unwrap_err();
    assert!(early.to_string().contains("until"), "{early}");
}
