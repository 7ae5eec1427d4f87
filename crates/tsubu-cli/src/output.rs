//! Printing: results to stdout, messages to stderr, colour only where someone can see it.

use crate::failure::Failure;
use std::io::{ErrorKind, IsTerminal, Write};

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
        terminal && !refused && !dumb
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

/// Prints results. A reader that has gone away ends the command without a fuss.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Ok(()) => Ok(()),
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Err(Failure::nobody_reads()),
        Err(error) => Err(Failure::failed(format!("cannot write to stdout: {error}"))),
    }
}

/// Prints a message; whoever closed stderr does not want to hear about it.
pub fn tell(text: &str) {
    let _ = std::io::stderr().lock().write_all(text.as_bytes());
}
