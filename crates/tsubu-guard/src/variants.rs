//! One answer for every way to compute it: each scene by each method, run in ten ways that must not matter.
//!
//! Threads, the times at which rows and frames are written, a machine that is busy, and runs that are cut and resumed decide how
//! steps are shared out among calls. None of that may change a bit of the final state, the books, or a row of a table.

use crate::limits;
use crate::seeds::root;
use clap::Args;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;
use tsubu_scene::Scene;
use tsubu_scene::plan::Method;

const HISTORY: &str = "history.csv";

/// Fewer steps than this cannot be cut twice.
const FEWEST_STEPS: f64 = 60.0;

/// What is tried.
#[derive(Args)]
pub struct Options {
    /// Seed of the times at which runs are cut
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Computing time of a run, about [s]
    #[arg(long, default_value_t = 0.7, conflicts_with = "quick")]
    pub seconds: f64,
    /// Each scene by its own method alone, for a moment
    #[arg(long)]
    pub quick: bool,
    /// In the last way alone, which has frames, threads, and cuts where there can be some
    #[arg(long)]
    pub last_way: bool,
    /// The program [default: that of the same build]
    #[arg(long)]
    pub tsubu: Option<PathBuf>,
}

/// What an earlier program is held against.
#[derive(Args)]
pub struct Earlier {
    /// The earlier program
    pub earlier: PathBuf,
    /// Computing time of a run, about [s]
    #[arg(long, default_value_t = 2.0)]
    pub seconds: f64,
    /// The program [default: that of the same build]
    #[arg(long)]
    pub tsubu: Option<PathBuf>,
}

/// A scene by a method, for a time in which something happens [s].
struct Case {
    tsubu: PathBuf,
    scene: PathBuf,
    method: &'static str,
    duration: f64,
}

/// A way to compute it. What is not said is as in the first.
#[derive(Clone, Default)]
struct Variant {
    name: &'static str,
    threads: usize,
    /// Rows of the history.
    rows: usize,
    frames: bool,
    busy: bool,
    /// Shares of the time after which the run ends, to be resumed.
    cuts: Vec<f64>,
}

/// What must be the same.
#[derive(PartialEq)]
struct Answer {
    hash: Value,
    energy: Value,
    steps: Value,
    /// Rows of every table.
    tables: BTreeMap<String, Vec<String>>,
}

/// Each scene by its own method, by this program and by an earlier one: for changes that must not change a number. A hash that
/// differs alone is told apart: it covers the names under which the state is kept.
pub fn same(options: &Earlier) -> Result<bool, String> {
    let (mut wrong, mut names) = (0, 0);
    let cases = cases(options.tsubu.as_deref(), options.seconds, false)?;
    for case in &cases {
        let way = Variant { threads: 1, rows: 40, frames: true, ..Variant::default() };
        let now = case.run(&way)?;
        let mut before = Case { tsubu: options.earlier.clone(), scene: case.scene.clone(), ..*case }.run(&way)?;
        let named = before.hash != now.hash;
        before.hash.clone_from(&now.hash);
        let told = match now.differs(&before) {
            Some(text) => {
                wrong += 1;
                format!("DIFFERS: {text}")
            }
            None if named => {
                names += 1;
                "the same but for the hash".to_owned()
            }
            None => "the same".to_owned(),
        };
        println!("{:<18} t = {:<8.3e} s  {told}", case.name(), case.duration);
    }
    println!("\n{} scenes: {wrong} differ, {names} in the hash alone", cases.len());
    Ok(wrong == 0)
}

/// Runs all; says what differs, and whether nothing does.
pub fn variants(options: &Options) -> Result<bool, String> {
    let begun = Instant::now();
    let seconds = if options.quick { 0.1 } else { options.seconds };
    let cases = cases(options.tsubu.as_deref(), seconds, !options.quick)?;
    let (next, runs) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let found = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                while let Some(case) = cases.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let (done, wrong) = hold(case, options);
                    runs.fetch_add(done, Ordering::Relaxed);
                    let told = if wrong.is_empty() { "the same" } else { "DIFFERS" };
                    println!("{:<18} {:<28} t = {:<8.3e} s  {told}", case.name(), case.method, case.duration);
                    for text in &wrong {
                        println!("    {text}");
                    }
                    found.lock().unwrap_or_else(PoisonError::into_inner).extend(wrong);
                }
            });
        }
    });
    let wrong = found.into_inner().unwrap_or_else(PoisonError::into_inner).len();
    let (cases, runs, seconds) = (cases.len(), runs.into_inner(), begun.elapsed().as_secs_f64());
    println!("\n{cases} scenes and methods, {runs} runs, seed {}, {seconds:.0} s: {wrong} differ", options.seed);
    Ok(wrong == 0)
}

