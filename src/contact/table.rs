//! Who may touch whom, and who does: candidates from the neighbor list, and contacts, which have a history.
//!
//! A contact enters the list of contacts at the step in which it opens and leaves it once its last work is charged,
//! whatever the neighbor list holds; a rebuild makes new candidates and leaves contacts alone. That is what makes a
//! trajectory independent of the margin. Both are kept by chunk of particles, in key order.

use super::Contact;
use super::laws::SlotLaw;
use super::list::{ContactList, Entry, NO_CANDIDATE};
use crate::lanes::LANES;
use crate::threads::{CHUNK, chunk_count};

/// Pairs of bodies near each other, in key order: (owner, other side); they are looked at in fours.
#[derive(Debug, Clone, Default)]
pub struct Candidates {
    /// Column by column, filled up to whole fours with candidates that never wake.
    owner: Vec<[u32; LANES]>,
    other: Vec<[u32; LANES]>,
    squared_reach: Vec<[f64; LANES]>,
    wake: Vec<[f64; LANES]>,
    len: usize,
}

impl Candidates {
    /// Number of candidates.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Forgets all, keeping the memory.
    pub fn clear(&mut self) {
        self.owner.clear();
        self.other.clear();
        self.squared_reach.clear();
        self.wake.clear();
        self.len = 0;
    }

    /// Appends a candidate, awake: the particle of lower id, the particle of higher id or feature of the drum, and the
    /// square of the distance at which they touch [m²].
    pub fn push(&mut self, owner: u32, other: u32, squared_reach: f64) {
        let lane = self.len % LANES;
        if lane == 0 {
            self.owner.push([owner; LANES]);
            self.other.push([other; LANES]);
            self.squared_reach.push([0.0; LANES]);
            self.wake.push([f64::INFINITY; LANES]);
        }
        let last = self.len / LANES;
        (self.owner[last][lane], self.other[last][lane]) = (owner, other);
        (self.squared_reach[last][lane], self.wake[last][lane]) = (squared_reach, 0.0);
        self.len += 1;
    }

    /// The key of a candidate.
    #[inline]
    pub fn key(&self, candidate: usize) -> (u32, u32) {
        (self.owner[candidate / LANES][candidate % LANES], self.other[candidate / LANES][candidate % LANES])
    }

    /// The candidates of one particle.
    pub fn of(&self, particle: u32) -> std::ops::Range<usize> {
        let owner = &self.owner.as_flattened()[..self.len];
        let start = owner.partition_point(|&owner| owner < particle);
        start..start + owner[start..].partition_point(|&owner| owner == particle)
    }

    /// The other sides of all candidates.
    pub fn others(&self) -> &[u32] {
        &self.other.as_flattened()[..self.len]
    }

    /// The square of the distance at which a candidate's bodies touch [m²].
    #[inline(always)]
    pub fn squared_reach(&self, candidate: usize) -> f64 {
        self.squared_reach[candidate / LANES][candidate % LANES]
    }

    /// Number of fours, the last of which may be filled up.
    pub fn fours(&self) -> usize {
        self.wake.len()
    }

    /// The ways at which four candidates wake [m]: before the neighbor list has counted so far, no contact can have
    /// formed. Infinite for contacts. Scratch that saves work and changes no result.
    #[inline(always)]
    pub fn wakes(&self, four: usize) -> [f64; LANES] {
        self.wake[four]
    }

    /// The way at which a candidate wakes [m].
    #[inline]
    pub fn wake_of(&self, candidate: usize) -> f64 {
        self.wake[candidate / LANES][candidate % LANES]
    }

    /// Lets a candidate sleep until the given way [m].
    #[inline]
    pub fn sleep(&mut self, candidate: usize, until: f64) {
        self.wake[candidate / LANES][candidate % LANES] = until;
    }

    /// Wakes a candidate that is no contact any longer, if there is one.
    #[inline]
    pub fn wake(&mut self, candidate: u32) {
        if candidate != NO_CANDIDATE {
            self.sleep(candidate as usize, 0.0);
        }
    }
}

/// Candidates and contacts of one kind (pairs, or walls) that the particles of one chunk own.
#[derive(Debug, Clone, Default)]
pub struct Slots {
    /// Who may touch.
    pub candidates: Candidates,
    /// Who does.
    pub contacts: ContactList,
}

impl Slots {
    /// Makes a contact, still without history, of candidate `index`.
    pub fn open(&mut self, index: usize, law: SlotLaw, radii: [f64; 2]) {
        let (particle, other) = self.candidates.key(index);
        self.candidates.sleep(index, f64::INFINITY);
        let contact = Contact { particle, other, ..Contact::default() };
        self.contacts.insert(Entry { contact, law, radii, candidate: index as u32 });
    }

