//! The steps.

use super::Simulation;
use super::derived::Derived;
use crate::engine::{DrumMotion, memory_order};
use crate::error::Error;
use crate::physics::vector::Rotation;

/// Steps from one check of the whole load to the next: whether all is finite, no overlap too deep, no center inside a solid.
pub(super) const CHECK_STEPS: u64 = 32;

impl Simulation {
    /// Does `steps` steps. Everything is up to date after the last.
    ///
    /// # Errors
    /// One of the errors of instability; the simulation then stays as it is and answers every further run with the same.
    /// `Error::Memory` where a sample or frame has no room: the next run records it first and goes on, once records are taken.
    pub fn run(&mut self, steps: u64) -> Result<(), Error> {
        if let Some(failure) = &self.failure {
            return Err(failure.clone());
        }
        if steps == 0 {
            return Ok(());
        }
        let threads = self.engine.threads().clone();
        let outcome = threads.enter(self.state.particles.len(), || self.run_steps(steps));
        self.failure = outcome.clone().err().filter(|error| !matches!(error, Error::Memory { .. }));
        outcome
    }

    fn run_steps(&mut self, steps: u64) -> Result<(), Error> {
        if self.state.recorded.is_pending {
            self.record()?;
        }
        self.next_event = self.event_after(self.state.step);
        self.begin();
        for left in (0..steps).rev() {
            if let Err(error) = self.step(left == 0) {
                if matches!(error, Error::Memory { .. }) {
                    // The step is done and up to date; only its records are pending.
                    return Err(error);
                }
                self.engine.finish();
                self.engine.write_back(&mut self.state.particles);
                // Where there is no memory for it, that is not what the run ended on.
                let _ = self.collect();
                self.record_end();
                return Err(error);
            }
        }
        Ok(())
    }

    /// Begins a run of steps from a state that is up to date.
    fn begin(&mut self) {
        if self.is_sort_due() {
            let order = memory_order::hilbert_order(&self.state.particles.positions);
            self.engine.reorder(&mut self.state.particles, &order, self.derived.world());
        }
        self.engine.begin(&mut self.state.particles);
    }

    /// One step, whose drift is done; begins the next one unless this is the last.
    fn step(&mut self, is_last: bool) -> Result<(), Error> {
        self.state.step += 1;
        let turn = self.turn_of(self.state.step);
        let longest_displacement = self.engine.follow(turn);
        let drum = self.drum_motion(turn);
        self.guard_displacements(longest_displacement, drum)?;
        self.engine.update_list(&mut self.state.particles, self.derived.world(), drum);
        if is_last || self.state.step >= self.next_event || self.needs_moments() {
            return self.step_with_events(is_last, turn, drum);
        }
        let mass_moment = self.engine.mass_moment();
        self.engine.evaluate_and_advance(&self.state.particles, self.derived.world(), drum);
        self.charge(mass_moment, turn);
        Ok(())
    }

    /// The rest of a step after which the load may be checked, recorded or sorted.
    fn step_with_events(&mut self, is_last: bool, turn: f64, drum: DrumMotion) -> Result<(), Error> {
        let mass_moment = self.engine.mass_moment();
        self.engine.evaluate(&self.state.particles, self.derived.world(), drum);
        if self.needs_moments() {
            self.engine.write_back(&mut self.state.particles);
        } else {
            self.engine.write_back_positions(&mut self.state.particles);
        }
        self.charge(mass_moment, turn);
        self.charge_moments();
        if self.is_check_due() {
            self.guard(mass_moment).or_else(|_| {
                // Now that it is told, velocities are, too.
                self.engine.write_back(&mut self.state.particles);
                self.guard(mass_moment)
            })?;
            // Where there is no memory for them, events wait for the next sample or frame, which tells.
            let _ = self.collect();
            self.count_visits();
        }
        self.next_event = self.event_after(self.state.step);
        if !(is_last || self.is_record_due() || self.is_sort_due()) {
            self.engine.advance();
            return Ok(());
        }
        self.engine.finish();
        self.engine.write_back(&mut self.state.particles);
        self.record()?;
        if self.is_sort_due() && !is_last {
            self.begin();
        } else if !is_last {
            self.engine.start();
        }
        Ok(())
    }

    /// The next step at which something is due. Known in advance, since to ask in every step takes some divisions.
    fn event_after(&self, step: u64) -> u64 {
        let Derived { sample_steps, frame_steps, .. } = self.derived;
        let intervals = [CHECK_STEPS, sample_steps, frame_steps, memory_order::INTERVAL];
        intervals.into_iter().map(|interval| (step / interval + 1) * interval).min().unwrap_or(step + 1)
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
        DrumMotion { rotation, angular_velocity: turn / duration, step: self.state.step, duration }
    }

    /// The angle by which the drum turns in a step [rad].
    pub(super) fn turn_of(&self, step: u64) -> f64 {
        let (from, to) = (self.time_at(step - 1), self.time_at(step));
        match self.derived.steady_speed {
            Some(speed) => (to - from) * speed,
            None => self.config.rotation.angle_increment(from, to),
        }
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

    /// Whether the whole load is checked: at fixed steps, so that neither lists nor slices of a run show in an error.
    fn is_check_due(&self) -> bool {
        self.state.step.is_multiple_of(CHECK_STEPS) || self.is_sample_due()
    }

    fn is_sort_due(&self) -> bool {
        self.state.step > 0 && memory_order::is_due(self.state.particles.len(), self.state.step)
    }
}
