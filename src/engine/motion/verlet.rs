//! The leapfrog: positions at the steps, velocities half a step before or after.
//!
//! A step is a kick by the forces and a drift. A kick is made of two equal halves: after the first the velocities are those
//! at the time of the positions, which is when a simulation can be looked at. Where nothing is looked at, both halves and
//! the drift are one pass; adding twice gives the bits of either way.

use super::MotionArrays;
use crate::engine::simd::{F64x4, LANES, Vec2x4, greatest};
use crate::physics::particles::Particles;
use crate::physics::scalar::Scalar;
use crate::physics::vector::Vec2;

/// The first half of a kick, which ends a step; the forces are kept.
pub const FINISH: Part = 1;
/// The second half and the drift, which begin the next step.
pub const START: Part = 2;
/// Both at once.
pub const WHOLE: Part = FINISH | START;

/// Which parts of a step are to be done, as bits.
pub type Part = u8;

/// What a chunk's particles did in a drift.
#[derive(Debug, Clone, Copy, Default)]
pub struct DriftSums {
    /// Σ m x after it [kg].
    pub mass_moment: [f64; 2],
    /// The most by which a displacement differs from that of the step before [m].
    pub change: f64,
}

/// The constants of the motion.
#[derive(Debug, Clone)]
pub struct Verlet {
    time_step: f64,
    /// The velocity that gravity gives in half a step [m/s].
    half_gravity: [f64; 2],
    inertias: Vec<BodyConstants>,
    are_equal: bool,
}

/// The constants of one particle.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct BodyConstants {
    mass: f64,
    /// Half a step over the mass.
    half_per_mass: f64,
    /// Half a step over the moment of inertia; 0 where the spin is locked.
    half_per_inertia: f64,
}

impl Verlet {
    /// For these particles.
    pub fn new(particles: &Particles, time_step: f64, gravity: Vec2) -> Self {
        let half = 0.5 * time_step;
        let per = |value: f64| if value > 0.0 { half / value } else { 0.0 };
        let inertia = |(&mass, &inertia): (&f64, &f64)| BodyConstants {
            mass,
            half_per_mass: per(mass),
            half_per_inertia: per(inertia),
        };
        let mut inertias: Vec<_> = particles.masses.iter().zip(&particles.inertias).map(inertia).collect();
        let are_equal = inertias.windows(2).all(|two| two[0] == two[1]);
        if are_equal {
            inertias.truncate(1);
            inertias.shrink_to_fit();
        }
        Self { time_step, half_gravity: [gravity.x * half, gravity.y * half], inertias, are_equal }
    }

    /// Moves a chunk's particles, the first of which is `first`; `arrays` are theirs alone.
    pub fn advance<const PART: Part>(&self, first: usize, arrays: MotionArrays) -> DriftSums {
        match self.inertias.first() {
            Some(&inertia) if self.are_equal => self.run::<PART>(&Same::new(inertia), arrays),
            _ => self.run::<PART>(&Each(&self.inertias[first..]), arrays),
        }
    }

    fn run<const PART: Part>(&self, inertia: &impl EachBody, arrays: MotionArrays) -> DriftSums {
        let MotionArrays { position, velocity, angle, angular_velocity, force, torque } = arrays;
        let (count, quads) = (position.len(), position.len() / LANES);
        let mut sums = LaneSums::default();
        {
            // Slices of one known length let the compiler drop the bounds checks.
            let position = &mut position.as_flattened_mut().as_chunks_mut::<{ 2 * LANES }>().0[..quads];
            let velocity = &mut velocity.as_flattened_mut().as_chunks_mut::<{ 2 * LANES }>().0[..quads];
            let force = &mut force.as_flattened_mut().as_chunks_mut::<{ 2 * LANES }>().0[..quads];
            let angle = &mut angle.as_chunks_mut::<LANES>().0[..quads];
            let spin = &mut angular_velocity.as_chunks_mut::<LANES>().0[..quads];
            let torque = &mut torque.as_chunks_mut::<LANES>().0[..quads];
            let [gx, gy] = self.half_gravity;
            let (gravity, step) = (F64x4::new([gx, gy, gx, gy]), F64x4::splat(self.time_step));
            for quad in 0..quads {
                let (position, velocity, force) =
                    (&mut position[quad], &mut velocity[quad], &mut force[quad]);
                let rows = [0, LANES].map(|row| {
                    let half_per_mass = inertia.half_per_mass(quad, row / LANES);
                    let [f, v, x] = [&*force, velocity, position].map(|values| F64x4::new(from(values, row)));
                    let kick = f * half_per_mass + gravity;
                    let (x, v) = kick_and_drift::<_, PART>(x, v, kick, step);
                    put(velocity, row, v);
                    if PART & START != 0 {
                        put(position, row, x);
                        put(force, row, F64x4::ZERO);
                    }
                    (kick, x)
                });
                sums.add(rows, inertia, quad);
                let kick = F64x4::new(torque[quad]) * inertia.half_per_inertia(quad);
                let (a, w) =
                    kick_and_drift::<_, PART>(F64x4::new(angle[quad]), F64x4::new(spin[quad]), kick, step);
                spin[quad] = w.to_array();
                if PART & START != 0 {
                    angle[quad] = a.to_array();
                    torque[quad] = [0.0; LANES];
                }
            }
        }
        let mut total = sums.total(inertia, self.time_step);
        // Those after the last whole quad, one by one.
        for k in LANES * quads..count {
            let BodyConstants { mass, half_per_mass, half_per_inertia } = inertia.of(k);
            let mut squared_kick = 0.0;
            for axis in 0..2 {
                let kick = force[k][axis] * half_per_mass + self.half_gravity[axis];
                squared_kick += kick * kick;
                let (x, v) =
                    kick_and_drift::<_, PART>(position[k][axis], velocity[k][axis], kick, self.time_step);
                (position[k][axis], velocity[k][axis]) = (x, v);
                total.mass_moment[axis] += mass * x;
            }
            total.change = total.change.max(2.0 * self.time_step * squared_kick.sqrt());
            let kick = torque[k] * half_per_inertia;
            let (a, w) = kick_and_drift::<_, PART>(angle[k], angular_velocity[k], kick, self.time_step);
            (angle[k], angular_velocity[k]) = (a, w);
            if PART & START != 0 {
                (force[k], torque[k]) = ([0.0; 2], 0.0);
            }
        }
        total
    }
}

