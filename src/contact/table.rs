//! Contact slots in key order: for each particle its partners of higher id, then the drum's features it may meet.
//!
//! A slot exists while the two bodies are within the neighbor list's margin, and for as long as it has a history: a
//! contact that opened at the last step outlives its neighborhood until its last work is charged. That is what makes
//! a trajectory independent of the margin. A rebuild merges two sorted lists per particle.

use serde::{Deserialize, Serialize};

use super::History;
use super::laws::SlotLaw;

/// Slots of one kind (pairs, or walls), grouped by the particle that owns them, ordered by `other` within a group.
#[derive(Debug, Clone, PartialEq)]
pub struct SlotRows {
    /// Row `i` spans the slots `starts[i]..starts[i + 1]`.
    pub starts: Vec<u32>,
    /// The particle of each slot's row.
    pub owner: Vec<u32>,
    /// The other side: a particle of higher id, or a feature of the drum.
    pub other: Vec<u32>,
    /// Law, damping and history of each slot.
    pub records: Vec<Record>,
    /// A slot sleeps until the way that the list counts reaches this [m]: before, no contact can have formed. Below zero
    /// while the bodies touch, so that a search need not read histories. Scratch that saves work and changes no result.
    pub wake: Vec<f64>,
}

/// What a slot needs only while its bodies touch; one cache line.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C, align(64))]
pub struct Record {
    /// Everything that survives a step.
    pub history: History,
    /// Law and damping.
    pub law: SlotLaw,
}

/// One contact that has a history: its owner, its other side, and what it remembers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Contact {
    /// The owner's id.
    pub particle: u32,
    /// A particle of higher id, or a feature of the drum.
    pub other: u32,
    /// What it remembers.
    pub history: History,
}

impl SlotRows {
    /// Rows without slots for `count` particles.
    pub fn empty(count: usize) -> Self {
        Self {
            starts: vec![0; count + 1],
            owner: Vec::new(),
            other: Vec::new(),
            records: Vec::new(),
            wake: Vec::new(),
        }
    }

    /// Number of slots.
    pub fn len(&self) -> usize {
        self.other.len()
    }

    /// Whether there are no slots.
    pub fn is_empty(&self) -> bool {
        self.other.is_empty()
    }

    /// The slots of particle `i`.
    #[inline]
    pub fn row(&self, i: usize) -> std::ops::Range<usize> {
        self.starts[i] as usize..self.starts[i + 1] as usize
    }

    /// The contacts that have a history, in key order.
    pub fn touching(&self) -> impl Iterator<Item = Contact> + '_ {
        (0..self.len()).filter(|&slot| self.records[slot].history.is_touching()).map(|slot| Contact {
            particle: self.owner[slot],
            other: self.other[slot],
            history: self.records[slot].history,
        })
    }

    /// When a slot wakes whose gap is not known.
    #[inline]
    pub fn wake_of(history: &History) -> f64 {
        if history.is_touching() { -1.0 } else { 0.0 }
    }

    /// Forgets all slots and starts anew with row 0.
    fn clear(&mut self) {
        self.starts.clear();
        self.starts.push(0);
        self.owner.clear();
        self.other.clear();
        self.records.clear();
        self.wake.clear();
    }

    fn push(&mut self, other: u32, law: SlotLaw, history: History) {
        self.owner.push(self.starts.len() as u32 - 1);
        self.other.push(other);
        self.records.push(Record { history, law });
        self.wake.push(Self::wake_of(&history));
    }

    fn end_row(&mut self) {
        self.starts.push(self.other.len() as u32);
    }

    /// Appends the next row: the union of `candidates` (ascending) and of the contacts in the same row of `old` that
    /// have a history, which is carried over.
    pub fn merge_row(&mut self, old: &Self, candidates: &[u32], law_of: impl Fn(u32) -> SlotLaw) {
        let row = self.starts.len() - 1;
        let mut kept = old.row(row).filter(|&slot| old.records[slot].history.is_touching()).peekable();
        for &candidate in candidates {
            while let Some(slot) = kept.next_if(|&slot| old.other[slot] < candidate) {
                self.push(old.other[slot], old.records[slot].law, old.records[slot].history);
            }
            let history = match kept.next_if(|&slot| old.other[slot] == candidate) {
                Some(slot) => old.records[slot].history,
                None => History::default(),
            };
            self.push(candidate, law_of(candidate), history);
        }
        for slot in kept {
            self.push(old.other[slot], old.records[slot].law, old.records[slot].history);
        }
        self.end_row();
    }

    /// Rows that hold just `contacts` (in key order), as after reading a checkpoint.
    pub fn from_contacts(count: usize, contacts: &[Contact], law_of: impl Fn(u32, u32) -> SlotLaw) -> Self {
        let mut rows = Self::empty(count);
        rows.clear();
        let mut rest = contacts.iter().peekable();
        for particle in 0..count as u32 {
            while let Some(contact) = rest.next_if(|contact| contact.particle == particle) {
                rows.push(contact.other, law_of(particle, contact.other), contact.history);
            }
            rows.end_row();
        }
        rows
    }
}

/// All contacts: of bundles with each other, and of bundles with the drum.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactTable {
    /// Particle against particle of higher id.
    pub pairs: SlotRows,
    /// Particle against a feature of the drum.
    pub walls: SlotRows,
}

impl ContactTable {
    /// A table without slots for `count` particles.
    pub fn empty(count: usize) -> Self {
        Self { pairs: SlotRows::empty(count), walls: SlotRows::empty(count) }
    }

    /// Forgets all slots, keeping the memory.
    pub fn clear(&mut self) {
        self.pairs.clear();
        self.walls.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn touching(overlap: f64) -> History {
        History { overlap, ..History::default() }
    }

    fn law(_: u32) -> SlotLaw {
        SlotLaw::default()
    }

    fn contact(particle: u32, other: u32, overlap: f64) -> Contact {
        Contact { particle, other, history: touching(overlap) }
    }

    #[test]
    fn histories_survive_a_merge_even_without_a_candidate() {
        let contacts = [contact(0, 1, 0.1), contact(0, 5, 0.5), contact(1, 3, 0.3)];
        let old = SlotRows::from_contacts(3, &contacts, |_, _| SlotLaw::default());
        let mut new = SlotRows::empty(0);
        new.clear();
        new.merge_row(&old, &[1, 4, 7], law);
        new.merge_row(&old, &[2], law);
        new.merge_row(&old, &[], law);
        assert_eq!(new.other, [1, 4, 5, 7, 2, 3]);
        assert_eq!(new.starts, [0, 4, 6, 6]);
        assert_eq!(new.touching().collect::<Vec<_>>(), contacts);
    }

    #[test]
    fn a_slot_without_history_is_dropped() {
        let mut old = SlotRows::from_contacts(1, &[contact(0, 1, 0.1)], |_, _| SlotLaw::default());
        old.records[0].history = History::default();
        let mut new = SlotRows::empty(0);
        new.clear();
        new.merge_row(&old, &[], law);
        assert!(new.is_empty());
    }
}
