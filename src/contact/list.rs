//! Contacts that have a history, in key order, four to a block: the hot loop reads a block's columns as they are.

use super::laws::SlotLaw;
use super::{Contact, History, HistoryLanes};
use crate::lanes::{LANES, Lanes, Vec2Lanes};
use crate::vector::Vec2;

/// The candidate of a contact whose bodies the neighbor list no longer holds.
pub const NO_CANDIDATE: u32 = u32::MAX;

/// One contact with all that its list keeps of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Entry {
    /// Key and history.
    pub contact: Contact,
    /// Law and damping.
    pub law: SlotLaw,
    /// Radii of the owner and of the other side [m]; that of the drum is zero.
    pub radii: [f64; 2],
    /// Where the neighbor list holds this pair of bodies, or `NO_CANDIDATE`.
    pub candidate: u32,
}

impl Entry {
    /// The same contact between two particles at other places; the first in memory is the owner.
    #[must_use]
    pub fn between(mut self, own: u32, other: u32) -> Self {
        (self.contact.particle, self.contact.other) = (own.min(other), own.max(other));
        if other < own {
            self.radii.reverse();
            // Seen from the other side the normal is turned round; overlap, stretch and forces are the same.
            self.contact.history.normal = -self.contact.history.normal;
        }
        self
    }
}

/// Four contacts, column by column.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C, align(32))]
pub struct Block {
    overlap: [f64; LANES],
    tangential_displacement: [f64; LANES],
    normal_force: [f64; LANES],
    tangential_force: [f64; LANES],
    normal_x: [f64; LANES],
    normal_y: [f64; LANES],
    damping: [f64; LANES],
    own_radius: [f64; LANES],
    other_radius: [f64; LANES],
    law: [u32; LANES],
    /// The contacts' owners.
    pub owner: [u32; LANES],
    /// Their other sides: particles of higher id, or features of the drum.
    pub other: [u32; LANES],
    candidate: [u32; LANES],
}

impl Block {
    /// What the contacts remember.
    #[inline(always)]
    pub fn history(&self) -> HistoryLanes {
        HistoryLanes {
            overlap: Lanes::new(self.overlap),
            tangential_displacement: Lanes::new(self.tangential_displacement),
            normal_force: Lanes::new(self.normal_force),
            tangential_force: Lanes::new(self.tangential_force),
            normal: Vec2Lanes { x: Lanes::new(self.normal_x), y: Lanes::new(self.normal_y) },
        }
    }

    /// Replaces what they remember.
    #[inline(always)]
    pub fn remember(&mut self, history: &HistoryLanes) {
        self.overlap = history.overlap.to_array();
        self.tangential_displacement = history.tangential_displacement.to_array();
        self.normal_force = history.normal_force.to_array();
        self.tangential_force = history.tangential_force.to_array();
        self.normal_x = history.normal.x.to_array();
        self.normal_y = history.normal.y.to_array();
    }

    /// Their dampings.
    #[inline(always)]
    pub fn damping(&self) -> Lanes {
        Lanes::new(self.damping)
    }

    /// The owners' radii and the other sides' [m].
    #[inline(always)]
    pub fn radii(&self) -> [Lanes; 2] {
        [Lanes::new(self.own_radius), Lanes::new(self.other_radius)]
    }

    /// Their laws.
    #[inline(always)]
    pub fn laws(&self) -> [u32; LANES] {
        self.law
    }

    fn entry(&self, lane: usize) -> Entry {
        let history = History {
            overlap: self.overlap[lane],
            tangential_displacement: self.tangential_displacement[lane],
            normal_force: self.normal_force[lane],
            tangential_force: self.tangential_force[lane],
            normal: Vec2::new(self.normal_x[lane], self.normal_y[lane]),
        };
        Entry {
            contact: Contact { particle: self.owner[lane], other: self.other[lane], history },
            law: SlotLaw { damping: self.damping[lane], law: self.law[lane] },
            radii: [self.own_radius[lane], self.other_radius[lane]],
            candidate: self.candidate[lane],
        }
    }

