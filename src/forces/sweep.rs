//! Chunks on their way through a step: their contacts evaluated, their post collected, their particles moved on.

use super::Scene;
use super::ahead::{Ahead, Needs, Place};
use super::motions::{Copies, Elsewhere, Held, Motions, Nobody, Others};
use super::post::{Outbox, PostOffice, Sink, collect};
use super::stretches::Stretches;
use super::{pairs, walls};
use crate::contact::table::ChunkSlots;
use crate::integrator::{Drift, Load, Motion};
use crate::physics::energy::{StepFlows, SurfaceLoad};
use crate::threads::{CHUNK, Chunked, in_turn};

/// What the work on a chunk writes before it reads; kept, since clearing it costs small loads a twentieth.
#[derive(Debug, Clone)]
pub struct Scratch {
    pairs: pairs::Scratch,
    /// Empty between two chunks.
    loads: Vec<Load>,
}

impl Default for Scratch {
    fn default() -> Self {
        Self { pairs: pairs::Scratch::default(), loads: vec![Load::default(); CHUNK] }
    }
}

/// The slots of whole chunks of particles, and where their loads and sums go.
#[derive(Debug)]
pub struct Chunks<'a> {
    /// The chunk that the slices start with.
    pub first: usize,
    pub slots: &'a mut [ChunkSlots],
    pub loads: &'a mut [Load],
    pub outboxes: &'a mut [Outbox],
    pub flows: &'a mut [StepFlows],
    pub surfaces: &'a mut [SurfaceLoad],
    pub surfaces_per_chunk: usize,
}

impl Chunks<'_> {
    /// Evaluates one chunk.
    pub fn evaluate(mut self, scene: Scene<impl Motions>, scratch: &mut Scratch) {
        let loads = std::mem::take(&mut self.loads);
        self.run(0, scene, loads, &mut scratch.pairs);
    }

    /// Evaluates chunk `index` of these: its pairs, then its walls, so that every particle meets its contacts in key order.
    fn run(
        &mut self,
        index: usize,
        scene: Scene<impl Motions>,
        loads: &mut [Load],
        scratch: &mut pairs::Scratch,
    ) {
        let (slots, outboxes) = (&mut self.slots[index..], &mut self.outboxes[index..]);
        let (Some((slots, later)), Some((outbox, later_outboxes))) =
            (slots.split_first_mut(), outboxes.split_first_mut())
        else {
            return;
        };
        let first = (self.first + index) * CHUNK;
        let place = Place::of(scene.matter.masses.len());
        let next = later.first().zip(later_outboxes.first()).filter(|_| place > Place::Near);
        let next = next.map(|(slots, outbox)| Needs {
            slots,
            motions: scene.motions,
            first: first + CHUNK,
            outbox,
            place,
        });
        outbox.clear();
        let mut sink = Sink { first, loads, outbox };
        let surfaces = &mut self.surfaces[index * self.surfaces_per_chunk..][..self.surfaces_per_chunk];
        surfaces.fill(SurfaceLoad::default());
        let mut ahead = Ahead::new(next);
        let mut flows = pairs::evaluate(scene, &mut slots.pairs, (&mut sink, &mut ahead), scratch);
        ahead.ask_for_rest();
        flows.add(&walls::evaluate(scene, &mut slots.walls, surfaces, &mut sink));
        self.flows[index] = flows;
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

/// A stretch of chunks that are evaluated and moved on one after the other, so that large loads pass through the cache once
/// a step: a chunk's contacts are with itself and later ones, so after its turn nobody in the stretch asks where its particles
/// were, and the stretch has no more post for it.
#[derive(Debug)]
pub struct Sweep<'a> {
    pub chunks: Chunks<'a>,
    pub drift: Drift<'a>,
    pub motions: &'a mut [Motion],
}

impl Sweep<'_> {
    /// Evaluates all; moves those on that need not wait for earlier stretches.
    pub fn run(self, scene: Scene<()>, senders: &[Vec<u32>], stretches: &Stretches, scratch: &mut Scratch) {
        if stretches.count() == 1 {
            self.go(scene, Nobody, (senders, stretches), scratch);
        } else {
            let others = Elsewhere { first: self.chunks.first * CHUNK, copies: stretches.copies() };
            self.go(scene, others, (senders, stretches), scratch);
        }
    }

    fn go(
        self,
        scene: Scene<()>,
        others: impl Others,
        (senders, stretches): (&[Vec<u32>], &Stretches),
        scratch: &mut Scratch,
    ) {
        let Self { mut chunks, drift, motions } = self;
        let first = chunks.first;
        let mut own_loads = std::mem::take(&mut chunks.loads);
        for (index, drift) in in_turn(drift).enumerate() {
            let (chunk, count) = (first + index, own_loads.len().min(CHUNK));
            let (kept, rest) = std::mem::take(&mut own_loads).split_at_mut(count);
            own_loads = rest;
            let waits = stretches.waits(chunk);
            let loads = if waits { kept } else { &mut scratch.loads[..count] };
            let scene = scene.with(Held::new(motions, others));
            chunks.run(index, scene, loads, &mut scratch.pairs);
            if !waits {
                collect(chunk, &senders[chunk], (first, chunks.outboxes), loads);
                drift.kick_and_run(&mut motions[index * CHUNK..][..count], loads);
            }
        }
    }
}

impl Chunked for Sweep<'_> {
    fn chunks(&self) -> usize {
        self.drift.chunks()
    }

    fn split(self, chunks: usize) -> (Self, Self) {
        let (drift, more_drift) = self.drift.split(chunks);
        let (motions, more_motions) = self.motions.split_at_mut(chunks * CHUNK);
        let (chunks, more_chunks) = self.chunks.split(chunks);
        (
            Self { chunks, drift, motions },
            Self { chunks: more_chunks, drift: more_drift, motions: more_motions },
        )
    }
}

/// Chunks that are moved on after all have been evaluated.
#[derive(Debug)]
pub struct Rest<'a> {
    pub drift: Drift<'a>,
    pub motions: &'a mut [Motion],
    pub loads: &'a mut [Load],
    pub copies: &'a mut [Copies],
}

impl Rest<'_> {
    /// Moves one chunk on, and copies what earlier stretches read of it.
    pub fn run(self, post: &PostOffice) {
        let chunk = self.drift.chunk();
        collect(chunk, &post.senders()[chunk], (0, post.outboxes()), self.loads);
        self.drift.kick_and_run(self.motions, self.loads);
        self.copies[0].renew(chunk * CHUNK, self.motions);
    }
}

impl Chunked for Rest<'_> {
    fn chunks(&self) -> usize {
        self.drift.chunks()
    }

    fn split(self, chunks: usize) -> (Self, Self) {
        let (drift, more_drift) = self.drift.split(chunks);
        let (motions, more_motions) = self.motions.split_at_mut(chunks * CHUNK);
        let (loads, more_loads) = self.loads.split_at_mut(chunks * CHUNK);
        let (copies, more_copies) = self.copies.split_at_mut(chunks);
        (
            Self { drift, motions, loads, copies },
            Self { drift: more_drift, motions: more_motions, loads: more_loads, copies: more_copies },
        )
    }
}
