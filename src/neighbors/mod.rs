//! The Verlet list: which bodies may touch before anyone has moved half the margin (the skin) as seen from the drum.
//!
//! Distances do not change under rotation, so displacements in the drum's frame serve particle–particle and
//! particle–drum neighborhoods alike. When the list is rebuilt never changes a result.

mod cells;
mod search;

use cells::CellGrid;
use search::{Places, Search};

use crate::contact::table::ContactTable;
use crate::physics::drum::Drum;
use crate::physics::particles::Particles;
use crate::physics::vector::{Rotation, Vec2};
use crate::threads::Threads;

/// Decides when to rebuild, and rebuilds.
#[derive(Debug, Clone)]
pub struct VerletList {
    skin: f64,
    /// Positions at the last build, in the drum's frame.
    anchors: Vec<Vec2>,
    /// Greatest distance from the axis at the last build [m].
    farthest: f64,
    /// How far anyone may still move before the displacements have to be looked at [m].
    budget: f64,
    grid: CellGrid,
}

/// The parts of a simulation that a list is made from.
#[derive(Debug, Clone, Copy)]
pub struct Surroundings<'a> {
    /// The bundles.
    pub particles: &'a Particles,
    /// Rim and outlines.
    pub drum: &'a Drum,
    /// The drum's rotation.
    pub rotation: Rotation,
}

impl VerletList {
    /// A list with the margin `skin` [m] that asks to be built at once.
    pub fn new(skin: f64) -> Self {
        Self { skin, anchors: Vec::new(), farthest: 0.0, budget: -1.0, grid: CellGrid::default() }
    }

    /// Takes note of a step in which nobody moved farther than `longest_way` as seen from the drum, to first order in
    /// the drum's `turn`. Returns whether displacements have to be looked at.
    pub fn advance(&mut self, longest_way: f64, turn: f64) -> bool {
        self.budget -= longest_way + self.arc(turn);
        // A way that is not a number asks, too.
        self.budget <= 0.0 || self.budget.is_nan()
    }

    /// A distance from the axis that nobody goes beyond while the list holds [m].
    pub fn farthest(&self) -> f64 {
        self.farthest + self.skin
    }

    /// How far at most a way departs from its measure along the tangent while the drum turns by `turn` [rad]:
    /// |x| turn² / 2 [m].
    pub fn arc(&self, turn: f64) -> f64 {
        0.5 * turn * turn * self.farthest()
    }

    /// 1 / (distance + reach) for particles of at most `largest_radius` that the list holds, taken slightly low to cover
    /// round-off [1/m].
    ///
    /// Within the list, a distance is at most the reach and the skin at the build, and one skin more since.
    pub fn inverse_reach(&self, largest_radius: f64) -> f64 {
        ROUND_OFF_MARGIN / (4.0 * largest_radius + 2.0 * self.skin)
    }

    /// More than round-off of positions changes a displacement by from one step to the next [m].
    pub fn round_off(&self) -> f64 {
        8.0 * f64::EPSILON * self.farthest()
    }

    /// Whether the list still holds for sure: nobody has moved half the skin, or close to it. `position` tells where a
    /// particle is.
    pub fn still_holds(
        &mut self,
        position: &(impl Fn(usize) -> Vec2 + Sync),
        rotation: Rotation,
        threads: &Threads,
    ) -> bool {
        if self.anchors.is_empty() {
            return false;
        }
        let half = 0.5 * self.skin;
        let moved = |i: usize| [(rotation.apply_inverse(position(i)) - self.anchors[i]).norm_squared()];
        let [most] = threads.greatest(self.anchors.len(), &moved);
        self.budget = half * ROUND_OFF_MARGIN - most.sqrt();
        // A list about to expire is not worth another look at every particle soon after.
        self.budget > 0.1 * half
    }

    /// Asks to be built anew at the next step, as the particles are in other places.
    pub fn forget(&mut self) {
        self.anchors.clear();
        self.budget = -1.0;
    }

    /// Builds the list anew; `table` keeps every contact that has a history.
    pub fn rebuild(&mut self, around: Surroundings, table: &mut ContactTable, threads: &Threads) {
        let Particles { positions, radii, .. } = around.particles;
        if positions.is_empty() {
            return;
        }
        let extremes = |i: usize| {
            let (position, radius) = (positions[i], radii[i]);
            [position.norm_squared(), -position.x, -position.y, position.x, position.y, -radius, radius]
        };
        let [farthest, left, low, right, high, least, largest] = threads.greatest(positions.len(), &extremes);
        self.farthest = farthest.sqrt();
        self.budget = 0.5 * self.skin * ROUND_OFF_MARGIN;
        self.anchors.resize(positions.len(), Vec2::zeros());
        threads.set_each(&mut self.anchors, &|i| around.rotation.apply_inverse(positions[i]));
        let bounds = (Vec2::new(-left, -low), Vec2::new(right, high));
        self.grid.fill(positions, bounds, 2.0 * largest + self.skin, threads);
        let search = Search { chunks: &mut table.chunks, first: 0 };
        let radius = (largest == -least).then_some(largest);
        let places = Places { grid: &self.grid, anchors: &self.anchors, skin: self.skin, radius };
        threads.for_each_chunk(positions.len(), search, &|chunk: Search| chunk.run(around, places));
    }
}

/// Displacements are compared with slightly less than half the skin, which covers the round-off of the rotation.
const ROUND_OFF_MARGIN: f64 = 1.0 - 1e-6;
