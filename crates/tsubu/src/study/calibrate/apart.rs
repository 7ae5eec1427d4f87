//! A calibration whose runs are done apart, round by round, each by a process of its own.
//!
//! What a round asks for follows from the runs before, so whoever reads the folder comes to the same round. A run that failed counts as
//! done: with its values it fails again.

use super::{RUNS, Share, Task, Work, curve, existing, numbered, open, write};
use crate::interrupt::{Interrupt, Watcher};
use crate::methods;
use crate::partner::Hosts;
use crate::study::apart::{Apart, Gathered, StudyRuns, not_begun, unlocked};
use crate::study::cases::CasesError;
use crate::trial::unsettled;
use std::path::{Path, PathBuf};
use tsubu_frame::{Existing, FileError, RunFolder, Status, Summary};
use tsubu_scene::{Plan, Scene};

/// The runs of a scene's `[calibrate]` into a folder; nothing is written yet.
pub fn runs<'a>(scene: &'a Scene, folder: &Path) -> Result<StudyRuns<'a>, CasesError> {
    Ok(Box::new(Runs { scene, task: Task::new(scene)?, folder: folder.to_owned() }))
}

struct Runs<'a> {
    scene: &'a Scene,
    task: Task<'a>,
    folder: PathBuf,
}

impl Runs<'_> {
    fn work<'w>(&'w self, only: Option<usize>, watcher: &'w Watcher<'w>) -> Work<'w> {
        let apart = Some(Share { only, asked: Vec::new() });
        Work { task: &self.task, runs: self.folder.join(RUNS), watcher, ran: Vec::new(), apart }
    }

    /// The runs that the round which is not over asks for.
    fn asked(&self) -> Result<Vec<usize>, CasesError> {
        let watcher = Watcher { interrupt: &Interrupt::new(), progress: &|_| {} };
        let mut work = self.work(None, &watcher);
        work.calibrate()?;
        Ok(work.apart.take().map(|share| share.asked).unwrap_or_default())
    }

    /// Refuses a folder in which this calibration was not begun.
    fn goes_on(&self) -> Result<(), CasesError> {
        match existing(self.scene, &self.folder, false)? {
            Existing::Resume => Ok(()),
            _ => Err(not_begun("calibrate", &self.folder)),
        }
    }

    fn one(&self, name: &str, watcher: &Watcher) -> Result<Status, CasesError> {
        self.goes_on()?;
        let only = name.parse().map_err(|_| CasesError::Scene(format!("a run has a number, not `{name}`")))?;
        self.work(Some(only), watcher).calibrate()?;
        let left = Summary::read(&self.folder.join(RUNS).join(numbered(only)).join("summary.json"))?;
        Ok(left.status)
    }
}

impl Apart for Runs<'_> {
    fn begin(&mut self, overwrite: bool) -> Result<(), CasesError> {
        // A scene that its method refuses leaves nothing behind.
        methods::open(&unsettled(self.scene.plan()), &Hosts::new(&self.scene.plan().hosts))?;
        let folder: RunFolder = open(self.scene, &self.folder, existing(self.scene, &self.folder, overwrite)?)?;
        let runs = folder.file(RUNS);
        std::fs::create_dir_all(&runs).map_err(FileError::write(&runs))?;
        Ok(folder.sync()?)
    }

    fn missing(&mut self) -> Result<Vec<String>, CasesError> {
        Ok(self.asked()?.into_iter().map(numbered).collect())
    }

    fn run(&mut self, name: &str, watcher: &Watcher) -> Result<Status, CasesError> {
        unlocked(watcher.interrupt, CasesError::is_locked, || self.one(name, watcher))
    }

    fn plans(&self) -> Result<Vec<(Plan, f64)>, CasesError> {
        let plan = self.scene.plan();
        let curve = self.task.wanted.curve.as_ref();
        Ok(vec![(plan.clone(), curve.map_or(plan.duration, |curve| curve::seconds(plan, curve)))])
    }
}

impl Gathered for Runs<'_> {
    fn gather(&mut self, why: &dyn Fn(&str) -> String) -> Result<Summary, CasesError> {
        self.goes_on()?;
        let folder = open(self.scene, &self.folder, Existing::Resume)?;
        let watcher = Watcher { interrupt: &Interrupt::new(), progress: &|_| {} };
        let mut work = self.work(None, &watcher);
        let found = work.calibrate()?;
        let missing = work.apart.take().map(|share| share.asked).unwrap_or_default().into_iter().map(numbered);
        let missing: Vec<String> = missing.map(|name| format!("run {name} is missing: {}", why(&name))).collect();
        let status = if found.is_some() { Status::Finished } else { Status::Failed };
        let took = work.ran.iter().map(|ran| ran.summary.wall_seconds).sum();
        Ok(write::write(&folder, &work, found.as_ref(), status, took, missing)?)
    }
}
