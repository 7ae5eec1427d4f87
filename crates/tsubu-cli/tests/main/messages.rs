use crate::support::{Desk, SCENE, is};
use insta::assert_snapshot;
use std::fs;
use std::process::Command;

/// Runs a scene with something wrong in it; nothing may be written.
fn refused(find: &str, replace: &str) -> String {
    assert!(SCENE.contains(find), "{find}");
    let desk = Desk::with(&SCENE.replacen(find, replace, 1));
    let shown = desk.shown("run balls.toml");
    assert!(shown.ends_with("--- exit code 2\n--- files: balls.toml"), "{shown}");
    shown
}

#[test]
fn misspelt_key() {
    assert_snapshot!(refused("restitution =", "restitutoin ="));
}

#[test]
fn wrong_unit() {
    assert_snapshot!(refused("diameter = \"6 mm\"", "diameter = \"6 kg\""));
}

#[test]
fn missing_unit() {
    assert_snapshot!(refused("diameter = \"6 mm\"", "diameter = \"6\""));
}

#[test]
fn negative_mass() {
    assert_snapshot!(refused("mass = \"0.2 g\"", "mass = \"-0.2 g\""));
}

#[test]
fn overlapping_balls() {
    let rows =
        "count = 20\ndiameter = \"6 mm\"\nmass = \"0.2 g\"\nstart.rows = { spacing = 1.1, jitter = 0.5, speed = 0.3 }";
    let at = "diameter = \"6 mm\"\nmass = \"0.2 g\"\nstart.at = { position = [[0, \"10 mm\"], [\"2 mm\", \"12 mm\"]] }";
    let scene = SCENE.replace(rows, at);
    let cut = scene[..scene.find("[response]").unwrap()].to_owned();
    let desk = Desk::with(&cut);
    assert_snapshot!(desk.shown("run balls.toml"));
}

#[test]
fn more_balls_than_fit() {
    assert_snapshot!(refused("count = 20", "count = 2000"));
}

#[test]
fn everything_at_once() {
    let scene = SCENE
        .replace("restitution =", "restitutoin =")
        .replace("\"6 mm\"", "\"6 kg\"")
        .replace("count = 20", "count = -1");
    assert_snapshot!(Desk::with(&scene).shown("check balls.toml"));
}

#[test]
fn no_such_scene() {
    assert_snapshot!(Desk::empty().shown("run nothing.toml"));
}

#[test]
fn a_scene_that_is_no_text() {
    let desk = Desk::empty();
    fs::write(desk.path("balls.toml"), [0x89, 0x50, 0xff, 0x00]).unwrap();
    assert_snapshot!(desk.shown("run balls.toml"));
}

#[test]
fn not_a_number_in_a_table() {
    let scene = SCENE
        .replace("base.sine = { amplitude = \"5 mm\", frequency = \"6 Hz\" }", "base.table = { file = \"base.csv\" }");
    let cut = scene[..scene.find("[response]").unwrap()].to_owned();
    let desk = Desk::with(&cut);
    fs::write(desk.path("base.csv"), "time [s],displacement [m]\n0,0\n0.1,nan\n0.2,0.001\n").unwrap();
    assert_snapshot!(desk.shown("run balls.toml"));
}

#[test]
fn a_method_that_cannot() {
    let two = "[particles.giants]\nmaterial = \"acrylic\"\ncount = 2\ndiameter = \"9 mm\"\nmass = \"0.7 g\"\nstart.settled = {}\n\n[walls.box]";
    let scene = SCENE
        .replace("[walls.box]", two)
        .replace("start.rows = { spacing = 1.1, jitter = 0.5, speed = 0.3 }", "start.settled = {}");
    let desk = Desk::with(&scene);
    assert_snapshot!(desk.shown("run balls.toml --set method=lattice"));
    let response = desk.run("response balls.toml --set method=lattice");
    assert_eq!(response.code, Some(2), "{}", response.stderr);
    let compare = desk.run("compare balls.toml --methods dem,lattice");
    assert_eq!(compare.code, Some(2), "{}", compare.stderr);
    assert_eq!(desk.files(), ["balls.toml"]);
}

