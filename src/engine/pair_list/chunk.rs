//! What the particles of one chunk may touch: neighbors, and which of them are near.

use std::ops::Range;

use super::horizon::{Horizon, STEPS};
use super::near::{NearList, Reach};
use super::neighbors::{Neighbors, Status};
use crate::engine::contacts::{ListKind, NOT_LISTED};
use crate::engine::forces::StepInputs;
use crate::engine::motion::{MotionView, far, inside, offset};
use crate::engine::parallel::CHUNK;
use crate::engine::simd::{ALL_LANES, F64x4, LANES, Vec2x4, greatest, lanes, rows};
use crate::physics::drum::RIM;
use crate::physics::scalar::Scalar;
use crate::physics::vector::Vec2;

/// The neighbors of one chunk's particles.
#[derive(Debug, Clone)]
pub struct ChunkNeighbors {
    /// The chunk's particles.
    pub particles: Range<u32>,
    /// Pairs with later particles.
    pub pairs: Neighbors,
    /// Pairs with edges and vertices of outlines.
    pub features: Neighbors,
    /// By particle, whether it is a contact of the rim.
    pub at_rim: Vec<Status>,
    /// The pairs that are near.
    pub near_pairs: NearList,
    /// The particles near the rim.
    pub near_rim: NearList,
    /// The pairs with features that are near.
    pub near_features: NearList,
    /// The chunks of the particles of the pairs; ascending.
    pub watched: Vec<u32>,
    /// For how long the near lists hold.
    pub horizon: Horizon,
    /// No particle of the chunk moves farther in a step, as seen from the drum [m].
    pub longest_way: f64,
}

/// What the near lists are made from, apart from the step's inputs.
#[derive(Debug, Clone, Copy)]
pub struct NearLimits {
    /// 1 / (distance + reach) for the farthest and largest pair of the list of neighbors, and slightly less [1/m].
    pub inverse_sum: f64,
}

impl ChunkNeighbors {
    /// For chunk `index` of `count` particles.
    pub fn new(index: usize, count: usize) -> Self {
        let first = (index * CHUNK) as u32;
        let particles = first..(count.min((index + 1) * CHUNK)) as u32;
        Self {
            pairs: Neighbors::default(),
            features: Neighbors::default(),
            at_rim: vec![Status::Apart; particles.len()],
            near_pairs: NearList::new(ListKind::Pairs, (first, far(count))),
            near_rim: NearList::new(ListKind::Walls, (inside(count), RIM)),
            near_features: NearList::new(ListKind::Walls, (far(count), RIM)),
            watched: Vec::new(),
            horizon: Horizon::of(STEPS),
            longest_way: f64::INFINITY,
            particles,
        }
    }

    /// Makes the near lists anew.
    #[inline(never)]
    pub fn refresh(&mut self, motion: impl MotionView, inputs: &StepInputs, limits: NearLimits) {
        self.horizon.restart();
        let time = f64::from(self.horizon.steps()) * inputs.time.step;
        let reach = Reach {
            radius: inputs.bodies.radius,
            radii: inputs.bodies.radii,
            inverse_sum: F64x4::splat(limits.inverse_sum),
            time: F64x4::splat(time),
            budget: F64x4::splat(self.horizon.budget()),
        };
        self.near_pairs.fill_with_pairs(&self.pairs, motion, &reach);
        self.look_at_particles(motion, inputs, time);
        self.fill_near_features(motion, inputs, time);
    }

