//! Grains that are polyhedra or polygons.

use super::{hash, open_text, same_for_all};
use glam::{DMat3, DVec3};
use tsubu::engine::Engine;
use tsubu::partner::Hosts;
use tsubu::view::Wants;
use tsubu_frame::Kind;
use tsubu_scene::Scene;
use tsubu_scene::plan::{ClumpOrientation, GrainShape};

/// Bodies of one kind, as drawn, on a plane or in a box.
const ONE: &str = r#"
dimension = 3
duration = "1 s"
gravity = 9.81
[materials.wood]
young-modulus = "2 GPa"
poisson-ratio = 0.3
density = "700 kg/m^3"
restitution = 0.3
friction = 0
[particles.dice]
material = "wood"
diameter = "10 mm"
SHAPE
START
[walls.floor]
material = "wood"
"#;

const FLOOR: &str = "shape.plane = { point = [0, 0, 0], normal = [0, 0, 1] }";
const ROUNDING: f64 = 0.1;

fn cube(stretch: DVec3) -> Vec<DVec3> {
    (0..8).map(|i| stretch * DVec3::from_array([0, 1, 2].map(|k| f64::from(i >> k & 1) * 2.0 - 1.0))).collect()
}

fn turned(corners: Vec<DVec3>, by: DMat3) -> Vec<DVec3> {
    corners.into_iter().map(|corner| by * corner).collect()
}

fn shape(corners: &[DVec3]) -> String {
    let corners: Vec<[f64; 3]> = corners.iter().map(DVec3::to_array).collect();
    format!("shape.polyhedron = {{ corners = {corners:?}, rounding = {ROUNDING}, orientation = \"as-drawn\" }}")
}

fn scene(shape: &str, start: &str, wall: &str) -> String {
    format!("{}{wall}\n", ONE.replace("SHAPE", shape).replace("START", start))
}

fn at(place: DVec3, velocity: DVec3) -> String {
    let (place, velocity) = (place.to_array(), velocity.to_array());
    format!("start.at = {{ position = [{place:?}], velocity = [{velocity:?}] }}")
}

fn vectors(engine: &dyn Engine, name: &str) -> Vec<DVec3> {
    let frame = engine.frame(&Hosts::default());
    frame.vectors(Kind::Grain, name).iter().map(|v| DVec3::from_array(*v)).collect()
}

fn mass(engine: &dyn Engine) -> f64 {
    engine.frame(&Hosts::default()).scalars(Kind::Grain, "mass")[0]
}

/// Hertz's overlap of a corner of this rounding radius [m] under a force [N], against a wall of the same material.
fn overlap(force: f64, radius: f64) -> f64 {
    let modulus = 2e9 / (2.0 * (1.0 - 0.09));
    (force / (4.0 / 3.0 * modulus * radius.sqrt())).powf(2.0 / 3.0)
}

/// Scale from the units of the corners to metres, by the farthest corner of the core.
fn unit(farthest: f64) -> f64 {
    0.5e-2 / (farthest + ROUNDING)
}

/// A cube on a face, an edge or a corner lies still where 4, 2 or 1 corners carry its weight by Hertz's law. For one corner more or less it would not.
#[test]
fn a_cube_rests_on_face_edge_and_corner() {
    let half = 1.0 - ROUNDING;
    let on_edge = DMat3::from_rotation_x(std::f64::consts::FRAC_PI_4);
    let on_corner = DMat3::from_quat(glam::DQuat::from_rotation_arc(DVec3::ONE.normalize(), -DVec3::Z));
    for (by, height, bearing) in
        [(DMat3::IDENTITY, half, 4), (on_edge, half * 2.0_f64.sqrt(), 2), (on_corner, half * 3.0_f64.sqrt(), 1)]
    {
        let unit = unit(half * 3.0_f64.sqrt());
        let shape = shape(&turned(cube(DVec3::ONE), by));
        let open = |height: f64| open_text(&scene(&shape, &at(DVec3::Z * height, DVec3::ZERO), FLOOR), &[]);
        let weight = mass(&*open(1.0).0) * 9.81;
        let rest = |bearing: i32| {
            let depth = overlap(weight / f64::from(bearing), unit * ROUNDING);
            (unit * (height + ROUNDING) - depth, depth)
        };
        let (z, depth) = rest(bearing);
        let (mut engine, mut hosts, mut ledger) = open(z);
        let carried = |engine: &dyn Engine| vectors(engine, "contact force")[0].z / weight;
        assert!((carried(&*engine) - 1.0).abs() < 1e-6, "{bearing}: {}", carried(&*engine));
        assert_eq!(engine.contacts(), bearing as usize);
        engine.advance(3000, &mut hosts, &mut ledger).unwrap();
        assert!((vectors(&*engine, "position")[0].z - z).abs() < 1e-4 * depth);
        for wrong in [bearing - 1, bearing + 1].into_iter().filter(|wrong| *wrong > 0) {
            assert!((carried(&*open(rest(wrong).0).0) - 1.0).abs() > 0.1, "{bearing} is not {wrong}");
        }
    }
}

