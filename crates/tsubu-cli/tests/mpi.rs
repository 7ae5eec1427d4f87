//! Runs on several ranks over MPI, as `mpirun` starts them: the bits of one rank, whatever happens to the ranks.
//!
//! They want the feature `mpi`, `mpirun` of Open MPI or MPICH, and time: the ranks are more than the cores. `cargo xtask mpi` runs them.
#![cfg(feature = "mpi")]
#![allow(clippy::unwrap_used, reason = "a test that panics is a test that fails")]

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};
use tempfile::TempDir;

const PROGRAM: &str = env!("CARGO_BIN_EXE_tsubu");

/// Where a test works.
struct Desk {
    folder: TempDir,
}

impl Desk {
    fn with(scene: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("scene.toml"), scene).unwrap();
        Self { folder }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// `mpirun` with the words of a command line of the program.
    fn command(&self, ranks: usize, words: &str) -> Command {
        let mut command = Command::new("mpirun");
        command.args(["-n", &ranks.to_string()]);
        // What MPICH allows anyhow.
        if open_mpi() {
            command.arg("--oversubscribe");
            command.envs([("OMPI_ALLOW_RUN_AS_ROOT", "1"), ("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1")]);
        }
        command.arg(PROGRAM).args(words.split_whitespace()).current_dir(self.folder.path());
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    fn run(&self, ranks: usize, words: &str) -> Output {
        self.command(ranks, words).output().unwrap()
    }

    /// `state_hash` of a run.
    fn hash(&self, out: &str) -> String {
        let text = std::fs::read_to_string(self.path(out).join("summary.json")).unwrap();
        let line = text.lines().find(|line| line.contains("state_hash")).unwrap();
        line.split('"').nth(3).unwrap().to_owned()
    }

    /// The run on one rank without `mpirun`.
    fn alone(&self) -> String {
        let mut command = Command::new(PROGRAM);
        command.args(["run", "scene.toml", "-q", "-o", "alone"]).current_dir(self.folder.path());
        assert!(command.output().unwrap().status.success());
        self.hash("alone")
    }

    /// Waits until a run has left a checkpoint.
    fn checkpoint(&self, out: &str) {
        let file = self.path(out).join("checkpoint/state.tsubu");
        let begun = Instant::now();
        while !file.exists() {
            assert!(begun.elapsed() < Duration::from_mins(2), "no checkpoint");
            sleep(Duration::from_millis(20));
        }
    }
}

fn open_mpi() -> bool {
    let told = Command::new("mpirun").arg("--version").output().unwrap();
    String::from_utf8_lossy(&told.stdout).contains("Open MPI")
}

fn text(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned() + &String::from_utf8_lossy(&output.stdout)
}

/// Waits for the end of a program; says how long it took.
fn end(mut child: Child) -> (Option<i32>, Duration) {
    let begun = Instant::now();
    let status = child.wait().unwrap();
    (status.code(), begun.elapsed())
}

/// 2,500 balls in a box on a spring.
const DAMPER: &str = include_str!("mpi/damper.toml");
/// A silo that is filled, opened and emptied in three stages.
const SILO: &str = include_str!("mpi/silo.toml");
/// A periodic chute with a coupled stream over it.
const CHUTE: &str = include_str!("mpi/chute.toml");

/// Ranks, and threads of each.
const NUMBERS: [(usize, usize); 4] = [(2, 1), (3, 2), (4, 1), (7, 1)];

#[test]
fn a_damper_has_the_same_bits_and_files_on_any_ranks() {
    let desk = Desk::with(DAMPER);
    let alone = desk.alone();
    for (ranks, threads) in NUMBERS {
        let out = format!("out{ranks}");
        let done = desk.run(ranks, &format!("run scene.toml -q --threads {threads} -o {out}"));
        assert!(done.status.success(), "{}", text(&done));
        assert_eq!(desk.hash(&out), alone, "{ranks} ranks of {threads} threads");
        assert!(text(&done).contains(&format!("on {ranks} ranks")), "{}", text(&done));
        for file in ["history.csv", "frames/grains_000000.vtp", "frames/grains_000002.vtp"] {
            let [one, other] = ["alone", &out].map(|out| std::fs::read(desk.path(out).join(file)).unwrap());
            assert!(one == other, "{file} on {ranks} ranks");
        }
    }
}

#[test]
fn stages_streams_and_removal_have_the_same_bits() {
    for scene in [SILO, CHUTE] {
        let desk = Desk::with(scene);
        let alone = desk.alone();
        for (ranks, threads) in NUMBERS {
            let done = desk.run(ranks, &format!("run scene.toml -q --threads {threads} -o out{ranks}"));
            assert!(done.status.success(), "{}", text(&done));
            assert_eq!(desk.hash(&format!("out{ranks}")), alone, "{ranks} ranks of {threads} threads");
        }
    }
}

/// One rank is killed without a word. All end within seconds, and the run goes on from its checkpoint on another number of ranks.
#[test]
fn a_killed_rank_ends_the_run_and_another_number_goes_on() {
    for scene in [DAMPER.replace("0.02 s", "0.2 s"), format!("{SILO}[output]\ncheckpoint-interval = \"20 ms\"\n")] {
        killed(&Desk::with(&scene));
    }
}

fn killed(desk: &Desk) {
    let child = desk.command(3, "run scene.toml -q --threads 1 -o out").spawn().unwrap();
    desk.checkpoint("out");
    let ranks = Command::new("pgrep").args(["-f", &format!("^{PROGRAM} run scene.toml.*-o out")]).output().unwrap();
    let of_this_test = |pid: &&str| {
        std::fs::read_link(Path::new("/proc").join(pid).join("cwd")).is_ok_and(|cwd| cwd == desk.folder.path())
    };
    let listed = String::from_utf8_lossy(&ranks.stdout).into_owned();
    let pids: Vec<&str> = listed.lines().filter(of_this_test).collect();
    assert_eq!(pids.len(), 3, "{listed}");
    assert!(Command::new("kill").args(["-9", pids[1]]).status().unwrap().success());
    let begun = Instant::now();
    let ended = child.wait_with_output().unwrap();
    assert!(!ended.status.success() && begun.elapsed() < Duration::from_secs(10), "{ended:?}");
    // The launcher says who was killed.
    let said = text(&ended).to_lowercase();
    assert!(said.contains("signal") && said.contains("kill"), "{said}");
    let done = desk.run(2, "run scene.toml -q --threads 1 -o out --resume");
    assert!(done.status.success(), "{}", text(&done));
    assert_eq!(desk.hash("out"), desk.alone());
}

#[test]
fn an_interrupted_run_goes_on_alone() {
    let desk = Desk::with(&DAMPER.replace("0.02 s", "0.2 s"));
    let child = desk.command(2, "run scene.toml -q --threads 1 -o out").spawn().unwrap();
    desk.checkpoint("out");
    assert!(Command::new("kill").args(["-TERM", &child.id().to_string()]).status().unwrap().success());
    end(child);
    let mut command = Command::new(PROGRAM);
    command.args(["run", "scene.toml", "-q", "-o", "out", "--resume"]).current_dir(desk.folder.path());
    assert!(command.output().unwrap().status.success());
    assert_eq!(desk.hash("out"), desk.alone());
}

/// A task of a sweep on several ranks, as the job script starts it: runs with the bits of one rank; done again it does nothing, and a
/// case that goes wrong leaves the other to be done.
#[test]
fn a_task_of_a_sweep_is_done_on_several_ranks() {
    let desk = Desk::with(&format!("{DAMPER}\n[sweep]\nvary = {{ seed = [1, 2] }}\n"));
    let alone =
        Command::new(PROGRAM).args("sweep scene.toml -q -o alone".split(' ')).current_dir(desk.folder.path()).output();
    assert!(alone.unwrap().status.success());
    let task = "sweep scene.toml -q -o out --case seed=1 --case seed=2";
    let done = desk.run(3, task);
    assert!(done.status.success(), "{}", text(&done));
    let when = |case: &str| desk.path(case).join("summary.json").metadata().unwrap().modified().unwrap();
    let cases = ["out/cases/seed=1", "out/cases/seed=2"];
    for case in cases {
        assert_eq!(desk.hash(case), desk.hash(&case.replace("out", "alone")));
        let summary = std::fs::read_to_string(desk.path(case).join("summary.json")).unwrap();
        assert!(summary.contains("\"count\": 3"), "{summary}");
    }
    let before = cases.map(when);
    let again = desk.run(2, task);
    assert!(again.status.success() && cases.map(when) == before, "{}", text(&again));
    let wrong = desk.run(2, "sweep scene.toml -q -o wrong --set dem.largest-overlap=1e-9 --case seed=1 --case seed=2");
    assert_eq!(text(&wrong).matches("more than `dem.largest-overlap`").count(), 0, "{}", text(&wrong));
    assert!(!wrong.status.success() && text(&wrong).contains("2 of 2 cases failed"), "{}", text(&wrong));
}

/// The job script asks for as many tasks as ranks, and starts each run on them; the last job is one task.
#[test]
fn a_job_script_asks_for_ranks() {
    let desk = Desk::with(&format!("{DAMPER}\n[sweep]\nvary = {{ seed = [1, 2] }}\n"));
    let words = "sweep scene.toml -o out --launcher slurm --dry-run --ranks 4 --threads 2 --per-task 1";
    let script = Command::new(PROGRAM).args(words.split(' ')).current_dir(desk.folder.path()).output().unwrap();
    let script = text(&script);
    for line in [
        "#SBATCH --ntasks=4",
        "#SBATCH --cpus-per-task=2",
        "#SBATCH --mem-per-cpu=",
        "exec mpirun -n 4 ",
        " --ranks 4\n",
    ] {
        assert!(script.contains(line), "{line}\n{script}");
    }
    assert!(!script.contains("--nodes=1"), "{script}");
}

#[test]
fn what_cannot_be_done_is_said_once() {
    let desk = Desk::with(DAMPER);
    let cases = [
        ("check scene.toml", "works on one"),
        ("run nowhere.toml", "there is no such file"),
        ("run scene.toml --set method=lattice", "it runs on one rank"),
        ("run scene.toml --set dem.largest-overlap=1e-9", "more than `dem.largest-overlap`"),
    ];
    for (words, says) in cases {
        let done = desk.run(2, words);
        assert!(!done.status.success());
        assert_eq!(text(&done).matches(says).count(), 1, "{words}\n{}", text(&done));
    }
}
