//! The second half of a kick on its own, for steps after which somebody looks.

use super::Load;
use crate::threads::{CHUNK, Chunked, chunk_count};
use crate::vector::Vec2;

pub(super) struct Kick<'a> {
    pub(super) velocities: &'a mut [Vec2],
    pub(super) spins: &'a mut [f64],
    pub(super) accelerations: &'a mut [Vec2],
    pub(super) spin_rates: &'a mut [f64],
    pub(super) loads: &'a [Load],
    pub(super) inverse_masses: &'a [f64],
    pub(super) inverse_inertias: &'a [f64],
}

impl Kick<'_> {
    pub(super) fn run(self, half_step: f64, gravity: Vec2) {
        let n = self.loads.len();
        let (velocities, spins) = (&mut self.velocities[..n], &mut self.spins[..n]);
        let (accelerations, spin_rates) = (&mut self.accelerations[..n], &mut self.spin_rates[..n]);
        let (inverse_masses, inverse_inertias) = (&self.inverse_masses[..n], &self.inverse_inertias[..n]);
        for (i, load) in self.loads.iter().enumerate() {
            let acceleration = load.force() * inverse_masses[i] + gravity;
            let spin_rate = load.moment() * inverse_inertias[i];
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
        let (velocities, velocities_rest) = self.velocities.split_at_mut(at);
        let (spins, spins_rest) = self.spins.split_at_mut(at);
        let (accelerations, accelerations_rest) = self.accelerations.split_at_mut(at);
        let (spin_rates, spin_rates_rest) = self.spin_rates.split_at_mut(at);
        let (loads, loads_rest) = self.loads.split_at(at);
        let (inverse_masses, inverse_masses_rest) = self.inverse_masses.split_at(at);
        let (inverse_inertias, inverse_inertias_rest) = self.inverse_inertias.split_at(at);
        (
            Self { velocities, spins, accelerations, spin_rates, loads, inverse_masses, inverse_inertias },
            Self {
                velocities: velocities_rest,
                spins: spins_rest,
                accelerations: accelerations_rest,
                spin_rates: spin_rates_rest,
                loads: loads_rest,
                inverse_masses: inverse_masses_rest,
                inverse_inertias: inverse_inertias_rest,
            },
        )
    }
}
