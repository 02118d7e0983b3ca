//! The pass over contacts: who touches now, geometry, law, history; then each particle's sum of forces in a fixed order.
//!
//! Each contact writes only its own history. Its load goes to the particles of its own chunk at once and to others by
//! post; see `post` for the order.

mod ahead;
mod bodies;
mod motions;
mod pairs;
mod post;
mod stretches;
mod sweep;
mod walls;

use crate::contact::block::Traits;
use crate::contact::laws::Laws;
use crate::contact::table::ContactTable;
use crate::integrator::{Drift, Load, Motion};
use crate::patch::PatchMotion;
use crate::physics::drum::Drum;
use crate::physics::energy::{StepFlows, SurfaceLoad};
use crate::physics::vector::Rotation;
use crate::threads::{Threads, chunk_count, in_turn};
use motions::{Held, Nobody};
use post::{Delivery, PostOffice};
pub use stretches::LARGE;
use stretches::Stretches;
use sweep::{Chunks, Rest, Scratch, Sweep};

/// All that a contact needs beyond its own history.
#[derive(Debug, Clone, Copy)]
pub struct Scene<'a, M> {
    /// What each particle did in this step.
    pub motions: M,
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
    /// The time that the step took [s], none at the start.
    pub time_step: f64,
}

impl<'a, M> Scene<'a, M> {
    /// The same with other motions.
    pub fn with<N>(self, motions: N) -> Scene<'a, N> {
        let Self { matter, laws, drum, rotation, angular_velocity, turn, .. } = self;
        let Self { patches, arc, round_off, inverse_reach, step_rate, time_step, .. } = self;
        Scene {
            motions,
            matter,
            laws,
            drum,
            rotation,
            angular_velocity,
            turn,
            patches,
            arc,
            round_off,
            inverse_reach,
            step_rate,
            time_step,
        }
    }
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
    /// What contacts between them follow from, where all are equal.
    pub pair: Option<Traits>,
}

impl Matter<'_> {
    /// The radius of one particle [m].
    #[inline(always)]
    pub fn radius_of(&self, particle: u32) -> f64 {
        self.radius.unwrap_or_else(|| self.radii[particle as usize])
    }

    /// What a contact between two particles follows from.
    #[inline(always)]
    fn pair(&self, laws: &Laws, one: u32, other: u32) -> Traits {
        self.pair.unwrap_or_else(|| {
            let body = |id: u32| (self.materials[id as usize], self.masses[id as usize]);
            let radii = [self.radii[one as usize], self.radii[other as usize]];
            Traits { law: laws.pair_slot(body(one), body(other)), radii }
        })
    }
}

/// Scratch and results of the pass.
#[derive(Debug, Clone)]
pub struct ForcePass {
    /// Force and moment on each particle; empty before a pass, and after one that moves the particles on.
    pub loads: Vec<Load>,
    /// Load on the particles by each of the drum's surfaces.
    pub surfaces: Vec<SurfaceLoad>,
    /// Work of the step.
    pub flows: StepFlows,
    chunk_flows: Vec<StepFlows>,
    chunk_surfaces: Vec<SurfaceLoad>,
    post: PostOffice,
    stretches: Stretches,
    /// One for each stretch.
    scratches: Vec<Scratch>,
}

impl ForcePass {
    /// For `count` particles and a drum of `surfaces` surfaces.
    pub fn new(count: usize, surfaces: usize) -> Self {
        let chunks = chunk_count(count);
        Self {
            loads: vec![Load::default(); count],
            surfaces: vec![SurfaceLoad::default(); surfaces],
            // Before the first pass nobody knows how deep overlaps are.
            flows: StepFlows { overlap_ratio: f64::INFINITY, ..StepFlows::default() },
            chunk_flows: vec![StepFlows::default(); chunks],
            chunk_surfaces: vec![SurfaceLoad::default(); chunks * surfaces],
            post: PostOffice::new(chunks),
            stretches: Stretches::default(),
            scratches: Vec::new(),
        }
    }

    /// Takes note of new candidates: which chunk may have post for which, and how threads best share the chunks.
    pub fn prepare(&mut self, table: &ContactTable, threads: &Threads) {
        let count = self.loads.len();
        self.post.prepare(table, count, threads);
        let members = if threads.serve(count) { threads.count() } else { 1 };
        self.stretches.divide(table, &self.post, (count, members));
        self.scratches.resize_with(self.stretches.count(), Scratch::default);
    }

    /// Evaluates every contact; the loads must be empty.
    pub fn evaluate(
        &mut self,
        scene: Scene<()>,
        motions: &[Motion],
        table: &mut ContactTable,
        threads: &Threads,
    ) {
        self.evaluate_contacts(scene, motions, table, threads);
        let work = Delivery { first: 0, loads: &mut self.loads };
        threads.for_each_chunk(work.loads.len(), work, &|delivery: Delivery| delivery.run(&self.post));
        self.stretches.forget_copies();
        self.add_up();
    }

    /// Evaluates every contact and moves the particles on, which ends this step's kick and begins the next step; the loads
    /// must be empty. The scene's motions are `motions`.
    pub fn evaluate_and_move(
        &mut self,
        scene: Scene<()>,
        table: &mut ContactTable,
        (mut drift, motions): (Drift, &mut [Motion]),
        threads: &Threads,
    ) {
        let count = self.loads.len();
        if self.stretches.are_swept() {
            self.stretches.renew_copies(motions);
            let (chunks, stretches, scratches, senders) = self.parts_mut(table);
            let work = Sweep { chunks, drift: drift.lend(), motions };
            stretches.share(work, scratches, threads, &|sweep: Sweep, scratch: &mut Scratch| {
                sweep.run(scene, senders, stretches, scratch);
            });
        } else {
            self.evaluate_contacts(scene, motions, table, threads);
        }
        let (stretches, copies) = self.stretches.parts_mut();
        let work = Rest { drift, motions, loads: &mut self.loads, copies };
        threads.for_each(count, stretches.waiting(work), &|rest: Rest| rest.run(&self.post));
        self.add_up();
    }

    fn evaluate_contacts(
        &mut self,
        scene: Scene<()>,
        motions: &[Motion],
        table: &mut ContactTable,
        threads: &Threads,
    ) {
        let scene = scene.with(Held::new(motions, Nobody));
        let (chunks, stretches, scratches, _) = self.parts_mut(table);
        stretches.share(chunks, scratches, threads, &|chunks: Chunks, scratch: &mut Scratch| {
            in_turn(chunks).for_each(|chunk| chunk.evaluate(scene, scratch));
        });
    }

    /// All chunks, how they are divided, a scratch for each stretch; and by chunk who has post for it.
    fn parts_mut<'a>(
        &'a mut self,
        table: &'a mut ContactTable,
    ) -> (Chunks<'a>, &'a Stretches, &'a mut [Scratch], &'a [Vec<u32>]) {
        let (outboxes, senders) = self.post.parts_mut();
        let chunks = Chunks {
            first: 0,
            slots: &mut table.chunks,
            loads: &mut self.loads,
            outboxes,
            flows: &mut self.chunk_flows,
            surfaces: &mut self.chunk_surfaces,
            surfaces_per_chunk: self.surfaces.len(),
        };
        (chunks, &self.stretches, &mut self.scratches, senders)
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
