//! Where the forces of contacts go.

use wide::f64x2;

use super::reactions::RemoteReactions;
use crate::engine::motion::{FlatSums, at_offset, flat};

/// Sums of forces and moments by particle. Every particle meets its contacts in the order of their lists.
pub trait Accumulator {
    /// Takes the force of a contact off the particle at offset `own`, and adds the moment.
    fn subtract(&mut self, own: u32, force: f64x2, moment: f64);
    /// Adds force and moment of a contact to the particle at offset `other`.
    fn add(&mut self, other: u32, force: f64x2, moment: f64);
}

/// The sums of a load that is one chunk.
impl Accumulator for FlatSums<'_> {
    #[inline(always)]
    fn subtract(&mut self, own: u32, force: f64x2, moment: f64) {
        let (own, next) = (flat(own), flat(own) + 1);
        let sum = f64x2::new([self.force[own], self.force[next]]) - force;
        [self.force[own], self.force[next]] = sum.to_array();
        self.torque[own / 2] += moment;
    }

    #[inline(always)]
    fn add(&mut self, other: u32, force: f64x2, moment: f64) {
        let (other, next) = (flat(other), flat(other) + 1);
        let sum = f64x2::new([self.force[other], self.force[next]]) + force;
        [self.force[other], self.force[next]] = sum.to_array();
        self.torque[other / 2] += moment;
    }
}

/// The sums of one chunk of many; what goes to particles of later chunks is kept for them.
#[derive(Debug)]
pub struct ChunkSums<'a> {
    /// The chunk's first particle.
    pub first: usize,
    /// Forces on the chunk's particles [N/m].
    pub force: &'a mut [[f64; 2]],
    /// Moments on them [N m/m].
    pub torque: &'a mut [f64],
    /// What goes to others.
    pub remote: &'a mut RemoteReactions,
}

impl Accumulator for ChunkSums<'_> {
    #[inline(always)]
    fn subtract(&mut self, own: u32, force: f64x2, moment: f64) {
        let own = (at_offset(own) as usize).wrapping_sub(self.first);
        // A lane without a contact may refer to a place beyond all particles.
        if let (Some(sum), Some(torque)) = (self.force.get_mut(own), self.torque.get_mut(own)) {
            *sum = (f64x2::new(*sum) - force).to_array();
            *torque += moment;
        }
    }

    #[inline(always)]
    fn add(&mut self, other: u32, force: f64x2, moment: f64) {
        let own = (at_offset(other) as usize).wrapping_sub(self.first);
        if let (Some(sum), Some(torque)) = (self.force.get_mut(own), self.torque.get_mut(own)) {
            *sum = (f64x2::new(*sum) + force).to_array();
            *torque += moment;
        } else {
            self.remote.send(at_offset(other), force.to_array(), moment);
        }
    }
}
