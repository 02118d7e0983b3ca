//! What a contact law is: a base law, and terms that act with it.
//!
//! A base law answers with the normal and the tangential force; a term (rolling resistance, a tangential dashpot, adhesion)
//! adds to that answer. Each is one file: its parameters and its history as `columns!`, one pure function, the energy that
//! it stores. A simulation has one base law, bare or with all terms.

use std::fmt::Debug;

use super::parameters::ContactParameters;
use super::{Flows, Kinematics, Response, Stored};
use crate::physics::columns::{Columns, Of};
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

    /// Two equal discs of this mass and radius.
    pub fn of_equals((mass, radius): (f64, f64)) -> Self {
        Self { effective_mass: 0.5 * mass, effective_radius: 0.5 * radius, layer: 2.0 * radius }
    }

    /// A disc of this mass and radius at a wall.
    pub fn at_wall((mass, radius): (f64, f64)) -> Self {
        Self { effective_mass: mass, effective_radius: radius, layer: 2.0 * radius }
    }
}

/// A law of contact: a base law, alone or in front of terms.
pub trait ContactLaw: Copy + Debug + Default + PartialEq + Send + Sync + 'static {
    /// What it follows from between two bodies.
    type Parameters: Columns;
    /// What must survive a step beyond `ContactState`.
    type History: Columns;
    /// The energies that it takes; others are not summed up.
    const FLOWS: Flows<bool>;
    /// Whether the moments on the two bodies can differ where their arms are equal.
    const ROLLS: bool;
    /// Whether terms act beside the base law.
    const HAS_TERMS: bool = false;
    /// Whether it looks at a least normal force; asked of laws without terms only.
    const CLIPS: bool = false;
    /// Whether more is recorded of its contacts than the ledger needs.
    const IS_RECORDED: bool = false;

    /// The law between two bodies.
    fn between(parameters: &ContactParameters, bodies: BodyPair) -> Of<Self::Parameters, f64>;

    /// Forces and losses of one step, and what is to be remembered.
    fn respond<S: Scalar>(
        law: &Of<Self::Parameters, S>,
        contact: &Kinematics<S>,
        history: &Of<Self::History, S>,
    ) -> (Response<S>, Of<Self::History, S>);

    /// Energy that a contact holds at an overlap [J/m].
    fn stored(law: &Of<Self::Parameters, f64>, overlap: f64, history: &Of<Self::History, f64>)
    -> Stored<f64>;
}

/// What acts beside a base law: the record of its parameters.
pub trait ContactTerm: Columns {
    /// What must survive a step.
    type History: Columns;
    /// The energies that it takes.
    const FLOWS: Flows<bool>;
    /// Whether it makes the moments on the two bodies differ where their arms are equal.
    const ROLLS: bool = false;

    /// The term between two bodies.
    fn between(parameters: &ContactParameters, bodies: BodyPair) -> Of<Self, f64>;

    /// Adds to what the base law answered. Returns what is to be remembered.
    fn act<S: Scalar>(
        term: &Of<Self, S>,
        contact: &Kinematics<S>,
        history: &Of<Self::History, S>,
        response: &mut Response<S>,
    ) -> Of<Self::History, S>;

    /// Adds the energy that a contact holds at an overlap [J/m]; none where the term says nothing else.
    fn store(
        _term: &Of<Self, f64>,
        _overlap: f64,
        _history: &Of<Self::History, f64>,
        _stored: &mut Stored<f64>,
    ) {
    }
}

/// Two terms, one after the other.
impl<A: ContactTerm, B: ContactTerm> ContactTerm for (A, B) {
    type History = (A::History, B::History);
    const FLOWS: Flows<bool> = A::FLOWS.union(B::FLOWS);
    const ROLLS: bool = A::ROLLS || B::ROLLS;

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

/// A base law with terms.
impl<B: ContactLaw, T: ContactTerm> ContactLaw for (B, T) {
    type Parameters = (B::Parameters, T);
    type History = (B::History, T::History);
    const FLOWS: Flows<bool> = B::FLOWS.union(T::FLOWS);
    const ROLLS: bool = B::ROLLS || T::ROLLS;
    const HAS_TERMS: bool = true;

    fn between(parameters: &ContactParameters, bodies: BodyPair) -> Of<Self::Parameters, f64> {
        (B::between(parameters, bodies), T::between(parameters, bodies))
    }

    #[inline(always)]
    fn respond<S: Scalar>(
        (base, terms): &Of<Self::Parameters, S>,
        contact: &Kinematics<S>,
        history: &Of<Self::History, S>,
    ) -> (Response<S>, Of<Self::History, S>) {
        let (mut response, base_history) = B::respond(base, contact, &history.0);
        let term_history = T::act(terms, contact, &history.1, &mut response);
        (response, (base_history, term_history))
    }

    fn stored(
        (base, terms): &Of<Self::Parameters, f64>,
        overlap: f64,
        history: &Of<Self::History, f64>,
    ) -> Stored<f64> {
        let mut stored = B::stored(base, overlap, &history.0);
        T::store(terms, overlap, &history.1, &mut stored);
        stored
    }
}
