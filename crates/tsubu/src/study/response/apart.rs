//! A response whose runs are done apart, each by a process of its own.
//!
//! A run is a frequency of a case and a seed, or all of them where a case is walked through. Its bed is settled again: the same bits. What
//! the next round asks for follows from the points of those before, so whoever reads the folder knows the same round.

use super::rounds::Rounds;
use super::{Beds, Done, FILES, Key, Point, Task, Way, write};
use crate::interrupt::Watcher;
use crate::methods;
use crate::partner::Hosts;
use crate::study::apart::{Apart, Gathered, unlocked};
use crate::study::cases::CasesError;
use crate::study::journal::{self, Journal};
use crate::trial;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use tsubu_frame::{Status, Summary};
use tsubu_scene::{Plan, Scene};

/// The runs of a scene's `[response]`, and the folder that they are in.
pub struct Runs<'a> {
    scene: &'a Scene,
    task: Task,
    folder: PathBuf,
    /// Those of runs that this process has done.
    beds: Beds,
    /// What those of them have said that did not settle, by case and seed.
    unsettled: BTreeMap<(usize, u32), String>,
}

impl<'a> Runs<'a> {
    /// Lists them; nothing is written yet.
    pub fn new(scene: &'a Scene, folder: &Path) -> Result<Self, CasesError> {
        let (task, folder, beds) = (Task::new(scene)?, folder.to_owned(), Beds::new());
        Ok(Self { scene, task, folder, beds, unsettled: BTreeMap::new() })
    }

    /// What is done, and what failed.
    fn known(&self) -> Result<(Done, BTreeMap<Key, String>), CasesError> {
        let done: Option<Done> = journal::earlier(&self.folder, self.scene, false)?;
        let done = done.unwrap_or_default();
        let mut lost = journal::lost(&self.folder, self.scene);
        lost.retain(|key, _| !done.contains_key(key));
        Ok((done, lost))
    }

    /// The name of the run that this key belongs to.
    fn name(&self, key: Key) -> String {
        let (case, seed) = (self.task.cases[key.case].folder(), key.seed);
        match self.task.ways[key.case] {
            Way::Apart => format!("{case},seed={seed},ratio={}", key.ratio.0),
            Way::Up | Way::Down => format!("{case},seed={seed}"),
        }
    }

    /// Does one, and writes it down.
    fn one(&mut self, name: &str, watcher: &Watcher) -> Result<Status, CasesError> {
        // What another process has done while this one waited for the journal is read after it.
        let journal = Journal::apart(&self.folder, name, self.scene)?;
        let (done, lost) = self.known()?;
        let mut rounds = Rounds::without(&self.task, Some(&done), lost.into_keys().collect());
        if !rounds.asked.iter().any(|key| self.name(*key) == name) {
            return Err(CasesError::Scene(format!(
                "the response has no run `{name}`: `tsubu response SCENE --dry-run` names those that are missing"
            )));
        }
        let missing = std::mem::take(&mut rounds.missing);
        rounds.missing = missing.into_iter().filter(|key| self.name(*key) == name).collect();
        let mut left = rounds.missing.clone();
        let mut failures = Vec::new();
        self.task.settle(&rounds.missing, &mut self.beds, &mut failures)?;
        let record = |key: &Key, point: &Point| Ok(journal.record(key, point)?);
        let (points, failed) = self.task.measure_round(&rounds, &self.beds, &record, watcher)?;
        failures.extend(failed);
        left.retain(|key| !points.contains_key(key));
        for failure in &failures {
            let Key { case, seed, .. } = failure.key;
            if !matches!(self.beds.get(&(case, seed)), Some(Some(_))) {
                self.unsettled.insert((case, seed), self.task.told(failure));
            }
        }
        let Some(Key { case, seed, .. }) = left.first() else { return Ok(Status::Finished) };
        let told = failures.first().map(|failure| self.task.told(failure));
        let Some(told) = told.or_else(|| self.unsettled.get(&(*case, *seed)).cloned()) else {
            return Ok(Status::Interrupted);
        };
        left.iter().try_for_each(|key| journal.lose(key, &told))?;
        Ok(Status::Failed)
    }
}

impl Apart for Runs<'_> {
    fn begin(&mut self, overwrite: bool) -> Result<(), CasesError> {
        let earlier: Option<Done> = journal::earlier(&self.folder, self.scene, overwrite)?;
        for (index, plan) in self.task.plans.iter().enumerate() {
            // A case that its method refuses must say so before the others have run, and leave nothing behind.
            let open = methods::open(&trial::unsettled(plan), &Hosts::new(&plan.hosts));
            open.map_err(|error| self.task.fail(index, error.into()))?;
        }
        let folder = journal::open_folder(&self.folder, earlier.is_some(), self.scene, overwrite, &FILES)?;
        journal::collect::<Key, Point>(&folder, self.scene)?;
        Ok(folder.sync()?)
    }

    fn missing(&mut self) -> Result<Vec<String>, CasesError> {
        let (done, lost) = self.known()?;
        let rounds = Rounds::without(&self.task, Some(&done), lost.into_keys().collect());
        Ok(self.task.walks(&rounds).iter().map(|keys| self.name(keys[0])).collect())
    }

    fn run(&mut self, name: &str, watcher: &Watcher) -> Result<Status, CasesError> {
        unlocked(watcher.interrupt, CasesError::is_locked, || self.one(name, watcher))
    }

    fn plans(&self) -> Result<Vec<(Plan, f64)>, CasesError> {
        let ratios = &self.task.wanted.frequency_ratio;
        let each = ratios.iter().map(|ratio| self.task.wanted.periods() / (self.task.reference * ratio));
        let (longest, all) = (each.clone().fold(0.0, f64::max), each.sum());
        let ways = self.task.plans.iter().zip(&self.task.ways);
        Ok(ways.map(|(plan, way)| (plan.clone(), if *way == Way::Apart { longest } else { all })).collect())
    }
}

impl Gathered for Runs<'_> {
    fn gather(&mut self, why: &dyn Fn(&str) -> String) -> Result<Summary, CasesError> {
        let (done, lost) = self.known()?;
        let mut rounds = Rounds::without(&self.task, Some(&done), lost.keys().copied().collect());
        let told = |keys: &Vec<Key>| {
            let name = self.name(keys[0]);
            format!("{name} is missing: {}", why(&name))
        };
        let missing: Vec<String> = self.task.walks(&rounds).iter().map(told).collect();
        rounds.end(Done::new());
        let points = rounds.points;
        let whole = points.len() == rounds.asked.len();
        // A bed that did not settle says the same of each of its runs.
        let lost: BTreeSet<String> = lost.into_values().collect();
        let failures = lost.into_iter().chain(missing).collect();
        let folder = journal::open_folder(&self.folder, true, self.scene, false, &FILES)?;
        let results = self.task.results(&points);
        if whole {
            self.task.film(&results, &points, &mut self.beds, &folder)?;
        }
        let status = if whole { Status::Finished } else { Status::Failed };
        let took = points.values().map(|point| point.wall).sum();
        Ok(write::write(&folder, self.scene, &self.task.plans, &results, status, failures, took)?)
    }
}
