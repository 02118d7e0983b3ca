//! The state: all that a checkpoint holds besides the configuration.

use serde::{Deserialize, Serialize};

use crate::contact::Contact;
use crate::observe::recorder::{Frames, Series};
use crate::physics::energy::EnergyLedger;
use crate::physics::particles::Particles;

/// Everything from which a simulation goes on bit for bit. Contacts live in the table while it runs; a checkpoint holds
/// those that have a history.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Steps done.
    pub step: u64,
    /// The bundles.
    pub particles: Particles,
    /// The accounts.
    pub ledger: EnergyLedger,
    /// The samples.
    pub series: Series,
    /// The frames.
    pub frames: Frames,
}

/// Contacts that have a history, in key order.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct TouchingContacts {
    /// Of bundles with each other.
    pub pairs: Vec<Contact>,
    /// Of bundles with the drum.
    pub walls: Vec<Contact>,
}
