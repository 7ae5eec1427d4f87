//! A calibration: which values of keys fit what was measured, and how well that tells them.
//!
//! Runs at places spread over all ranges, then where the values may be, teach a Gaussian process each measured result; with it, samples of
//! the posterior cost no runs. Before anything was measured all places are equally likely; the likelihood is normal, with the measured
//! uncertainty and that of the process (Kennedy and O'Hagan 2001, without their term for what a model cannot do). Fresh runs at samples
//! with other seeds check what was found. Every run has a folder of its own: a calibration that was stopped goes on where it was.

mod apart;
#[cfg(test)]
mod coverage;
mod curve;
mod posterior;
mod write;

pub use apart::runs;

use super::cases::{Case, CasesError};
use super::kept;
use super::ranges::Range;
use super::surrogate::Surrogate;
use crate::interrupt::Watcher;
use crate::scene_files;
use posterior::{hypercube, sample};
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;
use tsubu_frame::{Existing, FileError, ResultValue, RunFolder, Status, Summary};
use tsubu_scene::{Scene, nearest, plan};

/// What a calibration writes beside its scene.
const FILES: [&str; 10] = [
    "posterior.csv",
    "parameters.csv",
    "correlations.csv",
    "measured.csv",
    "curve.csv",
    "runs.csv",
    "best.toml",
    "check.txt",
    "summary.json",
    RUNS,
];
/// The folder of the runs' folders.
const RUNS: &str = "runs/";
/// Runs before anything is guessed, a key.
const FIRST_A_KEY: usize = 6;
/// Runs side by side; what is run must not depend on the number of threads.
const ROUND: usize = 4;
/// Every so manyth sample is looked at for the next run.
const THINNED: usize = 5;

/// Calibrates within `folder`. An existing folder of the same scene is gone on with; one of another scene is not touched.
pub fn calibrate(scene: &Scene, folder: &Path, overwrite: bool, watcher: &Watcher) -> Result<Summary, CasesError> {
    let begun = Instant::now();
    let task = Task::new(scene)?;
    // A scene that its method refuses leaves nothing behind.
    crate::methods::open(&crate::trial::unsettled(scene.plan()), &crate::partner::Hosts::new(&scene.plan().hosts))?;
    let existing = existing(scene, folder, overwrite)?;
    let before = Summary::read(&folder.join("summary.json")).ok().filter(|_| existing == Existing::Resume);
    let before = before.map_or(0.0, |summary| summary.wall_seconds);
    let folder = open(scene, folder, existing)?;
    let mut work = Work { task: &task, runs: folder.file(RUNS), watcher, ran: Vec::new(), apart: None };
    let found = work.calibrate()?;
    let _held = watcher.interrupt.hold();
    let status = if found.is_some() { Status::Finished } else { Status::Interrupted };
    let took = before + begun.elapsed().as_secs_f64();
    Ok(write::write(&folder, &work, found.as_ref(), status, took, Vec::new())?)
}

/// What is done with what is in the folder; that of another scene is refused.
fn existing(scene: &Scene, folder: &Path, overwrite: bool) -> Result<Existing, CasesError> {
    if overwrite {
        return Ok(Existing::Overwrite);
    }
    if !folder.join(RUNS).is_dir() {
        return Ok(Existing::Refuse);
    }
    kept::begun_by_another(scene, folder, |_| false)
        .map_or(Ok(Existing::Resume), |why| Err(CasesError::NotThisScene(why)))
}

/// The folder with the scene in it.
fn open(scene: &Scene, folder: &Path, existing: Existing) -> Result<RunFolder, FileError> {
    let names: Vec<String> = scene_files::names(scene).into_iter().chain(FILES.map(str::to_owned)).collect();
    let folder = RunFolder::create(folder, existing, &names)?;
    folder.claim(&names)?;
    scene_files::write(&folder, scene)?;
    Ok(folder)
}

/// What is to be calibrated.
struct Task<'a> {
    scene: &'a Scene,
    wanted: plan::Calibrate,
    ranges: Vec<Range>,
    /// What was measured, the points of a curve among it.
    measured: Vec<plan::Measured>,
}

impl<'a> Task<'a> {
    fn new(scene: &'a Scene) -> Result<Self, CasesError> {
        let wanted = scene.plan().calibrate.clone().ok_or_else(|| {
            CasesError::Scene(
                "the scene has no `[calibrate]`: say what is not known, for example `vary = { \"materials.sand.friction\" = [0.2, 0.8] }`, and what was measured"
                    .to_owned(),
            )
        })?;
        let ranges = Range::all("calibrate", &wanted.vary).map_err(CasesError::Scene)?;
        let mut measured = wanted.measured.clone();
        measured.extend(wanted.curve.iter().flat_map(curve::measured));
        Ok(Self { scene, wanted, ranges, measured })
    }

