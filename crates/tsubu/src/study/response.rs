//! Frequency response of a host: every case at every frequency, side by side.
//!
//! Each case settles its grains once a seed; all its frequencies start from that bed. Periods in which the transient dies
//! away are thrown away, then whole periods are measured, mean removed (Komatsuzaki 2003: root mean square over ten
//! periods). A run that fails is said, and missing in its curve. A response that was stopped goes on where it was: every finished run is a line in `progress.jsonl`.

mod curve;
mod tasks;
mod write;

pub use curve::{CaseResult, Peak, peak};
pub use tasks::{Point, measure};

use super::cases::{Case, CasesError, cases};
use crate::engine::OpenError;
use crate::interrupt::{Interrupt, Watcher};
use crate::run::{RunError, scene_hash};
use crate::scene_files;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{File, OpenOptions};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;
use tsubu_frame::{Existing, FileError, RunFolder, State, Status, Summary};
use tsubu_scene::{Plan, Scene, plan};

/// One run of the response.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
struct Key {
    case: usize,
    seed: u32,
    frequency: usize,
}

/// Computes the frequency response of a scene into `folder`. An existing folder of the same scene is gone on with.
pub fn response(scene: &Scene, folder: &Path, overwrite: bool, watcher: &Watcher) -> Result<Summary, CasesError> {
    let begun = Instant::now();
    let task = Task::new(scene)?;
    let resolved = scene.resolved_toml();
    let earlier = earlier(folder, &resolved, overwrite)?;
    // An interrupted response has told how long it took until then.
    let before = earlier.as_ref().and_then(|_| Summary::read(&folder.join("summary.json")).ok());
    let before = before.map_or(0.0, |summary| summary.wall_seconds);
    let keys = task.missing(earlier.as_ref());
    let (beds, mut failures) = task.settle(&keys)?;
    // Only now, so that a scene that a method refuses leaves nothing behind.
    let (folder, mut points) = open_folder(folder, earlier, scene, overwrite)?;
    let journal = Mutex::new(journal(&folder)?);
    let record = |key: &Key, point: &Point| -> Result<(), CasesError> {
        if let Ok(mut file) = journal.lock() {
            let line = serde_json::to_string(&(key, point)).unwrap_or_default();
            writeln!(file, "{line}").map_err(FileError::write(&folder.file("progress.jsonl")))?;
        }
        Ok(())
    };
    let (measured, failed) = task.measure(&keys, &beds, &record, watcher)?;
    points.extend(measured);
    failures.extend(failed);
    let status = match points.len() {
        done if done == task.total() => Status::Finished,
        _ if watcher.interrupt.asked() => Status::Interrupted,
        0 => return Err(task.first(failures)),
        _ => Status::Failed,
    };
    let results = task.results(&points);
    let _held = watcher.interrupt.hold();
    if status == Status::Finished {
        task.film(&results, &folder)?;
    }
    let failures = failures.iter().map(|failure| task.told(failure)).collect();
    let took = before + begun.elapsed().as_secs_f64();
    Ok(write::write(&folder, scene, &task.plans, &results, status, failures, took)?)
}

/// The curves of a scene's response, without any file.
pub fn curves(scene: &Scene) -> Result<Vec<CaseResult>, CasesError> {
    let task = Task::new(scene)?;
    let keys = task.missing(None);
    let (beds, mut failures) = task.settle(&keys)?;
    let watcher = Watcher { interrupt: &Interrupt::new(), progress: &|_| {} };
    let (points, failed) = task.measure(&keys, &beds, &|_, _| Ok(()), &watcher)?;
    failures.extend(failed);
    if failures.is_empty() { Ok(task.results(&points)) } else { Err(task.first(failures)) }
}

type Done = BTreeMap<Key, Point>;

/// Settled beds by case and seed.
type Beds = BTreeMap<(usize, u32), State>;

/// A run that broke off: the first of those of a bed where it did not settle. The others go on.
struct Failed {
    key: Key,
    error: RunError,
}

/// What a response has to compute.
struct Task {
    wanted: plan::Response,
    reference: f64,
    cases: Vec<Case>,
    plans: Vec<Plan>,
}