    /// Measures how far particles move in a step as seen from the drum, and finds those that may touch the rim: in a straight
    /// line at their velocity, or by what changes of it add.
    ///
    /// |x + k u|² ≤ |x|² + 2 k max(0, x·u) + k² u² is compared with (R − r − S)².
    fn look_at_particles(&mut self, motion: impl MotionView, inputs: &StepInputs, time: f64) {
        self.near_rim.clear();
        let (time, speed) = (F64x4::splat(time), F64x4::splat(inputs.angular_velocity));
        let rim = inputs.drum.radius().map(|rim| (rim - 0.5 * self.horizon.budget()) * ROUND_OFF);
        let free_of = |radius: F64x4| (F64x4::splat(rim.unwrap_or(f64::MAX)) - radius).larger(F64x4::ZERO);
        let same = inputs.bodies.radius.map(|radius| free_of(F64x4::splat(radius)));
        let (start, last) = (self.particles.start, self.particles.end - 1);
        let mut most = F64x4::ZERO;
        for first in (start..=last).step_by(LANES) {
            let particle = |lane: usize| (first + lane as u32).min(last);
            let (position, velocity) = gather(motion, particle);
            most = squared_rate(position, velocity, speed).larger(most);
            let way = velocity.scaled(time);
            let outwards = position.dot(way).larger(F64x4::ZERO);
            let farthest = position.dot(position) + (outwards + outwards) + way.dot(way);
            let free = same.unwrap_or_else(|| free_of(lanes(|lane| inputs.bodies.radius_of(particle(lane)))));
            let inside = (free * free).exceeds(farthest).to_bitmask();
            if rim.is_none() || inside == ALL_LANES {
                continue;
            }
            for lane in (0..LANES).filter(|lane| inside >> lane & 1 == 0) {
                let particle = first + lane as u32;
                let own = (particle - start) as usize;
                if self.at_rim.get(own) == Some(&Status::Apart) {
                    self.near_rim.push((particle, RIM), own as u32);
                }
            }
        }
        self.longest_way = greatest(most.to_array()).sqrt() * inputs.time.step;
    }

    /// Pairs with features that may touch. As seen from the drum only the particle moves.
    fn fill_near_features(&mut self, motion: impl MotionView, inputs: &StepInputs, time: f64) {
        self.near_features.clear();
        for (place, &(particle, feature)) in self.features.pairs().iter().enumerate() {
            if self.features.status()[place] != Status::Apart {
                continue;
            }
            let ([x, y], [u, v]) = (motion.position(offset(particle)), motion.velocity(offset(particle)));
            let (position, velocity) = (Vec2::new(x, y), Vec2::new(u, v));
            let seen = velocity - crate::physics::vector::perpendicular(position) * inputs.angular_velocity;
            let way = seen.norm() * time + 0.5 * self.horizon.budget();
            let distance = inputs.drum.distance_to(feature, inputs.rotation.apply_inverse(position));
            if distance * ROUND_OFF <= inputs.bodies.radius_of(particle) + way {
                self.near_features.push((particle, feature), place as u32);
            }
        }
    }

    /// How far the particle that moves fastest, as seen from the drum, moves in a step [m].
    pub fn measure_way(&self, motion: impl MotionView, inputs: &StepInputs) -> f64 {
        let speed = F64x4::splat(inputs.angular_velocity);
        let last = self.particles.end - 1;
        let mut most = F64x4::ZERO;
        for first in self.particles.clone().step_by(LANES) {
            let (position, velocity) = gather(motion, |lane| (first + lane as u32).min(last));
            most = squared_rate(position, velocity, speed).larger(most);
        }
        greatest(most.to_array()).sqrt() * inputs.time.step
    }

    /// Takes note that a pair of particles has parted: it may touch again at once.
    pub fn release_pair(&mut self, key: (u32, u32), place: u32) {
        if place != NOT_LISTED {
            self.pairs.set(place, Status::Apart);
            self.near_pairs.push(key, place);
        }
    }

    /// Takes note that a particle has left the rim.
    pub fn release_rim(&mut self, particle: u32) {
        let own = particle - self.particles.start;
        self.at_rim[own as usize] = Status::Apart;
        self.near_rim.push((particle, RIM), own);
    }

    /// Takes note that a particle has left a feature.
    pub fn release_feature(&mut self, key: (u32, u32), place: u32) {
        if place != NOT_LISTED {
            self.features.set(place, Status::Apart);
            self.near_features.push(key, place);
        }
    }
}

/// Positions and velocities of four particles.
#[inline(always)]
fn gather(motion: impl MotionView, particle: impl Fn(usize) -> u32) -> (Vec2x4, Vec2x4) {
    let position = rows(|lane| motion.position(offset(particle(lane))));
    let velocity = rows(|lane| motion.velocity(offset(particle(lane))));
    (Vec2x4::from_rows(position), Vec2x4::from_rows(velocity))
}

/// Squares of velocities as seen from a drum that turns at some speed.
#[inline(always)]
fn squared_rate(position: Vec2x4, velocity: Vec2x4, speed: F64x4) -> F64x4 {
    let seen = Vec2x4 { x: velocity.x + position.y * speed, y: velocity.y - position.x * speed };
    seen.dot(seen)
}

/// Distances are taken slightly low, which covers round-off.
pub const ROUND_OFF: f64 = 1.0 - 1e-6;
