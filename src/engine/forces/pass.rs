//! The pass over contacts: from a step of the engine over all chunks to the lists of one.
//!
//! A chunk's contacts are with itself and with later chunks. Their forces go to its own particles at once and to others by
//! `reactions`; see there for the order. With one thread a chunk is moved on as soon as its own contacts and those of
//! earlier chunks are evaluated, while it is in the cache: nothing asks for its positions any more.

use std::marker::PhantomData;

use wide::f64x2;

use super::opening::Ended;
use super::outlines::Spot;
use super::pairs::GroupGeometry;
use super::reactions::RemoteReactions;
use super::store::ContactStore;
use super::{Bodies, StepInputs, Totals, outlines, pairs, walls};
use crate::engine::contacts::{ContactEvent, ContactList, ListKind, ListParameters};
use crate::engine::motion::verlet::{DriftSums, Verlet, WHOLE};
use crate::engine::motion::{
    Arrays, CHUNK_FLAT, FlatArrays, MotionArrays, MotionView, at_offset, far, inside, with_arrays,
};
use crate::engine::pair_list::{ChunkNeighbors, Opened, PairList};
use crate::engine::parallel::{CHUNK, Threads, chunk_count};
use crate::engine::{DrumMotion, Engine, World};
use crate::physics::contact::law::ContactLaw;
use crate::physics::contact::model::{Model, with_law};
use crate::physics::drum::RIM;
use crate::physics::energy::SurfaceLoad;
use crate::physics::particles::Particles;

impl Engine {
    /// Evaluates every contact; the forces must be zero.
    pub fn evaluate(&mut self, particles: &Particles, world: World, drum: DrumMotion) {
        let inputs = self.inputs(particles, world, drum);
        let Self { pass, list, arrays, sums, threads, .. } = self;
        pass.evaluate(list, arrays, &inputs, None, sums, threads);
    }

    /// Evaluates every contact, ends the step and begins the next.
    pub fn evaluate_and_advance(&mut self, particles: &Particles, world: World, drum: DrumMotion) {
        let inputs = self.inputs(particles, world, drum);
        let Self { pass, list, arrays, verlet, sums, threads, .. } = self;
        pass.evaluate(list, arrays, &inputs, Some(verlet), sums, threads);
    }
}

/// The pass over contacts, whatever their law.
pub trait ForcePass: ContactStore {
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
}

/// A pass for these particles, with the law that they need; what each contact does is recorded or not.
pub fn new_pass(model: Model, surfaces: usize, bodies: &Bodies, is_tallied: bool) -> Box<dyn ForcePass> {
    with_law!(model, L => Box::new(Pass::<L>::new(surfaces, bodies, is_tallied)))
}

/// The contacts of all chunks, and what they did.
#[derive(Debug, Clone)]
pub struct Pass<L: ContactLaw> {
    /// By chunk, its contacts.
    pub chunks: Vec<Chunk<L>>,
    /// By chunk, what its contacts did.
    pub outcomes: Vec<ChunkOutcome>,
    /// By chunk: the chunks that may have reactions for it; ascending.
    pub senders: Vec<Vec<u32>>,
    /// What each surface of the drum did to the load in the last pass, where there are several chunks.
    pub surfaces: Vec<SurfaceLoad>,
    count: usize,
}

/// The contacts that the particles of one chunk own. A particle meets the lists in this order.
#[derive(Debug, Clone)]
pub struct Chunk<L: ContactLaw> {
    /// Contacts with later particles.
    pub pairs: ContactList<L>,
    /// With the rim.
    pub rim: ContactList<L>,
    /// With edges and vertices of outlines.
    pub outlines: ContactList<L>,
    scratch: Scratch,
}

/// What the contacts of one chunk did.
#[derive(Debug, Clone, Default)]
pub struct ChunkOutcome {
    /// What the ledger is told.
    pub totals: Totals,
    /// What they do to particles of later chunks.
    pub remote: RemoteReactions,
    /// What each surface of the drum does to the particles.
    pub surfaces: Vec<SurfaceLoad>,
    /// What has happened to contacts that are recorded, until someone takes it; in order.
    pub events: Vec<ContactEvent>,
}

/// Written before it is read; kept, since making it takes time.
#[derive(Debug, Clone, Default)]
pub struct Scratch {
    /// Neighbors that have begun to touch.
    pub opened: Vec<Opened>,
    /// Where particles meet outlines.
    pub spots: Vec<Spot>,
    /// Where the particles of a group of blocks meet.
    pub group: GroupGeometry,
    /// The blocks with contacts that have ended.
    pub ended: Ended,
}

