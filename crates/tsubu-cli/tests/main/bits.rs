//! Promise 1 of the contract: the same scene and seed give the same bits, however they are computed.

use crate::support::{Desk, SCENE, signal, wait_for};
use std::fs;

/// Long enough to be hit in the middle, with checkpoints to go on from.
const LONG: &str =
    "--set 'duration=0.6 s' --set 'output.checkpoint-interval=0.05 s' --set 'output.history-interval=5 ms'";
/// Shaken less: in so long a time it would shake itself out of the automaton's grid.
const LONG_LATTICE: &str = "--set method=lattice --set 'duration=20 s' --set 'output.checkpoint-interval=1 s' \
    --set 'output.frame-interval=1 s' --set 'hosts.spring.base.sine.amplitude=0.2 mm'";

#[test]
fn any_number_of_threads() {
    let desk = Desk::new();
    for method in ["dem", "lattice"] {
        let hashes = [1, 2, 7].map(|threads| {
            desk.done(&format!("run balls.toml --set method={method} -o {method}{threads} --threads {threads} -q"));
            desk.hash(&format!("{method}{threads}"))
        });
        assert_eq!(hashes[0], hashes[1], "{method}");
        assert_eq!(hashes[0], hashes[2], "{method}");
    }
}

/// Fifty balls never leave one thread; this scene does.
#[test]
fn threads_that_are_really_used() {
    let scene = SCENE
        .replace("count = 20", "count = 2500")
        .replace("spacing = 1.1", "spacing = 1.01")
        .replace("width = \"60 mm\", height = \"96 mm\"", "width = \"400 mm\", height = \"400 mm\"")
        .replace("duration = \"0.05 s\"", "duration = \"2 ms\"");
    let desk = Desk::with(&scene);
    let hashes = [1, 2, 7].map(|threads| {
        desk.done(&format!("run balls.toml -o t{threads} --threads {threads} -q"));
        assert_eq!(desk.summary(&format!("t{threads}"))["threads"], threads);
        assert!(desk.summary(&format!("t{threads}"))["contacts_mean"].as_f64().unwrap() > 100.0);
        desk.hash(&format!("t{threads}"))
    });
    assert_eq!(hashes[0], hashes[1]);
    assert_eq!(hashes[0], hashes[2]);
}

/// Starts a run, stops it at its first checkpoint by a signal, goes on with it, and compares with a run in one go.
fn stopped_and_resumed(options: &str, how: &str) {
    let desk = Desk::new();
    desk.done(&format!("run balls.toml {options} -o whole -q"));
    let mut child = desk.start(&format!("run balls.toml {options} -o cut -q"));
    wait_for(&desk.path("cut/checkpoint/state.tsubu"));
    signal(&child, how);
    let status = child.wait().unwrap();
    if how == "INT" {
        assert_eq!(status.code(), Some(130), "the run ended before it could be interrupted");
        assert_eq!(desk.summary("cut")["status"], "interrupted");
    } else {
        assert_eq!(status.code(), None, "the run ended before it could be killed");
    }
    desk.done(&format!("run balls.toml {options} -o cut -q --resume"));
    assert_eq!(desk.hash("whole"), desk.hash("cut"));
    assert_eq!(desk.read("whole/history.csv"), desk.read("cut/history.csv"));
    let frames = |folder: &str| fs::read_dir(desk.path(&format!("{folder}/frames"))).unwrap().count();
    assert_eq!(frames("whole"), frames("cut"));
}

#[test]
fn dem_killed_and_resumed() {
    stopped_and_resumed(LONG, "KILL");
}

#[test]
fn dem_interrupted_and_resumed() {
    stopped_and_resumed(LONG, "INT");
}

#[test]
fn lattice_killed_and_resumed() {
    stopped_and_resumed(LONG_LATTICE, "KILL");
}

