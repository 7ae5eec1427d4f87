//! The two streams: who sees colour there.

use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether nobody sees colour, whatever the streams lead to.
static PLAIN: AtomicBool = AtomicBool::new(false);

/// Whether texts may have colour from now on: they should not where who asks for them puts them elsewhere.
pub fn allow_colour(allowed: bool) {
    PLAIN.store(!allowed, Ordering::Relaxed);
}

/// Where a text goes.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Stream {
    /// Results.
    Data,
    /// Messages.
    Error,
}

impl Stream {
    /// Whether colour is wanted there: a terminal, and no `NO_COLOR` (no-color.org).
    pub fn colour(self) -> bool {
        let terminal = match self {
            Self::Data => std::io::stdout().is_terminal(),
            Self::Error => std::io::stderr().is_terminal(),
        };
        let refused = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
        let dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
        terminal && !PLAIN.load(Ordering::Relaxed) && !refused && !dumb
    }

    /// As rustc writes `error`.
    pub fn bold_red(self, text: &str) -> String {
        self.painted(text, "1;31")
    }

    /// For hints and headings.
    pub fn bold_cyan(self, text: &str) -> String {
        self.painted(text, "1;36")
    }

    /// For what is worth a look.
    pub fn yellow(self, text: &str) -> String {
        self.painted(text, "33")
    }

    /// For what is well.
    pub fn green(self, text: &str) -> String {
        self.painted(text, "32")
    }

    fn painted(self, text: &str, code: &str) -> String {
        if self.colour() { format!("\x1b[{code}m{text}\x1b[0m") } else { text.to_owned() }
    }
}
