//! The list of laws: which base law a simulation has, and which terms act with it.

use super::adhesion::Adhesion;
use super::law::WithTerms;
use super::linear::Linear;
use super::rolling::RollingResistance;
use super::species::SpeciesTable;
use super::tangential_dashpot::TangentialDashpot;

/// The terms that act with a base law, in this order.
pub type Terms = (RollingResistance, (TangentialDashpot, Adhesion));

/// The base law alone, tension allowed.
pub type BareLaw = Linear<false>;
/// The base law alone, tension clipped for some contacts.
pub type ClippedLaw = Linear<true>;
/// The base law with all terms.
pub type FullLaw = WithTerms<Linear<true>, Terms>;

/// Which law a simulation has. Chosen once: a term that is 0 for every pair costs nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Model {
    /// `BareLaw`
    Bare,
    /// `ClippedLaw`
    Clipped,
    /// `FullLaw`
    Full,
}

impl Model {
    /// The simplest one that does what the table asks for.
    pub fn of(table: &SpeciesTable) -> Self {
        if table.all().any(super::parameters::ContactParameters::has_terms) {
            Self::Full
        } else if table.clips() {
            Self::Clipped
        } else {
            Self::Bare
        }
    }
}