    /// Makes candidates again of the contacts that no longer touch.
    pub fn close_ended(&mut self) {
        let candidates = &mut self.candidates;
        self.contacts
            .remove_where(|list, index| !list.is_touching(index), |entry| candidates.wake(entry.candidate));
    }

    /// Lets contact `index` go on as candidate `heir` of the same particle, with its history.
    pub fn pass_on(&mut self, index: usize, heir: usize) {
        let mut entry = self.contacts.remove(index);
        self.candidates.wake(entry.candidate);
        self.candidates.sleep(heir, f64::INFINITY);
        entry.contact.other = self.candidates.key(heir).1;
        entry.candidate = heir as u32;
        self.contacts.insert(entry);
    }

    /// Finds the contacts among new candidates.
    pub fn link(&mut self) {
        let mut candidate = 0;
        for index in 0..self.contacts.len() {
            let key = self.contacts.key(index);
            while candidate < self.candidates.len() && self.candidates.key(candidate) < key {
                candidate += 1;
            }
            let found = candidate < self.candidates.len() && self.candidates.key(candidate) == key;
            if found {
                self.candidates.sleep(candidate, f64::INFINITY);
            }
            self.contacts.link(index, if found { candidate as u32 } else { NO_CANDIDATE });
        }
    }
}

/// The slots that the particles of one chunk own.
#[derive(Debug, Clone, Default)]
pub struct ChunkSlots {
    /// With particles of higher id.
    pub pairs: Slots,
    /// With the drum.
    pub walls: Slots,
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

    /// Adds a contact between particles, as after reading a checkpoint.
    pub fn add_pair(&mut self, contact: Contact, law: SlotLaw, radii: [f64; 2]) {
        let entry = Entry { contact, law, radii, candidate: NO_CANDIDATE };
        self.chunks[contact.particle as usize / CHUNK].pairs.contacts.insert(entry);
    }

    /// Adds a contact with the drum.
    pub fn add_wall(&mut self, contact: Contact, law: SlotLaw, radius: f64) {
        let entry = Entry { contact, law, radii: [radius, 0.0], candidate: NO_CANDIDATE };
        self.chunks[contact.particle as usize / CHUNK].walls.contacts.insert(entry);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::History;

    fn slots(candidates: &[(u32, u32)]) -> Slots {
        let mut slots = Slots::default();
        for &(owner, other) in candidates {
            slots.candidates.push(owner, other, 1.0);
        }
        slots
    }

    fn touching(particle: u32, other: u32) -> Entry {
        let history = History { overlap: 1e-6, ..History::default() };
        let contact = Contact { particle, other, history };
        Entry { contact, law: SlotLaw::default(), radii: [1.0; 2], candidate: NO_CANDIDATE }
    }

    #[test]
    fn contacts_survive_new_candidates_even_without_one() {
        let mut slots = slots(&[(0, 1), (0, 4), (0, 7), (1, 2)]);
        for (particle, other) in [(0, 1), (0, 5), (1, 2)] {
            slots.contacts.insert(touching(particle, other));
        }
        slots.link();
        let links: Vec<u32> = slots.contacts.iter().map(|entry| entry.candidate).collect();
        assert_eq!(links, [0, NO_CANDIDATE, 3]);
        assert_eq!(slots.candidates.wakes(0), [f64::INFINITY, 0.0, 0.0, f64::INFINITY]);
        slots.close_ended();
        assert_eq!(slots.contacts.len(), 3, "all of them still touch");
    }

    #[test]
    fn a_contact_without_overlap_becomes_a_candidate_again() {
        let mut slots = slots(&[(2, 3), (2, 5)]);
        slots.open(1, SlotLaw::default(), [1.0; 2]);
        assert_eq!(slots.candidates.wakes(0), [0.0, f64::INFINITY, f64::INFINITY, f64::INFINITY]);
        slots.close_ended();
        assert!(slots.contacts.is_empty());
        assert_eq!(slots.candidates.wakes(0), [0.0, 0.0, f64::INFINITY, f64::INFINITY]);
    }

    #[test]
    fn candidates_are_found_by_their_particle() {
        let candidates = slots(&[(0, 1), (2, 3), (2, 5), (6, 7)]).candidates;
        assert_eq!(
            [candidates.of(0), candidates.of(1), candidates.of(2), candidates.of(9)],
            [0..1, 1..1, 1..3, 4..4]
        );
    }
}
