//! Kick, drift, kick: velocity Verlet for centers and spins.
//!
//! Between the kicks a particle moves with its half-step velocity; contacts are told that displacement. The velocity at
//! the end of the step, which the dashpots need before the force is known, is foretold with the last acceleration.

mod constants;
mod drift;
mod kick;
mod pull;
mod quad;

use crate::lanes::Lanes;
use crate::particles::Particles;
use crate::patch::{PATCH, PatchMotion};
use crate::threads::{CHUNK, Threads, chunk_count};
use crate::vector::Vec2;
use constants::Constants;
pub use drift::{Drift, Moved};
use drift::{Setting, Start};
use kick::Kick;

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

/// Scratch of the integrator; nothing in it outlives a step but what follows from the particles' constants. While steps
/// follow each other unseen, the motions alone know where the particles are.
#[derive(Debug, Clone)]
pub struct Integrator {
    /// What the contacts are told, by particle.
    pub motions: Vec<Motion>,
    /// The most that anyone did in the last step, by patch.
    pub patches: Vec<PatchMotion>,
    /// The same of the step under way: chunks move on while others still read what was done in the last.
    next_patches: Vec<PatchMotion>,
    /// Σ m x, by chunk.
    mass_moments: Vec<Vec2>,
    constants: Constants,
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
        Self {
            motions: (0..particles.len()).map(still).collect(),
            patches: vec![PatchMotion::default(); particles.len().div_ceil(PATCH)],
            next_patches: vec![PatchMotion::default(); particles.len().div_ceil(PATCH)],
            mass_moments: vec![Vec2::zeros(); chunk_count(particles.len())],
            constants: Constants::new(particles),
            time_step,
            gravity,
        }
    }

    /// A drift of all particles, while the drum turns by `turn` [rad], still to be run chunk by chunk; what the contacts are
    /// told by particle, which it changes; and by patch.
    pub fn drift<'a>(
        &'a mut self,
        moved: Moved<'a>,
        turn: f64,
    ) -> (Drift<'a>, &'a mut [Motion], &'a [PatchMotion]) {
        let (constants, time_step, gravity) = (&self.constants, self.time_step, self.gravity);
        let drift = Drift {
            first: 0,
            moved,
            patches: &mut self.next_patches,
            mass_moments: &mut self.mass_moments,
            setting: Setting { constants, time_step, turn, gravity },
        };
        (drift, &mut self.motions, &self.patches)
    }

    /// Half a kick with the accelerations that the particles carry, then the drift.
    pub fn start(&mut self, particles: &mut Particles, turn: f64, threads: &Threads) -> DriftSums {
        let moved = Moved {
            velocities: &mut particles.velocities,
            angles: &mut particles.angles,
            spins: &mut particles.angular_velocities,
        };
        let (drift, motions, _) = self.drift(moved, turn);
        let (accelerations, spin_rates) = (&particles.accelerations, &particles.angular_accelerations);
        let work = Start { drift, motions, accelerations, spin_rates };
        threads.for_each_chunk(accelerations.len(), work, &Start::run);
        self.end_drift()
    }

    /// Sums up what a drift did that has been run on all chunks.
    pub fn end_drift(&mut self) -> DriftSums {
        std::mem::swap(&mut self.patches, &mut self.next_patches);
        let mass_moment = self.mass_moments.iter().fold(Vec2::zeros(), |sum, part| sum + part);
        let longest_way = self.patches.iter().fold(0.0, |most: f64, patch| most.max(patch.way));
        DriftSums { mass_moment, longest_way }
    }

    /// Accelerations from the loads and gravity, then the second half of the kick: the particles are up to date.
    pub fn finish(&self, particles: &mut Particles, loads: &[Load], threads: &Threads) {
        let count = particles.len();
        let (constants, half_step, gravity) = (&self.constants, 0.5 * self.time_step, self.gravity);
        let work = Kick {
            first: 0,
            positions: &mut particles.positions,
            velocities: &mut particles.velocities,
            spins: &mut particles.angular_velocities,
            accelerations: &mut particles.accelerations,
            spin_rates: &mut particles.angular_accelerations,
            motions: &self.motions,
            loads,
        };
        threads.for_each_chunk(count, work, &|chunk: Kick| chunk.run(constants, half_step, gravity));
    }

    /// Tells the particles where they are.
    pub fn place(&self, positions: &mut [Vec2]) {
        for (position, motion) in positions.iter_mut().zip(&self.motions) {
            *position = motion.position();
        }
    }

    /// Accelerations from the loads and gravity alone: the start of a simulation, before the first kick.
    pub fn accelerate(&self, particles: &mut Particles, loads: &[Load]) {
        for (chunk, loads) in loads.chunks(CHUNK).enumerate() {
            let constants = self.constants.of(chunk * CHUNK, loads.len());
            for (i, load) in loads.iter().enumerate() {
                let particle = chunk * CHUNK + i;
                particles.accelerations[particle] = load.force() * constants.inverse_masses[i] + self.gravity;
                particles.angular_accelerations[particle] = load.moment() * constants.inverse_inertias[i];
            }
        }
    }
}
