//! A design whose runs are done apart, round by round, each by a process of its own.
//!
//! What a round asks for follows from what was measured before: whoever reads the folder goes the way of the search over what is known, and
//! comes to the same round.

use super::work::{Share, Work};
use super::{Done, FILES, Key, Measured, Task, write};
use crate::interrupt::{Interrupt, Watcher};
use crate::methods;
use crate::partner::Hosts;
use crate::run::RunError;
use crate::study::apart::{Apart, Gathered, unlocked};
use crate::study::cases::CasesError;
use crate::study::journal::{self, Journal};
use crate::trial::unsettled;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use tsubu_frame::{Status, Summary};
use tsubu_scene::{Plan, Scene};

/// The runs of a scene's `[design]`, and the folder that they are in.
pub struct Runs<'a> {
    scene: &'a Scene,
    task: Task<'a>,
    folder: PathBuf,
}

impl<'a> Runs<'a> {
    /// Lists the candidates; nothing is written yet.
    pub fn new(scene: &'a Scene, folder: &Path) -> Result<Self, CasesError> {
        Ok(Self { scene, task: Task::new(scene)?, folder: folder.to_owned() })
    }

    /// What is measured, and what failed.
    fn known(&self) -> Result<(Done, BTreeMap<Key, String>), CasesError> {
        let done: Option<Done> = journal::earlier(&self.folder, self.scene, false)?;
        Ok((done.unwrap_or_default(), journal::lost(&self.folder, self.scene)))
    }

    /// The runs that the round which is not over asks for.
    fn asked(&self) -> Result<Vec<Key>, CasesError> {
        let (done, lost) = self.known()?;
        let watcher = Watcher { interrupt: &Interrupt::new(), progress: &|_| {} };
        let mut work = Work::new(&self.task, done, &|_, _| Ok(()), &watcher);
        work.apart = Some(Share { lost, ..Share::default() });
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

    /// Does one of the round, and writes it down.
    fn one(&self, name: &str, watcher: &Watcher) -> Result<Status, CasesError> {
        let journal = Journal::apart(&self.folder, name, self.scene)?;
        let Some(key) = self.asked()?.into_iter().find(|key| self.name(key) == name) else {
            // It is done, or nobody asks for it any more.
            return Ok(Status::Finished);
        };
        let (done, lost) = self.known()?;
        let found = AtomicBool::new(false);
        let record = |key: &Key, measured: &Measured| {
            found.store(true, Ordering::Relaxed);
            journal.record(key, measured)
        };
        let mut work = Work::new(&self.task, done, &record, watcher);
        work.apart = Some(Share { lost, only: Some(key), asked: Vec::new() });
        work.design()?;
        if found.load(Ordering::Relaxed) {
            return Ok(Status::Finished);
        }
        if watcher.interrupt.asked() {
            return Ok(Status::Interrupted);
        }
        let told = work.failures.get(&key.candidate).map(ToString::to_string);
        journal.lose(&key, &told.unwrap_or_else(|| "the cheap method cannot begin with it".to_owned()))?;
        Ok(Status::Failed)
    }
}

impl Apart for Runs<'_> {
    fn begin(&mut self, overwrite: bool) -> Result<(), CasesError> {
        let earlier: Option<Done> = journal::earlier(&self.folder, self.scene, overwrite)?;
        // A scene that its method refuses leaves nothing behind.
        methods::open(&unsettled(self.scene.plan()), &Hosts::new(&self.scene.plan().hosts))?;
        let folder = journal::open_folder(&self.folder, earlier.is_some(), self.scene, overwrite, &FILES)?;
        journal::collect::<Key, Measured>(&folder, self.scene)?;
        Ok(folder.sync()?)
    }

    fn missing(&mut self) -> Result<Vec<String>, CasesError> {
        Ok(self.asked()?.iter().map(|key| self.name(key)).collect())
    }

    fn run(&mut self, name: &str, watcher: &Watcher) -> Result<Status, CasesError> {
        unlocked(watcher.interrupt, CasesError::is_locked, || self.one(name, watcher))
    }

    fn plans(&self) -> Result<Vec<(Plan, f64)>, CasesError> {
        /// Runs of an answer, as a rule.
        const RUNS: f64 = 8.0;
        let periods = self.scene.plan().response.as_ref().map_or(1.0, tsubu_scene::plan::Response::periods);
        let seconds = RUNS * periods / self.task.reference;
        let candidates = (0..=self.task.as_written()).map(|index| self.task.plan(index));
        let heaviest = candidates.max_by_key(|plan| plan.grains());
        Ok(heaviest.map(|plan| (plan.clone(), seconds)).into_iter().collect())
    }
}

impl Gathered for Runs<'_> {
    fn gather(&mut self, why: &dyn Fn(&str) -> String) -> Result<Summary, CasesError> {
        let (done, lost) = self.known()?;
        let folder = journal::open_folder(&self.folder, true, self.scene, false, &FILES)?;
        let watcher = Watcher { interrupt: &Interrupt::new(), progress: &|_| {} };
        let mut work = Work::new(&self.task, done, &|_, _| Ok(()), &watcher);
        work.apart = Some(Share { lost, ..Share::default() });
        let found = work.design()?;
        for key in work.apart.take().map(|share| share.asked).unwrap_or_default() {
            let name = self.name(&key);
            let told = RunError::Elsewhere(format!("{name} is missing: {}", why(&name)));
            work.failures.entry(key.candidate).or_insert(told);
        }
        let status = if found.is_some() { Status::Finished } else { Status::Failed };
        let took = work.done.values().map(|one| one.wall_of_run() * f64::from(one.runs())).sum();
        Ok(write::write(&folder, self.scene, &work, found.as_ref(), status, took)?)
    }
}
