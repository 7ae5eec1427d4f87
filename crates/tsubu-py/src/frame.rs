//! Frames: moments of a run as arrays.

use crate::{arrays, error};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use tsubu_cli::Failure;
use tsubu_frame::Kind;

/// One moment: columns with units.
#[pyclass(frozen, module = "tsubu._tsubu")]
pub struct Frame {
    pub frame: tsubu_frame::Frame,
}

#[pymethods]
impl Frame {
    /// Simulated time [s].
    #[getter]
    fn time(&self) -> f64 {
        self.frame.time
    }

    /// Number of the step.
    #[getter]
    fn step(&self) -> u64 {
        self.frame.step
    }

    /// The columns of a kind: name -> (array, unit).
    fn columns<'py>(&self, py: Python<'py>, kind: &str) -> PyResult<Bound<'py, PyDict>> {
        let columns = PyDict::new(py);
        for column in self.frame.of(kind_of(py, kind)?) {
            columns.set_item(column.name, (arrays::of_values(py, column.values.clone()), column.unit))?;
        }
        Ok(columns)
    }
}

fn kind_of(py: Python<'_>, name: &str) -> PyResult<Kind> {
    match name {
        "grains" => Ok(Kind::Grain),
        "contacts" => Ok(Kind::Contact),
        "cells" => Ok(Kind::Cell),
        "walls" => Ok(Kind::Surface),
        "globals" => Ok(Kind::Global),
        other => Err(error::wrong(py, format!("a frame has no `{other}`"), "")),
    }
}

/// Reads the frame that begins with a `.vtp` file of grains.
#[pyfunction]
pub fn read_frame(py: Python<'_>, path: PathBuf) -> PyResult<Frame> {
    let read = py.detach(|| tsubu_frame::read_frame(&path));
    read.map(|frame| Frame { frame }).map_err(|error| error::of(py, &Failure::of_file(&error, &path)))
}

/// Times and files of the frames in a run folder.
#[pyfunction]
pub fn snapshots(py: Python<'_>, folder: PathBuf) -> PyResult<Vec<(f64, PathBuf)>> {
    let found = tsubu_frame::snapshots(&folder).map_err(|error| error::of(py, &Failure::of_file(&error, &folder)))?;
    Ok(found.into_iter().map(|snapshot| (snapshot.time, snapshot.path)).collect())
}
