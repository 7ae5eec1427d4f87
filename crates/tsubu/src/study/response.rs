//! Frequency response of a host: every case at every frequency, side by side.
//!
//! Each case settles its grains once a seed; all its frequencies start from that bed. Periods in which the transient dies
//! away are thrown away, then whole periods are measured, mean removed (Komatsuzaki 2003: root mean square over ten
//! periods). Frequencies are measured in rounds: those that were asked for, then more where the curves bend. A run that fails is said,
//! and missing in its curve. A response that was stopped goes on where it was.

mod apart;
mod curve;
mod point;
pub(super) mod refine;
mod rounds;
pub(super) mod tasks;
pub(super) mod transient;
mod write;

pub use apart::runs;
pub use curve::{CaseResult, Hysteresis, Peak, peak};
pub use point::Point;
pub use tasks::{bed, measure};

use super::cases::{Case, CasesError, case_plans, cases};
use super::journal::{Exact, Journal, Place};
use super::journaled;
use crate::engine::OpenError;
use crate::interrupt::{Interrupt, Watcher};
use crate::run::RunError;
use rayon::prelude::*;
use rounds::Rounds;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;
use tsubu_frame::{RunFolder, State, Status, Summary};
use tsubu_scene::{Plan, Scene, plan};

/// Computes the frequency response of a scene into `folder`. An existing folder of the same scene is gone on with.
pub fn response(scene: &Scene, folder: &Path, overwrite: bool, watcher: &Watcher) -> Result<Summary, CasesError> {
    let begun = Instant::now();
    let task = Task::new(scene)?;
    let place = Place { study: "response", scene, folder };
    let earlier: Option<Done> = place.earlier(overwrite)?;
    // An interrupted response has told how long it took until then.
    let before = earlier.as_ref().and_then(|_| Summary::read(&folder.join("summary.json")).ok());
    let before = before.map_or(0.0, |summary| summary.wall_seconds);
    let mut rounds = Rounds::new(&task, earlier.as_ref());
    let (mut beds, mut failures) = (Beds::new(), Vec::new());
    task.settle(&rounds.missing, &mut beds, &mut failures)?;
    // Only now, so that a scene that a method refuses leaves nothing behind.
    let folder = place.open(earlier.is_some(), overwrite, &FILES)?;
    let journal = Journal::append(&folder)?;
    let record = |key: &Key, point: &Point| journal.record(key, point);
    let complete = task.measure(&mut rounds, &mut beds, &mut failures, &record, watcher)?;
    let points = rounds.points;
    let status = match points.len() {
        done if complete && done == rounds.asked.len() => Status::Finished,
        _ if watcher.interrupt.asked() => Status::Interrupted,
        0 => return Err(task.first(failures)),
        _ => Status::Failed,
    };
    let results = task.results(&points);
    let _held = watcher.interrupt.hold();
    if status == Status::Finished {
        task.film(&results, &points, &mut beds, &folder)?;
    }
    let failures = failures.iter().map(|failure| task.told(failure)).collect();
    let took = before + begun.elapsed().as_secs_f64();
    Ok(write::write(&folder, scene, &task.plans, &results, status, failures, took)?)
}

/// The curves of a scene's response, without any file.
pub fn curves(scene: &Scene) -> Result<Vec<CaseResult>, CasesError> {
    let task = Task::new(scene)?;
    let mut rounds = Rounds::new(&task, None);
    let (mut beds, mut failures) = (Beds::new(), Vec::new());
    task.settle(&rounds.missing, &mut beds, &mut failures)?;
    let watcher = Watcher { interrupt: &Interrupt::new(), progress: &|_| {} };
    task.measure(&mut rounds, &mut beds, &mut failures, &|_, _| Ok(()), &watcher)?;
    if failures.is_empty() { Ok(task.results(&rounds.points)) } else { Err(task.first(failures)) }
}

/// What a response writes beside what every study writes.
const FILES: [&str; 4] = ["response.csv", "cases.csv", "energy_by_cause.csv", "frames/"];

/// One run of the response.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
struct Key {
    case: usize,
    seed: u32,
    /// Frequency over the natural frequency.
    ratio: Exact,
}

/// All that is measured.
type Done = BTreeMap<Key, Point>;

/// Hears of every finished run.
type Record<'a> = journaled::Record<'a, Key, Point>;

/// Settled beds by case and seed; nothing where one did not settle.
type Beds = BTreeMap<(usize, u32), Option<State<'static>>>;

/// A run that broke off: the first of those of a bed where it did not settle. The others go on.
struct Failed {
    key: Key,
    error: RunError,
}

/// What a response has to compute.
struct Task {
    wanted: plan::Response,
    reference: f64,
    /// Each way of going through the frequencies is a case of its own.
    cases: Vec<Case>,
    ways: Vec<Way>,
    plans: Vec<Plan>,
}

/// How the frequencies of a case are gone through.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Way {
    Apart,
    Up,
    Down,
}

