//! Ctrl-C: the first asks for a checkpoint, the second ends the program at once.

use std::sync::atomic::{AtomicBool, Ordering};

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Listens from now on for Ctrl-C (and a polite kill), and gives the mark that it sets.
pub fn listen() -> &'static AtomicBool {
    // It fails only if something listens already, and then there is nothing to do.
    let _ = ctrlc::set_handler(|| {
        if INTERRUPTED.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
        crate::output::tell("\nstopping at the next step; once more to stop at once\n");
    });
    &INTERRUPTED
}
