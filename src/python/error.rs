//! From core errors to the exceptions of `drumrs.errors`.

use pyo3::exceptions::{PyMemoryError, PyOSError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::{Error, Incident, Value};

/// The Python exception for a core error. The classes live in Python, so that they pickle by name.
pub fn to_python(py: Python<'_>, error: &Error) -> PyErr {
    match error {
        Error::Memory { .. } => PyMemoryError::new_err(error.to_string()),
        Error::System { .. } => PyOSError::new_err(error.to_string()),
        _ => exception(py, error).unwrap_or_else(|failed| failed),
    }
}

/// An exception with the error's parts as its fields.
fn exception(py: Python<'_>, error: &Error) -> PyResult<PyErr> {
    let fields = PyDict::new(py);
    let class = match error {
        Error::Config { value, bound, .. } => {
            match value {
                Value::Number(number) => fields.set_item("value", number)?,
                Value::Count(count) => fields.set_item("value", count)?,
                Value::Text(text) => fields.set_item("value", text)?,
            }
            fields.set_item("bound", bound)?;
            "ConfigError"
        }
        Error::Packing { requested, fits, .. } => {
            fields.set_item("value", requested)?;
            fields.set_item("bound", fits)?;
            "ConfigError"
        }
        Error::StartOverlap { ratio, limit, .. } => {
            fields.set_item("value", ratio)?;
            fields.set_item("bound", limit)?;
            "ConfigError"
        }
        Error::NonFinite { incident } | Error::Escaped { incident, .. } => unstable(&fields, incident, None)?,
        Error::Overlap { incident, ratio, limit } => unstable(&fields, incident, Some((ratio, limit)))?,
        Error::TooFast { incident, displacement, limit } => {
            unstable(&fields, incident, Some((displacement, limit)))?
        }
        Error::Checkpoint { reason } => {
            fields.set_item("reason", reason)?;
            "CheckpointError"
        }
        Error::Memory { .. } | Error::System { .. } => unreachable!("these are exceptions of Python"),
    };
    if class != "CheckpointError" {
        fields.set_item("problem", error.problem())?;
        fields.set_item("hint", error.hint())?;
    }
    if let Some(key) = error.key() {
        fields.set_item("key", key)?;
        fields.set_item("limit", error.limit())?;
    }
    let instance = py.import("drumrs.errors")?.getattr(class)?.call((), Some(&fields))?;
    Ok(PyErr::from_value(instance))
}

/// Sets which bundle became unstable, when and where, and of some the value and its limit.
fn unstable(
    fields: &Bound<'_, PyDict>,
    incident: &Incident,
    beyond: Option<(&f64, &f64)>,
) -> PyResult<&'static str> {
    fields.set_item("bundle", incident.particle)?;
    fields.set_item("step", incident.step)?;
    fields.set_item("time", incident.time)?;
    fields.set_item("position", incident.position)?;
    fields.set_item("speed", incident.speed)?;
    if let Some((value, limit)) = beyond {
        fields.set_item("value", value)?;
        fields.set_item("limit", limit)?;
    }
    Ok("UnstableError")
}

/// So that `?` raises it, wherever the interpreter is held.
impl From<Error> for PyErr {
    fn from(error: Error) -> Self {
        Python::attach(|py| to_python(py, &error))
    }
}