impl<L: ContactLaw> Pass<L> {
    fn new(surfaces: usize, bodies: &Bodies, is_tallied: bool) -> Self {
        let count = bodies.radii.len();
        let (chunks, are_equal) = (chunk_count(count), bodies.are_equal());
        let surfaces = vec![SurfaceLoad::default(); surfaces];
        let outcome = ChunkOutcome { surfaces: surfaces.clone(), ..ChunkOutcome::default() };
        Self {
            chunks: (0..chunks).map(|index| Chunk::new(index, bodies, are_equal, is_tallied)).collect(),
            outcomes: vec![outcome; chunks],
            senders: vec![Vec::new(); chunks],
            surfaces,
            count,
        }
    }

    /// Whether there is code of its own for a load of one chunk, whose contacts need not ask whether a particle is another chunk's.
    /// Asking costs 1 to 5 %. Laws with terms do without, and clipped ones of which more is recorded: there are many, and each takes
    /// its share of the program's size.
    const KNOWS_ONE_CHUNK: bool = !L::HAS_TERMS && !(L::CLIPS && L::IS_RECORDED);

    /// Chunk after chunk, and each is moved on while it is in the cache.
    fn evaluate_in_turn<const N: usize, const M: usize, const H: usize, const ONE_CHUNK: bool>(
        &mut self,
        list: &mut PairList,
        arrays: &mut FlatArrays<N, M, H>,
        inputs: &StepInputs,
        advance: &impl Fn(MotionArrays, &mut DriftSums),
        sums: &mut [DriftSums],
    ) {
        for (index, sums) in sums.iter_mut().enumerate() {
            let (motion, forces) = arrays.lend::<ONE_CHUNK>();
            let own = (&mut forces.force[index], &mut forces.torque[index]);
            let (outcome, neighbors) = (&mut self.outcomes[index], &mut list.chunks[index]);
            self.chunks[index].evaluate(outcome, neighbors, motion, inputs, own);
            let first = index * CHUNK;
            let mut own = arrays.part(first..self.count.min(first + CHUNK));
            if !ONE_CHUNK {
                self.gather(&mut own);
            }
            advance(own, sums);
        }
    }

    /// All chunks at a time; they are moved on when all are evaluated.
    fn evaluate_in_parallel<const N: usize, const M: usize, const H: usize>(
        &mut self,
        list: &mut PairList,
        arrays: &mut FlatArrays<N, M, H>,
        inputs: &StepInputs,
        advance: &(impl Fn(MotionArrays, &mut DriftSums) + Sync),
        sums: &mut [DriftSums],
        threads: &Threads,
    ) {
        let (motion, forces) = arrays.lend::<false>();
        // The arrays are longer than the load.
        let own = self.outcomes.iter_mut().zip(forces.force.iter_mut().zip(forces.torque));
        let chunks = self.chunks.iter_mut().zip(&mut list.chunks).zip(own);
        threads.for_each(self.count, chunks, |((chunk, neighbors), (outcome, own))| {
            chunk.evaluate(outcome, neighbors, motion, inputs, own);
        });
        let chunks = arrays.part(0..self.count).chunks().zip(sums);
        threads.for_each(self.count, chunks, |(mut own, sums)| {
            self.gather(&mut own);
            advance(own, sums);
        });
    }

    /// Adds the reactions on a chunk's particles, in the order of the chunks that sent them.
    fn gather(&self, own: &mut MotionArrays) {
        let chunk = own.first / CHUNK;
        for &sender in &self.senders[chunk] {
            self.outcomes[sender as usize].remote.gather(chunk, own);
        }
    }

    /// Adds what the chunks did to the load, in their order.
    fn add_up(&mut self) {
        // Those of one chunk are read where they are.
        let [first, others @ ..] = &self.outcomes[..] else { return };
        if others.is_empty() {
            return;
        }
        self.surfaces.copy_from_slice(&first.surfaces);
        for outcome in others {
            for (surface, part) in self.surfaces.iter_mut().zip(&outcome.surfaces) {
                surface.force += part.force;
                surface.moment += part.moment;
            }
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
        let advance = &|own: MotionArrays, sums: &mut DriftSums| {
            if let Some(verlet) = integrator {
                *sums = verlet.advance::<WHOLE>(own);
            }
        };
        match arrays {
            Arrays::Small(arrays) if Self::KNOWS_ONE_CHUNK && self.chunks.len() == 1 => {
                self.evaluate_in_turn::<_, _, _, true>(list, arrays, inputs, advance, sums);
            }
            arrays => with_arrays!(arrays, arrays => if threads.serve(self.count) {
                self.evaluate_in_parallel(list, arrays, inputs, advance, sums, threads);
            } else {
                self.evaluate_in_turn::<_, _, _, false>(list, arrays, inputs, advance, sums);
            }),
        }
        self.add_up();
    }
}

impl<L: ContactLaw> Chunk<L> {
    /// No contacts yet, for chunk `index` of particles that are equal in what contacts follow from or not; what contacts do is
    /// recorded or not.
    fn new(index: usize, bodies: &Bodies, are_equal: bool, is_tallied: bool) -> Self {
        let (first, count) = ((index * CHUNK) as u32, bodies.radii.len());
        let pairs = if L::ROLLS || !are_equal { ListKind::PairsOfTwoMoments } else { ListKind::Pairs };
        let list = |kind: ListKind, vacant| {
            let same = || ListParameters::Same(bodies.parameters::<L>((0, 0), kind));
            let parameters = if are_equal { same() } else { ListParameters::Each(Vec::new()) };
            ContactList::new(parameters, vacant, kind, is_tallied)
        };
        Self {
            pairs: list(pairs, (first, far(count))),
            rim: list(ListKind::Walls, (inside(count), RIM)),
            outlines: list(ListKind::Walls, (far(count), RIM)),
            scratch: Scratch::default(),
        }
    }