/// All ways but the first, which they are held against.
fn ways(case: &Case, seed: u64) -> Vec<Variant> {
    // Any even spread of cuts will do; not a fixed one, so that no scene is always cut at the same step.
    let draw = |k: u64| {
        let mut x = seed ^ (k << 32) ^ case.duration.to_bits() ^ case.name().len() as u64;
        for _ in 0..3 {
            x = (x ^ (x >> 31)).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        }
        (x >> 11) as f64 / (1u64 << 53) as f64
    };
    let first = Variant { threads: 1, rows: 40, ..Variant::default() };
    let (early, late) = (0.05 + 0.4 * draw(1), 0.5 + 0.45 * draw(2));
    let mut ways = vec![
        Variant { name: "beside busy programs", busy: true, ..first.clone() },
        Variant { name: "2 threads", threads: 2, ..first.clone() },
        Variant { name: "3 threads", threads: 3, ..first.clone() },
        Variant { name: "8 threads", threads: 8, ..first.clone() },
        Variant { name: "more rows", rows: 1000, ..first.clone() },
        Variant { name: "few rows", rows: 8, ..first.clone() },
        Variant { name: "with frames", frames: true, ..first.clone() },
    ];
    // A pile at rest knows no time: its step is a share of the duration, and a run that ends earlier is another one.
    if case.method != Method::AfterHemmingssonHerrmann.name() {
        let twice = vec![early, late];
        ways.push(Variant { name: "cut and resumed", cuts: vec![early], ..first.clone() });
        ways.push(Variant { name: "cut twice, resumed on 3 threads", cuts: twice, threads: 3, frames: true, ..first });
    }
    ways
}

/// Holds all ways against the first; how many runs, and what differed.
fn hold(case: &Case, options: &Options) -> (usize, Vec<String>) {
    let first = Variant { name: "one thread", threads: 1, rows: 40, ..Variant::default() };
    let wanted = match case.run(&first) {
        Ok(answer) => answer,
        Err(text) => return (1, vec![format!("{}: {text}", first.name)]),
    };
    let mut ways = ways(case, options.seed);
    if options.last_way {
        ways.drain(..ways.len() - 1);
    }
    let wrong = ways.iter().filter_map(|way| {
        let text = match case.run(way) {
            Ok(answer) => wanted.differs(&answer)?,
            Err(text) => text,
        };
        Some(format!("{}: {text}", way.name))
    });
    let wrong = wrong.collect();
    (1 + ways.len(), wrong)
}

/// Every scene by its own method, or by all that take it if `by_all`, each for as long as the computing takes that is wanted.
fn cases(tsubu: Option<&Path>, seconds: f64, by_all: bool) -> Result<Vec<Case>, String> {
    let beside = || limits::beside("tsubu").map_err(|error| error.to_string());
    let tsubu = tsubu.map_or_else(beside, |tsubu| Ok(tsubu.to_owned()))?;
    let mut cases = Vec::new();
    for name in scenes()? {
        let scene = root().join(format!("scenes/{name}.toml"));
        let plan = Scene::read(&scene, &[]).map_err(|complaints| complaints.to_string())?;
        if plan.plans().len() > 1 {
            // How long it takes is said stage by stage; `tests/stages.rs` kills and resumes each of them.
            println!("{name}: has stages, and is left to the tests of stages");
            continue;
        }
        let (own, whole) = (plan.plan().method.name(), plan.plan().duration);
        let others = Method::ALL.iter().map(|method| method.name()).filter(|other| by_all && *other != own);
        for method in std::iter::once(own).chain(others) {
            let mut case = Case { tsubu: tsubu.clone(), scene: scene.clone(), method, duration: whole };
            // Grains settle before time 0, and most scenes change as they go: longer and longer until it is enough.
            for share in [0.003, 0.03, 0.3] {
                case.duration = share * whole;
                let begun = Instant::now();
                let steps = match case.run(&Variant { threads: 1, rows: 1, ..Variant::default() }) {
                    Ok(answer) => answer.steps.as_f64().unwrap_or_default(),
                    Err(_) if method != own => break,
                    Err(text) => return Err(format!("{name}: {text}")),
                };
                let speed = begun.elapsed().as_secs_f64() / case.duration;
                if speed * case.duration > 0.1 * seconds || share == 0.3 {
                    let least = case.duration * FEWEST_STEPS / steps.max(1.0);
                    case.duration = whole.min((seconds / speed).max(least));
                    cases.push(case);
                    break;
                }
            }
        }
    }
    Ok(cases)
}

/// The name of every scene, in order.
fn scenes() -> Result<Vec<String>, String> {
    let entries = fs::read_dir(root().join("scenes")).map_err(|error| format!("cannot list scenes/: {error}"))?;
    let files =
        entries.flatten().map(|entry| entry.path()).filter(|path| path.extension().is_some_and(|e| e == "toml"));
    let mut names: Vec<String> =
        files.filter_map(|path| Some(path.file_stem()?.to_string_lossy().into_owned())).collect();
    names.sort();
    if names.is_empty() { Err("there are no scenes".to_owned()) } else { Ok(names) }
}

impl Case {
    fn name(&self) -> String {
        self.scene.file_stem().unwrap_or_default().to_string_lossy().into_owned()
    }

