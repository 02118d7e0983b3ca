//! The list of laws: which base law a simulation has, and which terms act with it.

use super::adhesion::Adhesion;
use super::hertz::Hertz;
use super::law::ContactLaw;
use super::linear::Linear;
use super::parameters::{Base, ContactParameters};
use super::rolling::RollingResistance;
use super::species::SpeciesTable;
use super::tangential_dashpot::TangentialDashpot;

/// The terms that act with the linear law, in this order.
pub type Terms = (RollingResistance, (TangentialDashpot, Adhesion));

/// The base law alone, tension allowed.
pub type BareLaw = Linear<false>;
/// The base law alone, tension clipped for some contacts.
pub type ClippedLaw = Linear<true>;
/// The base law with all terms.
pub type FullLaw = (Linear<true>, Terms);

/// Hertz–Mindlin alone.
pub type BareHertzLaw = Hertz;
/// Hertz–Mindlin with the terms that do not go with the tangential stiffness.
pub type FullHertzLaw = (Hertz, Adhesion);

/// What is made for a law, once it is known which.
pub trait ForLaw {
    /// What comes of it.
    type Made;
    /// Makes it for a law.
    fn make<L: ContactLaw>(self) -> Self::Made;
}

/// Which law a simulation has. Chosen once: a term that is 0 for every pair costs nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Model {
    /// `BareLaw`
    Bare,
    /// `ClippedLaw`
    Clipped,
    /// `FullLaw`
    Full,
    /// `BareHertzLaw`
    Hertz,
    /// `FullHertzLaw`
    FullHertz,
}

impl Model {
    /// Makes what is to be made for this law.
    pub fn make<F: ForLaw>(self, for_law: F) -> F::Made {
        match self {
            Self::Bare => for_law.make::<BareLaw>(),
            Self::Clipped => for_law.make::<ClippedLaw>(),
            Self::Full => for_law.make::<FullLaw>(),
            Self::Hertz => for_law.make::<BareHertzLaw>(),
            Self::FullHertz => for_law.make::<FullHertzLaw>(),
        }
    }

    /// The simplest one that does what the table asks for.
    pub fn of(table: &SpeciesTable) -> Self {
        let has_terms = table.all().any(ContactParameters::has_terms);
        match table.base() {
            Base::Hertz if has_terms => Self::FullHertz,
            Base::Hertz => Self::Hertz,
            Base::Linear if has_terms => Self::Full,
            Base::Linear if table.clips() => Self::Clipped,
            Base::Linear => Self::Bare,
        }
    }
}
