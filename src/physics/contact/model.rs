//! The list of laws: which base law a simulation has, which terms act with it, and whether more is recorded of its contacts.

use super::adhesion::Adhesion;
use super::parameters::{Base, ContactParameters};
use super::rolling::RollingResistance;
use super::species::SpeciesTable;
use super::tangential_dashpot::TangentialDashpot;

/// The terms that act with the linear law, in this order.
pub type Terms = (RollingResistance, (TangentialDashpot, Adhesion));

/// Which law a simulation has. Chosen once: a term that is 0 for every pair costs nothing, nor does a record that is not asked
/// for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Model {
    /// The linear law alone, tension allowed.
    Bare,
    /// The same, tension clipped for some contacts.
    Clipped,
    /// The linear law with all terms.
    Full,
    /// Hertz–Mindlin with the terms that do not go with the tangential stiffness.
    Hertz,
    /// `Bare` with records.
    RecordedBare,
    /// `Clipped` with records.
    RecordedClipped,
    /// `Full` with records.
    RecordedFull,
    /// `Hertz` with records.
    RecordedHertz,
}

impl Model {
    /// The simplest one that does what the table asks for, with records of contacts or not.
    pub fn of(table: &SpeciesTable, is_recorded: bool) -> Self {
        let has_terms = table.all().any(ContactParameters::has_terms);
        match (table.base(), is_recorded, has_terms) {
            (Base::Linear, false, false) if table.clips() => Self::Clipped,
            (Base::Linear, false, false) => Self::Bare,
            (Base::Linear, false, true) => Self::Full,
            (Base::Linear, true, false) if table.clips() => Self::RecordedClipped,
            (Base::Linear, true, false) => Self::RecordedBare,
            (Base::Linear, true, true) => Self::RecordedFull,
            (Base::Hertz, false, _) => Self::Hertz,
            (Base::Hertz, true, _) => Self::RecordedHertz,
        }
    }
}

/// Does the same with the law of any model: each value of `Model` with its type.
macro_rules! with_law {
    ($model:expr, $law:ident => $work:expr) => {
        $crate::physics::contact::model::with_law!($model, $law => $work;
            Bare: Linear<false>, Clipped: Linear<true>, Full: (Linear<true>, Terms),
            Hertz: (Hertz, Adhesion),
            RecordedBare: WithRecords<Linear<false>>,
            RecordedClipped: WithRecords<Linear<true>>,
            RecordedFull: WithRecords<(Linear<true>, Terms)>,
            RecordedHertz: WithRecords<(Hertz, Adhesion)>)
    };
    ($model:expr, $law:ident => $work:expr; $($value:ident: $type:ty),*) => {{
        use $crate::physics::contact::model::{Model, Terms};
        use $crate::physics::contact::with_records::WithRecords;
        use $crate::physics::contact::{adhesion::Adhesion, hertz::Hertz, linear::Linear};
        match $model {
            $(Model::$value => {
                type $law = $type;
                $work
            })*
        }
    }};
}
pub(crate) use with_law;
