//! Records of contacts, and what is summed up by place, as numpy arrays.

use numpy::{Element, IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::arrays::table_of_rows;
use crate::error::Error;
use crate::observe::contact_rows::ContactRow;
use crate::observe::fields::{FIELD_WIDTH, FieldGrid, FieldSums};
use crate::observe::visits::Visits;
use crate::physics::columns::Columns;
use crate::physics::contact::Flows;
use crate::physics::drum::bins::ArcBin;
use crate::physics::energy::Sum;
use crate::simulation::Simulation as Core;
use crate::simulation::contact_log::{ContactLog, DiscAccount, PROFILE_WIDTH, by_direction};

/// The numbers of a row, in the order of their names below.
const NUMBERS: [fn(&ContactRow) -> f64; 8] = [
    |row| row.dissipated[0],
    |row| row.dissipated[1],
    |row| row.dissipated[2],
    |row| row.speeds[0],
    |row| row.speeds[1],
    |row| row.greatest_force,
    |row| row.point[0],
    |row| row.point[1],
];
const NAMES: [&str; 8] = [
    "dissipated_normal",
    "dissipated_tangential",
    "dissipated_rolling",
    "normal_speed",
    "tangential_speed",
    "greatest_force",
    "x",
    "y",
];

/// Contacts as a dict of arrays, with the drum's angle when each opened [rad].
///
/// # Errors
/// What Python answers.
pub fn contacts<'py>(
    py: Python<'py>,
    rows: &[ContactRow],
    drum_angles: Vec<f64>,
) -> PyResult<Bound<'py, PyDict>> {
    let table = PyDict::new(py);
    let steps = |value: fn(&ContactRow) -> u64| rows.iter().map(value).collect::<Vec<_>>().into_pyarray(py);
    let ids = |value: fn(&ContactRow) -> u32| rows.iter().map(value).collect::<Vec<_>>().into_pyarray(py);
    table.set_item("opened", steps(|row| row.opened))?;
    table.set_item("ended", steps(|row| row.ended))?;
    table.set_item("particle", ids(|row| row.particle))?;
    table.set_item("other", ids(|row| row.other))?;
    table.set_item("part", ids(|row| row.part))?;
    for (name, value) in NAMES.into_iter().zip(NUMBERS) {
        table.set_item(name, rows.iter().map(value).collect::<Vec<_>>().into_pyarray(py))?;
    }
    table.set_item("drum_angle", drum_angles.into_pyarray(py))?;
    Ok(table)
}

/// The contacts in what `contacts` gave.
///
/// # Errors
/// `Error::Config` naming the array that is none of the kind.
pub fn given_contacts(table: &Bound<'_, PyDict>) -> Result<Vec<ContactRow>, Error> {
    let (opened, ended): (Vec<u64>, Vec<u64>) = (column(table, "opened")?, column(table, "ended")?);
    let mut ids: [Vec<u32>; 3] = Default::default();
    for (values, name) in ids.iter_mut().zip(["particle", "other", "part"]) {
        *values = column(table, name)?;
    }
    let mut numbers: [Vec<f64>; 8] = Default::default();
    for (values, name) in numbers.iter_mut().zip(NAMES) {
        *values = column(table, name)?;
    }
    let count = opened.len();
    let is_short = ids.iter().any(|ids| ids.len() != count) || numbers.iter().any(|own| own.len() != count);
    if is_short || ended.len() != count {
        return Err(Error::config("contacts", "of several lengths", "of one length"));
    }
    let row = |k: usize| ContactRow {
        opened: opened[k],
        ended: ended[k],
        particle: ids[0][k],
        other: ids[1][k],
        part: ids[2][k],
        dissipated: [numbers[0][k], numbers[1][k], numbers[2][k]],
        speeds: [numbers[3][k], numbers[4][k]],
        greatest_force: numbers[5][k],
        point: [numbers[6][k], numbers[7][k]],
    };
    Ok((0..count).map(row).collect())
}

fn column<T: Element + Copy>(table: &Bound<'_, PyDict>, key: &str) -> Result<Vec<T>, Error> {
    let wrong = || Error::config(format!("contacts.{key}"), "something else", "an array of numbers");
    let item = table.get_item(key).ok().flatten().ok_or_else(wrong)?;
    let array: PyReadonlyArray1<T> = item.extract().map_err(|_| wrong())?;
    Ok(array.as_array().to_vec())
}

/// What is summed up on request, up to now; by place, up to the time that was asked for.
pub struct RecordedSums {
    log: ContactLog,
    fields: FieldSums,
    grid: Option<FieldGrid>,
    visits: Vec<Visits>,
    look_interval: f64,
    bins: Vec<ArcBin>,
    dissipated: Flows<f64>,
    masses: Vec<f64>,
    now: u64,
    time_step: f64,
}

