//! The Verlet list: which bodies may touch before anyone has moved half the margin (the skin) as seen from the drum.
//!
//! Distances do not change under rotation, so displacements in the drum's frame serve particle–particle and
//! particle–drum neighborhoods alike. When the list is rebuilt never changes a result.

mod cells;

use cells::CellGrid;

use crate::contact::table::{Candidate, ChunkSlots, ContactTable};
use crate::drum::{Drum, RIM};
use crate::lanes::{FOUR_IN_FRONT, LANES, Lanes, WholeFour, align_stack, lanes};
use crate::particles::Particles;
use crate::patch::PATCH;
use crate::threads::{CHUNK, Chunked, Threads};
use crate::vector::{Rotation, Vec2};

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

    /// Whether the list still holds for sure: nobody has moved half the skin, or close to it.
    pub fn still_holds(&mut self, positions: &[Vec2], rotation: Rotation) -> bool {
        let half = 0.5 * self.skin;
        let moved = positions.iter().zip(&self.anchors).fold(0.0_f64, |most, (&position, &anchor)| {
            most.max((rotation.apply_inverse(position) - anchor).norm_squared())
        });
        self.budget = half * ROUND_OFF_MARGIN - moved.sqrt();
        // A list about to expire is not worth another look at every particle soon after.
        self.anchors.len() == positions.len() && self.budget > 0.1 * half
    }

    /// Asks to be built anew at the next step, as the particles are in other places.
    pub fn forget(&mut self) {
        self.anchors.clear();
        self.budget = -1.0;
    }

    /// Builds the list anew; `table` keeps every contact that has a history.
    pub fn rebuild(&mut self, around: Surroundings, table: &mut ContactTable, threads: &Threads) {
        let particles = around.particles;
        self.anchors.clear();
        self.anchors
            .extend(particles.positions.iter().map(|&position| around.rotation.apply_inverse(position)));
        self.farthest = particles.positions.iter().fold(0.0_f64, |most, p| most.max(p.norm()));
        self.budget = 0.5 * self.skin * ROUND_OFF_MARGIN;
        self.grid.fill(&particles.positions, 2.0 * particles.largest_radius() + self.skin);
        let search = Search { chunks: &mut table.chunks, first: 0 };
        let (grid, anchors) = (&self.grid, &self.anchors);
        let same =
            particles.radii.first().copied().filter(|&first| particles.radii.iter().all(|&r| r == first));
        let margin = (self.skin, same);
        threads.for_each_chunk(particles.len(), search, &|chunk: Search| {
            chunk.run(around, grid, anchors, margin);
        });
    }
}

/// Displacements are compared with slightly less than half the skin, which covers the round-off of the rotation.
const ROUND_OFF_MARGIN: f64 = 1.0 - 1e-6;

struct Search<'a> {
    chunks: &'a mut [ChunkSlots],
    /// The chunk that `chunks[0]` is.
    first: usize,
}

impl Search<'_> {
    fn run(self, around: Surroundings, grid: &CellGrid, anchors: &[Vec2], (skin, same): (f64, Option<f64>)) {
        let Some(ChunkSlots { pairs, walls }) = self.chunks.first_mut() else { return };
        align_stack();
        pairs.candidates.clear();
        walls.candidates.clear();
        let (mut found, mut room) = (Vec::new(), Vec::new());
        let start = self.first * CHUNK;
        for (i, &center) in anchors.iter().enumerate().skip(start).take(CHUNK) {
            if i.is_multiple_of(PATCH) {
                let patch = (i / PATCH) as u32;
                pairs.candidates.begin(patch);
                walls.candidates.begin(patch);
            }
            let others = find_pairs(i as u32, around.particles, grid, (skin, same), &mut room);
            pairs.candidates.push_pairs(i as u32, others);
            find_walls(around.drum, center, around.particles.radii[i] + skin, &mut found);
            for feature in found.drain(..) {
                walls.candidates.push(Candidate { owner: i as u32, other: feature });
            }
        }
        pairs.candidates.end();
        walls.candidates.end();
        pairs.link();
        walls.link();
    }
}

impl Chunked for Search<'_> {
    fn chunks(&self) -> usize {
        self.chunks.len()
    }

    fn split(self, chunks: usize) -> (Self, Self) {
        let (left, right) = self.chunks.split_at_mut(chunks);
        (Self { chunks: left, first: self.first }, Self { chunks: right, first: self.first + chunks })
    }
}

/// The particles of higher id within reach of particle `i`, ascending. `same` is the radius where all have one, `room` what
/// they may be written to.
fn find_pairs<'a>(
    i: u32,
    particles: &Particles,
    grid: &CellGrid,
    (skin, same): (f64, Option<f64>),
    room: &'a mut Vec<u32>,
) -> &'a [u32] {
    let position = particles.positions[i as usize];
    let (x, y, own) = (Lanes::splat(position.x), Lanes::splat(position.y), WholeFour::splat(i));
    let own_reach = particles.radii[i as usize] + skin;
    let same_reach = same.map(|radius| Lanes::splat((own_reach + radius) * (own_reach + radius)));
    let mut count = 0;
    grid.for_each_near(i as usize, |row| {
        if room.len() < count + LANES * row.members.len() {
            room.resize(2 * (count + LANES * row.members.len()), 0);
        }
        let (mut left, mut places) = (row.count, WholeFour::splat(row.first as u32));
        for (members, (&x_of, &y_of)) in row.members.iter().zip(row.x.iter().zip(row.y)) {
            let reach_squared = same_reach.unwrap_or_else(|| {
                let reach = lanes(|lane| own_reach + particles.radii[members[lane] as usize]);
                reach * reach
            });
            let (dx, dy) = (Lanes::new(x_of) - x, Lanes::new(y_of) - y);
            let is_near = (dx * dx + dy * dy).simd_lt(reach_squared).to_bitmask();
            let is_later = WholeFour::new(*members).simd_gt(own).to_bitmask();
            let set = is_near & is_later & ((1 << left.min(LANES)) - 1);
            // All four are written, those that are meant in front; the next overwrite the others. No CPU could foretell a
            // branch here.
            room[count..][..LANES]
                .copy_from_slice((places + WholeFour::new(FOUR_IN_FRONT[set as usize])).as_array());
            count += set.count_ones() as usize;
            left -= left.min(LANES);
            places += WholeFour::splat(LANES as u32);
        }
    });
    let found = &mut room[..count];
    for place in &mut *found {
        *place = grid.members()[*place as usize];
    }
    found.sort_unstable();
    found
}

/// The drum's features within `reach` of `center` (in the drum's frame), ascending.
fn find_walls(drum: &Drum, center: Vec2, reach: f64, found: &mut Vec<u32>) {
    if drum.radius().is_some_and(|radius| center.norm() + reach > radius) {
        found.push(RIM);
    }
    drum.features_near(center, reach, found);
}
