//! What was recorded, until someone takes it: beside the state, since no step needs it.
//!
//! Frames and contacts are moved out when they are taken. Samples stay, for the averages over a window need them all and they are few;
//! those that were taken are only noted, so that they are neither taken twice nor written to checkpoints.

use super::Simulation;
use crate::error::Error;
use crate::observe::contact_rows::ContactRow;
use crate::observe::frames::Frames;
use crate::observe::memory;
use crate::observe::recorder::{Recording, Series, columns};
use crate::physics::drum::Drum;

/// Samples, frames and contacts in memory: the last of those that the state counts.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Records {
    /// The samples.
    pub series: Series,
    /// The frames.
    pub frames: Frames,
    /// The contacts that have ended.
    pub contacts: Vec<ContactRow>,
    /// Samples at the beginning of `series` that were taken.
    pub(super) taken: usize,
}

impl Records {
    /// No records of a drum's load yet; `record` is what is recorded on request.
    pub fn new(drum: &Drum, record: &[Recording]) -> Self {
        let columns = columns(drum.surface_names(), record);
        Self { series: Series::new(columns), ..Self::default() }
    }

    /// The samples that were not taken yet, row after row.
    pub fn untaken_rows(&self) -> &[f64] {
        self.series.rows_from(self.taken)
    }
}

impl Simulation {
    /// What is in memory of the records.
    pub fn records(&self) -> &Records {
        &self.records
    }

    /// The samples in memory.
    pub fn series(&self) -> &Series {
        &self.records.series
    }

    /// The frames in memory.
    pub fn frames(&self) -> &Frames {
        &self.records.frames
    }

    /// How many samples were recorded before the first in memory.
    pub fn first_sample(&self) -> u64 {
        self.state.recorded.samples - self.records.series.len() as u64
    }

    /// How many samples were recorded before the first that was not taken.
    pub fn first_untaken_sample(&self) -> u64 {
        self.first_sample() + self.records.taken as u64
    }

    /// How many frames were recorded before the first in memory.
    pub fn first_frame(&self) -> u64 {
        self.state.recorded.frames - self.records.frames.len() as u64
    }

    /// How many contacts were recorded before the first in memory.
    pub fn first_contact(&self) -> u64 {
        self.state.recorded.contacts - self.records.contacts.len() as u64
    }

    /// Memory that records take which were not taken yet [bytes].
    pub fn untaken_size(&self) -> usize {
        let contacts = size_of_val(self.records.contacts.as_slice());
        size_of_val(self.records.untaken_rows()) + self.records.frames.size() + contacts
    }

    /// Hands over the contacts in memory, without copying them.
    pub fn take_contacts(&mut self) -> Vec<ContactRow> {
        std::mem::take(&mut self.records.contacts)
    }

    /// Hands over the frames in memory, without copying them.
    pub fn take_frames(&mut self) -> Frames {
        std::mem::take(&mut self.records.frames)
    }

    /// Hands over the samples that were not taken yet, row after row.
    ///
    /// # Errors
    /// `Error::Memory` where there is no room for the copy; nothing is taken then.
    pub fn take_rows(&mut self) -> Result<Vec<f64>, Error> {
        let mut rows = Vec::new();
        memory::reserve(&mut rows, self.records.untaken_rows().len(), "taking samples")?;
        rows.extend_from_slice(self.records.untaken_rows());
        self.records.taken = self.records.series.len();
        Ok(rows)
    }

    /// Puts samples back that were recorded before the first in memory: rows of all columns, up to that one.
    ///
    /// # Errors
    /// `Error::Checkpoint` where they are not those, `Error::Memory` where there is no room for them.
    pub fn put_back_rows(&mut self, rows: &[f64], are_taken: bool) -> Result<(), Error> {
        let width = self.records.series.width();
        let count = rows.len() / width;
        if !rows.len().is_multiple_of(width) || count as u64 != self.first_sample() {
            return Err(not_missing("samples", self.first_sample(), count));
        }
        self.records.series.prepend(rows)?;
        self.records.taken += if are_taken { count } else { 0 };
        Ok(())
    }

    /// Puts frames back that were recorded before the first in memory, up to that one.
    ///
    /// # Errors
    /// `Error::Checkpoint` where they are not those, `Error::Memory` where there is no room for them.
    pub fn put_back_frames(&mut self, frames: Frames) -> Result<(), Error> {
        let count = self.state.particles.len();
        if !frames.are_of(count) || frames.len() as u64 != self.first_frame() {
            return Err(not_missing("frames", self.first_frame(), frames.len()));
        }
        self.records.frames.prepend(frames, count)
    }

    /// Puts contacts back that were recorded before the first in memory, up to that one.
    ///
    /// # Errors
    /// `Error::Checkpoint` where they are not those, `Error::Memory` where there is no room for them.
    pub fn put_back_contacts(&mut self, contacts: &[ContactRow]) -> Result<(), Error> {
        if contacts.len() as u64 != self.first_contact() {
            return Err(not_missing("contacts", self.first_contact(), contacts.len()));
        }
        memory::prepend(&mut self.records.contacts, contacts, "putting contacts back")
    }
}

fn not_missing(what: &str, missing: u64, given: usize) -> Error {
    Error::Checkpoint { reason: format!("{missing} {what} were taken of it, and {given} are put back") }
}
