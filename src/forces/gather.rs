//! The gather of a parallel pass: each particle's contacts in key order, read from their histories.

use crate::contact::History;
use crate::contact::table::{ContactTable, SlotRows};
use crate::integrator::{Load, Motion};
use crate::threads::{CHUNK, Chunked, chunk_count};
use crate::vector::Vec2;

/// Slots by their higher particle, in key order: what a gather needs beside the rows.
#[derive(Debug, Clone, Default)]
pub struct Incidence {
    starts: Vec<u32>,
    slots: Vec<u32>,
}

impl Incidence {
    pub fn index(&mut self, pairs: &SlotRows) {
        let count = pairs.starts.len() - 1;
        self.starts.clear();
        self.starts.resize(count + 2, 0);
        for &j in &pairs.other {
            self.starts[j as usize + 2] += 1;
        }
        for j in 0..count {
            self.starts[j + 2] += self.starts[j + 1];
        }
        self.slots.clear();
        self.slots.resize(pairs.len(), 0);
        for (slot, &j) in pairs.other.iter().enumerate() {
            let cursor = &mut self.starts[j as usize + 1];
            self.slots[*cursor as usize] = slot as u32;
            *cursor += 1;
        }
    }

    fn of(&self, particle: usize) -> &[u32] {
        &self.slots[self.starts[particle] as usize..self.starts[particle + 1] as usize]
    }
}

/// Loads that one task sums up.
pub struct Gather<'a> {
    first: usize,
    loads: &'a mut [Load],
}

impl Chunked for Gather<'_> {
    fn chunks(&self) -> usize {
        chunk_count(self.loads.len())
    }

    fn split(self, chunks: usize) -> (Self, Self) {
        let (left, right) = self.loads.split_at_mut(chunks * CHUNK);
        (Self { first: self.first, loads: left }, Self { first: self.first + chunks * CHUNK, loads: right })
    }
}

impl<'a> Gather<'a> {
    /// All loads.
    pub fn of(loads: &'a mut [Load]) -> Self {
        Self { first: 0, loads }
    }

    pub fn run(self, motions: &[Motion], table: &ContactTable, incidence: &Incidence) {
        for (offset, load) in self.loads.iter_mut().enumerate() {
            let i = self.first + offset;
            let own = &motions[i];
            // Two particles touch halfway into the overlap, as in the pass over their slots.
            let half_way = |overlap: f64| own.radius - 0.5 * overlap;
            let mut sum = Load::default();
            let mut add = |force: Vec2, moment: f64| {
                sum.force += force;
                sum.moment += moment;
            };
            for &slot in incidence.of(i) {
                let history = &table.pairs.records[slot as usize].history;
                if history.is_touching() {
                    add(-history.force(), half_way(history.overlap) * history.tangential_force);
                }
            }
            for history in touching(&table.pairs, i) {
                add(history.force(), half_way(history.overlap) * history.tangential_force);
            }
            for history in touching(&table.walls, i) {
                add(history.force(), (own.radius - history.overlap) * history.tangential_force);
            }
            *load = sum;
        }
    }
}

/// Histories of the contacts that particle `i` owns, in key order.
fn touching(rows: &SlotRows, i: usize) -> impl Iterator<Item = &History> {
    rows.records[rows.row(i)].iter().map(|record| &record.history).filter(|history| history.is_touching())
}
