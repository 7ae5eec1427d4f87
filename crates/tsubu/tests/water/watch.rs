//! What the watch on the water reads.

use crate::dem::open_text;
use std::path::Path;
use tsubu::view::Wants;
use tsubu::watch;
use tsubu_scene::Scene;

/// A grain in a stream of 2 cm down a slope, and one of lead: too small to matter to so much water.
const SCENE: &str = r#"
dimension = 3
slope = 0.05
gravity = "9.8 m/s^2"
duration = "10 s"
speed-scale = "1 m/s"
[materials.quartz]
young-modulus = "5 MPa"
density = "2650 kg/m^3"
[materials.lead]
young-modulus = "5 MPa"
density = "11350 kg/m^3"
[particles.sand]
material = "quartz"
diameter = "2 mm"
start.at = { position = [[5e-3, 5e-3, 5e-3]] }
[particles.shot]
material = "lead"
diameter = "2 mm"
start.at = { position = [[50e-3, 50e-3, 5e-3]] }
[periodic]
x = [0, "400 mm"]
y = [0, "400 mm"]
[water]
[watch.water]
stream = {}
"#;

const LAYERS: &str = "water.flow.coupled={bottom=0,top=0.02,layers=20,roughness=2e-3}";
const LOG_LAW: &str = "water.flow.log-law={depth=0.02,roughness=2e-3}";

/// The numbers of the watch after some steps, by name, and its rows.
fn look(flow: &str, group: Option<&str>) -> (impl Fn(&str) -> f64, Vec<Vec<f64>>) {
    let group = group.map(|group| format!("watch.water.stream.group='{group}'"));
    let changes: Vec<String> = [flow.to_owned()].into_iter().chain(group).collect();
    let scene = Scene::parse("test", SCENE, Path::new("."), &changes).unwrap_or_else(|c| panic!("{c}"));
    let (mut engine, mut hosts, mut ledger) = open_text(SCENE, &changes.iter().map(String::as_str).collect::<Vec<_>>());
    engine.advance(20, &mut hosts, &mut ledger).unwrap();
    let mut watch = watch::open(&scene.plan().watch["water"].measure, scene.plan());
    let sample = watch.take(&engine.view(Wants::GRAINS));
    let named: Vec<(String, f64)> = watch.scalars().into_iter().zip(sample.scalars).collect();
    let number =
        move |name: &str| named.iter().find(|(known, _)| known.starts_with(name)).unwrap_or_else(|| panic!("{name}")).1;
    (number, sample.rows)
}

/// U*^2 = g sin H of a stream without grains, in layers and by the log law; Shields and Rouse numbers of sand and of lead follow. With
/// the lead's density the sand's gate fails.
#[test]
fn shields_and_rouse_numbers_are_those_of_the_depth_and_the_slope() {
    let pull = 9.8 * 0.05f64.sin();
    let stress = 1000.0 * pull * 0.02;
    for flow in [LAYERS, LOG_LAW] {
        let near = |found: f64, wanted: f64| (found / wanted - 1.0).abs() < 5e-3;
        let (number, _) = look(flow, Some("sand"));
        assert!(near(number("bed stress"), stress), "{flow}: {}", number("bed stress"));
        assert!(near(number("shear velocity").powi(2), stress / 1000.0), "{flow}");
        let shields = stress / (1650.0 * 9.8 * 2e-3);
        assert!(near(number("Shields number"), shields), "{flow}: {}", number("Shields number"));
        // 2 mm of quartz sinks at 0.3137 m/s by this drag (V-50).
        assert!(
            near(number("Rouse number"), 0.3137 / (0.4 * (pull * 0.02).sqrt())),
            "{flow}: {}",
            number("Rouse number")
        );
        let (lead, _) = look(flow, Some("shot"));
        assert!(near(lead("Shields number"), shields * 1650.0 / 10350.0) && !near(lead("Shields number"), shields));
        assert!(lead("Rouse number") > 2.0 * number("Rouse number"));
    }
}

/// The diameter of a cube is that of the sphere which holds it, a sqrt(3); its Shields number takes that of the sphere of its volume,
/// a (6/pi)^(1/3), and by the former it was 1.4 times too small.
#[test]
fn the_shields_number_of_a_body_takes_the_sphere_of_its_volume() {
    let cube = "particles.sand.shape.polyhedron={corners=[[-1,-1,-1],[1,-1,-1],[-1,1,-1],[1,1,-1],[-1,-1,1],[1,-1,1],[-1,1,1],[1,1,1]],rounding=0.001}";
    let shields = |changes: &[&str]| {
        let changes: Vec<String> =
            [&[LOG_LAW, "watch.water.stream.group='sand'", "water.drag={haider-levenspiel={}}"], changes]
                .concat()
                .into_iter()
                .map(str::to_owned)
                .collect();
        let scene = Scene::parse("test", SCENE, Path::new("."), &changes).unwrap_or_else(|c| panic!("{c}"));
        let (engine, hosts, _) = open_text(SCENE, &changes.iter().map(String::as_str).collect::<Vec<_>>());
        let mut watch = watch::open(&scene.plan().watch["water"].measure, scene.plan());
        let sample = watch.take(&engine.view(Wants::GRAINS));
        let place = watch.scalars().iter().position(|name| name.starts_with("Shields")).expect("a Shields number");
        let verdict = tsubu::check::verdict(scene.plan(), &hosts, &*engine).to_string();
        let told =
            verdict.split("sand in the stream as typed").nth(1).and_then(|text| text.split("Shields number ").nth(1));
        let told = told.and_then(|text| text.split_whitespace().next()?.parse::<f64>().ok()).expect("a number");
        [sample.scalars[place], told]
    };
    let (sphere, cube) = (shields(&[]), shields(&[cube]));
    let wanted = 3.0_f64.sqrt() * (std::f64::consts::PI / 6.0).cbrt();
    for (sphere, cube) in sphere.into_iter().zip(cube) {
        assert!((cube / sphere / wanted - 1.0).abs() < 3e-3, "{cube} {sphere}");
    }
}

/// In layers without grains the stress falls in a straight line to the surface, and the shear is that of the log law, U*/(0.40 z), to what
/// a difference over two layers makes of it. The bed's neighbour is left out.
#[test]
fn stress_and_shear_are_those_of_the_log_law() {
    let (_, rows) = look(LAYERS, None);
    let pull = 9.8 * 0.05f64.sin();
    let velocity = (pull * 0.02).sqrt();
    assert_eq!(rows.len(), 20);
    for row in &rows[3..19] {
        let [z, _, open, shear, stress] = row[..] else { panic!("{row:?}") };
        let wanted = 1000.0 * pull * (0.02 - z);
        assert!((stress - wanted).abs() < 0.01 * 1000.0 * pull * 0.02, "{z}: {stress} {wanted}");
        assert!((shear * 0.4 * z / velocity - 1.0).abs() < 0.05, "{z}: {shear}");
        assert!(open > 0.999);
    }
    // Not the stress at the bottom everywhere.
    assert!(rows[15][4] < 0.5 * rows[3][4]);
}
