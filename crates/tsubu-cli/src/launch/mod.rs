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

pub use logs::Logs;

use crate::failure::Failure;
use crate::options::{FolderOptions, WorkOptions};
use crate::output;
use crate::session::Session;
use clap::{Args, ValueEnum};
use job::Job;
use tsubu::study::apart::Apart;

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
    /// Address of Dask's scheduler, as tcp://node:8786 [default: DASK_SCHEDULER_ADDRESS]
    #[arg(long, value_name = "ADDRESS")]
    scheduler: Option<String>,
    /// Do this run alone, as a task does; may be repeated
    #[arg(long = "case", value_name = "NAME", conflicts_with_all = ["launcher", "dry_run", "gather", "overwrite"])]
    cases: Vec<String>,
    /// Make tables and page of what is there, and run nothing
    #[arg(long, conflicts_with_all = ["launcher", "dry_run", "overwrite"])]
    gather: bool,
}

/// What is left to do for the command itself.
pub enum Left {
    /// Nothing: tasks were started, done, or printed.
    Nothing,
    /// No run is to be waited for: tables and page.
    Gather,
}

impl LaunchOptions {
    /// Whether this process does the whole study.
    pub fn is_here(&self) -> bool {
        self.launcher == Launcher::Local && !self.dry_run && !self.gather && self.cases.is_empty()
    }

    /// Does what was asked for with the runs of a study; `name` is that of the command.
    pub fn go(
        &self,
        name: &'static str,
        study: &mut (dyn Apart + Send),
        session: &Session,
        folder: &FolderOptions,
        work: &WorkOptions,
    ) -> Result<Left, Failure> {
        if !self.cases.is_empty() {
            return cases::cases(study, session, &self.cases).map(|()| Left::Nothing);
        }
        if self.gather {
            return Ok(Left::Gather);
        }
        let scheduler = self.scheduler.as_deref();
        let broken = |error| Failure::of_cases(&error, &session.scene, &session.folder);
        if !self.dry_run {
            // What cannot be started leaves nothing behind.
            match self.launcher {
                Launcher::Local => {}
                Launcher::Slurm => slurm::ready(&session.folder)?,
                Launcher::Dask => dask::ready(scheduler)?,
            }
            study.begin(folder.overwrite).map_err(broken)?;
        }
        let missing = study.missing().map_err(broken)?;
        if missing.is_empty() {
            output::tell("no run is missing\n");
            return Ok(if self.dry_run { Left::Nothing } else { Left::Gather });
        }
        if self.launcher == Launcher::Local {
            return output::print(&(missing.join("\n") + "\n")).map(|()| Left::Nothing);
        }
        let plans = study.plans().map_err(broken)?;
        let per_task = self.per_task.map(|n| n as usize);
        let job = Job::new(name, &session.folder, missing, per_task, work.told().unwrap_or(1), plans)?;
        match (self.launcher, self.dry_run) {
            (Launcher::Dask, true) => output::print(&dask::script(&job, scheduler)).map(|()| Left::Nothing),
            (Launcher::Dask, false) => dask::run(&job, scheduler).map(|()| Left::Gather),
            (_, true) => output::print(&slurm::script(&job)).map(|()| Left::Nothing),
            (_, false) => slurm::submit(&job).map(|()| Left::Nothing),
        }
    }
}
