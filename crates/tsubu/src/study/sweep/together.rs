//! Cases on several ranks: the first does them, and tells the others which it is at.

use super::Sweep;
use crate::interrupt::{Interrupt, Watcher};
use crate::ranks::Communicator;
use crate::run::{self, RunError};
use crate::study::cases::CasesError;
use std::path::Path;
use std::sync::Arc;
use tsubu_frame::{Existing, Summary};
use tsubu_scene::Scene;

impl Sweep<'_> {
    /// The sweep on rank 0 of several; the others [`Sweep::follow`] it until it is dropped.
    #[must_use]
    pub fn on_ranks(mut self, communicator: Arc<dyn Communicator>) -> Self {
        self.communicator = Some(communicator);
        self
    }

    /// Makes, on a rank that is not the first, every run that the first makes. Whoever asks it to stop is to ask the first.
    pub fn follow(&self, communicator: &Arc<dyn Communicator>, interrupt: &Interrupt) -> Result<(), CasesError> {
        loop {
            let mut message = Vec::new();
            communicator.broadcast(&mut message);
            let Some(case) = message.first().and_then(|index| self.cases.get(*index as usize)) else { return Ok(()) };
            let scene = case.scene(self.scene).map_err(CasesError::Complaints)?;
            // What goes wrong goes wrong on all ranks: the first tells it, and goes on to another case.
            let _ = run::follow(&scene, communicator, interrupt);
        }
    }

    /// Makes the run of a case, with the other ranks if there are any.
    pub(super) fn run_together(
        &self,
        index: usize,
        scene: &Scene,
        folder: &Path,
        existing: Existing,
        watcher: &Watcher,
    ) -> Result<Summary, RunError> {
        if let Some(communicator) = &self.communicator {
            communicator.broadcast(&mut vec![index as f64]);
        }
        let quiet = watcher.quiet();
        run::one_of_many(scene, folder, existing, self.communicator.clone(), &quiet)
    }
}

impl Drop for Sweep<'_> {
    fn drop(&mut self) {
        // In a panic the others may be anywhere; whoever started them ends them.
        if let Some(communicator) = self.communicator.as_ref().filter(|_| !std::thread::panicking()) {
            communicator.broadcast(&mut Vec::new());
        }
    }
}
