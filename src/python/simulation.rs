//! `drumrs._core.Simulation`: the one class.
//!
//! The simulation sits behind a lock that is only ever waited for with the interpreter released, so that other Python
//! threads may look at it, or stop it, between two slices of a run. Every slice leaves it up to date: looking never moves
//! anything, and where slices end does not show in a bit.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::fair_lock::FairLock;
use super::fork_guard::Entered;
use super::pace::{Pace, SLICE};
use super::{arrays, averages, contact_arrays};
use crate::engine::parallel::CHUNK;
use crate::error::Error;
use crate::io::config::SimulationConfig;
use crate::observe::contact_rows::ContactRow;
use crate::observe::frames::Frames;
use crate::observe::recorder::{Recording, columns};
use crate::observe::summary::summarize;
use crate::physics::particles::Particles;
use crate::simulation::Simulation as Core;

/// A drum with its load; see `drumrs.Simulation`.
#[pyclass(frozen, module = "drumrs._core")]
pub struct Simulation {
    core: FairLock<Core>,
    stop: AtomicBool,
}

impl Simulation {
    fn around(core: Core) -> Self {
        Self { core: FairLock::new(core), stop: AtomicBool::new(false) }
    }

    /// Lets `work` have the core, between two slices of a run, with the interpreter released.
    fn with<T: Send>(&self, py: Python<'_>, work: impl FnOnce(&mut Core) -> T + Send) -> T {
        py.detach(|| {
            let _entered = Entered::enter();
            work(&mut self.core.lock())
        })
    }

    fn contact_arrays<'py>(&self, py: Python<'py>, rows: &[ContactRow]) -> PyResult<Bound<'py, PyDict>> {
        let angles = self.with(py, |core| rows.iter().map(|row| core.drum_angle_at(row.opened)).collect());
        contact_arrays::contacts(py, rows, angles)
    }

    /// One of the particles' vectors in id order.
    fn by_id<T: Copy + Send>(&self, py: Python<'_>, values: fn(&Particles) -> &[T]) -> Vec<T> {
        self.with(py, |core| core.state().particles.by_id(values(&core.state().particles)))
    }

    /// Does steps until step `end` or until a slice of time is over; returns the step.
    fn slice(&self, py: Python<'_>, end: u64, pace: &mut Pace) -> Result<u64, Error> {
        self.with(py, |core| {
            pace.slice(end.saturating_sub(core.state().step), |steps| core.run(steps))?;
            Ok(core.state().step)
        })
    }

    /// Runs slice by slice until step `end`, a signal or a stop.
    fn run_until(&self, py: Python<'_>, end: u64, progress: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        let (mut step, mut pace) = (self.step(py), Pace::of(self.count(py)));
        while step < end && !self.stop.load(Ordering::Relaxed) {
            step = self.slice(py, end, &mut pace)?;
            py.check_signals()?;
            if let Some(progress) = progress {
                progress.call1((step,))?;
            }
        }
        Ok(())
    }
}

/// Makes a simulation on a thread of its own, so that Ctrl-C is heard while a large load is packed; what is made after
/// that ends unseen.
fn on_a_thread(
    py: Python<'_>,
    action: &str,
    make: impl FnOnce() -> Result<Core, Error> + Send + 'static,
) -> PyResult<Core> {
    let (sender, mut receiver) = mpsc::channel();
    let made = std::thread::Builder::new().spawn(move || sender.send(make()).ok());
    let refuse = |reason: String| Error::System { action: action.into(), reason };
    made.map_err(|error| refuse(error.to_string()))?;
    loop {
        let waited = py.detach(move || (receiver.recv_timeout(SLICE), receiver));
        receiver = waited.1;
        match waited.0 {
            Ok(outcome) => return Ok(outcome?),
            Err(mpsc::RecvTimeoutError::Timeout) => py.check_signals()?,
            Err(mpsc::RecvTimeoutError::Disconnected) => {
                return Err(refuse("the thread was lost".into()).into());
            }
        }
    }
}

