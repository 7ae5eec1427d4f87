//! Scenes become units, and units move, seen from Rust; `test_unit.py` sees them as a tool does.

use std::collections::BTreeSet;
use std::fs;
use std::io::{Cursor, Read};
use std::path::{Path, PathBuf};
use tsubu_fmu::description::{About, Version, describe};
use tsubu_fmu::instance::{Instance, Mode};
use tsubu_fmu::moving::Motion;
use tsubu_fmu::pack::{archive, prepare, token};
use tsubu_fmu::variables::{Causality, UNITS, variables};
use tsubu_scene::Scene;
use zip::ZipArchive;

fn scene(name: &str, changes: &[&str]) -> Scene {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/scenes").join(name);
    let changes: Vec<String> = changes.iter().map(|change| (*change).to_owned()).collect();
    Scene::read(&path, &changes).expect("a scene")
}

/// The description is XML of the variables, each with the value reference that is its place, whatever the names of hosts are.
#[test]
fn the_description_is_that_of_the_variables() {
    let text = scene("ball.toml", &[]).text().replace("hosts.casing", "hosts.\"a <b> & 'c'\"");
    let text = text.replace("host = \"casing\"", "host = \"a <b> & 'c'\"");
    let scene = Scene::parse("ball.toml", &text, Path::new("."), &[]).expect("a scene");
    let variables = variables(scene.plan());
    for (version, element) in [(Version::Three, ["Float64", "Boolean"]), (Version::Two, ["ScalarVariable"; 2])] {
        let about = About { version, plan: scene.plan(), token: "t", time_step: 1e-5, step: 1e-4 };
        let xml = describe(&about);
        let document = roxmltree::Document::parse(&xml).expect("XML");
        let told: Vec<_> = document.descendants().filter(|node| element.contains(&node.tag_name().name())).collect();
        let told: Vec<_> = told.into_iter().filter(|node| node.has_attribute("name")).collect();
        assert_eq!(told.len(), variables.len());
        for ((at, variable), node) in variables.iter().enumerate().zip(told) {
            assert_eq!(node.attribute("name"), Some(variable.name.as_str()));
            assert_eq!(node.attribute("valueReference"), Some(at.to_string().as_str()));
        }
        let root = document.root_element();
        assert_eq!(root.attribute("modelName"), Some("One ball & a <shaken> casing"));
    }
    assert_eq!(variables[1].name, "a <b> & 'c'.base.displacement");
    let names: BTreeSet<&str> = variables.iter().map(|variable| variable.name.as_str()).collect();
    assert_eq!(names.len(), variables.len());
    let known = |unit: &str| unit.is_empty() || UNITS.iter().any(|(name, _)| *name == unit);
    assert!(variables.iter().all(|variable| known(variable.unit)));
}

/// The archive holds what a tool looks for, the scene in it means what was packed, and the same scene makes the same bytes.
#[test]
fn the_archive_is_whole() {
    let scene = scene("ball.toml", &[]);
    let pack = || archive(&scene, Some(1e-3), Version::Three, b"code").expect("an archive");
    let bytes = pack();
    assert_eq!(bytes, pack());
    let mut archive = ZipArchive::new(Cursor::new(bytes)).expect("a zip");
    let mut text = |name: &str| {
        let mut text = String::new();
        archive.by_name(name).expect(name).read_to_string(&mut text).expect("text");
        text
    };
    let library = format!("binaries/{}/tsubu{}", Version::Three.platform(), std::env::consts::DLL_SUFFIX);
    assert_eq!(text(&library), "code");
    let (xml, packed) = (text("modelDescription.xml"), text("resources/scene.toml"));
    assert!(xml.contains(&format!("instantiationToken=\"{}\"", token(&packed))), "{xml}");
    let again = Scene::parse("scene.toml", &packed, Path::new("."), &[]).expect("the scene");
    assert_eq!(again.plan().hosts, scene.plan().hosts);
}

