//! The next chunk's data, asked for share by share while the present chunk is worked through: where a load has left the
//! cache, that hides most of memory's latency.

use super::motions::Motions;
use super::post::Outbox;
use crate::cache::{SHARES, ask, ask_for, share_of};
use crate::contact::table::ChunkSlots;

/// What a chunk will read.
#[derive(Debug, Clone, Copy)]
pub struct Needs<'a, M> {
    /// Its candidates and contacts.
    pub slots: &'a ChunkSlots,
    /// The motions that it may read.
    pub motions: M,
    /// The first of its own particles.
    pub first: usize,
    /// Where its post goes.
    pub outbox: &'a Outbox,
    /// Whether all of it has left the cache, not just the first levels of it.
    pub is_far: bool,
}

/// What is still to be asked for.
#[derive(Debug)]
pub struct Ahead<'a, M> {
    needs: Option<Needs<'a, M>>,
    asked: usize,
}

impl<'a, M: Motions> Ahead<'a, M> {
    /// Asks for these, or nothing.
    pub fn new(needs: Option<Needs<'a, M>>) -> Self {
        Self { needs, asked: 0 }
    }

    /// Asks for the next share.
    #[inline(always)]
    pub fn ask(&mut self) {
        if let Some(needs) = &self.needs
            && self.asked < SHARES
        {
            ask_for_share(needs, self.asked);
            self.asked += 1;
        }
    }

    /// Asks for the shares that are left.
    pub fn ask_for_rest(&mut self) {
        while self.needs.is_some() && self.asked < SHARES {
            self.ask();
        }
    }
}

#[inline(never)]
fn ask_for_share(needs: &Needs<impl Motions>, share: usize) {
    // Contacts read motions in an order that no CPU foresees.
    ask_for(share_of(needs.motions.of_chunk(needs.first), share));
    if !needs.is_far {
        return;
    }
    let pairs = &needs.slots.pairs;
    pairs.candidates.ask_for(share);
    pairs.contacts.ask_for(share);
    for &particle in share_of(needs.outbox.abroad(), share) {
        needs.motions.get(particle).into_iter().for_each(ask);
    }
}
