//! Columns as arrays.

use glam::DVec3;
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArrayDyn, PyArrayMethods};
use pyo3::prelude::*;
use tsubu_frame::Values;

/// An array of its own with the numbers of a column.
pub fn of_values(py: Python<'_>, values: Values) -> Bound<'_, PyAny> {
    match values {
        Values::Scalar(values) => values.into_pyarray(py).into_any(),
        Values::Integer(values) => values.into_pyarray(py).into_any(),
        Values::Vector(rows) => rows_of(py, rows.len(), 3, rows.into_flattened()),
        Values::Quaternion(rows) => rows_of(py, rows.len(), 4, rows.into_flattened()),
    }
}

/// The same for vectors of the engine.
pub fn of_vectors<'py>(py: Python<'py>, vectors: &[DVec3]) -> Bound<'py, PyAny> {
    rows_of(py, vectors.len(), 3, vectors.iter().flat_map(DVec3::to_array).collect())
}

fn rows_of(py: Python<'_>, rows: usize, width: usize, flat: Vec<f64>) -> Bound<'_, PyAny> {
    match Array2::from_shape_vec((rows, width), flat) {
        Ok(array) => array.into_pyarray(py).into_any(),
        // As many numbers as rows and width make: it does not happen.
        Err(_) => PyArray1::from_vec(py, Vec::<f64>::new()).into_any(),
    }
}

/// Puts three numbers a row, one row a grain, into a column, from anything that numpy can make an array of; one row alone is meant for
/// all grains.
pub fn vectors(value: &Bound<'_, PyAny>, rows: usize, what: &str, column: &mut Vec<DVec3>) -> PyResult<()> {
    let py = value.py();
    let array = py.import("numpy")?.call_method1("ascontiguousarray", (value, "float64"))?;
    let array = array.cast_into::<PyArrayDyn<f64>>()?;
    let shape = numpy::PyUntypedArrayMethods::shape(&array).to_vec();
    let read = array.readonly();
    let flat = read.as_slice()?;
    column.clear();
    match shape.as_slice() {
        [3] => column.resize(rows, DVec3::from_slice(flat)),
        [given, 3] if *given == rows => column.extend(flat.chunks_exact(3).map(DVec3::from_slice)),
        _ => {
            let text = format!("{what} have the shape {shape:?}, and there are {rows} grains");
            return Err(crate::error::wrong(py, text, &format!("give an array of the shape ({rows}, 3), or None")));
        }
    }
    // All of them: a loop that may end early is slower.
    if flat.iter().fold(true, |finite, number| finite & number.is_finite()) {
        return Ok(());
    }
    let at = column.iter().position(|vector| !vector.is_finite()).unwrap_or_default();
    let text = format!("{what}: row {at} is not a number");
    Err(crate::error::wrong(py, text, "every force and torque is a finite number"))
}
