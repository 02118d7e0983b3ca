//! Who may touch whom, and who does: candidates from the neighbor list, and contacts, which have a history.
//!
//! A contact enters the list of contacts at the step in which it opens and leaves it once its last work is charged,
//! whatever the neighbor list holds; a rebuild makes new candidates and leaves contacts alone. That is what makes a
//! trajectory independent of the margin. Both are kept by chunk of particles, in key order.

use std::ops::Range;

use super::Contact;
use super::block::Traits;
use super::clock::{Clock, StepClock, WayClock};
use super::list::{ContactList, Entry, patch_of, rank};
use crate::cache::{ask_for, share_of};
use crate::lanes::ROW;
use crate::patch::{PATCH, PatchMotion};
use crate::threads::{CHUNK, chunk_count};

/// Two bodies near each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Candidate {
    /// The particle of lower id.
    pub owner: u32,
    /// The particle of higher id, or a feature of the drum.
    pub other: u32,
}

/// Pairs of bodies near each other, in key order, and until when they may sleep; patch by patch of their owners.
#[derive(Debug, Clone, Default)]
pub struct Candidates<C> {
    /// A patch begins with a whole row; those of the one before are filled up with its last candidate.
    bodies: Vec<Candidate>,
    /// Filled up with numbers that never come.
    wake: Vec<f32>,
    patches: Vec<Patch<C>>,
    /// The patches whose particles are at the candidates, their owners' own in front.
    watched: Vec<u32>,
}

/// The candidates of one patch's particles.
#[derive(Debug, Clone, Copy)]
struct Patch<C> {
    first_row: u32,
    first_watched: u32,
    /// Goes with what anyone in the patches watched does.
    clock: C,
}

impl<C: Clock> Candidates<C> {
    /// Number of candidates, those that fill up included.
    pub fn len(&self) -> usize {
        self.bodies.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.bodies.is_empty()
    }

    /// Forgets all, keeping the memory.
    pub fn clear(&mut self) {
        self.bodies.clear();
        self.wake.clear();
        self.patches.clear();
        self.watched.clear();
    }

    /// Goes on to the particles of patch `patch`.
    pub fn begin(&mut self, patch: u32) {
        self.end();
        let (first_row, first_watched) = ((self.wake.len() / ROW) as u32, self.watched.len() as u32);
        self.patches.push(Patch { first_row, first_watched, clock: C::default() });
        self.watched.push(patch);
    }

    /// Appends a candidate, awake once the patch has ended.
    pub fn push(&mut self, candidate: Candidate) {
        self.bodies.push(candidate);
    }

    /// Appends the candidates of a particle with others.
    pub fn push_pairs(&mut self, owner: u32, others: &[u32]) {
        self.bodies.extend(others.iter().map(|&other| Candidate { owner, other }));
        let first = self.patches.last().map_or(0, |patch| patch.first_watched as usize);
        let mut last = owner / PATCH as u32;
        for patch in others.iter().map(|other| other / PATCH as u32) {
            // Most are of the same patch as the one before.
            if patch != last && !self.watched[first..].contains(&patch) {
                self.watched.push(patch);
            }
            last = patch;
        }
    }

    /// Ends the last patch: its candidates are awake, and fill whole rows.
    pub fn end(&mut self) {
        self.wake.resize(self.len(), 0.0);
        self.wake.resize(self.len().next_multiple_of(ROW), f32::INFINITY);
        if let Some(&last) = self.bodies.last() {
            self.bodies.resize(self.wake.len(), last);
        }
    }

    /// Asks memory for a share of them.
    #[inline(always)]
    pub fn ask_for(&self, share: usize) {
        ask_for(share_of(&self.bodies, share));
        ask_for(share_of(&self.wake, share));
    }

    /// Number of patches.
    pub fn patches(&self) -> usize {
        self.patches.len()
    }

    /// Follows a step: shows `advance` each patch's clock, and the most that anyone whom it watches did.
    pub fn follow(&mut self, motions: &[PatchMotion], advance: impl Fn(&mut C, PatchMotion)) {
        let mut end = self.watched.len();
        for patch in self.patches.iter_mut().rev() {
            let watched = &self.watched[patch.first_watched as usize..end];
            let motions = watched.iter().map(|&patch| motions[patch as usize]);
            advance(&mut patch.clock, motions.fold(PatchMotion::default(), PatchMotion::and));
            end = patch.first_watched as usize;
        }
    }

    /// The clock of a patch.
    #[inline(always)]
    pub fn clock(&self, patch: usize) -> &C {
        &self.patches[patch].clock
    }

