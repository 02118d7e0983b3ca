//! One chunk's contacts through one step: those that open, those that go on, those that end.

use super::StepInputs;
use super::accumulate::Accumulator;
use super::pairs::{self, Scratch};
use super::totals::Totals;
use super::walls::{self, Spot};
use crate::engine::contacts::{ContactList, ContactRecord, ListKind, ListParameters};
use crate::engine::motion::{MotionView, at_offset, far, inside};
use crate::engine::pair_list::{ChunkNeighbors, NearBlock, NearLimits, Opened, Status};
use crate::engine::parallel::CHUNK;
use crate::engine::simd::{F64x4, LANES, Vec2x4, lanes, rows};
use crate::physics::contact::law::ContactLaw;
use crate::physics::drum::RIM;
use crate::physics::energy::SurfaceLoad;

/// The contacts that the particles of one chunk own. A particle meets them in this order.
#[derive(Debug, Clone)]
pub struct ChunkContacts<L: ContactLaw> {
    /// With later particles.
    pub pairs: ContactList<L>,
    /// With the rim.
    pub rim: ContactList<L>,
    /// With edges and vertices of outlines.
    pub outlines: ContactList<L>,
    /// What the ledger is told of them.
    pub totals: Totals,
}

/// Written before it is read; kept, since making it takes time.
#[derive(Debug, Clone, Default)]
pub struct ChunkScratch {
    pairs: Scratch,
    opened: Vec<Opened>,
    spots: Vec<Spot>,
}

impl<L: ContactLaw> ChunkContacts<L> {
    /// None yet, for chunk `index` of `count` particles, which are equal in what contacts follow from or not.
    pub fn new(index: usize, count: usize, bodies: &super::Bodies, are_equal: bool) -> Self {
        let first = (index * CHUNK) as u32;
        let parameters = |same: &dyn Fn() -> _| {
            if are_equal { ListParameters::Same(same()) } else { ListParameters::Each(Vec::new()) }
        };
        let walls = || parameters(&|| bodies.wall::<L>(0));
        Self {
            pairs: ContactList::new(
                parameters(&|| bodies.pair::<L>(0, 0)),
                (first, far(count)),
                if L::ROLLS || !are_equal { ListKind::PairsOfTwoMoments } else { ListKind::Pairs },
            ),
            rim: ContactList::new(walls(), (inside(count), RIM), ListKind::Walls),
            outlines: ContactList::new(walls(), (far(count), RIM), ListKind::Walls),
            totals: Totals::default(),
        }
    }

    /// The lists, in the order in which a particle meets them.
    pub fn lists(&self) -> [&ContactList<L>; 3] {
        [&self.pairs, &self.rim, &self.outlines]
    }

    /// Forgets all contacts.
    pub fn clear(&mut self) {
        self.pairs.clear();
        self.rim.clear();
        self.outlines.clear();
    }

    /// Links the contacts to neighbors that have been searched for anew.
    pub fn link(&mut self, neighbors: &mut ChunkNeighbors) {
        for index in 0..self.pairs.len() {
            let place = neighbors.pairs.place_of(self.pairs.key(index));
            neighbors.pairs.set(place, Status::Contact);
            *self.pairs.neighbor_mut(index) = place;
        }
        for index in 0..self.rim.len() {
            let own = self.rim.key(index).0 - neighbors.particles.start;
            neighbors.at_rim[own as usize] = Status::Contact;
            *self.rim.neighbor_mut(index) = own;
        }
        for index in 0..self.outlines.len() {
            let place = neighbors.features.place_of(self.outlines.key(index));
            neighbors.features.set(place, Status::Contact);
            *self.outlines.neighbor_mut(index) = place;
        }
    }

    /// Adds a contact as it is, at the end of its list.
    pub fn insert_pair(&mut self, record: &ContactRecord, place: u32, bodies: &super::Bodies) {
        self.pairs.push(record, place, &bodies.pair::<L>(record.particle, record.other));
    }

    /// Adds a contact with the drum.
    pub fn insert_wall(&mut self, record: &ContactRecord, place: u32, bodies: &super::Bodies) {
        let list = if record.other == RIM { &mut self.rim } else { &mut self.outlines };
        list.push(record, place, &bodies.wall::<L>(record.particle));
    }

