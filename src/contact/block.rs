//! Four contacts, column by column: the hot loop reads the columns as they are.

use super::laws::SlotLaw;
use super::{History, HistoryLanes};
use crate::cache::ask;
use crate::lanes::{LANES, Lanes, Vec2Lanes};
use crate::physics::vector::Vec2;

/// What a contact follows from its bodies alone.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Traits {
    /// Law and damping.
    pub law: SlotLaw,
    /// Radii of the owner and of the other side [m]; that of the drum is zero.
    pub radii: [f64; 2],
}

/// The traits of four contacts.
#[derive(Debug, Clone, Copy)]
pub struct TraitsLanes {
    /// Dampings.
    pub damping: Lanes,
    /// The owners' radii and the other sides' [m].
    pub radii: [Lanes; 2],
}

impl TraitsLanes {
    /// The same for all.
    #[inline(always)]
    pub fn splat(traits: &Traits) -> Self {
        Self { damping: Lanes::splat(traits.law.damping), radii: traits.radii.map(Lanes::splat) }
    }
}

/// Who is at four contacts.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C, align(32))]
pub struct Ends {
    /// The contacts' owners.
    pub owner: [u32; LANES],
    /// Their other sides: particles later in memory, or features of the drum.
    pub other: [u32; LANES],
}

impl Ends {
    /// The same contact in all lanes.
    pub(super) fn splat((owner, other): (u32, u32)) -> Self {
        Self { owner: [owner; LANES], other: [other; LANES] }
    }

    /// The key of a contact.
    #[inline]
    pub(super) fn key(&self, lane: usize) -> (u32, u32) {
        (self.owner[lane], self.other[lane])
    }

    #[inline]
    pub(super) fn put(&mut self, lane: usize, (owner, other): (u32, u32)) {
        (self.owner[lane], self.other[lane]) = (owner, other);
    }
}

/// What four contacts remember; three cache lines.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
pub struct Block {
    /// Overlaps [m]; below zero where a lane is vacant.
    pub(super) overlap: [f64; LANES],
    pub(super) tangential_displacement: [f64; LANES],
    pub(super) normal_force: [f64; LANES],
    pub(super) tangential_force: [f64; LANES],
    pub(super) normal_x: [f64; LANES],
    pub(super) normal_y: [f64; LANES],
}

/// What stands in the place of the overlap where there is no contact.
const NO_CONTACT: f64 = -1.0;

impl Block {
    /// No contacts.
    pub(super) const VACANT: Self = Self {
        overlap: [NO_CONTACT; LANES],
        tangential_displacement: [0.0; LANES],
        normal_force: [0.0; LANES],
        tangential_force: [0.0; LANES],
        normal_x: [0.0; LANES],
        normal_y: [0.0; LANES],
    };

    /// Asks memory for all of it.
    #[inline(always)]
    pub(super) fn ask_for(&self) {
        [&self.overlap, &self.normal_force, &self.normal_x].into_iter().for_each(ask);
    }

    /// Whether a lane has a contact.
    #[inline]
    pub fn holds(&self, lane: usize) -> bool {
        self.overlap[lane] >= 0.0
    }

    pub(super) fn vacate(&mut self, lane: usize) {
        self.put(lane, &History { overlap: NO_CONTACT, ..History::default() });
    }

    /// All ones in the lanes that have a contact.
    #[inline(always)]
    pub fn in_use(&self) -> Lanes {
        Lanes::new(self.overlap).simd_ge(Lanes::ZERO)
    }

    /// What the contacts remember; vacant lanes remember nothing.
    #[inline(always)]
    pub fn history(&self) -> HistoryLanes {
        HistoryLanes {
            overlap: Lanes::new(self.overlap).fast_max(Lanes::ZERO),
            tangential_displacement: Lanes::new(self.tangential_displacement),
            normal_force: Lanes::new(self.normal_force),
            tangential_force: Lanes::new(self.tangential_force),
            normal: Vec2Lanes { x: Lanes::new(self.normal_x), y: Lanes::new(self.normal_y) },
        }
    }

    /// Replaces what they remember.
    #[inline(always)]
    pub fn remember(&mut self, history: &HistoryLanes) {
        let vacant = !self.in_use() & Lanes::splat(NO_CONTACT);
        self.overlap = (history.overlap | vacant).to_array();
        self.tangential_displacement = history.tangential_displacement.to_array();
        self.normal_force = history.normal_force.to_array();
        self.tangential_force = history.tangential_force.to_array();
        self.normal_x = history.normal.x.to_array();
        self.normal_y = history.normal.y.to_array();
    }

    /// The contacts that did not touch at the last force evaluation, as bits.
    #[inline(always)]
    pub(super) fn separated(&self) -> u32 {
        Lanes::new(self.overlap).simd_eq(Lanes::ZERO).to_bitmask()
    }

    #[inline]
    pub(super) fn of(&self, lane: usize) -> History {
        History {
            overlap: self.overlap[lane],
            tangential_displacement: self.tangential_displacement[lane],
            normal_force: self.normal_force[lane],
            tangential_force: self.tangential_force[lane],
            normal: Vec2::new(self.normal_x[lane], self.normal_y[lane]),
        }
    }

    #[inline]
    pub(super) fn put(&mut self, lane: usize, history: &History) {
        self.overlap[lane] = history.overlap;
        self.tangential_displacement[lane] = history.tangential_displacement;
        self.normal_force[lane] = history.normal_force;
        self.tangential_force[lane] = history.tangential_force;
        (self.normal_x[lane], self.normal_y[lane]) = (history.normal.x, history.normal.y);
    }
}

/// The traits of four contacts that differ in them, column by column.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C, align(32))]
pub struct TraitsBlock {
    pub(super) damping: [f64; LANES],
    pub(super) own_radius: [f64; LANES],
    pub(super) other_radius: [f64; LANES],
    pub(super) law: [u32; LANES],
}

impl TraitsBlock {
    pub(super) fn splat(traits: &Traits) -> Self {
        let mut block = Self::default();
        (0..LANES).for_each(|lane| block.put(lane, traits));
        block
    }

    /// As lanes, but for the laws.
    #[inline(always)]
    pub fn lanes(&self) -> TraitsLanes {
        TraitsLanes {
            damping: Lanes::new(self.damping),
            radii: [Lanes::new(self.own_radius), Lanes::new(self.other_radius)],
        }
    }

    /// The laws.
    #[inline(always)]
    pub fn laws(&self) -> [u32; LANES] {
        self.law
    }

    pub(super) fn traits(&self, lane: usize) -> Traits {
        Traits {
            law: SlotLaw { damping: self.damping[lane], law: self.law[lane] },
            radii: [self.own_radius[lane], self.other_radius[lane]],
        }
    }

    pub(super) fn put(&mut self, lane: usize, traits: &Traits) {
        let Traits { law, radii } = *traits;
        (self.damping[lane], self.law[lane]) = (law.damping, law.law);
        [self.own_radius[lane], self.other_radius[lane]] = radii;
    }
}