/// What a body does on a plane that is tilted by an angle whose tangent is given: speed down the plane, and its height over that at first.
fn on_incline(corners: &[DVec3], height: f64, tangent: f64, friction: f64, seconds: f64) -> (f64, f64) {
    let angle = tangent.atan();
    let gravity = format!("gravity=[{:?}, 0, {:?}]", 9.81 * angle.sin(), -9.81 * angle.cos());
    let friction = format!("materials.wood.friction={friction}");
    let text = scene(&shape(corners), &at(DVec3::Z * height, DVec3::ZERO), FLOOR);
    let (mut engine, mut hosts, mut ledger) =
        open_text(&text, &[&gravity, &friction, "materials.wood.restitution=0.1"]);
    let steps = (seconds / engine.time_step()) as u64;
    engine.advance(steps, &mut hosts, &mut ledger).unwrap();
    (vectors(&*engine, "velocity")[0].x, vectors(&*engine, "position")[0].z / height)
}

/// A cube slides where the slope is steeper than its friction, with g (sin - mu cos), and stays where it is less steep; a pillar tips where its weight passes the corners of its core.
#[test]
fn a_cube_slides_and_a_pillar_tips() {
    let unit_of_cube = unit((1.0 - ROUNDING) * 3.0_f64.sqrt());
    let slide = |tangent: f64, seconds: f64| on_incline(&cube(DVec3::ONE), unit_of_cube, tangent, 0.3, seconds).0;
    assert!(slide(0.29, 0.02).abs() < 1e-4, "{}", slide(0.29, 0.02));
    let (early, late) = (slide(0.36, 0.01), slide(0.36, 0.03));
    let angle = 0.36_f64.atan();
    let told = 9.81 * (angle.sin() - 0.3 * angle.cos());
    let found = (late - early) / 0.02;
    assert!((found / told - 1.0).abs() < 0.01, "{found} {told}");
    assert!((found / (9.81 * angle.sin()) - 1.0).abs() > 0.5, "friction is felt");
    // A pillar three times as high as it is wide: its core ends ROUNDING within its sides.
    let pillar = cube(DVec3::new(1.0, 1.0, 3.0));
    let core = DVec3::new(1.0, 1.0, 3.0) - DVec3::splat(ROUNDING);
    let height = 3.0 * unit(core.length());
    let tips = (1.0 - ROUNDING) / 3.0;
    let up = |tangent: f64| on_incline(&pillar, height, tangent, 0.9, 0.15).1;
    let [stands, falls, sharp] = [0.97 * tips, 1.03 * tips, 0.97 / 3.0].map(up);
    assert!(stands > 0.99 && falls < 0.9, "{stands} {falls}");
    assert!(sharp < 0.9, "with sharp edges it would stand: {sharp}");
}

