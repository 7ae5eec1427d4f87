//! Grains that are superellipsoids.

use super::{missing, open_text, same_for_all};
use tsubu::engine::Engine;
use tsubu::partner::Hosts;
use tsubu_frame::{Kind, Values};
use tsubu_scene::Scene;

/// Bodies of one kind that fly, on a smooth plane or in a box.
const ONE: &str = r#"
dimension = 3
duration = "1 s"
gravity = 0
[materials.glass]
young-modulus = "10 GPa"
poisson-ratio = 0.3
density = "2500 kg/m^3"
restitution = 0.6
friction = 0
[contact]
normal.hertz = {}
[particles.seeds]
material = "glass"
diameter = "4 mm"
SHAPE
START
[walls.WALL]
material = "glass"
"#;

const FLOOR: &str = "shape.plane = { point = [0, 0, 0], normal = [0, 0, 1] }";
const FAR: &str = "shape.plane = { point = [0, 0, -1], normal = [0, 0, 1] }";

fn scene(shape: &str, start: &str, wall: &str) -> String {
    format!("{}{wall}\n", ONE.replace("SHAPE", shape).replace("START", start).replace("WALL", "floor"))
}

fn body(axes: &str, exponents: &str) -> String {
    format!("shape.superellipsoid = {{ semi-axes = {axes}, exponents = {exponents}, orientation = \"as-drawn\" }}")
}

fn vectors(engine: &dyn Engine, name: &str) -> Vec<[f64; 3]> {
    engine.frame(&Hosts::default()).vectors(Kind::Grain, name).to_vec()
}

/// Two of them fly at each other, not quite head on, with friction. Where all axes are equal the path is that of spheres; where one is longer by
/// 1 % it is not.
#[test]
fn equal_axes_are_a_sphere() {
    let start = "start.at = { position = [[0, 0, 0], [\"4.1 mm\", \"0.7 mm\", \"0.4 mm\"]], velocity = [[1, 0, 0], [-1, 0, 0]], spin = [[30, 0, 90], [0, 200, 0]] }";
    let end = |shape: &str| {
        let (mut engine, mut hosts, mut ledger) =
            open_text(&scene(shape, start, FAR), &["materials.glass.friction=0.4", "dem.time-step=2e-8"]);
        engine.advance(8_000, &mut hosts, &mut ledger).unwrap();
        (vectors(&*engine, "velocity"), vectors(&*engine, "spin"))
    };
    let far = |a: &[[f64; 3]], b: &[[f64; 3]]| {
        let differ: f64 = a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (a - b).powi(2)).sum();
        (differ / a.iter().flatten().map(|a| a * a).sum::<f64>()).sqrt()
    };
    let sphere = end("shape.sphere = {}");
    assert!(sphere.0[0][0] < 0.0, "they have met");
    for exponents in ["[2, 2]", "[2.0000000001, 2]"] {
        let round = end(&body("[7, 7, 7]", exponents));
        assert!(far(&round.0, &sphere.0) < 1e-6 && far(&round.1, &sphere.1) < 1e-6, "{}", far(&round.0, &sphere.0));
    }
    let longer = end(&body("[1, 1, 0.99]", "[2, 2]"));
    assert!(far(&longer.0, &sphere.0) > 1e-4, "{}", far(&longer.0, &sphere.0));
}

