//! Kick, drift, kick: velocity Verlet for centers and spins.
//!
//! Between the kicks a particle moves with its half-step velocity; contacts are told that displacement. The velocity at
//! the end of the step, which the dashpots need before the force is known, is foretold with the last acceleration.

use crate::lanes::Lanes;
use crate::particles::Particles;
use crate::threads::{CHUNK, Chunked, Threads, chunk_count};
use crate::vector::{Vec2, dot, larger, perpendicular};

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

    /// Radius [m].
    #[inline(always)]
    pub fn radius(&self) -> f64 {
        self.pace.to_array()[3]
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
    /// Per chunk: Σ m x and the square of the longest way.
    chunks: Vec<(Vec2, f64)>,
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
            chunks: vec![(Vec2::zeros(), 0.0); chunk_count(particles.len())],
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
        let work = Drift { pull: known, moved, masses, motions: &mut self.motions, sums: &mut self.chunks };
        threads.for_each_chunk(masses.len(), work, &|chunk: Drift<Known>| chunk.run(time_step, turn));
        self.sum()
    }

    /// The second half of a kick and a `drift` in one pass over the particles, for steps between which nobody looks:
    /// the same operations, but accelerations are not kept.
    pub fn kick_and_drift(
        &mut self,
        particles: &mut Particles,
        loads: &[Load],
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
        let work = Drift { pull: fresh, moved, masses, motions: &mut self.motions, sums: &mut self.chunks };
        threads.for_each_chunk(masses.len(), work, &|chunk: Drift<Fresh>| chunk.run(time_step, turn));
        self.sum()
    }

    fn sum(&self) -> DriftSums {
        let start = (Vec2::zeros(), 0.0_f64);
        let (mass_moment, longest_squared) =
            self.chunks.iter().fold(start, |sum, chunk| (sum.0 + chunk.0, sum.1.max(chunk.1)));
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

/// Where a drift takes its accelerations from.
trait Pull: Send + Sized {
    /// Whether the velocities still lack the second half of the last kick.
    const UNFINISHED: bool;
    /// Acceleration and angular acceleration of a particle of the chunk.
    fn of(&self, i: usize) -> (Vec2, f64);
    fn split(self, at: usize) -> (Self, Self);
}

/// The accelerations that the particles carry.
struct Known<'a> {
    accelerations: &'a [Vec2],
    spin_rates: &'a [f64],
}

impl Pull for Known<'_> {
    const UNFINISHED: bool = false;

    #[inline]
    fn of(&self, i: usize) -> (Vec2, f64) {
        (self.accelerations[i], self.spin_rates[i])
    }

    fn split(self, at: usize) -> (Self, Self) {
        let (accelerations, more_accelerations) = self.accelerations.split_at(at);
        let (spin_rates, more_spin_rates) = self.spin_rates.split_at(at);
        (
            Self { accelerations, spin_rates },
            Self { accelerations: more_accelerations, spin_rates: more_spin_rates },
        )
    }
}

/// Accelerations from the loads of the last force pass.
struct Fresh<'a> {
    loads: &'a [Load],
    inverse_masses: &'a [f64],
    inverse_inertias: &'a [f64],
    gravity: Vec2,
}

impl Pull for Fresh<'_> {
    const UNFINISHED: bool = true;

    #[inline]
    fn of(&self, i: usize) -> (Vec2, f64) {
        let load = &self.loads[i];
        (load.force() * self.inverse_masses[i] + self.gravity, load.moment() * self.inverse_inertias[i])
    }

    fn split(self, at: usize) -> (Self, Self) {
        let (loads, more_loads) = self.loads.split_at(at);
        let (inverse_masses, more_inverse_masses) = self.inverse_masses.split_at(at);
        let (inverse_inertias, more_inverse_inertias) = self.inverse_inertias.split_at(at);
        let gravity = self.gravity;
        (
            Self { loads, inverse_masses, inverse_inertias, gravity },
            Self {
                loads: more_loads,
                inverse_masses: more_inverse_masses,
                inverse_inertias: more_inverse_inertias,
                gravity,
            },
        )
    }
}