/// A wedge of half angle a between two planes: each carries m g / (2 sin a), by four corners alike.
#[test]
fn a_wedge_rests_between_two_planes() {
    let angle = 0.5_f64;
    let (w, h) = (2.0 * angle.tan(), 2.0);
    let corners: Vec<DVec3> = [-1.5, 1.5]
        .into_iter()
        .flat_map(|y| [DVec3::new(0.0, y, 0.0), DVec3::new(w, y, h), DVec3::new(-w, y, h)])
        .collect();
    let plan = GrainShape::Polyhedron {
        corners: corners.iter().map(DVec3::to_array).collect(),
        rounding: ROUNDING,
        orientation: ClumpOrientation::AsDrawn,
    };
    let clump = plan.clump().unwrap();
    let body = clump.polyhedron.unwrap();
    let axes = clump.axes.map(DVec3::from_array);
    let normal = |n: &[f64; 3]| axes[0] * n[0] + axes[1] * n[1] + axes[2] * n[2];
    let left = DVec3::new(-angle.cos(), 0.0, -angle.sin());
    let face = body.faces.iter().find(|face| (normal(&face.normal) - left).length() < 1e-9).unwrap();
    let (distance, radius) = (1e-2 * (face.offset + body.rounding), 1e-2 * body.rounding);
    let walls = |depth: f64| {
        let plane = |sign: f64| {
            let n = DVec3::new(sign * left.x, 0.0, left.z);
            format!(
                "shape.plane = {{ point = {:?}, normal = {:?} }}",
                (n * (distance - depth)).to_array(),
                (-n).to_array()
            )
        };
        format!("{}\n[walls.right]\nmaterial = \"wood\"\n{}", plane(1.0), plane(-1.0))
    };
    let open = |depth: f64| open_text(&scene(&shape(&corners), &at(DVec3::ZERO, DVec3::ZERO), &walls(depth)), &[]);
    let weight = mass(&*open(-1e-4).0) * 9.81;
    let on_each = weight / (2.0 * angle.sin());
    let (mut engine, mut hosts, mut ledger) = open(overlap(on_each / 4.0, radius));
    let push = |engine: &dyn Engine| {
        let contacts = engine.view(Wants::CONTACTS).contacts;
        let of = |wall: usize| contacts.iter().filter(|c| c.second == wall).map(|c| c.force).sum::<DVec3>().length();
        (contacts.len(), of(0), of(1))
    };
    for _ in 0..2 {
        let (count, first, second) = push(&*engine);
        assert_eq!(count, 8);
        assert!(
            (first / on_each - 1.0).abs() < 1e-3 && (second / on_each - 1.0).abs() < 1e-3,
            "{first} {second} {on_each}"
        );
        engine.advance(3000, &mut hosts, &mut ledger).unwrap();
    }
    let (_, flat, _) = push(&*open(overlap(weight / 8.0, radius)).0);
    assert!((flat / on_each - 1.0).abs() > 0.3, "a wedge is no block: {flat}");
}

/// What was asked for comes back where a lone corner lands, and the body turns; with the mass of the whole body in the dashpot it would not. Of a face that lands flat it comes back nearly: four corners share it.
#[test]
fn what_is_asked_comes_back_where_a_corner_lands() {
    let axis = DVec3::new(1.0, 0.7, 0.4).normalize();
    let by = DMat3::from_axis_angle(axis, 0.5);
    let core: Vec<DVec3> = turned(cube(DVec3::splat(1.0 - ROUNDING)), by);
    let unit = unit((1.0 - ROUNDING) * 3.0_f64.sqrt());
    let lowest = core.iter().copied().min_by(|a, b| a.z.total_cmp(&b.z)).unwrap() * unit;
    let radius = unit * ROUNDING;
    let land = |corners: &[DVec3], arm: DVec3| {
        let start = at(DVec3::Z * (radius - arm.z + 1e-4), DVec3::Z * -0.5);
        let (mut engine, mut hosts, mut ledger) =
            open_text(&scene(&shape(corners), &start, FLOOR), &["gravity=0", "materials.wood.restitution=0.6"]);
        engine.advance((0.6e-3 / engine.time_step()) as u64, &mut hosts, &mut ledger).unwrap();
        let (v, w) = (vectors(&*engine, "velocity")[0], vectors(&*engine, "spin")[0]);
        ((v + w.cross(arm - DVec3::Z * radius)).z / 0.5, w.length())
    };
    let (back, spin) = land(&turned(cube(DVec3::ONE), by), lowest);
    assert!((back - 0.6).abs() < 0.01 && spin > 10.0, "{back} {spin}");
    let (flat, spin) = land(&cube(DVec3::ONE), DVec3::Z * ((ROUNDING - 1.0) * unit));
    assert!((flat - 0.6).abs() < 0.05 && spin < 1e-6, "{flat} {spin}");
}

