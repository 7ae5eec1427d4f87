//! A design whose runs are done apart, round by round.
//!
//! What a round asks for follows from what was measured before: the search goes its way again over what is known, and comes to the same round.

use super::work::{Share, Work};
use super::{FILES, Key, Measured, Task, write};
use crate::interrupt::{Interrupt, Watcher};
use crate::methods;
use crate::partner::Hosts;
use crate::run::RunError;
use crate::study::apart::StudyRuns;
use crate::study::cases::CasesError;
use crate::study::journaled::{self, Journaled, Record, Runs};
use crate::trial::unsettled;
use std::path::Path;
use tsubu_frame::{RunFolder, Status, Summary};
use tsubu_scene::{Plan, Scene};

/// The runs of a scene's `[design]` into a folder; nothing is written yet.
pub fn runs<'a>(scene: &'a Scene, folder: &Path) -> Result<StudyRuns<'a>, CasesError> {
    Ok(Box::new(Runs::new(scene, folder, Design { plan: scene.plan(), task: Task::new(scene)? })))
}

struct Design<'a> {
    /// Of the scene as it is written.
    plan: &'a Plan,
    task: Task<'a>,
}

type Known = journaled::Known<Key, Measured>;

impl Design<'_> {
    /// The work of somebody who does one run of a round, or none.
    fn work<'a>(
        &'a self,
        known: &Known,
        only: Option<Key>,
        record: Record<'a, Key, Measured>,
        watcher: &'a Watcher<'a>,
    ) -> Work<'a> {
        let mut work = Work::new(&self.task, known.done.clone(), record, watcher);
        work.apart = Some(Share { lost: known.lost.clone(), only, asked: Vec::new() });
        work
    }
}

impl Journaled for Design<'_> {
    type Key = Key;
    type Point = Measured;

    const NAME: &'static str = "design";
    const FILES: &'static [&'static str] = &FILES;

    fn open(&self) -> Result<(), CasesError> {
        methods::open(&unsettled(self.plan), &Hosts::new(&self.plan.hosts))?;
        Ok(())
    }

    fn asked(&self, known: &Known) -> Result<Vec<Key>, CasesError> {
        let watcher = Watcher { interrupt: &Interrupt::new(), progress: &|_| {} };
        let mut work = self.work(known, None, &|_, _| Ok(()), &watcher);
        work.design()?;
        Ok(work.apart.map(|share| share.asked).unwrap_or_default())
    }

    fn name(&self, key: &Key) -> String {
        let candidate = self.task.candidates.list.get(key.candidate);
        let candidate = candidate.map_or_else(|| "as-written".to_owned(), |one| one.case.folder());
        let ratio = key.ratio.map_or_else(String::new, |ratio| format!(",ratio={}", ratio.0));
        let cheap = if key.cheap { ",cheap" } else { "" };
        format!("{candidate},level={},seed={}{ratio}{cheap}", key.level, key.seed)
    }

    fn make(
        &mut self,
        keys: &[Key],
        known: &Known,
        record: Record<'_, Key, Measured>,
        watcher: &Watcher,
    ) -> Result<Option<String>, CasesError> {
        let [key] = keys else { return Ok(None) };
        let mut work = self.work(known, Some(*key), record, watcher);
        work.design()?;
        if watcher.interrupt.asked() {
            return Ok(None);
        }
        let told = work.failures.get(&key.candidate).map(ToString::to_string);
        Ok(Some(told.unwrap_or_else(|| "the cheap method cannot begin with it".to_owned())))
    }

    fn plans(&self) -> Vec<(Plan, f64)> {
        /// Runs of an answer, as a rule.
        const RUNS: f64 = 8.0;
        let periods = self.plan.response.as_ref().map_or(1.0, tsubu_scene::plan::Response::periods);
        let seconds = RUNS * periods / self.task.reference;
        let candidates = (0..=self.task.as_written()).map(|index| self.task.plan(index));
        let heaviest = candidates.max_by_key(|plan| plan.grains());
        heaviest.map(|plan| (plan.clone(), seconds)).into_iter().collect()
    }

    fn write(
        &mut self,
        known: Known,
        missing: Vec<(Key, String)>,
        folder: &RunFolder,
        scene: &Scene,
    ) -> Result<Summary, CasesError> {
        let watcher = Watcher { interrupt: &Interrupt::new(), progress: &|_| {} };
        let mut work = self.work(&known, None, &|_, _| Ok(()), &watcher);
        let found = work.design()?;
        for (key, why) in missing {
            work.failures.entry(key.candidate).or_insert(RunError::Elsewhere(why));
        }
        let status = if found.is_some() { Status::Finished } else { Status::Failed };
        let took = work.done.values().map(|one| one.wall_of_run() * f64::from(one.runs())).sum();
        Ok(write::write(folder, scene, &work, found.as_ref(), status, took)?)
    }
}
