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
        "units",
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

/// The user's commented scene was replaced by the resolved one.
#[test]
fn a_scene_in_the_output_folder_stays_the_users() {
    let desk = Desk::empty();
    std::fs::create_dir(desk.path("s")).unwrap();
    std::fs::write(desk.path("s/scene.toml"), SCENE).unwrap();
    for line in
        ["run s -o s --overwrite", "run s/scene.toml -o s", "sweep s -o s --overwrite", "response s -o s --overwrite"]
    {
        let ended = desk.run(line);
        assert_eq!(ended.code, Some(2), "{line}: {}", ended.stderr);
    }
    let ended = desk.run("compare s --methods dem -o s --overwrite");
    assert!(ended.stderr.contains("s/scene.toml was not written by this tsubu"), "{}", ended.stderr);
    assert_eq!(desk.read("s/scene.toml"), SCENE);
    assert_eq!(desk.files(), ["s/scene.toml"]);
    // What tsubu itself has written runs again in its place, until somebody changes it.
    desk.done("run s -q -o out");
    desk.done("run out/scene.toml -q -o out --overwrite");
    let changed = desk.read("out/scene.toml") + "# mine\n";
    std::fs::write(desk.path("out/scene.toml"), &changed).unwrap();
    let ended = desk.run("run out -q -o out --overwrite");
    assert!(ended.code == Some(2) && ended.stderr.contains("changed since"), "{}", ended.stderr);
    assert_eq!(desk.read("out/scene.toml"), changed);
}

/// A measurement replaced it.
#[test]
fn a_bench_file_of_somebody_else_stays_theirs() {
    let desk = Desk::empty();
    std::fs::create_dir(desk.path("me")).unwrap();
    std::fs::write(desk.path("me/bench.json"), "mine").unwrap();
    let ended = desk.run("bench --seconds 600 -o me");
    assert!(ended.code == Some(2) && ended.stderr.contains("not written by this tsubu"), "{}", ended.stderr);
    assert_eq!(desk.read("me/bench.json"), "mine");
}

/// Extending a finished run was refused where a watch follows the history's interval and that the duration; the message blamed
/// another scene. A run that stopped at a limit that only guards could not be gone on with either.
#[test]
fn a_finished_run_goes_on_as_the_book_says() {
    let scene = SCENE.replace("history-interval = \"1 ms\"\n", "") + "[watch.layers]\nprofile.bins = 5\n";
    let desk = Desk::with(&scene);
    desk.done("run balls.toml -q -o out");
    let longer = "--set 'duration=0.08 s' --set dem.largest-overlap=0.4 --set dem.energy-tolerance=0.5";
    desk.done(&format!("run balls.toml -q -o out --resume {longer}"));
    desk.done("run balls.toml -q -o whole --set 'duration=0.08 s' --set output.history-interval=5e-5");
    assert_eq!(desk.hash("out"), desk.hash("whole"));
    assert_eq!(desk.read("out/history.csv"), desk.read("whole/history.csv"));
    assert_eq!(desk.read("out/watch/layers.csv"), desk.read("whole/watch/layers.csv"));
    let ended =
        desk.run("run balls.toml -q -o out --resume --set materials.acrylic.friction=0.25 --set 'duration=1 s'");
    assert_eq!(ended.code, Some(2));
    assert!(ended.stderr.contains("`materials.acrylic.friction` was 0.5, is 0.25"), "{}", ended.stderr);
    assert!(!ended.stderr.contains("duration"), "{}", ended.stderr);
}

/// A missing, cut or edited history was gone on with in silence.
#[test]
fn a_changed_history_is_not_gone_on_with() {
    let desk = Desk::new();
    desk.done("run balls.toml -q -o out");
    let whole = desk.read("out/history.csv");
    let cut = whole.lines().take(10).collect::<Vec<_>>().join("\n");
    for history in [None, Some(cut), Some(whole.replace("0.001", "0.002"))] {
        match &history {
            Some(text) => std::fs::write(desk.path("out/history.csv"), text).unwrap(),
            None => std::fs::remove_file(desk.path("out/history.csv")).unwrap(),
        }
        let before = desk.files();
        let ended = desk.run("run balls.toml -q -o out --resume --set 'duration=0.1 s'");
        assert_eq!(ended.code, Some(2), "{}", ended.stderr);
        assert!(ended.stderr.contains("history.csv"), "{}", ended.stderr);
        assert_eq!(desk.files(), before);
    }
}

