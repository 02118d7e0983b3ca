//! One chunk's contacts through one step.

use super::accumulate::ChunkSums;
use super::outlines::Spot;
use super::pairs::GroupGeometry;
use super::reactions::RemoteReactions;
use super::totals::Totals;
use super::{Bodies, StepInputs, outlines, pairs, walls};
use crate::engine::contacts::{ContactEvent, ContactList, ListKind, ListParameters};
use crate::engine::motion::{CHUNK_FLAT, MotionView, far, inside};
use crate::engine::pair_list::{ChunkNeighbors, Opened};
use crate::engine::parallel::CHUNK;
use crate::engine::simd::{ALL_LANES, LANES};
use crate::physics::contact::law::ContactLaw;
use crate::physics::drum::RIM;
use crate::physics::energy::SurfaceLoad;

/// The contacts that the particles of one chunk own, and what they did. A particle meets the lists in this order.
#[derive(Debug, Clone)]
pub struct Chunk<L: ContactLaw> {
    /// Contacts with later particles.
    pub pairs: ContactList<L>,
    /// With the rim.
    pub rim: ContactList<L>,
    /// With edges and vertices of outlines.
    pub outlines: ContactList<L>,
    /// What the ledger is told of them.
    pub totals: Totals,
    /// What they do to particles of later chunks.
    pub remote: RemoteReactions,
    /// What each surface of the drum does to the particles.
    pub surfaces: Vec<SurfaceLoad>,
    /// What has happened to contacts that are recorded, until someone takes it; in order.
    pub events: Vec<ContactEvent>,
    scratch: Scratch,
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

/// The blocks of a list with contacts that have ended.
///
/// There is room for all before a pass begins: where a list could grow in a loop, the sums would have to be in memory in every
/// turn, in case that fails.
#[derive(Debug, Clone, Default)]
pub struct Ended {
    blocks: Vec<u32>,
    count: usize,
    /// Which lanes of the last of them touch.
    touching: u32,
}

impl Ended {
    /// None yet, of a list of so many blocks.
    pub fn clear(&mut self, blocks: usize) {
        if self.blocks.len() < blocks {
            self.blocks.resize(blocks, 0);
        }
        self.count = 0;
    }

    /// Takes note of a block of which these lanes touch.
    #[inline(always)]
    pub fn note(&mut self, block: usize, touching: u32) {
        if touching != ALL_LANES
            && let Some(next) = self.blocks.get_mut(self.count)
        {
            *next = block as u32;
            self.count += 1;
            self.touching = touching;
        }
    }

    /// The blocks of a list of so many contacts, ascending.
    pub fn blocks(&self, contacts: usize) -> &[u32] {
        let blocks = &self.blocks[..self.count];
        match blocks.split_last() {
            // Lanes behind the last contact never touch.
            Some((&last, others))
                if last as usize == contacts / LANES && self.touching == (1 << (contacts % LANES)) - 1 =>
            {
                others
            }
            _ => blocks,
        }
    }
}

impl<L: ContactLaw> Chunk<L> {
    /// No contacts yet, for chunk `index` of `count` particles, which are equal in what contacts follow from or not; what contacts
    /// do is recorded or not.
    pub fn new(
        index: usize,
        count: usize,
        surfaces: usize,
        bodies: &Bodies,
        are_equal: bool,
        is_tallied: bool,
    ) -> Self {
        let first = (index * CHUNK) as u32;
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
            totals: Totals::default(),
            remote: RemoteReactions::default(),
            surfaces: vec![SurfaceLoad::default(); surfaces],
            events: Vec::new(),
            scratch: Scratch::default(),
        }
    }

    /// The lists, in the order in which a particle meets them.
    pub fn lists(&self) -> [&ContactList<L>; 3] {
        [&self.pairs, &self.rim, &self.outlines]
    }

    /// Links the contacts to neighbors that have been searched for anew.
    pub fn link(&mut self, neighbors: &mut ChunkNeighbors) {
        self.pairs.link(&mut neighbors.pairs);
        self.rim.link(&mut neighbors.rim);
        self.outlines.link(&mut neighbors.features);
    }

    /// One step of the contacts; `force` and `torque` are those of the chunk's particles.
    pub fn evaluate<V: MotionView>(
        &mut self,
        neighbors: &mut ChunkNeighbors,
        motion: V,
        inputs: &StepInputs,
        (force, torque): (&mut [f64; CHUNK_FLAT], &mut [f64; CHUNK]),
    ) {
        let Self { pairs, rim, outlines, totals, remote, surfaces, events, scratch } = self;
        if neighbors.horizon.is_over() {
            neighbors.refresh(motion, inputs);
        }
        remote.clear();
        let chunk = neighbors.particles.start / CHUNK as u32;
        let sums = ChunkSums::new(chunk, force, torque, remote);
        let step = &mut ChunkStep { motion, inputs, sums, totals, events, scratch };
        pairs::evaluate(pairs, &mut neighbors.pairs, step);
        surfaces[0] = walls::evaluate_rim(rim, &mut neighbors.rim, step);
        if inputs.drum.has_outlines() {
            surfaces[1..].fill(SurfaceLoad::default());
            outlines::evaluate(outlines, &mut neighbors.features, step, surfaces);
        }
    }
}