/// Files that the scene names come along: the unit begins where they are nowhere else.
#[test]
fn files_of_the_scene_come_along() {
    let desk = tempfile::tempdir().expect("a folder of its own");
    let corners = ["0 0 20", "5 0 30", "0 5 30", "-5 -5 30"];
    let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let faces = faces.map(|face| {
        let corners = face.map(|corner: usize| format!("vertex {}\n", corners[corner])).concat();
        format!("facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
    });
    fs::write(desk.path().join("blade.stl"), format!("solid blade\n{}endsolid blade\n", faces.concat()))
        .expect("a file");
    let text = scene("ball.toml", &[]).text().replace("[[0, \"5 mm\"]]", "[[0, 0, \"5 mm\"]]");
    let text = text.replace("height = \"40 mm\" }", "height = \"40 mm\", depth = \"40 mm\" }");
    let blade =
        "[walls.blade]\nmaterial = \"putty\"\nhost = \"casing\"\nshape.mesh = { path = \"blade.stl\", scale = 1e-3 }\n";
    let text = format!("dimension = 3\n{text}{blade}");
    let scene = Scene::parse("blade.toml", &text, desk.path(), &[]).expect("a scene");
    let bytes = archive(&scene, Some(1e-3), Version::Three, b"code").expect("an archive");
    let elsewhere = tempfile::tempdir().expect("a folder of its own");
    ZipArchive::new(Cursor::new(bytes)).expect("a zip").extract(elsewhere.path()).expect("files");
    drop(desk);
    let resources = elsewhere.path().join("resources");
    let token = token(&fs::read_to_string(resources.join("scene.toml")).expect("a text"));
    let mut instance = Instance::new(&resources, &token).expect("the scene");
    instance.begin(0.0).expect("the begin");
    instance.settle().expect("the scene opens");
    instance.step(0.0, 1e-3).expect("a step");
}

/// The engine's step divides the communication step, and is no longer than it would be alone. Control: alone it does not divide it.
#[test]
fn the_step_of_the_engine_fits() {
    let scene = scene("ball.toml", &[]);
    let alone = prepare(&scene, None).expect("a unit");
    assert_eq!(alone.step, alone.time_step);
    let whole = |step: f64, time_step: f64| (step / time_step - (step / time_step).round()).abs() < 1e-9;
    for step in [1e-3, 3.3e-4, 0.1 * alone.time_step] {
        let made = prepare(&scene, Some(step)).expect("a unit");
        assert!(whole(step, made.time_step) && made.time_step <= alone.time_step * (1.0 + 1e-9), "{made:?}");
    }
    assert!(!whole(3.3e-4, alone.time_step));
}

/// What cannot be a unit says why, and what to do.
#[test]
fn some_scenes_are_no_units() {
    let stages = "duration = \"0.8 s\"";
    let two = "[[stage]]\nname = \"one\"\nduration = \"1 s\"\n[[stage]]\nname = \"two\"\nduration = \"1 s\"\n[materials.putty]";
    let text = scene("ball.toml", &[]).text().replace(stages, "").replace("[materials.putty]", two);
    let staged = Scene::parse("ball.toml", &text, Path::new("."), &[]).expect("a scene");
    let told = prepare(&staged, None).expect_err("stages").to_string();
    assert!(told.contains("several stages") && told.contains("hint: "), "{told}");
    let told = prepare(&scene("ball.toml", &[]), Some(f64::NAN)).expect_err("no step").to_string();
    assert!(told.contains("NaN"), "{told}");
}

/// Value reference of a variable.
fn reference(instance: &str, scene: &Scene) -> u32 {
    let place = variables(scene.plan()).iter().position(|variable| variable.name == instance);
    u32::try_from(place.expect("a variable")).expect("few of them")
}

/// A steered shaker posts its work: the books close, the better the shorter the step. Control: without that work they do not.
#[test]
fn the_work_of_a_steered_base_is_in_the_books() {
    let residual = |step: &str| {
        let scene = scene("ball.toml", &[step]);
        let mut instance = Instance::of(scene.clone());
        instance.begin(0.0).expect("the begin");
        instance.settle().expect("the scene");
        let inputs = ["displacement", "velocity", "acceleration"];
        let inputs = inputs.map(|word| reference(&format!("casing.base.{word}"), &scene));
        let held = |instance: &mut Instance| -> f64 {
            let energies = ["kinetic_energy", "potential_energy", "elastic_energy"];
            energies.map(|name| instance.number(reference(name, &scene)).expect("a number")).iter().sum()
        };
        let begin = held(&mut instance);
        for n in 0..200 {
            let time = f64::from(n) * 1e-3;
            let (sin, cos) = (30.0 * time).sin_cos();
            for (input, value) in inputs.iter().zip([0.03 * sin, 0.9 * cos, -27.0 * sin]) {
                instance.set(*input, value).expect("an input");
            }
            instance.step(time, 1e-3).expect("a step");
        }
        let gained = held(&mut instance) - begin;
        let mut number = |name: &str| instance.number(reference(name, &scene)).expect("a number");
        let (work, lost) = (number("base_work"), number("dissipated_energy"));
        assert!(lost > 1e-5 && (gained + lost).abs() > 0.9 * work.abs(), "{gained} {lost} {work}");
        assert!((gained + lost - work).abs() < 1e-2 * work.abs(), "{gained} {lost} {work}");
        number("energy_residual").abs()
    };
    let [coarse, fine] = [residual("dem.time-step=1e-5"), residual("dem.time-step=2.5e-6")];
    assert!(coarse < 1e-3 && fine < 0.3 * coarse, "{coarse} {fine}");
}

/// Nothing is done out of turn, and what is told must be told of something.
#[test]
fn modes_are_kept() {
    let scene = scene("ball.toml", &[]);
    let mut instance = Instance::of(scene.clone());
    let told = |done: Result<(), tsubu_fmu::error::Error>| done.expect_err("out of turn").to_string();
    assert!(told(instance.step(0.0, 1e-3)).contains("in the mode Instantiated"));
    assert!(told(instance.number(5).map(|_| ())).contains("an output is asked for"));
    instance.begin(0.0).expect("the begin");
    assert!(told(instance.begin(0.0)).contains("Initialization"));
    assert!(told(instance.set(99, 1.0)).contains("no variable with the value reference 99"));
    assert!(told(instance.set(1, f64::NAN)).contains("NaN"));
    instance.settle().expect("the scene");
    assert!(told(instance.begin(0.0)).contains("Step"));
    instance.terminate().expect("the end");
    assert_eq!(instance.mode(), Mode::Terminated);
    assert!(instance.number(4).is_ok());
    assert!(told(instance.set(1, 0.0)).contains("Terminated"));
    instance.reset();
    assert_eq!(instance.mode(), Mode::Instantiated);
    let outputs = variables(scene.plan()).iter().filter(|variable| variable.causality == Causality::Output).count();
    assert_eq!(outputs, 12);
}

/// The motion told for the start is that of the first moment, and grains that lie on walls weigh on them from then on.
#[test]
fn the_start_is_told() {
    let scene = scene("ball.toml", &["particles.ball.start={ settled = {} }", "particles.ball.count=1"]);
    let mut instance = Instance::of(scene.clone());
    instance.begin(7.0).expect("the begin");
    instance.set(reference("casing.base.displacement", &scene), 0.011).expect("an input");
    instance.set(reference("casing.base.velocity", &scene), -0.2).expect("an input");
    let at_first = instance.number(reference("casing.velocity", &scene)).expect("a number");
    assert!((at_first + 0.2).abs() < 1e-14);
    // It is told anew, and the grain does not feel a floor that moves away.
    instance.set(reference("casing.base.velocity", &scene), 0.0).expect("an input");
    instance.settle().expect("the scene");
    let mut number = |name: &str| instance.number(reference(name, &scene)).expect("a number");
    assert_eq!(number("time"), 7.0);
    assert!((number("casing.displacement") - 0.011).abs() < 1e-15 && number("casing.velocity").abs() < 1e-14);
    let weight = number("casing.force") / (-2e-3 * 9.8);
    assert!((weight - 1.0).abs() < 1e-2, "{weight}");
}

/// A scene that does not parse, and one that is not the one described, are told as everywhere else.
#[test]
fn a_broken_scene_is_told() {
    let desk = tempfile::tempdir().expect("a folder of its own");
    let told = |text: &str, token: &str| {
        fs::write(desk.path().join("scene.toml"), text).expect("a file");
        Instance::new(desk.path(), token).err().map(|error| error.to_string())
    };
    let good = scene("ball.toml", &[]).text().to_owned();
    assert_eq!(told(&good, &token(&good)), None);
    assert!(told(&good, "another").expect("refused").contains("do not belong together"));
    let broken = good.replace("restitution", "restitucion");
    let text = told(&broken, &token(&broken)).expect("refused");
    assert!(text.contains("scene.toml:10:1") && text.contains("did you mean `restitution`?"), "{text}");
}

/// u + v h + a h^2 / 2, v + a h.
#[test]
fn a_motion_goes_on_at_its_acceleration() {
    let motion = Motion { displacement: 1.0, velocity: 2.0, acceleration: -3.0 };
    assert_eq!(motion.after(2.0), (1.0 + 4.0 - 6.0, 2.0 - 6.0));
}
