//! A contact outside of its block.

use serde::{Deserialize, Serialize};

use crate::physics::columns::{Columns, Of, columns};
use crate::physics::contact::ContactState;
use crate::physics::contact::law::ContactLaw;

columns! {
    /// What a contact's geometry follows from.
    pub struct Geometry {
        /// Radius of body i [m].
        radius,
        /// Radius of body j [m]; 0 for the drum.
        other_radius,
    }
}

/// What a contact follows from its bodies alone: the law between them, and their radii.
pub type PairParameters<L> = (<L as ContactLaw>::Parameters, Geometry);

/// One contact, as it leaves the engine and as a checkpoint keeps it.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct ContactRecord {
    /// Body i, a particle.
    pub particle: u32,
    /// Body j: a later particle, or a feature of the drum.
    pub other: u32,
    /// Overlap [m].
    pub overlap: f64,
    /// Rate at which the bodies parted in the middle of the last step [m/s].
    pub separation_rate: f64,
    /// Force on body j [N/m].
    pub force: [f64; 2],
    /// Moments on the two bodies about their centers [N m/m]; that on the drum is not meant.
    pub moments: [f64; 2],
    /// What its law remembers, column by column.
    pub history: [f64; ContactRecord::MOST_COLUMNS],
}

impl ContactRecord {
    /// The most that a law may remember.
    pub const MOST_COLUMNS: usize = 4;

    /// The key of the contact.
    pub fn key(&self) -> (u32, u32) {
        (self.particle, self.other)
    }

    /// Whether all its numbers are finite.
    pub fn is_finite(&self) -> bool {
        let rates = [self.overlap, self.separation_rate];
        let numbers = rates.iter().chain(&self.force).chain(&self.moments).chain(&self.history);
        numbers.copied().all(f64::is_finite)
    }

    /// The same contact between two particles at other places in memory; the first is body i.
    #[must_use]
    pub fn between(mut self, particle: u32, other: u32) -> Self {
        (self.particle, self.other) = (particle.min(other), particle.max(other));
        if other < particle {
            // Seen from the other side the force is turned round. Overlap, rate and histories are the same.
            self.force = self.force.map(|component| -component);
            self.moments.reverse();
        }
        self
    }

    /// Its state.
    pub fn state(&self) -> ContactState<f64> {
        let Self { overlap, separation_rate, force: [force_x, force_y], moments: [moment, _], .. } = *self;
        ContactState { overlap, separation_rate, force_x, force_y, moment }
    }

    /// What its law remembers.
    pub fn history_of<L: ContactLaw>(&self) -> Of<L::History, f64> {
        L::History::build(|column| self.history[column])
    }
}
