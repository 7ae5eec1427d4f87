//! Threads: pools that are taken for a piece of work and given back, so that simulations side by side do not wait for each other, and
//! one after the other start no new threads.

use rayon::{ThreadPool, ThreadPoolBuilder};
use std::mem;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, OnceLock, PoisonError};

/// Pools that nobody works with, and the process that they are of.
static IDLE: Mutex<(u32, Vec<ThreadPool>)> = Mutex::new((0, Vec::new()));

/// Pools that somebody works with.
static TAKEN: AtomicUsize = AtomicUsize::new(0);

/// Cores of the machine: to ask for them costs as much as some steps of a small bed.
static CORES: OnceLock<usize> = OnceLock::new();

/// Pools that are kept idle.
const KEPT: usize = 8;

/// A pool that is given back when it is dropped.
pub struct Taken {
    pool: Option<ThreadPool>,
}

/// Takes a pool of so many threads; 0: one a core.
pub fn take(threads: usize) -> Result<Taken, String> {
    let cores = *CORES.get_or_init(|| std::thread::available_parallelism().map_or(1, usize::from));
    let threads = if threads == 0 { cores } else { threads.min(16.max(4 * cores)) };
    let mut idle = IDLE.lock().unwrap_or_else(PoisonError::into_inner);
    let here = std::process::id();
    if idle.0 != here {
        // A fork has the pools of its parent without their threads: they are left as they are, for they would wait for these.
        mem::take(&mut idle.1).into_iter().for_each(mem::forget);
        idle.0 = here;
    }
    let known = idle.1.iter().position(|pool| pool.current_num_threads() == threads);
    let pool = match known {
        Some(at) => idle.1.swap_remove(at),
        None => ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .map_err(|error| format!("cannot start the threads: {error}"))?,
    };
    TAKEN.fetch_add(1, Ordering::Relaxed);
    Ok(Taken { pool: Some(pool) })
}

impl Taken {
    /// Does the work on its threads. They may stay awake between steps where nobody else works.
    pub fn install<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        let alone = TAKEN.load(Ordering::Relaxed) == 1;
        match &self.pool {
            Some(pool) if alone => pool.install(|| tsubu::threads::alone(work)),
            Some(pool) => pool.install(work),
            None => work(),
        }
    }
}

impl Drop for Taken {
    fn drop(&mut self) {
        TAKEN.fetch_sub(1, Ordering::Relaxed);
        let mut idle = IDLE.lock().unwrap_or_else(PoisonError::into_inner);
        if idle.1.len() < KEPT {
            idle.1.extend(self.pool.take());
        }
    }
}
