//! The pass over all chunks: one that is small, several in a row, or several on many threads.
//!
//! A chunk's contacts are with itself and with later chunks. Their forces go to its own particles at once and to others by
//! `reactions`; see there for the order. With one thread a chunk is moved on as soon as its own contacts and those of
//! earlier chunks are evaluated, while it is in the cache: nothing asks for its positions any more.

use std::fmt::Debug;

use super::chunk::Chunk;
use super::totals::Totals;
use super::{Bodies, StepInputs};
use crate::engine::contacts::{ContactEvent, ContactRecord, ContactTally, ListKind};
use crate::engine::motion::verlet::{DriftSums, Verlet, WHOLE};
use crate::engine::motion::{Arrays, MotionArrays, with_arrays};
use crate::engine::pair_list::PairList;
use crate::engine::parallel::{CHUNK, Threads, chunk_count};
use crate::engine::simd::LANES;
use crate::physics::columns::Columns;
use crate::physics::contact::law::ContactLaw;
use crate::physics::contact::model::{Model, with_law};
use crate::physics::contact::{ContactState, Stored};
use crate::physics::drum::RIM;
use crate::physics::energy::SurfaceLoad;
use crate::physics::vector::Vec2;

/// Contacts of pairs, and of particles with the drum, each in the order of their lists.
#[derive(Debug, Clone, PartialEq, Default, serde::Serialize, serde::Deserialize)]
pub struct Lists {
    /// Of particles with each other.
    pub pairs: Vec<ContactRecord>,
    /// Of particles with the drum.
    pub walls: Vec<ContactRecord>,
    /// What those of particles with each other have done; empty where that is not recorded.
    pub pair_tallies: Vec<ContactTally>,
    /// What those with the drum have done, likewise.
    pub wall_tallies: Vec<ContactTally>,
}

impl Lists {
    /// Numbers of contacts: between particles, with the drum.
    pub fn counts(&self) -> (usize, usize) {
        (self.pairs.len(), self.walls.len())
    }

    /// The deepest contact: its overlap over the smaller radius, its bodies, and whether both are particles.
    pub fn deepest(&self, radii: &[f64]) -> Option<(f64, (u32, u32), bool)> {
        let radius = |particle: u32| radii[particle as usize];
        let pairs = self.pairs.iter().map(|c| (c, radius(c.particle).min(radius(c.other)), true));
        let all = pairs.chain(self.walls.iter().map(|c| (c, radius(c.particle), false)));
        let ratios = all.map(|(c, radius, is_pair)| (c.overlap / radius, c.key(), is_pair));
        ratios.max_by(|a, b| a.0.total_cmp(&b.0))
    }
}

