//! Grains turn as they roll.

use super::open_text;
use tsubu_frame::{Frame, Kind, Values};

const SCENE: &str = r#"
dimension = 3
duration = "1 s"
[materials.glass]
young-modulus = "1 GPa"
density = "2500 kg/m^3"
restitution = 0.5
friction = 0.8
[particles.marble]
material = "glass"
diameter = "20 mm"
start.at = { position = [[0, 0, "10 mm"]], velocity = [["0.1 m/s", 0, 0]], spin = [[0, "10 rad/s", 0]] }
[walls.floor]
material = "glass"
shape.plane = { point = [0, 0, 0], normal = [0, 0, 1] }
[dem]
orientation = true
"#;

fn turned(frame: &Frame) -> [f64; 4] {
    match &frame.column(Kind::Grain, "orientation").unwrap().values {
        Values::Quaternion(q) => q[0],
        _ => panic!("no quaternion"),
    }
}

#[test]
fn a_rolling_sphere_turns_by_its_way_over_its_radius() {
    let (mut engine, mut hosts, mut ledger) = open_text(SCENE, &[]);
    assert_eq!(turned(&engine.frame(&hosts)), [1.0, 0.0, 0.0, 0.0]);
    let steps = (0.2 / engine.time_step()) as u64;
    engine.advance(steps, &mut hosts, &mut ledger).unwrap();
    let frame = engine.frame(&hosts);
    let [w, x, y, z] = turned(&frame);
    assert!((w * w + x * x + y * y + z * z - 1.0).abs() < 1e-14);
    assert_eq!((x, z), (0.0, 0.0));
    let way = frame.vectors(Kind::Grain, "position")[0][0];
    let angle = 2.0 * y.atan2(w);
    assert!(way > 0.019, "{way}");
    assert!((angle - way / 0.01).abs() < 2e-4 * angle, "turned by {angle}, rolled {way}");
}

#[test]
fn orientations_go_through_a_checkpoint_and_are_not_there_unasked() {
    let (mut engine, mut hosts, mut ledger) = open_text(SCENE, &[]);
    engine.advance(500, &mut hosts, &mut ledger).unwrap();
    let mut state = tsubu_frame::State::default();
    engine.save(&mut state);
    let (mut other, ..) = open_text(SCENE, &[]);
    other.load(&mut state).unwrap();
    assert_eq!(turned(&engine.frame(&hosts)), turned(&other.frame(&hosts)));
    let (without, hosts, _) = open_text(SCENE, &["dem.orientation=false"]);
    assert!(without.frame(&hosts).column(Kind::Grain, "orientation").is_none());
}

#[test]
fn walls_in_space_are_faces() {
    let drum = "[walls.drum]\nmaterial = \"glass\"\nshape.cylinder = { point = [0, -0.1, 0.2], axis = [0, 1, 0], radius = 0.2, length = 0.2 }\n";
    let text = SCENE.replace("[dem]", &format!("{drum}[dem]"));
    let (engine, hosts, _) = open_text(&text, &[]);
    let frame = engine.frame(&hosts);
    let (face, wall) = (frame.integers(Kind::Surface, "face"), frame.integers(Kind::Surface, "wall"));
    let corners = |n: i64| face.iter().zip(wall).filter(|(f, w)| **f == 1 && **w == n).count();
    assert_eq!((corners(0), corners(1)), (3 * 144, 3 * 2));
}