/// Smooth bodies that lose nothing in a box without gravity keep their energy, in space and in the plane, at the step that is found for them; one five times as long does not.
#[test]
fn bodies_that_lose_nothing_keep_their_energy() {
    let space = shape(&cube(DVec3::new(1.0, 1.2, 0.8))).replace("as-drawn", "random");
    let three = (
        "count = 30\nstart.random = { region = { low = [-0.02, -0.02, 0.002], high = [0.02, 0.02, 0.06] }, speed = 0.5 }",
        "shape.box = { width = 0.042, depth = 0.042, height = 0.062 }",
    );
    let plane =
        "shape.polygon = { corners = [[1, 0.9], [-1, 1.1], [-0.8, -1], [1, -0.7]], rounding = 0.1, thickness = 0.01 }";
    let two = (
        "count = 25\nstart.random = { region = { low = [-0.039, 0.002], high = [0.039, 0.08] }, speed = 0.5 }",
        "shape.box = { width = 0.08, height = 0.082 }",
    );
    for (body, (start, wall), changes) in [
        (space.as_str(), three, &["gravity=0", "materials.wood.restitution=1", "dem.largest-overlap=1"][..]),
        (plane, two, &["dimension=2", "gravity=0", "materials.wood.restitution=1", "dem.largest-overlap=1"]),
    ] {
        let drift = |longer: Option<f64>| {
            let text = scene(body, start, wall);
            let automatic = open_text(&text, changes).0.time_step();
            let step = longer.map(|times| format!("dem.time-step={}", automatic * times));
            let changes: Vec<&str> = changes.iter().copied().chain(step.as_deref()).collect();
            let (mut engine, mut hosts, mut ledger) = open_text(&text, &changes);
            let before = engine.grain_energies().kinetic;
            engine.advance((0.1 / engine.time_step()) as u64, &mut hosts, &mut ledger).unwrap();
            let after = engine.grain_energies();
            assert!(after.rotational > 0.1 * before, "they turn: {} of {before}", after.rotational);
            (after.kinetic + after.rotational + after.elastic) / before - 1.0
        };
        let off = drift(None);
        assert!(off.abs() < 1e-3, "{off:e}");
        let off = drift(Some(5.0));
        assert!(off.abs() > 1e-3, "{off:e}");
    }
}

/// In the plane a square lies on its side by two corners and stands on one.
#[test]
fn a_square_rests_on_side_and_corner() {
    let half = 1.0 - ROUNDING;
    let unit = unit(half * 2.0_f64.sqrt());
    let side = "[[1, 1], [-1, 1], [-1, -1], [1, -1]]";
    let corner =
        "[[1.4142135623730951, 0], [0, 1.4142135623730951], [-1.4142135623730951, 0], [0, -1.4142135623730951]]";
    for (corners, height, bearing) in [(side, half, 2), (corner, half * 2.0_f64.sqrt(), 1)] {
        let shape = format!(
            "shape.polygon = {{ corners = {corners}, rounding = {ROUNDING}, thickness = 0.01, orientation = \"as-drawn\" }}"
        );
        let floor = "shape.plane = { point = [0, 0], normal = [0, 1] }";
        let open = |height: f64| {
            let start = format!("start.at = {{ position = [[0, {height:?}]] }}");
            open_text(&scene(&shape, &start, floor), &["dimension=2"])
        };
        let weight = mass(&*open(1.0).0) * 9.81;
        let rest = |bearing: i32| unit * (height + ROUNDING) - overlap(weight / f64::from(bearing), unit * ROUNDING);
        let carried = |engine: &dyn Engine| vectors(engine, "contact force")[0].z / weight;
        let (mut engine, mut hosts, mut ledger) = open(rest(bearing));
        assert!((carried(&*engine) - 1.0).abs() < 1e-6, "{bearing}: {}", carried(&*engine));
        engine.advance(3000, &mut hosts, &mut ledger).unwrap();
        assert!((carried(&*engine) - 1.0).abs() < 1e-3, "{bearing}: {}", carried(&*engine));
        assert!((carried(&*open(rest(3 - bearing)).0) - 1.0).abs() > 0.1);
    }
}

