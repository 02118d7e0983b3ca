//! Kick, drift, kick: velocity Verlet for centers and spins.
//!
//! Between the kicks a particle moves with its half-step velocity; contacts are told that displacement. The velocity at
//! the end of the step, which the dashpots need before the force is known, is foretold with the last acceleration.

mod drift;
mod kick;
mod pull;
mod quad;

use crate::lanes::Lanes;
use crate::particles::Particles;
use crate::threads::{PATCH, Threads, chunk_count};
use crate::vector::Vec2;
use drift::{Drift, Moved};
use kick::Kick;
use pull::{Fresh, Known};

/// What contacts need of a particle in one step, as two rows that load at once; one cache line.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C, align(64))]
pub struct Motion {
    /// Center at the end of the step [m], x and y; how it got there [m], x and y.
    pub place: Lanes,
    /// Velocity foretold for the end of the step [m/s], x and y; angle turned during the step [rad]; radius [m].
    pub pace: Lanes,
}

impl Motion {
    /// Center at the end of the step [m].
    #[inline(always)]
    pub fn position(&self) -> Vec2 {
        let [x, y, _, _] = self.place.to_array();
        Vec2::new(x, y)
    }

    /// Angle turned during the step [rad].
    #[inline(always)]
    pub fn turn(&self) -> f64 {
        self.pace.as_array()[2]
    }

    /// Radius [m].
    #[inline(always)]
    pub fn radius(&self) -> f64 {
        self.pace.as_array()[3]
    }
}

/// Sums over particles at the end of the drift.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DriftSums {
    /// Σ m x [kg].
    pub mass_moment: Vec2,
    /// Longest way of a particle in this step as seen from the drum [m].
    pub longest_way: f64,
}

/// Force of all contacts on a particle [N/m], x and y, and their moment about its center [N m/m]; the fourth number means
/// nothing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Load(pub Lanes);

impl Default for Load {
    fn default() -> Self {
        Self(Lanes::ZERO)
    }
}

impl Load {
    /// Force [N/m].
    #[inline(always)]
    pub fn force(&self) -> Vec2 {
        let [x, y, _, _] = self.0.to_array();
        Vec2::new(x, y)
    }

    /// Moment about the center [N m/m].
    #[inline(always)]
    pub fn moment(&self) -> f64 {
        self.0.to_array()[2]
    }
}

/// Scratch of the integrator; nothing in it outlives a step but what follows from the particles' constants.
#[derive(Debug, Clone)]
pub struct Integrator {
    /// What the contacts are told, by particle.
    pub motions: Vec<Motion>,
    /// 1/m [m/kg], by particle.
    inverse_masses: Vec<f64>,
    /// 1/I, 0 where the spin is locked.
    inverse_inertias: Vec<f64>,
    /// The square of the longest way of the step as seen from the drum [m²], by patch.
    pub ways: Vec<f64>,
    /// Σ m x, by chunk.
    mass_moments: Vec<Vec2>,
    time_step: f64,
    gravity: Vec2,
}

impl Integrator {
    /// For these particles at rest in time: the motions say where they are and how fast, with no displacement.
    pub fn new(particles: &Particles, time_step: f64, gravity: Vec2) -> Self {
        let still = |i: usize| {
            let (position, velocity) = (particles.positions[i], particles.velocities[i]);
            Motion {
                place: Lanes::new([position.x, position.y, 0.0, 0.0]),
                pace: Lanes::new([velocity.x, velocity.y, 0.0, particles.radii[i]]),
            }
        };
        let inverse = |value: &f64| if *value > 0.0 { 1.0 / value } else { 0.0 };
        Self {
            motions: (0..particles.len()).map(still).collect(),
            inverse_masses: particles.masses.iter().map(inverse).collect(),
            inverse_inertias: particles.inertias.iter().map(inverse).collect(),
            ways: vec![0.0; particles.len().div_ceil(PATCH)],
            mass_moments: vec![Vec2::zeros(); chunk_count(particles.len())],
            time_step,
            gravity,
        }
    }

    /// Half a kick with the known accelerations, then the drift, while the drum turns by `turn` [rad].
    pub fn drift(&mut self, particles: &mut Particles, turn: f64, threads: &Threads) -> DriftSums {
        let known =
            Known { accelerations: &particles.accelerations, spin_rates: &particles.angular_accelerations };
        let moved = Moved {
            positions: &mut particles.positions,
            velocities: &mut particles.velocities,
            angles: &mut particles.angles,
            spins: &mut particles.angular_velocities,
        };
        let (time_step, masses) = (self.time_step, &particles.masses);
        let (motions, sums, ways) = (&mut self.motions[..], &mut self.mass_moments[..], &mut self.ways[..]);
        let work = Drift { pull: known, moved, masses, motions, sums, ways };
        threads.for_each_chunk(masses.len(), work, &|chunk: Drift<Known>| chunk.run(time_step, turn));
        self.sum()
    }

    /// The second half of a kick and a `drift` in one pass over the particles, for steps between which nobody looks:
    /// the same operations, but accelerations are not kept.
    pub fn kick_and_drift(
        &mut self,
        particles: &mut Particles,
        loads: &mut [Load],
        turn: f64,
        threads: &Threads,
    ) -> DriftSums {
        let fresh = Fresh {
            loads,
            inverse_masses: &self.inverse_masses,
            inverse_inertias: &self.inverse_inertias,
            gravity: self.gravity,
        };
        let moved = Moved {
            positions: &mut particles.positions,
            velocities: &mut particles.velocities,
            angles: &mut particles.angles,
            spins: &mut particles.angular_velocities,
        };
        let (time_step, masses) = (self.time_step, &particles.masses);
        let (motions, sums, ways) = (&mut self.motions[..], &mut self.mass_moments[..], &mut self.ways[..]);
        let work = Drift { pull: fresh, moved, masses, motions, sums, ways };
        threads.for_each_chunk(masses.len(), work, &|chunk: Drift<Fresh>| chunk.run(time_step, turn));
        self.sum()
    }

    fn sum(&self) -> DriftSums {
        let mass_moment = self.mass_moments.iter().fold(Vec2::zeros(), |sum, part| sum + part);
        let longest_squared = self.ways.iter().copied().fold(0.0, f64::max);
        DriftSums { mass_moment, longest_way: longest_squared.sqrt() }
    }

    /// Accelerations from the loads and gravity, then the second half of the kick.
    pub fn kick(&self, particles: &mut Particles, loads: &[Load], threads: &Threads) {
        let count = particles.len();
        let (half_step, gravity) = (0.5 * self.time_step, self.gravity);
        let work = Kick {
            velocities: &mut particles.velocities,
            spins: &mut particles.angular_velocities,
            accelerations: &mut particles.accelerations,
            spin_rates: &mut particles.angular_accelerations,
            loads,
            inverse_masses: &self.inverse_masses,
            inverse_inertias: &self.inverse_inertias,
        };
        threads.for_each_chunk(count, work, &|chunk: Kick| chunk.run(half_step, gravity));
    }

    /// Accelerations from the loads and gravity alone: the start of a simulation, before the first kick.
    pub fn accelerate(&self, particles: &mut Particles, loads: &[Load]) {
        for (i, load) in loads.iter().enumerate() {
            particles.accelerations[i] = load.force() * self.inverse_masses[i] + self.gravity;
            particles.angular_accelerations[i] = load.moment() * self.inverse_inertias[i];
        }
    }
}
