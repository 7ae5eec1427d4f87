//! What models on lattices leave out of a scene they tell, and what would make nonsense they refuse.

use crate::dem::open_text;
use tsubu::methods;
use tsubu::partner::Hosts;
use tsubu_scene::Scene;

/// Six balls in a box.
const BALLS: &str = r#"
gravity = 10
duration = "20 ms"
[materials.a]
young-modulus = "5 MPa"
restitution = 0.75
density = 1200
[particles.g]
material = "a"
diameter = "6 mm"
count = 6
start.rows = {}
[walls.box]
material = "a"
shape.box = { width = "40 mm", height = "40 mm" }
"#;

/// What is told of the scene, as `key: text`, or why it is refused.
fn told(method: &str, changes: &[&str]) -> String {
    told_of(BALLS, method, changes)
}

fn told_of(text: &str, method: &str, changes: &[&str]) -> String {
    let changes: Vec<String> =
        changes.iter().map(|change| (*change).to_owned()).chain([format!("method={method}")]).collect();
    let scene = Scene::parse("test", text, std::path::Path::new("."), &changes).unwrap_or_else(|c| panic!("{c}"));
    match methods::open(scene.plan(), &Hosts::new(&scene.plan().hosts)) {
        Ok(engine) => {
            engine.notes().iter().map(|note| format!("{}: {}", note.key, note.text)).collect::<Vec<_>>().join("\n")
        }
        Err(error) => error.to_string(),
    }
}

/// Gravity that points up made grains fall down, or steps of no length.
#[test]
fn gravity_that_a_lattice_has_not_is_refused() {
    for gravity in ["gravity=-9.8", "gravity=[9.8, 0]", "gravity=[1, 0]"] {
        assert!(
            told("after-savage", &[gravity]).contains("gravity: the lattice has gravity that may lean"),
            "{gravity}"
        );
    }
    assert!(!told("after-savage", &["gravity=[3, -9]"]).contains("gravity: "));
    assert!(told("litwiniszyn", &["gravity=[3, -9]"]).contains("gravity: the lattice has gravity along -z"));
    assert!(!told("fhp", &["gravity=[9.8, 0]", "duration=1 s"]).contains("gravity: the"));
    assert!(told("after-savage", &["after-savage.up=0.9"]).contains("after-savage.up: 0.9 is more than"));
}

/// Sizes, spacings, velocities of files and round regions were dropped without a word.
#[test]
fn what_sites_cannot_have_is_told() {
    let sizes = BALLS.replace("diameter = \"6 mm\"", "size.uniform = { smallest = \"2 mm\", largest = \"6 mm\" }");
    for method in ["after-savage", "gutt-haff", "fhp"] {
        let text = told_of(&sizes, method, &["duration=1 s"]);
        assert!(text.contains("particles.g.size: all grains of this group get its mean diameter"), "{method}: {text}");
        let text = told(method, &["duration=1 s"]);
        assert!(text.contains("particles.g.start.rows: filled site by site"), "{method}: {text}");
    }
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("g.csv"), "x [m],z [m],vx [m/s]\n0,0.02,1\n").unwrap();
    let file = BALLS.replace("count = 6\nstart.rows = {}", "start.file = { path = \"g.csv\" }");
    let changes = ["method=litwiniszyn".to_owned()];
    let scene = Scene::parse("test", &file, folder.path(), &changes).unwrap();
    let engine = methods::open(scene.plan(), &Hosts::default()).unwrap();
    assert!(engine.notes().iter().any(|note| note.key == "particles.g.start.file" && note.text.contains("at rest")));
}

/// A sphere as a region was taken for its box.
#[test]
fn round_regions_are_round_on_sites_too() {
    let ball = BALLS
        .replace("diameter = \"6 mm\"\ncount = 6", "diameter = \"2 mm\"\ncount = 60")
        .replace("start.rows = {}", "start.rows = { region = { sphere = { centre = [0, 0.02], radius = 0.012 } } }");
    for method in ["litwiniszyn", "after-savage", "gutt-haff"] {
        let (engine, ..) = open_text(&ball, &[&format!("method={method}")]);
        let seen = engine.view(tsubu::view::Wants::GRAINS);
        let farthest = seen.grains.position.iter().map(|p| p.x.hypot(p.z - 0.02)).fold(0.0, f64::max);
        assert!(farthest < 0.0121, "{method}: {farthest}");
    }
}

/// A ball of a gram and one of a hundred exchanged the same velocity: energy came from nowhere. All have the mean mass, and it is told.
#[test]
fn lattice_grains_are_equals() {
    let two = r#"
        gravity = 10
        duration = "1 s"
        method = "gutt-haff"
        [materials.a]
        young-modulus = "5 MPa"
        restitution = 1
        [particles.heavy]
        material = "a"
        diameter = "10 mm"
        mass = "100 g"
        start.at.position = [[0, 0.005]]
        [particles.light]
        material = "a"
        diameter = "10 mm"
        mass = "1 g"
        start.at.position = [[0, 0.05]]
        [walls.box]
        material = "a"
        shape.box = { width = "60 mm", height = "100 mm" }
    "#;
    assert!(told_of(two, "gutt-haff", &[]).contains("all have the mean mass, 5.050e-2 kg"));
    let (mut engine, mut hosts, mut ledger) = open_text(two, &[]);
    let energy = |engine: &dyn tsubu::engine::Engine| {
        let all = engine.grain_energies();
        all.kinetic + all.potential
    };
    let begun = energy(&*engine);
    for _ in 0..200 {
        engine.advance(5, &mut hosts, &mut ledger).unwrap();
        assert!(energy(&*engine) < 1.001 * begun, "{} of {begun}", energy(&*engine));
    }
}

/// Of the damper automaton: dashpots that know no restitution were taken for it, pairs of two materials for one, and a start that is refused
/// had all balls missing beside.
#[test]
fn the_damper_tells_what_it_leaves_out() {
    for damping in ["none={}", "rate={rate=10}", "dashpot={coefficient=1}", "viscoelastic={coefficient=1}"] {
        let text = told("lattice", &[&format!("contact.damping.{damping}")]);
        assert!(
            text.contains("contact.damping: the automaton's balls rebound by the restitution"),
            "{damping}: {text}"
        );
    }
    assert!(!told("lattice", &["contact.damping.sqrt={}"]).contains("contact.damping"));
    let pair = format!(
        "{BALLS}\n[materials.b]\nyoung-modulus = \"5 MPa\"\nrestitution = 0.75\ndensity = 1200\n[particles.h]\nmaterial = \"b\"\n\
         diameter = \"6 mm\"\ncount = 3\nstart.rows = {{}}\n[[material-pair]]\nbetween = [\"a\", \"b\"]\nrestitution = 0.1\n"
    );
    let text = told_of(&pair, "lattice", &[]);
    assert!(text.contains("particles.h.material: its restitution differs"), "{text}");
    let text = told_of(&BALLS.replace("start.rows = {}", "start.random = {}"), "lattice", &[]);
    assert!(text.contains("the automaton fills its box by") && !text.contains("do not fit"), "{text}");
}
