//! Grains find room among walls of every shape and among grains that are there.

use super::open_text;
use tsubu::engine::Engine;
use tsubu_frame::{Frame, Kind, Values};

const MATERIAL: &str = "
dimension = 3
duration = \"0.1 s\"
[materials.glass]
young-modulus = \"10 MPa\"
density = \"2500 kg/m^3\"
";

const DRUM: &str = r#"
[walls.drum]
material = "glass"
shape.cylinder = { point = [0, -0.05, 0], axis = [0, 1, 0], radius = 0.05, length = 0.1 }
"#;

/// A room that reaches over the corners of the drum.
const ROOM: &str = "region = { low = [-0.05, -0.05, -0.05], high = [0.05, 0.05, 0.05] }";

fn vectors(frame: &Frame, name: &str) -> Vec<[f64; 3]> {
    match &frame.column(Kind::Grain, name).unwrap().values {
        Values::Vector(v) => v.clone(),
        _ => panic!("{name} is no vector"),
    }
}

fn positions(engine: &dyn Engine) -> Vec<[f64; 3]> {
    vectors(&engine.frame(&tsubu::partner::Hosts::default()), "position")
}

fn from_axis(p: &[f64; 3]) -> f64 {
    p[0].hypot(p[2])
}

#[test]
fn random_grains_stay_within_a_drum() {
    let grains = format!(
        "[particles.beads]\nmaterial = \"glass\"\ncount = 400\ndiameter = \"6 mm\"\nstart.random = {{ {ROOM} }}\n"
    );
    let (engine, ..) = open_text(&format!("{MATERIAL}{grains}{DRUM}"), &[]);
    assert_eq!(engine.grains(), 400);
    assert_eq!(engine.contacts(), 0);
    let places = positions(&*engine);
    assert!(places.iter().all(|p| from_axis(p) < 0.047), "some are outside the drum or in its wall");
    // Without the drum some would be in the corners: the room alone does not keep them in.
    let (free, ..) = open_text(&format!("{MATERIAL}{grains}"), &[]);
    assert!(positions(&*free).iter().any(|p| from_axis(p) > 0.05));
}

#[test]
fn an_obstacle_in_a_room_is_gone_round() {
    let scene = format!(
        "{MATERIAL}[particles.beads]\nmaterial = \"glass\"\ncount = 400\ndiameter = \"6 mm\"\nstart.random = {{ {ROOM} }}\n\
         [walls.ball]\nmaterial = \"glass\"\nshape.sphere = {{ centre = [0, 0, 0], radius = 0.02 }}\n"
    );
    let (engine, ..) = open_text(&scene, &[]);
    let away = |p: &[f64; 3]| p.iter().map(|x| x * x).sum::<f64>().sqrt();
    assert!(positions(&*engine).iter().all(|p| away(p) > 0.023));
}

/// Rows went through whatever stood in the box, and the run ended in its first step with a word about neighbours.
#[test]
fn rows_go_round_what_stands_in_the_box() {
    let ball = "[walls.ball]\nmaterial = \"glass\"\nshape.sphere = { centre = [0, 0, 0.05], radius = 0.02 }\n";
    let scene = |count: usize, ball: &str| {
        format!(
            "{MATERIAL}[particles.beads]\nmaterial = \"glass\"\ncount = {count}\ndiameter = \"6 mm\"\nstart.rows = {{}}\n\
             [walls.box]\nmaterial = \"glass\"\nshape.box = {{ width = 0.08, depth = 0.08, height = 0.1 }}\n{ball}"
        )
    };
    let (engine, ..) = open_text(&scene(1500, ball), &[]);
    let from_ball = |p: &[f64; 3]| p[0].hypot(p[1]).hypot(p[2] - 0.05);
    assert_eq!(engine.grains(), 1500);
    assert!(positions(&*engine).iter().all(|p| from_ball(p) > 0.02299));
    // Without the ball some are where it stood, and all stand where they always did.
    let (free, ..) = open_text(&scene(1500, ""), &[]);
    assert!(positions(&*free).iter().any(|p| from_ball(p) < 0.017));
    assert_eq!(positions(&*free)[..300], positions(&*engine)[..300]);
    // Too many for what the ball leaves.
    let scene = tsubu_scene::Scene::parse("test", &scene(2160, ball), std::path::Path::new("."), &[]).unwrap();
    let wrong =
        tsubu::methods::open(scene.plan(), &tsubu::partner::Hosts::default()).err().expect("no room").to_string();
    assert!(wrong.contains("particles.beads.start.rows") && wrong.contains("of 2160 grains only"), "{wrong}");
}

