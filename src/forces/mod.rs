//! The pass over contact slots: geometry, law, history; then each particle's sum of forces in key order.
//!
//! Each slot writes only its own history, which holds the force. A serial pass adds it to both particles at once: slots
//! come in key order, so every particle receives its contacts in key order. A parallel pass leaves that to a gather
//! that reads the same histories in the same order; the bits are the same.

mod batch;
mod bodies;
mod gather;
mod pairs;
mod slots;
mod walls;

use crate::contact::laws::Laws;
use crate::contact::table::ContactTable;
use crate::drum::Drum;
use crate::energy::{StepFlows, SurfaceLoad};
use crate::integrator::{Load, Motion};
use crate::threads::{Chunked, Threads, chunk_count};
use crate::vector::{Rotation, Vec2};
use gather::{Gather, Incidence};
use slots::SlotSlice;

/// All that a contact needs beyond its own slot.
#[derive(Debug, Clone, Copy)]
pub struct Scene<'a> {
    /// What each particle did in this step.
    pub motions: &'a [Motion],
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
    /// How far anyone can have moved since the list was built, as seen from the drum [m].
    pub way: f64,
    /// Half of 1 / (distance + reach), for the largest distance and reach in the list and slightly less [1/m].
    pub half_gap: f64,
    /// 1 / time step [1/s].
    pub step_rate: f64,
}

/// Scratch and results of the pass.
#[derive(Debug, Clone)]
pub struct ForcePass {
    /// Force and moment on each particle.
    pub loads: Vec<Load>,
    /// Load on the particles by each of the drum's surfaces.
    pub surfaces: Vec<SurfaceLoad>,
    /// Work of the step.
    pub flows: StepFlows,
    chunk_flows: Vec<StepFlows>,
    chunk_surfaces: Vec<SurfaceLoad>,
    incidence: Incidence,
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
            incidence: Incidence::default(),
        }
    }

    /// Takes note of new slots; only a parallel pass needs to know them by their higher particle.
    pub fn prepare(&mut self, table: &ContactTable, threads: &Threads) {
        if threads.serve(self.loads.len()) {
            self.incidence.index(&table.pairs);
        }
    }

    /// Evaluates every slot.
    pub fn evaluate(&mut self, scene: Scene, table: &mut ContactTable, threads: &Threads) {
        let count = self.loads.len();
        let work = Chunks {
            pairs: (&mut table.pairs).into(),
            walls: (&mut table.walls).into(),
            flows: &mut self.chunk_flows,
            surfaces: &mut self.chunk_surfaces,
            surfaces_per_chunk: self.surfaces.len(),
        };
        if threads.serve(count) {
            threads.for_each_chunk(count, work, &|chunk: Chunks| chunk.run(scene, &mut Leave));
            let gather = Gather::of(&mut self.loads);
            let (table, incidence) = (&*table, &self.incidence);
            threads
                .for_each_chunk(count, gather, &|chunk: Gather| chunk.run(scene.motions, table, incidence));
        } else {
            self.loads.fill(Load::default());
            let mut scatter = Scatter { loads: &mut self.loads };
            let mut rest = work;
            while rest.chunks() > 1 {
                let (chunk, others) = rest.split(1);
                chunk.run(scene, &mut scatter);
                rest = others;
            }
            rest.run(scene, &mut scatter);
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

/// Where a contact's force goes right away.
trait Sink {
    fn add(&mut self, particle: usize, force: Vec2, moment: f64);
}

/// Nowhere: a gather will read it from the history.
struct Leave;

impl Sink for Leave {
    #[inline]
    fn add(&mut self, _: usize, _: Vec2, _: f64) {}
}

/// To the particles' loads.
struct Scatter<'a> {
    loads: &'a mut [Load],
}

impl Sink for Scatter<'_> {
    #[inline]
    fn add(&mut self, particle: usize, force: Vec2, moment: f64) {
        let load = &mut self.loads[particle];
        load.force += force;
        load.moment += moment;
    }
}

/// The slots of whole chunks of particles, and where their sums go.
#[derive(Debug)]
struct Chunks<'a> {
    pairs: SlotSlice<'a>,
    walls: SlotSlice<'a>,
    flows: &'a mut [StepFlows],
    surfaces: &'a mut [SurfaceLoad],
    surfaces_per_chunk: usize,
}

impl Chunks<'_> {
    /// Evaluates one chunk: its pairs, then its walls, so that every particle meets its contacts in key order.
    fn run(self, scene: Scene, sink: &mut impl Sink) {
        let Some(flows) = self.flows.first_mut() else { return };
        *flows = pairs::evaluate(scene, self.pairs, sink);
        self.surfaces.fill(SurfaceLoad::default());
        flows.add(&walls::evaluate(scene, self.walls, self.surfaces, sink));
    }
}

impl Chunked for Chunks<'_> {
    fn chunks(&self) -> usize {
        self.flows.len()
    }

    fn split(self, chunks: usize) -> (Self, Self) {
        let (pairs, more_pairs) = self.pairs.split(chunks);
        let (walls, more_walls) = self.walls.split(chunks);
        let (flows, more_flows) = self.flows.split_at_mut(chunks);
        let surfaces_per_chunk = self.surfaces_per_chunk;
        let (surfaces, more_surfaces) = self.surfaces.split_at_mut(chunks * surfaces_per_chunk);
        (
            Self { pairs, walls, flows, surfaces, surfaces_per_chunk },
            Self {
                pairs: more_pairs,
                walls: more_walls,
                flows: more_flows,
                surfaces: more_surfaces,
                surfaces_per_chunk,
            },
        )
    }
}
