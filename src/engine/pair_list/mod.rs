//! The Verlet list: which bodies may touch before any particle has moved half the margin (the skin) as seen from the drum,
//! and of these the near ones.
//!
//! Distances do not change under rotation, so displacements in the drum's frame serve pairs of particles and particles at
//! the drum alike. When a list is made anew never changes a result.

mod cells;
mod chunk;
mod horizon;
mod levels;
mod near;
mod neighbors;
mod search;

pub use chunk::ChunkNeighbors;
use horizon::Horizon;
use levels::Levels;
pub use near::{NearBlock, Opened};
pub use neighbors::Neighbors;
use search::Search;

use crate::engine::forces::StepInputs;
use crate::engine::motion::MotionView;
use crate::engine::motion::verlet::DriftSums;
use crate::engine::parallel::{Threads, chunk_count};
use crate::physics::vector::{Rotation, Vec2};
use chunk::ROUND_OFF;

/// The neighbors of all particles, and until when they are known.
#[derive(Debug, Clone)]
pub struct PairList {
    /// By chunk.
    pub chunks: Vec<ChunkNeighbors>,
    skin: f64,
    /// Positions when the list was built, in the drum's frame.
    anchors: Vec<Vec2>,
    /// Greatest distance from the axis at that time [m].
    farthest: f64,
    /// How far any particle may still move before the displacements have to be looked at [m].
    slack: f64,
    /// The angle by which the drum turned in the last step [rad].
    last_turn: f64,
    levels: Levels,
}

impl PairList {
    /// A list for `count` particles with the margin `skin` [m] that asks to be built at once.
    pub fn new(count: usize, skin: f64, largest_radius: f64) -> Self {
        let chunk = |index| ChunkNeighbors::new(index, count, skin);
        Self {
            chunks: (0..chunk_count(count)).map(chunk).collect(),
            skin,
            anchors: Vec::new(),
            farthest: 0.0,
            slack: -1.0,
            last_turn: 0.0,
            levels: Levels::new(largest_radius),
        }
    }

    /// Takes note of a drift, of which `sums` tells what each chunk's particles did, while the drum turned by `turn` [rad].
    /// Returns a displacement that no particle has exceeded as seen from the drum [m].
    pub fn advance(&mut self, sums: &[DriftSums], turn: f64) -> f64 {
        let farthest = self.farthest + self.skin;
        // More than round-off of positions changes a displacement by from one step to the next.
        let round_off = 8.0 * f64::EPSILON * farthest;
        let last_turn = std::mem::replace(&mut self.last_turn, turn);
        let mut longest: f64 = 0.0;
        for (chunk, sums_of_chunk) in self.chunks.iter_mut().zip(sums) {
            let most = chunk.watched.iter().map(|&other| sums[other as usize].change);
            // As seen from the drum a displacement also changes as it is turned, and with the drum's speed.
            let turned = turn.abs() * (chunk.longest_displacement + last_turn.abs() * farthest)
                + (turn - last_turn).abs() * farthest;
            let change = most.fold(sums_of_chunk.change, f64::max) + round_off;
            chunk.horizon.advance(change + turned);
            let displacement = chunk.longest_displacement + sums_of_chunk.change + round_off + turned;
            // A displacement that is not known must not be lost in a comparison: ∞ times a turn of 0 is not a number.
            chunk.longest_displacement = if displacement.is_nan() { f64::INFINITY } else { displacement };
            longest = longest.max(chunk.longest_displacement);
        }
        // A displacement is measured along the tangent; the rest of the arc is |x| turn² / 2.
        self.slack -= longest + 0.5 * turn * turn * farthest;
        longest
    }

    /// Whether the list may no longer hold.
    pub fn is_due(&self) -> bool {
        // What is not a number is due, too.
        self.slack.is_nan() || self.slack <= 0.0
    }

    /// Whether the list still holds for sure: no particle has moved half the skin, or close to it.
    pub fn still_holds(&mut self, positions: &[Vec2], rotation: Rotation, threads: &Threads) -> bool {
        if self.anchors.is_empty() {
            return false;
        }
        let half = 0.5 * self.skin;
        let moved = |i: usize| [(rotation.apply_inverse(positions[i]) - self.anchors[i]).norm_squared()];
        let [most] = threads.greatest(self.anchors.len(), moved);
        self.slack = half * ROUND_OFF - most.sqrt();
        // A list about to expire is not worth another look at every particle soon after.
        self.slack > 0.1 * half
    }

    /// Measures how far particles move in a step as seen from the drum; returns the longest displacement [m].
    pub fn measure_displacements(&mut self, motion: impl MotionView, inputs: &StepInputs) -> f64 {
        for chunk in &mut self.chunks {
            chunk.longest_displacement = chunk.measure_displacement(motion, inputs);
        }
        self.chunks.iter().fold(0.0, |most, chunk| most.max(chunk.longest_displacement))
    }

    /// Asks to be built anew at the next step, as the particles are in other places.
    pub fn invalidate(&mut self) {
        self.anchors.clear();
        self.slack = -1.0;
    }

    /// Ends the near lists, as the particles' displacements are others than they were.
    pub fn end_near_lists(&mut self) {
        for chunk in &mut self.chunks {
            chunk.horizon.end();
            chunk.longest_displacement = f64::INFINITY;
        }
    }

    /// Makes near lists for so many steps from now on.
    pub fn set_near_steps(&mut self, steps: u32) {
        for chunk in &mut self.chunks {
            chunk.horizon = Horizon::of(steps);
        }
    }

    /// Builds the list anew. Contacts have to be linked to it afterwards.
    pub fn rebuild(&mut self, positions: &[Vec2], inputs: &StepInputs, threads: &Threads) {
        if positions.is_empty() {
            return;
        }
        let extremes = |i: usize| {
            let position = positions[i];
            [position.norm_squared(), -position.x, -position.y, position.x, position.y]
        };
        let [farthest, left, low, right, high] = threads.greatest(positions.len(), extremes);
        self.farthest = farthest.sqrt();
        self.slack = 0.5 * self.skin * ROUND_OFF;
        self.anchors.resize(positions.len(), Vec2::zeros());
        threads.set_each(&mut self.anchors, |i| inputs.rotation.apply_inverse(positions[i]));
        let bounds = (Vec2::new(-left, -low), Vec2::new(right, high));
        self.levels.fill(positions, &inputs.bodies, bounds, self.skin, threads);
        let Self { chunks, levels, anchors, skin, .. } = self;
        let search = Search { levels, anchors, positions, skin: *skin };
        threads.for_each(positions.len(), chunks.iter_mut(), |chunk| search.run(chunk, inputs));
    }
}
