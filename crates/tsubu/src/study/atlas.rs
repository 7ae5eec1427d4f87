//! An atlas of cavities: each alone on a shaker, at many frequencies and accelerations.
//!
//! What grains do to a structure near a resonance follows from the complex mass that they show it there ([`Point`]). Each case is
//! a cavity; its grid of points is refined where that mass bends. An atlas that was stopped goes on where it was.

mod apart;
mod cavity;
mod chart;
mod refine;
mod shown;
mod write;

pub use apart::runs;
pub use cavity::Point;
pub use chart::{AtlasError, Cavity, Chart, read};
pub use shown::Shown;

use super::cases::{Case, CasesError, case_plans, cases};
use super::journal::{Exact, Journal, Place};
use super::journaled;
use super::response::tasks;
use crate::interrupt::{Interrupt, Watcher};
use crate::run::RunError;
use nalgebra::Complex;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;
use tsubu_frame::{State, Status, Summary};
use tsubu_scene::{Plan, Scene, plan};

/// What an atlas writes beside what every study writes.
const FILES: [&str; 1] = [chart::FILE];

/// One run of an atlas.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
struct Key {
    case: usize,
    /// Frequency [Hz].
    frequency: Exact,
    /// Amplitude of the acceleration [m/s^2].
    acceleration: Exact,
    seed: u32,
}

/// All that is measured.
type Done = BTreeMap<Key, Point>;

/// What came of a run; nothing where it was interrupted.
type Ran = Option<Result<(Key, Point), Failed>>;

/// A run that broke off.
type Failed = (Key, RunError);

/// Computes the atlas of a scene into `folder`. An existing folder of the same scene is gone on with.
pub fn atlas(scene: &Scene, folder: &Path, overwrite: bool, watcher: &Watcher) -> Result<Summary, CasesError> {
    let begun = Instant::now();
    let task = Task::new(scene)?;
    let place = Place { study: "atlas", scene, folder };
    let earlier: Option<Done> = place.earlier(overwrite)?;
    let before = earlier.as_ref().and_then(|_| Summary::read(&folder.join("summary.json")).ok());
    let before = before.map_or(0.0, |summary| summary.wall_seconds);
    // Only then, so that a scene that a method refuses leaves nothing behind.
    let beds = task.beds()?;
    let folder = place.open(earlier.is_some(), overwrite, &FILES)?;
    let journal = Journal::append(&folder)?;
    let record = |key: &Key, point: &Point| journal.record(key, point);
    let (points, failures) = task.run(&beds, &earlier.unwrap_or_default(), &record, watcher)?;
    let status = match points.len() {
        _ if watcher.interrupt.asked() => Status::Interrupted,
        0 if !failures.is_empty() => return Err(task.first(failures)),
        _ if failures.is_empty() => Status::Finished,
        _ => Status::Failed,
    };
    let _held = watcher.interrupt.hold();
    let told = failures.iter().map(|failed| task.told(failed)).collect();
    Ok(write::write(&folder, &task, &points, status, told, before + begun.elapsed().as_secs_f64())?)
}

/// The cavities of a scene's atlas, without any file.
pub fn cavities(scene: &Scene) -> Result<Vec<Cavity>, CasesError> {
    let task = Task::new(scene)?;
    let watcher = Watcher { interrupt: &Interrupt::new(), progress: &|_| {} };
    let (points, failures) = task.run(&task.beds()?, &Done::new(), &|_, _| Ok(()), &watcher)?;
    if !failures.is_empty() {
        return Err(task.first(failures));
    }
    let plans = case_plans(scene, &task.cases)?;
    let of_case = |case: usize| points.iter().filter(move |(key, _)| key.case == case);
    let shown = |point: &Point| {
        let error = point.error.unwrap_or(0.0);
        Shown { mass: point.complex(), error, harmonics: point.harmonics }
    };
    let rows = |case| of_case(case).map(|(key, point)| (key.seed, [key.frequency.0, key.acceleration.0], shown(point)));
    let all = chart::names(&task.cases).into_iter().zip(plans).enumerate();
    Ok(all.map(|(case, (name, plan))| Cavity::new(name, plan, &task.wanted, rows(case))).collect())
}

