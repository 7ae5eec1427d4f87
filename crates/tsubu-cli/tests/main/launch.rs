//! Runs of a study done apart, as a cluster does them. The tasks are real, and so is the job script; what starts them is `bash` here.
//! Real Slurm and real Dask: `cargo xtask cluster`.

use crate::support::{Desk, Ended, SCENE, designed, signal, wait_for};
use std::fs;
use std::process::Command;

/// Twelve runs of a response in which the peak is looked for, so that there is more than one round, and beds are settled.
fn rounds() -> Desk {
    let scene = SCENE
        .replace("count = 20\n", "count = 20\nstart.settled.time = \"0.02 s\"\n")
        .replace("start.rows = { spacing = 1.1, jitter = 0.5, speed = 0.3 }\n", "")
        .replace("measure-periods = 2", "measure-periods = 2\npeak-within = 0.03")
        .replace("[0, 10, 20] }", "[0, 20] }");
    Desk::with(&scene)
}

/// The names of the runs that are missing.
fn missing(desk: &Desk, study: &str) -> Vec<String> {
    let shown = desk.done(&format!("{study} balls.toml -o out --dry-run")).stdout;
    shown.lines().map(str::to_owned).collect()
}

/// A folder that is begun, and nothing run in it.
fn begun(desk: &Desk, study: &str) {
    let ended = desk.run(&format!("{study} balls.toml -o out --gather"));
    assert_eq!(ended.code, Some(3), "{}", ended.stderr);
}

fn bash(desk: &Desk, script: &str, task: Option<usize>) -> Ended {
    let mut command = Command::new("bash");
    command.arg("-c").arg(script).current_dir(desk.path("")).env("NO_COLOR", "1");
    // This test may itself be a job of Slurm.
    command.env_remove("SLURM_ARRAY_TASK_ID");
    if let Some(task) = task {
        command.env("SLURM_ARRAY_TASK_ID", task.to_string());
    }
    let out = command.output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    Ended { code: out.status.code(), stdout: text(out.stdout), stderr: text(out.stderr) }
}

/// The table without what a case cost.
fn table(desk: &Desk, file: &str) -> Vec<String> {
    let text = desk.read(file);
    let at = text.lines().next().unwrap().split(',').position(|name| name == "wall seconds [s]");
    // Names of cases have commas, and stand before it in quotes.
    let cells = |line: &str| -> Vec<String> {
        let mut quoted = false;
        line.split(|c| {
            quoted ^= c == '"';
            c == ',' && !quoted
        })
        .enumerate()
        .filter(|(i, _)| Some(*i) != at)
        .map(|(_, cell)| cell.to_owned())
        .collect()
    };
    text.lines().map(|line| cells(line).join(",")).collect()
}

#[test]
fn the_job_script_does_a_sweep() {
    let desk = Desk::new();
    desk.done("sweep balls.toml -q -o here");
    let script = desk.done("sweep balls.toml -o out --launcher slurm --dry-run --per-task 3").stdout;
    assert!(!desk.path("out").exists(), "a dry run has written something");
    for line in ["--array=0-1 FILE", "#SBATCH --requeue", "#SBATCH --signal=B:TERM@60", "#SBATCH --cpus-per-task=1"] {
        assert!(script.contains(line), "{line}: {script}");
    }
    let given = |key: &str| script.lines().find_map(|line| line.strip_prefix(&format!("#SBATCH --{key}="))).unwrap();
    assert!(given("time").parse::<u32>().unwrap() >= 10);
    assert!(given("mem").strip_suffix('M').unwrap().parse::<u32>().unwrap() >= 200);
    begun(&desk, "sweep");
    let first = bash(&desk, &script, Some(0));
    assert!(first.code == Some(0) && first.stderr.contains("case restitution=0.6: finished"), "{}", first.stderr);
    // The last job comes after a task that was lost: the page says which cases are missing.
    let last = bash(&desk, &script, None);
    assert_eq!(last.code, Some(3), "{}", last.stderr);
    assert!(last.stderr.contains("1 of 4 cases failed or are missing"), "{}", last.stderr);
    assert!(desk.read("out/report.html").contains("1 case missing"));
    assert_eq!(missing(&desk, "sweep"), ["restitution=0.8"]);
    let second = bash(&desk, &script, Some(1));
    assert_eq!(second.code, Some(0), "{}", second.stderr);
    let last = bash(&desk, &script, None);
    assert_eq!(last.code, Some(0), "{}", last.stderr);
    assert_eq!(table(&desk, "out/sweep.csv"), table(&desk, "here/sweep.csv"));
    assert!(desk.read("out/report.html").contains("finished"));
    for value in ["0.5", "0.6", "0.7", "0.8"] {
        let case = format!("cases/restitution={value}");
        assert_eq!(desk.hash(&format!("out/{case}")), desk.hash(&format!("here/{case}")));
    }
}

