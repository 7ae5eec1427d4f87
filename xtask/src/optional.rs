//! What needs more than Rust and a C compiler: the book, the browser, Python. What is missing is said and skipped; `.ci/install` installs it.

use crate::shell::{cargo, cargo_path, command, succeeds};
use crate::{book, python};

/// All optional parts.
pub fn optional() -> Result<(), String> {
    book::book()?;
    // A test that opens pages is in a module of this name. Without a browser it says so, and passes.
    if succeeds(command(&cargo_path(), &["nextest", "--version"])) {
        cargo(&["nextest", "run", "--workspace", "browser::"])?;
    } else {
        cargo(&["test", "--workspace", "browser::"])?;
    }
    python::python(&[])
}
