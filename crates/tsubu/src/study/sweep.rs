//! A parameter sweep: every case is a run of its own, in a folder of its own.
//!
//! Cases know nothing of each other. They run side by side here ([`sweep`]), or each in a process of its own, on whatever
//! machine ([`Sweep::run`]); [`Sweep::gather`] makes the tables of what is there.

mod table;
mod together;

pub use table::Outcome;

use super::apart::{Apart, not_begun, unlocked};
use super::cases::{Case, CasesError, cases};
use super::kept;
use crate::interrupt::Watcher;
use crate::methods;
use crate::partner::Hosts;
use crate::ranks::Communicator;
use crate::run::{self, RunError};
use crate::scene_files;
use crate::trial;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;
use tsubu_frame::summary::read_json;
use tsubu_frame::{Existing, RunFolder, Status, Summary};
use tsubu_scene::{Plan, Scene};

/// What a sweep took as a whole, interruptions left out: its cases run side by side, their times add up to more.
#[derive(Debug, Serialize, Deserialize)]
struct Took {
    /// By the clock on the wall [s].
    wall_seconds: f64,
    /// Cases that ran side by side.
    jobs: usize,
}

/// Runs every case of the scene's `[sweep]` into a folder of its own below `folder/cases`; finished cases are kept, cut
/// ones go on from their checkpoint; one that goes wrong says so in its row. Writes `sweep.csv`, and `sweep.json` with what
/// it took.
pub fn sweep(scene: &Scene, folder: &Path, overwrite: bool, watcher: &Watcher) -> Result<Vec<Summary>, CasesError> {
    let sweep = Sweep::new(scene, folder)?;
    let folder = sweep.open(overwrite)?;
    let begun = Instant::now();
    let finished = AtomicUsize::new(0);
    let outcomes: Vec<Option<Outcome>> = sweep
        .cases
        .par_iter()
        .map(|case| {
            if watcher.interrupt.asked() {
                return Ok(None);
            }
            let summary = kept::one(scene, case, &sweep.place(case), watcher)?;
            let done = finished.fetch_add(1, Ordering::Relaxed) + 1;
            (watcher.progress)(done as f64 / sweep.cases.len() as f64);
            Ok(Some(Outcome::Told(Box::new(summary))))
        })
        .collect::<Result<_, CasesError>>()?;
    let (cases, outcomes): (Vec<&Case>, Vec<Outcome>) =
        sweep.cases.iter().zip(outcomes).filter_map(|(case, outcome)| Some((case, outcome?))).unzip();
    folder.write("sweep.csv", table::of(&cases, &outcomes).to_csv().as_bytes())?;
    let earlier = read_json::<Took>(&folder.file("sweep.json")).map_or(0.0, |took| took.wall_seconds);
    let wall_seconds = earlier + begun.elapsed().as_secs_f64();
    folder.write_json("sweep.json", &Took { wall_seconds, jobs: rayon::current_num_threads() })?;
    folder.sync()?;
    Ok(outcomes.into_iter().filter_map(Outcome::summary).collect())
}

/// The folder of the cases' folders.
const CASES: &str = "cases/";

/// The cases of a scene's `[sweep]`, and where they are.
pub struct Sweep<'a> {
    scene: &'a Scene,
    cases: Vec<Case>,
    folder: PathBuf,
    /// How the ranks talk that make each run together.
    communicator: Option<Arc<dyn Communicator>>,
}

impl<'a> Sweep<'a> {
    /// Lists them; nothing is written yet.
    pub fn new(scene: &'a Scene, folder: &Path) -> Result<Self, CasesError> {
        let wanted = scene.plan().sweep.as_ref().ok_or_else(|| {
            CasesError::Scene("the scene has no `[sweep]`: say what varies, for example `vary = { \"particles.balls.count\" = [10, 20] }`".to_owned())
        })?;
        Ok(Self { scene, cases: cases(&wanted.vary), folder: folder.to_owned(), communicator: None })
    }

    /// The folder, with the scene in it; refused where a method refuses a case.
    fn open(&self, overwrite: bool) -> Result<RunFolder, CasesError> {
        // A case that its method refuses must say so before the others have run, and leave nothing behind.
        for case in &self.cases {
            let scene = case.scene(self.scene).map_err(CasesError::Complaints)?;
            let plan = trial::unsettled(scene.plan());
            let open = methods::open(&plan, &Hosts::new(&plan.hosts)).map_err(RunError::from);
            open.and_then(|engine| run::steps(&plan, &*engine))
                .map_err(|error| CasesError::Run { case: case.name.clone(), error })?;
            if let Some(why) = kept::of_another(&scene, &self.place(case)).filter(|_| !overwrite) {
                return Err(CasesError::NotThisScene(why));
            }
        }
        let existing = match self.is_begun() {
            _ if overwrite => Existing::Overwrite,
            true => Existing::Resume,
            false => Existing::Refuse,
        };
        if existing == Existing::Resume {
            self.is_ours()?;
        }
        self.take(existing)
    }

    fn is_begun(&self) -> bool {
        self.folder.join(CASES).is_dir()
    }

