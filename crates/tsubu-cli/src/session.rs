//! What the commands that run things share: a scene and its folder, threads, progress, Ctrl-C, and how they end.

use crate::failure::Failure;
use crate::options::{FolderOptions, SceneOptions, WorkOptions, command_to_resume, quoted};
use crate::progress::Progress;
use crate::{output, stop};
use rayon::ThreadPool;
use std::path::{Path, PathBuf};
use tsubu::interrupt::{Interrupt, Watcher};
use tsubu_frame::Claim;
use tsubu_scene::Scene;

/// A command at work on a scene.
pub struct Session {
    /// What is run.
    pub scene: Scene,
    /// Where its results go.
    pub folder: PathBuf,
    name: &'static str,
    pool: ThreadPool,
    quiet: bool,
}

/// How to go on after an interruption, where that can be done.
pub fn resume() -> String {
    format!("go on with `{}`", command_to_resume())
}

impl Session {
    /// Reads the scene and finds threads; results go to a folder that ends in `suffix` unless the user names one.
    pub fn begin(
        name: &'static str,
        suffix: &str,
        scene: &SceneOptions,
        folder: &FolderOptions,
        work: &WorkOptions,
    ) -> Result<Self, Failure> {
        let folder = folder.folder(scene, suffix);
        Ok(Self { scene: scene.read()?, folder, name, pool: work.pool()?, quiet: work.quiet })
    }

    /// Where resuming is asked for and there is nothing yet, it is refused.
    pub fn needs_folder(&self) -> Result<(), Failure> {
        if self.folder.is_dir() {
            return Ok(());
        }
        Err(Failure::wrong(format!("nothing to resume: {} is not a folder", self.folder.display())))
    }

    /// Does the work on the threads, with progress shown, and tells whether it was asked to stop; `words` are said where stopping
    /// takes too long.
    pub fn work<T: Send>(&self, words: &str, work: impl FnOnce(&Watcher) -> T + Send) -> (T, &'static Interrupt) {
        let progress = Progress::new(self.name, self.quiet);
        let interrupt = stop::interrupt(words);
        let done = self.pool.install(|| work(&Watcher { interrupt, progress: &|done| progress.set(done) }));
        progress.end();
        (done, interrupt)
    }

    /// Does work of which nothing is shown; whoever asks it to stop is heard elsewhere.
    pub fn silently<T: Send>(&self, work: impl FnOnce(&Interrupt) -> T + Send) -> T {
        let interrupt = stop::interrupt(stop::NOT_BEGUN);
        self.pool.install(|| work(interrupt))
    }

    /// Makes the page of results that were just computed, and gives its path.
    pub fn page(&self) -> Result<PathBuf, Failure> {
        self.pool.install(|| page(&self.folder))
    }

    /// Prints the results, and where they are; without a page of them, how to make one.
    pub fn show(&self, results: &str, page: Option<&Path>) -> Result<(), Failure> {
        output::print(results)?;
        let folder = quoted(&self.folder.to_string_lossy());
        output::tell(&match page {
            Some(page) => format!("results in {folder}; open {}\n", quoted(&page.to_string_lossy())),
            None => format!("results in {folder}; figures and a page: tsubu report {folder}\n"),
        });
        Ok(())
    }
}

/// Writes figures and page into a folder of results, and gives the page's path.
pub fn page(folder: &Path) -> Result<PathBuf, Failure> {
    tsubu_report::report(folder).map(|written| written.page).map_err(|error| Failure::of_report(&error))
}

/// How a command ends that has done its work: well where every claim holds.
pub fn judge<'a>(claims: impl IntoIterator<Item = &'a Claim>) -> Result<(), Failure> {
    if claims.into_iter().all(|claim| claim.pass) { Ok(()) } else { Err(Failure::claim()) }
}