/// Hears of every finished run.
type Record<'a> = journaled::Record<'a, Key, Point>;

/// What an atlas has to compute.
struct Task {
    wanted: plan::Atlas,
    cases: Vec<Case>,
    /// Each with its host as a shaker.
    plans: Vec<Plan>,
}

impl Task {
    fn new(scene: &Scene) -> Result<Self, CasesError> {
        let wanted = scene.plan().atlas.clone().ok_or_else(|| {
            CasesError::Scene(
                "the scene has no `[atlas]`: say how the cavity is shaken, for example `frequency = [\"4 Hz\", \"8 Hz\"]` and `acceleration = [\"0.1 g\", \"3 g\"]`".to_owned(),
            )
        })?;
        if scene.plans().len() > 1 {
            return Err(CasesError::Scene("an atlas is of a scene of one stage: leave `[[stage]]` out".to_owned()));
        }
        let cases = cases(&wanted.vary);
        let plans = case_plans(scene, &cases)?;
        if plans.iter().all(|plan| plan.grain_mass() == 0.0) {
            return Err(CasesError::Scene(
                "no case of this atlas has grains: an empty cavity shows no mass".to_owned(),
            ));
        }
        let plans = plans.iter().map(|plan| cavity::shaken(plan, &wanted)).collect();
        Ok(Self { wanted, cases, plans })
    }

    fn fail(&self, case: usize, error: RunError) -> CasesError {
        CasesError::Run { case: self.cases[case].name.clone(), error }
    }

    fn first(&self, failures: Vec<Failed>) -> CasesError {
        match failures.into_iter().next() {
            Some((key, error)) => self.fail(key.case, error),
            None => CasesError::Scene("there is nothing to run".to_owned()),
        }
    }

    /// A failure in a sentence.
    fn told(&self, (key, error): &Failed) -> String {
        let name = &self.cases[key.case].name;
        let case = if name.is_empty() { String::new() } else { format!("case `{name}`, ") };
        format!(
            "{case}{} Hz, {} m/s^2, seed {}: the run failed and is not in the atlas: {error}",
            key.frequency.0, key.acceleration.0, key.seed
        )
    }

