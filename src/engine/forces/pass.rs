//! The pass over all chunks: one that is small, several in a row, or several on many threads.
//!
//! A chunk's contacts are with itself and with later chunks. Their forces go to its own particles at once and to others by
//! `reactions`; see there for the order. With one thread a chunk is moved on as soon as its own contacts and those of
//! earlier chunks are evaluated, while it is in the cache: nothing asks for its positions any more.

use std::fmt::Debug;

use super::accumulate::ChunkSums;
use super::chunk::{ChunkContacts, ChunkScratch};
use super::reactions::RemoteReactions;
use super::totals::{FoldedTotals, Totals};
use super::{Bodies, StepInputs};
use crate::engine::contacts::{ContactRecord, NOT_LISTED};
use crate::engine::motion::verlet::{DriftSums, Verlet, WHOLE};
use crate::engine::motion::{
    Arrays, CHUNK_FLAT, ChunkForces, FlatArrays, MotionArrays, MotionView, with_arrays,
};
use crate::engine::pair_list::{ChunkNeighbors, NearLimits, PairList};
use crate::engine::parallel::{CHUNK, Chunked, Threads, chunk_count};
use crate::physics::columns::Columns;
use crate::physics::contact::Stored;
use crate::physics::contact::law::ContactLaw;
use crate::physics::contact::model::{ForLaw, Model};
use crate::physics::energy::SurfaceLoad;

/// Contacts of pairs, and of particles with the drum, each in the order of their lists.
#[derive(Debug, Clone, PartialEq, Default, serde::Serialize, serde::Deserialize)]
pub struct Lists {
    /// Of particles with each other.
    pub pairs: Vec<ContactRecord>,
    /// Of particles with the drum.
    pub walls: Vec<ContactRecord>,
}

impl Lists {
    /// Numbers of contacts: between particles, with the drum.
    pub fn counts(&self) -> (usize, usize) {
        (self.pairs.len(), self.walls.len())
    }
}

/// The pass over contacts, whatever their law.
pub trait ForcePass: Debug + Send + Sync {
    /// Evaluates every contact. The forces must be zero before.
    fn evaluate(&mut self, list: &mut PairList, arrays: &mut Arrays, inputs: &StepInputs, threads: &Threads);

    /// Evaluates every contact and moves the particles on: the second half of this step's kick, the first of the next one's,
    /// and the drift. `sums` tells what each chunk did.
    fn evaluate_and_advance(
        &mut self,
        list: &mut PairList,
        arrays: &mut Arrays,
        inputs: &StepInputs,
        verlet: &Verlet,
        sums: &mut [DriftSums],
        threads: &Threads,
    );

    /// Links the contacts to a list of neighbors that has been built anew.
    fn link(&mut self, list: &mut PairList);

    /// What each surface of the drum did to the load in the last pass.
    fn surfaces(&self) -> &[SurfaceLoad];

    /// Greatest overlap over the smaller radius since the totals were last folded.
    fn deepest(&self) -> f64;

    /// The sums for the ledger, which begin anew.
    fn fold(&mut self) -> FoldedTotals;

    /// These sums by chunk, as they are.
    fn totals(&self) -> Vec<Totals>;

    /// Replaces them.
    fn set_totals(&mut self, totals: &[Totals]);

    /// Energy that the contacts hold [J/m].
    fn stored(&self) -> Stored<f64>;

    /// Numbers of contacts: between particles, with the drum.
    fn counts(&self) -> (usize, usize);

    /// All contacts.
    fn contacts(&self) -> Lists;

    /// Adds contacts as they are.
    fn insert(&mut self, contacts: &Lists, bodies: &Bodies);

    /// Takes all contacts out.
    fn drain(&mut self) -> Lists;
}

/// A pass for these particles, with the law that they need.
pub fn new_pass(model: Model, surfaces: usize, bodies: &Bodies) -> Box<dyn ForcePass> {
    model.make(NewPass { surfaces, bodies })
}

