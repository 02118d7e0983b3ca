//! The list of laws: which base law a simulation has, which terms act with it, and whether more is recorded of its contacts.

use super::adhesion::Adhesion;
use super::hertz::Hertz;
use super::linear::Linear;
use super::parameters::{Base, ContactParameters};
use super::rolling::RollingResistance;
use super::species::SpeciesTable;
use super::tangential_dashpot::TangentialDashpot;
use super::with_records::WithRecords;

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

/// `BareLaw` with records.
pub type RecordedBareLaw = WithRecords<BareLaw>;
/// `ClippedLaw` with records.
pub type RecordedClippedLaw = WithRecords<ClippedLaw>;
/// `FullLaw` with records.
pub type RecordedFullLaw = WithRecords<FullLaw>;
/// `FullHertzLaw` with records.
pub type RecordedFullHertzLaw = WithRecords<FullHertzLaw>;

/// Which law a simulation has. Chosen once: a term that is 0 for every pair costs nothing, nor does a record that nobody asked
/// for.
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
    /// `RecordedBareLaw`
    RecordedBare,
    /// `RecordedClippedLaw`
    RecordedClipped,
    /// `RecordedFullLaw`
    RecordedFull,
    /// `RecordedFullHertzLaw`
    RecordedFullHertz,
}

impl Model {
    /// The simplest one that does what the table asks for, with records of contacts or not.
    pub fn of(table: &SpeciesTable, is_recorded: bool) -> Self {
        let has_terms = table.all().any(ContactParameters::has_terms);
        match table.base() {
            Base::Hertz if is_recorded => Self::RecordedFullHertz,
            Base::Linear if is_recorded && has_terms => Self::RecordedFull,
            Base::Linear if is_recorded && table.clips() => Self::RecordedClipped,
            Base::Linear if is_recorded => Self::RecordedBare,
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
            RecordedBare RecordedBareLaw, RecordedClipped RecordedClippedLaw, RecordedFull RecordedFullLaw,
            RecordedFullHertz RecordedFullHertzLaw)
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