/// What was asked for comes back at the place of contact: of an ellipsoid that falls flat, and of one that a tilted plane meets far from its centre,
/// which then turns. With the mass of the whole body in the dashpot the second would give back another: z sqrt(m/m*) in the place of z.
#[test]
fn what_is_asked_comes_back_at_the_place_of_contact() {
    let back = |tilt: f64, shape: &str| {
        let n = [tilt.sin(), 0.0, tilt.cos()];
        let wall = format!("shape.plane = {{ point = [0, 0, 0], normal = {n:?} }}");
        // Where it touches: what of the ellipsoid 2 mm x 1.2 mm x 1 mm reaches farthest towards the plane.
        let [a, c] = [2e-3, 1e-3];
        let reach = (a * a * n[0] * n[0] + c * c * n[2] * n[2]).sqrt();
        let arm = [-a * a * n[0] / reach, -c * c * n[2] / reach];
        let away = reach + 1e-4;
        let start = format!(
            "start.at = {{ position = [[{}, 0, {}]], velocity = [[{}, 0, {}]] }}",
            away * n[0],
            away * n[2],
            -0.5 * n[0],
            -0.5 * n[2]
        );
        let (mut engine, mut hosts, mut ledger) = open_text(&scene(shape, &start, &wall), &[]);
        // Long enough for the impact, too short for the other end to come round.
        let steps = (1e-3 / engine.time_step()) as u64;
        engine.advance(steps, &mut hosts, &mut ledger).unwrap();
        let (v, w) = (vectors(&*engine, "velocity")[0], vectors(&*engine, "spin")[0][1]);
        let there = [v[0] + w * arm[1], v[2] - w * arm[0]];
        ((there[0] * n[0] + there[1] * n[2]) / 0.5, w)
    };
    let shape = body("[2, 1.2, 1]", "[2, 2]");
    let (flat, spin) = back(0.0, &shape);
    assert!((flat - 0.6).abs() < 0.006 && spin.abs() < 1e-9, "{flat} {spin}");
    let (tilted, spin) = back(0.5, &shape);
    assert!((tilted - 0.6).abs() < 0.006 && spin.abs() > 10.0, "{tilted} {spin}");
    // The mass that it shows there, and what a dashpot for the whole mass would give back.
    let (n, squares) = ([0.5_f64.sin(), 0.5_f64.cos()], [4.0, 1.0]);
    let reach = (squares[0] * n[0] * n[0] + squares[1] * n[1] * n[1]).sqrt();
    let lever = (squares[0] - squares[1]) * n[0] * n[1] / reach;
    let lighter = 1.0 + lever * lever / ((squares[0] + squares[1]) / 5.0);
    let loss = 0.6_f64.ln();
    let number = -loss / (loss * loss + std::f64::consts::PI.powi(2)).sqrt() * lighter.sqrt();
    let wrong = (-std::f64::consts::PI * number / (1.0 - number * number).sqrt()).exp();
    assert!((wrong - 0.6).abs() > 0.02, "{wrong}");
}

/// A crowd in a world that repeats itself: ellipsoids, nearly boxes, spheres and clumps.
const CROWD: &str = r#"
dimension = 3
duration = "1 s"
gravity = 9.81
[materials.glass]
young-modulus = "200 MPa"
poisson-ratio = 0.3
density = "2500 kg/m^3"
restitution = 0.7
friction = 0.4
[particles.balls]
material = "glass"
count = 100
diameter = "3 mm"
start.random = { region = { low = ["-20 mm", "-20 mm", "2 mm"], high = ["20 mm", "20 mm", "60 mm"] }, velocity = [0, 0, -4], speed = 0.5 }
[particles.boxes]
material = "glass"
count = 100
diameter = "5 mm"
shape.superellipsoid = { semi-axes = [1, 1.2, 0.8], exponents = [5, 4] }
start.random = { region = { low = ["-20 mm", "-20 mm", "2 mm"], high = ["20 mm", "20 mm", "60 mm"] }, velocity = [0, 0, -4], speed = 0.5 }
[particles.pairs]
material = "glass"
count = 60
diameter = "4 mm"
shape.clump = { centre = [[-1, 0, 0], [1, 0, 0]], diameter = [2, 2] }
start.random = { region = { low = ["-20 mm", "-20 mm", "2 mm"], high = ["20 mm", "20 mm", "60 mm"] }, velocity = [0, 0, -4], speed = 0.5 }
[particles.seeds]
material = "glass"
count = 200
diameter = "5 mm"
shape.superellipsoid.semi-axes = [3, 2, 1.5]
start.random = { region = { low = ["-20 mm", "-20 mm", "2 mm"], high = ["20 mm", "20 mm", "60 mm"] }, velocity = [0, 0, -4], speed = 0.5 }
[walls.floor]
material = "glass"
shape.plane = { point = [0, 0, 0], normal = [0, 0, 1] }
[periodic]
x = ["-20 mm", "20 mm"]
y = ["-20 mm", "20 mm"]
"#;