    /// Refuses the folder of another scene's sweep: all but what either varies is to be the same.
    fn is_ours(&self) -> Result<(), CasesError> {
        let there = std::fs::read_to_string(self.folder.join("scene.toml")).unwrap_or_default();
        let varied = |text: &str| -> Vec<String> {
            let table: toml::Table = toml::from_str(text).unwrap_or_default();
            let vary = table.get("sweep").and_then(|sweep| sweep.get("vary")).and_then(toml::Value::as_table);
            vary.into_iter().flat_map(toml::Table::keys).cloned().collect()
        };
        let free = [varied(&there), varied(&self.scene.resolved_toml())].concat();
        let is_free = |key: &str| free.iter().any(|one| one == key);
        kept::begun_by_another(self.scene, &self.folder, is_free)
            .map_or(Ok(()), |why| Err(CasesError::NotThisScene(why)))
    }

    /// Refuses a folder in which this sweep was not begun.
    fn goes_on(&self) -> Result<(), CasesError> {
        if self.is_begun() { self.is_ours() } else { Err(not_begun("sweep", &self.folder)) }
    }

    /// A case hangs on no other, so the first that is asked for begins the sweep where nobody has.
    fn goes_on_or_begins(&mut self) -> Result<(), CasesError> {
        if !self.is_begun()
            && let Err(error) = self.begin(false)
            // Another case may have begun it in the meantime.
            && !self.is_begun()
        {
            return Err(error);
        }
        self.is_ours()
    }

    fn take(&self, existing: Existing) -> Result<RunFolder, CasesError> {
        let own = ["sweep.csv", "sweep.json", CASES].map(str::to_owned);
        let names: Vec<String> = scene_files::names(self.scene).into_iter().chain(own).collect();
        let folder = RunFolder::create(&self.folder, existing, &names)?;
        folder.claim(&names)?;
        scene_files::write(&folder, self.scene)?;
        Ok(folder)
    }

    fn place(&self, case: &Case) -> PathBuf {
        self.folder.join(CASES).join(case.folder())
    }

    /// Makes `sweep.csv` of what is there, and runs nothing. `why` tells of a case, by its name, why it has no result.
    pub fn gather(&self, why: &dyn Fn(&str) -> String) -> Result<Vec<Outcome>, CasesError> {
        self.goes_on()?;
        let folder = self.take(Existing::Resume)?;
        let told = |case: &Case| -> Result<Outcome, CasesError> {
            Ok(match kept::of_case(self.scene, case, &self.place(case))? {
                Some(summary) => Outcome::Told(Box::new(summary)),
                None => Outcome::Missing(why(&case.folder())),
            })
        };
        let outcomes = self.cases.iter().map(told).collect::<Result<Vec<_>, _>>()?;
        let cases: Vec<&Case> = self.cases.iter().collect();
        folder.write("sweep.csv", table::of(&cases, &outcomes).to_csv().as_bytes())?;
        folder.sync()?;
        Ok(outcomes)
    }
}

impl Apart for Sweep<'_> {
    fn begin(&mut self, overwrite: bool) -> Result<(), CasesError> {
        let folder = self.open(overwrite)?;
        // What is begun is gone on with, even where no case has come to anything.
        let cases = folder.file(CASES);
        std::fs::create_dir_all(&cases).map_err(tsubu_frame::FileError::write(&cases))?;
        Ok(folder.sync()?)
    }

    fn missing(&mut self) -> Result<Vec<String>, CasesError> {
        let mut names = Vec::new();
        for case in &self.cases {
            let earlier = kept::of_case(self.scene, case, &self.place(case))?;
            if earlier.is_none_or(|summary| summary.status != Status::Finished) {
                names.push(case.folder());
            }
        }
        Ok(names)
    }

    fn run(&mut self, name: &str, watcher: &Watcher) -> Result<Status, CasesError> {
        let index = self.cases.iter().position(|case| case.folder() == name).ok_or_else(|| {
            CasesError::Scene(format!("the sweep has no case `{name}`: `tsubu sweep SCENE --dry-run` names all"))
        })?;
        unlocked(watcher.interrupt, CasesError::is_locked, || self.goes_on_or_begins())?;
        let case = &self.cases[index];
        let run = |scene: &Scene, folder: &Path, existing| self.run_together(index, scene, folder, existing, watcher);
        // Whoever holds it may be a worker that its cluster has given up: what it does is not done twice.
        unlocked(watcher.interrupt, CasesError::is_locked, || kept::made(self.scene, case, &self.place(case), &run))
            .map(|summary| summary.status)
    }

    fn plans(&self) -> Result<Vec<(Plan, f64)>, CasesError> {
        let plans = super::cases::case_plans(self.scene, &self.cases)?;
        Ok(plans.into_iter().map(|plan| (plan.duration, plan)).map(|(seconds, plan)| (plan, seconds)).collect())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that panics is a test that fails")]
mod tests {
    use super::*;

    /// What the studies vary, their methods take: a case that is refused ends a sweep before its first run.
    #[test]
    fn sweeps_of_the_studies_can_begin() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../studies");
        let folders = std::fs::read_dir(root).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_dir());
        let files = folders.flat_map(|folder| std::fs::read_dir(folder).unwrap()).map(|entry| entry.unwrap().path());
        let mut cases = 0;
        for file in files.filter(|file| file.extension().is_some_and(|extension| extension == "toml")) {
            let scene = Scene::read(&file, &[]).unwrap();
            if scene.plan().sweep.is_some() {
                let into = tempfile::tempdir().unwrap();
                let sweep = Sweep::new(&scene, &into.path().join("out")).unwrap();
                sweep.open(false).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
                cases += sweep.cases.len();
            }
        }
        assert!(cases > 8, "only {cases} cases were found");
    }
}