/// What was complete is not run again, whoever asks for it.
#[test]
fn a_task_given_twice_does_nothing() {
    let desk = Desk::new();
    begun(&desk, "sweep");
    let case = "out/cases/restitution=0.5/summary.json";
    let task = "sweep out -o out -q --case restitution=0.5";
    desk.done(task);
    let before = fs::metadata(desk.path(case)).unwrap().modified().unwrap();
    desk.done(task);
    assert_eq!(before, fs::metadata(desk.path(case)).unwrap().modified().unwrap());
    let ended = desk.run("sweep out -o out --case restitution=0.55");
    assert!(ended.code == Some(2) && ended.stderr.contains("no case `restitution=0.55`"), "{}", ended.stderr);
    // Nor is it lost where a value comes before the others.
    fs::write(desk.path("balls.toml"), SCENE.replace("[0.5, 0.6,", "[0.4, 0.5, 0.6,")).unwrap();
    assert_eq!(missing(&desk, "sweep"), ["0.4", "0.6", "0.7", "0.8"].map(|value| format!("restitution={value}")));
}

/// A case hangs on no other: whoever comes first makes the folder, here three at once.
#[test]
fn the_first_case_begins_its_sweep() {
    let desk = Desk::new();
    desk.done("sweep balls.toml -q -o here");
    let names = ["restitution=0.5", "restitution=0.6", "restitution=0.7"];
    let tasks = names.map(|name| desk.start(&format!("sweep balls.toml -o out -q --case {name}")));
    for mut task in tasks {
        assert_eq!(task.wait().unwrap().code(), Some(0));
    }
    assert_eq!(missing(&desk, "sweep"), ["restitution=0.8"]);
    let hashes = |of: &str| names.map(|name| desk.hash(&format!("{of}/cases/{name}")));
    assert_eq!(hashes("out"), hashes("here"));
    desk.done("sweep out -o out -q");
    assert_eq!(table(&desk, "out/sweep.csv"), table(&desk, "here/sweep.csv"));
}

/// A worker that its cluster has given up may still be at work: its case is waited for, and not run beside it.
#[test]
fn a_case_that_somebody_works_at_is_waited_for() {
    let desk = Desk::new();
    let long = "--set 'duration=4 s' --set 'sweep.vary={ seed = [1] }'";
    desk.run(&format!("sweep balls.toml -o out {long} --gather"));
    let mut child = desk.start("sweep out -o out -q --case seed=1");
    wait_for(&desk.path("out/cases/seed=1/history.csv"));
    desk.done("sweep out -o out -q --case seed=1");
    assert_eq!(child.wait().unwrap().code(), Some(0), "it was disturbed");
}

#[test]
fn a_case_that_fails_leaves_the_others_and_says_why() {
    let vary = SCENE
        .replace("\"materials.acrylic.restitution\" = [0.5, 0.6, 0.7, 0.8]", "\"dem.largest-overlap\" = [0.1, 1e-9]");
    let desk = Desk::with(&vary);
    begun(&desk, "sweep");
    let names = missing(&desk, "sweep");
    let ended = desk.run(&format!("sweep out -o out -q --case {} --case {}", names[1], names[0]));
    assert!(ended.code == Some(3) && ended.stderr.contains("1 of 2 cases failed"), "{}", ended.stderr);
    let ended = desk.run("sweep out -o out --gather");
    assert_eq!(ended.code, Some(3), "{}", ended.stderr);
    let table = desk.read("out/sweep.csv");
    assert!(table.lines().nth(1).unwrap().contains("finished") && table.lines().nth(2).unwrap().contains("overlap"));
    assert_eq!(missing(&desk, "sweep"), [names[1].clone()], "what failed is tried again");
}

/// Does a study by its job scripts, round by round, the last task first; gives the number of rounds. No run is asked for twice.
fn by_rounds(desk: &Desk, study: &str, changes: &str) -> usize {
    let line = format!("{study} balls.toml -o out {changes}");
    let ended = desk.run(&format!("{line} --gather"));
    assert_eq!(ended.code, Some(3), "{}", ended.stderr);
    let mut asked: Vec<String> = Vec::new();
    for round in 0..100 {
        let shown = desk.done(&format!("{line} --dry-run")).stdout;
        if shown.is_empty() {
            return round;
        }
        let names: Vec<String> = shown.lines().map(str::to_owned).collect();
        assert!(names.iter().all(|name| !asked.contains(name)), "asked for twice: {names:?}");
        asked.extend(names);
        let script = desk.done(&format!("{line} --launcher slurm --dry-run --per-task 5")).stdout;
        let tasks = script.lines().filter(|line| line.starts_with("  \"--case")).count();
        for task in (0..tasks).rev() {
            let ended = bash(desk, &script, Some(task));
            assert_eq!(ended.code, Some(0), "{}", ended.stderr);
        }
    }
    panic!("there is no end of rounds")
}