    /// The reading that rows of wakes are compared with: those that are rounded to below a patch's clock come to below it,
    /// too. Never infinite, nor not a number.
    #[inline(always)]
    pub fn waking(&self, patch: usize) -> f32 {
        ((self.clock(patch).reading() * (1.0 + 1e-6)) as f32).min(f32::MAX)
    }

    /// The rows of a patch.
    #[inline(always)]
    pub fn rows(&self, patch: usize) -> Range<usize> {
        let end = self.patches.get(patch + 1).map_or(self.wake.len() / ROW, |next| next.first_row as usize);
        self.patches[patch].first_row as usize..end
    }

    /// A candidate's bodies.
    #[inline(always)]
    pub fn bodies(&self, candidate: usize) -> &Candidate {
        &self.bodies[candidate]
    }

    /// The key of a candidate.
    #[inline]
    pub fn key(&self, candidate: usize) -> (u32, u32) {
        (self.bodies[candidate].owner, self.bodies[candidate].other)
    }

    /// The candidates of one particle.
    pub fn of(&self, particle: u32) -> Range<usize> {
        let start = self.bodies.partition_point(|bodies| bodies.owner < particle);
        let mut end = start + self.bodies[start..].partition_point(|bodies| bodies.owner == particle);
        while end > start + 1 && self.bodies[end - 1] == self.bodies[end - 2] {
            end -= 1;
        }
        start..end
    }

    /// All candidates.
    pub fn iter(&self) -> impl Iterator<Item = &Candidate> {
        self.bodies.iter()
    }

    /// The readings at which the candidates of some rows wake: before their patch's clock has come so far, no contact can
    /// have formed. Infinite for contacts. Scratch that saves work and changes no result.
    #[inline(always)]
    pub fn wakes(&self, rows: Range<usize>) -> &[[f32; ROW]] {
        &self.wake.as_chunks().0[rows]
    }

    /// Whether a candidate has woken.
    #[inline]
    pub fn is_due(&self, candidate: usize, waking: f32) -> bool {
        self.wake[candidate] <= waking
    }

    /// Whether a candidate can be a contact's again.
    #[inline]
    pub fn is_free(&self, candidate: usize) -> bool {
        self.wake[candidate] < f32::INFINITY
    }

    /// Lets a candidate sleep until its clock shows `until`.
    #[inline]
    pub fn sleep(&mut self, candidate: usize, until: f32) {
        self.wake[candidate] = until;
    }

    /// Wakes the candidate of a contact that has ended, if the list still holds it.
    pub fn wake(&mut self, key: (u32, u32)) {
        let rows = self.rows(patch_of(key.0));
        let (first, end) = (ROW * rows.start, ROW * rows.end);
        let before = |pair: &Candidate| rank((pair.owner, pair.other)) < rank(key);
        let candidate = first + self.bodies[first..end].partition_point(before);
        if candidate < end && self.key(candidate) == key {
            self.sleep(candidate, 0.0);
        }
    }
}

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

    #[test]
    fn a_patch_follows_those_that_its_candidates_are_with() {
        let patch = PATCH as u32;
        let mut candidates = Candidates::<WayClock>::default();
        candidates.begin(0);
        candidates.push_pairs(0, &[1]);
        candidates.push_pairs(2, &[2 * patch]);
        candidates.begin(1);
        candidates.push_pairs(patch, &[patch + 1]);
        candidates.end();
        // Patch 2 has moved by 4, which concerns patch 0 only.
        let motions = |ways: [f64; 3]| ways.map(|way| PatchMotion { way, change: 0.0 });
        candidates.follow(&motions([1.0, 2.0, 4.0]), |clock, most| clock.advance(most.way, 0.5));
        candidates.follow(&motions([1.0, 2.0, 0.0]), |clock, most| clock.advance(most.way, 0.0));
        assert_eq!([0, 1].map(|patch| candidates.clock(patch).reading()), [4.5 + 1.0, 2.5 + 2.0]);
        // The first patch is filled up, so that the second begins with a row of its own.
        assert_eq!((candidates.rows(0), candidates.rows(1)), (0..1, 1..2));
        assert_eq!((candidates.of(2), candidates.key(ROW)), (1..2, (patch, patch + 1)));
    }

    #[test]
    fn candidates_are_found_by_their_particle() {
        let candidates = slots(&[(0, 1), (2, 3), (2, 5), (6, 7)]).candidates;
        assert_eq!(
            [candidates.of(0), candidates.of(1), candidates.of(2), candidates.of(6)],
            [0..1, 1..1, 1..3, 3..4]
        );
    }
}
