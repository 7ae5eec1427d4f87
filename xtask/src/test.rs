//! All tests, with what they need.

use crate::shell::{cargo, cargo_path, command, root, run, succeeds};
use std::path::PathBuf;

/// Runs all tests of the workspace.
pub fn test() -> Result<(), String> {
    if succeeds(command(&cargo_path(), &["nextest", "--version"])) {
        cargo(&["nextest", "run", "--workspace"])?;
        cargo(&["test", "--workspace", "--doc", "--quiet"])?;
    } else {
        cargo(&["test", "--workspace", "--no-fail-fast"])?;
    }
    let Some(python) = python_with_vtk() else {
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

/// A Python that knows VTK: the system's, or one in an environment of our own under `target/`.
fn python_with_vtk() -> Option<PathBuf> {
    let knows = |python: &str| succeeds(command(python, &["-c", "import vtk"]));
    if knows("python3") {
        return Some("python3".into());
    }
    let home = root().join("target/vtk");
    let python = home.join("bin/python3");
    let path = python.to_str()?;
    if !knows(path) {
        run(command("python3", &["-m", "venv", home.to_str()?])).ok()?;
        run(command(path, &["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "vtk"])).ok()?;
    }
    knows(path).then_some(python)
}
