//! `Simulation`: configuration, state and engine; it steps, guards and records.

mod accounts;
mod collect;
pub mod contact_log;
pub mod derived;
mod guards;
pub mod initial_state;
mod records;
mod run;
pub mod state;
mod sums;
mod views;
pub mod warnings;

use contact_log::ContactLog;
use derived::Derived;
use initial_state::InitialState;
pub use records::Records;
use state::{EngineState, Recorded, State};

use crate::engine::forces::Lists;
use crate::engine::parallel::Threads;
use crate::engine::{Engine, memory_order, relabel};
use crate::error::Error;
use crate::io::config::SimulationConfig;
use crate::observe::fields::FieldSums;
use crate::physics::drum::Drum;
use crate::physics::energy::{EnergyLedger, MomentBalance};
use crate::physics::load::packing::pack_mixed;
use crate::physics::particles::Particles;
use crate::physics::vector::Rotation;

/// A drum with its load, at some step.
#[derive(Debug)]
pub struct Simulation {
    config: SimulationConfig,
    seed: u64,
    state: State,
    /// Follows from the configuration.
    derived: Derived,
    engine: Engine,
    /// What was recorded and has not been taken yet.
    records: Records,
    /// The step at which the load is checked, recorded or sorted next.
    next_event: u64,
    failure: Option<Error>,
}

impl Simulation {
    /// Packs the load at random into the turning drum.
    ///
    /// # Errors
    /// `Error::Config` for a bad configuration, `Error::Packing` where the load does not fit.
    pub fn new(config: SimulationConfig, seed: u64, threads: usize) -> Result<Self, Error> {
        config.validate()?;
        let threads = Threads::new(threads)?;
        let drum = Drum::new(&config.drum)?;
        let discs = config.load.discs(seed)?;
        let positions = pack_mixed(&drum, &discs.radii, seed)?;
        let particles = initial_state::packed(&config, discs, positions, seed);
        particles.validate()?;
        Self::start(config, seed, threads, particles, &InitialState::default())
    }

    /// Starts from a given state, whose particles take the place of the configured load.
    #[allow(clippy::needless_pass_by_value)] // A state is made for one start.
    pub fn with_state(
        config: SimulationConfig,
        seed: u64,
        threads: usize,
        initial: InitialState,
    ) -> Result<Self, Error> {
        config.validate()?;
        let threads = Threads::new(threads)?;
        let particles = initial.particles(&config, config.contact.table()?.count())?;
        Self::start(config, seed, threads, particles, &initial)
    }

    fn start(
        config: SimulationConfig,
        seed: u64,
        threads: Threads,
        mut particles: Particles,
        initial: &InitialState,
    ) -> Result<Self, Error> {
        let derived = Derived::new(&config, &particles)?;
        let rotation = Rotation::new(initial.drum_angle);
        initial_state::require_inside(&derived.drum, &particles, rotation)?;
        let mut contacts = initial_state::matching(&initial.contacts, &particles, &derived.drum, rotation);
        if memory_order::is_due(particles.len(), 0) {
            let order = memory_order::hilbert_order(&particles.positions);
            particles.reorder(&order);
            relabel(&mut contacts, &memory_order::places(&order));
        }
        if contacts != Lists::default() {
            let found = Self::contacts_at_start(&config, &derived, &mut particles.clone(), rotation)?;
            let fresh = initial_state::missing(found, &contacts);
            initial_state::require_apart(&fresh, &particles, &derived.drum)?;
            contacts.pairs.extend(fresh.pairs);
            contacts.walls.extend(fresh.walls);
        }
        let state = State {
            step: 0,
            initial_angle: initial.drum_angle,
            recorded: Recorded::default(),
            ledger: EnergyLedger::default(),
            log: ContactLog::default(),
            fields: FieldSums::default(),
            visits: Vec::new(),
            last_told: None,
            told: None,
            particles,
        };
        let engine_state = EngineState { contacts, totals: Vec::new(), events: Vec::new() };
        let records = Records::new(&derived.drum, &config.run.record);
        let mut simulation = Self::assemble(config, seed, threads, state, &engine_state, records, derived);
        simulation.open(&engine_state);
        if engine_state.contacts == Lists::default() {
            let found = simulation.contacts();
            initial_state::require_apart(&found, &simulation.state.particles, simulation.drum())?;
        }
        simulation.guard(simulation.state.particles.mass_moment())?;
        simulation.record()?;
        Ok(simulation)
    }

