//! The energy ledger: what the drum gave, where it went, and what is left unexplained (round-off alone).
//!
//! Each contact is charged ½ (Fₙ + Fₙ₊₁) · Δx over each step, the steps in which it opens and closes included. Together
//! with the kinetic energy ½ m v₋·v₊ this is an identity of the leapfrog, at any time step. What springs and dashpots
//! by their own formulas do not account for of that work is the column "numerical", which falls with the time step.

use serde::{Deserialize, Serialize};

use crate::physics::vector::Vec2;

/// A sum whose rounding errors are kept and added back (Neumaier's compensated summation).
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Sum {
    total: f64,
    lost: f64,
}

impl Sum {
    /// Adds `value`.
    #[inline]
    pub fn add(&mut self, value: f64) {
        let total = self.total + value;
        self.lost += if self.total.abs() >= value.abs() {
            (self.total - total) + value
        } else {
            (value - total) + self.total
        };
        self.total = total;
    }

    /// The sum so far.
    pub fn value(&self) -> f64 {
        self.total + self.lost
    }
}

/// Work that contacts took in one step, and the step's deepest overlap.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StepFlows {
    /// Work into contacts along their normals [J/m].
    pub work_normal: f64,
    /// Work into contacts along their tangents [J/m].
    pub work_tangential: f64,
    /// Taken by dashpots [J/m].
    pub dissipated_normal: f64,
    /// Taken by sliding [J/m].
    pub dissipated_sliding: f64,
    /// Greatest overlap over the smaller radius.
    pub overlap_ratio: f64,
}

impl StepFlows {
    /// Adds the flows of another part of the load.
    pub fn add(&mut self, other: &Self) {
        self.work_normal += other.work_normal;
        self.work_tangential += other.work_tangential;
        self.dissipated_normal += other.dissipated_normal;
        self.dissipated_sliding += other.dissipated_sliding;
        self.overlap_ratio = self.overlap_ratio.max(other.overlap_ratio);
    }
}

/// What one surface of the drum (rim, baffle, wall) does to the load.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct SurfaceLoad {
    /// Force on the load [N/m].
    pub force: Vec2,
    /// Moment on the load about the drum's axis [N m/m].
    pub moment: f64,
}

/// A surface's account.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct SurfaceAccount {
    /// Work done on the load [J/m].
    pub work: Sum,
    /// ∫ force on the load dt [N s/m], x and y.
    pub impulse: [Sum; 2],
    /// ∫ moment on the load about the axis dt [N m s/m].
    pub angular_impulse: Sum,
    /// Load at the last step.
    last: SurfaceLoad,
}

/// Energy stored at one instant [J/m].
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct StoredEnergy {
    /// Kinetic energy of translation, in the leapfrog's form.
    pub kinetic_translation: f64,
    /// Kinetic energy of rotation, likewise.
    pub kinetic_rotation: f64,
    /// Potential energy, zero at the drum's axis.
    pub gravitational: f64,
    /// Normal springs.
    pub elastic_normal: f64,
    /// Tangential springs.
    pub elastic_tangential: f64,
}

impl StoredEnergy {
    /// Kinetic and gravitational energy.
    pub fn of_motion(&self) -> f64 {
        self.kinetic_translation + self.kinetic_rotation + self.gravitational
    }

    /// Sum of the parts' magnitudes: the scale that round-off is held against.
    fn scale(&self) -> f64 {
        self.kinetic_translation.abs()
            + self.kinetic_rotation.abs()
            + self.gravitational.abs()
            + self.elastic_normal
            + self.elastic_tangential
    }
}

/// The moments that the third power, Ω (M g x + dL/dt), is made of, at the end of a step.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Balance {
    /// Σ m x [kg].
    pub mass_moment: Vec2,
    /// Moment of gravity about the axis, plus that of any lock on the spins taken away [N m/m].
    pub outer_moment: f64,
    /// Angular momentum about the axis [kg m/s], needed only where the speed of the drum changes.
    pub angular_momentum: f64,
}

/// All accounts since the start.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EnergyLedger {
    /// Work into contacts along their normals [J/m].
    pub work_normal: Sum,
    /// Work into contacts along their tangents [J/m].
    pub work_tangential: Sum,
    /// Taken by dashpots [J/m].
    pub dissipated_normal: Sum,
    /// Taken by sliding [J/m].
    pub dissipated_sliding: Sum,
    /// Rim, baffles, walls.
    pub surfaces: Vec<SurfaceAccount>,
    /// ∫ Ω (dL/dt − outer moment) dt, without the part of L that telescopes at a constant speed [J/m].
    balance_work: Sum,
    /// ∫ Σ m x dt [kg s], x and y.
    pub mass_moment: [Sum; 2],
    last: Balance,
    initial: StoredEnergy,
    initial_angular_momentum: f64,
    greatest_stored: f64,
    /// Greatest overlap ratio since it was last recorded.
    pub overlap_ratio: f64,
}