    /// The lists, in the order in which a particle meets them.
    pub fn lists(&self) -> [&ContactList<L>; 3] {
        [&self.pairs, &self.rim, &self.outlines]
    }

    /// One step of the contacts; `force` and `torque` are those of the chunk's particles.
    fn evaluate<V: MotionView>(
        &mut self,
        outcome: &mut ChunkOutcome,
        neighbors: &mut ChunkNeighbors,
        motion: V,
        inputs: &StepInputs,
        (force, torque): (&mut [f64; CHUNK_FLAT], &mut [f64; CHUNK]),
    ) {
        let Self { pairs, rim, outlines, scratch } = self;
        let ChunkOutcome { totals, remote, surfaces, events } = outcome;
        if neighbors.horizon.is_over() {
            neighbors.refresh(motion, inputs);
        }
        if !V::ONE_CHUNK {
            remote.clear();
        }
        let chunk = neighbors.particles.start / CHUNK as u32;
        let sums = ChunkSums { chunk, force, torque, remote, view: PhantomData };
        let step = &mut ChunkStep { motion, inputs, sums, totals, events, scratch };
        pairs::evaluate(pairs, &mut neighbors.pairs, step);
        surfaces[0] = walls::evaluate_rim(rim, &mut neighbors.rim, step);
        if inputs.drum.has_outlines() {
            surfaces[1..].fill(SurfaceLoad::default());
            outlines::evaluate(outlines, &mut neighbors.features, step, surfaces);
        }
    }
}

/// One step of a chunk, as its lists go through it.
pub struct ChunkStep<'a, V> {
    /// How the particles move.
    pub motion: V,
    /// What is the same for all contacts.
    pub inputs: &'a StepInputs<'a>,
    /// Where forces go.
    pub sums: ChunkSums<'a, V>,
    /// What the ledger is told.
    pub totals: &'a mut Totals,
    /// What happens to contacts that are recorded.
    pub events: &'a mut Vec<ContactEvent>,
    pub scratch: &'a mut Scratch,
}

/// The sums of forces [N/m] and moments [N m/m] of one chunk's particles. Every particle meets its contacts in the order of their
/// lists.
#[derive(Debug)]
pub struct ChunkSums<'a, V> {
    chunk: u32,
    force: &'a mut [f64; CHUNK_FLAT],
    torque: &'a mut [f64; CHUNK],
    /// For particles of later chunks.
    remote: &'a mut RemoteReactions,
    view: PhantomData<V>,
}

impl<V: MotionView> ChunkSums<'_, V> {
    /// Takes the force of a contact off the particle at offset `own`, which is one of the chunk's, and adds the moment.
    #[inline(always)]
    pub fn subtract(&mut self, own: u32, force: f64x2, moment: f64) {
        // A masked offset is an index into the forces of its chunk. A lane without a contact may refer to a place beyond all
        // particles; it brings nothing to whichever this takes it for.
        let x = own as usize & (CHUNK_FLAT - 2);
        let sum = f64x2::new([self.force[x], self.force[x + 1]]) - force;
        [self.force[x], self.force[x + 1]] = sum.to_array();
        self.torque[x / 2] += moment;
    }

    /// Adds force and moment of a contact to the particle at offset `other`, which may be another chunk's.
    #[inline(always)]
    pub fn add(&mut self, other: u32, force: f64x2, moment: f64) {
        if !V::ONE_CHUNK && other / CHUNK_FLAT as u32 != self.chunk {
            return self.remote.send(at_offset(other), force.to_array(), moment);
        }
        // An index into vectors instead of an offset takes 5 instructions more a contact.
        let x = other as usize & (CHUNK_FLAT - 2);
        let sum = f64x2::new([self.force[x], self.force[x + 1]]) + force;
        [self.force[x], self.force[x + 1]] = sum.to_array();
        self.torque[x / 2] += moment;
    }
}