    fn run(&self, variant: &Variant) -> Result<Answer, String> {
        let folder = root().join(format!("target/variants/{}-{}", self.name(), self.method));
        let _ = fs::remove_dir_all(&folder);
        let stop = AtomicBool::new(false);
        std::thread::scope(|scope| {
            for _ in 0..if variant.busy { 4 } else { 0 } {
                scope.spawn(|| {
                    while !stop.load(Ordering::Relaxed) {
                        std::hint::spin_loop();
                    }
                });
            }
            let ends = variant.cuts.iter().copied().chain([1.0]);
            let done = ends.enumerate().try_for_each(|(k, end)| self.go(variant, &folder, end, k > 0));
            stop.store(true, Ordering::Relaxed);
            done
        })?;
        Answer::read(&folder)
    }

    /// Runs to a share of the time.
    fn go(&self, variant: &Variant, folder: &Path, end: f64, resume: bool) -> Result<(), String> {
        let mut command = Command::new(&self.tsubu);
        command.arg("run").arg(&self.scene).arg("-o").arg(folder).args([
            "-q",
            "--threads",
            &variant.threads.to_string(),
        ]);
        let mut set = |text: String| _ = command.args(["--set", &text]);
        set(format!("method='{}'", self.method));
        set(format!("duration={:e}", end * self.duration));
        set(format!("output.history-interval={:e}", self.duration / variant.rows as f64));
        set(format!("output.checkpoint-interval={:e}", self.duration / 3.0));
        if variant.frames {
            set(format!("output.frame-interval={:e}", self.duration / 5.0));
        }
        set("claim=[]".to_owned());
        if resume {
            command.arg("--resume");
        }
        let output = command.output().map_err(|error| {
            let program = command.get_program().display();
            format!("cannot start {program}: {error}")
        })?;
        if output.status.success() { Ok(()) } else { Err(String::from_utf8_lossy(&output.stderr).trim().to_owned()) }
    }
}

impl Answer {
    fn read(folder: &Path) -> Result<Self, String> {
        let text = |name: &str| fs::read_to_string(folder.join(name)).map_err(|error| format!("{name}: {error}"));
        let summary: Value = serde_json::from_str(&text("summary.json")?).map_err(|error| error.to_string())?;
        let mut tables = BTreeMap::new();
        let rows = |text: String| text.lines().map(str::to_owned).collect::<Vec<_>>();
        tables.insert(HISTORY.to_owned(), rows(text(HISTORY)?));
        let watches = fs::read_dir(folder.join("watch")).into_iter().flatten().flatten();
        for entry in watches.filter(|entry| entry.path().extension().is_some_and(|e| e == "csv")) {
            let name = format!("watch/{}", entry.file_name().to_string_lossy());
            tables.insert(name.clone(), rows(text(&name)?));
        }
        let [hash, energy, steps] = ["state_hash", "energy", "steps"].map(|key| summary[key].clone());
        Ok(Self { hash, energy, steps, tables })
    }

    /// What differs, if anything does.
    fn differs(&self, other: &Self) -> Option<String> {
        for (what, one, another) in [
            ("steps", &self.steps, &other.steps),
            ("state_hash", &self.hash, &other.hash),
            ("energy", &self.energy, &other.energy),
        ] {
            if one != another {
                return Some(format!("{what}: {one}, then {another}"));
            }
        }
        self.tables.iter().find_map(|(name, rows)| {
            let Some(others) = other.tables.get(name) else { return Some(format!("{name} is not there")) };
            table_differs(name, rows, others).map(|text| format!("{name}: {text}"))
        })
    }
}

/// What differs between two tables: all of it where they have the same times. Where they have not, what the engine itself tells in
/// the history at the times of both; columns and tables of watches may hold what has been since the last look.
fn table_differs(name: &str, one: &[String], other: &[String]) -> Option<String> {
    let time = |row: &String| row.split(',').next().unwrap_or_default().to_owned();
    let told = |here: &str, there: &str| Some(format!("{here}\n        then {there}"));
    if one.iter().map(time).eq(other.iter().map(time)) {
        return one.iter().zip(other).find(|(here, there)| here != there).and_then(|(here, there)| told(here, there));
    }
    if one.first() != other.first() {
        return Some("another header".to_owned());
    }
    if name != HISTORY {
        return None;
    }
    let header: Vec<&str> = one.first()?.split(',').collect();
    let of_engine = header.iter().position(|cell| cell.starts_with("centre of mass")).map_or(0, |k| k + 1);
    let of_hosts = header[of_engine..].iter().take_while(|c| c.starts_with("host ") || c.starts_with("force on host"));
    let columns = of_engine + of_hosts.count();
    let cut = |row: &String| row.split(',').take(columns).collect::<Vec<_>>().join(",");
    let there: BTreeMap<String, String> = other.iter().map(|row| (time(row), cut(row))).collect();
    let both = one.iter().filter_map(|row| Some((cut(row), there.get(&time(row))?)));
    both.into_iter().find(|(here, there)| here != *there).and_then(|(here, there)| told(&here, there))
}
