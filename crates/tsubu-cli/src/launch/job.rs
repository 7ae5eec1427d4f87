//! What is handed to a cluster: tasks of runs, and what a task needs.

use super::{Estimate, Runs};
use crate::failure::Failure;
use crate::options::program;
use std::path::PathBuf;
use std::sync::mpsc;
use std::time::Duration;
use tsubu::study::apart::Need;

/// Tasks shorter than this [s] keep a cluster busier with starting them than with them.
const SHORTEST: f64 = 60.0;

/// Tasks of a job at most: an array of Slurm has 1001 places unless its administrator says more.
const MOST: usize = 1000;

/// How long a user waits for an estimate.
const PATIENCE: Duration = Duration::from_secs(9);

/// The runs of a study that are missing, shared out.
pub struct Job {
    /// The command.
    pub name: &'static str,
    /// The folder of results, from the root.
    pub folder: PathBuf,
    /// Names of runs, a list a task.
    pub tasks: Vec<Vec<String>>,
    /// Runs of a task, where the user says how many.
    pub per_task: Option<usize>,
    /// Threads of a task, or of each of its ranks.
    pub threads: u16,
    /// Ranks of MPI that make each run together.
    pub ranks: u16,
    /// What the longest run needs; none where that cannot be told soon.
    pub need: Option<Need>,
    /// Words by which a task knows the study.
    words: Vec<String>,
    program: PathBuf,
}

impl Job {
    /// Shares the runs out, `per_task` each unless what they take says how many.
    pub fn new(
        name: &'static str,
        runs: &dyn Runs,
        missing: &[String],
        per_task: Option<usize>,
        threads: u16,
    ) -> Result<Self, Failure> {
        let folder = runs.folder();
        let folder = std::path::absolute(folder)
            .map_err(|error| Failure::wrong(format!("{} cannot be named from the root: {error}", folder.display())))?;
        let need = soon(runs.need()?);
        let short = need.map_or(1, |need| (SHORTEST / need.seconds.max(1e-3)).round() as usize);
        let size = per_task.unwrap_or(short).clamp(1, missing.len().max(1)).max(missing.len().div_ceil(MOST));
        let tasks = missing.chunks(size).map(<[String]>::to_vec).collect();
        let words = runs.words(&folder.display().to_string());
        Ok(Self { name, folder, tasks, per_task, threads, ranks: 1, need, words, program: program() })
    }

    /// Runs of all tasks.
    pub fn runs(&self) -> usize {
        self.tasks.iter().map(Vec::len).sum()
    }

    /// Runs of the longest task.
    pub fn longest(&self) -> usize {
        self.tasks.iter().map(Vec::len).max().unwrap_or_default()
    }

    /// The command of a task, but for its cases.
    pub fn command(&self) -> Vec<String> {
        let mut words = vec![self.program.display().to_string(), self.name.to_owned()];
        words.extend_from_slice(&self.words);
        words.extend(["-o", &self.folder.display().to_string(), "--quiet", "--threads"].map(str::to_owned));
        words.push(self.threads.to_string());
        words
    }

    /// The folder of what tasks have said.
    pub fn logs(&self) -> PathBuf {
        self.folder.join(super::logs::FOLDER)
    }
}

/// The estimate, if it is there before a user loses patience.
fn soon(estimate: Estimate) -> Option<Need> {
    let (send, told) = mpsc::channel();
    std::thread::spawn(move || _ = send.send(estimate()));
    told.recv_timeout(PATIENCE).ok().flatten()
}
