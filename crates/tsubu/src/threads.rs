//! Threads that wait for work with open eyes.
//!
//! A step of many grains has two short pieces of work for all threads, with a shorter one for a single thread between them. A
//! thread that goes to sleep in the gap is woken a tenth of a step later; so while steps are made, threads without work look for
//! it. Only where one run has the threads for itself: with several in one pool, whoever waits for a thread of another run waits
//! for that run.

use rayon::Yield;
use rayon::prelude::*;
use std::hint::spin_loop;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// A thread that was away for so long between two looks shares its core with other programs, and goes to sleep as they do: on a
/// core that is shared, to look for work all the time takes from the time to do it.
const AWAY: Duration = Duration::from_millis(1);

/// How many pieces of work of this process are [`alone`] with their threads.
static ALONE: AtomicUsize = AtomicUsize::new(0);

/// Runs `work`, which makes one run at a time and has the threads of its pool for itself: the run may keep them awake between
/// its steps. Results are the same without.
pub fn alone<R>(work: impl FnOnce() -> R) -> R {
    ALONE.fetch_add(1, Ordering::Relaxed);
    let _end = Finally(|| _ = ALONE.fetch_sub(1, Ordering::Relaxed));
    work()
}

/// Runs `work` on this thread. Where a run is [`alone`], other threads of its pool take their share of what it hands out without
/// going to sleep: no more of them than there are `shares`.
pub(crate) fn awake<R: Send>(shares: usize, work: impl FnOnce() -> R + Send) -> R {
    if ALONE.load(Ordering::Relaxed) == 0 {
        return work();
    }
    let looking = &AtomicBool::new(true);
    rayon::scope(|scope| {
        let mine = rayon::current_thread_index();
        scope.spawn_broadcast(move |_, thread| {
            let useful = thread.index() < shares && Some(thread.index()) != mine;
            let mut looked = Instant::now();
            while useful && looking.load(Ordering::Relaxed) {
                let worked = rayon::yield_now() == Some(Yield::Executed);
                if !worked && looked.elapsed() > AWAY {
                    return;
                }
                looked = Instant::now();
                spin_loop();
            }
        });
        let _end = Finally(|| looking.store(false, Ordering::Relaxed));
        work()
    })
}

/// How long to look out for another thread before going to sleep: some times what a block of grains takes.
const LOOK_OUT: Duration = Duration::from_micros(200);

/// Does both, on two threads if there is another. Where a run is [`alone`], who is done first looks for work before it goes to
/// sleep: beside a program that keeps a core busy a step takes little more than half of the time so; on idle cores as long.
pub(crate) fn both(first: impl FnOnce() + Send, second: impl FnOnce() + Send) {
    if ALONE.load(Ordering::Relaxed) == 0 {
        rayon::join(first, second);
        return;
    }
    let done = &AtomicBool::new(false);
    let wait = || {
        let begun = Instant::now();
        // The second may still lie here: then this is who does it.
        while !done.load(Ordering::Acquire) && begun.elapsed() < LOOK_OUT {
            rayon::yield_now();
            spin_loop();
        }
    };
    let second = || {
        let _end = Finally(|| done.store(true, Ordering::Release));
        second();
    };
    rayon::join(|| (first(), wait()), second);
}

/// Fewer grains than this are not worth waking threads for.
pub const WORTH_THREADS: usize = 2000;

/// On how many threads so many grains are worth it.
pub fn shares(grains: usize) -> usize {
    if grains >= WORTH_THREADS { rayon::current_num_threads() } else { 1 }
}

/// How many of so many grains a thread does at a time, at least, where little is done to each.
pub(crate) fn piece(grains: usize) -> usize {
    if shares(grains) > 1 { 4096 } else { grains.max(1) }
}

/// Gives each place its value, on many threads.
pub(crate) fn fill<T: Send>(places: &mut [T], value: impl Fn(usize) -> T + Sync) {
    let piece = piece(places.len());
    places.par_chunks_mut(piece).enumerate().for_each(|(k, places)| {
        for (i, place) in (k * piece..).zip(places) {
            *place = value(i);
        }
    });
}

/// Does something to each of `things`, on many threads if there are several `shares`.
pub(crate) fn each<T: Send>(things: &mut [T], shares: usize, work: impl Fn(&mut T) + Sync + Send) {
    if shares > 1 {
        // One by one: a thread that is done early finds work as long as there is any.
        things.par_iter_mut().with_max_len(1).for_each(work);
    } else {
        things.iter_mut().for_each(work);
    }
}

/// The same in as many equal parts as there are `shares`, for things that are too small to be handed out one by one.
pub(crate) fn each_in_parts<T: Send>(things: &mut [T], shares: usize, work: &(impl Fn(&mut T) + Sync)) {
    if shares <= 1 || things.len() <= 1 {
        return things.iter_mut().for_each(work);
    }
    let left = shares / 2;
    let (first, others) = things.split_at_mut(things.len() * left / shares);
    both(|| each_in_parts(first, left, work), || each_in_parts(others, shares - left, work));
}

/// Does something when dropped, however the work before has ended.
struct Finally<F: Fn()>(F);

impl<F: Fn()> Drop for Finally<F> {
    fn drop(&mut self) {
        self.0();
    }
}