    /// The contacts that particles have which have just been put there.
    fn contacts_at_start(
        config: &SimulationConfig,
        derived: &Derived,
        particles: &mut Particles,
        rotation: Rotation,
    ) -> Result<Lists, Error> {
        let mut engine = Engine::new(particles, derived.world(), skin(config, particles), Threads::new(1)?);
        let angular_velocity = config.rotation.angular_velocity(0.0);
        engine.open(particles, derived.world(), rotation, angular_velocity);
        Ok(engine.pass().contacts())
    }

    /// Puts a simulation together around a state; the pair list will be built at the first step.
    pub(crate) fn resume(
        config: SimulationConfig,
        seed: u64,
        threads: usize,
        state: State,
        engine_state: &EngineState,
        records: Records,
    ) -> Result<Self, Error> {
        config.validate()?;
        let derived = Derived::new(&config, &state.particles)?;
        Ok(Self::assemble(config, seed, Threads::new(threads)?, state, engine_state, records, derived))
    }

    #[allow(clippy::too_many_arguments)] // All its parts.
    fn assemble(
        config: SimulationConfig,
        seed: u64,
        threads: Threads,
        state: State,
        engine_state: &EngineState,
        records: Records,
        derived: Derived,
    ) -> Self {
        let skin = skin(&config, &state.particles);
        let mut engine = Engine::new(&state.particles, derived.world(), skin, threads);
        engine.insert(&engine_state.contacts, &state.particles, derived.world());
        engine.pass_mut().set_totals(&engine_state.totals);
        engine.pass_mut().set_events(engine_state.events.clone());
        Self { config, seed, state, derived, engine, records, next_event: 0, failure: None }
    }

    /// First forces, opened accounts.
    fn open(&mut self, given: &EngineState) {
        let rotation = Rotation::new(self.state.initial_angle);
        let angular_velocity = self.config.rotation.angular_velocity(0.0);
        let surfaces = if given.contacts == Lists::default() {
            self.engine.open(&mut self.state.particles, self.derived.world(), rotation, angular_velocity);
            self.engine.pass().surfaces().to_vec()
        } else {
            initial_state::add_forces(&given.contacts, &mut self.state.particles, &self.derived.drum)
        };
        // There has been no step yet that work could have been done in.
        let overlap_ratio = self.engine.pass_mut().fold().deepest;
        let mass_moment = self.state.particles.mass_moment();
        let moments = MomentBalance::open(
            mass_moment,
            self.outer_moment(mass_moment),
            self.state.particles.angular_momentum(),
        );
        self.state.ledger = EnergyLedger::open(self.stored(), moments, &surfaces);
        self.state.ledger.overlap_ratio = overlap_ratio;
        self.open_log();
        self.open_sums();
    }

    /// What the engine holds of the state.
    pub fn engine_state(&self) -> EngineState {
        let pass = self.engine.pass();
        EngineState { contacts: pass.contacts(), totals: pass.totals(), events: pass.events() }
    }

    fn id_of(&self, place: usize) -> usize {
        self.state.particles.ids[place] as usize
    }

    fn time_at(&self, step: u64) -> f64 {
        step as f64 * self.derived.time_step
    }
}

/// Margin of the pair list in mean radii of the bundles; speed is flat from 0.4 to 1 at 100 … 10 000 bundles.
const DEFAULT_SKIN: f64 = 0.8;

fn skin(config: &SimulationConfig, particles: &Particles) -> f64 {
    config.run.skin.unwrap_or_else(|| DEFAULT_SKIN * particles.mean_radius())
}
