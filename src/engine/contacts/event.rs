//! What is kept of a contact beside its state where contacts are recorded, and what is told of it.

use serde::{Deserialize, Serialize};

use crate::physics::columns::{Columns, Of};
use crate::physics::contact::tally::Tally;

/// What stands for a bin of a profile where none has been looked for yet.
pub const NO_BIN: u32 = u32::MAX;

/// How a contact began, and what has been told of it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Opening {
    /// The step at whose end the bodies touched for the first time.
    pub step: u64,
    /// Speed at which they approached along the normal in that step, and that of slip [m/s]; not a number where it was not recorded.
    pub speeds: [f64; 2],
    /// Where they touched [m], likewise.
    pub point: [f64; 2],
    /// The bin of the drum's outline that the contact is in.
    pub bin: u32,
    /// Its tally when it came into that bin.
    pub told: Of<Tally, f64>,
}

impl Default for Opening {
    /// Of a contact that was there before anyone looked.
    fn default() -> Self {
        let unknown = [f64::NAN; 2];
        Self { step: 0, speeds: unknown, point: unknown, bin: NO_BIN, told: Tally::build(|_| 0.0) }
    }
}

/// What is kept of a contact where contacts are recorded.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct ContactTally {
    /// How it began.
    pub opening: Opening,
    /// What it has done since.
    pub tally: Of<Tally, f64>,
}

/// What may happen to a contact; in the order in which the events of a step are gone through.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum EventKind {
    /// Its bodies have begun to touch.
    Opened,
    /// It has come into another bin of the drum's outline.
    Moved,
    /// Its bodies have separated.
    Ended,
}

/// Something that happened to a contact.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ContactEvent {
    /// At the end of which step.
    pub step: u64,
    /// What.
    pub kind: EventKind,
    /// Whether body j is a feature of the drum, not a particle.
    pub is_wall: bool,
    /// The bodies, by their places in memory.
    pub key: (u32, u32),
    /// Where the particles are [m].
    pub centers: [[f64; 2]; 2],
    /// What the contact has done; of one that moved on, up to then.
    pub contact: ContactTally,
}
