//! Laws of their own for pairs of materials: each impact ends as its own law says, and a bed of several laws keeps its bits
//! and its books.

use super::{open_text, run_text};
use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::fmt::Write as _;
use std::path::Path;
use tsubu::check;
use tsubu::engine;
use tsubu::methods;
use tsubu::partner::Hosts;
use tsubu_frame::{Frame, Kind, Values};
use tsubu_scene::Scene;

const E: f64 = 0.8;
const STIFFNESS: f64 = 1e5;
const DASHPOT: f64 = 1.5;
const MASS: f64 = 2e-4;
const RADIUS: f64 = 3e-3;
const SURFACE_ENERGY: f64 = 5.0;

const LAWS: &str = r#"
[contact]
damping.sqrt = {}
tangential.none = {}
[[material-pair]]
between = ["b", "a"]
contact = { normal.hooke.stiffness = 1e5, damping.dashpot.coefficient = 1.5, attraction = true }
[[material-pair]]
between = ["b", "b"]
contact = { damping.none = {}, cohesion.jkr = {} }
"#;

/// Five impacts at 1 m/s far apart: a on a, a on b, b on b, and a on a plane and on triangles of b. Grains go by 0 and 1, 2
/// and 5, 6 and 7, 3 (the plane), 4 (the triangles).
fn impacts(laws: &str) -> String {
    format!(
        r#"
title = "impacts"
dimension = 3
gravity = 0
duration = "1 ms"
speed-scale = 1
[materials.a]
young-modulus = "0.5 GPa"
restitution = {E}
[materials.b]
young-modulus = "0.5 GPa"
restitution = 0.9
surface-energy = {SURFACE_ENERGY}
[particles.a]
material = "a"
diameter = {diameter}
mass = {MASS}
start.at.position = [[-3.05e-3, 0, 0], [3.05e-3, 0, 0], [-3.05e-3, 0.1, 0], [0, 0.2, -0.9969], [0, 0, 0.9969]]
start.at.velocity = [[0.5, 0, 0], [-0.5, 0, 0], [0.5, 0, 0], [0, 0, -1], [0, 0, 1]]
[particles.b]
material = "b"
diameter = {diameter}
mass = {MASS}
start.at.position = [[3.05e-3, 0.1, 0], [-3.05e-3, 0.3, 0.5], [3.05e-3, 0.3, 0.5]]
start.at.velocity = [[-0.5, 0, 0], [0.5, 0, 0], [-0.5, 0, 0]]
[walls.floor]
material = "b"
shape.plane = {{ point = [0, 0, -1], normal = [0, 0, 1] }}
[walls.lid]
material = "b"
shape.mesh.path = "lid.stl"
[dem]
time-step = "5e-8 s"
{laws}
"#,
        diameter = 2.0 * RADIUS
    )
}

/// What came of the impacts.
#[derive(Debug, PartialEq)]
struct Outcome {
    /// Speed of parting over that of meeting: a on a, a on b, a on the plane, a on triangles.
    restitution: [f64; 4],
    /// Largest attraction of b and b [N].
    pull_off: f64,
}

/// Two triangles that look down.
fn lid(folder: &Path) {
    let face = "facet normal 0 0 -1\nouter loop\nvertex -1 -1 1\nvertex 1 1 1\nvertex 1 -1 1\nendloop\nendfacet\n";
    let other = "facet normal 0 0 -1\nouter loop\nvertex -1 -1 1\nvertex -1 1 1\nvertex 1 1 1\nendloop\nendfacet\n";
    std::fs::write(folder.join("lid.stl"), format!("solid lid\n{face}{other}endsolid lid\n")).unwrap();
}

fn outcome(laws: &str) -> Outcome {
    let folder = tempfile::tempdir().unwrap();
    lid(folder.path());
    let (mut engine, mut hosts, mut ledger) = run_text(&impacts(laws), folder.path(), &[]);
    let mut pull_off = 0.0f64;
    for _ in 0..10_000 {
        engine.advance(1, &mut hosts, &mut ledger).unwrap();
        if engine.contacts() > 0 || engine.steps() < 6000 {
            pull_off = pull_off.max(attraction(&engine.frame(&hosts), 6));
        }
    }
    assert_eq!(engine.contacts(), 0);
    let residual = ledger.residual_relative(&engine::energies(&*engine, &hosts));
    assert!(residual.abs() < 1e-3, "{residual:e}");
    let frame = engine.frame(&hosts);
    let Some(Values::Vector(v)) = frame.column(Kind::Grain, "velocity").map(|c| &c.values) else { panic!() };
    Outcome { restitution: [v[1][0] - v[0][0], v[5][0] - v[2][0], v[3][2], -v[4][2]], pull_off }
}