/// Rows of five in a box five grains wide touch, and the walls hold the columns upright; but no two seeds give the same bed, so
/// that what is shaken in it goes its own way with each.
#[test]
fn a_box_that_is_full_to_the_walls_has_another_bed_with_every_seed() {
    let bed = |start: &str, seed: u32| {
        let scene = format!(
            "seed = {seed}\n{MATERIAL}[particles.beads]\nmaterial = \"glass\"\ncount = 225\ndiameter = \"6 mm\"\nstart.{start}\n\
             [walls.box]\nmaterial = \"glass\"\nshape.box = {{ width = \"30 mm\", depth = \"30 mm\", height = \"64 mm\" }}\n"
        );
        positions(&*open_text(&scene, &[]).0)
    };
    let (one, two) = (bed("settled = {}", 1), bed("settled = {}", 2));
    let apart = one.iter().zip(&two).filter(|(a, b)| (0..3).any(|k| (a[k] - b[k]).abs() > 1e-8)).count();
    assert_eq!(apart, 225);
    // Rows that do not fall are the same with every seed.
    assert_eq!(bed("rows = { spacing = 1, jitter = 0.9 }", 1), bed("rows = { spacing = 1, jitter = 0.9 }", 2));
}

#[test]
fn a_stream_keeps_clear_of_a_mesh() {
    let folder = tempfile::tempdir().unwrap();
    // A tilted sheet across the middle of the region.
    let sheet = "v -0.06 -0.06 -0.02\nv 0.06 -0.06 0.02\nv 0.06 0.06 0.02\nv -0.06 0.06 -0.02\nf 1 2 3\nf 1 3 4\n";
    std::fs::write(folder.path().join("sheet.obj"), sheet).unwrap();
    let scene = format!(
        "gravity = [0, 0, 0]\n{MATERIAL}[particles.beads]\nmaterial = \"glass\"\ncount = 300\ndiameter = \"6 mm\"\n\
         start.stream = {{ {ROOM}, rate = 100000 }}\n\
         [walls.sheet]\nmaterial = \"glass\"\nshape.mesh = {{ path = \"sheet.obj\" }}\n"
    );
    let scene = tsubu_scene::Scene::parse("test", &scene, folder.path(), &[]).unwrap_or_else(|c| panic!("{c}"));
    let mut hosts = tsubu::partner::Hosts::default();
    let mut engine = tsubu::methods::open(scene.plan(), &hosts).unwrap();
    let mut ledger = tsubu::ledger::Ledger::open(tsubu::engine::energies(&*engine, &hosts), engine.momentum());
    while engine.grains() < 300 {
        engine.advance(50, &mut hosts, &mut ledger).unwrap();
        assert_eq!(engine.contacts(), 0, "a grain came into the sheet");
    }
    let normal = [-0.04 / (0.04f64.hypot(0.12)), 0.12 / (0.04f64.hypot(0.12))];
    let height = |p: &[f64; 3]| (p[0] * normal[0] + p[2] * normal[1]).abs();
    assert!(positions(&*engine).iter().all(|p| height(p) > 0.003 - 1e-12));
}

#[test]
fn random_grains_find_room_among_frozen_ones_of_any_name() {
    let scene = format!(
        "{MATERIAL}[particles.a-loose]\nmaterial = \"glass\"\ncount = 500\ndiameter = \"6 mm\"\nstart.random = {{ {ROOM} }}\n\
         [particles.z-rough]\nmaterial = \"glass\"\ncount = 400\ndiameter = \"5 mm\"\nmotion.frozen = {{}}\n\
         start.rows = {{ region = {{ low = [-0.05, -0.05, -0.05], high = [0.05, 0.05, 0] }} }}\n"
    );
    let (engine, ..) = open_text(&scene, &[]);
    assert_eq!((engine.grains(), engine.contacts()), (900, 0));
}

