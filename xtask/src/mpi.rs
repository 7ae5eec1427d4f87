//! One run on several ranks: the program with MPI, and its tests under `mpirun`.

use crate::shell::{cargo, on_path};
use crate::test::has_nextest;

/// Builds it and tests; says so where there is no MPI.
pub fn mpi(arguments: &[&str]) -> Result<(), String> {
    let missing: Vec<&str> = ["mpicc", "mpirun"].into_iter().filter(|program| !on_path(program)).collect();
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
    let which = ["--workspace", "--features", "tsubu-cli/mpi", "--test", "mpi"];
    cargo(&[run, &which, arguments].concat())
}