struct NewPass<'a> {
    surfaces: usize,
    bodies: &'a Bodies<'a>,
}

impl ForLaw for NewPass<'_> {
    type Made = Box<dyn ForcePass>;

    fn make<L: ContactLaw>(self) -> Self::Made {
        Box::new(Pass::<L>::new(self.surfaces, self.bodies))
    }
}

/// What the pass has of one chunk.
#[derive(Debug, Clone)]
struct Chunk<L: ContactLaw> {
    contacts: ChunkContacts<L>,
    remote: RemoteReactions,
    surfaces: Vec<SurfaceLoad>,
    scratch: ChunkScratch,
}

#[derive(Debug, Clone)]
struct Pass<L: ContactLaw> {
    count: usize,
    chunks: Vec<Chunk<L>>,
    /// By chunk: the chunks that may have reactions for it; ascending.
    senders: Vec<Vec<u32>>,
    surfaces: Vec<SurfaceLoad>,
}

impl<L: ContactLaw> Pass<L> {
    fn new(surfaces: usize, bodies: &Bodies) -> Self {
        let count = bodies.radii.len();
        let are_equal = bodies.are_equal();
        let chunk = |index| Chunk {
            contacts: ChunkContacts::new(index, count, bodies, are_equal),
            remote: RemoteReactions::default(),
            surfaces: vec![SurfaceLoad::default(); surfaces],
            scratch: ChunkScratch::default(),
        };
        let chunks = (0..chunk_count(count)).map(chunk).collect();
        let senders = vec![Vec::new(); chunk_count(count)];
        Self { count, chunks, senders, surfaces: vec![SurfaceLoad::default(); surfaces] }
    }

    /// Adds what the chunks did to the load, in their order.
    fn add_up(&mut self) {
        let Some((first, others)) = self.chunks.split_first() else { return };
        self.surfaces.copy_from_slice(&first.surfaces);
        for chunk in others {
            for (surface, part) in self.surfaces.iter_mut().zip(&chunk.surfaces) {
                surface.force += part.force;
                surface.moment += part.moment;
            }
        }
    }

    /// Evaluates and moves on chunk after chunk.
    fn sweep<const N: usize, const M: usize, const H: usize>(
        &mut self,
        list: &mut PairList,
        arrays: &mut FlatArrays<N, M, H>,
        inputs: &StepInputs,
        verlet: &Verlet,
        sums: &mut [DriftSums],
    ) {
        let limits = list.limits();
        for (index, sums) in sums.iter_mut().enumerate() {
            let (motion, forces) = arrays.lend();
            let own = (&mut forces.force[index], &mut forces.torque[index]);
            self.chunks[index].evaluate(&mut list.chunks[index], limits, motion, inputs, own);
            let first = index * CHUNK;
            let mut own = arrays.part(first..self.count.min(first + CHUNK));
            self.gather(index, &mut own);
            *sums = verlet.advance::<WHOLE>(first, own);
        }
    }

    /// Adds the reactions on a chunk's particles, in the order of the chunks that sent them.
    fn gather(&self, index: usize, own: &mut MotionArrays) {
        for &sender in &self.senders[index] {
            self.chunks[sender as usize].remote.gather(index, own);
        }
    }

    /// Evaluates the contacts of all chunks, on several threads where that pays; reactions are still to be gathered.
    fn evaluate_chunks<const N: usize, const M: usize, const H: usize>(
        &mut self,
        list: &mut PairList,
        arrays: &mut FlatArrays<N, M, H>,
        inputs: &StepInputs,
        threads: &Threads,
    ) {
        let limits = list.limits();
        let (motion, ChunkForces { force, torque }) = arrays.lend();
        let work = Evaluation { chunks: &mut self.chunks, neighbors: &mut list.chunks, force, torque };
        threads.for_each_chunk(self.count, work, &|work: Evaluation<L>| {
            if let ([chunk], [neighbors], [force, ..], [torque, ..]) =
                (work.chunks, work.neighbors, work.force, work.torque)
            {
                chunk.evaluate(neighbors, limits, motion, inputs, (force, torque));
            }
        });
    }

