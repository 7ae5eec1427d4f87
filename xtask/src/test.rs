//! All tests, with what they need.

use crate::shell::{cargo, cargo_path, command, python_with, run, succeeds};

/// Whether cargo has nextest, which runs the tests of all crates side by side.
pub fn has_nextest() -> bool {
    succeeds(command(&cargo_path(), &["nextest", "--version"]))
}

/// Runs the tests of the workspace.
pub fn test() -> Result<(), String> {
    if has_nextest() {
        cargo(&["nextest", "run", "--workspace"])?;
        cargo(&["test", "--workspace", "--doc", "--quiet"])?;
    } else {
        cargo(&["test", "--workspace", "--no-fail-fast"])?;
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
