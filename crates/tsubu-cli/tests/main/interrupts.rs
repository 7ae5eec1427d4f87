//! Ctrl-C and a polite kill end every command soon, with 130, and no state is lost.

use crate::support::{Desk, SCENE, listening, signal, wait_for};
use std::time::{Duration, Instant};

/// Settles for minutes: its steps are a hundred thousandth of a contact.
const SLOW: &str = "--set materials.acrylic.restitution=1e-6 --set 'particles.balls.start.settled.time=100 s'";

/// Two seconds on an idle machine; others may be busy.
const SOON: Duration = Duration::from_secs(8);

fn stops(desk: &Desk, line: &str, after: Duration, how: &str) {
    let mut child = desk.start(line);
    listening(&child);
    std::thread::sleep(after);
    signal(&child, how);
    let begun = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if begun.elapsed() > SOON {
            child.kill().unwrap();
            panic!("tsubu {line} went on after SIG{how}");
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    assert_eq!(child.wait().unwrap().code(), Some(130), "tsubu {line}, SIG{how}");
}

/// Nobody could tell from an interrupted verification how much of it was done.
#[test]
fn an_interrupted_verification_says_how_far_it_came() {
    let desk = Desk::new();
    let mut child = desk.command("verify --all --threads 1").stderr(std::process::Stdio::piped()).spawn().unwrap();
    listening(&child);
    std::thread::sleep(Duration::from_millis(1500));
    signal(&child, "INT");
    let mut said = String::new();
    std::io::Read::read_to_string(&mut child.stderr.take().unwrap(), &mut said).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130));
    let (_, rest) = said.split_once("interrupted: ").unwrap_or_else(|| panic!("{said}"));
    assert!(rest.contains(" cases were done") && rest.contains("hint: with `-o DIR`"), "{said}");
}

/// An interrupted verification began again from nothing, and its folder was refused.
#[test]
fn an_interrupted_verification_goes_on_where_it_was() {
    let desk = Desk::empty();
    let line = "verify figure-9 restitution -o kept --threads 2";
    let members = || {
        let files = std::fs::read_dir(desk.path("kept/members/figure-9")).into_iter().flatten().flatten();
        let files = files.map(|file| (file.file_name(), file.metadata().unwrap().modified().unwrap()));
        let mut files: Vec<_> = files.filter(|(name, _)| !name.to_string_lossy().starts_with('.')).collect();
        files.sort_by_key(|(_, when)| *when);
        files
    };
    let stopped_with = |count: usize| {
        let mut child = desk.command(line).stderr(std::process::Stdio::piped()).spawn().unwrap();
        let begun = Instant::now();
        while members().len() < count {
            assert!(begun.elapsed() < Duration::from_mins(1), "no run of the ensemble was kept");
            std::thread::sleep(Duration::from_millis(20));
        }
        wait_for(&desk.path("kept/cases/restitution.json"));
        signal(&child, "INT");
        let mut said = String::new();
        std::io::Read::read_to_string(&mut child.stderr.take().unwrap(), &mut said).unwrap();
        assert_eq!(child.wait().unwrap().code(), Some(130), "{said}");
        assert!(
            said.contains("hint: go on with `tsubu verify figure-9 restitution -o kept --threads 2 --resume`"),
            "{said}"
        );
        members()
    };
    let first = stopped_with(2);
    let done = std::fs::metadata(desk.path("kept/cases/restitution.json")).unwrap().modified().unwrap();
    let second = stopped_with(first.len() + 2);
    assert_eq!(second[..first.len()], first, "what was done was run again");
    assert_eq!(done, std::fs::metadata(desk.path("kept/cases/restitution.json")).unwrap().modified().unwrap());
    assert!(!desk.path("kept/verify.json").exists());
}

