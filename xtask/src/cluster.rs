//! Many runs on real clusters: Slurm and Dask are started on this machine, and their workers killed.

use crate::mpi;
use crate::python::{environment, recent};
use crate::shell::{command, program_with, root, run};

/// Starts them and tests; says so where there is no Python or no network. Where there is no Slurm, its tests say that they are skipped.
pub fn cluster(arguments: &[&str]) -> Result<(), String> {
    if !recent() {
        return skipped("there is no Python 3.10 or later with `venv`");
    }
    let tests = root().join("crates/tsubu-cli/tests/cluster");
    let requirements = tests.join("requirements.txt");
    let home = root().join("target/cluster-test");
    let Some(python) = environment(&home, &["-r", &requirements.to_string_lossy()]) else {
        return skipped("Dask cannot be installed: is there a network?");
    };
    let mut test = command(&python.to_string_lossy(), &["-m", "pytest", "--quiet", "-rs", "-p", "no:cacheprovider"]);
    // Without MPI the test of runs on several ranks says that it is skipped.
    let features: &[&str] = if mpi::missing().is_empty() { &mpi::FEATURES } else { &[] };
    // Other tests that run beside these build the program anew.
    let own = home.join("tsubu");
    std::fs::copy(program_with("tsubu", features)?, &own).map_err(|error| format!("{}: {error}", own.display()))?;
    test.env("TSUBU", own).args(arguments).arg(tests);
    run(test)
}

#[expect(clippy::unnecessary_wraps, reason = "how the chore ends there")]
fn skipped(why: &str) -> Result<(), String> {
    eprintln!("\nSKIPPED: runs over Slurm and Dask are not tested, for {why}");
    Ok(())
}
