//! What needs more than Rust and a C compiler: the book, the browser, units for co-simulation, MPI, Slurm and Dask, Python. What is missing is said and skipped; `.ci/install`
//! installs it.

use crate::shell::cargo;
use crate::test::has_nextest;
use crate::{book, cluster, fmu, mpi, python};

/// All optional parts.
pub fn optional() -> Result<(), String> {
    mpi::mpi(&[])?;
    // Two thirds of the time of clusters are waiting.
    std::thread::scope(|scope| {
        let clusters = scope.spawn(|| cluster::cluster(&[]));
        book::book()?;
        // Tests that open pages say so where there is no browser, and pass.
        if has_nextest() {
            cargo(&["nextest", "run", "--workspace", "-E", "package(tsubu-view)"])?;
        } else {
            cargo(&["test", "--package", "tsubu-view"])?;
        }
        fmu::fmu(&[])?;
        python::python(&[])?;
        clusters.join().unwrap_or_else(|_| Err("the runs over Slurm and Dask have panicked".to_owned()))
    })
}
