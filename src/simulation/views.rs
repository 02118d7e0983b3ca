//! What a simulation shows of itself.

use super::Simulation;
use super::derived::{self, Facts};
use super::state::State;
use crate::engine::forces::Lists;
use crate::engine::relabel;
use crate::error::Error;
use crate::io::config::SimulationConfig;
use crate::physics::drum::Drum;

impl Simulation {
    /// Makes near lists for so many steps from now on, 32 unless told otherwise. No result depends on it, which is what this is
    /// for to test.
    pub fn set_near_steps(&mut self, steps: u32) {
        self.engine.set_near_steps(steps);
    }

    /// Time [s]: steps × time step.
    pub fn time(&self) -> f64 {
        self.time_at(self.state.step)
    }

    /// Length of a step [s].
    pub fn time_step(&self) -> f64 {
        self.derived.time_step
    }

    /// The configuration.
    pub fn config(&self) -> &SimulationConfig {
        &self.config
    }

    /// The seed of the start.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// Number of threads.
    pub fn threads(&self) -> usize {
        self.engine.threads().count()
    }

    /// State: step, particles, ledger.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// The contacts.
    pub fn contacts(&self) -> Lists {
        self.engine.pass().contacts()
    }

    /// The contacts by id, in the same order.
    pub fn contacts_by_id(&self) -> Lists {
        let mut contacts = self.contacts();
        relabel(&mut contacts, &self.state.particles.ids);
        contacts
    }

    /// The drum.
    pub fn drum(&self) -> &Drum {
        &self.derived.drum
    }

    /// Mass of the load [kg/m].
    pub fn mass(&self) -> f64 {
        self.derived.mass
    }

    /// Angle of the drum [rad].
    pub fn drum_angle(&self) -> f64 {
        self.drum_angle_at(self.state.step)
    }

    /// Shortest collision times [s] of this load: (between bundles, with the drum).
    pub fn collision_times(&self) -> (f64, f64) {
        derived::collision_times(&self.derived.table, &self.state.particles)
    }

    /// What places this case among others.
    pub fn facts(&self) -> Facts {
        Facts::new(&self.config, &self.derived.table, &self.state.particles, self.derived.time_step)
    }

    /// The error that stopped this simulation, if one did.
    pub fn failure(&self) -> Option<&Error> {
        self.failure.as_ref()
    }
}