#[test]
fn a_variant_that_is_wrong() {
    let desk = Desk::new();
    for (methods, said) in [
        ("dem,dem", "`dem` is named twice"),
        ("dem:contact.rotation", "`contact.rotation` changes nothing"),
        ("all=dem", "`all` means something else"),
        ("../dem=dem", "cannot be the name of a column and a folder"),
        ("dem:contact.rotaton=false", "did you mean `rotation`?"),
        ("dem:contact.rotation=perhaps", "`rotation` needs true or false"),
    ] {
        let ended = desk.run(&format!("compare balls.toml --methods {methods}"));
        assert_eq!(ended.code, Some(2), "{methods}: {}", ended.stderr);
        assert!(ended.stderr.contains(said), "{methods}: {}", ended.stderr);
    }
    assert_eq!(desk.files(), ["balls.toml"]);
}

#[test]
fn an_output_folder_that_exists() {
    let desk = Desk::new();
    fs::create_dir_all(desk.path("out/balls")).unwrap();
    fs::write(desk.path("out/balls/mine.txt"), "").unwrap();
    assert_snapshot!(desk.shown("run balls.toml"));
    for command in [
        "response balls.toml -o out/balls",
        "sweep balls.toml -o out/balls",
        "compare balls.toml --methods dem -o out/balls",
    ] {
        let ended = desk.run(command);
        assert_eq!(ended.code, Some(2), "{command}: {}", ended.stderr);
        assert!(ended.stderr.contains("not empty"), "{}", ended.stderr);
    }
    assert_eq!(desk.files(), ["balls.toml", "out/balls/mine.txt"]);
}

#[test]
fn an_output_folder_that_cannot_be() {
    let desk = Desk::new();
    assert_snapshot!(desk.shown("run balls.toml -o balls.toml/out"));
}

#[test]
fn a_step_too_long_is_warned_of() {
    let desk = Desk::new();
    let check = desk.done("check balls.toml --set 'dem.time-step=50 us'");
    assert!(check.stdout.contains("warn balls on balls: contact time"), "{}", check.stdout);
    assert!(check.stdout.contains("change: `dem.time-step` to"), "{}", check.stdout);
    let strict = desk.run("check balls.toml --strict --set 'dem.time-step=50 us'");
    assert_eq!(strict.code, Some(2));
    assert!(strict.stderr.contains("`--strict` lets none pass"), "{}", strict.stderr);
    assert_eq!(desk.files(), ["balls.toml"]);
}

#[test]
fn a_run_that_blows_up_keeps_what_it_has() {
    let desk = Desk::new();
    // It said that the run would fail, and then that the scene can be run.
    let check = desk.run("check balls.toml --set 'dem.time-step=1 ms'");
    assert!(check.stdout.contains("warn the run would fail: step "), "{}", check.stdout);
    assert!(check.stderr.starts_with("error: the scene cannot be run as it is\n"), "{}", check.stderr);
    assert_eq!(check.code, Some(2));
    let none = desk.run("check balls.toml --set 'dem.time-step=5 s'");
    assert!(none.stdout.contains("the run would have no step") || none.stderr.contains("time-step"), "{}", none.stdout);
    assert_eq!(none.code, Some(2));
    let ended = desk.run("run balls.toml -q -o blown --set 'dem.time-step=1 ms'");
    assert_eq!(ended.code, Some(3), "{}", ended.stderr);
    assert!(ended.stderr.starts_with("error: step "), "{}", ended.stderr);
    assert!(ended.stderr.contains("hint: what was computed so far is kept in blown"), "{}", ended.stderr);
    let summary = desk.summary("blown");
    assert_eq!(summary["status"], "failed");
    let warnings = summary["warnings"].as_array().unwrap();
    assert!(warnings.iter().any(|w| w.as_str().unwrap().starts_with("step ")), "{warnings:?}");
    assert!(desk.read("blown/history.csv").lines().count() > 1);
}

