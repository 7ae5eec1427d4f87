use crate::support::{Desk, SCENE};
use insta::assert_snapshot;
use std::io::Read;
use std::process::Stdio;

/// A scene without watches told its user "momentum residual" and nothing else.
#[test]
fn a_run_without_watches_tells_what_happened() {
    let removal = "[removal.drain.behind]\npoint = [0, \"1 m\"]\nnormal = \"z\"\n";
    let desk = Desk::with(&format!("{SCENE}\n{removal}"));
    let shown = desk.done("run balls.toml -q").stdout;
    for said in ["value or mean", "kinetic energy", "centre of mass height", "contacts", "removal drain grains"] {
        assert!(shown.contains(said), "{said}: {shown}");
    }
    let summary = desk.summary("out/balls");
    assert_eq!(summary["results"]["removal drain grains"], 20.0);
    assert_eq!(summary["particles"], 0);
    assert!(summary["results"]["kinetic energy spread"].as_f64().unwrap() > 0.0);
}

#[test]
fn nothing_asked() {
    assert_snapshot!(Desk::empty().shown(""));
}

#[test]
fn help_lists_the_commands() {
    let help = Desk::empty().done("--help").stdout;
    for command in [
        "run",
        "check",
        "sweep",
        "response",
        "atlas",
        "predict",
        "design",
        "calibrate",
        "compare",
        "verify",
        "explain",
        "report",
        "view",
        "new",
        "schema",
        "completions",
    ] {
        assert!(help.contains(&format!("\n  {command} ")), "{command}: {help}");
        Desk::empty().done(&format!("{command} --help"));
    }
    assert_snapshot!(Desk::empty().shown("run --help"));
}

#[test]
fn a_misspelt_command() {
    assert_snapshot!(Desk::empty().shown("rum damper.toml"));
}

#[test]
fn a_view_of_nothing() {
    assert_snapshot!(Desk::empty().shown("view out/damper --port 8000"));
}

#[test]
fn a_law_a_watch_and_a_case_are_explained() {
    let desk = Desk::empty();
    assert_snapshot!(desk.shown("explain hertz"));
    assert_snapshot!(desk.shown("explain rolling.epsd"));
    assert_snapshot!(desk.shown("explain fabric"));
    assert_snapshot!(desk.shown("explain haff"));
    let springs = desk.done("explain spring").stdout;
    assert!(
        ["tangential", "rolling", "twisting"].iter().all(|part| springs.contains(&format!("[contact.{part}.spring]")))
    );
    assert!(desk.done("explain rolling").stdout.contains("slide-to-roll"), "a study");
}

/// A claim whose ensemble leaves it open was said to fail.
#[test]
fn an_undecided_claim_is_called_so() {
    let shown = Desk::empty().done("explain haff-inelastic").stdout;
    assert!(shown.contains("undecided") && !shown.contains("FAIL"), "{shown}");
}

/// Whoever reads the results may go away: the claims are judged all the same. The exit code was 0.
#[test]
fn a_reader_that_goes_away_changes_no_exit_code() {
    let desk =
        Desk::with(&format!("{SCENE}\n[[claim]]\nresult = \"momentum residual\"\nhigh = -1\nsource = \"never\"\n"));
    let mut child = desk.command("run balls.toml -q").stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap();
    drop(child.stdout.take());
    assert_eq!(child.wait().unwrap().code(), Some(1));
    assert!(desk.path("out/balls/summary.json").exists());
}

/// A name that is almost one gets the one that is meant, and nothing is explained.
#[test]
fn what_has_no_explanation_is_told() {
    let desk = Desk::empty();
    for (typed, meant) in [
        ("hertzz", "hertz"),
        ("schiller-nauman", "schiller-naumann"),
        ("contact.normal.hok", "hook"),
        ("brazilnut", "brazil-nut"),
    ] {
        let ended = desk.run(&format!("explain {typed}"));
        assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{typed}");
        assert!(ended.stderr.contains(meant), "{typed}: {}", ended.stderr);
    }
    assert_snapshot!(desk.shown("explain qqq"));
}

#[test]
fn everything_that_is_listed_can_be_explained() {
    let desk = Desk::empty();
    let list = desk.done("explain").stdout;
    let names: Vec<&str> = list
        .lines()
        .filter(|line| line.starts_with("    "))
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    for name in ["hertz", "schiller-naumann", "discharge", "mesh", "after-savage", "haff"] {
        assert!(names.contains(&name), "{name}: {list}");
    }
    for name in names {
        assert!(!desk.done(&format!("explain {name}")).stdout.is_empty(), "{name}");
    }
}

