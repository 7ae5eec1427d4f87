//! Errors: the texts of the program as an exception.

use pyo3::create_exception;
use pyo3::exceptions::PyException;
use pyo3::prelude::*;
use std::fmt::Display;
use tsubu_cli::Failure;

create_exception!(
    tsubu,
    Error,
    PyException,
    "What the program would say: message, place and hints as text; `code` is its exit code."
);

/// The exception that says what a failed command would.
pub fn of(py: Python<'_>, failure: &Failure) -> PyErr {
    let error = Error::new_err(failure.text().trim_end().to_owned());
    // An exception takes any attribute.
    let _ = error.value(py).setattr("code", failure.code());
    error
}

/// The same for what only Python can do wrong.
pub fn wrong(py: Python<'_>, message: impl Display, hint: &str) -> PyErr {
    let failure = Failure::wrong(message.to_string());
    of(py, &if hint.is_empty() { failure } else { failure.hint(hint.to_owned()) })
}
