//! The slots that one task evaluates: shared keys and laws, histories of its own.

use crate::contact::table::{Record, SlotRows};
use crate::threads::CHUNK;

/// One kind of slots of whole chunks of particles.
#[derive(Debug)]
pub struct SlotSlice<'a> {
    /// First slots of the particles from the first chunk on.
    starts: &'a [u32],
    /// The particles that own the slots.
    pub owner: &'a [u32],
    /// The other sides.
    pub other: &'a [u32],
    /// Laws, dampings and what survives the step.
    pub records: &'a mut [Record],
    /// The way at which each slot wakes.
    pub wake: &'a mut [f64],
}

impl<'a> From<&'a mut SlotRows> for SlotSlice<'a> {
    fn from(rows: &'a mut SlotRows) -> Self {
        Self {
            starts: &rows.starts,
            owner: &rows.owner,
            other: &rows.other,
            records: &mut rows.records,
            wake: &mut rows.wake,
        }
    }
}

impl SlotSlice<'_> {
    /// Cuts after the slots of the first `chunks` chunks of particles.
    pub fn split(self, chunks: usize) -> (Self, Self) {
        let particles = (chunks * CHUNK).min(self.starts.len() - 1);
        let at = (self.starts[particles] - self.starts[0]) as usize;
        let (owner, more_owner) = self.owner.split_at(at);
        let (other, more_other) = self.other.split_at(at);
        let (records, more_records) = self.records.split_at_mut(at);
        let (wake, more_wake) = self.wake.split_at_mut(at);
        (
            Self { starts: &self.starts[..=particles], owner, other, records, wake },
            Self {
                starts: &self.starts[particles..],
                owner: more_owner,
                other: more_other,
                records: more_records,
                wake: more_wake,
            },
        )
    }
}
