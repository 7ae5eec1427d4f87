//! The wish of whoever started the work that it stop.
//!
//! Work asks now and then whether it is to stop, at least once a step. What takes longer than a moment without asking (placing
//! grains, settling them, drawing) has nothing to lose: a program may just end then. It must not as long as somebody
//! [holds](Interrupt::hold) a state that is not saved yet.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Whoever started the work: may stop it, wants to see it move.
pub struct Watcher<'a> {
    /// Asked, and a run writes a checkpoint and stops.
    pub interrupt: &'a Interrupt,
    /// Called now and then with the share that is done, 0 to 1.
    pub progress: &'a (dyn Fn(f64) + Sync),
}

impl Watcher<'_> {
    /// The same for a run among many, whose progress nobody looks at.
    pub(crate) fn quiet(&self) -> Watcher<'_> {
        Watcher { interrupt: self.interrupt, progress: &|_| {} }
    }
}

/// Set from outside, for example by Ctrl-C.
#[derive(Debug, Default)]
pub struct Interrupt {
    asked: AtomicBool,
    held: AtomicUsize,
}

impl Interrupt {
    /// Nobody has asked yet.
    pub const fn new() -> Self {
        Self { asked: AtomicBool::new(false), held: AtomicUsize::new(0) }
    }

    /// Asks for the end; says whether that was asked before.
    pub fn ask(&self) -> bool {
        self.asked.swap(true, Ordering::Relaxed)
    }

    /// Whether the work is to stop.
    pub fn asked(&self) -> bool {
        self.asked.load(Ordering::Relaxed)
    }

    /// Says that there is a state that will be saved before this is dropped.
    pub fn hold(&self) -> Held<'_> {
        self.held.fetch_add(1, Ordering::SeqCst);
        Held(self)
    }

    /// Whether there is a state that is not saved yet.
    pub fn is_held(&self) -> bool {
        self.held.load(Ordering::SeqCst) > 0
    }
}

/// A state that will be saved.
#[derive(Debug)]
pub struct Held<'a>(&'a Interrupt);

impl Drop for Held<'_> {
    fn drop(&mut self) {
        self.0.held.fetch_sub(1, Ordering::SeqCst);
    }
}
