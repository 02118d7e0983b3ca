//! What one contact does from first touch to opening, added up: what is recorded of contacts on request.

use super::{Flows, Kinematics, Response};
use crate::physics::columns::columns;
use crate::physics::scalar::Scalar;

columns! {
    /// What a contact does to its bodies beside taking energy. All but the first is recorded at the drum alone.
    pub struct Exertion {
        /// Greatest normal force [N/m].
        greatest_force,
        /// ∫ Fₙ dt [N s/m].
        normal_impulse,
        /// ∫ Fₙ ds over the sliding distance [J/m], as Archard's law of wear has it.
        normal_force_slip,
        /// ∫ 2 |v| |F| f(γ) dt while the bodies approach [J/m], as Finnie's law of wear has it.
        finnie,
    }
}

/// The energies that a contact has taken, and what else it has done.
pub type Tally = (Flows, Exertion);

impl<S: Scalar> Exertion<S> {
    /// Of a contact with the drum in one step.
    ///
    /// The impulse is that of the leapfrog, each force over one step. Sliding takes μ |Fₙ| ds, so the loss over the limit of
    /// friction is the sliding distance, and Fₙ ds is the loss over μ; where there is no friction, all slip slides.
    ///
    /// With γ the angle of the velocity v of approach to the surface, f(γ) = sin 2γ − 3 sin² γ for tan γ < 1/3, cos² γ / 3
    /// beyond. Source: Finnie, Wear 3 (1960) 87, doi:10.1016/0043-1648(60)90055-7.
    #[inline(always)]
    pub fn of_wall_step(contact: &Kinematics<S>, response: &Response<S>) -> Self {
        let zero = S::zero();
        let (normal_force, tangential_force) = (response.normal_force, response.tangential_force);
        let pressing = response.pressing_force.abs();
        let slides_freely = !response.friction_limit.exceeds(zero);
        let limit = S::select(slides_freely, S::splat(1.0), response.friction_limit);
        let free_slip = pressing * contact.slip.abs();
        let slip_work = pressing * response.flows.dissipated_sliding / limit;
        let time_step = contact.time_step;
        // Velocities: along the normal towards the wall, and along it.
        let (into, along) = ((-contact.last_rate).larger(zero), contact.slip_rate.abs());
        let speed = (into * into + along * along).sqrt();
        let is_shallow = along.exceeds(into * S::splat(3.0));
        let cut = S::select(
            is_shallow,
            into * along * S::splat(2.0) - into * into * S::splat(3.0),
            along * along * S::splat(1.0 / 3.0),
        );
        // |v| f(γ): zero with the speed.
        let approaching = contact.touching & into.exceeds(zero);
        let cut = (cut / S::select(approaching, speed, S::splat(1.0))).within(approaching);
        let force = (normal_force * normal_force + tangential_force * tangential_force).sqrt();
        Self {
            greatest_force: normal_force,
            normal_impulse: normal_force * time_step,
            normal_force_slip: S::select(slides_freely, free_slip, slip_work),
            finnie: force * cut * time_step * S::splat(2.0),
        }
    }

    /// These of one step added to those before.
    #[inline(always)]
    #[must_use]
    pub fn plus(self, step: Self) -> Self {
        Self {
            greatest_force: step.greatest_force.larger(self.greatest_force),
            normal_impulse: self.normal_impulse + step.normal_impulse,
            normal_force_slip: self.normal_force_slip + step.normal_force_slip,
            finnie: self.finnie + step.finnie,
        }
    }
}
