//! The search of the cells: who is near each particle of a chunk.

use std::ops::Range;

use super::Surroundings;
use super::cells::CellGrid;
use crate::contact::candidates::Candidate;
use crate::contact::table::ChunkSlots;
use crate::lanes::{ROW, Row, WholeRow, align_stack, in_front};
use crate::patch::PATCH;
use crate::physics::drum::{Drum, RIM};
use crate::physics::particles::Particles;
use crate::physics::vector::Vec2;
use crate::threads::{CHUNK, Chunked};

/// Slots of whole chunks, for which candidates are to be found.
pub struct Search<'a> {
    pub chunks: &'a mut [ChunkSlots],
    /// The chunk that `chunks[0]` is.
    pub first: usize,
}

/// Where a search looks.
#[derive(Clone, Copy)]
pub struct Places<'a> {
    pub grid: &'a CellGrid,
    /// Positions in the drum's frame.
    pub anchors: &'a [Vec2],
    /// The margin [m].
    pub skin: f64,
    /// The radius [m] where all have the same.
    pub radius: Option<f64>,
}

impl Search<'_> {
    /// Searches for the candidates of one chunk.
    pub fn run(self, around: Surroundings, places: Places) {
        let Some(ChunkSlots { pairs, walls }) = self.chunks.first_mut() else { return };
        align_stack();
        pairs.candidates.clear();
        walls.candidates.clear();
        let (start, particles) = (self.first * CHUNK, around.particles);
        let end = particles.len().min(start + CHUNK);
        let mut found = Found::default();
        for first in (start..end).step_by(PATCH) {
            let patch = first..end.min(first + PATCH);
            pairs.candidates.begin((first / PATCH) as u32);
            walls.candidates.begin((first / PATCH) as u32);
            found.look_near(patch.clone(), particles, places);
            for (i, (ids, count)) in patch.clone().zip(found.by_particle()) {
                pairs.candidates.push_pairs(i as u32, ids, count);
            }
            for (i, &center) in patch.clone().zip(&places.anchors[patch]) {
                find_walls(around.drum, center, particles.radii[i] + places.skin, |feature| {
                    walls.candidates.push(Candidate { owner: i as u32, other: feature });
                });
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

/// The particles of higher id within reach of those of a patch, in no order.
struct Found {
    /// Eight are written at a time, those that are meant in front; the next overwrite the others. No CPU could foretell
    /// branches here.
    ids: Vec<u32>,
    count: usize,
    /// By particle: how many there are with those of the particles before.
    ends: Vec<usize>,
}

impl Default for Found {
    fn default() -> Self {
        Self { ids: vec![0; 8 * PATCH], count: 0, ends: Vec::with_capacity(PATCH) }
    }
}

impl Found {
    /// Finds those of some particles.
    fn look_near(&mut self, patch: Range<usize>, particles: &Particles, places: Places) {
        let (Places { grid, skin, .. }, Particles { positions, radii, .. }) = (places, particles);
        let same = places.radius.map(|radius| Row::splat(grid.seen_squared(radius + radius + skin)));
        self.ends.clear();
        self.count = 0;
        for i in patch {
            let (near, seen) = (grid.near(i), grid.seen(positions[i]));
            let most = near.iter().fold(self.count + ROW, |sum, [start, end]| sum + (end - start) as usize);
            if self.ids.len() < most {
                self.ids.resize(2 * most, 0);
            }
            let reach_squared = |members: WholeRow| {
                same.unwrap_or_else(|| {
                    let reach = |member: u32| radii[i] + radii[member as usize] + skin;
                    Row::new(members.to_array().map(|member| grid.seen_squared(reach(member))))
                })
            };
            for [start, end] in near {
                self.look_along(grid, start..end, (i as u32, seen), reach_squared);
            }
            self.ends.push(self.count);
        }
    }

    /// Finds those among some members of the grid.
    #[inline(always)]
    fn look_along(
        &mut self,
        grid: &CellGrid,
        mut members: Range<u32>,
        (own, (x, y)): (u32, (f32, f32)),
        reach_squared: impl Fn(WholeRow) -> Row,
    ) {
        loop {
            let (ids, x_of, y_of) = grid.eight_from(members.start);
            let (dx, dy) = (x_of - Row::splat(x), y_of - Row::splat(y));
            let is_near = (dx * dx + dy * dy).simd_lt(reach_squared(ids)).to_bitmask();
            let is_later = ids.simd_gt(WholeRow::splat(own)).to_bitmask();
            let left = members.end - members.start;
            let set = is_near & is_later & ((1 << left.min(ROW as u32)) - 1);
            self.ids[self.count..][..ROW].copy_from_slice(in_front(ids, set as usize).as_array());
            self.count += set.count_ones() as usize;
            // More than eight are so rare that CPUs foretell this.
            if left <= ROW as u32 {
                return;
            }
            members.start += ROW as u32;
        }
    }

    /// Those of each particle: they in front, and their number.
    fn by_particle(&self) -> impl Iterator<Item = (&[u32], usize)> {
        let starts = [0].into_iter().chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, &end)| (&self.ids[start..], end - start))
    }
}

/// The drum's features within `reach` of `center` (in the drum's frame), ascending.
fn find_walls(drum: &Drum, center: Vec2, reach: f64, mut found: impl FnMut(u32)) {
    if drum.radius().is_some_and(|radius| center.norm() + reach > radius) {
        found(RIM);
    }
    let mut features = Vec::new();
    drum.features_near(center, reach, &mut features);
    features.into_iter().for_each(found);
}
