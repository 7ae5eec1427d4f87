//! Folders of results hold the files that their scene names: they run again anywhere.

use crate::support::{Desk, signal, wait_for};
use std::fs;

/// Three grains from a file fall into a tray that is a mesh.
const SCENE: &str = r#"
dimension = 3
duration = "20 ms"

[materials.acrylic]
density = "1200 kg/m^3"
young-modulus = "10 MPa"
restitution = 0.75
friction = 0.5

[particles."my grains"]
material = "acrylic"
start.file = { path = "data/grains.csv" }

[walls.tray]
material = "acrylic"
shape.mesh = { path = "data/tray.obj" }

[sweep]
vary = { "materials.acrylic.restitution" = [0.5, 0.8] }

[output]
history-interval = "1 ms"
frame-interval = "10 ms"
"#;

const GRAINS: &str = "x,y,z,diameter\n0,0,0.0035,0.006\n0.01,0.002,0.0035,0.005\n-0.01,0,0.004,0.006\n";

/// A square of two triangles.
const TRAY: &str = "v -0.05 -0.05 0\nv 0.05 -0.05 0\nv 0.05 0.05 0\nv -0.05 0.05 0\nf 1 2 3\nf 1 3 4\n";

const COPIES: [&str; 2] = ["particles-my_grains.csv", "walls-tray.obj"];

fn desk() -> Desk {
    let desk = Desk::with(SCENE);
    fs::create_dir(desk.path("data")).unwrap();
    fs::write(desk.path("data/grains.csv"), GRAINS).unwrap();
    fs::write(desk.path("data/tray.obj"), TRAY).unwrap();
    desk
}

/// The originals are gone from here on.
fn forget(desk: &Desk) {
    fs::remove_dir_all(desk.path("data")).unwrap();
    fs::remove_file(desk.path("balls.toml")).unwrap();
}

#[test]
fn a_run_folder_runs_again_elsewhere() {
    let desk = desk();
    desk.done("run balls.toml -q -o first");
    for name in COPIES {
        assert!(desk.files().contains(&format!("first/{name}")), "{name} is not in {:?}", desk.files());
    }
    forget(&desk);
    fs::rename(desk.path("first"), desk.path("moved")).unwrap();
    desk.done("run moved/scene.toml -q -o second");
    assert_eq!(desk.hash("moved"), desk.hash("second"));
    for name in ["scene.toml", COPIES[0], COPIES[1]] {
        assert_eq!(desk.read(&format!("moved/{name}")), desk.read(&format!("second/{name}")), "{name}");
    }
    // Into itself, and on from its own end.
    desk.done("run second/scene.toml -q -o second --overwrite");
    desk.done("run second/scene.toml -q -o second --resume");
    assert_eq!(desk.hash("moved"), desk.hash("second"));
}

/// Copies of files that only the earlier scene named, and its snapshots, stayed in the folder of the new run.
#[test]
fn overwriting_leaves_nothing_of_the_earlier_scene() {
    let desk = desk();
    desk.done("run balls.toml -q -o new --set output.frame-interval=20e-3");
    fs::write(desk.path("plate.toml"), SCENE.replace("walls.tray", "walls.plate")).unwrap();
    desk.done("run plate.toml -q -o old --set output.lammps=true");
    desk.done("compare plate.toml -q -o old --methods dem --overwrite");
    assert!(desk.path("old/dem/walls-plate.obj").exists());
    desk.done("run balls.toml -q -o old --overwrite --set output.frame-interval=20e-3");
    let inside = |folder: &str| -> Vec<String> {
        desk.files().iter().filter_map(|f| f.strip_prefix(folder)).map(str::to_owned).collect()
    };
    assert_eq!(inside("old/"), inside("new/"));
}

#[test]
fn a_cut_run_goes_on_without_the_originals() {
    let desk = desk();
    let long = "--set 'duration=4 s' --set 'output.checkpoint-interval=20 ms'";
    desk.done(&format!("run balls.toml -q -o whole {long}"));
    let mut child = desk.start(&format!("run balls.toml -q -o cut {long}"));
    wait_for(&desk.path("cut/checkpoint/state.tsubu"));
    signal(&child, "INT");
    assert_eq!(child.wait().unwrap().code(), Some(130), "the run ended before it could be interrupted");
    forget(&desk);
    desk.done("run cut/scene.toml -q -o cut --resume");
    assert_eq!(desk.hash("whole"), desk.hash("cut"));
}

#[test]
fn a_changed_file_is_another_scene() {
    let desk = desk();
    desk.done("run balls.toml -q -o run");
    fs::write(desk.path("data/grains.csv"), GRAINS.replace("-0.01,0,", "-0.011,0,")).unwrap();
    let ended = desk.run("run balls.toml -q -o run --resume");
    assert_eq!(ended.code, Some(2), "{}", ended.stderr);
    assert!(ended.stderr.contains("belongs to another scene"), "{}", ended.stderr);
}

#[test]
fn sweeps_and_comparisons_run_again_too() {
    let desk = desk();
    desk.done("sweep balls.toml -q -o sweep");
    desk.done("compare balls.toml -q -o compare --methods dem");
    forget(&desk);
    for folder in ["sweep", "sweep/cases/restitution=0.8", "compare", "compare/dem"] {
        desk.done(&format!("run {folder}/scene.toml -q -o again --overwrite"));
    }
    desk.done("sweep sweep/scene.toml -q -o other");
    assert_eq!(desk.hash("sweep/cases/restitution=0.8"), desk.hash("other/cases/restitution=0.8"));
}
