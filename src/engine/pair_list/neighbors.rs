//! The neighbors of a chunk's particles: which pairs may touch while the list holds, whether they do, and which are near.

use super::near::{NearList, Reach};
use crate::engine::contacts::NOT_LISTED;
use crate::engine::motion::MotionView;
use crate::engine::simd::LANES;

/// Pairs of bodies near each other, in key order.
#[derive(Debug, Clone)]
pub struct Neighbors {
    pairs: Vec<(u32, u32)>,
    /// Whether each has not begun to touch.
    are_apart: Vec<bool>,
    /// Those that may touch within the next steps.
    pub near: NearList,
}

impl Neighbors {
    /// None yet; vacant lanes of the near list refer to the bodies `vacant`.
    pub fn new(vacant: (u32, u32)) -> Self {
        Self { pairs: Vec::new(), are_apart: Vec::new(), near: NearList::new(vacant) }
    }

    /// Forgets all, keeping the memory.
    pub fn clear(&mut self) {
        self.pairs.clear();
        self.are_apart.clear();
    }

    /// Appends a pair of the greatest key so far, or of its owner: `sort_from` then brings these in order.
    pub fn push(&mut self, own: u32, other: u32) {
        self.pairs.push((own, other));
        self.are_apart.push(true);
    }

    /// Brings the pairs from `start` on in order.
    pub fn sort_from(&mut self, start: usize) {
        self.pairs[start..].sort_unstable();
    }

    /// The pairs, in key order.
    pub fn pairs(&self) -> &[(u32, u32)] {
        &self.pairs
    }

    /// Whether the pair at a place is no contact; false where there is no such place.
    #[inline]
    pub fn is_apart(&self, place: usize) -> bool {
        self.are_apart.get(place) == Some(&true)
    }

    /// Takes note that the pair at a place, if it is listed, is a contact.
    pub fn open(&mut self, place: u32) {
        if place != NOT_LISTED {
            self.are_apart[place as usize] = false;
        }
    }

    /// Takes note that the pair at a place, if it is listed, has parted: it may touch again at once.
    pub fn release(&mut self, key: (u32, u32), place: u32) {
        if place != NOT_LISTED {
            self.are_apart[place as usize] = true;
            self.near.push(key, place);
        }
    }

    /// The place of a pair, or `NOT_LISTED`.
    pub fn place_of(&self, key: (u32, u32)) -> u32 {
        self.pairs.binary_search(&key).map_or(NOT_LISTED, |place| place as u32)
    }

    /// The places of the pairs of one particle.
    pub fn of(&self, own: u32) -> std::ops::Range<usize> {
        let start = self.pairs.partition_point(|pair| pair.0 < own);
        start..start + self.pairs[start..].partition_point(|pair| pair.0 == own)
    }

    /// Makes the near list anew, of the pairs of particles that may touch while less than the budget is used up.
    pub fn find_near_pairs(&mut self, motion: impl MotionView, reach: &Reach) {
        self.near.clear();
        let (blocks, rest) = self.pairs.as_chunks::<LANES>();
        // Those behind the last pair are far.
        let mut last = [self.near.vacant(); LANES];
        last[..rest.len()].copy_from_slice(rest);
        let last = (reach.near(&last, motion), LANES * blocks.len());
        for block in 0..blocks.len() {
            let near = reach.near(&self.pairs.as_chunks::<LANES>().0[block], motion);
            if near != 0 {
                self.push_near(near, LANES * block);
            }
        }
        self.push_near(last.0, last.1);
    }

    /// Takes those of the four pairs from place `first` on that are near, given as bits, into the near list, if they are apart.
    pub fn push_near(&mut self, near: u32, first: usize) {
        let mut left = near;
        while left != 0 {
            let place = first + left.trailing_zeros() as usize;
            left &= left - 1;
            if self.is_apart(place) {
                self.near.push(self.pairs[place], place as u32);
            }
        }
    }
}
