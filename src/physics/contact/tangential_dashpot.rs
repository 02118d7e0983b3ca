//! A dashpot beside the tangential spring, which acts while the contact sticks.

use super::law::{BodyPair, ContactTerm};
use super::parameters::ContactParameters;
use super::{Flows, Kinematics, Response};
use crate::physics::columns::columns;
use crate::physics::scalar::Scalar;

columns! {
    /// Fₜ = kₛ ξ + νₜ ξ̇  with |Fₜ| ≤ μ |Fₙ|,   νₜ = 2 ζₜ √(kₛ mₜ),  mₜ = m* / 3
    ///
    /// mₜ is what discs oppose to a tangential force at their rims: 1/mₜ = 1/m* + Σ r²/I = 3/m*. Where the spring alone slides,
    /// the dashpot rests.
    pub struct TangentialDashpot {
        /// Damping νₜ [N s/m].
        tangential_damping,
    }
}

columns! {
    /// What the dashpot remembers.
    pub struct SlipHistory {
        /// Rate of slip in the middle of the last step [m/s].
        slip_rate,
    }
}

impl ContactTerm for TangentialDashpot {
    type History = SlipHistory;
    const FLOWS: Flows<bool> = Flows { dissipated_tangential: true, ..Flows::NONE };

    fn between(parameters: &ContactParameters, bodies: BodyPair) -> TangentialDashpot<f64> {
        let stiffness = parameters.stiffness_ratio * parameters.normal_stiffness;
        let mass = bodies.effective_mass / 3.0;
        TangentialDashpot {
            tangential_damping: 2.0 * parameters.tangential_damping_ratio * (stiffness * mass).sqrt(),
        }
    }

    #[inline(always)]
    fn act<S: Scalar>(
        term: &TangentialDashpot<S>,
        contact: &Kinematics<S>,
        history: &SlipHistory<S>,
        response: &mut Response<S>,
    ) -> SlipHistory<S> {
        let (spring, limit) = (response.tangential_force, response.friction_limit);
        let acting = contact.touching & response.sticking;
        let last_rate = S::select(contact.opening, contact.slip_rate, history.slip_rate);
        // At the time of the force, as the normal dashpot; its loss is that of the middle of the step.
        let rate = contact.slip_rate * S::splat(1.5) - last_rate * S::splat(0.5);
        let with_dashpot =
            |rate: S| (spring + (term.tangential_damping * rate).within(acting)).clamped(limit);
        let mean_force = with_dashpot(contact.slip * contact.step_rate) - spring;
        response.flows.dissipated_tangential = (mean_force * contact.slip).larger(S::zero());
        response.tangential_force = with_dashpot(rate);
        SlipHistory { slip_rate: contact.slip_rate.within(contact.touching) }
    }
}