    /// Brings reactions to their particles; then moves them on, if there is a `verlet`.
    fn complete<const N: usize, const M: usize, const H: usize>(
        &self,
        arrays: &mut FlatArrays<N, M, H>,
        verlet: Option<&Verlet>,
        sums: &mut [DriftSums],
        threads: &Threads,
    ) {
        let work = Completion { first: 0, arrays: arrays.part(0..self.count), sums };
        threads.for_each_chunk(self.count, work, &|mut work: Completion| {
            self.gather(work.first / CHUNK, &mut work.arrays);
            if let (Some(verlet), [sums]) = (verlet, work.sums) {
                *sums = verlet.advance::<WHOLE>(work.first, work.arrays);
            }
        });
    }
}

impl<L: ContactLaw> Chunk<L> {
    /// Evaluates the chunk's contacts, of whose particles these are the forces and torques.
    fn evaluate(
        &mut self,
        neighbors: &mut ChunkNeighbors,
        limits: NearLimits,
        motion: impl MotionView,
        inputs: &StepInputs,
        (force, torque): (&mut [f64; CHUNK_FLAT], &mut [f64; CHUNK]),
    ) {
        let Self { contacts, remote, surfaces, scratch } = self;
        remote.clear();
        surfaces.fill(SurfaceLoad::default());
        let chunk = neighbors.particles.start / CHUNK as u32;
        if remote.targets().is_empty() {
            let mut sums = ChunkSums::<true> { chunk, force, torque, remote };
            contacts.evaluate(neighbors, limits, motion, inputs, &mut sums, surfaces, scratch);
        } else {
            let mut sums = ChunkSums::<false> { chunk, force, torque, remote };
            contacts.evaluate(neighbors, limits, motion, inputs, &mut sums, surfaces, scratch);
        }
    }
}

/// Chunks whose contacts are to be evaluated.
struct Evaluation<'a, L: ContactLaw> {
    chunks: &'a mut [Chunk<L>],
    neighbors: &'a mut [ChunkNeighbors],
    force: &'a mut [[f64; CHUNK_FLAT]],
    torque: &'a mut [[f64; CHUNK]],
}

impl<L: ContactLaw> Chunked for Evaluation<'_, L> {
    fn chunks(&self) -> usize {
        self.chunks.len()
    }

    fn split(self, chunks: usize) -> (Self, Self) {
        let (own, more) = self.chunks.split_at_mut(chunks);
        let (neighbors, more_neighbors) = self.neighbors.split_at_mut(chunks);
        let (force, more_force) = self.force.split_at_mut(chunks);
        let (torque, more_torque) = self.torque.split_at_mut(chunks);
        (
            Self { chunks: own, neighbors, force, torque },
            Self { chunks: more, neighbors: more_neighbors, force: more_force, torque: more_torque },
        )
    }
}

/// Chunks that gather their reactions, and move on if `sums` are there.
struct Completion<'a> {
    first: usize,
    arrays: MotionArrays<'a>,
    sums: &'a mut [DriftSums],
}

impl Chunked for Completion<'_> {
    fn chunks(&self) -> usize {
        chunk_count(self.arrays.position.len())
    }

    fn split(self, chunks: usize) -> (Self, Self) {
        let (arrays, more_arrays) = self.arrays.split_at(chunks * CHUNK);
        let (sums, more_sums) = self.sums.split_at_mut(chunks.min(self.sums.len()));
        let first = self.first + chunks * CHUNK;
        (Self { first: self.first, arrays, sums }, Self { first, arrays: more_arrays, sums: more_sums })
    }
}

impl<L: ContactLaw> ForcePass for Pass<L> {
    fn evaluate(&mut self, list: &mut PairList, arrays: &mut Arrays, inputs: &StepInputs, threads: &Threads) {
        with_arrays!(arrays, arrays => {
            self.evaluate_chunks(list, arrays, inputs, threads);
            self.complete(arrays, None, &mut [], threads);
        });
        self.add_up();
    }