#[test]
fn a_full_disk() {
    let desk = Desk::new();
    let disk = desk.path("disk");
    fs::create_dir(&disk).unwrap();
    let mounted = Command::new("mount").args(["-t", "tmpfs", "-o", "size=256k", "tmpfs"]).arg(&disk).output();
    if !mounted.is_ok_and(|out| out.status.success()) {
        eprintln!("skipped: only root may mount the small disk that this test fills");
        return;
    }
    let ended = desk.run("run balls.toml -q -o disk/run --set 'output.frame-interval=0.2 ms'");
    let files = desk.files();
    let (summary, rows) = (desk.summary("disk/run"), desk.read("disk/run/history.csv").lines().count());
    let unmounted = Command::new("umount").arg(&disk).status().unwrap();
    assert_eq!(ended.code, Some(3), "{}", ended.stderr);
    assert!(ended.stderr.starts_with("error: step ") && ended.stderr.contains(": cannot write "), "{}", ended.stderr);
    assert!(ended.stderr.contains("hint: the disk is full"), "{}", ended.stderr);
    // What became of the run is told, with the rows up to there.
    assert_eq!(summary["status"], "failed");
    assert!(rows > 2, "{rows}");
    assert!(!ended.stderr.contains("panicked"), "{}", ended.stderr);
    assert!(files.iter().all(|file| !is(file, "tmp")), "half-written: {files:?}");
    assert!(unmounted.success());
}

#[test]
fn a_mesh_with_holes_and_flipped_triangles_is_described() {
    let scene = "dimension = 3\nduration = \"1 ms\"\n\
        [materials.steel]\nyoung-modulus = \"10 MPa\"\ndensity = \"7800 kg/m^3\"\n\
        [particles.ball]\nmaterial = \"steel\"\ndiameter = \"6 mm\"\nstart.at = { position = [[0.5, 0.5, 0.5]] }\n\
        [walls.crate]\nmaterial = \"steel\"\nshape.mesh = { path = \"crate.obj\" }\n";
    // A cube without one half of its lid, with one triangle turned and one twice.
    let cube = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n\
        f 1 3 4\nf 1 4 2\nf 5 6 8\nf 1 2 6\nf 1 6 5\nf 3 7 8\nf 3 8 4\nf 1 5 7\nf 1 7 3\nf 2 8 4\nf 2 8 6\nf 3 7 8\n";
    let desk = Desk::with(scene);
    fs::write(desk.path("crate.obj"), cube).unwrap();
    let shown = desk.shown("check balls.toml");
    let told: Vec<&str> = shown.lines().skip_while(|line| !line.contains("`crate`")).collect();
    let told =
        told.into_iter().filter(|line| line.contains("`crate`") || line.contains("mesh file")).collect::<Vec<_>>();
    assert_snapshot!(told.join("\n"));
}

/// What a method had against a scene came without file, line and text, unlike all other errors of a scene.
#[test]
fn a_refusal_shows_where_it_stands() {
    let desk = Desk::with(&SCENE.replace("title =", "removal.below.behind.point = [0, -1]\ntitle ="));
    for command in ["check", "run"] {
        let ended = desk.run(&format!("{command} balls.toml --set method=lattice"));
        assert_eq!(ended.code, Some(2), "{}", ended.stderr);
        assert!(ended.stderr.contains("--> balls.toml:2:"), "{}", ended.stderr);
        assert!(ended.stderr.contains("removal.below.behind.point = [0, -1]"), "{}", ended.stderr);
        assert!(ended.stderr.contains("hint: use `method = \"dem\"`"), "{}", ended.stderr);
    }
}

