//! Between numpy arrays and the core's vectors. What leaves is handed over, not copied again.

use numpy::ndarray::{Array2, Array3};
use numpy::{
    Element, IntoPyArray, PyArray2, PyArray3, PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArrayDyn,
};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::engine::contacts::ContactRecord;
use crate::engine::forces::Lists;
use crate::error::Error;
use crate::observe::frames::Frames;
use crate::observe::memory;
use crate::physics::vector::Vec2;
use crate::simulation::initial_state::InitialState;

/// Vectors as an array of shape (n, 2).
pub fn vectors<'py>(py: Python<'py>, vectors: &[Vec2]) -> Bound<'py, PyArray2<f64>> {
    table_of_rows(py, vectors.iter().flat_map(|v| [v.x, v.y]).collect(), 2)
}

/// Rows of `width` values as an array of shape (rows, width).
pub fn table_of_rows<T: Element>(py: Python<'_>, values: Vec<T>, width: usize) -> Bound<'_, PyArray2<T>> {
    let rows = values.len().checked_div(width).unwrap_or(0);
    Array2::from_shape_vec((rows, width), values).expect("whole rows").into_pyarray(py)
}

/// Frames as a dict of arrays.
pub fn frames(py: Python<'_>, frames: Frames, count: usize) -> PyResult<Bound<'_, PyDict>> {
    let table = PyDict::new(py);
    table.set_item("time", frames.times.into_pyarray(py))?;
    table.set_item("drum_angle", frames.drum_angles.into_pyarray(py))?;
    table.set_item("positions", frame_vectors(py, frames.positions, count))?;
    table.set_item("angles", table_of_rows(py, frames.angles, count))?;
    table.set_item("velocities", frame_vectors(py, frames.velocities, count))?;
    table.set_item("contacts", table_of_rows(py, frames.contacts, count))?;
    Ok(table)
}

/// The frames in what `frames` gave.
///
/// # Errors
/// `Error::Config` naming the array that is none of the kind, `Error::Memory` where there is no room for a copy.
pub fn given_frames(table: &Bound<'_, PyDict>) -> Result<Frames, Error> {
    Ok(Frames {
        times: copied(table, "time")?,
        drum_angles: copied(table, "drum_angle")?,
        positions: copied(table, "positions")?,
        angles: copied(table, "angles")?,
        velocities: copied(table, "velocities")?,
        contacts: copied(table, "contacts")?,
    })
}

fn copied<T: Element + Copy>(table: &Bound<'_, PyDict>, key: &str) -> Result<Vec<T>, Error> {
    let wrong = || Error::config(format!("frames.{key}"), "something else", "an array of numbers in a row");
    let item = table.get_item(key).ok().flatten().ok_or_else(wrong)?;
    let array: PyReadonlyArrayDyn<T> = item.extract().map_err(|_| wrong())?;
    let values = array.as_slice().map_err(|_| wrong())?;
    let mut copy = Vec::new();
    memory::reserve(&mut copy, values.len(), "putting frames back")?;
    copy.extend_from_slice(values);
    Ok(copy)
}

/// Vectors as an array of shape (frames, particles, 2).
fn frame_vectors(py: Python<'_>, values: Vec<f32>, count: usize) -> Bound<'_, PyArray3<f32>> {
    let rows = values.len().checked_div(2 * count).unwrap_or(0);
    Array3::from_shape_vec((rows, count, 2), values).expect("whole frames").into_pyarray(py)
}

/// The initial state in a dict of arrays.
pub fn initial_state(state: &Bound<'_, PyDict>) -> Result<InitialState, Error> {
    let mut initial = InitialState::default();
    for (key, value) in state.iter() {
        let name = key.to_string();
        let key = &format!("state.{name}");
        match name.as_str() {
            "positions" => initial.positions = points(key, &value)?,
            "velocities" => initial.velocities = Some(points(key, &value)?),
            "angles" => initial.angles = Some(column(key, &value)?),
            "angular_velocities" => initial.angular_velocities = Some(column(key, &value)?),
            "radii" => initial.radii = Some(column(key, &value)?),
            "species" => initial.species = Some(column(key, &value)?),
            "drum_angle" => {
                initial.drum_angle = value
                    .extract()
                    .map_err(|_| Error::config("state.drum_angle", "something else", "a number"))?;
            }
            "contacts" => {
                initial.contacts = Lists {
                    pairs: records("state.contacts.pairs", &value, "pairs")?,
                    walls: records("state.contacts.walls", &value, "walls")?,
                    ..Lists::default()
                };
            }
            _ => {
                let known = "positions, velocities, angles, angular_velocities, radii, species, drum_angle or contacts";
                return Err(Error::config("a field of the state", name, known));
            }
        }
    }
    Ok(initial)
}

fn points(key: &str, value: &Bound<'_, PyAny>) -> Result<Vec<Vec2>, Error> {
    Ok(rows(key, value)?.into_iter().map(Vec2::from).collect())
}

fn column<T: Element + Copy>(key: &str, value: &Bound<'_, PyAny>) -> Result<Vec<T>, Error> {
    let array: PyReadonlyArray1<T> = value
        .extract()
        .map_err(|_| Error::config(key, "something else", "an array of numbers of shape (n,)"))?;
    Ok(array.as_array().to_vec())
}

/// Rows of `N` numbers.
fn rows<const N: usize>(key: &str, value: &Bound<'_, PyAny>) -> Result<Vec<[f64; N]>, Error> {
    let wrong = || Error::config(key, "something else", format!("an array of floats of shape (n, {N})"));
    let array: PyReadonlyArray2<f64> = value.extract().map_err(|_| wrong())?;
    let array = array.as_array();
    if array.ncols() != N {
        return Err(wrong());
    }
    Ok(array.rows().into_iter().map(|row| std::array::from_fn(|k| row[k])).collect())
}

/// Contacts as a dict of arrays, one for each field of a record.
pub fn contact_table<'py>(py: Python<'py>, records: &[ContactRecord]) -> PyResult<Bound<'py, PyDict>> {
    fn grid<'py, const N: usize>(
        py: Python<'py>,
        records: &[ContactRecord],
        value: fn(&ContactRecord) -> [f64; N],
    ) -> Bound<'py, PyArray2<f64>> {
        table_of_rows(py, records.iter().flat_map(value).collect(), N)
    }
    let ids = |value: fn(&ContactRecord) -> u32| records.iter().map(value).collect::<Vec<_>>();
    let floats = |value: fn(&ContactRecord) -> f64| records.iter().map(value).collect::<Vec<_>>();
    let table = PyDict::new(py);
    table.set_item("particle", ids(|record| record.particle).into_pyarray(py))?;
    table.set_item("other", ids(|record| record.other).into_pyarray(py))?;
    table.set_item("overlap", floats(|record| record.overlap).into_pyarray(py))?;
    table.set_item("separation_rate", floats(|record| record.separation_rate).into_pyarray(py))?;
    table.set_item("force", grid(py, records, |record| record.force))?;
    table.set_item("moments", grid(py, records, |record| record.moments))?;
    table.set_item("history", grid(py, records, |record| record.history))?;
    Ok(table)
}

