//! An atlas whose runs are done apart: each is a frequency and an acceleration of a cavity and a seed. Its bed is settled again: the same bits.

use super::{Done, FILES, Key, Point, Task, cavity, write};
use crate::engine::OpenError;
use crate::interrupt::Watcher;
use crate::run::RunError;
use crate::study::apart::StudyRuns;
use crate::study::cases::{self, CasesError};
use crate::study::journaled::{self, Journaled, Record, Runs};
use crate::study::response::tasks;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::path::Path;
use tsubu_frame::{RunFolder, State, Status, Summary};
use tsubu_scene::{Plan, Scene};

/// The runs of a scene's `[atlas]` into a folder; nothing is written yet.
pub fn runs<'a>(scene: &'a Scene, folder: &Path) -> Result<StudyRuns<'a>, CasesError> {
    Ok(Box::new(Runs::new(scene, folder, Atlas { task: Task::new(scene)?, beds: BTreeMap::new() })))
}

struct Atlas {
    task: Task,
    /// Those of runs that this process has done, by case and seed.
    beds: BTreeMap<(usize, u32), State<'static>>,
}

type Known = journaled::Known<Key, Point>;

impl Atlas {
    /// What is known of all rounds that are over, and what the next asks for.
    fn rounds(&self, known: &Known) -> (Done, Vec<Key>) {
        let (mut points, mut tried) = (Done::new(), Vec::new());
        loop {
            let wanted = self.task.next(&points, &tried);
            let is_known = |key: &&Key| known.done.contains_key(key) || known.lost.contains_key(key);
            let missing: Vec<Key> = wanted.iter().filter(|key| !is_known(key)).copied().collect();
            let over = missing.is_empty() && !wanted.is_empty();
            for key in wanted {
                match known.done.get(&key) {
                    Some(point) => drop(points.insert(key, point.clone())),
                    None => tried.push(key),
                }
            }
            if !over {
                return (points, missing);
            }
        }
    }
}

impl Journaled for Atlas {
    type Key = Key;
    type Point = Point;

    const NAME: &'static str = "atlas";
    const FILES: &'static [&'static str] = &FILES;

    fn open(&self) -> Result<(), CasesError> {
        cases::open(self.task.cases.iter().zip(&self.task.plans))
    }

    fn asked(&self, known: &Known) -> Result<Vec<Key>, CasesError> {
        Ok(self.rounds(known).1)
    }

    fn name(&self, key: &Key) -> String {
        let Key { case, frequency, acceleration, seed } = key;
        let case = self.task.cases[*case].folder();
        format!("{case},seed={seed},frequency={},acceleration={}", frequency.0, acceleration.0)
    }

    fn make(
        &mut self,
        keys: &[Key],
        _: &Known,
        record: Record<'_, Key, Point>,
        watcher: &Watcher,
    ) -> Result<Option<String>, CasesError> {
        let [key] = keys else { return Ok(None) };
        let plan = &self.task.plans[key.case];
        let bed = match self.beds.entry((key.case, key.seed)) {
            Entry::Occupied(bed) => bed.into_mut(),
            Entry::Vacant(place) => match tasks::bed(plan, key.seed) {
                Ok(bed) => place.insert(bed),
                Err(error @ OpenError::Settling(_)) => return Ok(Some(self.task.told(&(*key, error.into())))),
                Err(error) => return Err(self.task.fail(key.case, error.into())),
            },
        };
        let place = [key.frequency.0, key.acceleration.0];
        match cavity::measure(plan, &self.task.wanted, key.seed, bed, place, watcher.interrupt) {
            Ok(Some(point)) => Ok(record(key, &point).map(|()| None)?),
            Ok(None) => Ok(None),
            Err(error @ RunError::Fault(_)) => Ok(Some(self.task.told(&(*key, error)))),
            Err(error) => Err(self.task.fail(key.case, error)),
        }
    }

    fn plans(&self) -> Vec<(Plan, f64)> {
        let seconds = self.task.wanted.periods() / self.task.wanted.frequency[0];
        self.task.plans.iter().map(|plan| (plan.clone(), seconds)).collect()
    }

    fn write(
        &mut self,
        known: Known,
        missing: Vec<(Key, String)>,
        folder: &RunFolder,
        _: &Scene,
    ) -> Result<Summary, CasesError> {
        let (points, _) = self.rounds(&known);
        let whole = missing.is_empty() && known.lost.is_empty();
        let status = if whole { Status::Finished } else { Status::Failed };
        let failures = known.lost.into_values().chain(missing.into_iter().map(|(_, why)| why)).collect();
        let took = points.values().map(|point| point.wall).sum();
        Ok(write::write(folder, &self.task, &points, status, failures, took)?)
    }
}