/// Studies told what a method refuses without saying where it stands.
#[test]
fn refusals_of_studies_are_shown_where_they_stand() {
    let text = SCENE.replace("title =", "removal.below.behind.point = [0, -1]\nmethod = \"lattice\"\ntitle =");
    let desk = Desk::with(&text);
    for line in [
        "sweep balls.toml",
        "response balls.toml",
        "compare balls.toml --methods lattice,litwiniszyn",
        "compare balls.toml --methods all --set water.density=1000 --set dem.time-step=1 --set duration=10",
    ] {
        let ended = desk.run(line);
        assert_eq!(ended.code, Some(2), "{line}: {}", ended.stderr);
        assert!(ended.stderr.contains("--> balls.toml:2:"), "{line}: {}", ended.stderr);
        assert!(ended.stderr.contains("removal.below.behind.point = [0, -1]"), "{line}: {}", ended.stderr);
    }
    let ended = desk.run("sweep balls.toml");
    assert!(ended.stderr.contains("in the case `"), "{}", ended.stderr);
    assert_eq!(desk.files(), ["balls.toml"]);
}

mod patient {
    use super::*;

    /// `check` went on for minutes without a word: a contact of almost no mass takes so many steps that grains never come to rest.
    #[test]
    #[ignore = "ten seconds: cargo xtask patient"]
    fn check_ends_though_grains_do_not_settle() {
        let settled = SCENE.replace("start.rows = { spacing = 1.1, jitter = 0.5, speed = 0.3 }", "start.settled = {}");
        let desk = Desk::with(&settled);
        let begun = std::time::Instant::now();
        let ended = desk.done("check balls.toml --set 'dem.time-step=1e-12 s'");
        assert!(begun.elapsed().as_secs() < 25, "{:?}", begun.elapsed());
        assert!(ended.stdout.contains("is still at settling the grains before time 0"), "{}", ended.stdout);
        assert!(ended.stdout.contains("ok   speed scale"), "{}", ended.stdout);
    }
}

/// A bed that was still falling when its time was over was stopped in the air, and the run began from there as if it had settled.
#[test]
fn grains_that_do_not_come_to_rest_are_told() {
    let settled =
        SCENE.replace("start.rows = { spacing = 1.1, jitter = 0.5, speed = 0.3 }", "start.settled.time = 0.05");
    let desk = Desk::with(&settled);
    let ended = desk.run("run balls.toml --set materials.acrylic.restitution=1 --set materials.acrylic.friction=0");
    assert_eq!(ended.code, Some(3), "{}", ended.stderr);
    for part in [
        "while settling before time 0: after",
        "0.05",
        "have not come to rest: grain",
        "hint: raise `start.settled.time`",
    ] {
        assert!(ended.stderr.contains(part), "{}", ended.stderr);
    }
    assert_eq!(desk.files(), ["balls.toml"]);
    // Until it is at rest, or nearly so.
    assert_eq!(desk.run("run balls.toml --set particles.balls.start.settled.time=1").code, Some(0));
}

/// A hundred million grains were placed until the memory was gone, and the program broke off with a backtrace.
#[test]
fn more_grains_than_memory_are_refused_with_numbers() {
    let many = SCENE.replace("count = 20", "count = 100_000_000").replace(
        "start.rows = { spacing = 1.1, jitter = 0.5, speed = 0.3 }",
        "start.random.region = { low = [-9e3, -9e3], high = [9e3, 9e3] }",
    );
    let desk = Desk::with(&many[..many.find("[response]").unwrap()].replace("[walls.box]", "[walls.plate]").replace(
        "shape.box = { width = \"60 mm\", height = \"96 mm\", depth = \"6 mm\" }",
        "shape.plane.point = [0, -1e4]",
    ));
    let tsubu = assert_cmd::cargo::cargo_bin("tsubu");
    for command in ["check", "run"] {
        let limited = format!("ulimit -v 6000000; '{}' {command} balls.toml", tsubu.display());
        let out = Command::new("sh").args(["-c", &limited]).current_dir(desk.path("")).output().unwrap();
        let told = String::from_utf8_lossy(&out.stderr);
        assert_eq!(out.status.code(), Some(2), "{told}");
        assert!(told.contains("100000000 grains take about 100.01 GB of memory, more than the"), "{told}");
        assert!(!told.contains("panicked") && !told.contains("allocation"), "{told}");
    }
    assert_eq!(desk.files(), ["balls.toml"]);
}

