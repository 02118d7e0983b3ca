//! Who may touch whom: candidates from the neighbor list, and until when they may sleep.

use std::ops::Range;

use super::clock::Clock;
use super::list::{patch_of, rank};
use crate::cache::{ask_for, share_of};
use crate::lanes::{ROW, WholeRow};
use crate::patch::{PATCH, PatchMotion};

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

    /// Appends the candidates of a particle with the first `count` of some others, which are in no order.
    #[inline(always)]
    pub fn push_pairs(&mut self, owner: u32, others: &[u32], count: usize) {
        let start = self.bodies.len();
        match others.first_chunk() {
            Some(eight) if count <= ROW => {
                self.bodies.resize(start + ROW, Candidate { owner, other: owner });
                for (&other, rank) in eight.iter().zip(ranks(eight, count)) {
                    self.bodies[start + rank as usize].other = other;
                }
                self.bodies.truncate(start + count);
            }
            _ => {
                self.bodies.extend(others[..count].iter().map(|&other| Candidate { owner, other }));
                self.bodies[start..].sort_unstable_by_key(|pair| pair.other);
            }
        }
        let last = self.bodies.last().map_or(owner, |last| last.other);
        if last / PATCH as u32 != owner / PATCH as u32 {
            self.watch(owner, start);
        }
    }

    /// Takes note of the patches of those that the candidates from `first` on are with.
    fn watch(&mut self, owner: u32, first: usize) {
        let watched = self.patches.last().map_or(0, |patch| patch.first_watched as usize);
        let mut last = owner / PATCH as u32;
        for patch in self.bodies[first..].iter().map(|pair| pair.other / PATCH as u32) {
            // Most are of the same patch as the one before.
            if patch != last && !self.watched[watched..].contains(&patch) {
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

    /// Asks memory for the patches and what they watch.
    pub fn ask_for_patches(&self) {
        ask_for(&self.patches);
        ask_for(&self.watched);
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

/// By number: how many of the first `count` of eight different numbers are below it; for those that come after them, `count`.
#[inline(always)]
fn ranks(numbers: &[u32; ROW], count: usize) -> [u32; ROW] {
    // A comparison gives all ones, which makes the greatest number.
    let is_vacant = WholeRow::new([1, 2, 3, 4, 5, 6, 7, 8]).simd_gt(WholeRow::splat(count as u32));
    let numbers = WholeRow::new(*numbers) | is_vacant;
    let below = |number: u32| numbers.simd_gt(WholeRow::splat(number));
    let [a, b, c, d, e, f, g, h] = numbers.to_array().map(below);
    (WholeRow::ZERO - (((a + b) + (c + d)) + ((e + f) + (g + h)))).to_array()
}

#[cfg(test)]
mod tests {
    use super::super::clock::{StepClock, WayClock};
    use super::*;
    use crate::threads::CHUNK;

    #[test]
    fn candidates_of_a_particle_are_put_in_order() {
        // More than are brought in order at once, all numbers from 1 on; what comes after the count means nothing.
        for count in 0..=2 * ROW as u32 {
            let mut candidates = Candidates::<StepClock>::default();
            candidates.begin(0);
            let others: Vec<u32> = (1..=count).map(|k| 1 + k * 19 % (count + 1)).chain([0; ROW]).collect();
            candidates.push(Candidate { owner: 0, other: 1 });
            candidates.push_pairs(1, &others, count as usize);
            let mut expected = others[..count as usize].to_vec();
            expected.sort_unstable();
            let found: Vec<u32> = candidates.iter().skip(1).map(|pair| pair.other).collect();
            assert_eq!(found, expected, "{others:?}");
        }
    }

    #[test]
    fn a_patch_follows_those_that_its_candidates_are_with() {
        let patch = PATCH as u32;
        let mut candidates = Candidates::<WayClock>::default();
        candidates.begin(0);
        candidates.push_pairs(0, &[1], 1);
        // In another patch, which is the first of its chunk, too.
        let far = (CHUNK / PATCH) as u32;
        candidates.push_pairs(2, &[far * patch], 1);
        candidates.begin(1);
        candidates.push_pairs(patch, &[patch + 1], 1);
        candidates.end();
        // The far patch has moved by 4, which concerns patch 0 only.
        let motions = |ways: [f64; 3]| {
            let far_ways = std::iter::repeat_n(0.0, far as usize - 2).chain([ways[2]]);
            let ways = [ways[0], ways[1]].into_iter().chain(far_ways);
            ways.map(|way| PatchMotion { way, change: 0.0 }).collect::<Vec<_>>()
        };
        candidates.follow(&motions([1.0, 2.0, 4.0]), |clock, most| clock.advance(most.way, 0.5));
        candidates.follow(&motions([1.0, 2.0, 0.0]), |clock, most| clock.advance(most.way, 0.0));
        assert_eq!([0, 1].map(|patch| candidates.clock(patch).reading()), [4.5 + 1.0, 2.5 + 2.0]);
        // The first patch is filled up, so that the second begins with a row of its own.
        assert_eq!((candidates.rows(0), candidates.rows(1)), (0..1, 1..2));
        assert_eq!((candidates.of(2), candidates.key(ROW)), (1..2, (patch, patch + 1)));
    }

    #[test]
    fn candidates_are_found_by_their_particle() {
        let mut candidates = Candidates::<StepClock>::default();
        candidates.begin(0);
        for (owner, other) in [(0, 1), (2, 3), (2, 5), (6, 7)] {
            candidates.push(Candidate { owner, other });
        }
        candidates.end();
        assert_eq!(
            [candidates.of(0), candidates.of(1), candidates.of(2), candidates.of(6)],
            [0..1, 1..1, 1..3, 3..4]
        );
    }
}