    fn evaluate_and_advance(
        &mut self,
        list: &mut PairList,
        arrays: &mut Arrays,
        inputs: &StepInputs,
        verlet: &Verlet,
        sums: &mut [DriftSums],
        threads: &Threads,
    ) {
        with_arrays!(arrays, arrays => {
            if threads.serve(self.count) {
                self.evaluate_chunks(list, arrays, inputs, threads);
                self.complete(arrays, Some(verlet), sums, threads);
            } else {
                self.sweep(list, arrays, inputs, verlet, sums);
            }
        });
        self.add_up();
    }

    fn link(&mut self, list: &mut PairList) {
        self.senders.iter_mut().for_each(Vec::clear);
        for (index, (chunk, neighbors)) in self.chunks.iter_mut().zip(&mut list.chunks).enumerate() {
            chunk.contacts.link(neighbors);
            // Contacts may be with particles that are no neighbors any more.
            let others = (0..chunk.contacts.pairs.len()).map(|contact| chunk.contacts.pairs.key(contact).1);
            let watched = neighbors.watched.iter().map(|&other| other * CHUNK as u32);
            chunk.remote.prepare(index, watched.chain(others));
            for &target in chunk.remote.targets() {
                self.senders[target as usize].push(index as u32);
            }
        }
    }

    fn surfaces(&self) -> &[SurfaceLoad] {
        &self.surfaces
    }

    fn deepest(&self) -> f64 {
        self.chunks.iter().fold(0.0, |most, chunk| most.max(chunk.contacts.totals.deepest()))
    }

    fn fold(&mut self) -> FoldedTotals {
        let folded = self.chunks.iter_mut().map(|chunk| chunk.contacts.totals.fold());
        folded.fold(FoldedTotals::default(), FoldedTotals::plus)
    }

    fn totals(&self) -> Vec<Totals> {
        self.chunks.iter().map(|chunk| chunk.contacts.totals).collect()
    }

    fn set_totals(&mut self, totals: &[Totals]) {
        for (chunk, &totals) in self.chunks.iter_mut().zip(totals) {
            chunk.contacts.totals = totals;
        }
    }

    fn stored(&self) -> Stored<f64> {
        let mut sum = Stored::build(|_| 0.0);
        for list in self.chunks.iter().flat_map(|chunk| chunk.contacts.lists()) {
            for (index, record) in list.records().enumerate() {
                let (law, _) = list.parameters(index);
                let stored = L::stored(&law, record.overlap, &record.history_of::<L>());
                sum = Stored::build(|k| Stored::field(&sum, k) + Stored::field(&stored, k));
            }
        }
        sum
    }

    fn counts(&self) -> (usize, usize) {
        self.chunks.iter().fold((0, 0), |(pairs, walls), Chunk { contacts, .. }| {
            (pairs + contacts.pairs.len(), walls + contacts.rim.len() + contacts.outlines.len())
        })
    }

    fn contacts(&self) -> Lists {
        let chunks = || self.chunks.iter().map(|chunk| &chunk.contacts);
        Lists {
            pairs: chunks().flat_map(|contacts| contacts.pairs.records()).collect(),
            walls: chunks()
                .flat_map(|contacts| contacts.rim.records().chain(contacts.outlines.records()))
                .collect(),
        }
    }

    fn insert(&mut self, contacts: &Lists, bodies: &Bodies) {
        for record in &contacts.pairs {
            let chunk = &mut self.chunks[record.particle as usize / CHUNK];
            chunk.contacts.insert_pair(record, NOT_LISTED, bodies);
        }
        for record in &contacts.walls {
            let chunk = &mut self.chunks[record.particle as usize / CHUNK];
            chunk.contacts.insert_wall(record, NOT_LISTED, bodies);
        }
    }

    fn drain(&mut self) -> Lists {
        let lists = self.contacts();
        for chunk in &mut self.chunks {
            chunk.contacts.clear();
        }
        lists
    }
}
