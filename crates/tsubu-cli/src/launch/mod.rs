//! Where the runs of a study are done: in this process, as an array job of Slurm, or by workers of Dask.
//!
//! A cluster starts this very program, once a task: `tsubu sweep DIR -o DIR --case NAME` does one run into its folder, and
//! `--gather` makes the tables and the page of what is there. All that is known of a run is in the folder, so that this is all
//! that any other scheduler needs.

mod cases;
mod dask;
mod job;
mod logs;
mod slurm;
mod study;

pub use logs::Logs;
pub use study::OfStudy;

use crate::failure::Failure;
use crate::options::WorkOptions;
use crate::output;
use clap::{Args, ValueEnum};
use job::Job;
use std::collections::BTreeSet;
use std::path::Path;
use tsubu::study::apart::Need;
use tsubu_frame::Status;

/// Who starts the runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Launcher {
    /// This process
    #[default]
    Local,
    /// An array job of Slurm, and a last job that gathers
    Slurm,
    /// Workers of Dask
    Dask,
}

#[derive(Args)]
#[command(next_help_heading = "Many machines")]
pub struct LaunchOptions {
    /// Who starts the runs
    #[arg(long, value_enum, default_value_t, value_name = "WHO")]
    launcher: Launcher,
    /// Print the job script, and start nothing; with the launcher `local`, the names of the runs that are missing
    #[arg(long, conflicts_with = "overwrite")]
    dry_run: bool,
    /// Runs that a task does one after the other [default: what takes a minute]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    per_task: Option<u32>,
    /// Ranks of MPI that make each run together, for `tsubu sweep` over Slurm
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(2..))]
    ranks: Option<u16>,
    /// Address of Dask's scheduler, as tcp://node:8786 [default: DASK_SCHEDULER_ADDRESS]
    #[arg(long, value_name = "ADDRESS")]
    scheduler: Option<String>,
    /// Do this run alone, as a task does; may be repeated
    #[arg(long = "case", value_name = "NAME", conflicts_with_all = ["launcher", "dry_run", "gather", "overwrite"])]
    cases: Vec<String>,
    /// Make tables and page of what is there, and run nothing; a launcher is handed the next round of runs, where there is one
    #[arg(long, conflicts_with_all = ["dry_run", "overwrite"])]
    gather: bool,
}

/// Runs that are done apart, each by a process of its own: whoever shares them out and whoever does one meet in the folder alone.
pub trait Runs {
    /// The folder.
    fn folder(&self) -> &Path;

    /// Makes it, or takes the one that was begun.
    fn begin(&mut self, overwrite: bool) -> Result<(), Failure>;

    /// Names of the runs that are to be done.
    fn missing(&mut self) -> Result<Vec<String>, Failure>;

    /// Does one of them.
    fn run(&mut self, name: &str) -> Result<Status, Failure>;

    /// How to find out what the longest needs, which takes a while.
    fn need(&self) -> Result<Estimate, Failure>;

    /// Words of the command line by which a task knows the study, whose folder has this name from the root.
    fn words(&self, folder: &str) -> Vec<String>;
}

/// What tells what a run needs, where that can be told.
pub type Estimate = Box<dyn FnOnce() -> Option<Need> + Send>;

/// What is left to do for the command itself.
pub enum Left {
    /// Nothing: tasks were started, done, or printed.
    Nothing,
    /// No run is to be waited for: tables and page.
    Gather,
}

impl LaunchOptions {
    /// Whether this process does the whole study. An option of another launcher is refused.
    pub fn is_here(&self) -> Result<bool, Failure> {
        let local = self.launcher == Launcher::Local;
        if self.per_task.is_some() && local {
            return Err(Failure::wrong("`--per-task` is for `--launcher slurm` or `dask`"));
        }
        if self.ranks.is_some() && self.launcher != Launcher::Slurm {
            return Err(Failure::wrong("`--ranks` is for `--launcher slurm`").hint("here: mpirun -n N tsubu run SCENE"));
        }
        if self.scheduler.is_some() && self.launcher != Launcher::Dask {
            return Err(Failure::wrong("`--scheduler` is for `--launcher dask`"));
        }
        Ok(local && !self.dry_run && !self.gather && self.cases.is_empty())
    }

