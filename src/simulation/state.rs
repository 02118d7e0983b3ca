//! The state: all that a checkpoint holds besides the configuration.

use serde::{Deserialize, Serialize};

use super::contact_log::ContactLog;
use crate::engine::contacts::ContactEvent;
use crate::engine::forces::{Lists, Totals};
use crate::observe::fields::FieldSums;
use crate::observe::recorder::Earlier;
use crate::observe::visits::Visits;
use crate::physics::energy::EnergyLedger;
use crate::physics::particles::Particles;

/// Everything from which a simulation goes on bit for bit, but for its contacts, which the engine holds while it runs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Steps done.
    pub step: u64,
    /// Angle of the drum at t = 0 [rad].
    pub initial_angle: f64,
    /// The bundles.
    pub particles: Particles,
    /// The accounts.
    pub ledger: EnergyLedger,
    /// What contacts did, where that is recorded.
    pub log: ContactLog,
    /// Sums in cells; none where fields are not recorded.
    pub fields: FieldSums,
    /// By zone and disc, in id order, its visits.
    pub visits: Vec<Visits>,
    /// The last step of which sums by place are told; none goes on to the end of the run.
    pub last_told: Option<u64>,
    /// What they were then, once they have gone on beyond it.
    pub told: Option<PlaceSums>,
    /// How much has been recorded.
    pub recorded: Recorded,
}

/// What is summed up by place, as it was at some step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlaceSums {
    /// Sums in cells.
    pub fields: FieldSums,
    /// By zone and disc, in id order, its visits.
    pub visits: Vec<Visits>,
}

/// How much has been recorded since the start, wherever it is kept, and what the next sample needs of the last.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Recorded {
    /// Number of samples.
    pub samples: u64,
    /// Number of frames.
    pub frames: u64,
    /// Number of contacts that have ended, those below the floor left out.
    pub contacts: u64,
    /// What the last sample had seen.
    pub earlier: Earlier,
    /// Whether what is due at this step is still to be recorded, since there was no memory for it.
    pub is_pending: bool,
}

/// What the engine holds of the state.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct EngineState {
    /// The contacts, in the order of their lists.
    pub contacts: Lists,
    /// Sums for the ledger since the last sample, by chunk.
    pub totals: Vec<Totals>,
    /// Events of contacts for whose records there has been no memory yet.
    pub events: Vec<ContactEvent>,
}