/// A comparison began again from nothing, and its folder was refused.
#[test]
fn an_interrupted_comparison_goes_on_where_it_was() {
    let desk = Desk::new();
    let long = "--set 'duration=0.6 s' --set 'hosts.spring.base.sine.amplitude=0.5 mm' \
                --set 'output.checkpoint-interval=5 ms' --set 'output.frame-interval=200 ms'";
    let line = format!("compare balls.toml --methods lattice,dem -q -o cut {long}");
    let mut child = desk.command(&line).stderr(std::process::Stdio::piped()).spawn().unwrap();
    wait_for(&desk.path("cut/dem/checkpoint/state.tsubu"));
    signal(&child, "INT");
    let mut said = String::new();
    std::io::Read::read_to_string(&mut child.stderr.take().unwrap(), &mut said).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{said}");
    assert!(said.contains("hint: go on with `tsubu compare balls.toml --methods lattice,dem"), "{said}");
    assert_eq!(desk.summary("cut/dem")["status"], "interrupted");
    assert!(desk.read("cut/compare.csv").starts_with("quantity [text],unit [text],lattice,dem\n"));
    desk.run("report cut");
    assert!(desk.read("cut/report.html").contains("did not come to its end"));
    let when = || std::fs::metadata(desk.path("cut/lattice/summary.json")).unwrap().modified().unwrap();
    let before = when();
    for other in [
        format!("{line} --set seed=7"),
        format!("{line} --set seed=7 --methods a=dem").replace("--methods lattice,dem ", ""),
    ] {
        let other = desk.run(&other);
        assert!(other.code == Some(2) && other.stderr.contains("belong to another scene"), "{}", other.stderr);
    }
    desk.done(&format!("{line} --resume"));
    assert_eq!(when(), before, "what was done was run again");
    desk.done(&format!("run balls.toml -q -o whole {long}"));
    assert_eq!(desk.hash("cut/dem"), desk.hash("whole"));
    assert!(desk.path("cut/report.html").exists());
}

/// Intervals of next to nothing were counted up one by one, and the run never ended.
#[test]
fn an_interval_below_a_step_is_a_step() {
    let desk = Desk::new();
    desk.done(
        "run balls.toml -q -o every --set duration=1e-3 --set output.history-interval=1e-10 \
        --set output.checkpoint-interval=1e-10",
    );
    let rows = desk.read("every/history.csv").lines().count() as u64 - 1;
    assert_eq!(rows, desk.summary("every")["steps"].as_u64().unwrap() + 1);
}

/// A second run went on beside the first: rows were missing from the history, and both ended well.
#[test]
fn a_folder_has_one_writer() {
    let desk = Desk::new();
    let often = "--set 'output.checkpoint-interval=0.05 s' --set 'output.frame-interval=100 s'";
    let options = format!("-o one -q --set 'duration=100 s' {often}");
    let mut child = desk.start(&format!("run balls.toml {options}"));
    wait_for(&desk.path("one/checkpoint/state.tsubu"));
    for line in
        [&format!("run balls.toml {options} --resume"), &format!("run balls.toml {options} --overwrite"), "report one"]
    {
        let second = desk.run(line);
        assert_eq!(second.code, Some(2), "{line}: {}", second.stderr);
        assert!(second.stderr.contains("one/.tsubu") && second.stderr.contains("lock"), "{line}: {}", second.stderr);
    }
    signal(&child, "INT");
    assert_eq!(child.wait().unwrap().code(), Some(130));
    desk.done("report one");
}

mod patient {
    use super::*;

    /// While grains settled before time 0 nobody listened: the program lived on for more than 40 s.
    #[test]
    #[ignore = "7 s: cargo xtask patient"]
    fn settling_stops() {
        let desk = Desk::with(
            &SCENE.replace("start.rows = { spacing = 1.1, jitter = 0.5, speed = 0.3 }", "start.settled = {}"),
        );
        for (command, how) in [("run", "INT"), ("run", "TERM"), ("response", "INT"), ("check", "TERM")] {
            stops(&desk, &format!("{command} balls.toml {SLOW}"), Duration::from_millis(700), how);
        }
        assert_eq!(desk.files(), ["balls.toml"], "something was left behind");
    }

    /// A verification died of the signal without a word, and a response went on to the end of a frequency.
    #[test]
    #[ignore = "5 s: cargo xtask patient"]
    fn long_commands_stop() {
        let desk = Desk::with(&SCENE.replace("measure-periods = 2", "measure-periods = 100000"));
        stops(&desk, "verify --all", Duration::from_millis(500), "INT");
        stops(&desk, "bench --seconds 600", Duration::from_millis(500), "TERM");
        stops(&desk, "sweep balls.toml -o swept --set 'duration=100 s'", Duration::from_millis(1500), "TERM");
        stops(&desk, "response balls.toml -o out --threads 2", Duration::from_millis(2500), "INT");
        assert_eq!(desk.summary("out")["status"], "interrupted");
    }
}
