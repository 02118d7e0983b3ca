//! The list of laws: which base law a simulation has, and which terms act with it.

use super::adhesion::Adhesion;
use super::hertz::Hertz;
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

/// Does the same with the law of any model.
macro_rules! with_law {
    ($model:expr, $law:ident => $work:expr) => {{
        use $crate::physics::contact::model as laws;
        match $model {
            laws::Model::Bare => {
                type $law = laws::BareLaw;
                $work
            }
            laws::Model::Clipped => {
                type $law = laws::ClippedLaw;
                $work
            }
            laws::Model::Full => {
                type $law = laws::FullLaw;
                $work
            }
            laws::Model::Hertz => {
                type $law = laws::BareHertzLaw;
                $work
            }
            laws::Model::FullHertz => {
                type $law = laws::FullHertzLaw;
                $work
            }
        }
    }};
}
pub(crate) use with_law;
