//! Near lists: of the pairs in the list of neighbors, those that can touch within the next few steps. Only these are looked
//! at in every step.
//!
//! The textbook looks at all neighbors in every step. Here that is done for the tenth of them that are near, some 33
//! instructions for four; making the list anew costs about as much as one look at all neighbors, every 32 steps (GROMACS
//! prunes its outer list to an inner one in the same way). No result depends on it, since a pair that is left out cannot
//! touch before the list ends (`horizon`).

use super::neighbors::{Neighbors, Status};
use crate::engine::contacts::{ListKind, NOT_LISTED};
use crate::engine::motion::{MotionView, at_offset, offset};
use crate::engine::simd::{ALL_LANES, F64x4, LANES, Vec2x4, lanes, rows};
use crate::physics::scalar::Scalar;

/// Four pairs that are near.
#[derive(Debug, Clone, Copy)]
pub struct NearBlock {
    /// Offsets of bodies i.
    pub own: [u32; LANES],
    /// Offsets of bodies j; at the drum, features.
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
    kind: ListKind,
    /// The bodies of a vacant lane.
    vacant: (u32, u32),
}

/// A pair that has begun to touch: its bodies, and its place among the neighbors.
pub type Opened = ((u32, u32), u32);

impl NearList {
    /// An empty list; vacant lanes refer to the bodies `vacant`.
    pub fn new(kind: ListKind, vacant: (u32, u32)) -> Self {
        Self { blocks: Vec::new(), len: 0, kind, vacant }
    }

    /// Forgets all, keeping the memory.
    pub fn clear(&mut self) {
        self.blocks.clear();
        self.len = 0;
    }

    /// The pairs, four by four.
    #[inline(always)]
    pub fn blocks(&self) -> &[NearBlock] {
        &self.blocks
    }

    /// Appends a pair.
    #[inline]
    pub fn push(&mut self, (own, other): (u32, u32), place: u32) {
        let lane = self.len % LANES;
        if lane == 0 {
            let (own, other) = self.encode(self.vacant);
            self.blocks.push(NearBlock {
                own: [own; LANES],
                other: [other; LANES],
                place: [NOT_LISTED; LANES],
            });
        }
        let (own, other) = self.encode((own, other));
        if let Some(block) = self.blocks.last_mut() {
            (block.own[lane], block.other[lane], block.place[lane]) = (own, other, place);
        }
        self.len += 1;
    }

    fn encode(&self, (own, other): (u32, u32)) -> (u32, u32) {
        (offset(own), self.kind.encode(other))
    }

    /// The bodies of one lane of a block.
    pub fn key(&self, block: usize, lane: usize) -> (u32, u32) {
        let block = &self.blocks[block];
        (at_offset(block.own[lane]), self.kind.decode(block.other[lane]))
    }

    /// Takes out the pairs for which a mask of each block holds.
    #[inline(always)]
    pub fn take_where(&mut self, opened: &mut Vec<Opened>, touching: impl Fn(&NearBlock) -> F64x4) {
        for block in 0..self.blocks.len() {
            let touching = touching(&self.blocks[block]).to_bitmask();
            if touching != 0 {
                self.take(block, touching, opened);
            }
        }
    }

    /// Takes out the pairs of a block that touch, given as bits.
    #[cold]
    #[inline(never)]
    pub fn take(&mut self, block: usize, touching: u32, opened: &mut Vec<Opened>) {
        let vacant = self.encode(self.vacant);
        for lane in (0..LANES).filter(|lane| touching >> lane & 1 == 1) {
            let key = self.key(block, lane);
            let block = &mut self.blocks[block];
            opened.push((key, block.place[lane]));
            (block.own[lane], block.other[lane]) = vacant;
            block.place[lane] = NOT_LISTED;
        }
    }

    /// Fills the list anew with the pairs of particles that may touch while less than the budget is used up.
    pub fn fill_with_pairs(&mut self, neighbors: &Neighbors, motion: impl MotionView, reach: &Reach) {
        self.clear();
        let (pairs, rest) = neighbors.pairs().as_chunks::<LANES>();
        for (block, four) in pairs.iter().enumerate() {
            self.push_near(four, LANES * block, neighbors.status(), motion, reach);
        }
        let mut last = [self.vacant; LANES];
        last[..rest.len()].copy_from_slice(rest);
        self.push_near(&last, LANES * pairs.len(), neighbors.status(), motion, reach);
    }

    /// Appends those of four neighbors that are near; the first of them is at place `first`.
    #[inline(always)]
    fn push_near(
        &mut self,
        pairs: &[(u32, u32); LANES],
        first: usize,
        status: &[Status],
        motion: impl MotionView,
        reach: &Reach,
    ) {
        let apart = between(pairs, |particle| motion.position(offset(particle)));
        let velocity = between(pairs, |particle| motion.velocity(offset(particle)));
        let distance = reach.of(|lane| pairs[lane]);
        // The gap is (d² − reach²) / (d + reach). The approach is over d, which is no less than the reach.
        let excess = apart.dot(apart) - distance * distance;
        let gap = excess.larger(F64x4::ZERO) * reach.inverse_sum;
        let approach = -(apart.dot(velocity)) * (reach.time / distance);
        let far = gap.exceeds(approach.larger(F64x4::ZERO) + reach.budget).to_bitmask();
        if far == ALL_LANES {
            return;
        }
        for lane in (0..LANES).filter(|lane| far >> lane & 1 == 0) {
            let place = first + lane;
            if status.get(place) == Some(&Status::Apart) {
                self.push(pairs[lane], place as u32);
            }
        }
    }
}

/// What the vectors of bodies j have that those of bodies i have not.
#[inline(always)]
fn between(pairs: &[(u32, u32); LANES], vector: impl Fn(u32) -> [f64; 2]) -> Vec2x4 {
    let [own, own_odd] = rows(|lane| vector(pairs[lane].0));
    let [other, other_odd] = rows(|lane| vector(pairs[lane].1));
    Vec2x4::from_rows([other - own, other_odd - own_odd])
}

/// When two particles count as near.
#[derive(Debug, Clone, Copy)]
pub struct Reach<'a> {
    /// The radius [m] where all have the same.
    pub radius: Option<f64>,
    /// The radii [m].
    pub radii: &'a [f64],
    /// 1 / (distance + reach) for the farthest and largest pair of the list of neighbors, and slightly less [1/m].
    pub inverse_sum: F64x4,
    /// The time for which the list is made [s].
    pub time: F64x4,
    /// What changes of displacements may add to the approach [m].
    pub budget: F64x4,
}

impl Reach<'_> {
    /// The sums of the radii of four pairs.
    #[inline(always)]
    fn of(&self, pair: impl Fn(usize) -> (u32, u32)) -> F64x4 {
        match self.radius {
            Some(radius) => F64x4::splat(radius + radius),
            // Vacant lanes refer to bodies that are no particles.
            None => lanes(|lane| {
                let (own, other) = pair(lane);
                let radius = |particle: u32| self.radii.get(particle as usize).copied().unwrap_or_default();
                let sum = radius(own) + radius(other);
                if sum > 0.0 { sum } else { 1.0 }
            }),
        }
    }
}