/// The contacts of one kind in what `contact_table` gave, by kind.
fn records(key: &str, contacts: &Bound<'_, PyAny>, kind: &str) -> Result<Vec<ContactRecord>, Error> {
    let wrong = || Error::config(key, "something else", "the contacts of a simulation's state");
    let table = contacts.get_item(kind).map_err(|_| wrong())?;
    let field = |name: &str| table.get_item(name).map_err(|_| wrong());
    let particle: Vec<u32> = column(key, &field("particle")?)?;
    let other: Vec<u32> = column(key, &field("other")?)?;
    let overlap: Vec<f64> = column(key, &field("overlap")?)?;
    let separation_rate: Vec<f64> = column(key, &field("separation_rate")?)?;
    let force = rows(key, &field("force")?)?;
    let moments = rows(key, &field("moments")?)?;
    let history = rows(key, &field("history")?)?;
    let count = particle.len();
    let lengths =
        [other.len(), overlap.len(), separation_rate.len(), force.len(), moments.len(), history.len()];
    if lengths.iter().any(|&length| length != count) {
        return Err(Error::config(key, "of several lengths", "of one length"));
    }
    let record = |k: usize| ContactRecord {
        particle: particle[k],
        other: other[k],
        overlap: overlap[k],
        separation_rate: separation_rate[k],
        force: force[k],
        moments: moments[k],
        history: history[k],
    };
    Ok((0..count).map(record).collect())
}
