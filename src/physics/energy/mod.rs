//! The energy ledger: what the drum gave, where it went, and what is left unexplained (round-off alone).
//!
//! Each contact is charged ½ (Fₙ + Fₙ₊₁) · Δx over each step, the steps in which it opens and closes included. Together with
//! the kinetic energy ½ m v₋·v₊ this is an identity of the leapfrog, at any time step. What springs, dashpots and sliding by
//! their own formulas do not account for of that work is the column "numerical", which falls with the time step.

mod moments;
mod sum;

use std::ops::Sub;

use serde::{Deserialize, Serialize};

pub use moments::MomentBalance;
pub use sum::{Integrals, Sum};

use crate::physics::columns::Columns;
use crate::physics::contact::gross_work::GrossWork;
use crate::physics::contact::{Flows, Stored};
use crate::physics::vector::Vec2;

/// What one surface of the drum (rim, baffle, wall) does to the load.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct SurfaceLoad {
    /// Force on the load [N/m].
    pub force: Vec2,
    /// Moment on the load about the drum's axis [N m/m].
    pub moment: f64,
}

impl SurfaceLoad {
    /// The rates of a surface's account: of work by the angle, of angular impulse and impulse by time.
    fn rates(&self) -> [f64; 4] {
        [self.moment, self.moment, self.force.x, self.force.y]
    }
}

/// A surface's account.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct SurfaceAccount(Integrals);

impl SurfaceAccount {
    /// Work done on the load [J/m].
    pub fn work(&self) -> f64 {
        self.0.value(0)
    }

    /// ∫ moment on the load about the axis dt [N m s/m].
    pub fn angular_impulse(&self) -> f64 {
        self.0.value(1)
    }

    /// ∫ force on the load dt [N s/m], x and y.
    pub fn impulse(&self) -> [f64; 2] {
        [self.0.value(2), self.0.value(3)]
    }
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
    /// What contacts hold.
    pub contacts: Stored<f64>,
}

impl StoredEnergy {
    /// Kinetic and gravitational energy.
    pub fn of_motion(&self) -> f64 {
        self.kinetic_translation + self.kinetic_rotation + self.gravitational
    }

    /// What contacts hold, all together.
    pub fn of_contacts(&self) -> f64 {
        Stored::values(&self.contacts).sum()
    }

    /// Sum of the parts' magnitudes: the scale that round-off is held against.
    fn scale(&self) -> f64 {
        let contacts: f64 = Stored::values(&self.contacts).map(f64::abs).sum();
        self.kinetic_translation.abs() + self.kinetic_rotation.abs() + self.gravitational.abs() + contacts
    }
}

/// All accounts since the start. Sums over contacts are kept by the engine between two samples, and folded in here.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct EnergyLedger {
    /// Work that contacts took out of the particles [J/m].
    taken: Sum,
    flows: Flows<Sum>,
    gross_work: GrossWork<Sum>,
    /// Rim, baffles, walls.
    pub surfaces: Vec<SurfaceAccount>,
    /// The third power.
    pub moments: MomentBalance,
    initial: StoredEnergy,
    greatest_stored: f64,
    /// Greatest overlap ratio before the last fold and since it was last recorded.
    pub overlap_ratio: f64,
}

impl EnergyLedger {
    /// Accounts opened with what is stored, and what pushes, at the start.
    pub fn open(stored: StoredEnergy, moments: MomentBalance, surfaces: &[SurfaceLoad]) -> Self {
        Self {
            surfaces: surfaces.iter().map(|load| SurfaceAccount(Integrals::from(load.rates()))).collect(),
            moments,
            initial: stored,
            greatest_stored: stored.scale(),
            ..Self::default()
        }
    }

    /// Charges one step to the surfaces, in which the drum turned by `turn` [rad] within `time_step` [s].
    #[inline]
    pub fn charge_surfaces(&mut self, surfaces: &[SurfaceLoad], turn: f64, time_step: f64) {
        let half = 0.5 * time_step;
        for (account, now) in self.surfaces.iter_mut().zip(surfaces) {
            account.0.advance(now.rates(), [0.5 * turn, half, half, half]);
        }
    }

    /// Brings the sums since the last fold to the others: work that contacts took out of the particles, and flows.
    pub fn fold(&mut self, taken: f64, flows: &Flows<f64>, overlap_ratio: f64) {
        self.taken.add(taken);
        for flow in 0..Flows::COUNT {
            Flows::field_mut(&mut self.flows, flow).add(Flows::field(flows, flow));
        }
        self.overlap_ratio = self.overlap_ratio.max(overlap_ratio);
        self.surfaces.iter_mut().for_each(|account| account.0.fold());
        self.moments.fold();
    }

    /// Brings the gross work since the last fold to the rest. No balance needs it.
    pub fn fold_gross_work(&mut self, gross_work: &GrossWork<f64>) {
        for way in 0..GrossWork::COUNT {
            GrossWork::field_mut(&mut self.gross_work, way).add(GrossWork::field(gross_work, way));
        }
    }

    /// Gross work since the start [J/m]; 0 where it is not recorded.
    pub fn gross_work(&self) -> GrossWork<f64> {
        GrossWork::map(&self.gross_work, |sum| sum.value())
    }

    /// Takes note of the energy stored at a sample.
    pub fn note(&mut self, stored: &StoredEnergy) {
        self.greatest_stored = self.greatest_stored.max(stored.scale());
    }

    /// Energy taken by one flow [J/m].
    pub fn flow(&self, flow: usize) -> f64 {
        Flows::field(&self.flows, flow).value()
    }

    /// Energy taken by all flows [J/m].
    pub fn dissipated(&self) -> f64 {
        Flows::values(&self.flows).map(|sum| sum.value()).sum()
    }

    /// What contacts hold more than at the start, part by part [J/m].
    pub fn stored_since_start(&self, stored: &StoredEnergy) -> Stored<f64> {
        Stored::zip(&stored.contacts, &self.initial.contacts, f64::sub)
    }

    /// Work of the whole drum on the load [J/m]: the first of the three powers, integrated.
    pub fn drum_work(&self) -> f64 {
        self.surfaces.iter().map(SurfaceAccount::work).sum()
    }

    /// Work into contacts that their laws do not account for [J/m].
    pub fn numerical(&self, stored: &StoredEnergy) -> f64 {
        let work = self.taken.value() + self.drum_work();
        work - (stored.of_contacts() - self.initial.of_contacts()) - self.dissipated()
    }

    /// Stored + dissipated + numerical − work of the drum − initial [J/m]: zero but for round-off.
    pub fn residual(&self, stored: &StoredEnergy) -> f64 {
        (stored.of_motion() - self.initial.of_motion()) + self.taken.value()
    }

    /// |residual| over the greater of Σ |flows| and the greatest stored energy; 0 where both vanish.
    pub fn relative_residual(&self, stored: &StoredEnergy) -> f64 {
        let flows: f64 = Flows::values(&self.flows).map(|sum| sum.value().abs()).sum();
        let flows = self.drum_work().abs() + flows + self.numerical(stored).abs();
        let scale = flows.max(self.greatest_stored);
        if scale > 0.0 { self.residual(stored).abs() / scale } else { 0.0 }
    }
}
