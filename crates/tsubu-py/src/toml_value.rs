//! Values of Python as values of a scene.

use crate::error;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyString};
use toml::{Table, Value};

/// A value as a scene file would say it: text, numbers, truth, lists, tables; arrays of numpy are lists.
pub fn of(value: &Bound<'_, PyAny>) -> PyResult<Value> {
    if let Ok(flag) = value.cast::<PyBool>() {
        return Ok(Value::Boolean(flag.is_true()));
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(Value::String(text.extract()?));
    }
    if value.is_instance_of::<PyInt>() {
        return Ok(Value::Integer(value.extract()?));
    }
    if value.is_instance_of::<PyFloat>() {
        return Ok(Value::Float(value.extract()?));
    }
    if let Ok(table) = value.cast::<PyDict>() {
        return Ok(Value::Table(self::table(table)?));
    }
    if value.hasattr("tolist")? {
        return of(&value.call_method0("tolist")?);
    }
    let items = value.try_iter().map_err(|_| {
        let kind = value.get_type().name().map_or_else(|_| "this".to_owned(), |name| name.to_string());
        let hint = "a scene has text, numbers, true and false, lists and tables";
        error::wrong(value.py(), format!("`{kind}` is no value of a scene"), hint)
    })?;
    Ok(Value::Array(items.map(|item| of(&item?)).collect::<PyResult<_>>()?))
}

/// A dictionary as a table of a scene.
pub fn table(dictionary: &Bound<'_, PyDict>) -> PyResult<Table> {
    dictionary.iter().map(|(key, value)| Ok((key.str()?.extract()?, of(&value)?))).collect()
}
