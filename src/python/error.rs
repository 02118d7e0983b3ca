//! From core errors to the exceptions of `drumrs.errors`.

use pyo3::exceptions::{PyMemoryError, PyOSError};
use pyo3::prelude::*;

use crate::error::Error;

/// The Python exception for a core error. The classes live in Python, so that they pickle by name.
pub fn to_python(py: Python<'_>, error: &Error) -> PyErr {
    let class = match error {
        Error::Config { .. } | Error::Packing { .. } | Error::StartOverlap { .. } => "ConfigError",
        Error::NonFinite { .. } | Error::Overlap { .. } | Error::Escaped { .. } | Error::TooFast { .. } => {
            "UnstableError"
        }
        Error::Checkpoint { .. } => "CheckpointError",
        Error::Memory { .. } => return PyMemoryError::new_err(error.to_string()),
        Error::System { .. } => return PyOSError::new_err(error.to_string()),
    };
    let instance = py
        .import("drumrs.errors")
        .and_then(|errors| errors.getattr(class))
        .and_then(|class| class.call1((error.to_string(),)));
    match instance {
        Ok(instance) => PyErr::from_value(instance),
        Err(failed) => failed,
    }
}

/// So that `?` raises it, wherever the interpreter is held.
impl From<Error> for PyErr {
    fn from(error: Error) -> Self {
        Python::attach(|py| to_python(py, &error))
    }
}
