//! The pass over contacts: which bodies touch now, geometry, law, history; then each particle's sum of forces in a fixed order.
//!
//! In the order in which to read: `pass`, from the engine to one chunk; `pairs`, its contacts between particles; `walls` and
//! `outlines`, those with the drum; `opening`, how contacts begin and end; `reactions` between chunks; `totals`, `tallies` and
//! `store`, what is kept of all that.

mod opening;
mod outlines;
mod pairs;
mod pass;
mod reactions;
mod store;
mod tallies;
mod totals;
mod walls;

pub use pass::{ForcePass, new_pass};
pub use store::Lists;
pub use totals::Totals;

use crate::engine::contacts::{Geometry, ListKind, PairParameters};
use crate::physics::columns::Of;
use crate::physics::contact::law::{BodyPair, ContactLaw};
use crate::physics::contact::species::SpeciesTable;
use crate::physics::drum::Drum;
use crate::physics::drum::bins::ArcBins;
use crate::physics::energy::SurfaceLoad;
use crate::physics::vector::Rotation;

/// What is the same for all contacts of a step.
#[derive(Debug, Clone, Copy)]
pub struct StepInputs<'a> {
    /// Length of the step [s], 0 where a load has just been started and has not moved yet; inverse of the length that steps
    /// have [1/s].
    pub time: [f64; 2],
    /// Rim and outlines.
    pub drum: &'a Drum,
    /// The drum's rotation at the end of the step.
    pub rotation: Rotation,
    /// Its mean angular velocity in the step [rad/s].
    pub angular_velocity: f64,
    /// What the particles are.
    pub bodies: Bodies<'a>,
    /// The number of the step.
    pub step: u64,
    /// Whether gross work is summed up.
    pub records_gross_work: bool,
    /// The bins of a profile along the drum's outline, where one is recorded.
    pub profile: Option<&'a ArcBins>,
}

/// What particles are made of.
#[derive(Debug, Clone, Copy)]
pub struct Bodies<'a> {
    /// The radius [m] where all have the same.
    pub radius: Option<f64>,
    /// Radii [m].
    pub radii: &'a [f64],
    /// Masses [kg/m].
    pub masses: &'a [f64],
    /// Species.
    pub species: &'a [u16],
    /// What acts between species, and between them and the drum.
    pub table: &'a SpeciesTable,
}

impl Bodies<'_> {
    /// The radius of one particle [m]; of a place that is none, 0.
    #[inline(always)]
    pub fn radius_of(&self, particle: u32) -> f64 {
        self.radius.unwrap_or_else(|| self.radii.get(particle as usize).copied().unwrap_or_default())
    }

    /// Whether all particles are equal in what their contacts follow from.
    pub fn are_equal(&self) -> bool {
        let is_same = |values: &[f64]| values.windows(2).all(|two| two[0] == two[1]);
        is_same(self.radii) && is_same(self.masses) && self.species.windows(2).all(|two| two[0] == two[1])
    }

    fn body(&self, particle: u32) -> (f64, f64) {
        (self.masses[particle as usize], self.radii[particle as usize])
    }

    /// What a contact follows from, by its bodies.
    pub fn parameters<L: ContactLaw>(
        &self,
        (one, other): (u32, u32),
        kind: ListKind,
    ) -> Of<PairParameters<L>, f64> {
        let own = self.body(one);
        if kind == ListKind::Walls {
            let law = L::between(self.table.wall(self.species[one as usize]), BodyPair::at_wall(own));
            return (law, Geometry { radius: own.1, other_radius: 0.0 });
        }
        let parameters = self.table.pair(self.species[one as usize], self.species[other as usize]);
        let other = self.body(other);
        let law = L::between(parameters, BodyPair::of_discs(own, other));
        (law, Geometry { radius: own.1, other_radius: other.1 })
    }
}
