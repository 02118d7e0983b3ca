//! The second half of a kick on its own, for steps after which somebody looks.

use super::constants::Constants;
use super::{Load, Motion};
use crate::threads::{CHUNK, Chunked, chunk_count};
use crate::vector::Vec2;

/// What the end of a step brings up to date of whole chunks of particles.
pub(super) struct Kick<'a> {
    /// The first of the particles.
    pub(super) first: usize,
    pub(super) motions: &'a mut [Motion],
    pub(super) accelerations: &'a mut [Vec2],
    pub(super) spin_rates: &'a mut [f64],
    pub(super) loads: &'a [Load],
}

impl Kick<'_> {
    /// Kicks one chunk.
    pub(super) fn run(self, constants: &Constants, half_step: f64, gravity: Vec2) {
        let n = self.loads.len();
        let constants = constants.of(self.first, n);
        let motions = &mut self.motions[..n];
        let (accelerations, spin_rates) = (&mut self.accelerations[..n], &mut self.spin_rates[..n]);
        for (i, load) in self.loads.iter().enumerate() {
            accelerations[i] = load.force() * constants.inverse_masses[i] + gravity;
            spin_rates[i] = load.moment() * constants.inverse_inertias[i];
            motions[i].kick(accelerations[i] * half_step, spin_rates[i] * half_step);
        }
    }
}

impl Chunked for Kick<'_> {
    fn chunks(&self) -> usize {
        chunk_count(self.loads.len())
    }

    fn split(self, chunks: usize) -> (Self, Self) {
        let at = chunks * CHUNK;
        let (motions, more_motions) = self.motions.split_at_mut(at);
        let (accelerations, more_accelerations) = self.accelerations.split_at_mut(at);
        let (spin_rates, more_spin_rates) = self.spin_rates.split_at_mut(at);
        let (loads, more_loads) = self.loads.split_at(at);
        let first = self.first;
        (
            Self { first, motions, accelerations, spin_rates, loads },
            Self {
                first: first + at,
                motions: more_motions,
                accelerations: more_accelerations,
                spin_rates: more_spin_rates,
                loads: more_loads,
            },
        )
    }
}
