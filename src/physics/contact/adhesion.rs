//! A constant pull while bodies touch.

use super::law::{BodyPair, ContactTerm};
use super::parameters::ContactParameters;
use super::{Flows, Kinematics, Response, Stored};
use crate::physics::columns::columns;
use crate::physics::scalar::Scalar;

columns! {
    /// Fₙ = (force of spring and dashpot) − `F_c`  while the bodies touch
    ///
    /// Its potential is −`F_c` δ, so that it takes no energy. Friction and rolling are limited by the force of spring and
    /// dashpot, Fₙ + `F_c`: adhesion presses the bodies together. Where tension is clipped, spring and dashpot are, not the
    /// pull.
    pub struct Adhesion {
        /// `F_c` [N/m].
        pull,
    }
}

impl ContactTerm for Adhesion {
    type History = ();
    const FLOWS: Flows<bool> = Flows::NONE;

    fn between(parameters: &ContactParameters, _bodies: BodyPair) -> Adhesion<f64> {
        Adhesion { pull: parameters.adhesion }
    }

    #[inline(always)]
    fn act<S: Scalar>(term: &Adhesion<S>, contact: &Kinematics<S>, (): &(), response: &mut Response<S>) {
        response.normal_force = response.normal_force - term.pull.within(contact.touching);
    }

    fn store(term: &Adhesion<f64>, overlap: f64, (): &(), stored: &mut Stored<f64>) {
        stored.adhesion -= term.pull * overlap;
    }
}
