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
    /// Of each particle, or of the first where they are equal.
    bodies: Vec<BodyConstants>,
    are_equal: bool,
}

/// The constants of one particle.
#[derive(Debug, Clone, Copy, PartialEq)]
struct BodyConstants {
    mass: f64,
    /// Half a step over the mass.
    half_per_mass: f64,
    /// Half a step over the moment of inertia; 0 where the spin is locked.
    half_per_inertia: f64,
}

/// The constants of four particles; those of two vectors a row, for x and y.
struct QuadConstants {
    /// What positions are weighed with: the masses, or 1 where all are equal.
    weights: [F64x4; 2],
    half_per_mass: [F64x4; 2],
    half_per_inertia: F64x4,
}

impl Verlet {
    /// For these particles.
    pub fn new(particles: &Particles, time_step: f64, gravity: Vec2) -> Self {
        let half = 0.5 * time_step;
        let per = |value: f64| if value > 0.0 { half / value } else { 0.0 };
        let body = |(&mass, &inertia): (&f64, &f64)| BodyConstants {
            mass,
            half_per_mass: per(mass),
            half_per_inertia: per(inertia),
        };
        let mut bodies: Vec<_> = particles.masses.iter().zip(&particles.inertias).map(body).collect();
        let are_equal = bodies.windows(2).all(|two| two[0] == two[1]);
        if are_equal {
            bodies.truncate(1);
            bodies.shrink_to_fit();
        }
        Self { time_step, half_gravity: [gravity.x * half, gravity.y * half], bodies, are_equal }
    }

    /// Moves a chunk's particles; `arrays` are theirs alone.
    pub fn advance<const PART: Part>(&self, arrays: MotionArrays) -> DriftSums {
        match self.bodies.first() {
            Some(&body) if self.are_equal => {
                let quad = |_| QuadConstants {
                    weights: [F64x4::ONE; 2],
                    half_per_mass: [F64x4::splat(body.half_per_mass); 2],
                    half_per_inertia: F64x4::splat(body.half_per_inertia),
                };
                self.run::<PART>(arrays, quad, |_| body, body.mass)
            }
            _ => {
                let bodies = &self.bodies[arrays.first..];
                let quad = |quad: usize| {
                    let [a, b, c, d] = std::array::from_fn(|lane| bodies[LANES * quad + lane]);
                    let rows = |value: fn(BodyConstants) -> f64| {
                        let row = |a, b| F64x4::new([value(a), value(a), value(b), value(b)]);
                        [row(a, b), row(c, d)]
                    };
                    QuadConstants {
                        weights: rows(|body| body.mass),
                        half_per_mass: rows(|body| body.half_per_mass),
                        half_per_inertia: F64x4::new([a, b, c, d].map(|body| body.half_per_inertia)),
                    }
                };
                self.run::<PART>(arrays, quad, |particle| bodies[particle], 1.0)
            }
        }
    }

    /// Moves them by the constants of quads, and of those after the last whole quad; sums of weighed positions are multiplied by
    /// `mass`.
    #[inline(always)]
    fn run<const PART: Part>(
        &self,
        arrays: MotionArrays,
        constants: impl Fn(usize) -> QuadConstants,
        body: impl Fn(usize) -> BodyConstants,
        mass: f64,
    ) -> DriftSums {
        let ([position, velocity, force], [angle, angular_velocity, torque]) =
            (arrays.vectors, arrays.scalars);
        let (count, quads) = (position.len(), position.len() / LANES);
        // Σ x, or Σ m x where masses differ, x and y in turn; the greatest square of half a kick.
        let (mut moments, mut greatest_square) = (F64x4::ZERO, F64x4::ZERO);
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
                let constants = constants(quad);
                // Calls one by one: `array::map` is not always inlined.
                let mut advance = |row: usize| {
                    let start = LANES * row;
                    let four = |values| F64x4::new(from(values, start));
                    let (f, v, x) = (four(force), four(velocity), four(position));
                    let kick = f * constants.half_per_mass[row] + gravity;
                    let (x, v) = kick_and_drift::<_, PART>(x, v, kick, step);
                    put(velocity, start, v);
                    if PART & START != 0 {
                        put(position, start, x);
                        put(force, start, F64x4::ZERO);
                    }
                    moments += x * constants.weights[row];
                    kick * kick
                };
                let squares = Vec2x4::from_rows([advance(0), advance(1)]);
                greatest_square = (squares.x + squares.y).larger(greatest_square);
                let kick = F64x4::new(torque[quad]) * constants.half_per_inertia;
                let (a, w) =
                    kick_and_drift::<_, PART>(F64x4::new(angle[quad]), F64x4::new(spin[quad]), kick, step);
                spin[quad] = w.to_array();
                if PART & START != 0 {
                    angle[quad] = a.to_array();
                    torque[quad] = [0.0; LANES];
                }
            }
        }
        let [a, b, c, d] = moments.to_array();
        let mut total = DriftSums {
            mass_moment: [(a + c) * mass, (b + d) * mass],
            change: 2.0 * self.time_step * greatest(greatest_square.to_array()).sqrt(),
        };
        // Those after the last whole quad, one by one.
        for k in LANES * quads..count {
            let BodyConstants { mass, half_per_mass, half_per_inertia } = body(k);
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
