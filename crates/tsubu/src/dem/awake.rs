//! Threads that wait for work with open eyes.
//!
//! A step has two short pieces of work for all threads, with a shorter one for a single thread between them. A thread that goes
//! to sleep in the gap is woken a tenth of a step later; so while steps are made, threads without work look for it.

use rayon::Yield;
use std::hint::spin_loop;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether somebody keeps threads awake. Runs side by side have work for every thread anyway, and two that each had the other
/// look for work would wait for each other.
static TAKEN: AtomicBool = AtomicBool::new(false);

/// Runs `work` on this thread, while other threads of its pool take their share of what it hands out without going to sleep:
/// no more of them than there are `shares`.
pub(super) fn awake<R: Send>(shares: usize, work: impl FnOnce() -> R + Send) -> R {
    if TAKEN.swap(true, Ordering::Acquire) {
        return work();
    }
    let done = &AtomicBool::new(false);
    rayon::scope(|scope| {
        let mine = rayon::current_thread_index();
        scope.spawn_broadcast(move |_, thread| {
            let useful = thread.index() < shares && Some(thread.index()) != mine;
            while useful && !done.load(Ordering::Relaxed) {
                if rayon::yield_now() != Some(Yield::Executed) {
                    spin_loop();
                }
            }
        });
        let _end = End(done);
        work()
    })
}

/// Lets the others sleep, however the work ends.
struct End<'a>(&'a AtomicBool);

impl Drop for End<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
        TAKEN.store(false, Ordering::Release);
    }
}
