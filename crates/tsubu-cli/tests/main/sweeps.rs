//! Sweeps: every case a run of its own, what is done kept, what goes wrong told beside the others.

use crate::support::{Desk, SCENE};

#[test]
fn a_sweep_runs_every_case_and_keeps_what_is_done() {
    let desk = Desk::new();
    let shown = desk.done("sweep balls.toml -q --jobs 2").stdout;
    assert!(shown.contains("restitution = 0.5"), "{shown}");
    assert_eq!(desk.read("out/balls-sweep/sweep.csv").lines().count(), 5);
    let hash = |case: &str| desk.hash(&format!("out/balls-sweep/cases/{case}"));
    assert_ne!(hash("restitution=0.5"), hash("restitution=0.8"));
    let before = desk.read("out/balls-sweep/cases/restitution=0.7/summary.json");
    std::fs::remove_dir_all(desk.path("out/balls-sweep/cases/restitution=0.6")).unwrap();
    desk.done("sweep balls.toml -q --jobs 1");
    assert_eq!(
        desk.read("out/balls-sweep/cases/restitution=0.7/summary.json"),
        before,
        "a finished case was run again"
    );
    assert!(desk.path("out/balls-sweep/cases/restitution=0.6/summary.json").exists());
}

/// Finished cases of another scene were replaced without a word.
#[test]
fn a_sweep_leaves_what_another_scene_has_given() {
    let desk = Desk::new();
    desk.done("sweep balls.toml -q -o out");
    let hash = || desk.hash("out/cases/restitution=0.7");
    let before = hash();
    for line in ["sweep balls.toml -o out --set duration=0.06", "sweep balls.toml -o out --set duration=0.06 --resume"]
    {
        let ended = desk.run(line);
        assert_eq!(ended.code, Some(2), "{}", ended.stderr);
        assert!(ended.stderr.contains("`duration` was 0.05, is 0.06"), "{}", ended.stderr);
        assert!(!ended.stderr.contains("sweep.vary"), "{}", ended.stderr);
        assert_eq!(hash(), before);
    }
    // What else is varied is nothing to a case.
    desk.done("sweep balls.toml -q -o out --set 'sweep.vary={\"materials.acrylic.restitution\"=[0.7, 0.9]}'");
    assert_eq!(hash(), before);
    desk.done("sweep balls.toml -q -o out --set duration=0.06 --overwrite");
    assert_ne!(hash(), before);
}

/// Cases that were done stayed when the run that they began from had gone on, beside others of another begin.
#[test]
fn a_sweep_keeps_no_case_of_another_begin() {
    let desk = Desk::new();
    desk.done("run balls.toml -q -o bed");
    let longer = ["--set start-from=bed", "--set duration=0.1"].join(" ");
    let line = format!("sweep balls.toml -o out {longer}");
    desk.done(&line);
    let hash = || desk.hash("out/cases/restitution=0.7");
    let before = hash();
    desk.done(&line);
    // The folder alone tells what began there, as a task of a cluster reads it; other beginnings may be varied.
    desk.done("sweep out -o out -q --case restitution=0.7");
    desk.done("run balls.toml -q -o other --set duration=0.06");
    desk.done("sweep out -o ways --set 'sweep.vary={start-from=[\"../bed\", \"../other\"]}'");
    assert_eq!(hash(), before);
    desk.done("run balls.toml -q -o bed --resume --set duration=0.07");
    let resumed = desk.run(&line);
    assert_eq!(resumed.code, Some(2), "{}", resumed.stderr);
    assert!(resumed.stderr.contains("`start-fingerprint` was"), "{}", resumed.stderr);
    let task = desk.run("sweep out -o out --case restitution=0.7");
    assert!(task.code == Some(2) && task.stderr.contains("has gone on, or was made anew"), "{}", task.stderr);
    assert_eq!(hash(), before);
    desk.done(&format!("{line} --overwrite"));
    assert_ne!(hash(), before);
}

