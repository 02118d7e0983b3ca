//! What a pass keeps between two steps: contacts, as they leave and as they come back, and sums and events of what they did.

use std::fmt::Debug;
use std::ops::Add;

use super::pass::{Chunk, ChunkOutcome, Pass};
use super::{Bodies, Totals};
use crate::engine::contacts::{ContactEvent, ContactRecord, ContactTally, ListKind};
use crate::engine::pair_list::PairList;
use crate::engine::parallel::CHUNK;
use crate::engine::simd::LANES;
use crate::physics::columns::Columns;
use crate::physics::contact::law::ContactLaw;
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

/// What a pass keeps, whatever the law of its contacts.
pub trait ContactStore: Debug + Send + Sync {
    /// By chunk, what its contacts did.
    fn outcomes(&self) -> &[ChunkOutcome];

    /// The same, to change.
    fn outcomes_mut(&mut self) -> &mut [ChunkOutcome];

    /// What each surface of the drum did to the load in the last pass.
    fn surfaces(&self) -> &[SurfaceLoad];

    /// Greatest overlap over the smaller radius since the totals were last folded.
    fn deepest(&self) -> f64 {
        self.outcomes().iter().fold(0.0, |most, outcome| most.max(outcome.totals.deepest()))
    }

    /// The sums for the ledger, which begin anew.
    fn fold(&mut self) -> Totals<f64> {
        let folded = self.outcomes_mut().iter_mut().map(|outcome| outcome.totals.fold());
        folded.fold(Totals::default(), Totals::plus)
    }

    /// These sums by chunk, as they are.
    fn totals(&self) -> Vec<Totals> {
        self.outcomes().iter().map(|outcome| outcome.totals).collect()
    }

    /// Replaces them.
    fn set_totals(&mut self, totals: &[Totals]) {
        for (outcome, &totals) in self.outcomes_mut().iter_mut().zip(totals) {
            outcome.totals = totals;
        }
    }

    /// How many events of contacts have not been taken.
    fn event_count(&self) -> usize {
        self.outcomes().iter().map(|outcome| outcome.events.len()).sum()
    }

    /// Those events, chunk by chunk.
    fn events(&self) -> Vec<ContactEvent> {
        self.outcomes().iter().flat_map(|outcome| outcome.events.iter().copied()).collect()
    }

    /// Replaces them.
    fn set_events(&mut self, events: Vec<ContactEvent>) {
        self.outcomes_mut().iter_mut().for_each(|outcome| outcome.events.clear());
        if let Some(first) = self.outcomes_mut().first_mut() {
            first.events = events;
        }
    }

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

    /// Links the contacts to a list of neighbors that has been built anew.
    fn link(&mut self, list: &mut PairList);
}

impl<L: ContactLaw> ContactStore for Pass<L> {
    fn outcomes(&self) -> &[ChunkOutcome] {
        &self.outcomes
    }

    fn outcomes_mut(&mut self) -> &mut [ChunkOutcome] {
        &mut self.outcomes
    }

    fn surfaces(&self) -> &[SurfaceLoad] {
        match &self.outcomes[..] {
            [only] => &only.surfaces,
            _ => &self.surfaces,
        }
    }

    fn stored(&self) -> Stored<f64> {
        let mut sum = Stored::default();
        for list in self.chunks.iter().flat_map(Chunk::lists) {
            for (index, record) in list.records().enumerate() {
                let (law, _) = list.parameters(index);
                let stored = L::stored(&law, record.overlap, &record.history_of::<L>());
                sum = Stored::zip(&sum, &stored, f64::add);
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

    fn link(&mut self, list: &mut PairList) {
        self.senders.iter_mut().for_each(Vec::clear);
        let chunks = self.chunks.iter_mut().zip(&mut self.outcomes).zip(&mut list.chunks);
        for (index, ((chunk, outcome), neighbors)) in chunks.enumerate() {
            chunk.pairs.link(&mut neighbors.pairs);
            chunk.rim.link(&mut neighbors.rim);
            chunk.outlines.link(&mut neighbors.features);
            // Contacts may be with particles that are no neighbors any more.
            let others = (0..chunk.pairs.len()).map(|contact| chunk.pairs.key(contact).1);
            let watched = neighbors.watched.iter().map(|&other| other * CHUNK as u32);
            outcome.remote.prepare(index, watched.chain(others));
            for &target in outcome.remote.targets() {
                self.senders[target as usize].push(index as u32);
            }
        }
    }
}