/// The same bits whoever computes, and after a resume; the books close.
#[test]
fn a_crowd_gives_the_same_bits_for_all() {
    let contacts = same_for_all(|| open_text(CROWD, &[]), [[2000, 2500], [3100, 1400]]);
    assert!(contacts > 100, "{contacts}");
}

/// Smooth bodies that lose nothing, in a box without gravity: for a quarter of a second of impacts the energy stays, and so do the books.
#[test]
fn bodies_that_lose_nothing_keep_their_energy() {
    let start = "count = 40\nstart.random = { region = { low = [-0.012, -0.012, 0.002], high = [0.012, 0.012, 0.024] }, speed = 1 }";
    let wall = "shape.box = { width = 0.026, depth = 0.026, height = 0.026 }";
    for exponents in ["[2, 2]", "[4, 4]"] {
        let shape = body("[3, 2, 1.5]", exponents).replace("as-drawn", "random");
        let changes = ["materials.glass.restitution=1", "materials.glass.young-modulus=1e8", "dem.time-step=2e-6"];
        let (mut engine, mut hosts, mut ledger) = open_text(&scene(&shape, start, wall), &changes);
        let before = engine.grain_energies().kinetic;
        engine.advance(60_000, &mut hosts, &mut ledger).unwrap();
        let after = engine.grain_energies();
        let held = after.kinetic + after.rotational + after.elastic;
        assert!(after.rotational > 0.2 * before, "they turn: {} of {before}", after.rotational);
        assert!((held / before - 1.0).abs() < 1e-3, "{exponents}: {}", held / before - 1.0);
        assert!(missing(&*engine, &hosts, &ledger) < 1e-3);
    }
}

/// Any orientation is as likely as another: the mean square of a component of an axis is a third. As drawn it is one.
#[test]
fn bodies_are_turned_at_random() {
    let start = "count = 400\nstart.random.region = { low = [-0.05, -0.05, 0.01], high = [0.05, 0.05, 0.1] }";
    let squared = |orientation: &str| {
        let shape = body("[3, 2, 1.5]", "[2, 2]").replace("as-drawn", orientation);
        let (engine, hosts, _) = open_text(&scene(&shape, start, FLOOR), &[]);
        let frame = engine.frame(&hosts);
        let Some(Values::Quaternion(turned)) = frame.column(Kind::Grain, "orientation").map(|c| &c.values) else {
            panic!("orientations are told")
        };
        turned.iter().map(|[_, x, y, _]| (1.0 - 2.0 * (x * x + y * y)).powi(2)).sum::<f64>() / 400.0
    };
    let random = squared("random");
    assert!((random - 1.0 / 3.0).abs() < 4.0 * (4.0_f64 / 45.0 / 400.0).sqrt(), "{random}");
    assert!((squared("as-drawn") - 1.0).abs() < 1e-12);
}

/// What superellipsoids cannot have yet is refused by name.
#[test]
fn what_superellipsoids_cannot_have_is_refused() {
    let start = "start.at = { position = [[0, 0, \"3 mm\"]] }";
    let refused = |wall: &str, changes: &[&str], key: &str| {
        let text = scene(&body("[3, 2, 1.5]", "[2, 2]"), start, wall);
        let changes: Vec<String> = changes.iter().map(|change| (*change).to_owned()).collect();
        let scene = Scene::parse("seeds", &text, std::path::Path::new("."), &changes).unwrap_or_else(|c| panic!("{c}"));
        let told = tsubu::methods::open(scene.plan(), &Hosts::default()).err().map(|error| error.to_string());
        assert!(told.as_ref().is_some_and(|told| told.contains(&format!("  {key}: "))), "{told:?}");
    };
    refused(FLOOR, &["dem.integrator=forward-euler"], "dem.integrator");
    refused(FLOOR, &["method=lattice"], "particles.seeds.shape");
}
