//! Contacts that open and end, in an order that neither lists nor threads show in.

use super::Bodies;
use super::pass::{ChunkStep, Scratch};
use crate::engine::contacts::{ContactList, ContactRecord, ContactTally, NOT_LISTED};
use crate::engine::motion::MotionView;
use crate::engine::pair_list::{Neighbors, Opened};
use crate::engine::simd::{ALL_LANES, LANES};
use crate::physics::contact::law::ContactLaw;

/// The blocks of a list with contacts that have ended.
///
/// There is room for all before a pass begins: where a list could grow in a loop, the sums would have to be in memory in every
/// turn, in case that fails.
#[derive(Debug, Clone, Default)]
pub struct Ended {
    blocks: Vec<u32>,
    count: usize,
    /// Which lanes of the last of them touch.
    touching: u32,
}

impl Ended {
    /// None yet, of a list of so many blocks.
    pub fn clear(&mut self, blocks: usize) {
        if self.blocks.len() < blocks {
            self.blocks.resize(blocks, 0);
        }
        self.count = 0;
    }

    /// Takes note of a block of which these lanes touch.
    #[inline(always)]
    pub fn note(&mut self, block: usize, touching: u32) {
        if touching != ALL_LANES
            && let Some(next) = self.blocks.get_mut(self.count)
        {
            *next = block as u32;
            self.count += 1;
            self.touching = touching;
        }
    }

    /// The blocks of a list of so many contacts, ascending.
    pub fn blocks(&self, contacts: usize) -> &[u32] {
        let blocks = &self.blocks[..self.count];
        match blocks.split_last() {
            // Lanes behind the last contact never touch.
            Some((&last, others))
                if last as usize == contacts / LANES && self.touching == (1 << (contacts % LANES)) - 1 =>
            {
                others
            }
            _ => blocks,
        }
    }
}

impl<V: MotionView> ChunkStep<'_, V> {
    /// Makes contacts of neighbors that have begun to touch. Returns whether the list has contacts.
    #[inline]
    pub fn open<L: ContactLaw>(&mut self, list: &mut ContactList<L>, neighbors: &mut Neighbors) -> bool {
        let Scratch { opened, .. } = &mut *self.scratch;
        if !opened.is_empty() {
            let first = list.len();
            list.open(opened, neighbors, &self.inputs.bodies);
            if L::IS_RECORDED && list.is_tallied {
                self.note_opened(list, first);
            }
        }
        self.scratch.ended.clear(list.blocks.len());
        !list.is_empty()
    }

    /// Takes out contacts that have ended.
    #[inline]
    pub fn close<L: ContactLaw>(&mut self, list: &mut ContactList<L>, neighbors: &mut Neighbors) {
        if L::IS_RECORDED && list.is_tallied {
            self.note_moved(list);
            self.note_ended(list);
        }
        list.close(&self.scratch.ended, neighbors);
    }
}

impl<L: ContactLaw> ContactList<L> {
    /// Adds a contact as it is, at the end of the list, with what it has done where that is known.
    pub fn insert(&mut self, record: &ContactRecord, tally: Option<&ContactTally>, bodies: &Bodies) {
        self.push(record, NOT_LISTED, &bodies.parameters::<L>(record.key(), self.kind));
        if let Some(tally) = tally {
            self.set_tally(self.len() - 1, tally);
        }
    }

    /// Links the contacts to neighbors that have been searched for anew.
    pub fn link(&mut self, neighbors: &mut Neighbors) {
        for index in 0..self.len() {
            let place = neighbors.place_of(self.key(index));
            neighbors.open(place);
            self.neighbors[index] = place;
        }
    }

    /// Makes contacts of neighbors that have begun to touch: those of one step by key.
    #[cold]
    pub fn open(&mut self, opened: &mut Vec<Opened>, neighbors: &mut Neighbors, bodies: &Bodies) {
        opened.sort_unstable();
        // A pair can be in the near list twice, if it has opened there by the history of another.
        opened.dedup();
        for ((particle, other), place) in opened.drain(..) {
            let record = ContactRecord { particle, other, ..ContactRecord::default() };
            self.push(&record, place, &bodies.parameters::<L>(record.key(), self.kind));
            neighbors.open(place);
        }
    }

    /// Takes out contacts that have ended, from the highest place down.
    #[inline]
    pub fn close(&mut self, ended: &Ended, neighbors: &mut Neighbors) {
        let blocks = ended.blocks(self.len());
        if !blocks.is_empty() {
            self.close_in(blocks, neighbors);
        }
    }

    /// Takes out those of some blocks, which are in order.
    #[cold]
    fn close_in(&mut self, blocks: &[u32], neighbors: &mut Neighbors) {
        for &block in blocks.iter().rev() {
            let block = block as usize;
            for lane in (0..LANES).rev() {
                let index = LANES * block + lane;
                if index < self.len() && self.blocks[block].state.overlap[lane] == 0.0 {
                    let (key, place) = self.remove(index);
                    neighbors.release(key, place);
                }
            }
        }
    }
}