impl Way {
    fn all(path: plan::Path) -> &'static [(Self, &'static str)] {
        match path {
            plan::Path::Apart => &[(Self::Apart, "")],
            plan::Path::Up => &[(Self::Up, "up")],
            plan::Path::Down => &[(Self::Down, "down")],
            plan::Path::UpAndDown => &[(Self::Up, "up"), (Self::Down, "down")],
        }
    }
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
        let ways = Way::all(wanted.path);
        let each = cases(&wanted.vary).into_iter().flat_map(|case| {
            ways.iter().map(move |(way, word)| {
                let words: Vec<&str> = [case.name.as_str(), word].into_iter().filter(|word| !word.is_empty()).collect();
                (*way, Case { name: words.join(", "), values: case.values.clone() })
            })
        });
        let (ways, cases): (Vec<Way>, Vec<Case>) = each.unzip();
        let plans = case_plans(scene, &cases)?;
        Ok(Self { wanted, reference, cases, ways, plans })
    }

    fn fail(&self, case: usize, error: RunError) -> CasesError {
        CasesError::Run { case: self.cases[case].name.clone(), error }
    }

    /// A failure in a sentence.
    fn told(&self, Failed { key, error }: &Failed) -> String {
        let (case, ratio) = (&self.cases[key.case].name, key.ratio.0);
        let case = if case.is_empty() { String::new() } else { format!("case `{case}`, ") };
        let lost = match self.ways[key.case] {
            Way::Apart => "the run failed and is not in the curve",
            Way::Up | Way::Down => "the run failed; neither it nor what comes after it on the way is in the curve",
        };
        format!("{case}frequency ratio {ratio}, seed {}: {lost}: {error}", key.seed)
    }

    /// The failure that stands for all.
    fn first(&self, mut failures: Vec<Failed>) -> CasesError {
        failures.sort_by_key(|failed| std::cmp::Reverse(failed.key));
        let Some(Failed { key, error }) = failures.pop() else {
            return CasesError::Scene("there is nothing to run".to_owned());
        };
        self.fail(key.case, error)
    }

    /// Settles the bed of every case and seed among the keys that has none yet.
    fn settle(&self, keys: &[Key], beds: &mut Beds, failures: &mut Vec<Failed>) -> Result<(), CasesError> {
        let needed: BTreeSet<(usize, u32)> =
            keys.iter().map(|k| (k.case, k.seed)).filter(|bed| !beds.contains_key(bed)).collect();
        let settled: Result<Vec<_>, CasesError> = needed
            .into_par_iter()
            .map(|(case, seed)| match tasks::bed(&self.plans[case], seed) {
                Ok(bed) => Ok(((case, seed), Ok(bed))),
                Err(error @ OpenError::Settling(_)) => Ok(((case, seed), Err(error))),
                Err(error) => Err(self.fail(case, error.into())),
            })
            .collect();
        for ((case, seed), bed) in settled? {
            let ratio = Exact(self.wanted.frequency_ratio.first().copied().unwrap_or(f64::NAN));
            let failed = |error: OpenError| Failed { key: Key { case, seed, ratio }, error: error.into() };
            beds.insert((case, seed), bed.map_err(|error| failures.push(failed(error))).ok());
        }
        Ok(())
    }

    /// Runs all rounds, the frequencies of each side by side. Says whether it came to the end.
    fn measure(
        &self,
        rounds: &mut Rounds<'_>,
        beds: &mut Beds,
        failures: &mut Vec<Failed>,
        record: Record<'_>,
        watcher: &Watcher,
    ) -> Result<bool, CasesError> {
        while !rounds.missing.is_empty() {
            self.settle(&rounds.missing, beds, failures)?;
            let (points, failed) = self.measure_round(rounds, beds, record, watcher)?;
            failures.extend(failed);
            if watcher.interrupt.asked() {
                rounds.end(points);
                return Ok(false);
            }
            rounds.next(self, points);
        }
        Ok(true)
    }

    fn measure_round(
        &self,
        rounds: &Rounds<'_>,
        beds: &Beds,
        record: Record<'_>,
        watcher: &Watcher,
    ) -> Result<(Done, Vec<Failed>), CasesError> {
        let failures = Mutex::new(Vec::new());
        let total = self.expected().max(rounds.asked.len());
        let counter = AtomicUsize::new(rounds.asked.len() - rounds.missing.len());
        let finished = |key: &Key, point: &Point| {
            record(key, point)?;
            let finished = counter.fetch_add(1, Ordering::Relaxed) + 1;
            // A walk that begins anew passes what it had done before.
            (watcher.progress)((finished as f64 / total as f64).min(1.0));
            Ok(())
        };
        let done: Result<Vec<Done>, CasesError> = self
            .walks(rounds)
            .par_iter()
            .map(|keys| {
                let mut done = Done::new();
                let Some(Key { case, seed, .. }) = keys.first().copied() else { return Ok(done) };
                let Some(Some(bed)) = beds.get(&(case, seed)) else { return Ok(done) };
                if watcher.interrupt.asked() {
                    return Ok(done);
                }
                let ended = self.walk(keys, bed, &of_case(&rounds.points, case), &finished, watcher, &mut done)?;
                if let Err(error) = ended {
                    let key = keys[done.len()];
                    match (error, failures.lock()) {
                        (error @ RunError::Fault(_), Ok(mut failures)) => failures.push(Failed { key, error }),
                        (error, _) => return Err(self.fail(case, error)),
                    }
                }
                Ok(done)
            })
            .collect();
        Ok((done?.into_iter().flatten().collect(), failures.into_inner().unwrap_or_default()))
    }

    /// What is to be run of a round: each frequency by itself, or all of a case and seed one after the other, from the first on.
    fn walks(&self, rounds: &Rounds<'_>) -> Vec<Vec<Key>> {
        let mut walks: Vec<Vec<Key>> = Vec::new();
        for key in &rounds.missing {
            let way = self.ways[key.case];
            let same = |other: &&Key| (other.case, other.seed) == (key.case, key.seed);
            if way == Way::Apart {
                walks.push(vec![*key]);
            } else if !walks.iter().any(|walk| same(&&walk[0])) {
                let mut walk: Vec<Key> = rounds.asked.iter().filter(same).copied().collect();
                if way == Way::Down {
                    walk.reverse();
                }
                walks.push(walk);
            }
        }
        walks
    }

    /// Runs what belongs together; the inner error is that of a run.
    fn walk(
        &self,
        keys: &[Key],
        bed: &State,
        known: &[&Point],
        finished: Record<'_>,
        watcher: &Watcher,
        done: &mut Done,
    ) -> Result<Result<(), RunError>, CasesError> {
        let Key { case, seed, .. } = keys[0];
        let (plan, interrupt) = (&self.plans[case], watcher.interrupt);
        let frequencies: Vec<f64> = keys.iter().map(|key| self.reference * key.ratio.0).collect();
        let mut failed = Ok(());
        let mut take = |index: usize, point: Point| {
            if failed.is_ok() {
                failed = finished(&keys[index], &point);
            }
            done.insert(keys[index], point);
        };
        let ended = if self.ways[case] == Way::Apart {
            measure(plan, &self.wanted, seed, bed, frequencies[0], known, interrupt).map(|point| {
                if let Some(point) = point {
                    take(0, point);
                }
            })
        } else {
            tasks::walk(plan, &self.wanted, seed, bed, &frequencies, interrupt, &mut take)
        };
        Ok(failed.map(|()| ended)?)
    }

    /// About how many runs there will be.
    fn expected(&self) -> usize {
        self.wanted.runs_of_case() * self.plans.len() / Way::all(self.wanted.path).len()
    }

    /// Eight pictures of one period of the best case at its peak: of those with grains, the one with the lowest peak.
    fn film(
        &self,
        results: &[CaseResult],
        points: &Done,
        beds: &mut Beds,
        folder: &RunFolder,
    ) -> Result<(), CasesError> {
        let peaks = results.iter().enumerate().filter(|(_, case)| case.particles > 0);
        let peaks = peaks.filter_map(|(i, case)| Some((i, case.peak?)));
        let best = peaks.min_by(|(_, a), (_, b)| a.rms.total_cmp(&b.rms));
        let Some((case, peak)) = best else { return Ok(()) };
        // After an interruption it may not be there.
        let key = Key { case, seed: 0, ratio: Exact(peak.ratio) };
        self.settle(&[key], beds, &mut Vec::new())?;
        let Some(Some(bed)) = beds.get(&(case, 0)) else { return Ok(()) };
        let known = of_case(points, case);
        tasks::film(&self.plans[case], &self.wanted, bed, self.reference * peak.ratio, &known, folder)
            .map_err(|e| self.fail(case, e))
    }

    fn results(&self, points: &Done) -> Vec<CaseResult> {
        let of_case = |index: usize| -> Vec<(f64, &Point)> {
            points.iter().filter(|(k, _)| k.case == index).map(|(k, p)| (k.ratio.0, p)).collect()
        };
        let cases = self.cases.iter().zip(&self.plans).enumerate();
        let mut results: Vec<CaseResult> = cases
            .map(|(index, (case, plan))| CaseResult::new(&case.name, plan, self.reference, &of_case(index)))
            .collect();
        for (index, case) in results.iter_mut().enumerate() {
            let own = points.iter().filter(|(key, _)| key.case == index);
            case.peak_interval = curve::peak_interval(own.map(|(key, point)| (key.seed, key.ratio.0, point.rms)));
        }
        if self.wanted.path == plan::Path::UpAndDown {
            for pair in results.chunks_exact_mut(2) {
                let found = Hysteresis::between(&pair[0].rows, &pair[1].rows);
                for case in pair {
                    case.hysteresis = found;
                }
            }
        }
        results
    }
}

fn of_case(points: &Done, case: usize) -> Vec<&Point> {
    points.iter().filter(|(key, _)| key.case == case).map(|(_, point)| point).collect()
}

impl From<OpenError> for CasesError {
    fn from(error: OpenError) -> Self {
        Self::Open(error)
    }
}
