use crate::support::{Desk, SCENE, is};

#[test]
fn a_run_folder_holds_what_the_contract_says() {
    let desk = Desk::new();
    desk.done("run balls.toml -q --set output.xyz=true");
    let files = desk.files();
    for name in
        ["scene.toml", "summary.json", "history.csv", "checkpoint/state.tsubu", "frames/grains.pvd", "frames/walls.pvd"]
    {
        assert!(files.contains(&format!("out/balls/{name}")), "{name} is not in {files:?}");
    }
    assert_eq!(files.iter().filter(|f| f.contains("frames/grains_") && is(f, "vtp")).count(), 6);
    assert!(files.iter().any(|f| is(f, "xyz")), "{files:?}");
    assert!(desk.read("out/balls/history.csv").starts_with("time [s],"));
    assert_eq!(desk.read("out/balls/history.csv").lines().count(), 1 + 51);
    assert!(!desk.path("out/balls/report.html").exists());
    desk.done("report out/balls");
    assert!(desk.path("out/balls/report.html").exists());
    assert!(desk.files().iter().any(|f| f.starts_with("out/balls/figures/") && is(f, "svg")));
}

#[test]
fn a_summary_has_exactly_its_keys() {
    let desk = Desk::new();
    desk.done("run balls.toml -q");
    let summary = desk.summary("out/balls");
    let mut keys: Vec<&str> = summary.as_object().unwrap().keys().map(String::as_str).collect();
    keys.sort_unstable();
    let mut promised = vec![
        "tsubu_version",
        "status",
        "method",
        "dimension",
        "particles",
        "steps",
        "time_step",
        "simulated_seconds",
        "wall_seconds",
        "threads",
        "particle_steps_per_second",
        "contacts_mean",
        "energy",
        "state_hash",
        "results",
        "claims",
        "warnings",
    ];
    promised.sort_unstable();
    assert_eq!(keys, promised);
    assert_eq!(summary["particles"], 20);
    assert_eq!(summary["method"], "dem");
    assert!(summary["energy"]["residual_relative"].is_number());
    assert!(summary["energy"]["kinetic"].is_number());
}

#[test]
fn a_scene_claims_and_is_judged() {
    for (high, code, word) in [("1", 0, "pass"), ("1e-9", 1, "FAIL")] {
        let claim = "[[claim]]\nresult = \"host spring peak displacement\"\nlow = 0\nsource = \"common sense\"";
        let desk = Desk::with(&format!("{SCENE}\n{claim}\nhigh = {high}\n"));
        let ended = desk.run("run balls.toml -q");
        assert_eq!(ended.code, Some(code), "{}", ended.stderr);
        assert!(ended.stdout.contains(word) && ended.stdout.contains("common sense"), "{}", ended.stdout);
        assert_eq!(desk.summary("out/balls")["claims"][0]["pass"], code == 0);
    }
}

#[test]
fn overwriting_leaves_strangers_alone() {
    let desk = Desk::new();
    desk.done("run balls.toml -q");
    std::fs::write(desk.path("out/balls/notes.txt"), "mine").unwrap();
    assert_eq!(desk.run("run balls.toml -q").code, Some(2));
    desk.done("run balls.toml -q --overwrite");
    assert_eq!(desk.read("out/balls/notes.txt"), "mine");
}

#[test]
fn a_scene_in_a_folder_gives_the_folder_its_name() {
    let desk = Desk::empty();
    std::fs::create_dir(desk.path("study")).unwrap();
    std::fs::write(desk.path("study/scene.toml"), SCENE).unwrap();
    desk.done("run study -q");
    assert!(desk.path("out/study/summary.json").exists());
}
