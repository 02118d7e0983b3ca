//! The next chunk's data, asked for share by share while the present chunk is worked through: where a load has left the
//! cache, that hides most of memory's latency.

use crate::cache::{ask, ask_for, part_of};
use crate::contact::table::ChunkSlots;
use crate::integrator::{Drift, Load, Motion};
use crate::threads::CHUNK;

/// What a chunk will read.
#[derive(Debug, Clone, Copy)]
pub struct Needs<'a> {
    /// Its candidates and contacts.
    pub slots: &'a ChunkSlots,
    /// The motions of all particles.
    pub motions: &'a [Motion],
    /// The first of its own particles.
    pub first: usize,
    /// The particles of other chunks that it reads.
    pub abroad: &'a [u32],
    /// The loads of its own particles, where each chunk has its own.
    pub loads: &'a [Load],
    /// The drift of the present chunk, where it comes after the contacts.
    pub drift: Option<&'a Drift<'a>>,
}

/// What is still to be asked for.
#[derive(Debug)]
pub struct Ahead<'a> {
    needs: Option<Needs<'a>>,
    shares: usize,
    asked: usize,
}

impl<'a> Ahead<'a> {
    /// Asks for these, or nothing.
    pub fn new(needs: Option<Needs<'a>>) -> Self {
        Self { needs, shares: 1, asked: 0 }
    }

    /// Divides all into so many shares.
    pub fn share(&mut self, shares: usize) {
        self.shares = shares.max(1);
    }

    /// Asks for the next share.
    #[inline(always)]
    pub fn ask(&mut self) {
        if let Some(needs) = self.needs
            && self.asked < self.shares
        {
            ask_for_share(needs, self.asked, self.shares);
            self.asked += 1;
        }
    }
}

#[inline(never)]
fn ask_for_share(needs: Needs, part: usize, parts: usize) {
    let pairs = &needs.slots.pairs;
    pairs.candidates.ask_for(part, parts);
    pairs.contacts.ask_for(part, parts);
    ask_for(&needs.loads[part_of(needs.loads.len().min(CHUNK), part, parts)]);
    if let Some(drift) = needs.drift {
        drift.ask_for(part, parts);
    }
    let own = &needs.motions[needs.first..];
    ask_for(&own[part_of(own.len().min(CHUNK), part, parts)]);
    let abroad = &needs.abroad[part_of(needs.abroad.len(), part, parts)];
    for &particle in abroad {
        ask(&needs.motions[particle as usize]);
    }
}