impl RecordedSums {
    /// That of a simulation.
    pub fn of(core: &Core) -> Self {
        let particles = &core.state().particles;
        let (fields, visits) = core.told_sums();
        Self {
            log: core.contact_log(),
            fields: fields.clone(),
            grid: core.grid(),
            visits: visits.to_vec(),
            look_interval: core.visit_interval(),
            bins: core.profile_bins().to_vec(),
            dissipated: core.dissipated(),
            masses: particles.by_id(&particles.masses),
            now: core.state().step,
            time_step: core.time_step(),
        }
    }

    /// As arrays: `dissipated`, what contacts took, flow by flow; `below_floor`, how many contacts that were not listed and
    /// what they took; `split`, a row for each pair of species, then for each species and part of the drum, flow by flow;
    /// `profile`, a row for each bin of the drum's outline; `discs`, a row for each disc; `fields`, a row for each cell; `visits`,
    /// a row for each zone and disc.
    ///
    /// # Errors
    /// What Python answers.
    pub fn into_dict(self, py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
        let table = PyDict::new(py);
        let flows =
            |own: &Flows<f64>| (0..Flows::COUNT).map(|flow| Flows::field(own, flow)).collect::<Vec<_>>();
        table.set_item("dissipated", flows(&self.dissipated))?;
        let below = &self.log.below_floor;
        table.set_item("below_floor", (below.count, below.dissipated.map(|sum| sum.value())))?;
        let split = self.log.split.iter().flat_map(|own| flows(&Flows::map(own, |sum: Sum| sum.value())));
        table.set_item("split", table_of_rows(py, split.collect(), Flows::COUNT))?;
        table.set_item("profile", self.profile(py)?)?;
        table.set_item("discs", self.discs(py)?)?;
        table.set_item("fields", self.fields(py)?)?;
        table.set_item("visits", self.visits(py)?)?;
        Ok(table)
    }

    /// The middles of the cells of a row [m], the number of moments, and the sums by cell; none of what is not recorded.
    fn fields<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let table = PyDict::new(py);
        let middles: Vec<f64> = self.grid.iter().flat_map(FieldGrid::middles).collect();
        table.set_item("middles", middles.into_pyarray(py))?;
        table.set_item("moments", self.fields.moments)?;
        let sums = self.fields.cells.iter().flatten().copied().collect();
        table.set_item("sums", table_of_rows(py, sums, FIELD_WIDTH))?;
        Ok(table)
    }

    /// Counts, and times in seconds.
    fn visits<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let table = PyDict::new(py);
        let counts = |value: fn(&Visits) -> u32| -> Bound<'py, PyArray1<u32>> {
            self.visits.iter().map(value).collect::<Vec<_>>().into_pyarray(py)
        };
        table.set_item("entries", counts(|own| own.entries))?;
        table.set_item("cycles", counts(|own| own.cycles))?;
        let once = self.look_interval;
        let units = [once, once, once, once * once, once * once, once * once];
        let times = self.visits.iter().flat_map(|own| {
            let looks = [own.inside].into_iter().chain(own.sums);
            looks.zip(units).map(|(looks, unit)| looks as f64 * unit)
        });
        table.set_item("times", table_of_rows(py, times.collect(), units.len()))?;
        Ok(table)
    }

    fn profile<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let table = PyDict::new(py);
        let parts: Vec<u32> = self.bins.iter().map(|bin| bin.surface as u32).collect();
        let places = self
            .bins
            .iter()
            .flat_map(|bin| [bin.arc[0], bin.arc[1], bin.middle.x, bin.middle.y, bin.normal.x, bin.normal.y]);
        table.set_item("part", parts.into_pyarray(py))?;
        table.set_item("places", table_of_rows(py, places.collect(), 6))?;
        let values = self.log.profile.iter().flatten().map(Sum::value);
        table.set_item("sums", table_of_rows(py, values.collect(), PROFILE_WIDTH))?;
        Ok(table)
    }

    fn discs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let discs = &self.log.discs;
        let table = PyDict::new(py);
        let received = |disc: &DiscAccount| by_direction(&Flows::map(&disc.received, |sum: Sum| sum.value()));
        table.set_item("mass", self.masses.clone().into_pyarray(py))?;
        table.set_item("received", table_of_rows(py, discs.iter().flat_map(received).collect(), 3))?;
        let counts = |value: fn(&DiscAccount) -> u32| -> Bound<'py, PyArray1<u32>> {
            discs.iter().map(value).collect::<Vec<_>>().into_pyarray(py)
        };
        table.set_item("flights", counts(|disc| disc.flights))?;
        let in_flight = discs.iter().map(|disc| disc.steps_in_flight(self.now) as f64 * self.time_step);
        table.set_item("flight_time", in_flight.collect::<Vec<_>>().into_pyarray(py))?;
        table.set_item("falls", counts(|disc| disc.falls))?;
        table.set_item("drum_landings", counts(|disc| disc.landings[0]))?;
        table.set_item("load_landings", counts(|disc| disc.landings[1]))?;
        Ok(table)
    }
}
