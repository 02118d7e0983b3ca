//! Slots between particles: blocks of slots are searched for those that matter, which are then worked out.

use super::bodies::{Meeting, Pair, settle};
use super::slots::SlotSlice;
use super::{Scene, Sink};
use crate::contact::History;
use crate::energy::StepFlows;
use crate::integrator::Motion;
use crate::vector::dot;

/// Slots searched at a time. The search is a short loop without branches, and most slots do not touch.
const BLOCK: usize = 64;

/// Evaluates the slots in their order.
pub fn evaluate(scene: Scene, slots: SlotSlice, sink: &mut impl Sink) -> StepFlows {
    let mut flows = StepFlows::default();
    let mut found = [0_u32; BLOCK];
    let blocks = slots.owner.chunks(BLOCK).zip(slots.other.chunks(BLOCK));
    let states = slots.histories.chunks_mut(BLOCK).zip(slots.laws.chunks(BLOCK));
    for ((owner, other), (histories, laws)) in blocks.zip(states) {
        let count = search(scene.motions, (owner, other), histories, &mut found);
        for &slot in &found[..count] {
            let slot = slot as usize;
            let (i, j, history) = (owner[slot] as usize, other[slot] as usize, &mut histories[slot]);
            let pair = Pair { own: &scene.motions[i], other: &scene.motions[j] };
            let law = scene.laws.pair(laws[slot]);
            let damping = laws[slot].damping;
            settle(&pair, meet(&pair), (damping, scene.step_rate), history, &mut flows, |encounter, past| {
                law.respond(encounter, past)
            });
            let (force, tangential) = (history.force(), history.tangential_force);
            sink.add(i, force, pair.own_arm(history.overlap) * tangential);
            sink.add(j, -force, pair.other_arm(history.overlap) * tangential);
        }
    }
    flows
}

/// Lists the slots whose particles touch, or touched at the last step; returns their number.
#[inline]
fn search(
    motions: &[Motion],
    (owner, other): (&[u32], &[u32]),
    histories: &[History],
    found: &mut [u32; BLOCK],
) -> usize {
    let mut count = 0;
    for (slot, ((&i, &j), history)) in owner.iter().zip(other).zip(histories).enumerate() {
        let (own, other) = (&motions[i as usize], &motions[j as usize]);
        let gap = other.position - own.position;
        let reach = own.radius + other.radius;
        let matters = (dot(gap, gap) < reach * reach) | history.is_touching();
        found[count & (BLOCK - 1)] = slot as u32;
        count += usize::from(matters);
    }
    count
}

#[inline]
fn meet(pair: &Pair) -> Meeting {
    let gap = pair.other.position - pair.own.position;
    let distance = dot(gap, gap).sqrt();
    Meeting { overlap: pair.own.radius + pair.other.radius - distance, normal: gap * (1.0 / distance) }
}