/// The pass over contacts, whatever their law.
pub trait ForcePass: Debug + Send + Sync {
    /// Evaluates every contact; the forces must be zero before. With an integrator the particles are moved on: the second half of
    /// this step's kick, the first of the next one's, and the drift, of which `sums` tells what each chunk did.
    fn evaluate(
        &mut self,
        list: &mut PairList,
        arrays: &mut Arrays,
        inputs: &StepInputs,
        integrator: Option<&Verlet>,
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
    fn fold(&mut self) -> Totals<f64>;

    /// These sums by chunk, as they are.
    fn totals(&self) -> Vec<Totals>;

    /// Replaces them.
    fn set_totals(&mut self, totals: &[Totals]);

    /// Energy that the contacts hold [J/m].
    fn stored(&self) -> Stored<f64>;

    /// Numbers of contacts: between particles, with the drum.
    fn counts(&self) -> (usize, usize);

    /// Tells of every contact the particles that it is of, each by its place in memory.
    fn visit_bodies(&self, visit: &mut dyn FnMut(usize));

    /// Tells of every contact its bodies, whether it is with the drum, and the force on body j [N/m].
    fn visit_forces(&self, visit: &mut dyn FnMut((u32, u32), bool, Vec2));

    /// All contacts.
    fn contacts(&self) -> Lists;

    /// Adds contacts as they are.
    fn insert(&mut self, contacts: &Lists, bodies: &Bodies);

    /// Takes all contacts out.
    fn drain(&mut self) -> Lists;

    /// How many events of contacts have not been taken.
    fn event_count(&self) -> usize;

    /// Those events, chunk by chunk.
    fn events(&self) -> Vec<ContactEvent>;

    /// Replaces them.
    fn set_events(&mut self, events: Vec<ContactEvent>);
}

/// A pass for these particles, with the law that they need; what each contact does is recorded or not.
pub fn new_pass(model: Model, surfaces: usize, bodies: &Bodies, is_tallied: bool) -> Box<dyn ForcePass> {
    with_law!(model, L => Box::new(Pass::<L>::new(surfaces, bodies, is_tallied)))
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
    fn new(surfaces: usize, bodies: &Bodies, is_tallied: bool) -> Self {
        let count = bodies.radii.len();
        let are_equal = bodies.are_equal();
        let chunk = |index| Chunk::new(index, count, surfaces, bodies, are_equal, is_tallied);
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

    /// Adds the reactions on a chunk's particles, in the order of the chunks that sent them.
    fn gather(&self, own: &mut MotionArrays) {
        let chunk = own.first / CHUNK;
        for &sender in &self.senders[chunk] {
            self.chunks[sender as usize].remote.gather(chunk, own);
        }
    }
}

impl<L: ContactLaw> ForcePass for Pass<L> {
    fn evaluate(
        &mut self,
        list: &mut PairList,
        arrays: &mut Arrays,
        inputs: &StepInputs,
        integrator: Option<&Verlet>,
        sums: &mut [DriftSums],
        threads: &Threads,
    ) {
        let advance = |own: MotionArrays, sums: &mut DriftSums| {
            if let Some(verlet) = integrator {
                *sums = verlet.advance::<WHOLE>(own);
            }
        };
        with_arrays!(arrays, arrays => if threads.serve(self.count) {
            let (motion, forces) = arrays.lend();
            // The arrays are longer than the load.
            let own = forces.force.iter_mut().zip(forces.torque);
            let chunks = self.chunks.iter_mut().zip(&mut list.chunks).zip(own);
            threads.for_each(self.count, chunks, |((chunk, neighbors), own)| {
                chunk.evaluate(neighbors, motion, inputs, own);
            });
            let chunks = arrays.part(0..self.count).chunks().zip(sums);
            threads.for_each(self.count, chunks, |(mut own, sums)| {
                self.gather(&mut own);
                advance(own, sums);
            });
        } else {
            // Chunk after chunk, and each is moved on while it is in the cache.
            for (index, sums) in sums.iter_mut().enumerate() {
                let (motion, forces) = arrays.lend();
                let own = (&mut forces.force[index], &mut forces.torque[index]);
                self.chunks[index].evaluate(&mut list.chunks[index], motion, inputs, own);
                let first = index * CHUNK;
                let mut own = arrays.part(first..self.count.min(first + CHUNK));
                self.gather(&mut own);
                advance(own, sums);
            }
        });
        self.add_up();
    }

    fn link(&mut self, list: &mut PairList) {
        self.senders.iter_mut().for_each(Vec::clear);
        for (index, (chunk, neighbors)) in self.chunks.iter_mut().zip(&mut list.chunks).enumerate() {
            chunk.link(neighbors);
            // Contacts may be with particles that are no neighbors any more.
            let others = (0..chunk.pairs.len()).map(|contact| chunk.pairs.key(contact).1);
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
        self.chunks.iter().fold(0.0, |most, chunk| most.max(chunk.totals.deepest()))
    }

    fn fold(&mut self) -> Totals<f64> {
        let folded = self.chunks.iter_mut().map(|chunk| chunk.totals.fold());
        folded.fold(Totals::default(), Totals::plus)
    }

    fn totals(&self) -> Vec<Totals> {
        self.chunks.iter().map(|chunk| chunk.totals).collect()
    }

    fn set_totals(&mut self, totals: &[Totals]) {
        for (chunk, &totals) in self.chunks.iter_mut().zip(totals) {
            chunk.totals = totals;
        }
    }

    fn stored(&self) -> Stored<f64> {
        let mut sum = Stored::build(|_| 0.0);
        for list in self.chunks.iter().flat_map(Chunk::lists) {
            for (index, record) in list.records().enumerate() {
                let (law, _) = list.parameters(index);
                let stored = L::stored(&law, record.overlap, &record.history_of::<L>());
                sum = Stored::build(|k| Stored::field(&sum, k) + Stored::field(&stored, k));
            }
        }
        sum
    }

    fn counts(&self) -> (usize, usize) {
        self.chunks.iter().fold((0, 0), |(pairs, walls), chunk| {
            (pairs + chunk.pairs.len(), walls + chunk.rim.len() + chunk.outlines.len())
        })
    }

    fn visit_bodies(&self, visit: &mut dyn FnMut(usize)) {
        for list in self.chunks.iter().flat_map(Chunk::lists) {
            for (particle, other) in (0..list.len()).map(|index| list.key(index)) {
                visit(particle as usize);
                if list.kind != ListKind::Walls {
                    visit(other as usize);
                }
            }
        }
    }

    fn visit_forces(&self, visit: &mut dyn FnMut((u32, u32), bool, Vec2)) {
        for list in self.chunks.iter().flat_map(Chunk::lists) {
            for index in 0..list.len() {
                let (ContactState { force_x, force_y, .. }, lane) =
                    (&list.blocks[index / LANES].state, index % LANES);
                let force = Vec2::new(force_x[lane], force_y[lane]);
                visit(list.key(index), list.kind == ListKind::Walls, force);
            }
        }
    }

    fn contacts(&self) -> Lists {
        let mut lists = Lists::default();
        for chunk in &self.chunks {
            lists.pairs.extend(chunk.pairs.records());
            lists.walls.extend(chunk.rim.records().chain(chunk.outlines.records()));
            lists.pair_tallies.extend(chunk.pairs.all_tallies());
            lists.wall_tallies.extend(chunk.rim.all_tallies().chain(chunk.outlines.all_tallies()));
        }
        lists
    }

    fn insert(&mut self, contacts: &Lists, bodies: &Bodies) {
        for (index, record) in contacts.pairs.iter().enumerate() {
            let list = &mut self.chunks[record.particle as usize / CHUNK].pairs;
            list.insert(record, contacts.pair_tallies.get(index), bodies);
        }
        for (index, record) in contacts.walls.iter().enumerate() {
            let Chunk { rim, outlines, .. } = &mut self.chunks[record.particle as usize / CHUNK];
            let list = if record.other == RIM { rim } else { outlines };
            list.insert(record, contacts.wall_tallies.get(index), bodies);
        }
    }

    fn drain(&mut self) -> Lists {
        let lists = self.contacts();
        for list in self.chunks.iter_mut().flat_map(|own| [&mut own.pairs, &mut own.rim, &mut own.outlines]) {
            while !list.is_empty() {
                list.remove(list.len() - 1);
            }
        }
        lists
    }

    fn event_count(&self) -> usize {
        self.chunks.iter().map(|chunk| chunk.events.len()).sum()
    }

    fn events(&self) -> Vec<ContactEvent> {
        self.chunks.iter().flat_map(|chunk| chunk.events.iter().copied()).collect()
    }

    fn set_events(&mut self, events: Vec<ContactEvent>) {
        self.chunks.iter_mut().for_each(|chunk| chunk.events.clear());
        if let Some(first) = self.chunks.first_mut() {
            first.events = events;
        }
    }
}