/// What a drift changes.
struct Moved<'a> {
    positions: &'a mut [Vec2],
    velocities: &'a mut [Vec2],
    angles: &'a mut [f64],
    spins: &'a mut [f64],
}

impl Moved<'_> {
    fn split(self, at: usize) -> (Self, Self) {
        let (positions, more_positions) = self.positions.split_at_mut(at);
        let (velocities, more_velocities) = self.velocities.split_at_mut(at);
        let (angles, more_angles) = self.angles.split_at_mut(at);
        let (spins, more_spins) = self.spins.split_at_mut(at);
        (
            Self { positions, velocities, angles, spins },
            Self {
                positions: more_positions,
                velocities: more_velocities,
                angles: more_angles,
                spins: more_spins,
            },
        )
    }
}

struct Drift<'a, P> {
    pull: P,
    moved: Moved<'a>,
    masses: &'a [f64],
    motions: &'a mut [Motion],
    sums: &'a mut [(Vec2, f64)],
}

impl<P: Pull> Drift<'_, P> {
    fn run(self, time_step: f64, turn: f64) {
        let half_step = 0.5 * time_step;
        let mut mass_moment = Vec2::zeros();
        let mut longest_squared = 0.0_f64;
        let n = self.motions.len();
        // Slices of one known length let the compiler drop the bounds checks.
        let (positions, velocities) = (&mut self.moved.positions[..n], &mut self.moved.velocities[..n]);
        let (angles, spins) = (&mut self.moved.angles[..n], &mut self.moved.spins[..n]);
        let masses = &self.masses[..n];
        for (i, motion) in self.motions.iter_mut().enumerate() {
            let (acceleration, spin_rate) = self.pull.of(i);
            let (kick, twist) = (acceleration * half_step, spin_rate * half_step);
            let (mut velocity, mut spin) = (velocities[i], spins[i]);
            if P::UNFINISHED {
                velocity += kick;
                spin += twist;
            }
            velocity += kick;
            spin += twist;
            let displacement = velocity * time_step;
            let way = displacement - perpendicular(positions[i]) * turn;
            let position = positions[i] + displacement;
            let own_turn = spin * time_step;
            velocities[i] = velocity;
            positions[i] = position;
            spins[i] = spin;
            angles[i] += own_turn;
            motion.place = Lanes::new([position.x, position.y, displacement.x, displacement.y]);
            let foretold = velocity + kick;
            motion.pace = Lanes::new([foretold.x, foretold.y, own_turn, motion.radius()]);
            mass_moment += position * masses[i];
            longest_squared = larger(dot(way, way), longest_squared);
        }
        if let Some(sums) = self.sums.first_mut() {
            *sums = (mass_moment, longest_squared);
        }
    }
}

impl<P: Pull> Chunked for Drift<'_, P> {
    fn chunks(&self) -> usize {
        self.sums.len()
    }

    fn split(self, chunks: usize) -> (Self, Self) {
        let at = chunks * CHUNK;
        let (pull, more_pull) = self.pull.split(at);
        let (moved, more_moved) = self.moved.split(at);
        let (masses, more_masses) = self.masses.split_at(at);
        let (motions, more_motions) = self.motions.split_at_mut(at);
        let (sums, more_sums) = self.sums.split_at_mut(chunks);
        (
            Self { pull, moved, masses, motions, sums },
            Self {
                pull: more_pull,
                moved: more_moved,
                masses: more_masses,
                motions: more_motions,
                sums: more_sums,
            },
        )
    }
}

struct Kick<'a> {
    velocities: &'a mut [Vec2],
    spins: &'a mut [f64],
    accelerations: &'a mut [Vec2],
    spin_rates: &'a mut [f64],
    loads: &'a [Load],
    inverse_masses: &'a [f64],
    inverse_inertias: &'a [f64],
}

impl Kick<'_> {
    fn run(self, half_step: f64, gravity: Vec2) {
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