/// A crowd in a world that repeats itself: cubes, tetrahedra, spheres and clumps, with friction.
pub const CROWD: &str = r#"
dimension = 3
duration = "1 s"
gravity = 9.81
[dem]
largest-overlap = 0.5
[materials.wood]
young-modulus = "500 MPa"
poisson-ratio = 0.3
density = "700 kg/m^3"
restitution = 0.5
friction = 0.4
[particles.balls]
material = "wood"
count = 60
diameter = "3 mm"
start.random = { region = { low = ["-20 mm", "-20 mm", "2 mm"], high = ["20 mm", "20 mm", "110 mm"] }, velocity = [0, 0, -4], speed = 0.5 }
[particles.cubes]
material = "wood"
count = 120
diameter = "6 mm"
shape.polyhedron = { corners = [[-1, -1, -1], [1, -1, -1], [-1, 1, -1], [1, 1, -1], [-1, -1, 1], [1, -1, 1], [-1, 1, 1], [1, 1, 1]], rounding = 0.15 }
start.random = { region = { low = ["-20 mm", "-20 mm", "2 mm"], high = ["20 mm", "20 mm", "110 mm"] }, velocity = [0, 0, -4], speed = 0.5 }
[particles.pairs]
material = "wood"
count = 40
diameter = "4 mm"
shape.clump = { centre = [[-1, 0, 0], [1, 0, 0]], diameter = [2, 2] }
start.random = { region = { low = ["-20 mm", "-20 mm", "2 mm"], high = ["20 mm", "20 mm", "110 mm"] }, velocity = [0, 0, -4], speed = 0.5 }
[particles.tetrahedra]
material = "wood"
count = 120
diameter = "6 mm"
shape.polyhedron = { corners = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], rounding = 0.1 }
start.random = { region = { low = ["-20 mm", "-20 mm", "2 mm"], high = ["20 mm", "20 mm", "110 mm"] }, velocity = [0, 0, -4], speed = 0.5 }
[walls.floor]
material = "wood"
shape.plane = { point = [0, 0, 0], normal = [0, 0, 1] }
[periodic]
x = ["-20 mm", "20 mm"]
y = ["-20 mm", "20 mm"]
"#;

/// The same bits whoever computes, and after a resume; the books close. In space and in the plane.
#[test]
fn a_crowd_gives_the_same_bits_for_all() {
    let contacts = same_for_all(|| open_text(CROWD, &[]), [[6000, 4500], [7100, 3400]]);
    assert!(contacts > 30, "{contacts}");
    // Heavy, so that they have come together by then.
    let changes = ["gravity=400", "speed-scale=2", "dem.largest-overlap=1"];
    let run = |threads, resume| {
        hash(|| super::open("polygons", &changes), [4000, 3000], threads, resume, |engine, _, _| engine.contacts())
    };
    let ((alone, _), (other, contacts)) = (run(1, false), run(7, true));
    assert_eq!(alone, other);
    assert!(contacts > 2, "{contacts}");
}

/// What polyhedra cannot have yet is refused by name.
#[test]
fn what_polyhedra_cannot_have_is_refused() {
    let start = "start.at = { position = [[0, 0, \"6 mm\"]] }";
    let refused = |wall: &str, changes: &[&str], key: &str| {
        let text = scene(&shape(&cube(DVec3::ONE)), start, wall);
        let changes: Vec<String> = changes.iter().map(|change| (*change).to_owned()).collect();
        let scene = Scene::parse("dice", &text, std::path::Path::new("."), &changes).unwrap_or_else(|c| panic!("{c}"));
        let told = tsubu::methods::open(scene.plan(), &Hosts::default()).err().map(|error| error.to_string());
        assert!(told.as_ref().is_some_and(|told| told.contains(&format!("  {key}: "))), "{told:?}");
    };
    refused(FLOOR, &["dem.integrator=forward-euler"], "dem.integrator");
    refused(FLOOR, &["method=lattice"], "particles.dice.shape");
}