    fn put(&mut self, lane: usize, entry: &Entry) {
        let Entry { contact: Contact { particle, other, history }, law, radii, candidate } = *entry;
        self.overlap[lane] = history.overlap;
        self.tangential_displacement[lane] = history.tangential_displacement;
        self.normal_force[lane] = history.normal_force;
        self.tangential_force[lane] = history.tangential_force;
        (self.normal_x[lane], self.normal_y[lane]) = (history.normal.x, history.normal.y);
        (self.damping[lane], self.law[lane]) = (law.damping, law.law);
        [self.own_radius[lane], self.other_radius[lane]] = radii;
        (self.owner[lane], self.other[lane], self.candidate[lane]) = (particle, other, candidate);
    }
}

/// Contacts in key order: by owner, then by other side. Lanes of the last block beyond the end hold anything.
#[derive(Debug, Clone, Default)]
pub struct ContactList {
    blocks: Vec<Block>,
    len: usize,
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

    /// The blocks, and the number of contacts in them.
    #[inline]
    pub fn blocks_mut(&mut self) -> (&mut [Block], usize) {
        (&mut self.blocks, self.len)
    }

    /// One contact.
    pub fn entry(&self, index: usize) -> Entry {
        self.blocks[index / LANES].entry(index % LANES)
    }

    /// All contacts, in key order.
    pub fn iter(&self) -> impl Iterator<Item = Entry> + '_ {
        (0..self.len).map(|index| self.entry(index))
    }

    /// Whether contact `index` touched at the last force evaluation.
    #[inline]
    pub fn is_touching(&self, index: usize) -> bool {
        self.blocks[index / LANES].overlap[index % LANES] > 0.0
    }

    /// The key of contact `index`.
    #[inline]
    pub fn key(&self, index: usize) -> (u32, u32) {
        let (block, lane) = (&self.blocks[index / LANES], index % LANES);
        (block.owner[lane], block.other[lane])
    }

    /// Says where the neighbor list holds contact `index`.
    pub fn link(&mut self, index: usize, candidate: u32) {
        self.blocks[index / LANES].candidate[index % LANES] = candidate;
    }

    /// Puts a contact at the end, whatever its key.
    pub fn append(&mut self, entry: &Entry) {
        if self.len == LANES * self.blocks.len() {
            self.blocks.push(Block::default());
        }
        self.blocks[self.len / LANES].put(self.len % LANES, entry);
        self.len += 1;
    }

    /// Restores the order of the keys.
    pub fn sort(&mut self) {
        let mut entries: Vec<Entry> = self.iter().collect();
        entries.sort_unstable_by_key(|entry| (entry.contact.particle, entry.contact.other));
        self.len = 0;
        for entry in &entries {
            self.append(entry);
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
        let mut carried = entry;
        for index in low..self.len {
            let block = &mut self.blocks[index / LANES];
            let next = block.entry(index % LANES);
            block.put(index % LANES, &carried);
            carried = next;
        }
    }

    /// Takes contact `index` out.
    pub fn remove(&mut self, index: usize) -> Entry {
        let entry = self.entry(index);
        self.remove_where(|_, other| other == index, |_| {});
        entry
    }

    /// Takes every contact out that `ended` names, and shows it to `take`.
    pub fn remove_where(&mut self, ended: impl Fn(&Self, usize) -> bool, mut take: impl FnMut(&Entry)) {
        let mut kept = 0;
        for index in 0..self.len {
            if ended(self, index) {
                take(&self.entry(index));
                continue;
            }
            if kept < index {
                let entry = self.entry(index);
                self.blocks[kept / LANES].put(kept % LANES, &entry);
            }
            kept += 1;
        }
        self.len = kept;
        self.blocks.truncate(kept.div_ceil(LANES));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(particle: u32, other: u32) -> Entry {
        let history = History { overlap: f64::from(10 * particle + other), ..History::default() };
        Entry {
            contact: Contact { particle, other, history },
            law: SlotLaw::default(),
            radii: [1.0; 2],
            candidate: 7,
        }
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
        list.remove_where(|list, index| list.key(index).1 % 3 == 0, |entry| taken.push(entry.contact.other));
        assert_eq!(taken.len(), 36);
        assert!(taken.iter().all(|other| other % 3 == 0));
        assert_eq!(list.len(), 54);
        assert!(keys(&list).is_sorted());
        let own = |entry: &Entry| f64::from(10 * entry.contact.particle + entry.contact.other);
        assert!(list.iter().all(|entry| entry.contact.history.overlap == own(&entry)));
    }
}
