//! What a contact law is: a base law, and terms that act with it.
//!
//! A base law answers with the normal and the tangential force; a term (rolling resistance, a tangential dashpot, adhesion)
//! adds to that answer. Each is one file: its parameters and its history as `columns!`, one pure function, the energy that
//! it stores. A simulation has one base law, bare or with all terms.

use super::parameters::ContactParameters;
use super::{Kinematics, Response, Stored};
use crate::physics::columns::{Columns, Of, columns_of};
use crate::physics::scalar::Scalar;

/// What a law may depend on of two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyPair {
    /// m* = m₁ m₂ / (m₁ + m₂) [kg/m]; the mass of the one at a wall.
    pub effective_mass: f64,
    /// R̄ = r₁ r₂ / (r₁ + r₂) [m]; the radius of the one at a wall.
    pub effective_radius: f64,
    /// Diameter of the smaller disc [m]: the layer that a law of spheres is spread over.
    pub layer: f64,
}

impl BodyPair {
    /// Two discs, each given as (mass, radius).
    pub fn of_discs((mass, radius): (f64, f64), (other_mass, other_radius): (f64, f64)) -> Self {
        Self {
            effective_mass: mass * other_mass / (mass + other_mass),
            effective_radius: radius * other_radius / (radius + other_radius),
            layer: 2.0 * radius.min(other_radius),
        }
    }

    /// A disc of this mass and radius at a wall.
    pub fn at_wall((mass, radius): (f64, f64)) -> Self {
        Self { effective_mass: mass, effective_radius: radius, layer: 2.0 * radius }
    }
}

/// A law of contact. The type itself stands for the record of its parameters, see `Columns`.
pub trait ContactLaw: Columns {
    /// What must survive a step beyond `ContactState`.
    type History: Columns;
    /// The energies that it takes, as a set of `Flows`; others are not summed up.
    const FLOWS: u32;
    /// Whether the moments on the two bodies can differ where their arms are equal.
    const ROLLS: bool;

    /// The law between two bodies.
    fn between(parameters: &ContactParameters, bodies: BodyPair) -> Of<Self, f64>;

    /// Forces and losses of one step, and what is to be remembered.
    fn respond<S: Scalar>(
        law: &Of<Self, S>,
        contact: &Kinematics<S>,
        history: &Of<Self::History, S>,
    ) -> (Response<S>, Of<Self::History, S>);

    /// Energy that a contact holds at an overlap [J/m].
    fn stored(law: &Of<Self, f64>, overlap: f64, history: &Of<Self::History, f64>) -> Stored<f64>;
}

/// What acts beside a base law.
pub trait ContactTerm: Columns {
    /// What must survive a step.
    type History: Columns;
    /// The energies that it takes, as a set of `Flows`.
    const FLOWS: u32;

    /// The term between two bodies.
    fn between(parameters: &ContactParameters, bodies: BodyPair) -> Of<Self, f64>;

    /// Adds to what the base law answered. Returns what is to be remembered.
    fn act<S: Scalar>(
        term: &Of<Self, S>,
        contact: &Kinematics<S>,
        history: &Of<Self::History, S>,
        response: &mut Response<S>,
    ) -> Of<Self::History, S>;

    /// Adds the energy that a contact holds at an overlap [J/m].
    fn store(term: &Of<Self, f64>, overlap: f64, history: &Of<Self::History, f64>, stored: &mut Stored<f64>);
}

/// Two terms, one after the other.
impl<A: ContactTerm, B: ContactTerm> ContactTerm for (A, B) {
    type History = (A::History, B::History);
    const FLOWS: u32 = A::FLOWS | B::FLOWS;

    fn between(parameters: &ContactParameters, bodies: BodyPair) -> Of<Self, f64> {
        (A::between(parameters, bodies), B::between(parameters, bodies))
    }

    #[inline(always)]
    fn act<S: Scalar>(
        (one, other): &Of<Self, S>,
        contact: &Kinematics<S>,
        history: &Of<Self::History, S>,
        response: &mut Response<S>,
    ) -> Of<Self::History, S> {
        (A::act(one, contact, &history.0, response), B::act(other, contact, &history.1, response))
    }

    fn store(
        (one, other): &Of<Self, f64>,
        overlap: f64,
        history: &Of<Self::History, f64>,
        stored: &mut Stored<f64>,
    ) {
        A::store(one, overlap, &history.0, stored);
        B::store(other, overlap, &history.1, stored);
    }
}

/// No terms.
impl ContactTerm for () {
    type History = ();
    const FLOWS: u32 = 0;

    fn between(_parameters: &ContactParameters, _bodies: BodyPair) {}

    #[inline(always)]
    fn act<S: Scalar>((): &(), _contact: &Kinematics<S>, (): &(), _response: &mut Response<S>) {}

    fn store((): &(), _overlap: f64, (): &(), _stored: &mut Stored<f64>) {}
}

/// A base law with terms.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WithTerms<B, T>(B, T);

columns_of!([B: Columns, T: Columns] WithTerms<B, T> => (B, T));

impl<B: ContactLaw, T: ContactTerm> ContactLaw for WithTerms<B, T> {
    type History = (B::History, T::History);
    const FLOWS: u32 = B::FLOWS | T::FLOWS;
    const ROLLS: bool = true;

    fn between(parameters: &ContactParameters, bodies: BodyPair) -> Of<Self, f64> {
        (B::between(parameters, bodies), T::between(parameters, bodies))
    }

    #[inline(always)]
    fn respond<S: Scalar>(
        (base, terms): &Of<Self, S>,
        contact: &Kinematics<S>,
        history: &Of<Self::History, S>,
    ) -> (Response<S>, Of<Self::History, S>) {
        let (mut response, base_history) = B::respond(base, contact, &history.0);
        let term_history = T::act(terms, contact, &history.1, &mut response);
        (response, (base_history, term_history))
    }

    fn stored((base, terms): &Of<Self, f64>, overlap: f64, history: &Of<Self::History, f64>) -> Stored<f64> {
        let mut stored = B::stored(base, overlap, &history.0);
        T::store(terms, overlap, &history.1, &mut stored);
        stored
    }
}
