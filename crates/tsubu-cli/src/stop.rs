//! Ctrl-C, and a polite kill: the first asks whoever has a state to save it, the second ends the program at once.

use crate::output;
use std::process::exit;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, OnceLock};
use std::thread;
use std::time::Duration;
use tsubu::interrupt::Interrupt;

static INTERRUPT: Interrupt = Interrupt::new();

/// What to say where the program has to end by itself.
static WORDS: OnceLock<String> = OnceLock::new();

/// What to say where a command without a state ends.
static SO_FAR: Mutex<String> = Mutex::new(String::new());

/// Whether all is done, and only looked at.
static DONE: AtomicBool = AtomicBool::new(false);

/// Said where a run is asked to stop that has not begun.
pub const NOT_BEGUN: &str = "interrupted before time 0; nothing was computed";

/// How long those have who stop by themselves.
const GRACE: Duration = Duration::from_millis(1500);

const INTERRUPTED: i32 = 130;

/// Listens from now on. A command that has not asked for [`interrupt`] ends at once.
pub fn listen() {
    // It fails only if something listens already, and then there is nothing to do.
    let _ = ctrlc::set_handler(|| {
        let again = INTERRUPT.ask();
        match WORDS.get() {
            _ if DONE.load(Ordering::Relaxed) => {}
            Some(_) if again => exit(INTERRUPTED),
            Some(words) => {
                output::tell("\nstopping at the next step; once more to stop at once\n");
                // The handler must be free for the second signal.
                thread::spawn(move || end(words));
            }
            None => {
                let so_far = SO_FAR.lock().map(|text| text.clone()).unwrap_or_default();
                output::tell(&format!("\ninterrupted{so_far}\n"));
                exit(INTERRUPTED);
            }
        }
    });
}

/// The mark that is set then, for commands that stop by themselves; `words` are said where that takes too long. It never takes a
/// state that is not saved.
pub fn interrupt(words: &str) -> &'static Interrupt {
    WORDS.get_or_init(|| words.to_owned());
    &INTERRUPT
}

/// From now on there is nothing to save: the command ends by itself when it is asked to, with the exit code that it has.
pub fn nothing_to_save() {
    DONE.store(true, Ordering::Relaxed);
}

/// Whether the end was asked for.
pub fn is_asked() -> bool {
    INTERRUPT.asked()
}

/// How far a command has come that has no state to save, to be said behind "interrupted".
pub fn so_far(text: String) {
    if let Ok(mut so_far) = SO_FAR.lock() {
        *so_far = text;
    }
}

fn end(words: &str) {
    thread::sleep(GRACE);
    while INTERRUPT.is_held() {
        thread::sleep(Duration::from_millis(10));
    }
    output::tell(&format!("{words}\n"));
    exit(INTERRUPTED);
}
