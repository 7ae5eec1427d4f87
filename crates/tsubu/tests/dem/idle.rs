//! What a scene asks for and will not get is said before it runs.

use super::open_text;
use tsubu::check;
use tsubu_scene::Scene;

const SCENE: &str = r#"
dimension = 3
duration = "0.1 s"
[materials.glass]
young-modulus = "10 MPa"
density = "2500 kg/m^3"
[particles.balls]
material = "glass"
count = 4
diameter = "6 mm"
start.random.region = { low = [-0.02, -0.02, 0.05], high = [0.02, 0.02, 0.1] }
[walls.floor]
material = "glass"
shape.plane = {}
"#;

/// The warnings that the changes make.
fn warnings(changes: &[&str]) -> Vec<String> {
    let (engine, hosts, _) = open_text(SCENE, changes);
    let told: Vec<String> = changes.iter().map(|c| (*c).to_owned()).collect();
    let scene = Scene::parse("test", SCENE, std::path::Path::new("."), &told).unwrap_or_else(|c| panic!("{c}"));
    let said = |text: &str| ["does nothing", "never vanishes"].iter().any(|word| text.contains(word));
    let verdict = check::verdict(scene.plan(), &hosts, &*engine);
    verdict.lines.into_iter().filter(|line| !line.good && said(&line.text)).map(|line| line.text).collect()
}

#[test]
fn what_does_nothing_is_named() {
    for (part, key, value) in [
        ("rolling.epsd", "rolling-friction", "0.1"),
        ("rolling.epsd2", "rolling-friction", "0.1"),
        ("twisting.spring", "twisting-friction", "0.1"),
        ("cohesion.jkr", "surface-energy", "0.1"),
        ("cohesion.sjkr", "cohesion", "1000"),
    ] {
        let chosen = format!("contact.{part}={{}}");
        let idle = warnings(&[&chosen]);
        assert!(idle.len() == 1 && idle[0].contains(key), "{part}: {idle:?}");
        // The control: with a coefficient nothing is said.
        assert_eq!(warnings(&[&chosen, &format!("materials.glass.{key}={value}")]), [""; 0], "{part}");
    }
    let still = ["contact.rolling.epsd={}", "materials.glass.rolling-friction=0.1", "contact.rotation=false"];
    assert!(warnings(&still)[0].contains("do not spin"));
    assert_eq!(warnings(&["walls.floor.until=0.2"]).len(), 1);
    assert_eq!(warnings(&["walls.floor.until=0.05"]).len(), 0);
}
