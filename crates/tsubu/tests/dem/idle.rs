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
    let said = |text: &str| {
        ["does nothing", "never vanishes", "writes", "no grain feels", "it is driven at"]
            .iter()
            .any(|word| text.contains(word))
    };
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
        let constant = format!("materials.glass.{key}={value}");
        assert_eq!(warnings(&[&chosen, &constant]), [""; 0], "{part}");
        let alone = warnings(&[&constant]);
        assert!(alone.len() == 1 && alone[0].contains(key), "{part}: {alone:?}");
    }
    let still = ["contact.rolling.epsd={}", "materials.glass.rolling-friction=0.1", "contact.rotation=false"];
    assert!(warnings(&still)[0].contains("do not spin"));
    assert_eq!(warnings(&["walls.floor.until=0.2"]).len(), 1);
    assert_eq!(warnings(&["walls.floor.until=0.05"]).len(), 0);
}

/// Files that would hold nothing, a structure that carries nothing, and one whose mass and stiffness somebody has exchanged.
#[test]
fn outputs_and_hosts_that_do_nothing_are_named() {
    let one = |change: &str, part: &str| {
        let said = warnings(&[change]);
        assert!(said.len() == 1 && said[0].contains(part), "{change}: {said:?}");
    };
    one("output.frame-interval='2 s'", "frame-interval");
    one("output.xyz=true", "output.xyz");
    assert_eq!(warnings(&["output.xyz=true", "output.frame-interval='10 ms'"]), [""; 0]);
    let host = |mass: &str, stiffness: &str| {
        let sine = "base.sine={ amplitude=1e-3, frequency=12 }";
        format!("hosts.frame={{ structure.oscillator={{ mass={mass}, stiffness={stiffness}, damping=1 }}, {sine} }}")
    };
    one(&host("2", "12000"), "host `frame`");
    let carried = ["walls.floor.host='frame'"];
    assert_eq!(warnings(&[&host("2", "12000"), carried[0]]), [""; 0]);
    let exchanged = warnings(&[&host("12000", "2"), carried[0]]);
    assert!(exchanged.len() == 1 && exchanged[0].contains("driven at 12"), "{exchanged:?}");
}
