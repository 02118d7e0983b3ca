//! A law that is compiled with records of its contacts, so that one without pays nothing for them.

use super::law::{BodyPair, ContactLaw};
use super::parameters::ContactParameters;
use super::{Flows, Kinematics, Response, Stored};
use crate::physics::columns::Of;
use crate::physics::scalar::Scalar;

/// The same law, of whose contacts more is recorded than the ledger needs.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WithRecords<L>(L);

impl<L: ContactLaw> ContactLaw for WithRecords<L> {
    type Parameters = L::Parameters;
    type History = L::History;
    const FLOWS: Flows<bool> = L::FLOWS;
    const ROLLS: bool = L::ROLLS;
    const HAS_TERMS: bool = L::HAS_TERMS;
    const CLIPS: bool = L::CLIPS;
    const IS_RECORDED: bool = true;

    fn between(parameters: &ContactParameters, bodies: BodyPair) -> Of<Self::Parameters, f64> {
        L::between(parameters, bodies)
    }

    #[inline(always)]
    fn respond<S: Scalar>(
        law: &Of<Self::Parameters, S>,
        contact: &Kinematics<S>,
        history: &Of<Self::History, S>,
    ) -> (Response<S>, Of<Self::History, S>) {
        L::respond(law, contact, history)
    }

    fn stored(
        law: &Of<Self::Parameters, f64>,
        overlap: f64,
        history: &Of<Self::History, f64>,
    ) -> Stored<f64> {
        L::stored(law, overlap, history)
    }
}
