//! What the particles of one chunk may touch: neighbors, and which of them are near.

use std::ops::Range;

use super::horizon::{Horizon, STEPS};
use super::near::Reach;
use super::neighbors::Neighbors;
use crate::engine::forces::StepInputs;
use crate::engine::motion::{MotionView, far, inside, offset};
use crate::engine::parallel::CHUNK;
use crate::engine::simd::{ALL_LANES, F64x4, LANES, Vec2x4, greatest, lanes, vectors};
use crate::physics::drum::RIM;
use crate::physics::scalar::Scalar;
use crate::physics::vector::{Vec2, perpendicular};

/// The neighbors of one chunk's particles.
#[derive(Debug, Clone)]
pub struct ChunkNeighbors {
    /// The chunk's particles.
    pub particles: Range<u32>,
    /// Pairs with later particles.
    pub pairs: Neighbors,
    /// Pairs with the rim.
    pub rim: Neighbors,
    /// Pairs with edges and vertices of outlines.
    pub features: Neighbors,
    /// The chunks of the particles of the pairs; ascending.
    pub watched: Vec<u32>,
    /// For how long the near lists hold.
    pub horizon: Horizon,
    /// No particle of the chunk moves farther in a step, as seen from the drum [m].
    pub longest_displacement: f64,
    /// The margin of the list of neighbors [m].
    skin: f64,
}

impl ChunkNeighbors {
    /// For chunk `index` of `count` particles.
    pub fn new(index: usize, count: usize, skin: f64) -> Self {
        let first = (index * CHUNK) as u32;
        let particles = first..(count.min((index + 1) * CHUNK)) as u32;
        Self {
            pairs: Neighbors::new((first, far(count))),
            rim: Neighbors::new((inside(count), RIM)),
            features: Neighbors::new((far(count), RIM)),
            watched: Vec::new(),
            horizon: Horizon::of(STEPS),
            longest_displacement: f64::INFINITY,
            skin,
            particles,
        }
    }

    /// Makes the near lists anew.
    #[inline(never)]
    pub fn refresh(&mut self, motion: impl MotionView, inputs: &StepInputs) {
        self.horizon.restart();
        let time = f64::from(self.horizon.steps()) * inputs.time[0];
        let reach = Reach::new(inputs.bodies, self.skin, time, self.horizon.budget());
        self.pairs.find_near_pairs(motion, &reach);
        self.longest_displacement = self.measure_displacement(motion, inputs);
        self.fill_near_rim(motion, inputs, time);
        self.fill_near_features(motion, inputs, time);
    }

    /// Particles that may touch the rim: in a straight line at their velocity, or by what changes of it add.
    ///
    /// |x + k u|² ≤ |x|² + 2 k max(0, x·u) + k² u² is compared with (R − r − S)².
    fn fill_near_rim(&mut self, motion: impl MotionView, inputs: &StepInputs, time: f64) {
        self.rim.near.clear();
        let Some(rim) = inputs.drum.radius() else { return };
        let rim = F64x4::splat((rim - 0.5 * self.horizon.budget()) * ROUND_OFF);
        let (time, last) = (F64x4::splat(time), self.rim.pairs().len().saturating_sub(1));
        for first in (0..self.rim.pairs().len()).step_by(LANES) {
            let particle = |lane: usize| self.rim.pairs()[(first + lane).min(last)].0;
            let (position, velocity) = gather(motion, particle);
            let displacement = velocity.scaled(time);
            let outwards = position.dot(displacement).larger(F64x4::ZERO);
            let farthest = position.dot(position) + (outwards + outwards) + displacement.dot(displacement);
            let free = (rim - lanes(|lane| inputs.bodies.radius_of(particle(lane)))).larger(F64x4::ZERO);
            let near = !(free * free).exceeds(farthest).to_bitmask() & ALL_LANES;
            if near != 0 {
                self.rim.push_near(near, first);
            }
        }
    }

    /// Pairs with features that may touch. As seen from the drum only the particle moves.
    fn fill_near_features(&mut self, motion: impl MotionView, inputs: &StepInputs, time: f64) {
        self.features.near.clear();
        for place in 0..self.features.pairs().len() {
            if !self.features.is_apart(place) {
                continue;
            }
            let (particle, feature) = self.features.pairs()[place];
            let ([x, y], [u, v]) = (motion.position(offset(particle)), motion.velocity(offset(particle)));
            let (position, velocity) = (Vec2::new(x, y), Vec2::new(u, v));
            let relative = velocity - perpendicular(position) * inputs.angular_velocity;
            let displacement = relative.norm() * time + 0.5 * self.horizon.budget();
            let distance = inputs.drum.distance_to(feature, inputs.rotation.apply_inverse(position));
            if distance * ROUND_OFF <= inputs.bodies.radius_of(particle) + displacement {
                self.features.near.push((particle, feature), place as u32);
            }
        }
    }

    /// How far the particle that moves fastest, as seen from the drum, moves in a step [m].
    pub fn measure_displacement(&self, motion: impl MotionView, inputs: &StepInputs) -> f64 {
        let speed = F64x4::splat(inputs.angular_velocity);
        let last = self.particles.end - 1;
        let mut most = F64x4::ZERO;
        for first in self.particles.clone().step_by(LANES) {
            let (position, velocity) = gather(motion, |lane| (first + lane as u32).min(last));
            let seen = Vec2x4 { x: velocity.x + position.y * speed, y: velocity.y - position.x * speed };
            most = seen.dot(seen).larger(most);
        }
        greatest(most.to_array()).sqrt() * inputs.time[0]
    }
}

/// Positions and velocities of four particles.
#[inline(always)]
fn gather(motion: impl MotionView, particle: impl Fn(usize) -> u32) -> (Vec2x4, Vec2x4) {
    let at = |lane| offset(particle(lane));
    (vectors(|lane| motion.position(at(lane))), vectors(|lane| motion.velocity(at(lane))))
}

/// Distances are taken slightly low, which covers round-off.
pub const ROUND_OFF: f64 = 1.0 - 1e-6;
