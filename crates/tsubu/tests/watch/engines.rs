//! What the engines show, and what a run makes of watches.

use super::near;
use crate::dem::open_text;
use glam::DVec3;
use std::fs;
use std::path::Path;
use tsubu::engine::OpenError;
use tsubu::interrupt::Interrupt;
use tsubu::interrupt::Watcher;
use tsubu::methods;
use tsubu::partner::Hosts;
use tsubu::run::run;
use tsubu::view::{Contact, Wants};
use tsubu_frame::{Existing, ResultValue, Summary, Table};
use tsubu_scene::Scene;

const TWO: &str = r#"
gravity = 0
duration = "1 s"
periodic.x = [-0.05, 0.05]
[materials.soft]
young-modulus = "5 MPa"
density = 2500
[particles.a]
material = "soft"
diameter = 0.01
start.at.position = [[-0.0452, 0], [0.0452, 0.002795]]
[particles.b]
material = "soft"
diameter = 0.01
start.at.position = [[0, -0.0195]]
motion.frozen = {}
[walls.floor]
material = "soft"
shape.plane.point = [0, -0.0248]
"#;

#[test]
fn a_contact_across_the_end_knows_the_image() {
    let (engine, ..) = open_text(TWO, &[]);
    let shown = engine.view(Wants::ALL);
    let pair = shown.contacts.iter().find(|c| !c.wall).unwrap();
    let (a, b) = (shown.grains.position[pair.first], shown.grains.position[pair.second]);
    assert!(near(pair.branch.length(), 0.0096_f64.hypot(0.002_795), 1e-12), "{:?}", pair.branch);
    assert!((b - a).length() > 0.09, "the control: not the way through the world");
    assert!(pair.force.dot(pair.branch) < 0.0, "they press each other apart");
    assert!(near((shown.grains.radius[pair.first] - 0.5 * pair.overlap).abs(), (pair.position - a).length(), 1e-12));
    let held: Vec<bool> = (0..shown.len()).map(|i| !shown.free(i)).collect();
    assert_eq!((held, &*shown.grains.group), (vec![false, false, true], &[0, 0, 1][..]));
}

/// Places alone are those of the list with forces, across the end, of walls and of a bed in several blocks.
#[test]
fn places_alone_are_the_same_places() {
    let compare = |text: &str, time: f64| {
        let (mut engine, mut hosts, mut ledger) = open_text(text, &[]);
        engine.advance((time / engine.time_step()) as u64, &mut hosts, &mut ledger).unwrap();
        let (all, places) = (engine.view(Wants::CONTACTS).contacts, engine.view(Wants::TOUCHES).contacts);
        let name = |c: &Contact| (c.first, c.second, c.wall);
        assert_eq!(all.iter().map(name).collect::<Vec<_>>(), places.iter().map(name).collect::<Vec<_>>());
        for (a, b) in all.iter().zip(&places) {
            assert!(near(a.overlap, b.overlap, 1e-9) && (a.normal - b.normal).length() < 1e-12);
            assert!((a.position - b.position).length() < 1e-12 && (a.branch - b.branch).length() < 1e-12);
            assert_eq!(b.force, DVec3::ZERO);
        }
        all.len()
    };
    assert_eq!(compare(TWO, 0.0), 1);
    let many = BOX
        .replace("count = 20", "count = 800")
        .replace("{ width = \"60 mm\", height = \"60 mm\" }", "{ width = \"150 mm\", height = \"400 mm\" }");
    assert!(compare(&many, 0.1) > 300);
}

/// A ball at rest beside the origin: its weight and the torque of it are on the floor.
#[test]
fn a_floor_feels_weight_and_torque() {
    let text =
        TWO.replace("gravity = 0", "gravity = 10").replace("[[-0.0452, 0], [0.0452, 0.002795]]", "[[0.03, -0.0198]]");
    let (mut engine, mut hosts, mut ledger) = open_text(&text, &[]);
    engine.advance((2.0 / engine.time_step()) as u64, &mut hosts, &mut ledger).unwrap();
    let shown = engine.view(Wants::ALL);
    let weight = 10.0 * shown.grains.mass[0];
    let load = shown.walls[0];
    // The frozen one presses on nobody.
    assert!(near(load.force.z, -weight, 1e-6), "{:?} {weight}", load.force);
    assert!(near(load.torque.y, 0.03 * weight, 1e-6), "{:?}", load.torque);
    let contact = shown.contacts.iter().find(|c| c.wall).unwrap();
    assert!(
        near(contact.force.z, weight, 1e-6)
            && near(contact.branch.z, contact.position.z - shown.grains.position[contact.first].z, 1e-9)
    );
}

const BOX: &str = r#"
gravity = "10 m/s^2"
duration = "30 ms"
[materials.soft]
young-modulus = "5 MPa"
density = 2500
[particles.a]
material = "soft"
count = 20
diameter = "6 mm"
start.rows = {}
[walls.box]
material = "soft"
shape.box = { width = "60 mm", height = "60 mm" }
motion.signal.sine = { amplitude = "1 mm", frequency = "20 Hz" }
[output]
history-interval = "1 ms"
[watch.layers]
profile.bins = 4
[watch.gate]
every = "7 ms"
from = "5 ms"
discharge.point = [0, "3 mm"]
[watch.one]
until = "10 ms"
track.ids = [3]
"#;

pub fn done(text: &str, changes: &[&str], folder: &Path) -> Summary {
    let changes: Vec<String> = changes.iter().map(|c| (*c).to_owned()).collect();
    let scene = Scene::parse("test", text, Path::new("."), &changes).unwrap_or_else(|wrong| panic!("{wrong}"));
    let watcher = Watcher { interrupt: &Interrupt::new(), progress: &|_| {} };
    run(&scene, folder, Existing::Overwrite, &watcher).unwrap()
}

