use crate::support::Desk;
use std::path::Path;

/// Runs a scene for a moment and looks at its books. What a scene claims is true at its end only.
fn runs(desk: &Desk, scene: &str, options: &str, method: &str) {
    let folder = format!("{}-{method}", Path::new(scene).file_stem().unwrap().to_str().unwrap());
    desk.done(&format!("run {scene} -q -o {folder} {options}"));
    let summary = desk.summary(&folder);
    assert_eq!(summary["status"], "finished");
    let residual = summary["energy"]["residual_relative"].as_f64().unwrap();
    assert!(residual.abs() < 1e-3, "{folder}: the books miss {residual:e}");
}

#[test]
fn every_shipped_scene_runs_and_closes_its_books() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap().flatten() {
        if entry.path().extension().is_some_and(|e| e == "toml") {
            runs(&Desk::empty(), entry.path().to_str().unwrap(), "--set 'duration=0.2 s' --set claim=[]", "dem");
            count += 1;
        }
    }
    assert!(count >= 5);
}

#[test]
fn every_template_runs_and_closes_its_books() {
    let desk = Desk::empty();
    let list = desk.done("new --list").stdout;
    for line in list.lines() {
        let name = line.split_whitespace().next().unwrap();
        desk.done(&format!("new {name}"));
        runs(&desk, &format!("{name}.toml"), "--set 'duration=0.15 s' --set claim=[]", "dem");
    }
}

#[test]
fn the_damper_runs_by_both_methods() {
    let desk = Desk::empty();
    desk.done("new damper");
    runs(&desk, "damper.toml", "--set method=lattice --set 'duration=0.5 s'", "lattice");
    assert_eq!(desk.summary("damper-lattice")["method"], "lattice");
}