/// The end is that of a response that ran alone.
#[test]
fn the_job_scripts_do_a_response() {
    let desk = rounds();
    desk.done("response balls.toml -q -o here");
    assert!(by_rounds(&desk, "response", "") > 1, "the peak was not looked for");
    desk.done("response balls.toml -o out --gather");
    assert_eq!(desk.read("out/response.csv"), desk.read("here/response.csv"));
    assert_eq!(desk.summary("out")["results"], desk.summary("here")["results"]);
    // It goes on here as there: nothing is missing.
    desk.done("response balls.toml -q -o out");
    assert_eq!(desk.read("out/response.csv"), desk.read("here/response.csv"));
}

/// An atlas looks where its mass bends, round by round, and is that of one process.
#[test]
fn the_job_scripts_do_an_atlas() {
    let asked = "[atlas]\nfrequency = [\"5 Hz\", \"7 Hz\"]\nacceleration = [\"2 m/s^2\", \"40 m/s^2\"]\nat-most = 24\n\
                 vary = { \"particles.balls.count\" = [10, 20] }\n";
    let desk = Desk::with(&format!("{SCENE}\n{asked}"));
    desk.done("atlas balls.toml -q -o here --set method=lattice");
    assert!(by_rounds(&desk, "atlas", "--set method=lattice") > 1, "it did not look closer");
    desk.done("atlas balls.toml -q -o out --set method=lattice --gather");
    assert_eq!(desk.read("out/atlas.csv"), desk.read("here/atlas.csv"));
    assert_eq!(desk.summary("out")["results"], desk.summary("here")["results"]);
    let wrong = desk.run("atlas balls.toml -o out --set method=lattice --case nobody");
    assert!(wrong.code == Some(2) && wrong.stderr.contains("the atlas has no run `nobody`"), "{}", wrong.stderr);
}

/// A design chooses its runs by those before, and chooses the same whoever has done them.
#[test]
fn the_job_scripts_do_a_design() {
    let desk = Desk::with(&designed());
    desk.done("design balls.toml -q -o here --set method=lattice");
    assert!(by_rounds(&desk, "design", "--set method=lattice") > 2, "it did not choose");
    desk.done("design balls.toml -q -o out --set method=lattice --gather");
    for file in ["design.csv", "steps.csv", "curves.csv", "best.toml"] {
        assert_eq!(desk.read(&format!("out/{file}")), desk.read(&format!("here/{file}")));
    }
}

/// So does a calibration.
#[test]
fn the_job_scripts_do_a_calibration() {
    let asked = "[calibrate]\nruns = 16\nchecks = 2\nwithin = 0.01\n[calibrate.vary]\n\"materials.acrylic.restitution\" = [0.3, 0.9]\n\
                 [[calibrate.measured]]\nresult = \"host spring rms displacement\"\nvalue = 0.003\nuncertainty = 0.00001\nsource = \"here\"\n";
    let desk = Desk::with(&format!("{SCENE}\n{asked}"));
    desk.done("calibrate balls.toml -q -o here");
    assert!(by_rounds(&desk, "calibrate", "") > 2, "it did not choose");
    desk.done("calibrate balls.toml -o out --gather");
    for file in ["parameters.csv", "posterior.csv", "measured.csv", "best.toml"] {
        assert_eq!(desk.read(&format!("out/{file}")), desk.read(&format!("here/{file}")));
    }
}

const ATLAS: &str =
    "[atlas]\nfrequency = [\"5 Hz\", \"7 Hz\"]\nacceleration = [\"2 m/s^2\", \"40 m/s^2\"]\nat-most = 15\n";

