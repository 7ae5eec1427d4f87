//! `tsubu bench`: how fast this machine moves grains, on one thread and on all.
//!
//! Two pieces of work at two ends of what DEM does: a chute (grains pass each other, linear springs with history) and a
//! settled bed (nobody leaves, Hertz and Mindlin). Both are made here in seconds; their size is that of the races against
//! other codes, scaled down.

mod work;

use crate::engine::{self, Engine, OpenError};
use crate::interrupt::Watcher;
use crate::ledger::Ledger;
use crate::methods;
use crate::partner::Hosts;
use crate::threads::alone;
use serde::{Deserialize, Serialize};
use std::time::{Duration, Instant};
use tsubu_frame::{Advise, Hint};

/// What was measured on a machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bench {
    /// Version of the program.
    pub tsubu_version: String,
    /// The processor, as the system calls it.
    pub processor: String,
    /// Threads that the machine runs at once.
    pub cores: usize,
    /// One row a piece of work and number of threads.
    pub rows: Vec<Row>,
}

/// One piece of work on some threads.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// `chute` or `bed`.
    pub work: String,
    /// Number of grains.
    pub particles: usize,
    /// Threads.
    pub threads: usize,
    /// Grains times steps in a second, the median of several looks.
    pub particle_steps_per_second: f64,
    /// Touching pairs times steps in a second.
    pub contacts_per_second: f64,
    /// Speed over that of one thread.
    pub scaling: f64,
}

/// Why nothing was measured.
#[derive(Debug, thiserror::Error)]
pub enum BenchError {
    /// The work could not be made, or blew up: a mistake in tsubu.
    #[error("the benchmark `{work}` does not run: {error}")]
    Work {
        /// Which.
        work: &'static str,
        /// What went wrong.
        error: OpenError,
    },
    /// No threads to be had.
    #[error("cannot start the threads: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// Whoever started it has stopped it.
    #[error("interrupted")]
    Interrupted,
}

impl Advise for BenchError {
    fn hints(&self) -> Vec<Hint> {
        match self {
            Self::Work { error, .. } => error.hints(),
            Self::Threads(_) | Self::Interrupted => Vec::new(),
        }
    }
}

/// Share of the time of a piece of work that goes into making it: grains must have met before it counts.
const WARM: f64 = 0.2;
/// Looks at every number of threads.
const LOOKS: usize = 3;

impl Bench {
    /// Measures for about `seconds`.
    pub fn measure(seconds: f64, watcher: &Watcher) -> Result<Self, BenchError> {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let mut rows = Vec::new();
        for (index, (work, plan)) in work::ALL.iter().enumerate() {
            let part = |done: f64| (watcher.progress)((index as f64 + done) / work::ALL.len() as f64);
            let plan = plan();
            let hosts = Hosts::default();
            let engine = methods::open(&plan, &hosts).map_err(|error| BenchError::Work { work, error })?;
            let ledger = Ledger::open(engine::energies(&*engine, &hosts), engine.momentum());
            let mut job = Job { work, engine, hosts, ledger, watcher };
            let share = seconds / work::ALL.len() as f64;
            let all = threads(cores);
            let pool = |threads: usize| rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            job.go(&pool(cores)?, WARM * share)?;
            part(WARM);
            let mut speeds = vec![Vec::new(); all.len()];
            let looks = (LOOKS * all.len()) as f64;
            // In turns, so that whatever else the machine does meets all alike.
            for look in 0..LOOKS {
                for (k, threads) in all.iter().enumerate() {
                    speeds[k].push(job.go(&pool(*threads)?, (1.0 - WARM) * share / looks)?);
                    part(WARM + (1.0 - WARM) * (look * all.len() + k + 1) as f64 / looks);
                }
            }
            let (particles, contacts) = (job.engine.grains(), job.engine.contacts());
            let medians: Vec<f64> = speeds.into_iter().map(median).collect();
            rows.extend(all.iter().zip(&medians).map(|(threads, steps)| Row {
                work: (*work).to_owned(),
                particles,
                threads: *threads,
                particle_steps_per_second: steps * particles as f64,
                contacts_per_second: steps * contacts as f64,
                scaling: steps / medians[0],
            }));
        }
        Ok(Self { tsubu_version: crate::VERSION.to_owned(), processor: processor(), cores, rows })
    }

    /// How much faster many grains go on all threads than on one: the mean of the pieces of work.
    pub fn scaling(&self) -> f64 {
        let best = self.rows.iter().filter(|row| row.threads == self.cores).map(|row| row.scaling);
        let (sum, count) = best.fold((0.0, 0.0), |(sum, count), scaling| (sum + scaling, count + 1.0));
        if count > 0.0 { sum / count } else { 1.0 }
    }
}

/// A piece of work in progress.
struct Job<'a> {
    work: &'static str,
    engine: Box<dyn Engine>,
    hosts: Hosts,
    ledger: Ledger,
    watcher: &'a Watcher<'a>,
}

impl Job<'_> {
    /// Works for some time; gives the steps in a second.
    fn go(&mut self, pool: &rayon::ThreadPool, seconds: f64) -> Result<f64, BenchError> {
        let (begun, end) = (Instant::now(), Duration::from_secs_f64(seconds.max(0.0)));
        let first = self.engine.steps();
        let mut block = 4;
        while begun.elapsed() < end {
            if self.watcher.interrupt.asked() {
                return Err(BenchError::Interrupted);
            }
            let took = Instant::now();
            let step = || alone(|| self.engine.advance(block, &mut self.hosts, &mut self.ledger));
            let done = pool.install(step);
            done.map_err(|fault| BenchError::Work { work: self.work, error: fault.into() })?;
            block = if took.elapsed().as_millis() < 50 { (2 * block).min(1 << 16) } else { (block / 2).max(1) };
        }
        Ok((self.engine.steps() - first) as f64 / begun.elapsed().as_secs_f64())
    }
}

/// One, two, four and so on, and all.
fn threads(cores: usize) -> Vec<usize> {
    let mut all: Vec<usize> = std::iter::successors(Some(1), |n| Some(2 * n)).take_while(|n| *n < cores).collect();
    all.push(cores);
    all
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// The name of the processor where the system tells it, else its kind.
pub fn processor() -> String {
    let about = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = about.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':'));
    name.map_or_else(|| std::env::consts::ARCH.to_owned(), |(_, name)| name.trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn threads_double_up_to_all() {
        assert_eq!(threads(1), [1]);
        assert_eq!(threads(2), [1, 2]);
        assert_eq!(threads(6), [1, 2, 4, 6]);
    }
}
