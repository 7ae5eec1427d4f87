//! A study each of whose runs is a line in its journal, done apart: each run by a process of its own.
//!
//! What the next round asks for follows from what is known, so whoever reads the folder comes to the same round.

use super::apart::{Apart, Gathered, not_begun, unlocked};
use super::cases::CasesError;
use super::journal::Place;
use crate::interrupt::Watcher;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use tsubu_frame::{FileError, RunFolder, Status, Summary};
use tsubu_scene::{Plan, Scene};

/// What is known of the runs of a study.
pub(super) struct Known<K, P> {
    /// What was measured.
    pub done: BTreeMap<K, P>,
    /// What failed, and what was said of it.
    pub lost: BTreeMap<K, String>,
}

impl<K, P> Default for Known<K, P> {
    fn default() -> Self {
        Self { done: BTreeMap::new(), lost: BTreeMap::new() }
    }
}

impl<K: Copy + Ord, P> Known<K, P> {
    /// The keys of what failed.
    pub fn given_up(&self) -> BTreeSet<K> {
        self.lost.keys().copied().collect()
    }
}

/// Hears of everything that is measured.
pub(super) type Record<'a, K, P> = &'a (dyn Fn(&K, &P) -> Result<(), FileError> + Sync);

/// A study of such runs. What a key stands for is measured by itself, or by a run that several keys belong to.
pub(super) trait Journaled: Send {
    /// What is measured.
    type Key: Copy + Ord + Send + Serialize + DeserializeOwned;
    /// What came of it.
    type Point: Serialize + DeserializeOwned;

    /// The command.
    const NAME: &'static str;
    /// What it writes beside what every study writes.
    const FILES: &'static [&'static str];

    /// Says what a method has against a scene that is to be run.
    fn open(&self) -> Result<(), CasesError>;

    /// What the round that is not over asks for, and is neither measured nor lost.
    fn asked(&self, known: &Known<Self::Key, Self::Point>) -> Result<Vec<Self::Key>, CasesError>;

    /// The name of the run that a key belongs to.
    fn name(&self, key: &Self::Key) -> String;

    /// Makes the run that these keys belong to, and tells what comes of each; gives why some have come to nothing, if that was no interruption.
    fn make(
        &mut self,
        keys: &[Self::Key],
        known: &Known<Self::Key, Self::Point>,
        record: Record<'_, Self::Key, Self::Point>,
        watcher: &Watcher,
    ) -> Result<Option<String>, CasesError>;

    /// What each run is of, with the time that is simulated in it [s].
    fn plans(&self) -> Vec<(Plan, f64)>;

    /// Writes files and summary of what is known; `missing` has a key of every run without a result, and why it has none.
    fn write(
        &mut self,
        known: Known<Self::Key, Self::Point>,
        missing: Vec<(Self::Key, String)>,
        folder: &RunFolder,
        scene: &Scene,
    ) -> Result<Summary, CasesError>;
}

type KnownOf<S> = Known<<S as Journaled>::Key, <S as Journaled>::Point>;

/// The runs of a study, and the folder that they are in.
pub(super) struct Runs<'a, S> {
    scene: &'a Scene,
    folder: PathBuf,
    study: S,
}

impl<'a, S: Journaled> Runs<'a, S> {
    /// Nothing is written yet.
    pub fn new(scene: &'a Scene, folder: &Path, study: S) -> Self {
        Self { scene, folder: folder.to_owned(), study }
    }

