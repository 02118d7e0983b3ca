//! Contacts between particles: candidates that are awake are looked at, contacts are worked out four at a time.

use super::bodies::{FlowLanes, Pairs, settle};
use super::post::{Sink, load_rows, reaction};
use super::{Scene, in_use};
use crate::contact::list::Block;
use crate::contact::table::Slots;
use crate::energy::StepFlows;
use crate::lanes::{LANES, Lanes};
use crate::vector::{dot, larger};

/// Evaluates the pairs of one chunk in key order.
pub fn evaluate(scene: Scene, slots: &mut Slots, sink: &mut Sink) -> StepFlows {
    open_contacts(scene, slots);
    let mut flows = FlowLanes::zero();
    let mut all_touch = true;
    let (blocks, len) = slots.contacts.blocks_mut();
    let (full, rest) = blocks.split_at_mut(len / LANES);
    for block in full {
        all_touch &= work_out(scene, block, LANES, &mut flows, sink);
    }
    if let Some(block) = rest.first_mut() {
        all_touch &= work_out(scene, block, len % LANES, &mut flows, sink);
    }
    if !all_touch {
        slots.close_ended();
    }
    flows.total()
}

/// Makes contacts of the candidates that touch; puts the others to sleep until the particles could have closed the gap.
fn open_contacts(scene: Scene, slots: &mut Slots) {
    let way = Lanes::splat(scene.way);
    let fours = slots.candidates.len() / LANES;
    for four in 0..fours {
        let due = Lanes::new(slots.candidates.wake.as_chunks().0[four]).simd_le(way);
        if due.any() {
            for candidate in LANES * four..LANES * (four + 1) {
                look_at(scene, slots, candidate);
            }
        }
    }
    for candidate in LANES * fours..slots.candidates.len() {
        look_at(scene, slots, candidate);
    }
}

#[inline]
fn look_at(scene: Scene, slots: &mut Slots, candidate: usize) {
    let candidates = &mut slots.candidates;
    if candidates.wake[candidate] > scene.way {
        return;
    }
    let (i, j) = (candidates.owner[candidate] as usize, candidates.other[candidate] as usize);
    let (own, other) = (&scene.motions[i], &scene.motions[j]);
    let gap = other.position() - own.position();
    let reach = own.radius() + other.radius();
    // Each of the two has to go half of the gap, which is (distance² − reach²) / (distance + reach).
    let excess = dot(gap, gap) - reach * reach;
    candidates.wake[candidate] = scene.way + scene.half_gap * larger(excess, 0.0);
    if excess < 0.0 {
        let body = |id: usize| (scene.particles.materials[id], scene.particles.masses[id]);
        slots.open(candidate, scene.laws.pair_slot(body(i), body(j)));
    }
}

/// Works out the first `count` contacts of a block; returns whether all of them still touch.
#[inline(always)]
fn work_out(scene: Scene, block: &mut Block, count: usize, flows: &mut FlowLanes, sink: &mut Sink) -> bool {
    let motion = |id: u32| &scene.motions[id as usize];
    let pairs = Pairs::new(block.owner.map(motion), block.other.map(motion));
    let meeting = pairs.meet();
    let history = block.history();
    let law = (&scene.laws.pair_lanes(block.laws()), block.damping(), scene.step_rate);
    let used = in_use(count);
    let now = settle(&pairs, (meeting, &history), law, used, flows);
    block.remember(&now);

    let force = now.force();
    let own_moment = pairs.own_arm(now.overlap) * now.tangential_force;
    let other_moment = pairs.other_arm(now.overlap) * now.tangential_force;
    let rows = load_rows(force.x, force.y, own_moment, other_moment);
    for (lane, &row) in rows.iter().enumerate().take(count) {
        sink.add_to_own(block.owner[lane], row);
        sink.add(block.other[lane], reaction(row));
    }
    !(used & now.overlap.simd_le(Lanes::ZERO)).any()
}
