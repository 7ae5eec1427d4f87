//! One run on several ranks: the program with MPI, and its tests under `mpirun`.

use crate::shell::{cargo, on_path};
use crate::test::has_nextest;

/// What turns it on.
pub const FEATURES: [&str; 2] = ["--features", "tsubu-cli/mpi"];

/// What of an MPI is not there.
pub fn missing() -> Vec<&'static str> {
    ["mpicc", "mpirun"].into_iter().filter(|program| !on_path(program)).collect()
}

/// Builds it and tests; says so where there is no MPI.
pub fn mpi(arguments: &[&str]) -> Result<(), String> {
    let missing = missing();
    if !missing.is_empty() {
        eprintln!(
            "\nSKIPPED: runs over MPI are not tested, for there is no {}: the packages are libopenmpi-dev, openmpi-bin (or libmpich-dev, mpich) and \
             libclang-dev",
            missing.join(", no ")
        );
        return Ok(());
    }
    // One test at a time: each has more ranks than there are cores.
    let run: &[&str] = if has_nextest() { &["nextest", "run", "--test-threads", "1"] } else { &["test"] };
    cargo(&[run, &["--workspace", "--test", "mpi"], &FEATURES, arguments].concat())
}
