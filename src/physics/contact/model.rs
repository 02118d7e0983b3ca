//! The list of laws: which base law a simulation has, which terms act with it, and whether its gross work is recorded.

use super::adhesion::Adhesion;
use super::gross_work::WithGrossWork;
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

/// `ClippedLaw` with its gross work; where tension is allowed, nothing is clipped.
pub type ClippedGrossLaw = WithGrossWork<ClippedLaw>;
/// `FullLaw` with its gross work.
pub type FullGrossLaw = WithGrossWork<FullLaw>;
/// `FullHertzLaw` with its gross work.
pub type FullHertzGrossLaw = WithGrossWork<FullHertzLaw>;

/// Which law a simulation has. Chosen once: a term that is 0 for every pair costs nothing, nor does gross work that is not
/// recorded.
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
    /// `ClippedGrossLaw`
    ClippedGross,
    /// `FullGrossLaw`
    FullGross,
    /// `FullHertzGrossLaw`
    FullHertzGross,
}

impl Model {
    /// The simplest one that does what the table asks for.
    pub fn of(table: &SpeciesTable, records_gross_work: bool) -> Self {
        let has_terms = table.all().any(ContactParameters::has_terms);
        match table.base() {
            Base::Hertz if records_gross_work => Self::FullHertzGross,
            Base::Linear if records_gross_work && has_terms => Self::FullGross,
            Base::Linear if records_gross_work => Self::ClippedGross,
            Base::Hertz if has_terms => Self::FullHertz,
            Base::Hertz => Self::Hertz,
            Base::Linear if has_terms => Self::Full,
            Base::Linear if table.clips() => Self::Clipped,
            Base::Linear => Self::Bare,
        }
    }
}

/// Does the same with the law of any model: each value of `Model` with its type.
macro_rules! with_law {
    ($model:expr, $law:ident => $work:expr) => {
        $crate::physics::contact::model::with_law!($model, $law => $work;
            Bare BareLaw, Clipped ClippedLaw, Full FullLaw, Hertz BareHertzLaw, FullHertz FullHertzLaw,
            ClippedGross ClippedGrossLaw, FullGross FullGrossLaw, FullHertzGross FullHertzGrossLaw)
    };
    ($model:expr, $law:ident => $work:expr; $($value:ident $type:ident),*) => {{
        use $crate::physics::contact::model as laws;
        match $model {
            $(laws::Model::$value => {
                type $law = laws::$type;
                $work
            })*
        }
    }};
}
pub(crate) use with_law;
