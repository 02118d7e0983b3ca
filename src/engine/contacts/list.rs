//! A list of contacts, four to a block, column by column.

use super::event::{ContactTally, Opening};
use super::record::{ContactRecord, PairParameters};
use crate::engine::motion::{at_offset, offset};
use crate::engine::simd::{F64x4, LANES};
use crate::physics::columns::{Columns, Of};
use crate::physics::contact::ContactState;
use crate::physics::contact::law::ContactLaw;
use crate::physics::contact::tally::Tally;

/// The bodies of four contacts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ids {
    /// Offsets of bodies i.
    pub own: [u32; LANES],
    /// Offsets of bodies j; features of the drum are doubled likewise.
    pub other: [u32; LANES],
}

/// What four contacts keep: three cache lines for the linear law.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
pub struct Block<L: ContactLaw> {
    /// What every contact keeps.
    pub state: ContactState<[f64; LANES]>,
    /// What the law keeps.
    pub history: Of<L::History, [f64; LANES]>,
}

/// What four contacts have done since they opened, where that is recorded: the columns of `Tally` in their order.
pub type BlockTally = [[f64; LANES]; Tally::COUNT];

/// The parameters of the contacts of a list: in a load of equal bundles the same for all, which then cost neither memory
/// nor time.
#[derive(Debug, Clone)]
pub enum ListParameters<L: ContactLaw> {
    /// All have these.
    Same(Of<PairParameters<L>, f64>),
    /// By block.
    Each(Vec<Of<PairParameters<L>, [f64; LANES]>>),
}

/// The parameters of the blocks of a list, read in the same way whether all have the same or not.
#[derive(Debug, Clone, Copy)]
pub struct ByBlock<'a, L: ContactLaw> {
    each: &'a [Of<PairParameters<L>, [f64; LANES]>],
    /// From one block to the next: 0 where all have the same.
    stride: usize,
}

impl<L: ContactLaw> ListParameters<L> {
    /// The same for four lanes, where all contacts have the same.
    #[inline(always)]
    pub fn shared(&self) -> Option<Of<PairParameters<L>, [f64; LANES]>> {
        match self {
            Self::Same(same) => Some(PairParameters::<L>::map(same, |value| [value; LANES])),
            Self::Each(_) => None,
        }
    }

    /// By block; `shared` is what the method of that name returns.
    #[inline(always)]
    pub fn by_block<'a>(&'a self, shared: &'a Option<Of<PairParameters<L>, [f64; LANES]>>) -> ByBlock<'a, L> {
        match self {
            Self::Same(_) => ByBlock { each: shared.as_slice(), stride: 0 },
            Self::Each(each) => ByBlock { each, stride: 1 },
        }
    }
}

impl<L: ContactLaw> ByBlock<'_, L> {
    /// The laws of a block's contacts, and the radii of their bodies.
    #[inline(always)]
    pub fn of(&self, block: usize) -> Of<PairParameters<L>, F64x4> {
        PairParameters::<L>::map(&self.each[block * self.stride], F64x4::new)
    }
}

/// What a list has contacts with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ListKind {
    /// Other particles, the moments on both bodies being the same.
    Pairs,
    /// Other particles, each moment kept.
    PairsOfTwoMoments,
    /// Features of the drum.
    Walls,
}

/// Contacts in the order in which they opened. Lanes after the last one are vacant: they refer to bodies that never touch.
#[derive(Debug, Clone)]
pub struct ContactList<L: ContactLaw> {
    /// The bodies, by block.
    pub ids: Vec<Ids>,
    /// What is kept, by block.
    pub blocks: Vec<Block<L>>,
    /// By block, the moments on bodies j; empty where they are those on bodies i.
    pub other_moments: Vec<[f64; LANES]>,
    /// The law between the bodies, and their radii.
    pub parameters: ListParameters<L>,
    /// By contact, its place in the list of neighbors.
    pub neighbors: Vec<u32>,
    /// What they are with.
    pub kind: ListKind,
    /// By block, what the contacts have done since they opened; empty where that is not recorded.
    pub tallies: Vec<BlockTally>,
    /// By contact, how they began; likewise.
    pub openings: Vec<Opening>,
    /// Whether that is recorded.
    pub is_tallied: bool,
    /// The bodies of a vacant lane.
    vacant: (u32, u32),
}

impl<L: ContactLaw> ContactList<L> {
    /// No contacts yet; what they do is recorded or not.
    pub fn new(parameters: ListParameters<L>, vacant: (u32, u32), kind: ListKind, is_tallied: bool) -> Self {
        Self {
            ids: Vec::new(),
            blocks: Vec::new(),
            other_moments: Vec::new(),
            parameters,
            neighbors: Vec::new(),
            kind,
            tallies: Vec::new(),
            openings: Vec::new(),
            is_tallied: L::IS_RECORDED && is_tallied,
            vacant,
        }
    }

    /// Number of contacts.
    #[inline]
    pub fn len(&self) -> usize {
        self.neighbors.len()
    }

