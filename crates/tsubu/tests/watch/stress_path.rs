//! The stress path of a box of planes whose loads are known.

use super::{ball, on_wall, once, plan, scalar, view};
use glam::DVec3;
use tsubu::watch::open;
use tsubu_frame::State;
use tsubu_scene::Scene;

const PLANES: &str = "[walls.a]\nmaterial = \"glass\"\nshape.plane.normal = \"x\"\n\
                      [walls.b]\nmaterial = \"glass\"\nshape.plane = { point = [9, 0], normal = \"-x\" }\n\
                      [walls.c]\nmaterial = \"glass\"\nshape.plane.normal = \"z\"\n\
                      [walls.d]\nmaterial = \"glass\"\nshape.plane = { point = [0, 9], normal = \"-z\" }\n";

/// What the watch sees of one disc that all planes of a box of width and height press on.
fn pressed([width, height]: [f64; 2], [across, down]: [f64; 2]) -> tsubu::view::View<'static> {
    let balls = vec![ball(0.5 * width, 0.0, 0.5 * height, 1.0)];
    let on = |wall: usize, arm: DVec3, force: DVec3| {
        let overlap = 1.0 - arm.length();
        tsubu::view::Contact { second: wall, overlap, ..on_wall(&balls, 0, arm, force) }
    };
    let contacts = vec![
        on(0, DVec3::X * -0.5 * width, DVec3::X * across),
        on(1, DVec3::X * 0.5 * width, DVec3::X * -across),
        on(2, DVec3::Z * -0.5 * height, DVec3::Z * (down + 1.0)),
        on(3, DVec3::Z * 0.5 * height, DVec3::Z * -(down - 1.0)),
    ];
    view(&balls, contacts, [None; 3])
}

#[test]
fn stresses_and_strains_are_those_of_the_box() {
    let plan = plan(2, PLANES, "stress-path = {}");
    let mut path = open(&plan.watch["w"].measure, &plan);
    let nothing = once(&mut *path, &view(&[ball(1.0, 0.0, 1.0, 1.0)], Vec::new(), [None; 3]));
    assert!(scalar(&*path, &nothing, "porosity").is_nan());
    once(&mut *path, &pressed([1.8, 1.9], [5.0, 5.0]));
    // What the strains are told from goes with a checkpoint.
    let mut state = State::default();
    path.save("watch.w", &mut state);
    let mut path = open(&plan.watch["w"].measure, &plan);
    path.load("watch.w", &state).unwrap();
    let sample = once(&mut *path, &pressed([1.9, 1.6], [3.2, 11.4]));
    let told = |what: &str| scalar(&*path, &sample, what);
    let near = |what: &str, value: f64| assert!((told(what) - value).abs() < 1e-12, "{what}: {} {value}", told(what));
    // Forces over the lengths that they act on: 3.2 over 1.6, 11.4 over 1.9.
    near("stress x", 2.0);
    near("stress z", 6.0);
    near("mean stress", 4.0);
    near("deviator stress", 4.0);
    near("friction angle", 30.0);
    near("axial strain", (1.9_f64 / 1.6).ln());
    near("volume strain", (1.8 * 1.9 / (1.9 * 1.6_f64)).ln());
    near("porosity", 1.0 - std::f64::consts::PI / (1.9 * 1.6));
    // Along the other axis it is extended.
    let plan = super::plan(2, PLANES, "stress-path.axis = \"x\"");
    let mut other = open(&plan.watch["w"].measure, &plan);
    let sample = once(&mut *other, &pressed([1.9, 1.6], [3.2, 11.4]));
    assert!((scalar(&*other, &sample, "deviator stress") + 4.0).abs() < 1e-12);
}

#[test]
fn a_box_with_a_side_open_is_refused() {
    let told = |planes: &str, watch: &str| {
        let text = format!(
            "dimension = 2\nduration = 1\n{planes}[materials.glass]\nyoung-modulus = 1e7\ndensity = 2500\n[watch.w]\n{watch}\n"
        );
        Scene::parse("test", &text, std::path::Path::new("."), &[]).map(|_| ()).map_err(|error| error.to_string())
    };
    assert_eq!(told(PLANES, "stress-path = {}"), Ok(()));
    for planes in
        [PLANES.replace("normal = \"-z\"", "normal = \"x\""), PLANES.replace("normal = \"-z\"", "normal = [1, -1]")]
    {
        let told = told(&planes, "stress-path = {}").unwrap_err();
        assert!(told.contains("has no box of planes to look at"), "{told}");
    }
    assert!(told(PLANES, "stress-path.axis = \"y\"").unwrap_err().contains("no y to look along"));
}
