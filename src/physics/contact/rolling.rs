//! Rolling resistance of type C: a rotational spring that yields (Ai et al., Powder Technology 206 (2011) 269).

use super::law::{BodyPair, ContactTerm};
use super::linear::TruncatedSpring;
use super::parameters::ContactParameters;
use super::{Flows, Kinematics, Response, Stored};
use crate::physics::columns::columns;
use crate::physics::scalar::Scalar;

columns! {
    /// Mᵣ = −kᵣ φ  with |Mᵣ| ≤ μᵣ R̄ |Fₙ|
    ///
    /// φ grows by (ωᵢ − ωⱼ) Δt, Fₙ is the force that presses the bodies together, and kᵣ = kₛ R̄² makes rolling as stiff
    /// as shearing, so that it needs no dashpot of its own. Where the spring would exceed the limit it is truncated to it,
    /// and the lost angle is rolling friction. The moment acts on both bodies, on the drum, too.
    pub struct RollingResistance {
        /// Stiffness kᵣ [N m/m per rad].
        stiffness,
        /// μᵣ R̄ / kᵣ [rad per N/m]: the angle at which a unit of normal force lets the contact roll.
        roll_compliance,
    }
}

columns! {
    /// What the spring remembers.
    pub struct RollingHistory {
        /// Angle φ of the spring [rad].
        rolling_displacement,
    }
}

impl ContactTerm for RollingResistance {
    type History = RollingHistory;
    const FLOWS: Flows<bool> = Flows { dissipated_rolling: true, ..Flows::NONE };
    const ROLLS: bool = true;

    fn between(parameters: &ContactParameters, bodies: BodyPair) -> RollingResistance<f64> {
        let radius = bodies.effective_radius;
        let stiffness = parameters.stiffness_ratio * parameters.normal_stiffness * radius * radius;
        RollingResistance { stiffness, roll_compliance: parameters.rolling_friction * radius / stiffness }
    }

    #[inline(always)]
    fn act<S: Scalar>(
        term: &RollingResistance<S>,
        contact: &Kinematics<S>,
        history: &RollingHistory<S>,
        response: &mut Response<S>,
    ) -> RollingHistory<S> {
        let limit = term.roll_compliance * response.pressing_force.abs();
        let spring = TruncatedSpring::new(term.stiffness, limit, history.rolling_displacement, contact.roll);
        response.rolling_moment = response.rolling_moment - spring.force;
        response.flows.dissipated_rolling = spring.dissipated;
        RollingHistory { rolling_displacement: spring.displacement }
    }

    fn store(
        term: &RollingResistance<f64>,
        _overlap: f64,
        history: &RollingHistory<f64>,
        stored: &mut Stored<f64>,
    ) {
        let angle = history.rolling_displacement;
        stored.elastic_rolling += 0.5 * term.stiffness * angle * angle;
    }
}
