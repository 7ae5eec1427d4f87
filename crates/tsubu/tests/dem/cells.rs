//! Grains of cells: the same by DEM and by CL-CA, and bodies that do not turn.

use super::{hash, open_text};
use glam::DVec3;
use tsubu::engine::Engine;
use tsubu::view::{Contacts, Wants};

/// Rods of five cells, and hooks, which have a bay.
const MIXED: &str = r#"
duration = 1
gravity = "10 m/s^2"
speed-scale = "1 m/s"
[materials.m]
density = 2000
young-modulus = "100 MPa"
restitution = 0.3
friction = 0.4
[particles.hooks]
material = "m"
count = 6
start.random.region = { low = [0, 0], high = ["30 mm", "60 mm"] }
shape.cells = { outline.points.at = [[0, 0], [0, 2], [0, 4], [1, 5], [2, 4]], spacing = "1 mm", thickness = "10 mm" }
[particles.rods]
material = "m"
count = 12
start.random.region = { low = [0, 0], high = ["30 mm", "60 mm"] }
shape.cells = { outline.points.at = [[0, 0], [1, 1], [2, 2], [3, 3], [4, 4]], spacing = "1 mm", thickness = "10 mm", ORIENTATION }
[walls.box]
material = "m"
shape.box = { width = "30 mm", height = "60 mm", floor-centre = ["15 mm", 0] }
[dem]
largest-overlap = 0.4
"#;

fn mixed(orientation: &str) -> String {
    MIXED.replace("ORIENTATION", &format!("orientation = \"{orientation}\""))
}

fn long(engine: &dyn Engine, group: u32) -> Vec<DVec3> {
    let view = engine.view(Wants { bodies: true, ..Wants::GRAINS });
    view.bodies.iter().filter(|body| view.grains.group[body.grain] == group).map(|body| body.long).collect()
}

/// As many bodies, of the same mass, which lie as they are drawn, or by CL-CA in all six directions; what has no cells is refused by its name.
#[test]
fn both_methods_have_the_same_bodies() {
    let drawn = DVec3::new(0.75_f64.sqrt(), 0.0, 0.5);
    let mut masses = Vec::new();
    for method in ["method=dem", "method=cl-ca"] {
        let (engine, _, _) = open_text(&mixed("as-drawn"), &[method]);
        let rods = long(&*engine, 1);
        assert_eq!((rods.len(), long(&*engine, 0).len()), (12, 6), "{method}");
        assert!(rods.iter().all(|along| along.dot(drawn).abs() > 1.0 - 1e-12), "{method}: {rods:?}");
        masses.push(engine.view(Wants::GRAINS).grains.mass.iter().sum::<f64>());
        let (engine, _, _) = open_text(&mixed("random"), &[method]);
        let off = long(&*engine, 1).iter().filter(|along| along.dot(drawn).abs() < 0.9).count();
        assert!(off > 3, "{method}: {off}");
    }
    assert!((masses[0] / masses[1] - 1.0).abs() < 1e-12, "{masses:?}");
    let scene = tsubu_scene::Scene::parse(
        "test",
        &mixed("random"),
        std::path::Path::new("."),
        &["method=gutt-haff".to_owned()],
    );
    let plan = scene.expect("a scene").plan().clone();
    let refused = tsubu::methods::open(&plan, &tsubu::partner::Hosts::default()).err().map(|error| error.to_string());
    assert!(refused.is_some_and(|text| text.contains("`cl-ca` and `dem` compute them")));
}

/// Hexagons of 7 cells that stand beside each other on the lattice touch by a side without force; a hundredth of a spacing nearer they overlap
/// by the share of it that is across the side.
#[test]
fn neighbours_on_the_lattice_just_touch() {
    // From one to the next in a pavement of them: [1, 5], sqrt(7) spacings long; the normal of the side between is along [1, 3].
    let (way, normal) = (DVec3::new(0.75_f64.sqrt(), 0.0, 2.5), DVec3::new(0.5, 0.0, 0.75_f64.sqrt()));
    for (near, expected) in [(1e-9, 0.0), (-0.01, 0.01 * way.normalize().dot(normal))] {
        let second = way * (1.0 + near / way.length()) * 1e-3;
        let text = format!(
            "duration = 1\ngravity = 0\n[materials.m]\ndensity = 2000\nyoung-modulus = 1e8\n[particles.g]\nmaterial = \"m\"\n\
             start.at.position = [[0, 0], [{}, {}]]\n\
             shape.cells = {{ outline.hexagon.radius = 1, spacing = 1e-3, thickness = 0.01, orientation = \"as-drawn\" }}\n",
            second.x, second.z
        );
        let (engine, _, _) = open_text(&text, &["method=dem", "dem.largest-overlap=0.4"]);
        let view = engine.view(Wants { contacts: Contacts::Forces, ..Wants::GRAINS });
        let deepest = view.contacts.iter().map(|contact| contact.overlap).fold(0.0, f64::max) * 1e3;
        assert!((deepest - expected).abs() < 1e-6, "{near}: {deepest}, {expected}");
    }
}

/// Bodies that do not turn keep their axes to the bit while they fall on each other and on the ground, and the books close; those that turn do not.
#[test]
fn bodies_that_do_not_turn_keep_their_axes() {
    let run = |rotation: &str| {
        let (mut engine, mut hosts, mut ledger) = open_text(&mixed("random"), &["method=dem", rotation]);
        let before = long(&*engine, 1);
        let steps = (0.2 / engine.time_step()) as u64;
        engine.advance(steps, &mut hosts, &mut ledger).expect("it runs");
        let residual = ledger.residual_relative(&tsubu::engine::energies(&*engine, &hosts));
        (before == long(&*engine, 1), engine.grain_energies().rotational, residual)
    };
    let (kept, rotational, residual) = run("contact.rotation=false");
    assert!(kept && rotational == 0.0 && residual.abs() < 2e-3, "{kept} {rotational} {residual}");
    let (kept, _, residual) = run("contact.rotation=true");
    assert!(!kept && residual.abs() < 2e-3, "{kept} {residual}");
}

/// Same bits at any number of threads and after a resume, with and without turning.
#[test]
fn cells_have_the_same_bits() {
    for rotation in ["contact.rotation=true", "contact.rotation=false"] {
        let open = || open_text(&mixed("random"), &["method=dem", rotation]);
        let bits = |threads, resume| hash(open, [900, 700], threads, resume, |_, _, _| ()).0;
        let [one, two, seven] = [(1, false), (2, true), (7, false)].map(|(threads, resume)| bits(threads, resume));
        assert!(one == two && one == seven, "{rotation}");
    }
}
