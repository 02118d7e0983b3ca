//! Contacts that have a history, in key order, four to a block.

use std::ops::Range;

use super::Contact;
use super::block::{Block, Ends, Traits, TraitsBlock};
use super::shift::{close_gap, open_gap};
use crate::cache::{ask_for, share_of};
use crate::lanes::LANES;
use crate::patch::PATCH;
use crate::threads::CHUNK;

/// One contact with all that its list keeps of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Entry {
    /// Key and history.
    pub contact: Contact,
    /// What follows from its bodies.
    pub traits: Traits,
}

impl Entry {
    /// The same contact between two particles at other places; the first in memory is the owner.
    #[must_use]
    pub fn between(mut self, own: u32, other: u32) -> Self {
        (self.contact.particle, self.contact.other) = (own.min(other), own.max(other));
        if other < own {
            self.traits.radii.reverse();
            // Seen from the other side the normal is turned round; overlap, stretch and forces are the same.
            self.contact.history.normal = -self.contact.history.normal;
        }
        self
    }
}

/// The traits of the contacts of a list: in most loads one for all, which then cost neither memory nor time.
#[derive(Debug, Clone)]
pub enum ListTraits {
    /// All have these.
    Same(Traits),
    /// By block.
    Each(Vec<TraitsBlock>),
}

/// Contacts in key order: by owner, then by other side; patch by patch of their owners, so that one more or one less moves
/// only those of its patch. A patch begins with a whole block, and the lanes after its last contact are vacant.
#[derive(Debug, Clone)]
pub struct ContactList {
    ends: Vec<Ends>,
    blocks: Vec<Block>,
    traits: ListTraits,
    /// Numbers of contacts, by patch.
    counts: [u32; PATCHES],
}

/// Patches in a chunk.
const PATCHES: usize = CHUNK / PATCH;

/// The patch of its chunk that a particle belongs to.
#[inline]
pub(super) fn patch_of(particle: u32) -> usize {
    particle as usize % CHUNK / PATCH
}

/// A key as one number, in the same order: comparing two at once leaves no branch that a CPU could not foretell.
#[inline]
pub(super) fn rank((owner, other): (u32, u32)) -> u64 {
    u64::from(owner) << 32 | u64::from(other)
}

impl Default for ContactList {
    fn default() -> Self {
        let traits = ListTraits::Same(Traits::default());
        Self { ends: Vec::new(), blocks: Vec::new(), traits, counts: [0; PATCHES] }
    }
}

impl ContactList {
    /// Number of contacts.
    pub fn len(&self) -> usize {
        self.counts.iter().sum::<u32>() as usize
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.blocks.is_empty()
    }

    /// Who is at the contacts, what they remember, and their traits.
    #[inline]
    pub fn parts_mut(&mut self) -> (&[Ends], &mut [Block], &ListTraits) {
        (&self.ends, &mut self.blocks, &self.traits)
    }

    /// Asks memory for a share of it.
    #[inline(always)]
    pub fn ask_for(&self, share: usize) {
        ask_for(share_of(&self.ends, share));
        share_of(&self.blocks, share).iter().for_each(Block::ask_for);
    }

    /// The lanes, vacant ones included.
    pub fn lanes(&self) -> std::ops::Range<usize> {
        0..LANES * self.blocks.len()
    }

    /// Whether lane `index` has a contact.
    #[inline]
    pub fn holds(&self, index: usize) -> bool {
        self.blocks[index / LANES].holds(index % LANES)
    }

    /// The contact of lane `index`.
    pub fn entry(&self, index: usize) -> Entry {
        let (block, lane) = (index / LANES, index % LANES);
        let traits = match &self.traits {
            ListTraits::Same(traits) => *traits,
            ListTraits::Each(blocks) => blocks[block].traits(lane),
        };
        let (particle, other) = self.key(index);
        Entry { contact: Contact { particle, other, history: self.blocks[block].of(lane) }, traits }
    }