/// Attraction along the normal in the contact of a grain [N].
fn attraction(frame: &Frame, grain: i64) -> f64 {
    let column = |name: &str| &frame.column(Kind::Contact, name).unwrap().values;
    let (Values::Integer(first), Values::Vector(force), Values::Vector(normal)) =
        (column("first"), column("force"), column("normal"))
    else {
        panic!()
    };
    let along = |k: usize| (0..3).map(|axis| force[k][axis] * normal[k][axis]).sum::<f64>();
    (0..first.len()).filter(|&k| first[k] == grain).map(along).fold(0.0, f64::max)
}

/// Whether every impact ends as its own law says: Hertz with the restitution asked for at 1 m/s, Hooke with a dashpot as the
/// damped oscillator, JKR with its pull-off force.
fn each_by_its_own(outcome: &Outcome) -> bool {
    let oscillator = |mass: f64| {
        let ratio = DASHPOT / (2.0 * (mass * STIFFNESS).sqrt());
        (-PI * ratio / (1.0 - ratio * ratio).sqrt()).exp()
    };
    let closed = [E, oscillator(0.5 * MASS), oscillator(MASS), oscillator(MASS)];
    let pull_off = 3.0 * PI * SURFACE_ENERGY * 0.5 * RADIUS;
    outcome.restitution.iter().zip(closed).all(|(e, closed)| (e - closed).abs() < 1e-3)
        && (outcome.pull_off / pull_off - 1.0).abs() < 2e-3
}

#[test]
fn every_impact_ends_as_its_own_law_says() {
    let mixed = outcome(LAWS);
    assert!(each_by_its_own(&mixed), "{mixed:?}");
    // To the bit what the law alone gives, though a law beside it reaches beyond the overlap.
    let hooke = "[contact]\nnormal.hooke.stiffness = 1e5\ndamping.dashpot.coefficient = 1.5\nattraction = true\ntangential.none = {}";
    assert_eq!(mixed.restitution[1..], outcome(hooke).restitution[1..]);
    // The control: laws of pairs passed over, and only the first of them passed over.
    let (one, _) = LAWS.split_once("[[material-pair]]").unwrap();
    let ignored = outcome(one);
    assert!(!each_by_its_own(&ignored), "{ignored:?}");
    assert_eq!(mixed.restitution[0], ignored.restitution[0], "a on a has the scene's law either way");
    let swapped = LAWS.replace("[\"b\", \"a\"]", "[\"a\", \"a\"]");
    assert!(!each_by_its_own(&outcome(&swapped)));
}

/// JKR holds large grains over a wider gap than small ones: the smallest grain of a group must not shorten its reach.
#[test]
fn large_grains_are_held_until_their_own_pull_off() {
    let pull_off = |smallest: &str| {
        let text = format!(
            r#"
title = "a group of many sizes"
dimension = 3
gravity = 0
duration = "1 ms"
speed-scale = 1
[materials.a]
young-modulus = "0.5 GPa"
surface-energy = {SURFACE_ENERGY}
density = 2500
[particles.a]
material = "a"
start.file.path = "grains.csv"
[contact]
cohesion.jkr = {{}}
damping.none = {{}}
[dem]
time-step = "5e-8 s"
"#
        );
        let folder = tempfile::tempdir().unwrap();
        let grains =
            format!("x,y,z,r,vx,vy,vz\n-4.01e-3,0,0,4e-3,0.5,0,0\n4.01e-3,0,0,4e-3,-0.5,0,0\n0,0,1,{smallest},0,0,0\n");
        std::fs::write(folder.path().join("grains.csv"), grains).unwrap();
        let (mut engine, mut hosts, mut ledger) = run_text(&text, folder.path(), &[]);
        let mut most = 0.0f64;
        for _ in 0..10_000 {
            engine.advance(1, &mut hosts, &mut ledger).unwrap();
            most = most.max(attraction(&engine.frame(&hosts), 0));
        }
        most / (3.0 * PI * SURFACE_ENERGY * 2e-3)
    };
    for smallest in ["4e-3", "0.2e-3"] {
        let pull = pull_off(smallest);
        assert!((pull - 1.0).abs() < 2e-3, "{smallest}: {pull}");
    }
}

/// The step is a share of the shortest contact of any pair under its own law, and advice names the pair.
#[test]
fn the_verdict_judges_each_pair_under_its_own_law() {
    let look = |stiffness: &str| {
        let text = impacts(&LAWS.replace("1e5", stiffness)).replace("time-step = \"5e-8 s\"", "");
        let folder = tempfile::tempdir().unwrap();
        lid(folder.path());
        let scene = Scene::parse("test", &text, folder.path(), &[]).unwrap_or_else(|c| panic!("{c}"));
        let hosts = Hosts::new(&scene.plan().hosts);
        let engine = methods::open(scene.plan(), &hosts).unwrap();
        (engine.time_step(), check::verdict(scene.plan(), &hosts, &*engine).to_string())
    };
    let (step, _) = look("1e8");
    assert!((step / (PI * (0.5 * MASS / 1e8).sqrt() / 20.0) - 1.0).abs() < 1e-12, "{step:e}");
    let (_, text) = look("10");
    assert!(text.contains("`contact.normal.hooke.stiffness` of the pair `a` and `b`"), "{text}");
    // The control: stiff springs need no advice.
    assert!(!look("1e8").1.contains("of the pair"));
}

