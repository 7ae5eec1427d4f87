//! What needs more than Rust and a C compiler, or more patience: the book, the browser, Python, the slower of the quick verification
//! cases. What is missing is said and skipped; `.ci/install` installs it.

use crate::shell::cargo;
use crate::test::has_nextest;
use crate::{book, python};

/// All optional parts.
pub fn optional() -> Result<(), String> {
    book::book()?;
    // Tests that open pages say so where there is no browser, and pass.
    if has_nextest() {
        cargo(&["nextest", "run", "--workspace", "-E", "package(tsubu-view)"])?;
    } else {
        cargo(&["test", "--package", "tsubu-view"])?;
    }
    patient()?;
    python::python(&[])
}

/// The quick verification cases that the tests leave out for the time that they take.
fn patient() -> Result<(), String> {
    if has_nextest() {
        cargo(&["nextest", "run", "--workspace", "--run-ignored", "only", "-E", "binary(cases) & test(/^patient::/)"])
    } else {
        cargo(&["test", "--package", "tsubu-verify", "--test", "cases", "--", "--ignored", "patient::"])
    }
}