    /// One step. Adds what the contacts do to the particles to `sums`, what they do to the load by surface to `surfaces`.
    #[allow(clippy::too_many_arguments)]
    #[inline]
    pub fn evaluate(
        &mut self,
        neighbors: &mut ChunkNeighbors,
        limits: NearLimits,
        motion: impl MotionView,
        inputs: &StepInputs,
        sums: &mut impl Accumulator,
        surfaces: &mut [SurfaceLoad],
        scratch: &mut ChunkScratch,
    ) {
        if neighbors.horizon.is_over() {
            neighbors.refresh(motion, inputs, limits);
        }
        self.evaluate_pairs(neighbors, motion, inputs, sums, scratch);
        self.evaluate_rim(neighbors, motion, inputs, sums, surfaces, scratch);
        if inputs.drum.surface_count() > 1 {
            self.evaluate_outlines(neighbors, motion, inputs, sums, surfaces, scratch);
        }
    }

    fn evaluate_pairs(
        &mut self,
        neighbors: &mut ChunkNeighbors,
        motion: impl MotionView,
        inputs: &StepInputs,
        sums: &mut impl Accumulator,
        scratch: &mut ChunkScratch,
    ) {
        let opened = &mut scratch.opened;
        find_touching_pairs(neighbors, motion, inputs, opened);
        if !opened.is_empty() {
            self.open_pairs(neighbors, inputs, opened);
        }
        if self.pairs.is_empty() {
            return;
        }
        pairs::evaluate(&mut self.pairs, motion, inputs.time, sums, &mut self.totals, &mut scratch.pairs);
        let ended = scratch.pairs.ended.blocks();
        if !ended.is_empty() {
            self.pairs.close_ended(ended, |key, place| neighbors.release_pair(key, place));
        }
    }

    /// Makes contacts of pairs that have begun to touch.
    #[cold]
    fn open_pairs(&mut self, neighbors: &mut ChunkNeighbors, inputs: &StepInputs, opened: &mut Vec<Opened>) {
        opened.sort_unstable();
        for (key, place) in opened.drain(..) {
            self.insert_pair(&opening(key), place, &inputs.bodies);
            neighbors.pairs.set(place, Status::Contact);
        }
    }

    /// Makes contacts of particles that have begun to touch the rim.
    #[cold]
    fn open_rim(&mut self, neighbors: &mut ChunkNeighbors, inputs: &StepInputs, opened: &mut Vec<Opened>) {
        opened.sort_unstable();
        for (key, own) in opened.drain(..) {
            self.insert_wall(&opening(key), own, &inputs.bodies);
            neighbors.at_rim[own as usize] = Status::Contact;
        }
    }

    fn evaluate_rim(
        &mut self,
        neighbors: &mut ChunkNeighbors,
        motion: impl MotionView,
        inputs: &StepInputs,
        sums: &mut impl Accumulator,
        surfaces: &mut [SurfaceLoad],
        scratch: &mut ChunkScratch,
    ) {
        let opened = &mut scratch.opened;
        find_touching_rim(neighbors, motion, inputs, opened);
        if !opened.is_empty() {
            self.open_rim(neighbors, inputs, opened);
        }
        if self.rim.is_empty() {
            return;
        }
        let ended = &mut scratch.pairs.ended;
        surfaces[0] = walls::evaluate_rim(&mut self.rim, motion, inputs, sums, &mut self.totals, ended);
        if !ended.blocks().is_empty() {
            self.rim.close_ended(ended.blocks(), |(particle, _), _| neighbors.release_rim(particle));
        }
    }

