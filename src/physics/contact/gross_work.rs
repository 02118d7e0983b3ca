//! Gross work: the energy that contacts exchange, loading and unloading both counted.
//!
//! What a spring takes while it is loaded and gives back afterwards adds up to nothing in the net work. Park & Wassgren's
//! ratio of powers "includes both spring and dissipative elements", so it is read as N/T = Σ ∫ |Fₙ vₙ| dt / Σ ∫ |Fₜ vₜ| dt.

use super::Kinematics;
use crate::physics::columns::columns;
use crate::physics::scalar::Scalar;

columns! {
    /// Energy exchanged at contacts whichever way it goes, by direction [J/m].
    pub struct GrossWork {
        /// exchanged along normals
        gross_work_normal,
        /// exchanged along tangents
        gross_work_tangential,
    }
}

impl GrossWork {
    /// The symbols of the fields.
    pub const SYMBOLS: [&'static str; 2] = ["N_gross", "T_gross"];
    /// Their formulas.
    pub const FORMULAS: [&'static str; 2] = ["Σ ∫ |Fₙ vₙ| dt", "Σ ∫ |Fₜ vₜ| dt"];
}

impl<S: Scalar> GrossWork<S> {
    /// Of a contact in one step: the mean of the forces (normal, tangential) at its start and at its end, times the
    /// displacements within the contact.
    ///
    /// The normal force jumps at first touch and at the end of a contact, where a dashpot acts. In the steps in which a
    /// contact opens or ends it is therefore taken as it is at their other end: the mean with 0 would be too small by
    /// ¼ ν v² Δt, 1 % of an impact at Table 1's step.
    #[inline(always)]
    pub fn of_step(contact: &Kinematics<S>, last: [S; 2], now: [S; 2]) -> Self {
        let mean = |way: usize| (last[way] + now[way]) * S::splat(0.5);
        let normal = S::select(contact.touching, S::select(contact.opening, now[0], mean(0)), last[0]);
        Self {
            gross_work_normal: (normal * contact.travel).abs(),
            gross_work_tangential: (mean(1) * contact.slip).abs(),
        }
    }
}