/// A task of another scene emptied what was done, and one whose name leads elsewhere emptied what lies there.
#[test]
fn a_task_of_another_scene_leaves_what_is_there() {
    let desk = Desk::new();
    desk.done("sweep balls.toml -q -o swept");
    let hash = desk.hash("swept/cases/restitution=0.5");
    begun(&desk, "response");
    let name = missing(&desk, "response").remove(0);
    desk.done(&format!("response out -o out -q --case {name}"));
    let part = format!("out/progress/{name}.jsonl");
    let (journal, done) = (desk.read("out/progress.jsonl"), desk.read(&part));
    fs::write(desk.path("precious.jsonl"), "mine").unwrap();
    for (line, said) in [
        ("sweep balls.toml -o swept --set gravity=9 --case restitution=0.5".to_owned(), "belong to another scene"),
        (format!("response balls.toml -o out --set gravity=9 --case {name}"), "belong to another scene"),
        ("response balls.toml -o out --case ../progress".to_owned(), "has no run `../progress`"),
        ("response balls.toml -o out --case ../../precious".to_owned(), "has no run"),
        (format!("response balls.toml -o new --case {name}"), "nothing of `tsubu response` is begun in new"),
        ("sweep balls.toml -o new --case restitution=0.55".to_owned(), "has no case `restitution=0.55`"),
        ("sweep balls.toml -o out --case restitution=0.5".to_owned(), "out is not empty"),
        ("verify damped-contact -o new --case damped-contact".to_owned(), "no verification by tasks is begun in new"),
    ] {
        let ended = desk.run(&line);
        assert!(ended.code == Some(2) && ended.stderr.contains(said), "{line}: {}", ended.stderr);
    }
    assert_eq!(desk.hash("swept/cases/restitution=0.5"), hash);
    assert_eq!((desk.read("out/progress.jsonl"), desk.read(&part)), (journal, done));
    assert_eq!(desk.read("precious.jsonl"), "mine");
    assert!(!desk.path("new").exists());
}

/// Results of another command, scene or verification were replaced by what a gathering found of its own: nothing.
#[test]
fn what_was_not_begun_is_not_gathered() {
    let desk = Desk::with(&format!("{SCENE}\n{ATLAS}"));
    desk.done("run balls.toml -q -o ran");
    desk.done("sweep balls.toml -q -o swept");
    desk.done("verify damped-contact -q -o verified");
    begun(&desk, "response");
    let files = ["ran/scene.toml", "swept/scene.toml", "swept/sweep.csv", "verified/verify.json", "out/progress.jsonl"];
    let before = files.map(|file| desk.read(file));
    for line in [
        "sweep balls.toml -o ran --gather",
        "sweep balls.toml -o swept --gather --set gravity=9",
        "sweep balls.toml -o out --gather",
        "verify damped-contact -o verified --gather",
        "atlas balls.toml -o out --gather",
        "atlas balls.toml -o out",
        "predict balls.toml out -o out",
    ] {
        let ended = desk.run(line);
        assert_eq!(ended.code, Some(2), "{line}: {}", ended.stderr);
    }
    assert!(desk.run("atlas balls.toml -o out").stderr.contains("are of `tsubu response`"));
    assert_eq!(files.map(|file| desk.read(file)), before);
}

/// A run that fails is told, does not keep the next round from coming, and is tried again by the same command alone.
#[test]
fn a_run_of_a_response_that_fails_is_told() {
    let vary = SCENE.replace("\"particles.balls.count\" = [0, 10, 20]", "\"dem.largest-overlap\" = [0.1, 1e-9]");
    let desk = Desk::with(&vary);
    begun(&desk, "response");
    let names = missing(&desk, "response");
    assert_eq!(names.len(), 8);
    let cases = names[1..].join(" --case ");
    let ended = desk.run(&format!("response out -o out -q --case {cases}"));
    assert!(ended.code == Some(3) && ended.stderr.contains("4 of 7 cases failed"), "{}", ended.stderr);
    let ended = desk.run("response out -o out --gather");
    assert_eq!(ended.code, Some(3), "{}", ended.stderr);
    assert!(ended.stdout.contains("overlap"), "{}", ended.stdout);
    assert!(ended.stdout.contains(&format!("{} is missing: it was not begun", names[0])), "{}", ended.stdout);
    assert!(desk.read("out/report.html").contains("it was not begun"), "the page does not say it");
    assert_eq!(missing(&desk, "response"), names[..1], "what failed is not waited for");
}