    fn evaluate_outlines(
        &mut self,
        neighbors: &mut ChunkNeighbors,
        motion: impl MotionView,
        inputs: &StepInputs,
        sums: &mut impl Accumulator,
        surfaces: &mut [SurfaceLoad],
        scratch: &mut ChunkScratch,
    ) {
        let ChunkScratch { opened, spots, pairs: Scratch { ended, .. } } = scratch;
        spots.clear();
        for index in 0..self.outlines.len() {
            let (particle, feature) = self.outlines.key(index);
            let spot = Spot::of(particle, feature, motion, inputs);
            let spot =
                spot.or_else(|| transfer_history(&mut self.outlines, index, neighbors, motion, inputs));
            spots.push(spot.unwrap_or_default());
        }
        for block in 0..neighbors.near_features.blocks().len() {
            let touches = |lane: &usize| {
                let key = neighbors.near_features.key(block, *lane);
                key.1 != RIM && Spot::of(key.0, key.1, motion, inputs).is_some_and(|spot| spot.overlap > 0.0)
            };
            let touching = (0..LANES).filter(touches).fold(0, |bits, lane| bits | 1 << lane);
            if touching != 0 {
                neighbors.near_features.take(block, touching, opened);
            }
        }
        opened.sort_unstable();
        for (key, place) in opened.drain(..) {
            // A history may have passed to this feature in the meantime.
            if neighbors.features.status()[place as usize] == Status::Contact {
                continue;
            }
            self.insert_wall(&opening(key), place, &inputs.bodies);
            neighbors.features.set(place, Status::Contact);
            spots.push(Spot::of(key.0, key.1, motion, inputs).unwrap_or_default());
        }
        let totals = &mut self.totals;
        walls::evaluate_outlines(&mut self.outlines, spots, motion, inputs, sums, totals, surfaces, ended);
        self.outlines.close_ended(ended.blocks(), |key, place| neighbors.release_feature(key, place));
    }
}

/// A contact that has not touched before.
fn opening((particle, other): (u32, u32)) -> ContactRecord {
    ContactRecord { particle, other, ..ContactRecord::default() }
}

/// Takes the pairs that touch out of the near list.
fn find_touching_pairs(
    neighbors: &mut ChunkNeighbors,
    motion: impl MotionView,
    inputs: &StepInputs,
    opened: &mut Vec<Opened>,
) {
    let bodies = inputs.bodies;
    let apart = |near: &NearBlock| {
        let [own, own_odd] = rows(|lane| motion.position(near.own[lane]));
        let [other, other_odd] = rows(|lane| motion.position(near.other[lane]));
        Vec2x4::from_rows([other - own, other_odd - own_odd])
    };
    if let Some(radius) = bodies.radius {
        let reach = F64x4::splat((radius + radius) * (radius + radius));
        neighbors.near_pairs.take_where(opened, |near| {
            let apart = apart(near);
            reach.simd_gt(apart.dot(apart))
        });
    } else {
        let radius = |place: u32| bodies.radius_of(at_offset(place));
        neighbors.near_pairs.take_where(opened, |near| {
            let (apart, reach) =
                (apart(near), lanes(|lane| radius(near.own[lane]) + radius(near.other[lane])));
            (reach * reach).simd_gt(apart.dot(apart))
        });
    }
}

/// Takes the particles that touch the rim out of the near list.
fn find_touching_rim(
    neighbors: &mut ChunkNeighbors,
    motion: impl MotionView,
    inputs: &StepInputs,
    opened: &mut Vec<Opened>,
) {
    let Some(rim) = inputs.drum.radius() else { return };
    let bodies = inputs.bodies;
    let same = bodies.radius.map(|radius| F64x4::splat((rim - radius) * (rim - radius)));
    neighbors.near_rim.take_where(opened, |near| {
        let position = Vec2x4::from_rows(rows(|lane| motion.position(near.own[lane])));
        let free = same.unwrap_or_else(|| {
            let free = lanes(|lane| rim - bodies.radius_of(at_offset(near.own[lane])));
            free * free
        });
        position.dot(position).simd_gt(free)
    });
}

/// Passes the history of a contact to the neighboring feature of the outline when a particle rolls from one to the other.
/// The contact keeps its place; returns where it is now.
#[cold]
fn transfer_history<L: ContactLaw>(
    contacts: &mut ContactList<L>,
    index: usize,
    neighbors: &mut ChunkNeighbors,
    motion: impl MotionView,
    inputs: &StepInputs,
) -> Option<Spot> {
    let (particle, feature) = contacts.key(index);
    let (successor, spot) = neighbors.features.of(particle).find_map(|place| {
        let (_, other) = neighbors.features.pairs()[place];
        let is_free = neighbors.features.status()[place] == Status::Apart;
        let spot = (is_free && inputs.drum.adjacent(feature, other))
            .then(|| Spot::of(particle, other, motion, inputs))
            .flatten()
            .filter(|spot| spot.overlap > 0.0)?;
        Some((place, spot))
    })?;
    neighbors.release_feature((particle, feature), contacts.neighbor(index));
    neighbors.features.set(successor as u32, Status::Contact);
    contacts.pass_to(index, neighbors.features.pairs()[successor].1, successor as u32);
    Some(spot)
}
