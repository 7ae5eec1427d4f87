use crate::support::{Desk, shortened};
use std::path::Path;
use std::process::Command;
use tsubu_scene::Scene;

/// Runs a scene for a moment and looks at its books. What a scene claims is true at its end only.
fn runs(desk: &Desk, scene: &str, options: &str, method: &str) {
    let folder = format!("{}-{method}", Path::new(scene).file_stem().unwrap().to_str().unwrap());
    desk.done(&format!("run {scene} -q -o {folder} {options}"));
    let summary = desk.summary(&folder);
    assert_eq!(summary["status"], "finished");
    let residual = summary["energy"]["residual_relative"].as_f64().unwrap();
    assert!(residual.abs() < 1e-3, "{folder}: the energy residual is {residual:e}");
}

mod patient {
    use super::*;

    #[test]
    #[ignore = "a minute: cargo xtask patient"]
    fn every_shipped_scene_is_checked_runs_closes_its_books_and_is_reported() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
        let mut count = 0;
        for entry in std::fs::read_dir(folder).unwrap().flatten() {
            if entry.path().extension().is_some_and(|e| e == "toml") {
                let (desk, path) = (Desk::empty(), entry.path());
                let name = path.file_stem().unwrap().to_str().unwrap();
                desk.done(&format!("check {}", path.display()));
                let scene = Scene::read(&path, &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
                // None longer than it is: some break in milliseconds.
                let seconds = scene.plans().iter().map(|plan| plan.duration).fold(0.05, f64::min);
                let path = path.to_str().unwrap();
                runs(&desk, path, &format!("{} --set claim=[]", shortened(path, &format!("{seconds} s"))), "dem");
                desk.done(&format!("report {name}-dem"));
                count += 1;
            }
        }
        assert!(count >= 5);
    }
}

/// VTK draws ellipsoids and cubes where they touch. Read with VTK, which `cargo xtask test` brings.
#[test]
#[ignore = "needs Python with the package vtk: cargo xtask test"]
fn vtk_reads_every_snapshot_and_shape() {
    let desk = Desk::empty();
    desk.done("new mixed");
    desk.done("run mixed.toml -q --set 'duration=0.12 s'");
    let python = std::env::var_os("TSUBU_VTK_PYTHON").unwrap_or_else(|| "python3".into());
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/shapes_with_vtk.py");
    let out = Command::new(python).arg(script).arg(desk.path("out/mixed")).arg("700").output().unwrap();
    let said = String::from_utf8_lossy(&out.stdout);
    assert!(out.status.success(), "{said}{}", String::from_utf8_lossy(&out.stderr));
    assert!(said.contains("2 meshes"), "{said}");
}

/// So that what is written by `new` is tested with the scenes; one that names a file is written with it.
#[test]
fn every_template_is_a_shipped_scene() {
    let desk = Desk::empty();
    for line in desk.done("new --list").stdout.lines() {
        let name = line.split_whitespace().next().unwrap();
        desk.done(&format!("new {name}"));
        let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../scenes/{name}.toml"));
        assert_eq!(desk.read(&format!("{name}.toml")), std::fs::read_to_string(scene).unwrap(), "{name}");
    }
    desk.done("check mixer.toml");
    // A scene whose mesh is there already with something else in it is not written.
    std::fs::write(desk.path("mixer-blade.stl"), "solid other\nendsolid other\n").unwrap();
    assert_eq!(desk.run("new mixer again.toml").code, Some(2));
    assert!(!desk.path("again.toml").exists());
}

#[test]
fn the_damper_runs_by_both_methods() {
    let desk = Desk::empty();
    desk.done("new damper");
    runs(&desk, "damper.toml", "--set method=lattice --set 'duration=0.5 s'", "lattice");
    assert_eq!(desk.summary("damper-lattice")["method"], "lattice");
}
