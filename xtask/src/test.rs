//! All tests, with what they need.

use crate::shell::{cargo, cargo_path, command, python_with, run, succeeds};

/// Whether cargo has nextest, which runs the tests of all crates side by side.
pub fn has_nextest() -> bool {
    succeeds(command(&cargo_path(), &["nextest", "--version"]))
}

/// Runs the tests of the workspace, but for those that need patience or a browser: after an edit, all that are left take two minutes.
pub fn test() -> Result<(), String> {
    // What opens pages in a browser says that it is skipped.
    let without_browser = |arguments: &[&str]| {
        let mut tests = command(&cargo_path(), arguments);
        tests.env("TSUBU_BROWSER", "none");
        run(tests)
    };
    if has_nextest() {
        without_browser(&["nextest", "run", "--workspace"])?;
        cargo(&["test", "--workspace", "--doc", "--quiet"])?;
    } else {
        without_browser(&["test", "--workspace", "--no-fail-fast"])?;
    }
    let Some(python) = python_with("vtk", "import vtk") else {
        eprintln!("\nskipped: reading frames back with VTK, for want of a Python 3 with the package vtk");
        return Ok(());
    };
    let mut read = command(
        &cargo_path(),
        &["test", "--workspace", "--test", "main", "--quiet", "--", "--ignored", "vtk_reads_every_snapshot"],
    );
    read.env("TSUBU_VTK_PYTHON", python);
    run(read)
}

/// Runs the tests of modules named `patient`, which take from five seconds to a minute each.
pub fn patient() -> Result<(), String> {
    if has_nextest() {
        cargo(&["nextest", "run", "--workspace", "--run-ignored", "only", "-E", "test(/\\bpatient::/)"])
    } else {
        cargo(&["test", "--workspace", "--no-fail-fast", "--", "--ignored", "patient::"])
    }
}
