//! The neighbors of a chunk's particles: which pairs may touch while the list holds, and whether they do.

use crate::engine::contacts::NOT_LISTED;

/// What is known of two neighbors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Status {
    /// They do not touch.
    Apart,
    /// They are a contact.
    Contact,
}

/// Pairs of bodies near each other, in key order.
#[derive(Debug, Clone, Default)]
pub struct Neighbors {
    pairs: Vec<(u32, u32)>,
    status: Vec<Status>,
}

impl Neighbors {
    /// Forgets all, keeping the memory.
    pub fn clear(&mut self) {
        self.pairs.clear();
        self.status.clear();
    }

    /// Number of pairs.
    pub fn len(&self) -> usize {
        self.pairs.len()
    }

    /// Appends a pair of the greatest key so far, or of its owner: `sort_from` then brings these in order.
    pub fn push(&mut self, own: u32, other: u32) {
        self.pairs.push((own, other));
        self.status.push(Status::Apart);
    }

    /// Brings the pairs from `start` on in order.
    pub fn sort_from(&mut self, start: usize) {
        self.pairs[start..].sort_unstable();
    }

    /// The pairs, in key order.
    pub fn pairs(&self) -> &[(u32, u32)] {
        &self.pairs
    }

    /// What is known of them.
    pub fn status(&self) -> &[Status] {
        &self.status
    }

    /// Takes note of what became of the pair at a place, if it is listed.
    pub fn set(&mut self, place: u32, status: Status) {
        if place != NOT_LISTED {
            self.status[place as usize] = status;
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
}