/// A case that took long enough for a checkpoint on its way kept that one when it was done, and whoever started from the case began in its
/// middle.
#[test]
fn finished_cases_keep_no_checkpoint() {
    let desk = Desk::new();
    desk.done("sweep balls.toml -q --jobs 1 --set 'duration=1 s' --set 'sweep.vary={\"materials.acrylic.restitution\"=[0.5]}'");
    let left: Vec<String> = desk.files().into_iter().filter(|file| file.ends_with("state.tsubu")).collect();
    assert!(left.is_empty(), "{left:?}");
}

/// Results stood in the order of the alphabet, in the unit `[SI]`: a calibration showed eight densities, and no heap angle.
#[test]
fn a_sweep_tells_results_as_the_scene_asks_for_them() {
    let asked = "[watch.zone]\nslope.touching = false\n[watch.bed]\ncoordination = {}\n\
                 [[claim]]\nresult = \"bed rattlers final\"\nhigh = 1\nsource = \"here\"\n";
    let desk = Desk::with(&format!("{SCENE}\n{asked}"));
    let shown = desk.done("sweep balls.toml -q --jobs 2").stdout;
    let header = desk.read("out/balls-sweep/sweep.csv").lines().next().unwrap().to_owned();
    let at = |name: &str| header.find(name).unwrap_or_else(|| panic!("{name}: {header}"));
    let order =
        ["status [text]", "bed rattlers final [-]", "zone heap angle [rad]", "bed mean [-]", "momentum residual [N.s]"];
    assert!(order.map(at).is_sorted(), "{header}");
    assert!(!header.contains("[SI]"), "{header}");
    let first = shown.lines().next().unwrap();
    assert!(first.contains("bed rattlers final") && first.contains("zone angle [°]"), "{shown}");
    let summary = desk.summary("out/balls-sweep/cases/restitution=0.5");
    assert_eq!(summary["units"]["zone angle final"], "rad");
    assert_eq!(summary["units"]["host spring rms displacement"], "m");
    assert!(desk.read("out/balls-sweep/sweep.json").contains("wall_seconds"));
}

/// A case whose grains would not settle ended the sweep, with no table and no results of the others.
#[test]
fn a_case_that_does_not_settle_is_told_beside_the_others() {
    let scene =
        SCENE.replace("start.rows = { spacing = 1.1, jitter = 0.5, speed = 0.3 }", "start.settled = {}").replace(
            "\"materials.acrylic.restitution\" = [0.5, 0.6, 0.7, 0.8]",
            "\"particles.balls.start.settled.time\" = [\"10 ms\", \"2 s\"]",
        );
    let desk = Desk::with(&scene);
    let ended = desk.run("sweep balls.toml -q --jobs 2");
    assert_eq!(ended.code, Some(3), "{}", ended.stderr);
    let table = desk.read("out/balls-sweep/sweep.csv");
    assert!(table.contains("failed") && table.contains("finished"), "{table}");
}

/// One case that blew up ended the whole sweep: what the others gave was on the disk and in no table.
#[test]
fn a_case_that_fails_is_told_beside_the_others() {
    let vary = SCENE
        .replace("\"materials.acrylic.restitution\" = [0.5, 0.6, 0.7, 0.8]", "\"dem.largest-overlap\" = [0.1, 1e-9]");
    let desk = Desk::with(&vary);
    let ended = desk.run("sweep balls.toml -q --jobs 2");
    assert_eq!(ended.code, Some(3), "{}", ended.stderr);
    assert!(
        ended.stdout.contains("failed") && ended.stdout.contains("case `largest-overlap = 0.000000001`: "),
        "{}",
        ended.stdout
    );
    assert!(ended.stderr.contains("1 of 2 cases failed"), "{}", ended.stderr);
    let table = desk.read("out/balls-sweep/sweep.csv");
    assert!(
        table.lines().nth(1).unwrap().contains("finished") && table.lines().nth(2).unwrap().contains("overlap"),
        "{table}"
    );
    desk.done("report out/balls-sweep");
    let page = desk.read("out/balls-sweep/report.html");
    assert!(page.contains("1 case failed") && page.contains("overlaps"), "the page does not say it");
}
