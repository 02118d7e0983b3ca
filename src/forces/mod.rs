//! The pass over contacts: who touches now, geometry, law, history; then each particle's sum of forces in a fixed order.
//!
//! Each contact writes only its own history. Its load goes to the particles of its own chunk at once and to others by
//! post; see `post` for the order.

mod ahead;
mod bodies;
mod pairs;
mod post;
mod walls;

use crate::contact::laws::Laws;
use crate::contact::table::{ChunkSlots, ContactTable};
use crate::drum::Drum;
use crate::energy::{StepFlows, SurfaceLoad};
use crate::integrator::{Complete, Drift, Load, Motion, Told};
use crate::patch::PatchMotion;
use crate::threads::{CHUNK, Chunked, Threads, chunk_count, in_turn, with_later};
use crate::vector::Rotation;
use ahead::{Ahead, Needs};
use pairs::Scratch;
use post::{Delivery, Outbox, PostOffice, Sink};

/// All that a contact needs beyond its own history.
#[derive(Debug, Clone, Copy)]
pub struct Scene<'a> {
    /// What each particle did in this step.
    pub motions: &'a [Motion],
    /// What they are.
    pub matter: Matter<'a>,
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
    /// The most that anyone did in the step, by patch.
    pub patches: &'a [PatchMotion],
    /// How much farther anyone can have come by the drum's turn [m].
    pub arc: f64,
    /// More than round-off changes a displacement by from one step to the next [m].
    pub round_off: f64,
    /// 1 / (distance + reach), for the largest distance and reach in the list and slightly less [1/m].
    pub inverse_reach: f64,
    /// 1 / time step [1/s].
    pub step_rate: f64,
}

/// What particles are made of.
#[derive(Debug, Clone, Copy)]
pub struct Matter<'a> {
    /// Indices of their materials.
    pub materials: &'a [u16],
    /// Masses [kg/m].
    pub masses: &'a [f64],
    /// Radii [m].
    pub radii: &'a [f64],
    /// The radius [m] where all have the same.
    pub radius: Option<f64>,
}

/// Scratch and results of the pass.
#[derive(Debug, Clone)]
pub struct ForcePass {
    /// Force and moment on each particle; empty before a pass, and after one that moves the particles on.
    pub loads: Vec<Load>,
    /// Loads of a single chunk, empty between two chunks.
    chunk_loads: Vec<Load>,
    scratch: Box<Scratch>,
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
            chunk_loads: vec![Load::default(); CHUNK],
            scratch: Box::default(),
            surfaces: vec![SurfaceLoad::default(); surfaces],
            // Before the first pass nobody knows how deep overlaps are.
            flows: StepFlows { overlap_ratio: f64::INFINITY, ..StepFlows::default() },
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
        self.evaluate_all(scene, table, threads);
        let post = &self.post;
        let work = Delivery { first: 0, loads: &mut self.loads };
        threads
            .for_each_chunk(work.loads.len(), work, &|work: Delivery| post.collect(work.first, work.loads));
        self.add_up();
    }

    /// Evaluates every contact and moves the particles on, which ends this step's kick and begins the next step; the loads
    /// must be empty. `scene` is told by `told`.
    pub fn evaluate_and_move(
        &mut self,
        scene: Scene,
        table: &mut ContactTable,
        (drift, told): (Drift, Told),
        threads: &Threads,
    ) {
        if threads.serve(self.loads.len()) {
            let (motions, patches) = told.read();
            self.evaluate_all(Scene { motions, patches, ..scene }, table, threads);
            let post = &self.post;
            let work = Complete { drift, told, source: &mut self.loads[..] };
            let is_large = scene.matter.masses.len() >= LARGE;
            threads.for_each_run(scene.matter.masses.len(), work, &|run: Complete<&mut [Load]>| {
                with_later(run, |chunk, later| {
                    post.collect(chunk.drift.chunk(), chunk.source);
                    chunk.drift.kick_and_run(chunk.told, chunk.source, |part, parts| {
                        if let Some(later) = later.filter(|_| is_large) {
                            later.ask_for(part, parts);
                        }
                    });
                });
            });
        } else {
            self.sweep(scene, table, (drift, told));
        }
        self.add_up();
    }

    fn evaluate_all(&mut self, scene: Scene, table: &mut ContactTable, threads: &Threads) {
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
        threads.for_each_run(count, work, &|chunks: Chunks| chunks.run_all(scene));
    }

    /// Evaluates and moves on chunk by chunk, so that large loads pass through the cache once a step: a chunk's contacts
    /// are with itself and later ones, so after its turn nobody asks where its particles were, and its post is complete.
    fn sweep(&mut self, scene: Scene, table: &mut ContactTable, (drift, mut told): (Drift, Told)) {
        let surfaces_per_chunk = self.surfaces.len();
        let is_large = self.loads.len() >= LARGE;
        let mut later = &mut table.chunks[..];
        for drift in in_turn(drift) {
            let Some((slots, rest)) = std::mem::take(&mut later).split_first_mut() else { break };
            later = rest;
            let chunk = drift.chunk();
            let loads = &mut self.chunk_loads[..CHUNK.min(self.loads.len() - chunk * CHUNK)];
            let (motions, patches) = told.read();
            let (outboxes, later_outboxes) = self.post.outboxes_mut()[chunk..].split_at_mut(1);
            let next =
                later.first().zip(later_outboxes.first()).filter(|_| is_large).map(|(slots, outbox)| Needs {
                    slots,
                    motions,
                    first: (chunk + 1) * CHUNK,
                    abroad: outbox.abroad(),
                    loads: &[],
                    drift: Some(&drift),
                });
            let work = Chunks {
                first: chunk,
                slots: std::slice::from_mut(slots),
                loads,
                outboxes,
                flows: &mut self.chunk_flows[chunk..=chunk],
                surfaces: &mut self.chunk_surfaces[chunk * surfaces_per_chunk..][..surfaces_per_chunk],
                surfaces_per_chunk,
            };
            work.run(Scene { motions, patches, ..scene }, Ahead::new(next), &mut self.scratch);
            self.post.collect(chunk, loads);
            drift.kick_and_run(told.chunk(chunk), loads, |_, _| {});
        }
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

/// Particles from which on a load does not stay in the cache, so that asking ahead pays.
const LARGE: usize = 32_768;

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
    /// Evaluates all.
    fn run_all(self, scene: Scene) {
        let is_large = scene.motions.len() >= LARGE;
        let mut scratch = Scratch::default();
        with_later(self, |chunk, later| {
            let next = later.filter(|_| is_large).and_then(|later| {
                Some(Needs {
                    slots: later.slots.first()?,
                    motions: scene.motions,
                    first: later.first * CHUNK,
                    abroad: later.outboxes.first()?.abroad(),
                    loads: later.loads,
                    drift: None,
                })
            });
            chunk.run(scene, Ahead::new(next), &mut scratch);
        });
    }

    /// Evaluates one chunk: its pairs, then its walls, so that every particle meets its contacts in key order.
    fn run(self, scene: Scene, mut ahead: Ahead, scratch: &mut Scratch) {
        let (Some(slots), Some(outbox)) = (self.slots.first_mut(), self.outboxes.first_mut()) else { return };
        outbox.clear();
        let mut sink = Sink { first: self.first * CHUNK, loads: self.loads, outbox };
        self.surfaces.fill(SurfaceLoad::default());
        let mut flows = pairs::evaluate(scene, &mut slots.pairs, (&mut sink, &mut ahead), scratch);
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
