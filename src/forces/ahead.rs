//! The next chunk's data, asked for share by share while the present chunk is worked through: where a load has left the
//! cache, that hides most of memory's latency.

use super::motions::Motions;
use super::post::Outbox;
use super::stretches::LARGE;
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
    /// Where all of it is.
    pub place: Place,
}

/// Where in the machine a load has its place.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub enum Place {
    /// The first levels of the cache.
    Near,
    /// The second level: asking for motions pays.
    Second,
    /// The last level: asking for all that makes up much pays.
    Last,
    /// Memory: asking for every list pays.
    Memory,
}

impl Place {
    /// That of a load of `count` particles.
    pub fn of(count: usize) -> Self {
        match count {
            131_072.. => Self::Memory,
            LARGE.. => Self::Last,
            8192.. => Self::Second,
            _ => Self::Near,
        }
    }
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
    let Needs { slots, outbox, place, .. } = needs;
    if *place < Place::Last {
        return;
    }
    if *place == Place::Memory {
        if share == 0 {
            slots.pairs.candidates.ask_for_patches();
            slots.walls.candidates.ask_for_patches();
            outbox.ask_for_lists();
        }
        outbox.ask_for(share);
    }
    let pairs = &slots.pairs;
    pairs.candidates.ask_for(share);
    pairs.contacts.ask_for(share);
    for &particle in share_of(outbox.abroad(), share) {
        needs.motions.get(particle).into_iter().for_each(ask);
    }
}