#[pymethods]
impl Simulation {
    #[new]
    #[pyo3(signature = (config, seed, threads = 1, state = None))]
    fn new(
        py: Python<'_>,
        config: &str,
        seed: u64,
        threads: usize,
        state: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let config = SimulationConfig::from_json(config)?;
        let initial = state.map(arrays::initial_state).transpose()?;
        let few = config.load.count <= CHUNK;
        let start = move || match initial {
            Some(initial) => Core::with_state(config, seed, threads, initial),
            None => Core::new(config, seed, threads),
        };
        // A few bundles are packed in a tenth of a second. Each thread would leave memory behind: the system's allocator
        // keeps an arena for every thread that it has seen, and a sweep starts simulations by the thousand.
        let made = if few { Ok(py.detach(start)?) } else { on_a_thread(py, "starting a simulation", start) };
        made.map(Self::around)
    }

    #[staticmethod]
    #[pyo3(signature = (data, threads = 1))]
    fn from_checkpoint(py: Python<'_>, data: Vec<u8>, threads: usize) -> PyResult<Self> {
        let read = move || Core::from_checkpoint(&data, threads);
        on_a_thread(py, "reading a checkpoint", read).map(Self::around)
    }

    /// The bytes of a checkpoint, in an array: as large as the records, they are not copied.
    fn checkpoint<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<u8>>> {
        Ok(self.with(py, |core| core.to_checkpoint())?.into_pyarray(py))
    }

    /// A simulation that goes on from this one's state under another configuration.
    fn with_config(&self, py: Python<'_>, config: &str) -> PyResult<Self> {
        let config = SimulationConfig::from_json(config)?;
        Ok(Self::around(self.with(py, |core| core.with_config(config))?))
    }

    #[pyo3(signature = (steps, progress = None))]
    fn run(&self, py: Python<'_>, steps: u64, progress: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        self.stop.store(false, Ordering::Relaxed);
        self.run_until(py, self.step(py).saturating_add(steps), progress)
    }

    fn stop(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }

    #[getter]
    fn config(&self, py: Python<'_>) -> String {
        self.with(py, |core| core.config().to_json())
    }

    #[getter]
    fn seed(&self, py: Python<'_>) -> u64 {
        self.with(py, |core| core.seed())
    }

    #[getter]
    fn step(&self, py: Python<'_>) -> u64 {
        self.with(py, |core| core.state().step)
    }

    #[getter]
    fn time(&self, py: Python<'_>) -> f64 {
        self.with(py, |core| core.time())
    }

    #[getter]
    fn time_step(&self, py: Python<'_>) -> f64 {
        self.with(py, |core| core.time_step())
    }

    #[getter]
    fn count(&self, py: Python<'_>) -> usize {
        self.with(py, |core| core.state().particles.len())
    }

    #[getter]
    fn threads(&self, py: Python<'_>) -> usize {
        self.with(py, |core| core.threads())
    }

    #[getter]
    fn drum_angle(&self, py: Python<'_>) -> f64 {
        self.with(py, |core| core.drum_angle())
    }

    #[getter]
    fn drum_angular_velocity(&self, py: Python<'_>) -> f64 {
        self.with(py, |core| core.config().rotation.angular_velocity(core.time()))
    }