#[test]
fn a_run_writes_what_was_asked_for_when_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let summary = done(BOX, &[], folder.path());
    let table = |name: &str| Table::read(&folder.path().join(name)).unwrap();
    let history = table("history.csv");
    assert_eq!(history.rows.len(), 31);
    let passed = history.numbers("gate passed grains [-]").unwrap();
    let looks: Vec<usize> = (0..31).filter(|&k| k > 0 && passed[k - 1].is_nan() != passed[k].is_nan()).collect();
    assert_eq!(looks, [5], "not a number before the first look");
    let rate = history.numbers("gate rate [1/s]").unwrap();
    assert!(rate[11].is_nan() && rate[12].is_finite() && rate[12] == rate[18]);
    assert!(history.numbers("wall box force z [N]").is_some() && history.numbers("wall box torque y [N.m]").is_some());
    let layers = table("watch/layers.csv");
    assert_eq!(
        layers.header,
        [
            "time [s]",
            "z [m]",
            "solid fraction [-]",
            "velocity x [m/s]",
            "velocity z [m/s]",
            "granular temperature [m^2/s^2]"
        ]
    );
    assert_eq!(layers.rows.len(), 4 * 31);
    let one = table("watch/one.csv");
    assert_eq!(one.rows.len(), 11);
    assert!(history.numbers("one position z [m]").unwrap()[30] == one.numbers("position z [m]").unwrap()[10]);
    let number = |name: &str| match summary.results.get(name) {
        Some(ResultValue::Number(x)) => *x,
        other => panic!("{name}: {other:?}"),
    };
    assert_eq!(number("gate passed grains final"), passed[30]);
    let Some(ResultValue::List(profile)) = summary.results.get("layers solid fraction profile") else { panic!() };
    let of_first: Vec<f64> = layers.numbers("solid fraction [-]").unwrap().into_iter().step_by(4).collect();
    assert!(near(profile[0], of_first.iter().sum::<f64>() / 31.0, 1e-12));
    assert!(near(number("layers solid fraction"), profile.iter().sum::<f64>() / 4.0, 1e-12));
    let index = fs::read_to_string(folder.path().join("watch/index.json")).unwrap();
    assert!(index.contains("\"kind\": \"profile\"") && index.contains("gate passed mass [kg]"));
}

/// Watches read and never write: the state at the end is that of a run without them.
#[test]
fn nobody_feels_that_they_are_watched() {
    let folder = tempfile::tempdir().unwrap();
    let more = "[watch.grain]\ncoarse-grain = { width = 0.01, points = [9] }\n[watch.chains]\nforces = {}\n";
    let seen = done(&format!("{BOX}{more}"), &[], folder.path()).state_hash;
    let (alone, _) = BOX.split_once("[watch").unwrap();
    assert_eq!(seen, done(alone, &[], folder.path()).state_hash);
    assert!(!folder.path().join("watch").exists(), "overwriting takes the old tables away");
    assert_ne!(seen, done(alone, &["seed=2"], folder.path()).state_hash, "the control");
}

#[test]
fn the_automaton_says_what_it_cannot_show() {
    let refused = |watch: &str| {
        let (alone, _) = BOX.split_once("[watch").unwrap();
        let text = format!("{alone}[watch.w]\n{watch}\n");
        let changes = ["method=lattice".to_owned(), "particles.a.start.settled={}".to_owned()];
        let scene = Scene::parse("test", &text, Path::new("."), &changes).unwrap_or_else(|wrong| panic!("{wrong}"));
        match methods::open(scene.plan(), &Hosts::default()) {
            Ok(engine) => {
                let notes: Vec<String> = engine.notes().iter().map(|n| format!("{}: {}", n.key, n.text)).collect();
                Err(notes.join("\n"))
            }
            Err(OpenError::Refused(refusal)) => Ok(refusal.to_string()),
            Err(other) => panic!("{other}"),
        }
    };
    for watch in
        ["fabric = {}", "forces = {}", "coordination = {}", "slope = {}", "coarse-grain = { width = 1, points = [3] }"]
    {
        let text = refused(watch).unwrap();
        assert!(text.contains("watch.w.") && text.contains("a list of contacts"), "{text}");
    }
    assert!(refused("wall-load.wall = \"box\"").unwrap().contains("forces on walls"));
    assert!(refused("slope = {}").unwrap().contains("touching = false"));
    assert!(refused("profile.quantities = [\"coordination\"]").unwrap().contains("leave `coordination` out"));
    assert!(!refused("slope.touching = false").unwrap_err().contains("watch.w"));
    assert!(!refused("profile = {}").unwrap_err().contains("watch.w"));
    assert!(refused("track.ids = [1]").unwrap_err().contains("watch.w.track: `lattice` knows no spin"));
}

#[test]
fn the_automaton_is_watched() {
    let folder = tempfile::tempdir().unwrap();
    let changes = ["method=lattice", "particles.a.start.settled={}"];
    done(BOX, &changes, folder.path());
    let layers = Table::read(&folder.path().join("watch/layers.csv")).unwrap();
    let filled: f64 = layers.numbers("solid fraction [-]").unwrap()[..4].iter().sum();
    // 20 discs of 6 mm in a quarter of 60 mm by 60 mm.
    let exact = 20.0 * std::f64::consts::PI * 9e-6 / (0.06 * 0.015);
    assert!(near(filled, exact, 0.02), "{filled} {exact}");
    let history = Table::read(&folder.path().join("history.csv")).unwrap();
    assert!(history.header.iter().all(|h| !h.starts_with("wall box")), "it has no loads on walls");
}
