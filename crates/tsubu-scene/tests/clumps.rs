//! Grains of several spheres.

use super::GOOD;
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
    let told: Vec<String> = wrong
        .into_iter()
        .enumerate()
        .map(|(i, wrong)| wrong.err().unwrap_or_else(|| panic!("number {i} is not refused")))
        .collect();
    insta::assert_snapshot!(told.join("\n\n"));
}
