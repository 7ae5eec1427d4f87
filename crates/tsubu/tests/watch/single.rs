//! Single contacts, single faces of a box, single grains of a group, and the ends between which a number was.

use super::{GROUPS, ball, column, on_wall, once, plan, scalar, touching, view, watch};
use crate::dem::open_text;
use glam::DVec3;
use tsubu::view::Contact;
use tsubu::watch::{Watches, open};
use tsubu_frame::{ResultValue, Summary};
use tsubu_scene::Scene;

const BOX: &str = "[walls.a]\nmaterial = \"glass\"\nshape.box = { width = 4, height = 4 }\n\
                   [walls.b]\nmaterial = \"glass\"\nshape.plane = { point = [0, -9], normal = \"z\" }\n";

/// Two balls that touch in the corner of a box; forces on the first body of each pair.
fn corner() -> (Vec<super::Ball>, Vec<Contact>) {
    let balls = vec![ball(-1.5, 0.0, 0.5, 0.5), ball(-0.5, 0.0, 0.5, 0.5)];
    let mut contacts = touching(&balls, [None; 3], 7.0);
    contacts.push(on_wall(&balls, 0, DVec3::X * -0.5, DVec3::X * 7.0));
    contacts.push(on_wall(&balls, 0, DVec3::Z * -0.5, DVec3::Z * 3.0));
    contacts.push(on_wall(&balls, 1, DVec3::Z * -0.5, DVec3::Z * 2.0));
    (balls, contacts)
}

/// Who touches whom could be seen in frames alone.
#[test]
fn contacts_are_listed_one_by_one() {
    let (balls, contacts) = corner();
    let mut list = watch(2, "contacts = {}");
    let sample = once(&mut *list, &view(&balls, contacts.clone(), [None; 3]));
    assert_eq!(scalar(&*list, &sample, "contacts"), 4.0);
    assert_eq!(scalar(&*list, &sample, "largest force"), 7.0);
    assert_eq!(column(&*list, &sample, "first"), [0.0, 0.0, 0.0, 1.0]);
    assert_eq!(column(&*list, &sample, "wall"), [1.0, 1.0, 0.0, 1.0]);
    // The pair: the first is pushed to the left.
    assert_eq!(column(&*list, &sample, "force x")[2], -7.0);
    assert_eq!(column(&*list, &sample, "normal x")[2], 1.0);
    let mut inner = watch(2, "contacts.walls = false");
    let sample = once(&mut *inner, &view(&balls, contacts, [None; 3]));
    assert_eq!(column(&*inner, &sample, "second"), [1.0]);
}

/// The load on a box was that on all its faces, which may cancel.
#[test]
fn a_face_of_a_box_has_a_load_of_its_own() {
    let (balls, contacts) = corner();
    let of = |face: &str| {
        let plan =
            plan(2, BOX, &format!("wall-load = {{ wall = \"a\", face = \"{face}\", area = 2, direction = \"-z\" }}"));
        let mut load = open(&plan.watch["w"].measure, &plan);
        let sample = once(&mut *load, &view(&balls, contacts.clone(), [None; 3]));
        ["force x", "force z", "pressure"].map(|what| scalar(&*load, &sample, what))
    };
    assert_eq!(of("left"), [-7.0, 0.0, 0.0]);
    assert_eq!(of("floor"), [0.0, -5.0, 2.5]);
    assert_eq!(of("lid"), [0.0, 0.0, 0.0]);
    let refused = |watch: &str| {
        let text = format!(
            "dimension = 2\nduration = 1\n{BOX}[materials.glass]\nyoung-modulus = 1e7\ndensity = 2500\n[watch.w]\n{watch}\n"
        );
        Scene::parse("test", &text, std::path::Path::new("."), &[]).unwrap_err().to_string()
    };
    let told = refused("wall-load = { wall = \"b\", face = \"floor\" }");
    assert!(told.contains("has no `face` of its own"), "{told}");
    let told = refused("wall-load = { wall = \"a\", face = \"back\" }");
    assert!(told.contains("no back"), "{told}");
}

/// Numbers of grains among all shift with the names of the groups; those in a group do not.
#[test]
fn grains_are_tracked_by_their_number_in_a_group() {
    let more = "[particles.0-rain]\nmaterial = \"glass\"\ndiameter = 1\ncount = 3\n\
                start.stream = { region = { low = [0, 50], high = [9, 60] }, rate = 1 }\n";
    let plan = plan(2, &format!("{more}{GROUPS}"), "track = { ids = [0], group = \"b\" }");
    let mut track = open(&plan.watch["w"].measure, &plan);
    let sample = once(&mut *track, &view(&[ball(0.0, 0.0, 0.0, 0.5), ball(5.0, 0.0, 0.0, 0.5)], Vec::new(), [None; 3]));
    assert_eq!(scalar(&*track, &sample, "position x"), 5.0);
    // Grains of streams come after all others, whatever their names are.
    assert_eq!(["a", "b", "0-rain"].map(|name| plan.first_of(name)), [0, 1, 2]);
}

/// A depth that is reached on the way was lost: watches told means and the last value.
#[test]
fn the_ends_between_which_a_number_was_are_results() {
    let text = r#"
duration = "0.5 s"
[materials.glass]
young-modulus = "5 MPa"
density = "2500 kg/m^3"
restitution = 0.9
[particles.ball]
material = "glass"
diameter = "10 mm"
start.at = { position = [[0, 0.105]] }
[walls.floor]
material = "glass"
shape.plane = { point = [0, 0], normal = "z" }
[watch.ball]
every = "step"
track.ids = [0]
"#;
    let (mut engine, mut hosts, mut ledger) = open_text(text, &[]);
    let scene = Scene::parse("test", text, std::path::Path::new("."), &[]).unwrap();
    let mut watches = Watches::new(scene.plan(), &*engine);
    for _ in 0..(0.4 / engine.time_step()) as usize {
        watches.look(&*engine, &hosts).unwrap();
        engine.advance(1, &mut hosts, &mut ledger).unwrap();
    }
    let mut summary = Summary::default();
    watches.results(&mut summary, true);
    let number = |what: &str| match summary.results.get(&format!("ball position z {what}")) {
        Some(ResultValue::Number(value)) => *value,
        other => panic!("{what}: {other:?}"),
    };
    // It falls by h = 100 mm and sinks in until all is in the contact: m g h = 8/15 E* sqrt(R) d^(5/2) (Hertz), which damping
    // makes a little less.
    assert!((number("largest") - 0.105).abs() < 1e-12);
    let (mass, modulus) = (2500.0 * std::f64::consts::PI / 6.0 * 1e-6, 5e6 / (2.0 * (1.0 - 0.3 * 0.3)));
    let sunk = (15.0 * mass * 9.81 * 0.1 / (8.0 * modulus * 0.005_f64.sqrt())).powf(0.4);
    let depth = 0.005 - number("least");
    assert!(depth > 0.9 * sunk && depth < 1.01 * sunk, "{depth} {sunk}");
    assert!(number("final") > number("least") && number("final") < number("largest"));
}
