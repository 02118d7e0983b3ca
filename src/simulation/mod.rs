//! `Simulation`: configuration, state and scratch; it steps, guards and records.

mod accounts;
mod fixed;
mod views;

use fixed::Fixed;

use crate::contact::laws::Laws;
use crate::contact::table::ContactTable;
use crate::error::Error;
use crate::forces::{ForcePass, Matter, Scene};
use crate::integrator::{DriftSums, Integrator, Load};
use crate::io::config::SimulationConfig;
use crate::neighbors::{Surroundings, VerletList};
use crate::observe::recorder::{Frames, Series, columns};
use crate::order;
use crate::patch::PatchMotion;
use crate::physics::drum::Drum;
use crate::physics::energy::{Balance, EnergyLedger, StoredEnergy};
use crate::physics::load::packing::pack;
use crate::physics::particles::Particles;
use crate::physics::vector::Rotation;
use crate::start::{self, InitialState};
use crate::state::State;
use crate::threads::Threads;

/// A drum with its load, at some step.
#[derive(Debug)]
pub struct Simulation {
    config: SimulationConfig,
    seed: u64,
    state: State,
    table: ContactTable,
    /// Follows from the configuration.
    fixed: Fixed,
    /// Scratch: nothing in it changes a result.
    list: VerletList,
    inverse_reach: f64,
    integrator: Integrator,
    forces: ForcePass,
    threads: Threads,
    /// Where the drift of the next step is done, the drum's turn in it [rad] and its sums.
    ahead: Option<(f64, DriftSums)>,
    failure: Option<Error>,
}