/// It "finished" without a step.
#[test]
fn a_run_of_no_step_is_refused() {
    let desk = Desk::new();
    for command in ["run", "sweep"] {
        let ended = desk.run(&format!("{command} balls.toml -q --set 'dem.time-step=5 s'"));
        assert_eq!(ended.code, Some(2), "{command}: {}", ended.stderr);
        assert!(ended.stderr.contains("no step"), "{command}: {}", ended.stderr);
    }
    assert_eq!(desk.files(), ["balls.toml"]);
}

/// Damage was told inside the page alone: a script saw exit code 0 and an empty stderr, and rows that were cut off at the end of
/// a line were told nowhere.
#[test]
fn reports_tell_damage() {
    let desk = Desk::with(SCENE);
    desk.done("run balls.toml -o whole --set output.frame-interval=0.01");
    assert_eq!(desk.run("report whole").code, Some(0));
    let history = desk.read("whole/history.csv");
    let some: String = history.split_inclusive('\n').take(4).collect();
    for (file, content, told) in [
        ("history.csv", Some(some.as_str()), "rows at its end are missing"),
        ("history.csv", Some(&history[..history.len() - 7]), "history.csv"),
        ("history.csv", Some("a,b\n1,2\n"), "is not the history of a run"),
        ("history.csv", None, "no history.csv"),
        ("summary.json", Some("{ \"tsubu"), "summary.json"),
        ("frames/grains_000001.vtp", None, "grains_000001.vtp"),
    ] {
        let path = desk.path(&format!("whole/{file}"));
        let before = std::fs::read(&path).unwrap();
        match content {
            Some(content) => std::fs::write(&path, content).unwrap(),
            None => std::fs::remove_file(&path).unwrap(),
        }
        let ended = desk.run("report whole");
        assert_eq!(ended.code, Some(3), "{file} {content:?}: {}", ended.stderr);
        assert!(ended.stderr.contains(told) && ended.stdout.contains("report.html"), "{file}: {}", ended.stderr);
        std::fs::write(&path, before).unwrap();
    }
    assert_eq!(desk.run("report whole").code, Some(0));
}

/// Grains that fell out of a scene were told nowhere; they shrank in the pictures.
#[test]
fn grains_that_leave_the_scene_are_told() {
    let scene = "gravity = \"10 m/s^2\"\nduration = \"0.3 s\"\n[materials.glass]\nyoung-modulus = \"10 MPa\"\n[particles.balls]\n\
                 material = \"glass\"\ncount = 20\ndiameter = \"6 mm\"\nmass = \"0.2 g\"\nstart.rows = {}\n[walls.box]\nmaterial = \"glass\"\n\
                 shape.box = { width = \"60 mm\", height = \"96 mm\" }\nuntil = \"10 ms\"\n[output]\nhistory-interval = \"1 ms\"\n";
    let desk = Desk::with(scene);
    desk.done("run balls.toml -q -o out");
    let told = |folder: &str| desk.summary(folder)["warnings"].to_string();
    assert!(told("out").contains("20 grains have left the scene"), "{}", told("out"));
    assert!(told("out").contains("was seen at t = 0."), "{}", told("out"));
    desk.done("report out");
    assert!(desk.read("out/report.html").contains("have left the scene"));
    // The controls: with a floor far below, or somebody who takes them out there, all is well.
    let plane = "[walls.floor]\nmaterial = \"glass\"\nshape.plane.point = [0, \"-5 m\"]\n";
    let drain = "[removal.below]\nbehind.point = [0, \"-5 m\"]\n";
    for (folder, more) in [("floor", plane), ("drain", drain)] {
        std::fs::write(desk.path(&format!("{folder}.toml")), format!("{scene}{more}")).unwrap();
        desk.done(&format!("run {folder}.toml -q -o {folder}"));
        assert!(!told(folder).contains("left the scene"), "{}", told(folder));
    }
}
