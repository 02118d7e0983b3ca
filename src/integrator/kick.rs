//! The second half of a kick on its own, for steps after which somebody looks.

use super::constants::Constants;
use super::{Load, Motion};
use crate::threads::{CHUNK, Chunked, chunk_count};
use crate::vector::Vec2;

/// What the end of a step brings up to date of whole chunks of particles.
pub(super) struct Kick<'a> {
    /// The first of the particles.
    pub(super) first: usize,
    pub(super) positions: &'a mut [Vec2],
    pub(super) velocities: &'a mut [Vec2],
    pub(super) spins: &'a mut [f64],
    pub(super) accelerations: &'a mut [Vec2],
    pub(super) spin_rates: &'a mut [f64],
    pub(super) motions: &'a [Motion],
    pub(super) loads: &'a [Load],
}

impl Kick<'_> {
    /// Kicks one chunk.
    pub(super) fn run(self, constants: &Constants, half_step: f64, gravity: Vec2) {
        let n = self.loads.len();
        let constants = constants.of(self.first, n);
        let (positions, motions) = (&mut self.positions[..n], &self.motions[..n]);
        let (velocities, spins) = (&mut self.velocities[..n], &mut self.spins[..n]);
        let (accelerations, spin_rates) = (&mut self.accelerations[..n], &mut self.spin_rates[..n]);
        for (i, load) in self.loads.iter().enumerate() {
            let acceleration = load.force() * constants.inverse_masses[i] + gravity;
            let spin_rate = load.moment() * constants.inverse_inertias[i];
            positions[i] = motions[i].position();
            velocities[i] += acceleration * half_step;
            spins[i] += spin_rate * half_step;
            accelerations[i] = acceleration;
            spin_rates[i] = spin_rate;
        }
    }
}

impl Chunked for Kick<'_> {
    fn chunks(&self) -> usize {
        chunk_count(self.loads.len())
    }

    fn split(self, chunks: usize) -> (Self, Self) {
        let at = chunks * CHUNK;
        let (positions, more_positions) = self.positions.split_at_mut(at);
        let (velocities, more_velocities) = self.velocities.split_at_mut(at);
        let (spins, more_spins) = self.spins.split_at_mut(at);
        let (accelerations, more_accelerations) = self.accelerations.split_at_mut(at);
        let (spin_rates, more_spin_rates) = self.spin_rates.split_at_mut(at);
        let (motions, more_motions) = self.motions.split_at(at);
        let (loads, more_loads) = self.loads.split_at(at);
        let first = self.first;
        (
            Self { first, positions, velocities, spins, accelerations, spin_rates, motions, loads },
            Self {
                first: first + at,
                positions: more_positions,
                velocities: more_velocities,
                spins: more_spins,
                accelerations: more_accelerations,
                spin_rates: more_spin_rates,
                motions: more_motions,
                loads: more_loads,
            },
        )
    }
}
