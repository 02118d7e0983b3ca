//! What a simulation charges to its ledger after each step, and what it records now and then.

use super::Simulation;
use crate::error::Error;
use crate::observe::recorder::Snapshot;
use crate::physics::energy::StoredEnergy;
use crate::physics::vector::{Vec2, dot};

impl Simulation {
    /// Charges one step, in which the drum turned by `turn` [rad].
    pub(super) fn charge(&mut self, mass_moment: Vec2, turn: f64) {
        let outer_moment = self.outer_moment(mass_moment);
        let time_step = self.derived.time_step;
        let ledger = &mut self.state.ledger;
        ledger.charge_surfaces(self.engine.pass().surfaces(), turn, time_step);
        ledger.moments.charge(mass_moment, outer_moment, turn, time_step);
    }

    /// Moment of gravity about the axis, that of any lock on the spins taken away [N m/m].
    pub(super) fn outer_moment(&self, mass_moment: Vec2) -> f64 {
        let gravity = self.derived.gravity;
        let moment = mass_moment.x * gravity.y - mass_moment.y * gravity.x;
        if !self.config.load.spin_locked {
            return moment;
        }
        // What holds the spins takes the contacts' moments out of the load.
        moment - self.state.particles.torques.iter().fold(0.0, |sum, torque| sum + torque)
    }

    /// Whether this step's charge needs forces and velocities: where spins are locked, or where the drum's speed changes in
    /// this step or the next.
    pub(super) fn needs_moments(&self) -> bool {
        self.config.load.spin_locked || self.notes_angular_momentum()
    }

    fn notes_angular_momentum(&self) -> bool {
        let step = self.state.step;
        self.derived.steady_speed.is_none() && !(self.is_steady(step) && self.is_steady(step + 1))
    }

    /// Whether the drum's speed stays the same in a step.
    fn is_steady(&self, step: u64) -> bool {
        let (from, to) = (self.time_at(step - 1), self.time_at(step));
        self.derived.steady_speed.is_some() || self.config.rotation.is_steady(from, to)
    }

    /// Charges the change of angular momentum where it does not telescope. The velocities still lack half a kick.
    pub(super) fn charge_moments(&mut self) {
        if self.notes_angular_momentum() {
            let (half_step, gravity) = (0.5 * self.derived.time_step, self.derived.gravity);
            let now = self.state.particles.angular_momentum_after(half_step, gravity);
            self.note_angular_momentum(now);
        }
    }

    fn note_angular_momentum(&mut self, now: f64) {
        let step = self.state.step;
        let angular_velocity = match self.derived.steady_speed {
            Some(speed) => speed,
            None if self.is_steady(step) => self.config.rotation.angular_velocity(self.time()),
            None => self.turn_of(step) / self.derived.time_step,
        };
        self.state.ledger.moments.charge_angular_momentum(now, angular_velocity);
    }

    /// Records a sample or a frame where one is due; both or nothing.
    pub(super) fn record(&mut self) -> Result<(), Error> {
        self.state.recorded.is_pending = true;
        self.collect()?;
        if self.is_sample_due() {
            self.records.series.reserve()?;
        }
        if self.is_frame_due() {
            self.records.frames.reserve(1, self.state.particles.len(), "recording a frame")?;
        }
        self.state.recorded.is_pending = false;
        if self.is_sample_due() {
            self.sample();
        }
        if self.is_frame_due() {
            self.push_frame();
        }
        Ok(())
    }

    /// Records the frame at which a run has stopped on an error, so that what went wrong can be looked at. The step that fails
    /// records none itself. What single precision cannot hold is no picture.
    pub(super) fn record_end(&mut self) {
        let particles = &self.state.particles;
        let is_shown = |v: &Vec2| (v.x as f32).is_finite() && (v.y as f32).is_finite();
        let shown = particles.positions.iter().chain(&particles.velocities).all(is_shown);
        let is_whole = shown && particles.first_non_finite().is_none();
        // Where there is no memory for it, that is not what the run ended on.
        if is_whole && self.records.frames.reserve(1, particles.len(), "recording a frame").is_ok() {
            self.push_frame();
        }
    }

    fn push_frame(&mut self) {
        let (time, angle) = (self.time(), self.drum_angle());
        let particles = &self.state.particles;
        let contacts = self.records.frames.push(time, angle, particles);
        self.engine.pass().visit_bodies(&mut |particle| contacts[particles.ids[particle] as usize] += 1);
        self.state.recorded.frames += 1;
    }

    /// Brings the sums of the engine to the ledger.
    pub(super) fn fold(&mut self) {
        let folded = self.engine.pass_mut().fold();
        let taken = 0.5 * self.derived.time_step * folded.power;
        self.state.ledger.fold(taken, &folded.flows, folded.deepest);
        self.state.ledger.fold_gross_work(&folded.gross_work);
    }

    fn sample(&mut self) {
        let time = self.time();
        self.fold();
        let stored = self.stored();
        let angular_momentum = self.state.particles.angular_momentum();
        if self.state.step > 0 {
            self.note_angular_momentum(angular_momentum);
        }
        let angle = self.drum_angle();
        let state = &mut self.state;
        state.ledger.note(&stored);
        let snapshot = Snapshot {
            time,
            angle,
            angular_velocity: self.config.rotation.angular_velocity(time),
            ledger: &state.ledger,
            gross_work: self.derived.records_gross_work.then(|| state.ledger.gross_work()),
            stored,
            angular_momentum,
            mass: self.derived.mass,
            contacts: self.engine.pass().counts(),
            count: state.particles.len(),
            earlier: &state.recorded.earlier,
        };
        self.records.series.push(&snapshot);
        state.recorded.earlier = snapshot.for_next();
        state.recorded.samples += 1;
        state.ledger.overlap_ratio = 0.0;
        self.add_to_fields();
    }

    /// Energy stored now.
    pub fn stored(&self) -> StoredEnergy {
        let particles = &self.state.particles;
        let gravity = self.derived.gravity;
        let (kinetic_translation, kinetic_rotation) =
            particles.kinetic_energies(0.5 * self.derived.time_step, gravity);
        StoredEnergy {
            kinetic_translation,
            kinetic_rotation,
            gravitational: -dot(particles.mass_moment(), gravity),
            contacts: self.engine.pass().stored(),
        }
    }
}