impl EnergyLedger {
    /// Accounts opened with what is stored, and what pushes, at the start.
    pub fn open(stored: StoredEnergy, balance: Balance, surfaces: &[SurfaceLoad]) -> Self {
        let account = |&last: &SurfaceLoad| SurfaceAccount { last, ..SurfaceAccount::default() };
        Self {
            work_normal: Sum::default(),
            work_tangential: Sum::default(),
            dissipated_normal: Sum::default(),
            dissipated_sliding: Sum::default(),
            surfaces: surfaces.iter().map(account).collect(),
            balance_work: Sum::default(),
            mass_moment: [Sum::default(); 2],
            last: balance,
            initial: stored,
            initial_angular_momentum: balance.angular_momentum,
            greatest_stored: stored.scale(),
            overlap_ratio: 0.0,
        }
    }

    /// Charges one step, in which the drum turned by `turn` [rad] within `time_step` [s].
    pub fn charge(&mut self, flows: &StepFlows, surfaces: &[SurfaceLoad], turn: f64, time_step: f64) {
        self.work_normal.add(flows.work_normal);
        self.work_tangential.add(flows.work_tangential);
        self.dissipated_normal.add(flows.dissipated_normal);
        self.dissipated_sliding.add(flows.dissipated_sliding);
        self.overlap_ratio = self.overlap_ratio.max(flows.overlap_ratio);
        for (account, now) in self.surfaces.iter_mut().zip(surfaces) {
            let moment = 0.5 * (account.last.moment + now.moment);
            account.work.add(moment * turn);
            account.angular_impulse.add(moment * time_step);
            account.impulse[0].add(0.5 * (account.last.force.x + now.force.x) * time_step);
            account.impulse[1].add(0.5 * (account.last.force.y + now.force.y) * time_step);
            account.last = *now;
        }
    }

    /// Charges the balance of moments over one step. At a constant speed `steady` the angular momentum is left to
    /// telescope, and `now.angular_momentum` is not read.
    pub fn charge_balance(&mut self, now: Balance, turn: f64, time_step: f64, steady: bool) {
        let mean_moment = 0.5 * (self.last.outer_moment + now.outer_moment);
        let mut moment = -mean_moment;
        if !steady {
            moment += (now.angular_momentum - self.last.angular_momentum) / time_step;
        }
        self.balance_work.add(moment * turn);
        self.mass_moment[0].add(0.5 * (self.last.mass_moment.x + now.mass_moment.x) * time_step);
        self.mass_moment[1].add(0.5 * (self.last.mass_moment.y + now.mass_moment.y) * time_step);
        self.last = now;
    }

    /// Takes note of the energy stored at a sample.
    pub fn note(&mut self, stored: &StoredEnergy) {
        self.greatest_stored = self.greatest_stored.max(stored.scale());
    }

    /// Σ m x now [kg].
    pub fn mass_moment_now(&self) -> Vec2 {
        self.last.mass_moment
    }

    /// Work of the whole drum on the load [J/m]: the first of the three powers, integrated.
    pub fn drum_work(&self) -> f64 {
        self.surfaces.iter().map(|surface| surface.work.value()).sum()
    }

    /// ∫ Ω (M g x + dL/dt) dt [J/m]: the third of the three powers, integrated. `steady_speed` is the drum's speed
    /// where it is constant.
    pub fn balance_work(&self, angular_momentum: f64, steady_speed: Option<f64>) -> f64 {
        let telescoped =
            steady_speed.map_or(0.0, |speed| speed * (angular_momentum - self.initial_angular_momentum));
        self.balance_work.value() + telescoped
    }

    /// Work into contacts that neither springs, dashpots nor sliding account for [J/m].
    pub fn numerical(&self, stored: &StoredEnergy) -> f64 {
        let work = self.work_normal.value() + self.work_tangential.value();
        let elastic = stored.elastic_normal + stored.elastic_tangential;
        let initial = self.initial.elastic_normal + self.initial.elastic_tangential;
        work - (elastic - initial) - self.dissipated_normal.value() - self.dissipated_sliding.value()
    }

    /// Stored + dissipated − work of the drum − initial [J/m]: zero but for round-off.
    pub fn residual(&self, stored: &StoredEnergy) -> f64 {
        let contacts = self.work_normal.value() + self.work_tangential.value();
        (stored.of_motion() - self.initial.of_motion()) + contacts - self.drum_work()
    }

    /// |residual| over the greater of Σ |flows| and the greatest stored energy; 0 where both vanish.
    pub fn relative_residual(&self, stored: &StoredEnergy) -> f64 {
        let flows = self.drum_work().abs()
            + self.dissipated_normal.value().abs()
            + self.dissipated_sliding.value().abs()
            + self.numerical(stored).abs();
        let scale = flows.max(self.greatest_stored);
        if scale > 0.0 { self.residual(stored).abs() / scale } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_compensated_sum_keeps_what_a_plain_one_loses() {
        let mut sum = Sum::default();
        for value in [1.0, 1e100, 1.0, -1e100] {
            sum.add(value);
        }
        assert_eq!(sum.value(), 2.0);
    }
}