/// Balls of two materials in stripes, enough for threads to be worth it, in a box of one of them; some vanish in a corner.
fn bed(laws: &str) -> String {
    let mut text = r#"
title = "mixed"
gravity = 50
duration = "1 s"
[materials.glass]
young-modulus = "10 MPa"
restitution = 0.6
friction = 0.5
rolling-friction = 0.05
[materials.wax]
young-modulus = "5 MPa"
restitution = 0.5
friction = 0.4
rolling-friction = 0.1
surface-energy = 0.05
[walls.box]
material = "wax"
shape.box = { width = "110 mm", height = "200 mm", floor-centre = ["55 mm", 0] }
[removal.corner.inside]
region = { low = ["-1 mm", "-1 mm"], high = ["6 mm", "6 mm"] }
[dem]
time-step = "1e-5 s"
"#
    .to_owned();
    for stripe in 0..10 {
        let (left, material) = (11 * stripe, ["glass", "wax"][stripe % 2]);
        let _ = write!(
            text,
            r#"
[particles.stripe-{stripe}]
material = "{material}"
count = 250
diameter = "2 mm"
mass = "0.01 g"
start.rows = {{ spacing = 1.02, jitter = 0.8, speed = 0.3, region = {{ low = ["{left} mm", 0], high = ["{right} mm", "200 mm"] }} }}
"#,
            right = left + 11
        );
    }
    text + laws
}

const SCENE_LAW: &str = "[contact]\nrolling.constant = {}\n";

/// Each pair has a law of its own, with as many numbers to remember as no other.
const SEVERAL: &str = r#"
[contact]
rolling.constant = {}
[[material-pair]]
between = ["wax", "glass"]
contact.normal.hooke.stiffness = "1 kN/m"
contact.damping.linear = {}
contact.tangential.spring = {}
contact.rolling.spring.stiffness = "0.1 kN/m"
[[material-pair]]
between = ["wax", "wax"]
contact.cohesion.jkr = {}
"#;

/// Contacts of a grain of glass with a grain of wax.
fn mixed_contacts(frame: &Frame) -> usize {
    let integers = |kind, name: &str| match &frame.column(kind, name).unwrap().values {
        Values::Integer(values) => values.clone(),
        other => panic!("{other:?}"),
    };
    let group: BTreeMap<i64, i64> =
        integers(Kind::Grain, "id").into_iter().zip(integers(Kind::Grain, "group")).collect();
    let pairs = integers(Kind::Contact, "first").into_iter().zip(integers(Kind::Contact, "second"));
    pairs.filter(|(a, b)| *b >= 0 && (group[a] - group[b]) % 2 != 0).count()
}

fn hash(laws: &str, threads: usize, resume: bool) -> (String, f64) {
    let text = bed(laws);
    super::hash(
        || open_text(&text, &[]),
        [700, 800],
        threads,
        resume,
        |engine, hosts, ledger| {
            let mixed = mixed_contacts(&engine.frame(hosts));
            assert!(engine.grains() < 2500 && engine.contacts() > 2000 && mixed > 100, "{} {mixed}", engine.contacts());
            super::missing(engine, hosts, ledger)
        },
    )
}

#[test]
fn a_bed_of_several_laws_keeps_bits_and_books() {
    let (one, residual) = hash(SEVERAL, 1, false);
    assert!(residual < 1e-3, "{residual:e}");
    assert_eq!(one, hash(SEVERAL, 2, false).0);
    assert_eq!(one, hash(SEVERAL, 7, false).0);
    assert_eq!(one, hash(SEVERAL, 2, true).0);
    assert_ne!(one, hash(SCENE_LAW, 1, false).0);
}

#[test]
fn the_scenes_law_said_for_every_pair_changes_no_bit() {
    let pair = |between: &str| {
        format!(
            "[[material-pair]]\nbetween = [{between}]\ncontact.normal.hertz = {{}}\ncontact.rolling.constant = {{}}\n"
        )
    };
    let said = [r#""glass", "glass""#, r#""glass", "wax""#, r#""wax", "wax""#].map(pair).concat();
    assert_eq!(hash(SCENE_LAW, 2, false), hash(&format!("{SCENE_LAW}{said}"), 2, false));
    let said_once = "rolling.none = {}\n".to_owned() + &said;
    assert_eq!(hash(SCENE_LAW, 2, false), hash(&format!("[contact]\n{said_once}"), 2, false));
}
