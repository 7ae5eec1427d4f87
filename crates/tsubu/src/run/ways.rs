//! The ways into a run.

use super::{Onlooker, RunError, work};
use crate::interrupt::Watcher;
use crate::ranks::Communicator;
use std::path::Path;
use std::sync::Arc;
use tsubu_frame::{Existing, Summary};
use tsubu_scene::Scene;

/// Runs a scene to its end, or until it is interrupted, into `folder`.
pub fn run(scene: &Scene, folder: &Path, existing: Existing, watcher: &Watcher) -> Result<Summary, RunError> {
    work(scene, folder, existing, watcher, Manner::ALONE)
}

/// The same, with somebody who looks on. The run is the same to the last bit.
pub fn run_seen(
    scene: &Scene,
    folder: &Path,
    existing: Existing,
    watcher: &Watcher,
    onlooker: &dyn Onlooker,
) -> Result<Summary, RunError> {
    work(scene, folder, existing, watcher, Manner { onlooker: Some(onlooker), ..Manner::ALONE })
}

/// The same on rank 0 of several; the others [`follow`].
pub fn run_on_ranks(
    scene: &Scene,
    folder: &Path,
    existing: Existing,
    watcher: &Watcher,
    communicator: Arc<dyn Communicator>,
) -> Result<Summary, RunError> {
    work(scene, folder, existing, watcher, Manner { communicator: Some(communicator), ..Manner::ALONE })
}

/// One of many runs, on rank 0 of several if there is a communicator: it keeps no checkpoint of its end, and does not wait for the disk
/// there. After a power cut it is done again.
pub(crate) fn one_of_many(
    scene: &Scene,
    folder: &Path,
    existing: Existing,
    communicator: Option<Arc<dyn Communicator>>,
    watcher: &Watcher,
) -> Result<Summary, RunError> {
    work(scene, folder, existing, watcher, Manner { alone: false, communicator, ..Manner::ALONE })
}

/// How a run is made.
pub(super) struct Manner<'a> {
    /// Not one of many runs.
    pub alone: bool,
    pub onlooker: Option<&'a dyn Onlooker>,
    pub communicator: Option<Arc<dyn Communicator>>,
}

impl Manner<'_> {
    const ALONE: Self = Self { alone: true, onlooker: None, communicator: None };
}
