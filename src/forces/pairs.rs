//! Slots between particles: those awake are looked at, those in contact are worked out four at a time.
//!
//! Which slots are awake, and which of them touch, is hard to foretell for a CPU. Both are therefore listed by loops
//! without branches.

use super::batch::{Batch, in_use};
use super::bodies::{FlowLanes, Pairs, settle};
use super::slots::SlotSlice;
use super::{Scene, Sink};
use crate::contact::HistoryLanes;
use crate::contact::table::SlotRows;
use crate::energy::StepFlows;
use crate::integrator::Motion;
use crate::lanes::{LANES, Lanes, lanes};
use crate::vector::{dot, larger};

/// Slots searched at a time.
const BLOCK: usize = 128;

/// Evaluates the slots in their order.
pub fn evaluate(scene: Scene, slots: SlotSlice, sink: &mut impl Sink) -> StepFlows {
    let mut pass = Pass { scene, slots, flows: FlowLanes::zero() };
    let mut awake = [0_u32; BLOCK + LANES];
    // Contacts wait here until there are four of them.
    let mut waiting = [0_u32; 2 * BLOCK];
    let mut count = 0;
    for start in (0..pass.slots.wake.len()).step_by(BLOCK) {
        let found = pass.find_awake(start, &mut awake);
        count = pass.find_contacts(&awake[..found], &mut waiting, count);
        let full = count - count % LANES;
        for batch in waiting[..full].chunks_exact(LANES) {
            pass.work_out(&Batch::full(batch), sink);
        }
        waiting.copy_within(full..count, 0);
        count -= full;
    }
    if count > 0 {
        pass.work_out(&Batch::partial(&waiting[..count]), sink);
    }
    pass.flows.total()
}

/// For each set of lanes, as bits: its lanes in front, in their order.
const IN_FRONT: [[u32; LANES]; 1 << LANES] = {
    let mut table = [[0; LANES]; 1 << LANES];
    let mut set = 0;
    while set < table.len() {
        let (mut lane, mut count) = (0, 0);
        while lane < LANES {
            if set >> lane & 1 == 1 {
                table[set][count] = lane as u32;
                count += 1;
            }
            lane += 1;
        }
        set += 1;
    }
    table
};

struct Pass<'a> {
    scene: Scene<'a>,
    slots: SlotSlice<'a>,
    flows: FlowLanes,
}

impl<'a> Pass<'a> {
    #[inline(always)]
    fn motions(&self, slot: usize) -> (&'a Motion, &'a Motion) {
        let motions = self.scene.motions;
        (&motions[self.slots.owner[slot] as usize], &motions[self.slots.other[slot] as usize])
    }

    /// Lists the slots of a block that may matter at this step: a slot sleeps until the particles could have closed
    /// its gap.
    #[inline(always)]
    fn find_awake(&self, start: usize, awake: &mut [u32; BLOCK + LANES]) -> usize {
        let end = (start + BLOCK).min(self.slots.wake.len());
        let (fours, rest) = self.slots.wake[start..end].as_chunks::<LANES>();
        let way = Lanes::splat(self.scene.way);
        let (mut first, mut count) = (start as u32, 0);
        for &four in fours {
            let due = Lanes::new(four).simd_le(way).to_bitmask() as usize;
            // All four are written, those awake in front; the next four overwrite the others.
            let front = &IN_FRONT[due & 15];
            for lane in 0..LANES {
                awake[(count & (BLOCK - 1)) + lane] = first + front[lane];
            }
            count += due.count_ones() as usize;
            first += LANES as u32;
        }
        for &due in rest {
            awake[count & (BLOCK - 1)] = first;
            count += usize::from(due <= self.scene.way);
            first += 1;
        }
        count
    }

    /// Appends to the first `count` of `waiting` those slots whose particles touch, or touched at the last step; puts
    /// the others to sleep. Returns the new count.
    #[inline(always)]
    fn find_contacts(&mut self, awake: &[u32], waiting: &mut [u32; 2 * BLOCK], mut count: usize) -> usize {
        for &slot in awake {
            let (own, other) = self.motions(slot as usize);
            let gap = other.position - own.position;
            let reach = own.radius + other.radius;
            // Each of the two has to go half of the gap, which is (distance² − reach²) / (distance + reach).
            let excess = dot(gap, gap) - reach * reach;
            // Not `||`: a branch here would be foretold wrongly every other time.
            #[allow(clippy::needless_bitwise_bool)]
            let in_contact = (excess < 0.0) | (self.slots.wake[slot as usize] < 0.0);
            self.slots.wake[slot as usize] = self.scene.way + self.scene.half_gap * larger(excess, 0.0);
            waiting[count & (2 * BLOCK - 1)] = slot;
            count += usize::from(in_contact);
        }
        count
    }

    /// Works out the slots of a batch.
    #[inline(always)]
    fn work_out(&mut self, batch: &Batch, sink: &mut impl Sink) {
        let slots = batch.slots;
        let bodies = slots.map(|slot| self.motions(slot));
        let pairs = Pairs::new(bodies);
        let meeting = pairs.meet();
        let history = HistoryLanes::new(|lane| &self.slots.records[slots[lane]].history);
        let keys = slots.map(|slot| self.slots.records[slot].law);
        let law = self.scene.laws.pair_lanes(keys);
        let law = (&law, lanes(|lane| keys[lane].damping), self.scene.step_rate);
        let now = settle(&pairs, (meeting, &history), law, in_use(batch.count), &mut self.flows);

        let forces = now.force().to_array();
        let own_moments = (pairs.own_arm(now.overlap) * now.tangential_force).to_array();
        let other_moments = (pairs.other_arm(now.overlap) * now.tangential_force).to_array();
        let histories = now.to_array();
        for lane in 0..batch.count {
            let slot = slots[lane];
            self.slots.wake[slot] = SlotRows::wake_of(&histories[lane]);
            self.slots.records[slot].history = histories[lane];
            sink.add(self.slots.owner[slot] as usize, forces[lane], own_moments[lane]);
            sink.add(self.slots.other[slot] as usize, -forces[lane], other_moments[lane]);
        }
    }
}
