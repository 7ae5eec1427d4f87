//! Grains of several spheres.

use super::GOOD;
use std::fs;
use std::path::Path;
use tsubu_scene::Scene;

fn read(shape: &str, changes: &[&str]) -> Result<Scene, String> {
    let text = GOOD.replacen(
        "[particles.",
        &format!("[particles.rods]\nmaterial = \"glass\"\ncount = 3\ndiameter = 0.004\n{shape}\n[particles."),
        1,
    );
    let changes: Vec<String> = changes.iter().map(|change| (*change).to_owned()).collect();
    Scene::parse("scene.toml", &text, Path::new("."), &changes).map_err(|complaints| complaints.to_string())
}

/// Two spheres that touch in one point: a quarter of the mass of the sphere that holds them, 2 (1/2)^3; in any unit, and as typed again.
#[test]
fn a_density_gives_the_mass_of_what_is_there() {
    for scale in [1.0, 1e-3] {
        let shape = format!(
            "shape.clump = {{ centre = [[{}, 0], [{scale}, 0]], diameter = [{}, {}] }}",
            -scale,
            2.0 * scale,
            2.0 * scale
        );
        let scene = read(&shape, &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
        let group = &scene.plan().particles["rods"];
        let sphere = 2500.0 * std::f64::consts::PI / 6.0 * 0.004_f64.powi(3);
        assert!((group.mass / (0.25 * sphere) - 1.0).abs() < 1e-12, "{}", group.mass);
        let clump = group.shape.clump().expect("two spheres");
        // About the line 2/5 r^2 over the mass, across it (2/5 + 1) r^2, r a quarter of the diameter.
        for (found, expected) in clump.moments.iter().zip([0.4, 1.4, 1.4]) {
            assert!((found * 16.0 / expected - 1.0).abs() < 1e-12, "{:?}", clump.moments);
        }
        // Of the worst arm, straight on the end of one sphere across the line: 1 + r^2 m / I.
        assert!((clump.lightness() / (1.0 + 1.0 / 1.4) - 1.0).abs() < 1e-12, "{}", clump.lightness());
        let again = Scene::parse("scene.toml", &scene.resolved_toml(), Path::new("."), &[]).expect("the same scene");
        assert_eq!(again.plan().particles["rods"], *group);
    }
}

#[test]
fn clumps_that_cannot_be() {
    let two = "shape.clump = { centre = [[-1, 0], [1, 0]], diameter = [2, 2] }";
    let wrong = [
        read(&two.replace("[2, 2]", "[2]"), &[]),
        read(&two.replace("[2, 2]", "[2, -2]"), &[]),
        read("shape.clump = { centre = [], diameter = [] }", &[]),
        read(&two.replace("[1, 0]", "[1, 0.5, 0]"), &[]),
        read(&format!("{two}\nmotion.frozen = {{}}"), &[]),
        read(two, &["water.density=1000", "water.viscosity=1e-3"]),
        read(two, &["particles.rods.material=acrylic"]),
    ];
    insta::assert_snapshot!(crate::refusals(wrong));
}

pub(super) const HEAD: &str = "duration = 1\n[materials.glass]\nyoung-modulus = 1e9\ndensity = 2500\n[particles.rods]\nmaterial = \"glass\"\n\
                    count = 3\ndiameter = 0.004\nstart.random.region = { low = [0, 0, 0], high = [1, 1, 1] }\n";

/// Two spheres that touch, as CLUMP writes them.
const TWO: &str = "-1.000000,  0.000000,  0.000000,  1.000000\n 1.000000,  0.000000,  0.000000,  1.000000\n";

pub(super) fn in_folder(files: &[(&str, &str)], shape: &str, changes: &[&str]) -> Result<Scene, String> {
    let desk = tempfile::tempdir().expect("a folder of its own");
    for (name, text) in files {
        fs::write(desk.path().join(name), text).expect("a folder of its own");
    }
    let changes: Vec<String> = changes.iter().map(|change| (*change).to_owned()).collect();
    Scene::parse("scene.toml", &format!("{HEAD}{shape}\n"), desk.path(), &changes)
        .map_err(|complaints| complaints.to_string())
}

/// A file says what would be typed; its copy stands in the run folder, where the scene means the same again.
#[test]
fn a_file_says_what_would_be_typed() {
    let space = ["dimension=3"];
    let typed = "shape.clump = { centre = [[-1, 0, 0], [1, 0, 0]], diameter = [2, 2], orientation = \"as-drawn\" }";
    let named = "shape.clump-file = { path = \"two.txt\", orientation = \"as-drawn\" }";
    let typed = in_folder(&[], typed, &space).unwrap_or_else(|wrong| panic!("{wrong}"));
    let read = in_folder(&[("two.txt", TWO)], named, &space).unwrap_or_else(|wrong| panic!("{wrong}"));
    let [typed, found] = [&typed, &read].map(|scene| &scene.plan().particles["rods"]);
    assert_eq!((found.shape.clump(), found.mass), (typed.shape.clump(), typed.mass));
    assert!(found.shape.is_clump());

    let run = tempfile::tempdir().expect("a folder of its own");
    let copies = read.companions();
    assert_eq!(copies, [("clumps-rods.txt".to_owned(), TWO.as_bytes().to_vec())]);
    fs::write(run.path().join("clumps-rods.txt"), &copies[0].1).expect("a folder of its own");
    let text = read.resolved_toml();
    let again = Scene::parse("scene.toml", &text, run.path(), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    assert_eq!((again.plan(), again.resolved_toml()), (read.plan(), text));
}

#[test]
fn clump_files_that_cannot_be() {
    let named = "shape.clump-file.path = \"rock.csv\"";
    let with = |text: &str, changes: &[&str]| in_folder(&[("rock.csv", text)], named, changes);
    let space = ["dimension=3"];
    let wrong = [
        in_folder(&[], named, &space),
        with("0 0 0 1\n1 0 0\n1 0 0 -2\n1 0 0 r\n", &space),
        with("#format x_y_z_r_clumpId\n0 0 0 1 3\n0 0 1 1 4\n", &space),
        with("V\n2 atoms\n\nCoords\n\n1 0 0 0\n2 1 0 0\n\nDiameters\n\n1 1\n3 1\n", &space),
        with("V\n2 atoms\n\nCoords\n\n1 0 0 0\n", &space),
        with("V\n1 atoms\n\nCoords\n\n1 0 0 0\n", &space),
        with("0 0 0 1\n1 0.5 0 1\n", &["dimension=2", "particles.rods.start.random.region={low=[0,0],high=[1,1]}"]),
        with(TWO, &["dimension=3", "particles.rods.shape.clump-file.fingerprint='12345678'"]),
        with(TWO, &["dimension=3", "particles.rods.motion.frozen={}"]),
        with(TWO, &["dimension=3", "water.density=1000", "water.viscosity=1e-3"]),
    ];
    insta::assert_snapshot!(crate::refusals(wrong));
}
