//! Printing: results to stdout, messages to stderr.

use crate::failure::Failure;
use std::io::{ErrorKind, Write};

/// Prints results. A reader that has gone away changes nothing: files are written and claims judged as ever.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Ok(()) => Ok(()),
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        Err(error) => Err(Failure::failed(format!("cannot write to stdout: {error}"))),
    }
}

/// Prints a message; whoever closed stderr does not want to hear about it.
pub fn tell(text: &str) {
    let _ = std::io::stderr().lock().write_all(text.as_bytes());
}

/// Prints why a command did not end well, and gives its exit code.
pub fn report(failure: &Failure) -> u8 {
    tell(&failure.text());
    failure.code()
}