#[test]
fn speeds_in_a_file_are_for_free_grains() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("bed.csv"), "x,y,z,diameter,vx\n0,0,0,0.006,1\n0.01,0,0,0.006,2\n").unwrap();
    for (motion, speed) in [("free = {}", 2.0), ("frozen = {}", 0.0)] {
        let scene = format!(
            "{MATERIAL}[particles.bed]\nmaterial = \"glass\"\nmotion.{motion}\nstart.file = {{ path = \"bed.csv\" }}\n"
        );
        let scene = tsubu_scene::Scene::parse("test", &scene, folder.path(), &[]).unwrap_or_else(|c| panic!("{c}"));
        let hosts = tsubu::partner::Hosts::default();
        let engine = tsubu::methods::open(scene.plan(), &hosts).unwrap();
        assert_eq!(vectors(&engine.frame(&hosts), "velocity")[1][0], speed, "{motion}");
    }
}

/// The time step came from the mean diameter of a file, not from its smallest grain.
#[test]
fn the_smallest_grain_of_a_file_sets_the_time_step() {
    let folder = tempfile::tempdir().unwrap();
    let step = |small: &str, large: &str| {
        let text = format!("x,y,z,diameter\n0,0,0,{small}\n0.02,0,0,{large}\n");
        std::fs::write(folder.path().join("bed.csv"), text).unwrap();
        let scene = format!(
            "gravity = 0\n{MATERIAL}[particles.bed]\nmaterial = \"glass\"\nstart.file = {{ path = \"bed.csv\" }}\n"
        );
        super::run_text(&scene, folder.path(), &[]).0.time_step()
    };
    // The time of a contact goes with the diameter.
    assert!((step("0.002", "0.01") * 3.0 / step("0.006", "0.006") - 1.0).abs() < 1e-9);
}

/// Grains of every kind of start lie wholly in a cylinder or a sphere that is their region; its box alone would not keep them there.
#[test]
fn grains_begin_wholly_in_a_round_region() {
    let bar = "region.cylinder = { point = [0, 0, -0.04], axis = \"z\", radius = 0.04, length = 0.08 }";
    let ball = "region.sphere.radius = 0.04";
    let boxed = "region = { low = [-0.04, -0.04, -0.04], high = [0.04, 0.04, 0.04] }";
    let in_bar = |p: &[f64; 3]| p[0].hypot(p[1]) <= 0.037 + 1e-12 && p[2].abs() <= 0.037 + 1e-12;
    let in_ball = |p: &[f64; 3]| p.iter().map(|x| x * x).sum::<f64>().sqrt() <= 0.037 + 1e-12;
    for start in ["rows", "random"] {
        let scene = |region: &str| {
            format!(
                "{MATERIAL}[particles.beads]\nmaterial = \"glass\"\ncount = 250\ndiameter = \"6 mm\"\nstart.{start} = {{ {region} }}\n"
            )
        };
        let places = |region: &str| positions(&*open_text(&scene(region), &[]).0);
        assert!(places(bar).iter().all(in_bar), "{start}");
        assert!(places(ball).iter().all(in_ball), "{start}");
        // The control.
        assert!(!places(boxed).iter().all(in_bar), "{start}");
    }
}

/// Too many for the sphere, though its box would hold them: refused with the number that fits.
#[test]
fn a_round_region_that_is_too_small_says_how_many_fit() {
    let text = format!(
        "{MATERIAL}[particles.beads]\nmaterial = \"glass\"\ncount = 500\ndiameter = \"6 mm\"\nstart.rows = {{ region.sphere.radius = 0.03 }}\n"
    );
    let scene =
        tsubu_scene::Scene::parse("test", &text, std::path::Path::new("."), &[]).unwrap_or_else(|c| panic!("{c}"));
    let wrong = tsubu::methods::open(scene.plan(), &tsubu::partner::Hosts::default())
        .err()
        .map(|wrong| wrong.to_string())
        .unwrap();
    assert!(wrong.contains("room for") && wrong.contains("of 500 grains only"), "{wrong}");
}