    #[getter]
    fn positions<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        arrays::vectors(py, &self.by_id(py, |particles| &particles.positions))
    }

    #[getter]
    fn velocities<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        arrays::vectors(py, &self.by_id(py, |particles| &particles.velocities))
    }

    #[getter]
    fn angles<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.by_id(py, |particles| &particles.angles).into_pyarray(py)
    }

    #[getter]
    fn angular_velocities<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.by_id(py, |particles| &particles.angular_velocities).into_pyarray(py)
    }

    #[getter]
    fn radii<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.by_id(py, |particles| &particles.radii).into_pyarray(py)
    }

    #[getter]
    fn masses<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.by_id(py, |particles| &particles.masses).into_pyarray(py)
    }

    /// Places of the bundles' species in the list.
    #[getter]
    fn species<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u16>> {
        self.by_id(py, |particles| &particles.species).into_pyarray(py)
    }

    /// Everything that `State` has a field for, all at one moment.
    fn state<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (particles, drum_angle, contacts) =
            self.with(py, |core| (core.state().particles.clone(), core.drum_angle(), core.contacts_by_id()));
        let by_id = |values: &[f64]| particles.by_id(values).into_pyarray(py);
        let state = PyDict::new(py);
        state.set_item("positions", arrays::vectors(py, &particles.by_id(&particles.positions)))?;
        state.set_item("velocities", arrays::vectors(py, &particles.by_id(&particles.velocities)))?;
        state.set_item("angles", by_id(&particles.angles))?;
        state.set_item("angular_velocities", by_id(&particles.angular_velocities))?;
        state.set_item("radii", by_id(&particles.radii))?;
        state.set_item("species", particles.by_id(&particles.species).into_pyarray(py))?;
        state.set_item("drum_angle", drum_angle)?;
        let tables = PyDict::new(py);
        tables.set_item("pairs", arrays::contact_table(py, &contacts.pairs)?)?;
        tables.set_item("walls", arrays::contact_table(py, &contacts.walls)?)?;
        state.set_item("contacts", tables)?;
        Ok(state)
    }

    /// What places this case among others, in JSON.
    #[getter]
    fn facts(&self, py: Python<'_>) -> String {
        self.with(py, |core| serde_json::to_string(&core.facts()).expect("plain numbers"))
    }

    #[getter]
    fn warnings(&self, py: Python<'_>) -> Vec<String> {
        self.with(py, |core| core.warnings())
    }

    #[getter]
    fn collision_times<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (bundle, drum) = self.with(py, |core| core.collision_times());
        let times = PyDict::new(py);
        times.set_item("bundle", bundle)?;
        times.set_item("drum", drum)?;
        Ok(times)
    }

    /// The shell, if the drum has one, the baffles and the walls.
    #[allow(clippy::type_complexity)] // Three things, named in the stub.
    fn outlines<'py>(
        &self,
        py: Python<'py>,
    ) -> (Option<Bound<'py, PyArray2<f64>>>, Vec<Bound<'py, PyArray2<f64>>>, Vec<Bound<'py, PyArray2<f64>>>)
    {
        let drum = self.with(py, |core| core.drum().clone());
        let mut baffles: Vec<_> = drum.outlines().map(|outline| arrays::vectors(py, outline)).collect();
        let walls = baffles.split_off(drum.baffle_count());
        (drum.shell().map(|shell| arrays::vectors(py, shell)), baffles, walls)
    }

    /// What the parts of the drum are called, in the order of their columns in the series.
    fn parts(&self, py: Python<'_>) -> Vec<String> {
        self.with(py, |core| core.drum().surface_names().to_vec())
    }

    fn series<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let table = self.with(py, |core| {
            let columns = core.series().columns().iter().enumerate();
            columns
                .map(|(index, column)| Ok((column.name.clone(), core.series().try_column(index)?)))
                .collect::<Result<Vec<_>, Error>>()
        });
        let series = PyDict::new(py);
        for (name, values) in table? {
            series.set_item(name, values.into_pyarray(py))?;
        }
        Ok(series)
    }

    fn frames<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (frames, count) = self.with(py, |core| {
            let count = core.state().particles.len();
            (core.frames().try_clone(count), count)
        });
        arrays::frames(py, frames?, count)
    }

    /// The frames in memory, which then are no longer there; no copy is made.
    fn take_frames<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (frames, count) = self.with(py, |core| (core.take_frames(), core.state().particles.len()));
        arrays::frames(py, frames, count)
    }

    /// Puts the frames in memory, which then are no longer there, and the samples that were not taken yet, which stay, into a
    /// dict: one that is there before, so that no interrupt can come between them and whoever keeps them.
    fn take_records(&self, py: Python<'_>, into: &Bound<'_, PyDict>) -> PyResult<()> {
        let taken = self.with(py, |core| {
            let firsts = [core.first_untaken_sample(), core.first_frame(), core.first_contact()];
            Ok::<_, Error>((firsts, core.take_rows()?, core.take_frames(), core.take_contacts()))
        });
        let ([first_sample, first_frame, first_contact], rows, frames, contacts) = taken?;
        let (width, count) = self.with(py, |core| (core.series().width(), core.state().particles.len()));
        into.set_item("first_sample", first_sample)?;
        into.set_item("rows", arrays::table_of_rows(py, rows, width))?;
        into.set_item("first_frame", first_frame)?;
        into.set_item("frames", arrays::frames(py, frames, count)?)?;
        into.set_item("first_contact", first_contact)?;
        into.set_item("contacts", self.contact_arrays(py, &contacts)?)
    }

    /// The contacts that are still open, up to now, or those in memory that have ended; none where they are not recorded.
    fn contacts<'py>(&self, py: Python<'py>, are_open: bool) -> PyResult<Bound<'py, PyDict>> {
        let of = |core: &mut Core| if are_open { core.open_rows() } else { core.records().contacts.clone() };
        self.contact_arrays(py, &self.with(py, of))
    }

    /// What is summed up on request, up to now: see `contact_arrays::RecordedSums`.
    fn recorded_sums<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.with(py, |core| contact_arrays::RecordedSums::of(core)).into_dict(py)
    }

    fn tell_sums_until(&self, py: Python<'_>, time: f64) {
        self.with(py, |core| core.tell_sums_until(time));
    }

    fn put_back_contacts(&self, py: Python<'_>, contacts: &Bound<'_, PyDict>) -> PyResult<()> {
        let rows = contact_arrays::given_contacts(contacts)?;
        Ok(self.with(py, |core| core.put_back_contacts(&rows))?)
    }

    #[getter]
    fn first_contact(&self, py: Python<'_>) -> u64 {
        self.with(py, |core| core.first_contact())
    }

    fn put_back_rows(&self, py: Python<'_>, rows: &Bound<'_, PyArray2<f64>>, taken: bool) -> PyResult<()> {
        let rows = rows.try_readonly()?;
        let values = rows.as_slice()?;
        Ok(self.with(py, |core| core.put_back_rows(values, taken))?)
    }

    fn put_back_frames(&self, py: Python<'_>, frames: &Bound<'_, PyDict>) -> PyResult<()> {
        let frames = arrays::given_frames(frames)?;
        Ok(self.with(py, |core| core.put_back_frames(frames))?)
    }

    #[getter]
    fn first_sample(&self, py: Python<'_>) -> u64 {
        self.with(py, |core| core.first_sample())
    }

    #[getter]
    fn first_untaken_sample(&self, py: Python<'_>) -> u64 {
        self.with(py, |core| core.first_untaken_sample())
    }

    #[getter]
    fn first_frame(&self, py: Python<'_>) -> u64 {
        self.with(py, |core| core.first_frame())
    }

    /// Memory that a sample and a frame take [bytes].
    #[getter]
    fn record_sizes(&self, py: Python<'_>) -> (usize, usize) {
        self.with(py, |core| (8 * core.series().width(), Frames::size_of_one(core.state().particles.len())))
    }

    /// Memory that records take which were not taken yet [bytes].
    #[getter]
    fn untaken_size(&self, py: Python<'_>) -> usize {
        self.with(py, |core| core.untaken_size())
    }

    fn summary<'py>(&self, py: Python<'py>, start: f64, end: f64) -> PyResult<Bound<'py, PyDict>> {
        averages::dictionary(py, self.with(py, |core| summarize(core.series(), core.mass(), start, end))?)
    }

    /// The columns of the series: name, symbol, unit, reading, formula, meaning.
    #[staticmethod]
    #[allow(clippy::needless_pass_by_value)] // Arguments from Python arrive by value.
    fn columns(parts: Vec<String>, record_gross_work: bool) -> Vec<[String; 6]> {
        let record = record_gross_work.then_some(Recording::GrossWork);
        let told = columns(&parts, record.as_slice()).into_iter();
        told.map(|c| {
            [c.name, c.symbol, c.unit.into(), c.reading.name().into(), c.formula, c.meaning]
                .map(std::borrow::Cow::into_owned)
        })
        .collect()
    }
}