#[test]
fn lattice_interrupted_and_resumed() {
    stopped_and_resumed(LONG_LATTICE, "INT");
}

/// Watches of every sort: some remember, some have tables, some look at times of their own.
const WATCHES: &str = r#"
[watch.gate]
discharge = { point = [0, "10 mm"], normal = "z" }
[watch.late]
from = "0.11 s"
until = "0.52 s"
every = "13 ms"
coordination = {}
[watch.layers]
profile.bins = 5
[watch.field]
every = "20 ms"
coarse-grain = { width = "8 mm", axes = ["x", "z"], points = [6, 8] }
[watch.chains]
forces.bins = 4
[watch.some]
every = "7 ms"
track.ids = [0, 7]
[watch.box]
wall-load.wall = "box"
[watch.sand]
hops.bed = ["walls", "free-grains"]
[watch.load]
bedload = {}
[watch.out]
every = "20 ms"
run-out = {}
"#;

#[test]
fn watches_killed_and_resumed_say_the_same() {
    let desk = Desk::with(&format!("{SCENE}{WATCHES}"));
    desk.done(&format!("run balls.toml {LONG} -o whole -q"));
    let mut child = desk.start(&format!("run balls.toml {LONG} -o cut -q"));
    wait_for(&desk.path("cut/checkpoint/state.tsubu"));
    signal(&child, "KILL");
    assert_eq!(child.wait().unwrap().code(), None, "the run ended before it could be killed");
    desk.done(&format!("run balls.toml {LONG} -o cut -q --resume"));
    for name in ["layers", "field", "chains", "some", "sand", "out"] {
        let file = format!("watch/{name}.csv");
        assert_eq!(desk.read(&format!("whole/{file}")), desk.read(&format!("cut/{file}")), "{file}");
    }
    assert_eq!(desk.read("whole/history.csv"), desk.read("cut/history.csv"));
    let results = desk.summary("whole")["results"].clone();
    assert_eq!(results, desk.summary("cut")["results"]);
    assert!(results["gate passed grains final"].as_f64().is_some() && results["late mean"].as_f64().unwrap() > 0.0);
    // The control: another seed says something else.
    desk.done(&format!("run balls.toml {LONG} -o other -q --set seed=99"));
    assert_ne!(desk.read("whole/watch/layers.csv"), desk.read("other/watch/layers.csv"));
}

#[test]
fn a_finished_run_resumes_to_itself() {
    let desk = Desk::new();
    desk.done("run balls.toml -q");
    let before = desk.hash("out/balls");
    desk.done("run balls.toml -q --resume");
    assert_eq!(desk.hash("out/balls"), before);
}

/// A finished run was refused when its scene was to last longer, although nothing that had been computed would change.
#[test]
fn a_finished_run_goes_on_for_longer() {
    let desk = Desk::with(&format!("{SCENE}{WATCHES}"));
    let rows = "--set 'output.history-interval=5 ms' --set 'output.frame-interval=20 ms'";
    for method in ["dem", "lattice"] {
        let watches = if method == "dem" { "" } else { "--set watch={}" };
        let options = format!("balls.toml -q --set method={method} {watches} {rows}");
        let [whole, cut] = ["whole", "cut"].map(|name| format!("{method}-{name}"));
        desk.done(&format!("run {options} --set 'duration=0.2 s' -o {whole}"));
        desk.done(&format!("run {options} --set 'duration=0.12 s' -o {cut}"));
        assert_ne!(desk.hash(&whole), desk.hash(&cut));
        // What is written and claimed may change with it.
        let later = "--set 'duration=0.2 s' --set title=longer";
        desk.done(&format!("run {options} {later} -o {cut} --resume"));
        assert_eq!(desk.hash(&whole), desk.hash(&cut));
        assert_eq!(desk.read(&format!("{whole}/history.csv")), desk.read(&format!("{cut}/history.csv")));
        assert_eq!(desk.summary(&whole)["results"], desk.summary(&cut)["results"]);
        assert!(desk.read(&format!("{cut}/scene.toml")).contains("duration = 0.2"));
        let frames = |folder: &str| fs::read_dir(desk.path(&format!("{folder}/frames"))).unwrap().count();
        assert_eq!(frames(&whole), frames(&cut));
        // What decides the steps may not.
        for change in ["gravity=9", "seed=3", "duration=0.1"] {
            let refused = desk.run(&format!("run {options} {later} -o {cut} --resume --set {change}"));
            assert_eq!(refused.code, Some(2), "{change}");
            assert!(refused.stderr.contains("the checkpoint in"), "{}", refused.stderr);
        }
    }
}

