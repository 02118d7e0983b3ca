//! Contacts that have a history, in key order, four to a block.

use super::Contact;
use super::block::{Block, Ends, Traits, TraitsBlock};
use super::shift::{close_gap, open_gap};
use crate::lanes::LANES;

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

/// Contacts in key order: by owner, then by other side. Lanes of the last block beyond the end hold anything.
#[derive(Debug, Clone)]
pub struct ContactList {
    ends: Vec<Ends>,
    blocks: Vec<Block>,
    traits: ListTraits,
    len: usize,
}

impl Default for ContactList {
    fn default() -> Self {
        Self { ends: Vec::new(), blocks: Vec::new(), traits: ListTraits::Same(Traits::default()), len: 0 }
    }
}

impl ContactList {
    /// Number of contacts.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Who is at the contacts, what they remember, and their traits.
    #[inline]
    pub fn parts_mut(&mut self) -> (&[Ends], &mut [Block], &ListTraits) {
        (&self.ends, &mut self.blocks, &self.traits)
    }

    /// One contact.
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
        (0..self.len).map(|index| self.entry(index))
    }

    /// The key of contact `index`.
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

    /// Puts a contact at the end, whatever its key.
    pub fn append(&mut self, entry: &Entry) {
        if self.is_empty() {
            self.traits = ListTraits::Same(entry.traits);
        }
        if self.len == LANES * self.blocks.len() {
            self.ends.push(Ends::default());
            self.blocks.push(Block::default());
            if let ListTraits::Each(blocks) = &mut self.traits {
                blocks.push(TraitsBlock::default());
            }
        }
        self.len += 1;
        self.put(self.len - 1, entry);
    }

    /// Restores the order of the keys.
    pub fn sort(&mut self) {
        let mut entries: Vec<Entry> = self.iter().collect();
        entries.sort_unstable_by_key(|entry| (entry.contact.particle, entry.contact.other));
        for (index, entry) in entries.iter().enumerate() {
            self.put(index, entry);
        }
    }

    /// Puts a contact in its place.
    pub fn insert(&mut self, entry: Entry) {
        let key = (entry.contact.particle, entry.contact.other);
        let (mut low, mut high) = (0, self.len);
        while low < high {
            let middle = usize::midpoint(low, high);
            if self.key(middle) < key {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        self.append(&entry);
        open_gap(&mut self.ends, low);
        open_gap(&mut self.blocks, low);
        if let ListTraits::Each(blocks) = &mut self.traits {
            open_gap(blocks, low);
        }
        self.put(low, &entry);
    }

    /// Takes contact `index` out.
    pub fn remove(&mut self, index: usize) -> Entry {
        let entry = self.entry(index);
        self.drop(index);
        entry
    }

    fn drop(&mut self, index: usize) {
        self.len -= 1;
        let blocks = self.len.div_ceil(LANES);
        close_gap(&mut self.ends, index);
        close_gap(&mut self.blocks, index);
        self.ends.truncate(blocks);
        self.blocks.truncate(blocks);
        if let ListTraits::Each(each) = &mut self.traits {
            close_gap(each, index);
            each.truncate(blocks);
        }
    }

    /// Takes the contacts out that did not touch at the last force evaluation, and shows their keys to `take`.
    pub fn drop_separated(&mut self, mut take: impl FnMut((u32, u32))) {
        for block in (0..self.blocks.len()).rev() {
            let separated = self.blocks[block].separated();
            if separated == 0 {
                continue;
            }
            for index in (LANES * block..self.len.min(LANES * (block + 1))).rev() {
                if separated >> (index % LANES) & 1 == 1 {
                    take(self.key(index));
                    self.drop(index);
                }
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