/// What is not there says which package has it; nothing is left behind.
#[test]
fn without_slurm_or_dask_it_says_what_to_install() {
    let desk = Desk::new();
    let nothing = tempfile::tempdir().unwrap();
    for (launcher, package) in [("slurm", "slurm-client"), ("dask", "pip install distributed")] {
        let out = desk.command(&format!("sweep balls.toml -o out --launcher {launcher}"));
        let out = { out }.env("PATH", nothing.path()).output().unwrap();
        let said = String::from_utf8(out.stderr).unwrap();
        assert!(out.status.code() == Some(2) && said.contains(package), "{said}");
        assert!(!desk.path("out").exists());
    }
    for option in ["--per-task 3", "--scheduler tcp://node:8786", "--ranks 4"] {
        let ended = desk.run(&format!("sweep balls.toml -o out {option}"));
        assert!(ended.code == Some(2) && ended.stderr.contains("is for `--launcher"), "{}", ended.stderr);
    }
    let ended = desk.run("response balls.toml -o out --launcher slurm --dry-run --ranks 4");
    assert!(ended.code == Some(2) && ended.stderr.contains("on one rank each"), "{}", ended.stderr);
    let ended = desk.run("verify contact-time --launcher slurm");
    assert!(ended.code == Some(2) && ended.stderr.contains("name it with `-o DIR`"), "{}", ended.stderr);
}

/// The claims of a verification by tasks are those of one by a single process; what is missing is named, and done by the same command.
#[test]
fn the_job_script_does_a_verification() {
    let desk = Desk::new();
    let claims = |out: &str| {
        let results: serde_json::Value = serde_json::from_str(&desk.read(&format!("{out}/verify.json"))).unwrap();
        results["claims"].clone()
    };
    desk.done("verify drop-lattice gutt-haff damped-contact -q -o here");
    let line = "verify drop-lattice gutt-haff damped-contact -q -o out";
    let script = desk.done(&format!("{line} --launcher slurm --dry-run --per-task 2")).stdout;
    assert!(script.contains("--array=0-1 FILE"), "{script}");
    assert!(!desk.path("out").exists(), "a dry run has written something");
    let begun = desk.run(&format!("{line} --gather"));
    assert!(begun.code == Some(3) && begun.stderr.contains("3 of 3 cases have no result"), "{}", begun.stderr);
    let first = bash(&desk, &script, Some(0));
    assert!(first.code == Some(0) && first.stderr.contains(": finished"), "{}", first.stderr);
    let last = bash(&desk, &script, None);
    assert!(last.code == Some(3) && last.stderr.contains("1 of 3 cases have no result"), "{}", last.stderr);
    assert!(last.stderr.contains("has no result: it was not begun"), "{}", last.stderr);
    let left = desk.done(&format!("{line} --dry-run")).stdout;
    assert_eq!(left.lines().count(), 1, "{left}");
    desk.done(&format!("{line} --case {}", left.trim()));
    desk.done(&format!("{line} --gather"));
    assert_eq!(claims("out"), claims("here"));
    assert!(desk.path("out/report.html").exists());
    let wrong = desk.run(&format!("{line} --case janssen"));
    assert!(wrong.code == Some(2) && wrong.stderr.contains("no case `janssen`"), "{}", wrong.stderr);
}

#[test]
fn the_tasks_of_dask_are_a_program_of_python() {
    let desk = Desk::new();
    let script =
        desk.done("sweep balls.toml -o out --launcher dask --scheduler tcp://node:8786 --dry-run --per-task 1").stdout;
    assert!(script.starts_with("SCHEDULER = \"tcp://node:8786\"\n"), "{script}");
    assert!(script.contains("    [\"--case\",\"restitution=0.7\"],\n"), "{script}");
}

mod patient {
    use super::*;

    /// A task that is preempted is asked to stop, and goes on from its checkpoint; one that is killed from the last it has written.
    #[test]
    #[ignore = "10 s: cargo xtask patient"]
    fn a_task_goes_on_where_it_was_stopped() {
        let desk = Desk::new();
        let long = "--set 'duration=4 s' --set 'output.checkpoint-interval=20 ms'";
        desk.done(&format!("sweep balls.toml -q -o here {long} --set 'sweep.vary={{ seed = [1] }}'"));
        let ended = desk.run(&format!("sweep balls.toml -o out {long} --set 'sweep.vary={{ seed = [1] }}' --gather"));
        assert_eq!(ended.code, Some(3), "{}", ended.stderr);
        for (name, code) in [("TERM", Some(130)), ("KILL", None)] {
            let _ = fs::remove_file(desk.path("out/cases/seed=1/checkpoint/state.tsubu"));
            let mut child = desk.start("sweep out -o out -q --case seed=1");
            wait_for(&desk.path("out/cases/seed=1/checkpoint/state.tsubu"));
            signal(&child, name);
            assert_eq!(child.wait().unwrap().code(), code, "the task ended before it could be stopped");
        }
        desk.done("sweep out -o out -q --case seed=1");
        desk.done("sweep out -o out --gather");
        assert_eq!(desk.hash("out/cases/seed=1"), desk.hash("here/cases/seed=1"));
    }
}
