//! Where the forces of contacts go.

use std::marker::PhantomData;

use wide::f64x2;

use super::reactions::RemoteReactions;
use crate::engine::motion::{CHUNK_FLAT, MotionView, at_offset};
use crate::engine::parallel::CHUNK;

/// The sums of forces and moments of one chunk's particles. Every particle meets its contacts in the order of their lists.
#[derive(Debug)]
pub struct ChunkSums<'a, V> {
    chunk: u32,
    force: &'a mut [f64; CHUNK_FLAT],
    torque: &'a mut [f64; CHUNK],
    remote: &'a mut RemoteReactions,
    view: PhantomData<V>,
}

impl<'a, V: MotionView> ChunkSums<'a, V> {
    /// Of a chunk, to which these forces [N/m] and moments [N m/m] belong; `remote` is for particles of later chunks.
    pub fn new(
        chunk: u32,
        force: &'a mut [f64; CHUNK_FLAT],
        torque: &'a mut [f64; CHUNK],
        remote: &'a mut RemoteReactions,
    ) -> Self {
        Self { chunk, force, torque, remote, view: PhantomData }
    }

    /// Takes the force of a contact off the particle at offset `own`, which is one of the chunk's, and adds the moment.
    #[inline(always)]
    pub fn subtract(&mut self, own: u32, force: f64x2, moment: f64) {
        // A masked offset is an index into the forces of its chunk. A lane without a contact may refer to a place beyond all
        // particles; it brings nothing to whichever this takes it for.
        let x = own as usize & (CHUNK_FLAT - 2);
        let sum = f64x2::new([self.force[x], self.force[x + 1]]) - force;
        [self.force[x], self.force[x + 1]] = sum.to_array();
        self.torque[x / 2] += moment;
    }

    /// Adds force and moment of a contact to the particle at offset `other`, which may be another chunk's.
    #[inline(always)]
    pub fn add(&mut self, other: u32, force: f64x2, moment: f64) {
        if !V::ONE_CHUNK && other / CHUNK_FLAT as u32 != self.chunk {
            return self.remote.send(at_offset(other), force.to_array(), moment);
        }
        // An index into vectors instead of an offset takes 5 instructions more a contact.
        let x = other as usize & (CHUNK_FLAT - 2);
        let sum = f64x2::new([self.force[x], self.force[x + 1]]) + force;
        [self.force[x], self.force[x + 1]] = sum.to_array();
        self.torque[x / 2] += moment;
    }
}
