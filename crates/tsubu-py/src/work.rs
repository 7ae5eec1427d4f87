//! Work that takes long: beside the interpreter, which is free meanwhile, with its progress told and Ctrl-C heard.

use crate::error;
use crate::pools;
use pyo3::prelude::*;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Condvar, Mutex, PoisonError};
use std::thread;
use std::time::Duration;
use tsubu::interrupt::{Interrupt, Watcher};

/// How often Ctrl-C is looked for and progress is told.
const LOOK: Duration = Duration::from_millis(50);

/// Something that is done, and what Python raised meanwhile: the work was asked to stop then.
pub struct Done<T> {
    pub value: T,
    pub raised: Option<PyErr>,
}

/// Does the work on `threads` threads (0: one a core); `progress` is called with the share that is done.
pub fn work<T: Send>(
    py: Python<'_>,
    threads: usize,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Watcher) -> T + Send,
) -> PyResult<Done<T>> {
    let pool = pools::take(threads).map_err(|text| error::wrong(py, text, ""))?;
    let interrupt = Interrupt::new();
    let share = AtomicU64::new(0);
    let end = (Mutex::new(false), Condvar::new());
    thread::scope(|scope| {
        let ended = Ended(&end);
        let (interrupt, share) = (&interrupt, &share);
        let tell = move |done: f64| share.store(done.to_bits(), Ordering::Relaxed);
        let worker = scope.spawn(move || {
            let _ended = ended;
            pool.install(|| work(&Watcher { interrupt, progress: &tell }))
        });
        let mut raised = None;
        let mut told = 0;
        while !py.detach(|| wait(&end)) {
            let now = share.load(Ordering::Relaxed);
            let news = progress.filter(|_| now != told);
            told = now;
            let told = news.map_or(Ok(()), |progress| progress.call1((f64::from_bits(now),)).map(|_| ()));
            if let Err(error) = py.check_signals().and(told) {
                interrupt.ask();
                raised.get_or_insert(error);
            }
        }
        match py.detach(|| worker.join()) {
            Ok(value) => Ok(Done { value, raised }),
            Err(panic) => std::panic::resume_unwind(panic),
        }
    })
}

/// Says that the work has ended, however it did.
struct Ended<'a>(&'a (Mutex<bool>, Condvar));

impl Drop for Ended<'_> {
    fn drop(&mut self) {
        *self.0.0.lock().unwrap_or_else(PoisonError::into_inner) = true;
        self.0.1.notify_all();
    }
}

/// Waits a moment; says whether the work has ended.
fn wait(end: &(Mutex<bool>, Condvar)) -> bool {
    let ended = end.0.lock().unwrap_or_else(PoisonError::into_inner);
    let waited = end.1.wait_timeout_while(ended, LOOK, |ended| !*ended);
    *waited.unwrap_or_else(PoisonError::into_inner).0
}
