//! The steps.

use super::Simulation;
use crate::engine::{DrumMotion, memory_order};
use crate::error::Error;
use crate::physics::vector::Rotation;

/// Steps from one look at the whole load to the next: whether all is finite, no overlap too deep, no center inside a solid.
const LOOK_STEPS: u64 = 32;

impl Simulation {
    /// Does `steps` steps. Everything is up to date after the last.
    ///
    /// # Errors
    /// One of the errors of instability; the simulation then stays as it is and answers every further run with the same.
    pub fn run(&mut self, steps: u64) -> Result<(), Error> {
        if let Some(failure) = &self.failure {
            return Err(failure.clone());
        }
        if steps == 0 {
            return Ok(());
        }
        let threads = self.engine.threads().clone();
        let outcome = threads.enter(self.state.particles.len(), || self.run_steps(steps));
        self.failure = outcome.clone().err();
        outcome
    }

    fn run_steps(&mut self, steps: u64) -> Result<(), Error> {
        self.begin();
        for left in (0..steps).rev() {
            if let Err(error) = self.step(left == 0) {
                self.engine.finish(&mut self.state.particles);
                self.engine.end(&mut self.state.particles);
                self.record_end();
                return Err(error);
            }
        }
        self.engine.end(&mut self.state.particles);
        Ok(())
    }

    /// Begins a run of steps from a state that is up to date.
    fn begin(&mut self) {
        if self.is_sort_due() {
            let order = memory_order::along_curve(&self.state.particles.positions);
            self.engine.reorder(&mut self.state.particles, &order, self.derived.world());
        }
        self.engine.begin(&mut self.state.particles);
    }

    /// One step, whose drift is done; begins the next one unless this is the last.
    fn step(&mut self, is_last: bool) -> Result<(), Error> {
        self.state.step += 1;
        let turn = self.turn_of(self.state.step);
        let longest_way = self.engine.follow(turn);
        let drum = self.drum_motion(turn);
        self.guard_ways(longest_way, drum)?;
        let (world, particles) = (self.derived.world(), &mut self.state.particles);
        self.engine.update_list(particles, world, drum);
        let (mass_moment, looks) = (self.engine.mass_moment(), self.is_look_due());
        let stops = is_last || self.is_record_due() || self.is_sort_due();
        if !(stops || looks || self.needs_moments()) {
            self.engine.evaluate_and_advance(&mut self.state.particles, self.derived.world(), drum);
            self.charge(mass_moment, turn);
            return Ok(());
        }
        self.engine.evaluate(&mut self.state.particles, self.derived.world(), drum);
        if looks || self.needs_moments() {
            self.engine.show(&mut self.state.particles);
        }
        self.charge(mass_moment, turn);
        self.charge_moments();
        if looks {
            self.guard(mass_moment)?;
        }
        if !stops {
            self.engine.advance(&mut self.state.particles);
            return Ok(());
        }
        self.engine.finish(&mut self.state.particles);
        self.engine.show(&mut self.state.particles);
        self.record();
        if self.is_sort_due() && !is_last {
            self.engine.end(&mut self.state.particles);
            self.begin();
        } else if !is_last {
            self.engine.start(&mut self.state.particles);
        }
        Ok(())
    }

    /// How the drum moved in the last step, in which it turned by `turn` [rad]. Where only the pair list could see the
    /// rotation, and does not look, none is worked out.
    fn drum_motion(&self, turn: f64) -> DrumMotion {
        let rotation = if self.engine.needs_rotation(self.derived.world()) {
            Rotation::new(self.drum_angle())
        } else {
            Rotation::IDENTITY
        };
        let duration = self.derived.time_step;
        DrumMotion { rotation, angular_velocity: turn / duration, duration }
    }

    /// The angle by which the drum turns in a step [rad].
    pub(super) fn turn_of(&self, step: u64) -> f64 {
        self.config.rotation.angle_increment(self.time_at(step - 1), self.time_at(step))
    }

    pub(super) fn is_sample_due(&self) -> bool {
        self.state.step.is_multiple_of(self.derived.sample_steps)
    }

    pub(super) fn is_frame_due(&self) -> bool {
        self.state.step.is_multiple_of(self.derived.frame_steps)
    }

    fn is_record_due(&self) -> bool {
        self.is_sample_due() || self.is_frame_due()
    }

    /// Whether the whole load is looked at: at fixed steps, so that neither lists nor slices of a run show in an error.
    fn is_look_due(&self) -> bool {
        self.state.step.is_multiple_of(LOOK_STEPS) || self.is_sample_due()
    }

    fn is_sort_due(&self) -> bool {
        self.state.step > 0 && memory_order::is_due(self.state.particles.len(), self.state.step)
    }
}
