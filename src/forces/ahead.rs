//! The next chunk's data, asked for share by share while the present chunk is worked through: where a load has left the
//! cache, that hides most of memory's latency.

use super::motions::Motions;
use crate::cache::{ask, ask_for, part_of};
use crate::contact::table::ChunkSlots;
use crate::integrator::Drift;

/// What a chunk will read.
#[derive(Debug, Clone, Copy)]
pub struct Needs<'a, M> {
    /// Its candidates and contacts.
    pub slots: &'a ChunkSlots,
    /// The motions that it may read.
    pub motions: M,
    /// The first of its own particles.
    pub first: usize,
    /// The particles of other chunks that it reads.
    pub abroad: &'a [u32],
    /// The drift of the present chunk, which comes after the contacts.
    pub drift: &'a Drift<'a>,
}

/// What is still to be asked for.
#[derive(Debug)]
pub struct Ahead<'a, M> {
    needs: Option<Needs<'a, M>>,
    shares: usize,
    asked: usize,
}

impl<'a, M: Motions> Ahead<'a, M> {
    /// Asks for these, or nothing.
    pub fn new(needs: Option<Needs<'a, M>>) -> Self {
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
fn ask_for_share(needs: Needs<impl Motions>, part: usize, parts: usize) {
    let pairs = &needs.slots.pairs;
    pairs.candidates.ask_for(part, parts);
    pairs.contacts.ask_for(part, parts);
    needs.drift.ask_for(part, parts);
    let own = needs.motions.of_chunk(needs.first);
    ask_for(&own[part_of(own.len(), part, parts)]);
    let abroad = &needs.abroad[part_of(needs.abroad.len(), part, parts)];
    for &particle in abroad {
        needs.motions.get(particle).into_iter().for_each(ask);
    }
}