/// The instant at which forces are evaluated.
#[derive(Debug, Clone, Copy)]
struct Instant {
    rotation: Rotation,
    angular_velocity: f64,
    /// The time that has passed since forces were last evaluated [s].
    time_step: f64,
    /// The angle by which the drum turned in it [rad].
    turn: f64,
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
        let positions = pack(&drum, config.load.count, 0.5 * config.load.diameter, seed)?;
        let particles = start::packed(&config, positions, seed);
        particles.validate()?;
        Self::start(config, seed, threads, particles)
    }

    /// Starts from a given state, whose particles take the place of the configured load.
    ///
    /// # Errors
    /// `Error::Config` naming the field of the state or the configuration.
    pub fn with_state(
        config: SimulationConfig,
        seed: u64,
        threads: usize,
        initial: InitialState,
    ) -> Result<Self, Error> {
        config.validate()?;
        let threads = Threads::new(threads)?;
        let particles = initial.into_particles(&config)?;
        Self::start(config, seed, threads, particles)
    }

    fn start(
        config: SimulationConfig,
        seed: u64,
        threads: Threads,
        mut particles: Particles,
    ) -> Result<Self, Error> {
        let table = ContactTable::empty(particles.len());
        let fixed = Fixed::new(&config, &particles)?;
        start::require_inside(&fixed.drum, &particles)?;
        if order::is_due(particles.len(), 0) {
            particles.reorder(&order::along_curve(&particles.positions));
        }
        let state = State {
            step: 0,
            series: Series::new(columns(fixed.drum.baffle_count(), fixed.drum.wall_count()).len()),
            frames: Frames::default(),
            ledger: EnergyLedger::open(StoredEnergy::default(), Balance::default(), &[]),
            particles,
        };
        let mut simulation = Self::assemble(config, seed, threads, (state, table), fixed);
        simulation.open();
        simulation.guard()?;
        Ok(simulation)
    }

    /// Puts a simulation together around a state; the neighbor list will be built at the first step.
    pub(crate) fn resume(
        config: SimulationConfig,
        seed: u64,
        threads: usize,
        state: State,
        contacts: impl FnOnce(&Laws, &Particles) -> Result<ContactTable, Error>,
    ) -> Result<Self, Error> {
        config.validate()?;
        let fixed = Fixed::new(&config, &state.particles)?;
        let table = contacts(&fixed.laws, &state.particles)?;
        Ok(Self::assemble(config, seed, Threads::new(threads)?, (state, table), fixed))
    }

    fn assemble(
        config: SimulationConfig,
        seed: u64,
        threads: Threads,
        (state, table): (State, ContactTable),
        fixed: Fixed,
    ) -> Self {
        let count = state.particles.len();
        let skin = config.run.skin.unwrap_or(DEFAULT_SKIN * state.particles.largest_radius());
        let list = VerletList::new(skin);
        Self {
            inverse_reach: list.inverse_reach(state.particles.largest_radius()),
            list,
            integrator: Integrator::new(&state.particles, fixed.time_step, fixed.gravity),
            forces: ForcePass::new(count, fixed.drum.surface_count()),
            config,
            seed,
            state,
            table,
            fixed,
            threads,
            ahead: None,
            failure: None,
        }
    }

    /// First forces, first accelerations, opened accounts, first sample and frame.
    fn open(&mut self) {
        let instant = Instant {
            rotation: Rotation::new(self.config.rotation.angle(0.0)),
            angular_velocity: self.config.rotation.angular_velocity(0.0),
            time_step: 0.0,
            turn: 0.0,
        };
        self.rebuild(instant.rotation);
        self.evaluate(instant);
        self.integrator.accelerate(&mut self.state.particles, &self.forces.loads);
        // The particles have not been moving yet: what the list knows of their displacements does not hold.
        self.list.forget();
        let mass_moment = start::mass_moment(&self.state.particles);
        let balance = Balance {
            angular_momentum: self.state.particles.angular_momentum(),
            ..self.balance(mass_moment)
        };
        self.state.ledger = EnergyLedger::open(self.stored(), balance, &self.forces.surfaces);
        self.state.ledger.overlap_ratio = self.forces.flows.overlap_ratio;
        self.record();
    }

    /// Does `steps` steps.
    ///
    /// # Errors
    /// `Error::NonFinite`, `Error::Overlap` or `Error::Escaped`; the simulation then stays as it is and answers every
    /// further run with the same error.
    pub fn run(&mut self, steps: u64) -> Result<(), Error> {
        let threads = self.threads.clone();
        threads.enter(self.state.particles.len(), || {
            self.run_here(steps, true)?;
            // A step sees positions alone, and those of the step before; who looks now gets numbers throughout.
            if let Some(particle) = self.state.particles.first_non_finite() {
                self.failure =
                    Some(Error::NonFinite { step: self.state.step, particle: self.id_of(particle) });
            }
            self.failure.clone().map_or(Ok(()), Err)
        })
    }

    /// The same for a slice of a longer run, but does not bring the particles up to date at its end, which costs as much as a
    /// few steps. Who looks at them must `arrive` before.
    ///
    /// # Errors
    /// As `run`.
    pub fn run_on(&mut self, steps: u64) -> Result<(), Error> {
        let threads = self.threads.clone();
        threads.enter(self.state.particles.len(), || self.run_here(steps, false))
    }

    /// Brings the particles up to date, if slices of a run have left them behind, by one more step.
    ///
    /// # Errors
    /// As `run`.
    pub fn arrive(&mut self) -> Result<(), Error> {
        if self.ahead.is_some() { self.run(1) } else { Ok(()) }
    }

    /// Does steps. `seen` says that somebody looks at the particles after the last.
    fn run_here(&mut self, steps: u64, seen: bool) -> Result<(), Error> {
        for left in (0..steps).rev() {
            if let Some(failure) = &self.failure {
                return Err(failure.clone());
            }
            if let Err(failure) = self.step(seen && left == 0) {
                self.integrator.show(&mut self.state.particles, &self.threads);
                self.failure = Some(failure);
            }
        }
        self.failure.clone().map_or(Ok(()), Err)
    }

    /// One step. Where nobody looks in between, the drift of the next step goes along with its forces; `seen` says that
    /// somebody will.
    fn step(&mut self, seen: bool) -> Result<(), Error> {
        if self.is_sort_due() {
            self.sort();
        }
        let (turn, sums) = self.ahead.take().unwrap_or_else(|| self.start_drift());
        self.state.step += 1;
        if !(sums.mass_moment.x + sums.mass_moment.y).is_finite() {
            self.integrator.show(&mut self.state.particles, &self.threads);
            let particle = self.id_of(self.state.particles.first_non_finite().unwrap_or(0));
            return Err(Error::NonFinite { step: self.state.step, particle });
        }
        let rotation = self.keep_list(sums.longest_way, turn);
        let angular_velocity = self.config.rotation.angular_velocity(self.time());
        let instant = Instant { rotation, angular_velocity, time_step: self.fixed.time_step, turn };
        if seen || self.is_to_be_seen(sums.longest_way) {
            self.evaluate(instant);
            self.integrator.finish(&mut self.state.particles, &self.forces.loads, &self.threads);
        } else {
            self.evaluate_and_move(instant);
        }
        self.charge(sums.mass_moment, turn);
        self.guard()?;
        self.record();
        Ok(())
    }

    /// Follows a step with the neighbor list, and builds it anew where it no longer holds. Returns the drum's rotation,
    /// which without outlines only the list may see.
    fn keep_list(&mut self, longest_way: f64, turn: f64) -> Rotation {
        let look = self.list.advance(longest_way, turn);
        if !look && !self.has_outlines() {
            return Rotation::IDENTITY;
        }
        let rotation = Rotation::new(self.config.rotation.angle(self.time()));
        let motions = &self.integrator.motions;
        if look && !self.list.still_holds(&|i| motions[i].position(), rotation, &self.threads) {
            self.integrator.place(&mut self.state.particles.positions, &self.threads);
            self.rebuild(rotation);
        }
        rotation
    }

    /// Whether the particles have to be up to date at the end of this step, in which nobody moved farther than
    /// `longest_way`.
    fn is_to_be_seen(&self, longest_way: f64) -> bool {
        // An error leaves the particles at the step in which it occurred.
        let deepest = self.forces.flows.overlap_ratio + 2.0 * longest_way / self.fixed.least_radius;
        let balance_looks = self.fixed.steady_speed.is_none() || self.config.load.spin_locked;
        balance_looks || self.is_record_due() || self.is_sort_due() || deepest > self.config.run.overlap_limit
    }

    fn is_sort_due(&self) -> bool {
        self.state.step > 0 && order::is_due(self.state.particles.len(), self.state.step)
    }

    /// Brings neighbors together in memory.
    fn sort(&mut self) {
        let order = order::along_curve(&self.state.particles.positions);
        let mut places = vec![0; order.len()];
        for (place, &particle) in order.iter().enumerate() {
            places[particle as usize] = place as u32;
        }
        self.state.particles.reorder(&order);
        self.table.follow(&places);
        self.integrator = Integrator::new(&self.state.particles, self.fixed.time_step, self.fixed.gravity);
        self.list.forget();
    }

    fn start_drift(&mut self) -> (f64, DriftSums) {
        let turn = self.next_turn();
        self.threads.set_each(&mut self.forces.loads, &|_| Load::default());
        let farthest = self.list.farthest();
        (turn, self.integrator.start(&self.state.particles, (turn, farthest), &self.threads))
    }

    /// The angle by which the drum turns in the step after the last [rad].
    fn next_turn(&self) -> f64 {
        self.config.rotation.angle_increment(self.time(), self.time_at(self.state.step + 1))
    }

    fn is_record_due(&self) -> bool {
        let step = self.state.step;
        step.is_multiple_of(self.fixed.sample_steps) || step.is_multiple_of(self.fixed.frame_steps)
    }

    /// Whether the drum has anything but a rim, for which its rotation matters.
    fn has_outlines(&self) -> bool {
        self.fixed.drum.surface_count() > 1
    }

    fn rebuild(&mut self, rotation: Rotation) {
        let around = Surroundings { particles: &self.state.particles, drum: &self.fixed.drum, rotation };
        self.list.rebuild(around, &mut self.table, &self.threads);
        self.forces.prepare(&self.table, &self.threads);
    }

    fn evaluate(&mut self, instant: Instant) {
        let Particles { materials, masses, radii, .. } = &self.state.particles;
        let matter = Matter { materials, masses, radii, radius: self.fixed.radius, pair: self.fixed.pair };
        let (motions, patches) = (&self.integrator.motions, &self.integrator.patches);
        let scene = scene(&self.fixed, &self.list, self.inverse_reach, (matter, patches), instant);
        self.forces.evaluate(scene, motions, &mut self.table, &self.threads);
    }

    /// The forces of this step and the drift of the next.
    fn evaluate_and_move(&mut self, instant: Instant) {
        let turn = self.next_turn();
        let Particles { materials, masses, radii, .. } = &self.state.particles;
        let matter = Matter { materials, masses, radii, radius: self.fixed.radius, pair: self.fixed.pair };
        let (drift, motions, patches) = self.integrator.drift(turn, self.list.farthest());
        let scene = scene(&self.fixed, &self.list, self.inverse_reach, (matter, patches), instant);
        self.forces.evaluate_and_move(scene, &mut self.table, (drift, motions), &self.threads);
        self.ahead = Some((turn, self.integrator.end_drift()));
    }

    fn guard(&mut self) -> Result<(), Error> {
        let limit = self.config.run.overlap_limit;
        if self.forces.flows.overlap_ratio <= limit {
            return Ok(());
        }
        self.integrator.place(&mut self.state.particles.positions, &self.threads);
        let step = self.state.step;
        let (place, ratio) = start::deepest_overlap(&self.table, &self.state.particles);
        let particle = self.id_of(place);
        if self.fixed.drum.radius().is_some_and(|rim| self.state.particles.positions[place].norm() > rim) {
            return Err(Error::Escaped { step, particle });
        }
        Err(Error::Overlap { step, particle, ratio, limit })
    }

    fn id_of(&self, place: usize) -> usize {
        self.state.particles.ids[place] as usize
    }

    fn time_at(&self, step: u64) -> f64 {
        step as f64 * self.fixed.time_step
    }
}

/// Margin of the neighbor list in radii of the largest bundle; speed is flat from 0.4 to 1 at 100 … 10 000 bundles.
const DEFAULT_SKIN: f64 = 0.5;

/// All that contacts need at an instant but the particles' motions.
fn scene<'a>(
    fixed: &'a Fixed,
    list: &VerletList,
    inverse_reach: f64,
    (matter, patches): (Matter<'a>, &'a [PatchMotion]),
    instant: Instant,
) -> Scene<'a, ()> {
    Scene {
        motions: (),
        patches,
        matter,
        laws: &fixed.laws,
        drum: &fixed.drum,
        rotation: instant.rotation,
        angular_velocity: instant.angular_velocity,
        turn: instant.turn,
        arc: list.arc(instant.turn),
        round_off: list.round_off(),
        inverse_reach,
        time_step: instant.time_step,
        step_rate: 1.0 / fixed.time_step,
    }
}