    /// All contacts, in key order.
    pub fn iter(&self) -> impl Iterator<Item = Entry> + '_ {
        self.lanes().filter(|&index| self.holds(index)).map(|index| self.entry(index))
    }

    /// The keys of all contacts, ascending.
    pub fn keys(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        self.lanes().filter(|&index| self.holds(index)).map(|index| self.key(index))
    }

    /// The key of the contact of lane `index`.
    #[inline]
    pub fn key(&self, index: usize) -> (u32, u32) {
        self.ends[index / LANES].key(index % LANES)
    }

    fn put(&mut self, index: usize, entry: &Entry) {
        let (block, lane) = (index / LANES, index % LANES);
        self.ends[block].put(lane, (entry.contact.particle, entry.contact.other));
        self.blocks[block].put(lane, &entry.contact.history);
        match &mut self.traits {
            ListTraits::Same(traits) if *traits == entry.traits => {}
            ListTraits::Same(traits) => {
                let mut blocks = vec![TraitsBlock::splat(traits); self.blocks.len()];
                blocks[block].put(lane, &entry.traits);
                self.traits = ListTraits::Each(blocks);
            }
            ListTraits::Each(blocks) => blocks[block].put(lane, &entry.traits),
        }
    }

    /// The blocks of a patch.
    fn blocks_of(&self, patch: usize) -> Range<usize> {
        let blocks = |count: &u32| count.div_ceil(LANES as u32) as usize;
        let first = self.counts[..patch].iter().map(blocks).sum();
        first..first + blocks(&self.counts[patch])
    }

    /// Puts a contact in its place.
    pub fn insert(&mut self, entry: Entry) {
        if self.is_empty() {
            self.traits = ListTraits::Same(entry.traits);
        }
        let key = (entry.contact.particle, entry.contact.other);
        let patch = patch_of(key.0);
        let count = self.counts[patch] as usize;
        if count.is_multiple_of(LANES) {
            self.insert_block(self.blocks_of(patch).end, key, &entry.traits);
        }
        self.counts[patch] += 1;
        let blocks = self.blocks_of(patch);
        let place = self.place_of(key, LANES * blocks.start, count);
        let index = place - LANES * blocks.start;
        open_gap(&mut self.ends[blocks.clone()], index);
        open_gap(&mut self.blocks[blocks.clone()], index);
        if let ListTraits::Each(each) = &mut self.traits {
            open_gap(&mut each[blocks], index);
        }
        self.put(place, &entry);
    }

    /// Adds a vacant block. Its lanes have the ends and traits of a contact, so that they can be worked out.
    fn insert_block(&mut self, at: usize, key: (u32, u32), traits: &Traits) {
        self.ends.insert(at, Ends::splat(key));
        self.blocks.insert(at, Block::VACANT);
        if let ListTraits::Each(blocks) = &mut self.traits {
            blocks.insert(at, TraitsBlock::splat(traits));
        }
    }

    /// Where among the `count` contacts from lane `first` on one with this key comes.
    fn place_of(&self, key: (u32, u32), first: usize, count: usize) -> usize {
        let ends = &self.ends[first / LANES..][..count.div_ceil(LANES)];
        let before = ends.partition_point(|ends| rank(ends.key(0)) < rank(key)).saturating_sub(1);
        let from = LANES * before;
        let lanes = from..count.min(from + LANES);
        first + from + lanes.filter(|&lane| rank(self.key(first + lane)) < rank(key)).count()
    }

    /// Takes the contact of lane `index` out.
    pub fn remove(&mut self, index: usize) -> Entry {
        let entry = self.entry(index);
        self.drop(index);
        entry
    }

    fn drop(&mut self, index: usize) {
        let patch = patch_of(self.key(index).0);
        let blocks = self.blocks_of(patch);
        let index = index - LANES * blocks.start;
        close_gap(&mut self.ends[blocks.clone()], index);
        close_gap(&mut self.blocks[blocks.clone()], index);
        if let ListTraits::Each(each) = &mut self.traits {
            close_gap(&mut each[blocks.clone()], index);
        }
        self.counts[patch] -= 1;
        let (last, lane) = (blocks.end - 1, self.counts[patch] as usize % LANES);
        if lane > 0 {
            // What is vacant has the ends of a contact that is there: others may not be at hand.
            let key = self.ends[last].key(lane - 1);
            for lane in lane..LANES {
                self.blocks[last].vacate(lane);
                self.ends[last].put(lane, key);
            }
            return;
        }
        self.ends.remove(last);
        self.blocks.remove(last);
        if let ListTraits::Each(each) = &mut self.traits {
            each.remove(last);
        }
    }

    /// Takes the contacts out that did not touch at the last force evaluation, and shows their keys to `take`.
    pub fn drop_separated(&mut self, mut take: impl FnMut((u32, u32))) {
        let mut end = self.blocks.len();
        while let Some(block) = self.blocks[..end].iter().rposition(|block| block.separated() != 0) {
            end = block;
            let separated = self.blocks[block].separated();
            for lane in (0..LANES).rev().filter(|lane| separated >> lane & 1 == 1) {
                let index = LANES * block + lane;
                take(self.key(index));
                self.drop(index);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::History;
    use super::*;

    fn entry(particle: u32, other: u32) -> Entry {
        let overlap = if other.is_multiple_of(3) { 0.0 } else { f64::from(10 * particle + other) };
        let history =
            History { overlap, normal_force: f64::from(10 * particle + other), ..History::default() };
        // Contacts of particle 3 differ from the others.
        let radii = if particle == 3 { [2.0, 1.0] } else { [1.0; 2] };
        Entry { contact: Contact { particle, other, history }, traits: Traits { radii, ..Traits::default() } }
    }

    fn keys(list: &ContactList) -> Vec<(u32, u32)> {
        list.iter().map(|entry| (entry.contact.particle, entry.contact.other)).collect()
    }

    #[test]
    fn contacts_stay_in_key_order_with_their_histories() {
        let mut list = ContactList::default();
        for step in 0..90 {
            // Every key below 9 × 10, in a scrambled order.
            let key = 37 * step % 90;
            list.insert(entry(key / 10, key % 10));
        }
        assert_eq!(keys(&list), (0..90).map(|key| (key / 10, key % 10)).collect::<Vec<_>>());
        let mut taken = Vec::new();
        list.drop_separated(|key| taken.push(key.1));
        assert_eq!(taken.len(), 36);
        assert!(taken.iter().all(|other| other % 3 == 0));
        assert_eq!(list.len(), 54);
        assert!(keys(&list).is_sorted());
        let own = |entry: &Entry| f64::from(10 * entry.contact.particle + entry.contact.other);
        assert!(list.iter().all(|entry| entry.contact.history.normal_force == own(&entry)));
        assert!(list.iter().all(|found| found == entry(found.contact.particle, found.contact.other)));
    }
}
