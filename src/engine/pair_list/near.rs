//! Near lists: of the pairs in the list of neighbors, those that can touch within the next few steps. Only these are looked
//! at in every step.
//!
//! The textbook looks at all neighbors in every step. Here that is done for the tenth of them that are near, some 33
//! instructions for four; making the list anew costs about as much as one look at all neighbors, every 32 steps (GROMACS
//! prunes its outer list to an inner one in the same way). No result depends on it, since a pair that is left out cannot
//! touch before the list ends (`horizon`).

use super::chunk::ROUND_OFF;
use crate::engine::contacts::NOT_LISTED;
use crate::engine::forces::Bodies;
use crate::engine::motion::{MotionView, at_offset, offset};
use crate::engine::simd::{ALL_LANES, F64x4, LANES, differences, lanes};
use crate::physics::scalar::Scalar;

/// Four pairs that are near.
#[derive(Debug, Clone, Copy)]
pub struct NearBlock {
    /// Offsets of bodies i.
    pub own: [u32; LANES],
    /// Offsets of bodies j; features of the drum are doubled likewise.
    pub other: [u32; LANES],
    /// Their places among the neighbors.
    place: [u32; LANES],
}

/// Pairs that are near. Lanes after the last one, and those whose pair has become a contact, are vacant: they refer to
/// bodies that never touch.
#[derive(Debug, Clone)]
pub struct NearList {
    blocks: Vec<NearBlock>,
    len: usize,
    /// The bodies of a vacant lane.
    vacant: (u32, u32),
}

/// A pair that has begun to touch: its bodies, and its place among the neighbors.
pub type Opened = ((u32, u32), u32);

impl NearList {
    /// An empty list; vacant lanes refer to the bodies `vacant`.
    pub fn new(vacant: (u32, u32)) -> Self {
        Self { blocks: Vec::new(), len: 0, vacant }
    }

    /// Forgets all, keeping the memory.
    pub fn clear(&mut self) {
        self.blocks.clear();
        self.len = 0;
    }

    /// Appends a pair.
    #[inline]
    pub fn push(&mut self, (own, other): (u32, u32), place: u32) {
        let lane = self.len % LANES;
        if lane == 0 {
            let (own, other) = (offset(self.vacant.0), offset(self.vacant.1));
            let (own, other) = ([own; LANES], [other; LANES]);
            self.blocks.push(NearBlock { own, other, place: [NOT_LISTED; LANES] });
        }
        if let Some(block) = self.blocks.last_mut() {
            (block.own[lane], block.other[lane], block.place[lane]) = (offset(own), offset(other), place);
        }
        self.len += 1;
    }

    /// Takes out the pairs that touch, which each block tells by bits.
    #[inline(always)]
    pub fn take_where(&mut self, opened: &mut Vec<Opened>, touching: impl Fn(&NearBlock) -> u32) {
        let mut next = 0;
        // A loop that only looks, as hardly any pair touches: it need not ask in each turn whether the list has changed.
        while let Some(skipped) = self.blocks[next..].iter().position(|block| touching(block) != 0) {
            next += skipped + 1;
            self.take(next - 1, touching(&self.blocks[next - 1]), opened);
        }
    }

    #[cold]
    #[inline(never)]
    fn take(&mut self, block: usize, touching: u32, opened: &mut Vec<Opened>) {
        let vacant = (offset(self.vacant.0), offset(self.vacant.1));
        for lane in (0..LANES).filter(|lane| touching >> lane & 1 == 1) {
            let block = &mut self.blocks[block];
            let key = (at_offset(block.own[lane]), at_offset(block.other[lane]));
            opened.push((key, block.place[lane]));
            (block.own[lane], block.other[lane]) = vacant;
            block.place[lane] = NOT_LISTED;
        }
    }

    /// The bodies of a vacant lane.
    pub fn vacant(&self) -> (u32, u32) {
        self.vacant
    }
}

/// When two particles count as near.
#[derive(Debug, Clone, Copy)]
pub struct Reach<'a> {
    /// What the particles are.
    bodies: Bodies<'a>,
    /// The margin of the list of neighbors [m].
    skin: F64x4,
    /// Of equal particles, what a pair's are.
    equal: Option<PairReach>,
    /// The time for which the list is made [s].
    time: F64x4,
    /// What changes of displacements may add to the approach [m].
    budget: F64x4,
}

/// The reach of four pairs, and what follows from it.
#[derive(Debug, Clone, Copy)]
struct PairReach {
    /// Sum of the radii [m].
    reach: F64x4,
    /// 1 / (distance + reach) for the farthest pair in the list of neighbors, and slightly less [1/m].
    inverse_sum: F64x4,
}

impl PairReach {
    #[inline(always)]
    fn new(reach: F64x4, skin: F64x4) -> Self {
        // In the list, a distance is at most the reach and the skin when it was built, and one skin more since.
        let sum = (reach + skin) * 2.0;
        Self { reach, inverse_sum: F64x4::splat(ROUND_OFF) / sum }
    }
}

impl<'a> Reach<'a> {
    /// For a list of neighbors of the margin `skin` [m], of which the near ones are wanted for so long [s]; `budget` is what
    /// changes of displacements may add to the approach [m].
    pub fn new(bodies: Bodies<'a>, skin: f64, time: f64, budget: f64) -> Self {
        let [skin, time, budget] = [skin, time, budget].map(F64x4::splat);
        let equal = bodies.radius.map(|radius| PairReach::new(F64x4::splat(radius + radius), skin));
        Self { bodies, skin, equal, time, budget }
    }

    /// Which of four pairs may touch, as bits.
    #[inline(always)]
    pub fn near(&self, pairs: &[(u32, u32); LANES], motion: impl MotionView) -> u32 {
        let (own, other) = (|lane: usize| offset(pairs[lane].0), |lane: usize| offset(pairs[lane].1));
        let apart = differences(|lane| motion.position(own(lane)), |lane| motion.position(other(lane)));
        let velocity = differences(|lane| motion.velocity(own(lane)), |lane| motion.velocity(other(lane)));
        let radius = |particle| self.bodies.radius_of(particle);
        let PairReach { reach, inverse_sum } = self.equal.unwrap_or_else(|| {
            let reach = lanes(|lane| radius(pairs[lane].0) + radius(pairs[lane].1));
            PairReach::new(reach, self.skin)
        });
        // The gap is (d² − reach²) / (d + reach). The approach is over d, which is no less than the reach.
        let excess = apart.dot(apart) - reach * reach;
        let gap = excess.larger(F64x4::ZERO) * inverse_sum;
        let approach = -(apart.dot(velocity)) * (self.time / reach);
        !gap.exceeds(approach.larger(F64x4::ZERO) + self.budget).to_bitmask() & ALL_LANES
    }
}