    /// What a run is made of: a place, and a seed of its own.
    fn case(&self, place: &Case, run: usize) -> Result<Case, CasesError> {
        let seed = self.seed().wrapping_add(run as u64) & i64::MAX as u64;
        let mut case = place.clone();
        case.values.push(("seed".to_owned(), (seed as i64).into()));
        if let Some(curve) = &self.wanted.curve {
            curve::at_its_frequencies(&mut case, self.scene, curve)?;
        }
        Ok(case)
    }

    /// Makes a run in its folder.
    fn make(&self, case: &Case, folder: &Path, watcher: &Watcher) -> Result<Summary, CasesError> {
        match &self.wanted.curve {
            Some(_) => curve::one(self.scene, case, folder, watcher),
            None => kept::one(self.scene, case, folder, watcher),
        }
    }

    fn seed(&self) -> u64 {
        self.scene.plan().seed
    }

    /// How far the measured results are from guesses, as the logarithm of a likelihood.
    fn likelihood(&self, fits: &[Surrogate], place: &[f64]) -> f64 {
        let of_one = |(fit, measured): (&Surrogate, &plan::Measured)| {
            let [guess, deviation] = fit.at(place);
            let variance = measured.uncertainty.powi(2) + deviation.powi(2);
            -0.5 * ((measured.value - guess).powi(2) / variance + variance.ln())
        };
        fits.iter().zip(&self.measured).map(of_one).sum()
    }
}

/// What a run was for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Purpose {
    /// To learn what the results are.
    Learn,
    /// To check what was found.
    Check,
}

/// A run that was made.
struct Ran {
    case: Case,
    place: Vec<f64>,
    purpose: Purpose,
    /// The measured results, not-a-number where there is none.
    results: Vec<f64>,
    summary: Summary,
}

/// What came of a calibration.
struct Found {
    fits: Vec<Surrogate>,
    /// Samples of the posterior.
    samples: Vec<Vec<f64>>,
    /// The most likely of them.
    best: usize,
    /// How near each result is known, over the measured uncertainty.
    doubts: Vec<f64>,
}

/// A calibration on its way.
struct Work<'a> {
    task: &'a Task<'a>,
    /// The folder of the runs' folders.
    runs: PathBuf,
    watcher: &'a Watcher<'a>,
    ran: Vec<Ran>,
    /// Where runs are done apart, which.
    apart: Option<Share>,
}

/// What a process does of a round whose runs are done apart.
#[derive(Default)]
struct Share {
    /// The run that is done here, if any.
    only: Option<usize>,
    /// All that the round asks for and has no result.
    asked: Vec<usize>,
}

/// The folder of a run, and its name where it is done apart.
fn numbered(run: usize) -> String {
    format!("{run:04}")
}

