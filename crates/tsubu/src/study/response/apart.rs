//! A response whose runs are done apart.
//!
//! A run is a frequency of a case and a seed, or all of them where a case is walked through. Its bed is settled again: the same bits.

use super::rounds::Rounds;
use super::{Beds, Done, FILES, Key, Point, Task, Way, write};
use crate::interrupt::Watcher;
use crate::study::apart::StudyRuns;
use crate::study::cases::{self, CasesError};
use crate::study::journaled::{self, Journaled, Record, Runs};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use tsubu_frame::{RunFolder, Status, Summary};
use tsubu_scene::{Plan, Scene};

/// The runs of a scene's `[response]` into a folder; nothing is written yet.
pub fn runs<'a>(scene: &'a Scene, folder: &Path) -> Result<StudyRuns<'a>, CasesError> {
    let response = Response { task: Task::new(scene)?, beds: Beds::new(), unsettled: BTreeMap::new() };
    Ok(Box::new(Runs::new(scene, folder, response)))
}

struct Response {
    task: Task,
    /// Those of runs that this process has done.
    beds: Beds,
    /// What those of them have said that did not settle, by case and seed.
    unsettled: BTreeMap<(usize, u32), String>,
}

type Known = journaled::Known<Key, Point>;

impl Response {
    fn rounds<'a>(&self, known: &'a Known) -> Rounds<'a> {
        Rounds::without(&self.task, Some(&known.done), known.given_up())
    }
}

impl Journaled for Response {
    type Key = Key;
    type Point = Point;

    const NAME: &'static str = "response";
    const FILES: &'static [&'static str] = &FILES;

    fn open(&self) -> Result<(), CasesError> {
        cases::open(self.task.cases.iter().zip(&self.task.plans))
    }

    fn asked(&self, known: &Known) -> Result<Vec<Key>, CasesError> {
        Ok(self.rounds(known).missing)
    }

    fn name(&self, key: &Key) -> String {
        let (case, seed) = (self.task.cases[key.case].folder(), key.seed);
        match self.task.ways[key.case] {
            Way::Apart => format!("{case},seed={seed},ratio={}", key.ratio.0),
            Way::Up | Way::Down => format!("{case},seed={seed}"),
        }
    }

    fn make(
        &mut self,
        keys: &[Key],
        known: &Known,
        record: Record<'_, Key, Point>,
        watcher: &Watcher,
    ) -> Result<Option<String>, CasesError> {
        let mut rounds = self.rounds(known);
        rounds.missing = keys.to_vec();
        let mut failures = Vec::new();
        self.task.settle(keys, &mut self.beds, &mut failures)?;
        let (_, failed) = self.task.measure_round(&rounds, &self.beds, record, watcher)?;
        failures.extend(failed);
        for failure in &failures {
            let Key { case, seed, .. } = failure.key;
            if !matches!(self.beds.get(&(case, seed)), Some(Some(_))) {
                self.unsettled.insert((case, seed), self.task.told(failure));
            }
        }
        let told = failures.first().map(|failure| self.task.told(failure));
        let bed = keys.first().map(|key| (key.case, key.seed)).unwrap_or_default();
        Ok(told.or_else(|| self.unsettled.get(&bed).cloned()))
    }

    fn plans(&self) -> Vec<(Plan, f64)> {
        let ratios = &self.task.wanted.frequency_ratio;
        let each = ratios.iter().map(|ratio| self.task.wanted.periods() / (self.task.reference * ratio));
        let (longest, all) = (each.clone().fold(0.0, f64::max), each.sum());
        let ways = self.task.plans.iter().zip(&self.task.ways);
        ways.map(|(plan, way)| (plan.clone(), if *way == Way::Apart { longest } else { all })).collect()
    }

    fn write(
        &mut self,
        known: Known,
        missing: Vec<(Key, String)>,
        folder: &RunFolder,
        scene: &Scene,
    ) -> Result<Summary, CasesError> {
        let mut rounds = self.rounds(&known);
        rounds.end(Done::new());
        let points = rounds.points;
        let whole = points.len() == rounds.asked.len();
        let results = self.task.results(&points);
        if whole {
            self.task.film(&results, &points, &mut self.beds, folder)?;
        }
        let status = if whole { Status::Finished } else { Status::Failed };
        // A bed that did not settle says the same of each of its runs.
        let lost: BTreeSet<String> = known.lost.into_values().collect();
        let failures = lost.into_iter().chain(missing.into_iter().map(|(_, why)| why)).collect();
        let took = points.values().map(|point| point.wall).sum();
        Ok(write::write(folder, scene, &self.task.plans, &results, status, failures, took)?)
    }
}
