//! What a simulation charges to its ledger after each step, and what it records now and then.

use super::Simulation;
use crate::observe::recorder::Snapshot;
use crate::physics::energy::{Balance, StoredEnergy};
use crate::physics::vector::{Vec2, dot};
use crate::start;

impl Simulation {
    /// Charges one step, in which the drum turned by `turn` [rad].
    pub(super) fn charge(&mut self, mass_moment: Vec2, turn: f64) {
        let steady = self.fixed.steady_speed.is_some();
        let mut balance = self.balance(mass_moment);
        if !steady {
            balance.angular_momentum = self.state.particles.angular_momentum();
        }
        let ledger = &mut self.state.ledger;
        ledger.charge(&self.forces.flows, &self.forces.surfaces, turn, self.fixed.time_step);
        ledger.charge_balance(balance, turn, self.fixed.time_step, steady);
    }

    /// The balance of moments now, but for the angular momentum.
    pub(super) fn balance(&self, mass_moment: Vec2) -> Balance {
        let gravity = self.fixed.gravity;
        let mut outer_moment = mass_moment.x * gravity.y - mass_moment.y * gravity.x;
        if self.config.load.spin_locked {
            // What holds the spins takes the contacts' moments out of the load.
            outer_moment -= self.forces.loads.iter().fold(0.0, |sum, load| sum + load.moment());
        }
        Balance { mass_moment, outer_moment, angular_momentum: 0.0 }
    }

    /// Records a sample or a frame where one is due.
    pub(super) fn record(&mut self) {
        let (step, time) = (self.state.step, self.time());
        if step.is_multiple_of(self.fixed.sample_steps) {
            self.sample(time);
        }
        if step.is_multiple_of(self.fixed.frame_steps) {
            let angle = self.config.rotation.angle(time);
            self.state.frames.push(time, angle, &self.state.particles);
        }
    }

    fn sample(&mut self, time: f64) {
        let stored = self.stored();
        let angular_momentum = self.state.particles.angular_momentum();
        let state = &mut self.state;
        state.ledger.note(&stored);
        let snapshot = Snapshot {
            time,
            angle: self.config.rotation.angle(time),
            angular_velocity: self.config.rotation.angular_velocity(time),
            ledger: &state.ledger,
            stored,
            angular_momentum,
            balance_work: state.ledger.balance_work(angular_momentum, self.fixed.steady_speed),
            mass: self.fixed.mass,
            contacts: self.table.counts(),
            count: state.particles.len(),
            interval: time - state.series.last_time().unwrap_or(time),
            earlier: &state.series.earlier().clone(),
        };
        state.series.push(&snapshot);
        state.ledger.overlap_ratio = 0.0;
    }

    /// Energy stored now.
    pub fn stored(&self) -> StoredEnergy {
        let particles = &self.state.particles;
        let (kinetic_translation, kinetic_rotation) = particles.kinetic_energies(0.5 * self.fixed.time_step);
        let (elastic_normal, elastic_tangential) = start::elastic_energies(&self.table, &self.fixed.laws);
        let moment = start::mass_moment(particles);
        StoredEnergy {
            kinetic_translation,
            kinetic_rotation,
            gravitational: -dot(moment, self.fixed.gravity),
            elastic_normal,
            elastic_tangential,
        }
    }
}