/// At a tenth of the natural frequency a period is ten times as long; a run of ninety-six million hours was "ok".
#[test]
fn check_tells_the_time_of_slow_drives_and_of_endless_runs() {
    let desk = Desk::new();
    let seconds = |ratio: &str| {
        let ended = desk.run(&format!("check balls.toml --set 'response.frequency-ratio=[{ratio}]'"));
        let line = ended.stdout.lines().find(|line| line.contains("`tsubu response`")).unwrap().to_owned();
        let mut words = line.split("for `tsubu").next().unwrap().split_whitespace().rev();
        let unit = match words.next() {
            Some("h") => 3600.0,
            Some("min") => 60.0,
            Some("s") => 1.0,
            Some("ms") => 1e-3,
            other => panic!("{other:?}: {line}"),
        };
        unit * words.next().unwrap().parse::<f64>().unwrap()
    };
    let slow = seconds("0.01") / seconds("1.0");
    assert!((20.0..500.0).contains(&slow), "{slow}");
    let outputs = "--set output.history-interval=1e7 --set output.frame-interval=1e8";
    let endless = desk.run(&format!("check balls.toml --set 'duration=1e9 s' {outputs}"));
    assert!(endless.stdout.contains("warn time: about"), "{}", endless.stdout);
}

/// A response that was to go on with another scene was told to use `--resume`, which it had, and not what differed; `--jobs` was called
/// `--threads`.
#[test]
fn a_study_does_not_go_on_with_another_scene_and_options_have_the_names_that_were_typed() {
    let desk = Desk::new();
    let ratios = "--set 'response.frequency-ratio=[1.0]'";
    desk.done(&format!("response balls.toml -q -o curve --set method=lattice {ratios}"));
    let before = desk.files();
    let other =
        format!("response balls.toml -q -o curve --set method=lattice {ratios} --set materials.acrylic.friction=0.9");
    for resume in ["", " --resume"] {
        let refused = desk.run(&format!("{other}{resume}"));
        assert_eq!(refused.code, Some(2), "{}", refused.stderr);
        for part in [
            "the results in curve belong to another scene; what differs:",
            "`materials.acrylic.friction` was",
            "is 0.9",
            "`--overwrite`",
        ] {
            assert!(refused.stderr.contains(part), "{}", refused.stderr);
        }
    }
    // What decides the points of a response, and no step of a run, is named too.
    let more = desk.run("response balls.toml -q -o curve --set method=lattice --set 'response.frequency-ratio=[0.9]'");
    assert!(more.stderr.contains("`response.frequency-ratio` was"), "{}", more.stderr);
    assert_eq!(desk.files(), before);
    let none = desk.run("sweep balls.toml --jobs 0");
    assert!(none.code == Some(2) && none.stderr.contains("'--jobs <N>'"), "{}", none.stderr);
    assert!(!none.stderr.contains("--threads <N>"), "{}", none.stderr);
}

/// One case that blew up took all the others of a response with it, hours of them.
#[test]
fn a_response_keeps_the_cases_that_do_not_fail() {
    let vary = "vary = { \"particles.balls.count\" = [0, 10, 20] }";
    let desk = Desk::with(&SCENE.replace(vary, "vary = { \"dem.largest-overlap\" = [1e-7, 0.1] }"));
    let ended = desk.run("response balls.toml -q -o curve --set 'response.frequency-ratio=[0.95, 1.0, 1.05]'");
    assert_eq!(ended.code, Some(3), "{}", ended.stderr);
    assert!(ended.stderr.contains("error: some of the runs failed"), "{}", ended.stderr);
    assert!(ended.stdout.contains("warning: case `largest-overlap = 0.0000001`, frequency ratio"), "{}", ended.stdout);
    let curve = desk.read("curve/response.csv");
    assert_eq!(curve.lines().filter(|line| line.contains("largest-overlap = 0.1")).count(), 3, "{curve}");
    assert_eq!(desk.summary("curve")["status"], "failed");
}