impl Task {
    fn new(scene: &Scene) -> Result<Self, CasesError> {
        let plan = scene.plan();
        let wanted = plan.response.clone().ok_or_else(|| {
            CasesError::Scene("the scene has no `[response]`: say which frequencies, for example `frequency-ratio = { from = 0.85, to = 1.15, step = 0.01 }`".to_owned())
        })?;
        if scene.plans().len() > 1 {
            return Err(CasesError::Scene(
                "a response is of a scene of one stage: leave `[[stage]]` out, or run it".to_owned(),
            ));
        }
        let reference = tasks::reference_frequency(plan, &wanted.host).map_err(CasesError::Scene)?;
        let cases = cases(&wanted.vary);
        let plans = case_plans(scene, &cases)?;
        Ok(Self { wanted, reference, cases, plans })
    }

    fn total(&self) -> usize {
        self.plans.len() * self.wanted.seeds as usize * self.wanted.frequency_ratio.len()
    }

    /// The runs that are not done, long ones first, so that no core is left with one at the end.
    fn missing(&self, done: Option<&Done>) -> Vec<Key> {
        let mut keys: Vec<Key> = Vec::new();
        for case in 0..self.plans.len() {
            for seed in 0..self.wanted.seeds {
                for frequency in 0..self.wanted.frequency_ratio.len() {
                    keys.push(Key { case, seed, frequency });
                }
            }
        }
        keys.retain(|key| done.is_none_or(|done| !done.contains_key(key)));
        keys.sort_by_key(|k| std::cmp::Reverse(tasks::weight(&self.plans[k.case])));
        keys
    }

    fn fail(&self, case: usize, error: RunError) -> CasesError {
        CasesError::Run { case: self.cases[case].name.clone(), error }
    }

    /// A failure in a sentence.
    fn told(&self, Failed { key, error }: &Failed) -> String {
        let (case, ratio) = (&self.cases[key.case].name, self.wanted.frequency_ratio[key.frequency]);
        let case = if case.is_empty() { String::new() } else { format!("case `{case}`, ") };
        format!("{case}frequency ratio {ratio}, seed {}: the run failed and is not in the curve: {error}", key.seed)
    }

    /// The failure that stands for all.
    fn first(&self, mut failures: Vec<Failed>) -> CasesError {
        failures.sort_by_key(|failed| std::cmp::Reverse(failed.key));
        let Some(Failed { key, error }) = failures.pop() else {
            return CasesError::Scene("there is nothing to run".to_owned());
        };
        self.fail(key.case, error)
    }

    /// Settles the bed of every case and seed among the keys.
    fn settle(&self, keys: &[Key]) -> Result<(Beds, Vec<Failed>), CasesError> {
        let needed: BTreeSet<(usize, u32)> = keys.iter().map(|k| (k.case, k.seed)).collect();
        let failures = Mutex::new(Vec::new());
        let settled: Result<Vec<_>, CasesError> = needed
            .par_iter()
            .map(|&(case, seed)| match tasks::bed(&self.plans[case], seed) {
                Ok(bed) => Ok(Some(((case, seed), bed))),
                Err(error @ OpenError::Settling(_)) => {
                    keep(&failures, Key { case, seed, frequency: 0 }, error.into());
                    Ok(None)
                }
                Err(error) => Err(self.fail(case, error.into())),
            })
            .collect();
        Ok((settled?.into_iter().flatten().collect(), failures.into_inner().unwrap_or_default()))
    }

    /// Runs the keys side by side; `record` hears of every finished one.
    fn measure(
        &self,
        keys: &[Key],
        beds: &Beds,
        record: &(dyn Fn(&Key, &Point) -> Result<(), CasesError> + Sync),
        watcher: &Watcher,
    ) -> Result<(Done, Vec<Failed>), CasesError> {
        let failures = Mutex::new(Vec::new());
        let total = self.total();
        let counter = AtomicUsize::new(total - keys.len());
        let done: Result<Done, CasesError> = keys
            .par_iter()
            .map(|key| {
                if watcher.interrupt.asked() {
                    return Ok(None);
                }
                let frequency = self.reference * self.wanted.frequency_ratio[key.frequency];
                let Some(bed) = beds.get(&(key.case, key.seed)) else { return Ok(None) };
                let plan = &self.plans[key.case];
                let point = match measure(plan, &self.wanted, key.seed, bed, frequency, watcher.interrupt) {
                    Ok(Some(point)) => point,
                    Ok(None) => return Ok(None),
                    Err(error @ RunError::Fault(_)) => {
                        keep(&failures, *key, error);
                        return Ok(None);
                    }
                    Err(error) => return Err(self.fail(key.case, error)),
                };
                record(key, &point)?;
                let finished = counter.fetch_add(1, Ordering::Relaxed) + 1;
                (watcher.progress)(finished as f64 / total as f64);
                Ok(Some((*key, point)))
            })
            .filter_map(Result::transpose)
            .collect();
        Ok((done?, failures.into_inner().unwrap_or_default()))
    }

