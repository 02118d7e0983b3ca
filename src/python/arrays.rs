//! Between numpy arrays and the core's vectors. What leaves is handed over, not copied again.

use numpy::ndarray::{Array2, Array3};
use numpy::{IntoPyArray, PyArray2, PyArray3, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::Error;
use crate::physics::vector::Vec2;
use crate::simulation::initial_state::InitialState;

/// Vectors as an array of shape (n, 2).
pub fn vectors<'py>(py: Python<'py>, vectors: &[Vec2]) -> Bound<'py, PyArray2<f64>> {
    let flat: Vec<f64> = vectors.iter().flat_map(|v| [v.x, v.y]).collect();
    let array = Array2::from_shape_vec((vectors.len(), 2), flat);
    array.expect("two numbers a vector").into_pyarray(py)
}

/// Values as an array of shape (frames, particles).
pub fn frames(py: Python<'_>, values: Vec<f32>, count: usize) -> Bound<'_, PyArray2<f32>> {
    let rows = values.len().checked_div(count).unwrap_or(0);
    Array2::from_shape_vec((rows, count), values).expect("whole frames").into_pyarray(py)
}

/// Positions as an array of shape (frames, particles, 2).
pub fn frame_positions(py: Python<'_>, values: Vec<f32>, count: usize) -> Bound<'_, PyArray3<f32>> {
    let rows = values.len().checked_div(2 * count).unwrap_or(0);
    Array3::from_shape_vec((rows, count, 2), values).expect("whole frames").into_pyarray(py)
}

/// The initial state in a dict of arrays.
///
/// # Errors
/// `Error::Config` naming the field that is unknown or of the wrong shape.
pub fn initial_state(state: &Bound<'_, PyDict>) -> Result<InitialState, Error> {
    let mut initial = InitialState::default();
    for (key, value) in state.iter() {
        let name = key.to_string();
        match name.as_str() {
            "positions" => initial.positions = pairs(&name, &value)?,
            "velocities" => initial.velocities = Some(pairs(&name, &value)?),
            "angles" => initial.angles = Some(numbers(&name, &value)?),
            "angular_velocities" => initial.angular_velocities = Some(numbers(&name, &value)?),
            "radii" => initial.radii = Some(numbers(&name, &value)?),
            _ => {
                let known = "positions, velocities, angles, angular_velocities or radii";
                return Err(Error::config("a field of the state", name, known));
            }
        }
    }
    Ok(initial)
}

fn pairs(name: &str, value: &Bound<'_, PyAny>) -> Result<Vec<Vec2>, Error> {
    let wrong =
        || Error::config(format!("state.{name}"), "something else", "an array of floats of shape (n, 2)");
    let array: PyReadonlyArray2<f64> = value.extract().map_err(|_| wrong())?;
    if array.as_array().ncols() != 2 {
        return Err(wrong());
    }
    Ok(array.as_array().rows().into_iter().map(|row| Vec2::new(row[0], row[1])).collect())
}

fn numbers(name: &str, value: &Bound<'_, PyAny>) -> Result<Vec<f64>, Error> {
    let array: PyReadonlyArray1<f64> = value.extract().map_err(|_| {
        Error::config(format!("state.{name}"), "something else", "an array of floats of shape (n,)")
    })?;
    Ok(array.as_array().to_vec())
}
