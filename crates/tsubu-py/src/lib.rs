//! The door to Python: the module `tsubu._tsubu`, which the package `tsubu` is written on.
//!
//! It opens scenes, moves them, and hands out numbers. Texts, tables and plots are Python: `python/tsubu`. It only calls the other
//! crates; none calls it. Arrays of grains lie in the memory of the engine, see `lease.rs`.

#![allow(clippy::needless_pass_by_value, reason = "what Python hands over is made for the call and belongs to it")]

mod arrays;
mod error;
mod forces;
mod frame;
mod lease;
mod pools;
mod scene;
mod simulation;
mod studies;
mod toml_value;
mod work;

use pyo3::prelude::*;
use std::ffi::OsString;

/// What the package `tsubu` is written on.
#[pymodule]
mod _tsubu {
    use pyo3::prelude::*;

    #[pymodule_export]
    use crate::error::Error;
    #[pymodule_export]
    use crate::frame::{Frame, read_frame, snapshots};
    #[pymodule_export]
    use crate::main;
    #[pymodule_export]
    use crate::scene::Scene;
    #[pymodule_export]
    use crate::simulation::Simulation;
    #[pymodule_export]
    use crate::studies::{report, templates, verify};

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        // Texts of errors end in exceptions, wherever stderr leads to.
        tsubu_cli::allow_colour(false);
        // Of errors that Python raises; the program's have their own.
        module.py().get_type::<Error>().setattr("code", 2)?;
        module.add("__version__", tsubu::VERSION)
    }
}

/// Runs the program with these words, the name of the program first, and gives its exit code.
#[pyfunction]
fn main(py: Python<'_>, line: Vec<OsString>) -> u8 {
    tsubu_cli::allow_colour(true);
    py.detach(|| tsubu_cli::run(line))
}
