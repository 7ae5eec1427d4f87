//! The runs of a study of a scene.

use super::cases::INTERRUPTED;
use super::{Estimate, Runs};
use crate::failure::Failure;
use crate::session::Session;
use std::path::Path;
use tsubu::study::apart::{Apart, need};
use tsubu::study::cases::CasesError;
use tsubu_frame::Status;

/// A study, and the command that is at work on it.
pub struct OfStudy<'a, S: ?Sized> {
    /// The study.
    pub study: &'a mut S,
    /// The command.
    pub session: &'a Session,
}

impl<S: ?Sized> OfStudy<'_, S> {
    fn failure(&self) -> impl Fn(CasesError) -> Failure {
        let Session { scene, folder, .. } = self.session;
        move |error| Failure::of_cases(&error, scene, folder)
    }
}

impl<S: Apart + Send + ?Sized> Runs for OfStudy<'_, S> {
    fn folder(&self) -> &Path {
        &self.session.folder
    }

    fn begin(&mut self, overwrite: bool) -> Result<(), Failure> {
        self.study.begin(overwrite).map_err(self.failure())
    }

    fn missing(&mut self) -> Result<Vec<String>, Failure> {
        self.study.missing().map_err(self.failure())
    }

    fn run(&mut self, name: &str) -> Result<Status, Failure> {
        let (done, _) = self.session.work(INTERRUPTED, |watcher| self.study.run(name, watcher));
        done.map_err(self.failure())
    }

    fn need(&self) -> Result<Estimate, Failure> {
        let plans = self.study.plans().map_err(self.failure())?;
        Ok(Box::new(move || need(&plans)))
    }

    /// The scene is the one in the folder: what a user edits meanwhile is not run.
    fn words(&self, folder: &str) -> Vec<String> {
        vec![folder.to_owned()]
    }
}