    /// The settled beds of all cases with grains and of all seeds.
    fn beds(&self) -> Result<BTreeMap<(usize, u32), State<'static>>, CasesError> {
        let full = (0..self.plans.len()).filter(|case| self.plans[*case].grain_mass() > 0.0);
        let all: Vec<(usize, u32)> = full.flat_map(|case| (0..self.wanted.seeds).map(move |s| (case, s))).collect();
        let settle = |(case, seed): (usize, u32)| {
            let bed = tasks::bed(&self.plans[case], seed).map_err(|error| self.fail(case, error.into()))?;
            Ok(((case, seed), bed))
        };
        all.into_par_iter().map(settle).collect()
    }

    /// Measures round by round, but for what is known already, until nothing is wanted or somebody asks to stop.
    fn run(
        &self,
        beds: &BTreeMap<(usize, u32), State>,
        known: &Done,
        record: Record<'_>,
        watcher: &Watcher,
    ) -> Result<(Done, Vec<Failed>), CasesError> {
        let (mut points, mut failures) = (Done::new(), Vec::new());
        loop {
            let tried: Vec<Key> = failures.iter().map(|(key, _)| *key).collect();
            let wanted = self.next(&points, &tried);
            if wanted.is_empty() {
                return Ok((points, failures));
            }
            let (old, new): (Vec<Key>, Vec<Key>) = wanted.into_iter().partition(|key| known.contains_key(key));
            points.extend(old.into_iter().map(|key| (key, known[&key].clone())));
            let (done, failed) = self.measure(&new, beds, record, points.len(), watcher)?;
            points.extend(done);
            failures.extend(failed);
            if watcher.interrupt.asked() {
                return Ok((points, failures));
            }
        }
    }

    /// What is measured next: it follows from what is known, never from how far an interrupted round had come.
    fn next(&self, points: &Done, failed: &[Key]) -> Vec<Key> {
        let mut wanted = Vec::new();
        for case in (0..self.plans.len()).filter(|case| self.plans[*case].grain_mass() > 0.0) {
            let found = self.found(points, case);
            // Where every seed has failed nothing is known, and nothing is asked again.
            let of_case = failed.iter().filter(|key| key.case == case);
            let tried: Vec<refine::Place> = of_case.map(|key| (key.frequency, key.acceleration)).collect();
            let places = if found.is_empty() && tried.is_empty() {
                refine::first(self.wanted.frequency, self.wanted.acceleration)
            } else {
                let left = (self.wanted.at_most as usize).saturating_sub(found.len() + tried.len());
                let mut next = refine::next(&found, self.wanted.within, left);
                next.retain(|place| !tried.contains(place));
                next
            };
            let of_place = |(frequency, acceleration): refine::Place| {
                (0..self.wanted.seeds).map(move |seed| Key { case, frequency, acceleration, seed })
            };
            wanted.extend(places.into_iter().flat_map(of_place));
        }
        wanted.sort_by_key(|key| std::cmp::Reverse(self.plans[key.case].grains()));
        wanted
    }

    /// What is known of a case, in the mean over the seeds, over the mass of its grains.
    fn found(&self, points: &Done, case: usize) -> refine::Found {
        let mut seeds: BTreeMap<refine::Place, Vec<&Point>> = BTreeMap::new();
        for (key, point) in points.iter().filter(|(key, _)| key.case == case) {
            seeds.entry((key.frequency, key.acceleration)).or_default().push(point);
        }
        let mass = self.plans[case].grain_mass();
        let mean = |of: Vec<&Point>| {
            let n = of.len() as f64;
            let mean = of.iter().map(|point| point.complex()).sum::<Complex<f64>>() / n;
            let squares: f64 = of.iter().map(|point| point.error.unwrap_or(0.0).powi(2)).sum();
            Shown { mass: mean / mass, error: squares.sqrt() / (n * mass), harmonics: 0.0 }
        };
        seeds.into_iter().map(|(place, of)| (place, mean(of))).collect()
    }

    /// Runs all of these, side by side; each is written down when it is done.
    fn measure(
        &self,
        keys: &[Key],
        beds: &BTreeMap<(usize, u32), State>,
        record: Record<'_>,
        before: usize,
        watcher: &Watcher,
    ) -> Result<(Done, Vec<Failed>), CasesError> {
        let counter = AtomicUsize::new(before);
        let total = self.expected().max(before + keys.len()) as f64;
        let run = |key: &Key| -> Result<Ran, CasesError> {
            let Some(bed) = beds.get(&(key.case, key.seed)).filter(|_| !watcher.interrupt.asked()) else {
                return Ok(None);
            };
            let place = [key.frequency.0, key.acceleration.0];
            match cavity::measure(&self.plans[key.case], &self.wanted, key.seed, bed, place, watcher.interrupt) {
                Ok(None) => Ok(None),
                Ok(Some(point)) => {
                    record(key, &point)?;
                    (watcher.progress)((counter.fetch_add(1, Ordering::Relaxed) + 1) as f64 / total);
                    Ok(Some(Ok((*key, point))))
                }
                Err(error @ RunError::Fault(_)) => Ok(Some(Err((*key, error)))),
                Err(error) => Err(self.fail(key.case, error)),
            }
        };
        let ran: Result<Vec<_>, CasesError> = keys.par_iter().map(run).collect();
        let (mut done, mut failed) = (Done::new(), Vec::new());
        for one in ran?.into_iter().flatten() {
            match one {
                Ok((key, point)) => drop(done.insert(key, point)),
                Err(failure) => failed.push(failure),
            }
        }
        Ok((done, failed))
    }

    /// About how many runs there will be.
    fn expected(&self) -> usize {
        let full = self.plans.iter().filter(|plan| plan.grain_mass() > 0.0).count();
        full * (self.wanted.points() * self.wanted.seeds) as usize
    }
}