#[test]
fn the_scene_of_a_run_folder_gives_the_same_run() {
    let desk = Desk::new();
    for method in ["dem", "lattice"] {
        desk.done(&format!("run balls.toml -q --set method={method} --set seed=7 -o first-{method}"));
        desk.done(&format!("run first-{method}/scene.toml -q -o second-{method}"));
        assert_eq!(desk.hash(&format!("first-{method}")), desk.hash(&format!("second-{method}")));
        assert_eq!(desk.read(&format!("first-{method}/scene.toml")), desk.read(&format!("second-{method}/scene.toml")));
    }
}

#[test]
fn the_seed_matters() {
    let desk = Desk::new();
    desk.done("run balls.toml -q -o one");
    desk.done("run balls.toml -q -o other --set seed=99");
    assert_ne!(desk.hash("one"), desk.hash("other"));
}

#[test]
fn damaged_checkpoints_are_refused() {
    let desk = Desk::new();
    desk.done("run balls.toml -q -o run");
    let file = desk.path("run/checkpoint/state.tsubu");
    let whole = fs::read(&file).unwrap();
    fs::write(&file, &whole[..whole.len() / 2]).unwrap();
    let cut = desk.run("run balls.toml -q -o run --resume");
    assert_eq!(cut.code, Some(2));
    assert!(cut.stderr.contains("cut short"), "{}", cut.stderr);

    let mut altered = whole.clone();
    altered[whole.len() / 2] ^= 1;
    fs::write(&file, altered).unwrap();
    let altered = desk.run("run balls.toml -q -o run --resume");
    assert_eq!(altered.code, Some(2));
    assert!(altered.stderr.contains("was altered"), "{}", altered.stderr);

    fs::write(&file, whole).unwrap();
    let other = desk.run("run balls.toml -q -o run --resume --set seed=3");
    assert_eq!(other.code, Some(2));
    assert!(other.stderr.contains("belongs to another scene"), "{}", other.stderr);

    fs::remove_file(&file).unwrap();
    let none = desk.run("run balls.toml -q -o run --resume");
    assert_eq!(none.code, Some(2));
    assert!(none.stderr.contains("nothing to resume"), "{}", none.stderr);
}

#[test]
fn an_interrupted_response_goes_on() {
    let desk = Desk::new();
    desk.done("response balls.toml -q -o whole");
    let mut child = desk.start("response balls.toml -q -o cut --threads 1");
    let journal = desk.path("cut/progress.jsonl");
    wait_for(&journal);
    while child.try_wait().unwrap().is_none() && fs::read_to_string(&journal).unwrap().lines().count() < 5 {
        std::thread::sleep(std::time::Duration::from_millis(2));
    }
    signal(&child, "INT");
    assert_eq!(child.wait().unwrap().code(), Some(130), "the response ended before it could be interrupted");
    assert_eq!(desk.summary("cut")["status"], "interrupted");
    let done = fs::read_to_string(&journal).unwrap();
    desk.done("response balls.toml -q -o cut");
    assert!(desk.read("cut/progress.jsonl").starts_with(&done), "what was done was done again");
    assert_eq!(desk.read("whole/response.csv"), desk.read("cut/response.csv"));
}