    fn place(&self) -> Place<'_> {
        Place { study: S::NAME, scene: self.scene, folder: &self.folder }
    }

    /// What is known; nothing where the study is not begun.
    fn known(&self) -> Result<Option<KnownOf<S>>, CasesError> {
        let Some(done) = self.place().earlier(false)? else { return Ok(None) };
        let mut lost: BTreeMap<S::Key, String> = self.place().lost();
        lost.retain(|key, _| !done.contains_key(key));
        Ok(Some(Known { done, lost }))
    }

    /// A key of each run that is missing, with its name.
    fn missing_runs(&self, known: &KnownOf<S>) -> Result<Vec<(S::Key, String)>, CasesError> {
        let mut names = BTreeSet::new();
        let asked = self.study.asked(known)?.into_iter().map(|key| (key, self.study.name(&key)));
        Ok(asked.filter(|(_, name)| names.insert(name.clone())).collect())
    }

    /// What a run is still to measure, and what is known; an error where there is no such run.
    fn left(&self, name: &str) -> Result<(Vec<S::Key>, KnownOf<S>), CasesError> {
        let study = S::NAME;
        let known = self.known()?.ok_or_else(|| not_begun(study, &self.folder))?;
        let is_of = |key: &S::Key| self.study.name(key) == name;
        let left: Vec<S::Key> = self.study.asked(&known)?.into_iter().filter(is_of).collect();
        if left.is_empty() && !known.done.keys().chain(known.lost.keys()).any(is_of) {
            return Err(CasesError::Scene(format!(
                "the {study} has no run `{name}`: `tsubu {study} SCENE --dry-run` names those that are missing"
            )));
        }
        Ok((left, known))
    }

    /// Does a run, and writes it down.
    fn one(&mut self, name: &str, watcher: &Watcher) -> Result<Status, CasesError> {
        // A name that is none must not become a file.
        self.left(name)?;
        let journal = self.place().apart(name)?;
        // What another process has done while this one waited for the journal is known only now.
        let (mut left, known) = self.left(name)?;
        if left.is_empty() {
            return Ok(Status::Finished);
        }
        let done = Mutex::new(BTreeSet::new());
        let record = |key: &S::Key, point: &S::Point| {
            done.lock().unwrap_or_else(PoisonError::into_inner).insert(*key);
            journal.record(key, point)
        };
        let why = self.study.make(&left, &known, &record, watcher)?;
        let done = done.into_inner().unwrap_or_else(PoisonError::into_inner);
        left.retain(|key| !done.contains(key));
        match why {
            _ if left.is_empty() => Ok(Status::Finished),
            None => Ok(Status::Interrupted),
            Some(why) => {
                left.iter().try_for_each(|key| journal.lose(key, &why))?;
                Ok(Status::Failed)
            }
        }
    }
}

impl<S: Journaled> Apart for Runs<'_, S> {
    fn begin(&mut self, overwrite: bool) -> Result<(), CasesError> {
        let earlier: Option<BTreeMap<S::Key, S::Point>> = self.place().earlier(overwrite)?;
        // A scene that its method refuses leaves nothing behind.
        self.study.open()?;
        let folder = self.place().open(earlier.is_some(), overwrite, S::FILES)?;
        self.place().collect::<S::Key, S::Point>(&folder)?;
        Ok(folder.sync()?)
    }

    fn missing(&mut self) -> Result<Vec<String>, CasesError> {
        let missing = self.missing_runs(&self.known()?.unwrap_or_default())?;
        Ok(missing.into_iter().map(|(_, name)| name).collect())
    }

    fn run(&mut self, name: &str, watcher: &Watcher) -> Result<Status, CasesError> {
        unlocked(watcher.interrupt, CasesError::is_locked, || self.one(name, watcher))
    }

    fn plans(&self) -> Result<Vec<(Plan, f64)>, CasesError> {
        Ok(self.study.plans())
    }
}

impl<S: Journaled> Gathered for Runs<'_, S> {
    fn gather(&mut self, why: &dyn Fn(&str) -> String) -> Result<Summary, CasesError> {
        let known = self.known()?.ok_or_else(|| not_begun(S::NAME, &self.folder))?;
        let told = |(key, name): (S::Key, String)| (key, format!("{name} is missing: {}", why(&name)));
        let missing = self.missing_runs(&known)?.into_iter().map(told).collect();
        let folder = self.place().open(true, false, S::FILES)?;
        self.study.write(known, missing, &folder, self.scene)
    }
}
