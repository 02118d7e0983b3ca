//! The pass over contacts: who touches now, geometry, law, history; then each particle's sum of forces in a fixed order.
//!
//! Each contact writes only its own history. Its load goes to the particles of its own chunk at once and to others by
//! post; see `post` for the order.

mod bodies;
mod pairs;
mod post;
mod walls;

use crate::contact::laws::Laws;
use crate::contact::table::{ChunkSlots, ContactTable};
use crate::drum::Drum;
use crate::energy::{StepFlows, SurfaceLoad};
use crate::integrator::{Load, Motion};
use crate::lanes::{LANES, Lanes, lanes};
use crate::particles::Particles;
use crate::threads::{CHUNK, Chunked, Threads, chunk_count};
use crate::vector::Rotation;
use post::{Outbox, PostOffice, Sink};

/// All that a contact needs beyond its own history.
#[derive(Debug, Clone, Copy)]
pub struct Scene<'a> {
    /// What each particle did in this step.
    pub motions: &'a [Motion],
    /// What they are: materials and masses.
    pub particles: &'a Particles,
    /// The laws.
    pub laws: &'a Laws,
    /// Rim and outlines.
    pub drum: &'a Drum,
    /// The drum's rotation at the end of the step.
    pub rotation: Rotation,
    /// Its angular velocity [rad/s].
    pub angular_velocity: f64,
    /// The angle it turned during the step [rad].
    pub turn: f64,
    /// The square of the longest way of the step as seen from the drum [m²], by patch.
    pub ways: &'a [f64],
    /// How much farther anyone can have come by the drum's turn [m].
    pub arc: f64,
    /// Half of 1 / (distance + reach), for the largest distance and reach in the list and slightly less [1/m].
    pub half_gap: f64,
    /// 1 / time step [1/s].
    pub step_rate: f64,
}

/// Scratch and results of the pass.
#[derive(Debug, Clone)]
pub struct ForcePass {
    /// Force and moment on each particle; empty before a pass.
    pub loads: Vec<Load>,
    /// Load on the particles by each of the drum's surfaces.
    pub surfaces: Vec<SurfaceLoad>,
    /// Work of the step.
    pub flows: StepFlows,
    chunk_flows: Vec<StepFlows>,
    chunk_surfaces: Vec<SurfaceLoad>,
    post: PostOffice,
}

impl ForcePass {
    /// For `count` particles and a drum of `surfaces` surfaces.
    pub fn new(count: usize, surfaces: usize) -> Self {
        let chunks = chunk_count(count);
        Self {
            loads: vec![Load::default(); count],
            surfaces: vec![SurfaceLoad::default(); surfaces],
            flows: StepFlows::default(),
            chunk_flows: vec![StepFlows::default(); chunks],
            chunk_surfaces: vec![SurfaceLoad::default(); chunks * surfaces],
            post: PostOffice::new(chunks),
        }
    }

    /// Takes note of new candidates: which chunk may have post for which.
    pub fn prepare(&mut self, table: &ContactTable, threads: &Threads) {
        self.post.prepare(table, self.loads.len(), threads);
    }

    /// Evaluates every contact; the loads must be empty.
    pub fn evaluate(&mut self, scene: Scene, table: &mut ContactTable, threads: &Threads) {
        let count = self.loads.len();
        let work = Chunks {
            first: 0,
            slots: &mut table.chunks,
            loads: &mut self.loads,
            outboxes: self.post.outboxes_mut(),
            flows: &mut self.chunk_flows,
            surfaces: &mut self.chunk_surfaces,
            surfaces_per_chunk: self.surfaces.len(),
        };
        threads.for_each_chunk(count, work, &|chunk: Chunks| chunk.run(scene));
        if self.chunk_flows.len() > 1 {
            self.post.deliver(&mut self.loads, threads);
        }
        self.add_up();
    }

    /// Adds the chunks in their order.
    fn add_up(&mut self) {
        self.flows = StepFlows::default();
        self.surfaces.fill(SurfaceLoad::default());
        for flows in &self.chunk_flows {
            self.flows.add(flows);
        }
        for chunk in self.chunk_surfaces.chunks_exact(self.surfaces.len()) {
            for (surface, part) in self.surfaces.iter_mut().zip(chunk) {
                surface.force += part.force;
                surface.moment += part.moment;
            }
        }
    }
}

/// Reads what the contacts of a chunk are about to read in their own order, in the order in which it lies in memory:
/// where that has left the cache, many reads are then under way at once.
#[inline(always)]
fn fetch(motions: &[Motion], loads: &[Load]) {
    let places = motions.iter().take(CHUNK).fold(Lanes::ZERO, |seen, motion| seen | motion.place);
    // Two loads to a cache line.
    let loads = loads.iter().take(CHUNK).step_by(2).fold(Lanes::ZERO, |seen, load| seen | load.0);
    std::hint::black_box(places | loads);
}

/// All ones in the first `count` lanes.
#[inline(always)]
fn in_use(count: usize) -> Lanes {
    if count >= LANES {
        return bodies::all_ones();
    }
    let ones = f64::from_bits(u64::MAX);
    lanes(|lane| if lane < count { ones } else { 0.0 })
}

/// The slots of whole chunks of particles, and where their loads and sums go.
#[derive(Debug)]
struct Chunks<'a> {
    /// The chunk that the slices start with.
    first: usize,
    slots: &'a mut [ChunkSlots],
    loads: &'a mut [Load],
    outboxes: &'a mut [Outbox],
    flows: &'a mut [StepFlows],
    surfaces: &'a mut [SurfaceLoad],
    surfaces_per_chunk: usize,
}

impl Chunks<'_> {
    /// Evaluates one chunk: its pairs, then its walls, so that every particle meets its contacts in key order.
    fn run(self, scene: Scene) {
        let (Some(slots), Some(outbox)) = (self.slots.first_mut(), self.outboxes.first_mut()) else { return };
        outbox.clear();
        fetch(&scene.motions[self.first * CHUNK..], self.loads);
        let mut sink = Sink { first: self.first * CHUNK, loads: self.loads, outbox };
        self.surfaces.fill(SurfaceLoad::default());
        let mut flows = pairs::evaluate(scene, &mut slots.pairs, &mut sink);
        flows.add(&walls::evaluate(scene, &mut slots.walls, self.surfaces, &mut sink));
        self.flows[0] = flows;
    }
}

impl Chunked for Chunks<'_> {
    fn chunks(&self) -> usize {
        self.slots.len()
    }

    fn split(self, chunks: usize) -> (Self, Self) {
        let (slots, more_slots) = self.slots.split_at_mut(chunks);
        let (loads, more_loads) = self.loads.split_at_mut(chunks * CHUNK);
        let (outboxes, more_outboxes) = self.outboxes.split_at_mut(chunks);
        let (flows, more_flows) = self.flows.split_at_mut(chunks);
        let surfaces_per_chunk = self.surfaces_per_chunk;
        let (surfaces, more_surfaces) = self.surfaces.split_at_mut(chunks * surfaces_per_chunk);
        (
            Self { first: self.first, slots, loads, outboxes, flows, surfaces, surfaces_per_chunk },
            Self {
                first: self.first + chunks,
                slots: more_slots,
                loads: more_loads,
                outboxes: more_outboxes,
                flows: more_flows,
                surfaces: more_surfaces,
                surfaces_per_chunk,
            },
        )
    }
}