    /// Eight pictures of one period of the best case at its peak: of those with grains, the one with the lowest peak.
    fn film(&self, results: &[CaseResult], folder: &RunFolder) -> Result<(), CasesError> {
        let peaks = results.iter().enumerate().filter(|(_, case)| case.particles > 0);
        let peaks = peaks.filter_map(|(i, case)| Some((i, case.peak?)));
        let best = peaks.min_by(|(_, a), (_, b)| a.rms.total_cmp(&b.rms));
        let Some((index, peak)) = best else { return Ok(()) };
        let bed = tasks::bed(&self.plans[index], 0).map_err(|e| self.fail(index, e.into()))?;
        tasks::film(&self.plans[index], &self.wanted, &bed, self.reference * peak.ratio, folder)
            .map_err(|e| self.fail(index, e))
    }

    fn results(&self, points: &Done) -> Vec<CaseResult> {
        let of_case = |index: usize| -> Vec<(usize, &Point)> {
            points.iter().filter(|(k, _)| k.case == index).map(|(k, p)| (k.frequency, p)).collect()
        };
        self.cases
            .iter()
            .zip(&self.plans)
            .enumerate()
            .map(|(index, (case, plan))| {
                CaseResult::new(&case.name, plan, self.reference, &self.wanted.frequency_ratio, &of_case(index))
            })
            .collect()
    }
}

fn keep(failures: &Mutex<Vec<Failed>>, key: Key, error: RunError) {
    if let Ok(mut failures) = failures.lock() {
        failures.push(Failed { key, error });
    }
}

fn case_plans(scene: &Scene, list: &[Case]) -> Result<Vec<Plan>, CasesError> {
    list.iter().map(|case| Ok(case.scene(scene).map_err(CasesError::Complaints)?.plan().clone())).collect()
}

/// First line of the journal: which scene it belongs to.
fn mark(resolved: &str) -> String {
    serde_json::json!({ "scene": scene_hash(resolved), "version": crate::VERSION }).to_string()
}

/// What an interrupted response of the same scene has done in the folder; `None` where a new one is to begin.
fn earlier(path: &Path, resolved: &str, overwrite: bool) -> Result<Option<Done>, FileError> {
    if overwrite {
        return Ok(None);
    }
    let text = std::fs::read_to_string(path.join("progress.jsonl")).unwrap_or_default();
    if text.lines().next() == Some(mark(resolved).as_str()) {
        // The last line may be cut in half; it is computed again.
        return Ok(Some(text.lines().skip(1).filter_map(|l| serde_json::from_str::<(Key, Point)>(l).ok()).collect()));
    }
    let occupied = std::fs::read_dir(path).is_ok_and(|mut entries| entries.next().is_some());
    if occupied { Err(FileError::NotEmpty { path: path.to_owned() }) } else { Ok(None) }
}

/// Makes the folder, or takes the one that an earlier response has begun.
fn open_folder(
    path: &Path,
    earlier: Option<Done>,
    scene: &Scene,
    overwrite: bool,
) -> Result<(RunFolder, Done), FileError> {
    if let Some(done) = earlier {
        return Ok((RunFolder::create(path, Existing::Resume, names(scene))?, done));
    }
    let existing = if overwrite { Existing::Overwrite } else { Existing::Refuse };
    let folder = RunFolder::create(path, existing, names(scene))?;
    scene_files::write(&folder, scene)?;
    folder.claim(names(scene))?;
    folder.write("progress.jsonl", format!("{}\n", mark(&scene.resolved_toml())).as_bytes())?;
    Ok((folder, Done::new()))
}

/// The files of a response; those of its page come later.
fn names(scene: &Scene) -> Vec<String> {
    let tables = ["response.csv", "cases.csv", "energy_by_cause.csv"];
    let own = tables.into_iter().chain(["check.txt", "summary.json", "progress.jsonl", "frames/"]);
    scene_files::names(scene).into_iter().chain(own.map(str::to_owned)).collect()
}

fn journal(folder: &RunFolder) -> Result<File, FileError> {
    let path: PathBuf = folder.file("progress.jsonl");
    let mut file = OpenOptions::new().append(true).open(&path).map_err(FileError::write(&path))?;
    // A line cut short by a kill must not swallow the next one.
    writeln!(file).map_err(FileError::write(&path))?;
    Ok(file)
}

impl From<OpenError> for CasesError {
    fn from(error: OpenError) -> Self {
        Self::Open(error)
    }
}