/// Half a kick or both, then the drift if it is to be done.
#[inline(always)]
fn kick_and_drift<S: Scalar, const PART: Part>(place: S, rate: S, kick: S, step: S) -> (S, S) {
    let rate = if PART == WHOLE { (rate + kick) + kick } else { rate + kick };
    let place = if PART & START != 0 { place + rate * step } else { place };
    (place, rate)
}

/// Four of eight numbers.
#[inline(always)]
fn from(values: &[f64; 2 * LANES], start: usize) -> [f64; LANES] {
    [values[start], values[start + 1], values[start + 2], values[start + 3]]
}

#[inline(always)]
fn put(values: &mut [f64; 2 * LANES], start: usize, four: F64x4) {
    values[start..start + LANES].copy_from_slice(&four.to_array());
}

/// The constants of particles in a row.
trait EachBody {
    /// Those of one.
    fn of(&self, particle: usize) -> BodyConstants;
    /// Of two particles, for x and y.
    fn half_per_mass(&self, quad: usize, row: usize) -> F64x4;
    fn half_per_inertia(&self, quad: usize) -> F64x4;
    /// Positions (two a row) times masses, where these differ.
    fn weigh(&self, quad: usize, row: usize, position: F64x4) -> F64x4;
    /// The mass where all have the same.
    fn mass(&self) -> f64;
}

/// Equal particles.
struct Same {
    inertia: BodyConstants,
    half_per_mass: F64x4,
    half_per_inertia: F64x4,
}

impl Same {
    fn new(inertia: BodyConstants) -> Self {
        let [half_per_mass, half_per_inertia] =
            [inertia.half_per_mass, inertia.half_per_inertia].map(F64x4::splat);
        Self { inertia, half_per_mass, half_per_inertia }
    }
}

impl EachBody for Same {
    fn of(&self, _particle: usize) -> BodyConstants {
        self.inertia
    }

    #[inline(always)]
    fn half_per_mass(&self, _quad: usize, _row: usize) -> F64x4 {
        self.half_per_mass
    }

    #[inline(always)]
    fn half_per_inertia(&self, _quad: usize) -> F64x4 {
        self.half_per_inertia
    }

    #[inline(always)]
    fn weigh(&self, _quad: usize, _row: usize, position: F64x4) -> F64x4 {
        position
    }

    fn mass(&self) -> f64 {
        self.inertia.mass
    }
}

/// Particles that differ.
struct Each<'a>(&'a [BodyConstants]);

impl Each<'_> {
    #[inline(always)]
    fn two(&self, quad: usize, row: usize, value: impl Fn(&BodyConstants) -> f64) -> F64x4 {
        let first = LANES * quad + 2 * row;
        let (a, b) = (value(&self.0[first]), value(&self.0[first + 1]));
        F64x4::new([a, a, b, b])
    }
}

impl EachBody for Each<'_> {
    fn of(&self, particle: usize) -> BodyConstants {
        self.0[particle]
    }

    #[inline(always)]
    fn half_per_mass(&self, quad: usize, row: usize) -> F64x4 {
        self.two(quad, row, |inertia| inertia.half_per_mass)
    }

    #[inline(always)]
    fn half_per_inertia(&self, quad: usize) -> F64x4 {
        let four = &self.0[LANES * quad..LANES * quad + LANES];
        F64x4::new(std::array::from_fn(|lane| four[lane].half_per_inertia))
    }

    #[inline(always)]
    fn weigh(&self, quad: usize, row: usize, position: F64x4) -> F64x4 {
        position * self.two(quad, row, |inertia| inertia.mass)
    }

    fn mass(&self) -> f64 {
        1.0
    }
}

/// Sums over quads, lane by lane.
#[derive(Debug, Default)]
struct LaneSums {
    /// Σ x, or Σ m x where masses differ; x and y in turn.
    moments: F64x4,
    /// The greatest square of half a kick.
    squared_kick: F64x4,
}

impl LaneSums {
    #[inline(always)]
    fn add(&mut self, rows: [(F64x4, F64x4); 2], inertia: &impl EachBody, quad: usize) {
        let [(kick, position), (other_kick, other)] = rows;
        self.moments += inertia.weigh(quad, 0, position);
        self.moments += inertia.weigh(quad, 1, other);
        let squares = Vec2x4::from_rows([kick * kick, other_kick * other_kick]);
        self.squared_kick = (squares.x + squares.y).larger(self.squared_kick);
    }

    fn total(&self, inertia: &impl EachBody, time_step: f64) -> DriftSums {
        let ([a, b, c, d], mass) = (self.moments.to_array(), inertia.mass());
        DriftSums {
            mass_moment: [(a + c) * mass, (b + d) * mass],
            change: 2.0 * time_step * greatest(self.squared_kick.to_array()).sqrt(),
        }
    }
}
