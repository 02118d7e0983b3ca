//! Where the forces of contacts go.

use wide::f64x2;

use super::reactions::RemoteReactions;
use crate::engine::motion::{CHUNK_FLAT, at_offset};
use crate::engine::parallel::CHUNK;

/// Sums of forces and moments by particle. Every particle meets its contacts in the order of their lists.
pub trait Accumulator {
    /// Takes the force of a contact off the particle at offset `own`, which is one of the chunk's, and adds the moment.
    fn subtract(&mut self, own: u32, force: f64x2, moment: f64);
    /// Adds force and moment of a contact to the particle at offset `other`, which may be another chunk's.
    fn add(&mut self, other: u32, force: f64x2, moment: f64);
}

/// The sums of one chunk's particles. With `ALONE` there is no other chunk.
#[derive(Debug)]
pub struct ChunkSums<'a, const ALONE: bool> {
    /// The chunk.
    pub chunk: u32,
    /// Forces [N/m].
    pub force: &'a mut [f64; CHUNK_FLAT],
    /// Moments [N m/m].
    pub torque: &'a mut [f64; CHUNK],
    /// What goes to particles of later chunks.
    pub remote: &'a mut RemoteReactions,
}

/// An offset as an index into the forces of its chunk; even.
#[inline(always)]
fn within_chunk(offset: u32) -> usize {
    offset as usize & (CHUNK_FLAT - 2)
}

impl<const ALONE: bool> ChunkSums<'_, ALONE> {
    #[inline(always)]
    fn change(&mut self, offset: u32, moment: f64, change: impl FnOnce(f64x2) -> f64x2) {
        let x = within_chunk(offset);
        let sum = change(f64x2::new([self.force[x], self.force[x + 1]]));
        [self.force[x], self.force[x + 1]] = sum.to_array();
        self.torque[x / 2] += moment;
    }
}

impl<const ALONE: bool> Accumulator for ChunkSums<'_, ALONE> {
    #[inline(always)]
    fn subtract(&mut self, own: u32, force: f64x2, moment: f64) {
        // A lane without a contact may refer to a place beyond all particles; it brings nothing to whichever this takes it for.
        self.change(own, moment, |sum| sum - force);
    }

    #[inline(always)]
    fn add(&mut self, other: u32, force: f64x2, moment: f64) {
        if ALONE || other / CHUNK_FLAT as u32 == self.chunk {
            self.change(other, moment, |sum| sum + force);
        } else {
            self.remote.send(at_offset(other), force.to_array(), moment);
        }
    }
}
