//! Means over windows and their errors (`observe::averages`), and summaries, for `drumrs.analysis`: a mean is a pair of its value and its
//! `BlockError`, which is a tuple of error, correlation time and number of blocks.

#![allow(clippy::needless_pass_by_value)] // Arguments from Python arrive by value.

use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::error::to_python;
use crate::error::Error;
use crate::observe::averages::{self, BlockError, Mean};
use crate::observe::recorder::{Recording, Series, columns};
use crate::observe::summary::{Statistic, summarize};

type Column<'py> = PyReadonlyArray1<'py, f64>;
type ErrorTuple = (f64, f64, usize);
type MeanTuple = (f64, Option<ErrorTuple>);

/// The rows nearest to the start and the end of a window [s].
#[pyfunction]
pub fn window(py: Python<'_>, times: Column<'_>, start: f64, end: f64) -> PyResult<(usize, usize)> {
    averages::window(times.as_slice()?, start, end).ok_or_else(|| {
        let limit = "an interval that holds at least two samples of the run";
        to_python(py, &Error::config("window", format!("[{start}, {end}]"), limit))
    })
}

/// The standard error of the mean of correlated samples.
#[pyfunction]
pub fn block_error(values: Column<'_>, interval: f64) -> PyResult<Option<ErrorTuple>> {
    Ok(BlockError::of(values.as_slice()?, interval).map(error_tuple))
}

/// The mean rate of a cumulative column.
#[pyfunction]
pub fn mean_rate(times: Column<'_>, cumulative: Column<'_>) -> PyResult<MeanTuple> {
    Ok(mean_tuple(averages::mean_rate(times.as_slice()?, cumulative.as_slice()?)))
}

/// The ratio of the mean rates of two cumulative columns.
#[pyfunction]
pub fn mean_ratio(
    times: Column<'_>,
    numerator: Column<'_>,
    denominator: Column<'_>,
) -> PyResult<Option<MeanTuple>> {
    let ratio = averages::mean_ratio(times.as_slice()?, numerator.as_slice()?, denominator.as_slice()?);
    Ok(ratio.map(mean_tuple))
}

/// The mean of samples at equal intervals.
#[pyfunction]
pub fn mean_sampled(samples: Column<'_>, interval: f64) -> PyResult<MeanTuple> {
    Ok(mean_tuple(averages::mean_sampled(samples.as_slice()?, interval)))
}

/// The summary of the samples of a part of a run: rows of the series of a drum with these parts, and the mass of the load
/// [kg/m].
#[pyfunction]
pub fn summary<'py>(
    py: Python<'py>,
    parts: Vec<String>,
    record_gross_work: bool,
    rows: PyReadonlyArray2<'py, f64>,
    mass: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let record = record_gross_work.then_some(Recording::GrossWork);
    let mut series = Series::new(columns(&parts, record.as_slice()));
    let values = rows.as_slice()?;
    let is_whole = rows.as_array().ncols() == series.width();
    let times: Vec<f64> = values.iter().step_by(series.width()).copied().collect();
    let (Some(&start), Some(&end), true) = (times.first(), times.last(), is_whole) else {
        let limit = format!("at least two rows of {} columns", series.width());
        return Err(to_python(py, &Error::config("series", format!("{:?}", rows.as_array().dim()), limit)));
    };
    series.prepend(values)?;
    dictionary(py, summarize(&series, mass, start, end)?)
}

/// A summary as a dict.
pub fn dictionary(py: Python<'_>, statistics: Vec<Statistic>) -> PyResult<Bound<'_, PyDict>> {
    let summary = PyDict::new(py);
    for (name, value) in statistics {
        summary.set_item(name, value)?;
    }
    Ok(summary)
}

fn mean_tuple(mean: Mean) -> MeanTuple {
    (mean.value, mean.spread.map(error_tuple))
}

fn error_tuple(spread: BlockError) -> ErrorTuple {
    (spread.error, spread.correlation_time, spread.blocks)
}
