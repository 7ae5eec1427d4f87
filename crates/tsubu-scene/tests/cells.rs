//! Grains that are made of lattice cells.

use std::path::Path;
use tsubu_scene::Scene;

const SCENE: &str = r#"
title = "cells"
method = "cl-ca"
duration = 1
[materials.m]
density = 2000
young-modulus = "1 GPa"
[particles.rods]
material = "m"
count = 3
start.random.region = { low = [0, 0], high = [1, 1] }
shape.cells = { OUTLINE, spacing = "2 mm", thickness = "10 mm" }
"#;

fn read(outline: &str, changes: &[&str]) -> Result<Scene, String> {
    let changes: Vec<String> = changes.iter().map(|change| (*change).to_owned()).collect();
    let text = SCENE.replace("OUTLINE", &format!("outline.{outline}"));
    Scene::parse("scene.toml", &text, Path::new("."), &changes).map_err(|complaints| complaints.to_string())
}

/// Mass of the cells, diameter of the circle that holds them; a resolved scene says the same. `contact.rotation` is one key for both methods,
/// unless `cl-ca.turning` says another thing.
#[test]
fn cells_are_grains_of_a_size_of_their_own() {
    for outline in ["hexagon.radius = 1", "points.at = [[0, 0], [0, 2], [1, 3], [2, 2], [2, 0], [2, -2], [2, -4]]"] {
        let scene = read(outline, &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
        let group = &scene.plan().particles["rods"];
        let mass = 2000.0 * 0.01 * 7.0 * 0.75_f64.sqrt() * 4e-6;
        assert!((group.mass / mass - 1.0).abs() < 1e-12, "{}", group.mass);
        assert_eq!(group.shape.own_diameter(), Some(group.diameter));
        let again = Scene::parse("scene.toml", &scene.resolved_toml(), Path::new("."), &[]);
        assert_eq!(again.expect("the same scene").plan(), scene.plan());
        let turning = |changes: &[&str]| read(outline, changes).expect("a scene").plan().cl_ca.turning;
        assert!(turning(&[]) && !turning(&["contact.rotation=false"]) && !turning(&["cl-ca.turning=false"]));
        assert!(turning(&["contact.rotation=false", "cl-ca.turning=true"]));
    }
    let sphere = read("hexagon.radius = 1", &["particles.rods.shape={sphere={}}", "particles.rods.diameter=1 mm"]);
    assert!(!sphere.expect("a scene").plan().cl_ca.turning, "grains without cells do as they did");
}

#[test]
fn cells_that_cannot_be() {
    let hexagon = "hexagon.radius = 1";
    for (outline, changes, parts) in [
        ("points.at = [[0, 0], [0, 4]]", &[][..], &["the cells of `rods` are no grain", "connected"][..]),
        ("points.at = [[0, 0], [0, 1]]", &[], &["no grain", "even sums"]),
        ("polygon.corners = [[0, 0], [2, 0], [0, 4]]", &[], &["no grain", "sides along the lattice"]),
        (
            hexagon,
            &["dimension=3", "particles.rods.start.random={region={low=[0,0,0],high=[1,1,1]}}"],
            &["only the plane"],
        ),
        (hexagon, &["particles.rods.diameter=5 mm"], &["circle that holds `shape.cells`", "leave `diameter` out"]),
        (hexagon, &["particles.rods.size={uniform={smallest=0.01,largest=0.02}}"], &["whose spacing is their size"]),
        (hexagon, &["particles.rods.shape.cells.rounding=1.4"], &["rounding radius of `rods` leaves nothing"]),
        (hexagon, &["particles.rods.motion={frozen={}}"], &["grains of cells `rods` must be free"]),
        ("hexagon.radius = -1", &[], &["radius"]),
    ] {
        let Err(wrong) = read(outline, changes) else { panic!("{outline} {changes:?} was taken") };
        assert!(parts.iter().all(|part| wrong.contains(part)), "{outline} {changes:?}: {wrong}");
    }
}
