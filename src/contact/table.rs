//! Who may touch whom, and who does: candidates from the neighbor list, and contacts, which have a history.
//!
//! A contact enters the list of contacts at the step in which it opens and leaves it once its last work is charged,
//! whatever the neighbor list holds; a rebuild makes new candidates and leaves contacts alone. That is what makes a
//! trajectory independent of the margin. Both are kept by chunk of particles, in key order.

use super::Contact;
use super::block::Traits;
use super::candidates::Candidates;
use super::clock::{Clock, StepClock, WayClock};
use super::list::{ContactList, Entry};
use crate::threads::{CHUNK, chunk_count};

/// Candidates and contacts of one kind (pairs, or walls) that the particles of one chunk own.
#[derive(Debug, Clone, Default)]
pub struct Slots<C> {
    /// Who may touch.
    pub candidates: Candidates<C>,
    /// Who does.
    pub contacts: ContactList,
}

impl<C: Clock> Slots<C> {
    /// Makes a contact, still without history, of candidate `index`.
    pub fn open(&mut self, index: usize, traits: Traits) {
        let (particle, other) = self.candidates.key(index);
        self.candidates.sleep(index, f32::INFINITY);
        let contact = Contact { particle, other, ..Contact::default() };
        self.contacts.insert(Entry { contact, traits });
    }

    /// Makes candidates again of the contacts that no longer touch.
    pub fn close_ended(&mut self) {
        let candidates = &mut self.candidates;
        self.contacts.drop_separated(|key| candidates.wake(key));
    }

    /// Lets contact `index` go on as candidate `heir` of the same particle, with its history.
    pub fn pass_on(&mut self, index: usize, heir: usize) {
        let key = self.contacts.key(index);
        let mut entry = self.contacts.remove(index);
        self.candidates.wake(key);
        self.candidates.sleep(heir, f32::INFINITY);
        entry.contact.other = self.candidates.key(heir).1;
        self.contacts.insert(entry);
    }

    /// Lets those of the new candidates sleep that are contacts.
    pub fn link(&mut self) {
        let mut candidate = 0;
        for key in self.contacts.keys() {
            while candidate < self.candidates.len() && self.candidates.key(candidate) < key {
                candidate += 1;
            }
            if candidate < self.candidates.len() && self.candidates.key(candidate) == key {
                self.candidates.sleep(candidate, f32::INFINITY);
            }
        }
    }
}

/// The slots that the particles of one chunk own.
#[derive(Debug, Clone, Default)]
pub struct ChunkSlots {
    /// With particles of higher id.
    pub pairs: Slots<StepClock>,
    /// With the drum.
    pub walls: Slots<WayClock>,
}

/// All slots, chunk by chunk.
#[derive(Debug, Clone)]
pub struct ContactTable {
    /// The chunks, in the particles' order.
    pub chunks: Vec<ChunkSlots>,
}

impl ContactTable {
    /// A table without slots for `count` particles.
    pub fn empty(count: usize) -> Self {
        Self { chunks: vec![ChunkSlots::default(); chunk_count(count)] }
    }

    /// Contacts between particles, in key order.
    pub fn pairs(&self) -> impl Iterator<Item = Entry> + '_ {
        self.chunks.iter().flat_map(|chunk| chunk.pairs.contacts.iter())
    }

    /// Contacts with the drum, in key order.
    pub fn walls(&self) -> impl Iterator<Item = Entry> + '_ {
        self.chunks.iter().flat_map(|chunk| chunk.walls.contacts.iter())
    }

    /// Numbers of contacts: between particles, with the drum.
    pub fn counts(&self) -> (usize, usize) {
        self.chunks.iter().fold((0, 0), |(pairs, walls), chunk| {
            (pairs + chunk.pairs.contacts.len(), walls + chunk.walls.contacts.len())
        })
    }

    /// Follows the particles to other places in memory: particle `i` is now at `places[i]`. Candidates are forgotten.
    pub fn follow(&mut self, places: &[u32]) {
        let place = |particle: u32| places[particle as usize];
        let mut moved = Self::empty(places.len());
        for chunk in self.chunks.drain(..) {
            for entry in chunk.pairs.contacts.iter() {
                let entry = entry.between(place(entry.contact.particle), place(entry.contact.other));
                moved.chunk_of(entry.contact.particle).pairs.contacts.insert(entry);
            }
            for mut entry in chunk.walls.contacts.iter() {
                entry.contact.particle = place(entry.contact.particle);
                moved.chunk_of(entry.contact.particle).walls.contacts.insert(entry);
            }
        }
        *self = moved;
    }

    fn chunk_of(&mut self, particle: u32) -> &mut ChunkSlots {
        &mut self.chunks[particle as usize / CHUNK]
    }

    /// Adds a contact between particles, as after reading a checkpoint.
    pub fn add_pair(&mut self, contact: Contact, traits: Traits) {
        self.chunk_of(contact.particle).pairs.contacts.insert(Entry { contact, traits });
    }

    /// Adds a contact with the drum.
    pub fn add_wall(&mut self, contact: Contact, traits: Traits) {
        self.chunk_of(contact.particle).walls.contacts.insert(Entry { contact, traits });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::History;
    use crate::contact::candidates::Candidate;
    use crate::lanes::ROW;

    fn slots(candidates: &[(u32, u32)]) -> Slots<StepClock> {
        let mut slots = Slots::default();
        slots.candidates.begin(0);
        for &(owner, other) in candidates {
            slots.candidates.push(Candidate { owner, other });
        }
        slots.candidates.end();
        slots
    }

    fn free(slots: &Slots<StepClock>) -> Vec<usize> {
        (0..ROW).filter(|&candidate| slots.candidates.is_free(candidate)).collect()
    }

    fn touching(particle: u32, other: u32) -> Entry {
        let history = History { overlap: 1e-6, ..History::default() };
        let contact = Contact { particle, other, history };
        Entry { contact, traits: Traits::default() }
    }

    #[test]
    fn contacts_survive_new_candidates_even_without_one() {
        let mut slots = slots(&[(0, 1), (0, 4), (0, 7), (1, 2)]);
        for (particle, other) in [(0, 1), (0, 5), (1, 2)] {
            slots.contacts.insert(touching(particle, other));
        }
        slots.link();
        assert_eq!(free(&slots), [1, 2]);
        slots.close_ended();
        assert_eq!(slots.contacts.len(), 3, "all of them still touch");
    }

    #[test]
    fn a_contact_without_overlap_becomes_a_candidate_again() {
        let mut slots = slots(&[(2, 3), (2, 5)]);
        slots.open(1, Traits::default());
        assert_eq!(free(&slots), [0]);
        slots.close_ended();
        assert!(slots.contacts.is_empty());
        assert_eq!(free(&slots), [0, 1]);
    }
}