impl Work<'_> {
    /// Learns, samples, checks; nothing where it was interrupted.
    fn calibrate(&mut self) -> Result<Option<Found>, CasesError> {
        let (task, wanted) = (self.task, &self.task.wanted);
        let most = wanted.runs as usize;
        let dimension = task.ranges.len();
        let mut places = hypercube(dimension, (FIRST_A_KEY * dimension).clamp(ROUND, most), task.seed());
        loop {
            if !self.run(&places, Purpose::Learn)? {
                return Ok(None);
            }
            let fits = self.fit()?;
            let samples = sample(dimension, task.seed(), |place| task.likelihood(&fits, place));
            let doubts = task.doubts(&fits, &samples);
            let left = most - self.ran.len();
            if left > 0 && doubts.iter().any(|doubt| *doubt > wanted.within) {
                places = task.next(fits, &samples, left.min(ROUND));
                continue;
            }
            let checks = wanted.checks as usize;
            let checked: Vec<Vec<f64>> =
                (0..checks).map(|i| samples[(2 * i + 1) * samples.len() / (2 * checks)].clone()).collect();
            if !self.run(&checked, Purpose::Check)? {
                return Ok(None);
            }
            let likely = samples.iter().map(|place| task.likelihood(&fits, place)).enumerate();
            let best = likely.reduce(|best, one| if one.1 > best.1 { one } else { best }).map_or(0, |best| best.0);
            return Ok(Some(Found { fits, samples, best, doubts }));
        }
    }

    /// Runs all of these side by side, each with a seed of its own; says whether it came to the end.
    fn run(&mut self, places: &[Vec<f64>], purpose: Purpose) -> Result<bool, CasesError> {
        let (task, watcher, before) = (self.task, self.watcher, self.ran.len());
        let all = f64::from(task.wanted.runs + task.wanted.checks);
        let counter = AtomicUsize::new(before);
        let only = self.apart.as_ref().map(|share| share.only);
        let asked = Mutex::new(Vec::new());
        let one = |(index, place): (usize, &Vec<f64>)| -> Result<Option<Ran>, CasesError> {
            if watcher.interrupt.asked() {
                return Ok(None);
            }
            let (case, place) = Range::case(&task.ranges, place);
            let seeded = task.case(&case, before + index)?;
            let at = self.runs.join(numbered(before + index));
            let kept = || kept::of_case(task.scene, &seeded, &at);
            let mut summary = match only.map(|only| Ok::<_, CasesError>((only, kept()?))).transpose()? {
                Some((_, Some(summary))) if summary.status != Status::Interrupted => summary,
                Some((only, _)) => {
                    asked.lock().unwrap_or_else(PoisonError::into_inner).push(before + index);
                    if only == Some(before + index) {
                        task.make(&seeded, &at, watcher)?;
                    }
                    return Ok(None);
                }
                None => task.make(&seeded, &at, watcher)?,
            };
            if let (Some(curve), Status::Finished) = (&task.wanted.curve, summary.status) {
                curve::tell(curve, &at, &mut summary)?;
            }
            let result = |measured: &plan::Measured| match summary.results.get(&measured.result) {
                Some(ResultValue::Number(value)) if summary.status == Status::Finished => *value,
                _ => f64::NAN,
            };
            let results = task.measured.iter().map(result).collect();
            (watcher.progress)((counter.fetch_add(1, Ordering::Relaxed) + 1) as f64 / all);
            Ok(Some(Ran { case, place, purpose, results, summary }))
        };
        let ran: Vec<Option<Ran>> = places.par_iter().enumerate().map(one).collect::<Result<_, _>>()?;
        self.ran.extend(ran.into_iter().flatten());
        let mut asked = asked.into_inner().unwrap_or_else(PoisonError::into_inner);
        asked.sort_unstable();
        // The round ends here where it waits for others.
        let waits = !asked.is_empty();
        if let Some(share) = &mut self.apart {
            share.asked = asked;
        }
        Ok(!waits && !watcher.interrupt.asked())
    }

    /// A Gaussian process for each measured result.
    fn fit(&self) -> Result<Vec<Surrogate>, CasesError> {
        let of_one = |(index, measured): (usize, &plan::Measured)| {
            let known = self.ran.iter().filter(|ran| ran.results[index].is_finite());
            let (places, values): (Vec<_>, Vec<_>) = known.map(|ran| (ran.place.clone(), ran.results[index])).unzip();
            Surrogate::fit(&places, &values)
                .ok_or_else(|| CasesError::Scene(self.missing(&measured.result, values.len())))
        };
        self.task.measured.iter().enumerate().map(of_one).collect()
    }

    /// Why a result cannot be fitted.
    fn missing(&self, result: &str, number: usize) -> String {
        let runs = self.ran.len();
        let Some(whole) = self.ran.iter().find(|ran| ran.summary.status == Status::Finished) else {
            let why = self.ran.iter().find_map(|ran| ran.summary.warnings.last()).cloned().unwrap_or_default();
            return format!("none of the first {runs} runs came to its end: {why}");
        };
        let numbers =
            whole.summary.results_in_order().into_iter().filter(|(_, value)| matches!(value, ResultValue::Number(_)));
        let names: Vec<&str> = numbers.map(|(name, _)| name).collect();
        let told = match nearest(result, names.iter().copied()) {
            Some(near) if near == result => "in the others it is no number".to_owned(),
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("results of a run are `{}`", names.join("`, `")),
        };
        format!("{number} of the first {runs} runs have a result `{result}`; {told}")
    }
}

impl Task<'_> {
    /// How near each result is known among samples, over the measured uncertainty.
    fn doubts(&self, fits: &[Surrogate], samples: &[Vec<f64>]) -> Vec<f64> {
        let of_one = |(fit, measured): (&Surrogate, &plan::Measured)| {
            let squares: Vec<f64> = samples.par_iter().map(|place| fit.at(place)[1].powi(2)).collect();
            (squares.iter().sum::<f64>() / samples.len() as f64).sqrt() / measured.uncertainty
        };
        fits.iter().zip(&self.measured).map(of_one).collect()
    }

    /// The samples at which the results are known worst, each as if those before it had come out as guessed.
    fn next(&self, mut fits: Vec<Surrogate>, samples: &[Vec<f64>], number: usize) -> Vec<Vec<f64>> {
        let mut chosen = Vec::new();
        for _ in 0..number {
            let doubt = |place: &&Vec<f64>| -> f64 {
                let of_one =
                    |(fit, measured): (&Surrogate, &plan::Measured)| (fit.at(place)[1] / measured.uncertainty).powi(2);
                fits.iter().zip(&self.measured).map(of_one).sum()
            };
            let all: Vec<(&Vec<f64>, f64)> =
                samples.iter().step_by(THINNED).map(|place| (place, doubt(&place))).collect();
            let worst = all.into_iter().reduce(|worst, one| if one.1 > worst.1 { one } else { worst });
            let Some((place, _)) = worst else { break };
            chosen.push(place.clone());
            fits = fits.into_iter().map(|fit| fit.believing(place)).collect();
        }
        chosen
    }
}