    /// Whether there are none.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.neighbors.is_empty()
    }

    /// The bodies of contact `index`.
    #[inline]
    pub fn key(&self, index: usize) -> (u32, u32) {
        let ids = &self.ids[index / LANES];
        (at_offset(ids.own[index % LANES]), at_offset(ids.other[index % LANES]))
    }

    /// Contact `index`.
    pub fn record(&self, index: usize) -> ContactRecord {
        let (block, lane) = (index / LANES, index % LANES);
        let (particle, other) = self.key(index);
        let state = ContactState::map(&self.blocks[block].state, |column| column[lane]);
        let moment = self.other_moments.get(block).map_or(state.moment, |moments| moments[lane]);
        let mut history = [0.0; ContactRecord::MOST_COLUMNS];
        for (value, column) in history.iter_mut().zip(L::History::values(&self.blocks[block].history)) {
            *value = column[lane];
        }
        ContactRecord {
            particle,
            other,
            overlap: state.overlap,
            separation_rate: state.separation_rate,
            force: [state.force_x, state.force_y],
            moments: [state.moment, moment],
            history,
        }
    }

    /// All contacts, in order.
    pub fn records(&self) -> impl Iterator<Item = ContactRecord> + '_ {
        (0..self.len()).map(|index| self.record(index))
    }

    /// What contact `index` has done since it opened, where that is recorded.
    pub fn tally(&self, index: usize) -> ContactTally {
        let (block, lane) = (index / LANES, index % LANES);
        let columns = &self.tallies[block];
        ContactTally { opening: self.openings[index], tally: Tally::build(|column| columns[column][lane]) }
    }

    /// The same of all contacts, in order; none where it is not recorded.
    pub fn all_tallies(&self) -> impl Iterator<Item = ContactTally> + '_ {
        (0..self.openings.len()).map(|index| self.tally(index))
    }

    /// Replaces what contact `index` has done, where that is recorded.
    pub fn set_tally(&mut self, index: usize, contact: &ContactTally) {
        if !self.is_tallied {
            return;
        }
        self.openings[index] = contact.opening;
        for (column, own) in self.tallies[index / LANES].iter_mut().enumerate() {
            own[index % LANES] = Tally::field(&contact.tally, column);
        }
    }

    /// The law of contact `index`, and the radii of its bodies.
    pub fn parameters(&self, index: usize) -> Of<PairParameters<L>, f64> {
        match &self.parameters {
            ListParameters::Same(same) => *same,
            ListParameters::Each(blocks) => {
                PairParameters::<L>::map(&blocks[index / LANES], |column: [f64; LANES]| column[index % LANES])
            }
        }
    }

    /// Appends a contact; `neighbor` is its place in the list of neighbors.
    pub fn push(&mut self, record: &ContactRecord, neighbor: u32, parameters: &Of<PairParameters<L>, f64>) {
        let index = self.len();
        if index.is_multiple_of(LANES) {
            self.push_block(parameters);
        }
        self.neighbors.push(neighbor);
        self.put(index, record, parameters);
        if self.is_tallied {
            self.openings.push(Opening::default());
        }
    }

    /// Appends a vacant block. Its parameters are those of a contact, so that it can be worked out.
    fn push_block(&mut self, parameters: &Of<PairParameters<L>, f64>) {
        let (own, other) = (offset(self.vacant.0), offset(self.vacant.1));
        self.ids.push(Ids { own: [own; LANES], other: [other; LANES] });
        self.blocks.push(Block {
            state: ContactState::build(|_| [0.0; LANES]),
            history: L::History::build(|_| [0.0; LANES]),
        });
        if self.kind == ListKind::PairsOfTwoMoments {
            self.other_moments.push([0.0; LANES]);
        }
        if self.is_tallied {
            self.tallies.push([[0.0; LANES]; Tally::COUNT]);
        }
        if let ListParameters::Each(blocks) = &mut self.parameters {
            blocks.push(PairParameters::<L>::map(parameters, |value| [value; LANES]));
        }
    }

    fn put(&mut self, index: usize, record: &ContactRecord, parameters: &Of<PairParameters<L>, f64>) {
        let (block, lane) = (index / LANES, index % LANES);
        self.put_key(index, record.key());
        let own = &mut self.blocks[block];
        ContactState::set_lane(&mut own.state, lane, &record.state());
        L::History::set_lane(&mut own.history, lane, &record.history_of::<L>());
        if let Some(moments) = self.other_moments.get_mut(block) {
            moments[lane] = record.moments[1];
        }
        if let ListParameters::Each(blocks) = &mut self.parameters {
            PairParameters::<L>::set_lane(&mut blocks[block], lane, parameters);
        }
    }

    fn put_key(&mut self, index: usize, (own, other): (u32, u32)) {
        let ids = &mut self.ids[index / LANES];
        (ids.own[index % LANES], ids.other[index % LANES]) = (offset(own), offset(other));
    }

    /// Lets contact `index` be with another feature of the drum, which has this place in the list of neighbors.
    pub fn pass_to(&mut self, index: usize, feature: u32, neighbor: u32) {
        let (own, _) = self.key(index);
        self.put_key(index, (own, feature));
        self.neighbors[index] = neighbor;
    }

    /// Takes contact `index` out; the last one takes its place. Returns its key and its place in the list of neighbors.
    pub fn remove(&mut self, index: usize) -> ((u32, u32), u32) {
        let (key, last) = (self.key(index), self.len() - 1);
        if index < last {
            let parameters = self.parameters(last);
            self.put(index, &self.record(last), &parameters);
        }
        if self.is_tallied {
            self.openings.swap_remove(index);
            for column in 0..Tally::COUNT {
                let value = std::mem::take(&mut self.tallies[last / LANES][column][last % LANES]);
                if index < last {
                    self.tallies[index / LANES][column][index % LANES] = value;
                }
            }
        }
        let parameters = self.parameters(last);
        let (particle, other) = self.vacant;
        self.put(last, &ContactRecord { particle, other, ..ContactRecord::default() }, &parameters);
        let neighbor = self.neighbors.swap_remove(index);
        if last.is_multiple_of(LANES) {
            self.ids.pop();
            self.blocks.pop();
            self.other_moments.pop();
            self.tallies.pop();
            if let ListParameters::Each(blocks) = &mut self.parameters {
                blocks.pop();
            }
        }
        (key, neighbor)
    }
}