    /// The runs that a task is to do.
    pub fn cases(&self) -> &[String] {
        &self.cases
    }

    /// On how many ranks a run is to be made; refused where it cannot be.
    fn ranks(&self, name: &str) -> Result<u16, Failure> {
        let Some(ranks) = self.ranks else { return Ok(1) };
        if name != "sweep" {
            return Err(Failure::wrong(format!(
                "the runs of `tsubu {name}` are made on one rank each: leave `--ranks` out"
            ))
            .hint("`tsubu sweep` and `tsubu run` work on several"));
        }
        if !tsubu_mpi::BUILT {
            return Err(Failure::wrong("`--ranks` asks for MPI, and this program was built without")
                .hint(tsubu_mpi::HOW_TO_BUILD));
        }
        Ok(ranks)
    }

    /// Does what was asked for with the runs of a study; `name` is that of the command.
    pub fn go(
        &self,
        name: &'static str,
        runs: &mut dyn Runs,
        overwrite: bool,
        work: &WorkOptions,
    ) -> Result<Left, Failure> {
        if !self.cases.is_empty() {
            return cases::cases(runs, &self.cases).map(|()| Left::Nothing);
        }
        let ranks = self.ranks(name)?;
        let scheduler = self.scheduler.as_deref();
        let folder = runs.folder().to_owned();
        if !self.dry_run && !self.gather {
            // What cannot be started leaves nothing behind.
            match self.launcher {
                Launcher::Local => {}
                Launcher::Slurm => slurm::ready(&folder)?,
                Launcher::Dask => dask::ready(scheduler)?,
            }
            runs.begin(overwrite)?;
        }
        let empty = std::fs::read_dir(&folder).map_or(!folder.exists(), |mut entries| entries.next().is_none());
        if self.gather && empty {
            // So begins who starts the tasks by other means.
            runs.begin(false)?;
        }
        let mut waited = self.gather;
        loop {
            let missing = runs.missing()?;
            if self.dry_run && (missing.is_empty() || self.launcher == Launcher::Local) {
                let lines: Vec<&str> = missing.iter().flat_map(|name| [name.as_str(), "\n"]).collect();
                return output::print(&lines.concat()).map(|()| Left::Nothing);
            }
            // What was asked for and is missing is not asked for again; a next round of runs is.
            if missing.is_empty() || self.launcher == Launcher::Local || waited && asked_for(&folder, &missing) {
                return Ok(Left::Gather);
            }
            let per_task = self.per_task.map(|n| n as usize);
            let mut job = Job::new(name, runs, &missing, per_task, work.told().unwrap_or(1))?;
            job.ranks = ranks;
            match (self.launcher, self.dry_run) {
                (Launcher::Dask, true) => return output::print(&dask::script(&job, scheduler)).map(|()| Left::Nothing),
                (_, true) => return output::print(&slurm::script(&job)).map(|()| Left::Nothing),
                (Launcher::Dask, false) => {
                    ask_for(&job)?;
                    dask::run(&job, scheduler)?;
                    waited = true;
                }
                (_, false) => {
                    ask_for(&job)?;
                    return slurm::submit(&job).map(|()| Left::Nothing);
                }
            }
        }
    }
}

/// File with the names of the runs that were asked for last.
const RUNS: &str = "runs";

/// Keeps what is asked for.
fn ask_for(job: &Job) -> Result<(), Failure> {
    let logs = job.logs();
    let names: Vec<&str> = job.tasks.iter().flatten().map(String::as_str).collect();
    let kept = std::fs::create_dir_all(&logs).and_then(|()| std::fs::write(logs.join(RUNS), names.join("\n") + "\n"));
    kept.map_err(|error| Failure::failed(format!("cannot write into {}: {error}", logs.display())))
}

/// Whether any of these was asked for before.
fn asked_for(folder: &Path, names: &[String]) -> bool {
    let asked = std::fs::read_to_string(folder.join(logs::FOLDER).join(RUNS)).unwrap_or_default();
    let asked: BTreeSet<&str> = asked.lines().collect();
    asked.is_empty() || names.iter().any(|name| asked.contains(name.as_str()))
}
