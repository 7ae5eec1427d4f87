//! One binary for all integration tests of the crate: it links once.

mod bonds;
mod cells;
/// `--set` and programmatic changes.
mod changes;
mod clump_meshes;
mod clumps;
/// What drives hosts.
mod drives;
/// Grains from files, and what all files have in common.
mod files;
mod frames;
mod hosts;
/// What is too long, too large or no file.
mod limits;
mod matrix_files;
/// What scenes mean: values, defaults, choices.
mod meaning;
/// Meshes from files.
mod mesh_files;
/// What a user reads when a scene is wrong; snapshots of whole messages.
mod messages;
/// Contact laws of pairs of materials.
mod pairs;
mod polyhedra;
/// The resolved scene, the schema, the reference page, the templates.
mod products;
/// No text makes the reader panic.
mod robust;
/// Stages of a run.
mod stages;
mod superellipsoids;
/// Watches.
mod watches;
/// Water and slopes.
mod water;
/// Ends of the world, shapes, sizes, starts, motions, and the wider contact law.
mod wider;

use std::path::Path;
use tsubu_scene::{Complaints, Scene};

/// A small scene that is right; tests change a piece of it.
const GOOD: &str = r#"title = "Two groups"
duration = "1 s"
gravity = "10 m/s^2"

[materials.acrylic]
young-modulus = "0.5 GPa"
restitution = 0.75

[materials.glass]
young-modulus = "60 GPa"
density = "2500 kg/m^3"

[particles.balls]
material = "acrylic"
count = 20
diameter = "6 mm"
mass = "0.2 g"

[walls.box]
material = "glass"
host = "spring"
shape.box = { width = "60 mm", height = "96 mm" }

[hosts.spring]
structure.oscillator = { mass = "86 g", stiffness = "123.4 N/m", damping = "0.08 N s/m" }
base.sine = { amplitude = "0.5 mm", frequency = "6 Hz" }
"#;

fn read(text: &str, changes: &[&str]) -> Result<Scene, Complaints> {
    let changes: Vec<String> = changes.iter().map(ToString::to_string).collect();
    Scene::parse("scene.toml", text, Path::new("/nowhere"), &changes)
}

/// The good scene with one piece replaced.
fn edited(from: &str, to: &str) -> String {
    assert!(GOOD.contains(from), "the good scene has no `{from}`");
    GOOD.replacen(from, to, 1)
}

fn complaint(text: &str, changes: &[&str]) -> String {
    match read(text, changes) {
        Ok(_) => panic!("expected complaints about:\n{text}"),
        Err(complaints) => complaints.to_string(),
    }
}

/// What is said of scenes that must be refused, one after the other.
fn refusals<T>(scenes: impl IntoIterator<Item = Result<T, String>>) -> String {
    let refused =
        |(i, scene): (usize, Result<T, String>)| scene.err().unwrap_or_else(|| panic!("number {i} is not refused"));
    scenes.into_iter().enumerate().map(refused).collect::<Vec<_>>().join("\n\n")
}
