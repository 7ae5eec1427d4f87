//! The Python package: the wheel is built, installed into environments of its own, and tested.

use crate::shell::{command, root, run, succeeds};
use std::fs;
use std::path::{Path, PathBuf};

/// What builds the wheel.
const MATURIN: &str = "maturin>=1.9,<2";

/// Builds, installs and tests; says so where there is no Python or no network.
pub fn python(arguments: &[&str]) -> Result<(), String> {
    if !recent() {
        return skipped("there is no Python 3.10 or later with `venv`");
    }
    let target = root().join("target");
    let Some(builder) = environment(&target.join("python-build"), &[MATURIN]) else {
        return skipped("maturin cannot be installed: is there a network?");
    };
    let wheels = target.join("wheels");
    // What an earlier build has left would be taken for this one.
    let _ = fs::remove_dir_all(&wheels);
    let mut build = command(&text(&builder), &["-m", "maturin", "build", "--profile", "dev", "--locked", "--out"]);
    build.arg(wheels.canonicalize().unwrap_or(wheels.clone())).args(["--manifest-path", "crates/tsubu-py/Cargo.toml"]);
    run(build)?;
    let found = fs::read_dir(&wheels).map_err(|error| format!("cannot read {}: {error}", wheels.display()))?;
    let wheel = found.flatten().map(|entry| entry.path()).find(|path| path.extension().is_some_and(|e| e == "whl"));
    let wheel = text(&wheel.ok_or("maturin has built no wheel")?);

    bare(&target.join("python-bare"), &wheel)?;

    let tests = target.join("python-test");
    let requirements = text(&root().join("crates/tsubu-py/requirements-test.txt"));
    let Some(python) = environment(&tests, &["-r", &requirements]) else {
        return skipped("the packages that the tests need cannot be installed: is there a network?");
    };
    run(command(&text(&python), &["-m", "pip", "install", "--quiet", "--force-reinstall", "--no-deps", &wheel]))?;
    run(command(&text(&python), &["crates/tsubu-py/page.py", "--check"]))?;
    let mut test = command(&text(&python), &["-m", "pytest", "--quiet", "-p", "no:cacheprovider"]);
    test.args(arguments).arg("crates/tsubu-py/tests");
    run(test)
}

/// The wheel in an environment with nothing but what it asks for: module and program run there, without Rust.
fn bare(home: &Path, wheel: &str) -> Result<(), String> {
    let _ = fs::remove_dir_all(home);
    let python = environment(home, &[wheel]).ok_or("the wheel cannot be installed")?;
    let program = text(&home.join("bin/tsubu"));
    let scene = "import tsubu; sim = tsubu.template('drop').open().advance(steps=100); assert sim.time > 0";
    for (program, arguments) in [(&program, ["--version", ""]), (&text(&python), ["-c", scene])] {
        let arguments: Vec<&str> = arguments.into_iter().filter(|argument| !argument.is_empty()).collect();
        let mut command = command(program, &arguments);
        command.env("PATH", "/usr/bin:/bin").current_dir(home);
        run(command)?;
    }
    Ok(())
}

/// Whether there is a Python that is recent enough and can make environments.
pub fn recent() -> bool {
    let recent = "import sys, venv, ensurepip; assert sys.version_info >= (3, 10)";
    succeeds(command("python3", &["-c", recent]))
}

/// The Python of an environment that has these packages, made where it is not there.
pub fn environment(home: &Path, packages: &[&str]) -> Option<PathBuf> {
    let python = home.join("bin/python3");
    if !python.exists() {
        run(command("python3", &["-m", "venv", &text(home)])).ok()?;
    }
    let install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check"];
    run(command(&text(&python), &[&install[..], packages].concat())).ok()?;
    Some(python)
}

fn text(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}

#[expect(clippy::unnecessary_wraps, reason = "how the chore ends there")]
fn skipped(why: &str) -> Result<(), String> {
    eprintln!("\nSKIPPED: the Python package is neither built nor tested, for {why}");
    Ok(())
}