#[test]
fn an_unknown_verification() {
    assert_snapshot!(Desk::empty().shown("verify nonsense -o out"));
}

#[test]
fn an_unknown_method() {
    let desk = Desk::new();
    assert_snapshot!(desk.shown("compare balls.toml --methods sph"));
}

#[test]
fn a_report_of_nothing() {
    let desk = Desk::new();
    assert_snapshot!(desk.shown("report out/nothing"));
    std::fs::create_dir(desk.path("empty")).unwrap();
    assert_snapshot!(desk.shown("report empty"));
}

#[test]
fn templates_are_written_once() {
    let desk = Desk::empty();
    let list = desk.done("new --list").stdout;
    assert!(list.contains("damper"), "{list}");
    assert_snapshot!(desk.shown("new damper"));
    std::fs::write(desk.path("damper.toml"), "mine").unwrap();
    assert_snapshot!(desk.shown("new damper"));
    assert_eq!(desk.read("damper.toml"), "mine");
    assert_eq!(desk.run("new dampr").code, Some(2));
    assert_eq!(desk.run("new").code, Some(2));
    desk.done("new drop other.toml");
    desk.done("check other.toml --set 'duration=0.01 s'");
}

#[test]
fn verifications_are_listed() {
    let list = Desk::empty().done("verify --list").stdout;
    assert!(list.contains("restitution") && list.contains("impact-damper"), "{list}");
}

#[test]
fn the_schema_is_one() {
    let schema: serde_json::Value = serde_json::from_str(&Desk::empty().done("schema").stdout).unwrap();
    assert!(schema["properties"]["materials"].is_object());
}

#[test]
fn shells_get_their_script() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        assert!(Desk::empty().done(&format!("completions {shell}")).stdout.contains("tsubu"));
    }
}

/// As in `tsubu schema | head -c 10`.
#[test]
fn a_reader_may_leave() {
    let desk = Desk::new();
    for line in ["schema", "completions bash", "new --list", "verify --list", "check balls.toml", "run balls.toml -q"] {
        let mut child = desk.command(line).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let mut said = String::new();
        child.stderr.take().unwrap().read_to_string(&mut said).unwrap();
        assert_eq!(child.wait().unwrap().code(), Some(0), "{line}: {said}");
        assert!(!said.contains("panicked"), "{line}: {said}");
    }
}

#[test]
fn bench_is_kept_for_check_and_quoted_by_reports() {
    let desk = Desk::new();
    let ended = desk.done("bench --seconds 2 -q -o me");
    assert!(ended.stdout.contains("chute") && ended.stdout.contains("particle-steps/s"), "{}", ended.stdout);
    assert_eq!(desk.read("me/bench.json"), desk.read(".cache/tsubu/bench.json"));
    let bench: serde_json::Value = serde_json::from_str(&desk.read("me/bench.json")).unwrap();
    assert_eq!(bench["rows"][0]["threads"], 1);
    desk.done("run balls.toml -q");
    desk.done("report out/balls");
    assert!(desk.read("out/balls/report.html").contains("tsubu bench"));
    if bench["cores"].as_u64().unwrap() > 1 {
        let many = "--set particles.balls.count=2500 --set 'walls.box.shape.box.width=1 m' --set 'walls.box.shape.box.height=1 m'";
        let check = desk.done(&format!("check balls.toml {many}"));
        assert!(check.stdout.contains("times as fast by `tsubu bench`"), "{}", check.stdout);
    }
    // A damaged file is as good as none.
    std::fs::write(desk.path(".cache/tsubu/bench.json"), "{").unwrap();
    desk.done("check balls.toml");
    assert_eq!(desk.run("bench --seconds 0").code, Some(2));
}

/// The command that `check` suggested ran another scene than the one that it had judged.
#[test]
fn check_suggests_what_it_judged() {
    let desk = Desk::new();
    let set = "--set 'duration=0.02 s' --set speed-scale=0.2";
    let ended = desk.run(&format!("check balls.toml {set} --set materials.acrylic.young-modulus=1e8"));
    let whole = format!("run it: tsubu run balls.toml {set} --set materials.acrylic.young-modulus=1e8");
    assert!(ended.stderr.contains(&whole), "{}{}", ended.stdout, ended.stderr);
}

#[test]
fn check_estimates_what_ranks_take() {
    let desk = Desk::new();
    // One rank has the only block: nothing goes over but what blocks have summed.
    let told = desk.done("check balls.toml --ranks 3").stdout;
    assert!(told.contains("ranks: of 3 each has") && told.contains("2 messages a step"), "{told}");
    assert!(!desk.done("check balls.toml").stdout.contains("ranks:"));
}
