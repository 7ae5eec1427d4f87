//! The worker: judges case after case and says what came of each, a line a case.

use crate::bundle::Bundle;
use crate::kind::Kind;
use crate::outcome::Outcome;
use std::io::{self, Write};
use std::ops::Range;
use std::panic::{self, AssertUnwindSafe, PanicHookInfo};
use std::path::Path;
use std::sync::{Mutex, PoisonError};

/// Judges the cases of a range in a folder. Lines are `accepted`, `refused` or `found` and what was found, in JSON.
pub fn work(kind: Kind, folder: &Path, seed: u64, cases: Range<u64>) -> io::Result<()> {
    cases.into_iter().try_for_each(|number| judge(kind, folder, &kind.draw(seed, number)))
}

/// The same for one case.
pub fn judge(kind: Kind, folder: &Path, bundle: &Bundle) -> io::Result<()> {
    panic::set_hook(Box::new(remember));
    let line = match survive(kind, bundle, folder) {
        Ok(Outcome::Accepted) => "accepted\n".to_owned(),
        Ok(Outcome::Refused) => "refused\n".to_owned(),
        Err(text) => format!("found {}\n", serde_json::Value::String(text)),
    };
    // Whole lines at once: whoever reads must not wait for the other half of one.
    io::stdout().write_all(line.as_bytes())?;
    io::stdout().flush()
}

/// A panic is what went wrong.
fn survive(kind: Kind, bundle: &Bundle, folder: &Path) -> Result<Outcome, String> {
    panic::catch_unwind(AssertUnwindSafe(|| kind.judge(bundle, folder))).unwrap_or_else(|_| {
        let mut last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
        Err(last.take().unwrap_or_else(|| "panic".to_owned()))
    })
}

/// What the last panic said, and where.
static LAST: Mutex<Option<String>> = Mutex::new(None);

/// Keeps the text of a panic instead of printing it.
fn remember(panic: &PanicHookInfo<'_>) {
    let mut last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
    *last = Some(panic.to_string());
}
