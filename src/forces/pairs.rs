//! Contacts between particles: candidates that are awake are looked at, contacts are worked out four at a time.

use super::bodies::{FlowLanes, Meeting, Pairs, settle};
use super::post::Sink;
use super::{Scene, in_use};
use crate::contact::block::{Block, Ends, Traits, TraitsLanes};
use crate::contact::linear::LinearLanes;
use crate::contact::list::ListTraits;
use crate::contact::table::{Candidates, Slots};
use crate::energy::StepFlows;
use crate::lanes::{LANES, Lanes, Vec2Lanes, lanes, transpose};

/// Candidates searched at a time; a power of two.
const BLOCK: usize = 128;

/// Blocks of contacts that go through the stages of a step together: so many that the stages' latencies overlap, so few
/// that they stay in the cache.
const GROUP: usize = 8;

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

/// Evaluates the pairs of one chunk in key order.
pub fn evaluate(scene: Scene, slots: &mut Slots, sink: &mut Sink) -> StepFlows {
    open_contacts(scene, slots);
    let laws = scene.laws.pairs();
    let len = slots.contacts.len();
    let (ends, blocks, traits) = slots.contacts.parts_mut();
    let (flows, all_touch) = match traits {
        // In a load of equal bundles law and traits are read once.
        ListTraits::Same(same) => {
            let (law, traits) = (LinearLanes::splat(&laws[same.law.law as usize]), TraitsLanes::splat(same));
            work_through(scene, (ends, blocks, len), sink, |_| (law, traits))
        }
        ListTraits::Each(each) => work_through(scene, (ends, blocks, len), sink, |block| {
            let own = &each[block];
            (LinearLanes::new(|lane| &laws[own.laws()[lane] as usize]), own.lanes())
        }),
    };
    if !all_touch {
        slots.close_ended();
    }
    flows.total()
}

/// Works out all contacts; returns the flows, and whether all of them still touch.
#[inline(always)]
fn work_through(
    scene: Scene,
    (ends, blocks, len): (&[Ends], &mut [Block], usize),
    sink: &mut Sink,
    traits_of: impl Fn(usize) -> (LinearLanes, TraitsLanes),
) -> (FlowLanes, bool) {
    let mut flows = FlowLanes::zero();
    let mut all_touch = true;
    let mut met = [Met::none(); GROUP];
    let (full, rest) = blocks.split_at_mut(len / LANES);
    for (group, (blocks, ends)) in full.chunks_mut(GROUP).zip(ends.chunks(GROUP)).enumerate() {
        let first = GROUP * group;
        for (index, (ends, met)) in ends.iter().zip(&mut met).enumerate().take(blocks.len()) {
            *met = meet(scene, ends, &traits_of(first + index).1);
        }
        for (index, (block, met)) in blocks.iter_mut().zip(&mut met).enumerate() {
            let (law, traits) = traits_of(first + index);
            let law = (&law, traits.damping, scene.step_rate);
            all_touch &= work_out((block, LANES), met, law, &mut flows);
        }
        for (ends, met) in ends.iter().zip(&met).take(blocks.len()) {
            load((ends, LANES), &met.loads, sink);
        }
    }
    if let (Some(block), Some(ends)) = (rest.first_mut(), ends.last()) {
        let (law, traits) = traits_of(len / LANES);
        let mut met = meet(scene, ends, &traits);
        let law = (&law, traits.damping, scene.step_rate);
        all_touch &= work_out((block, len % LANES), &mut met, law, &mut flows);
        load((ends, len % LANES), &met.loads, sink);
    }
    (flows, all_touch)
}

/// Makes contacts of the candidates that touch; puts the others to sleep until the particles could have closed the gap.
fn open_contacts(scene: Scene, slots: &mut Slots) {
    let mut due = [0; BLOCK + LANES];
    let fours = slots.candidates.fours();
    for start in (0..fours).step_by(BLOCK / LANES) {
        let end = fours.min(start + BLOCK / LANES);
        let count = find_due(&slots.candidates, start..end, scene.way, &mut due);
        // The last four are filled up with the last one.
        let last = due[count.saturating_sub(1)];
        due[count..count + LANES].fill(last);
        for four in due[..count.next_multiple_of(LANES)].as_chunks().0 {
            look_at(scene, slots, four);
        }
    }
}

/// Lists the candidates that are due, without a branch that a CPU could not foretell. Returns their number.
fn find_due(
    candidates: &Candidates,
    fours: std::ops::Range<usize>,
    way: f64,
    due: &mut [u32; BLOCK + LANES],
) -> usize {
    let way = Lanes::splat(way);
    let mut count = 0;
    for four in fours {
        let set =
            Lanes::new(candidates.wakes(four)).simd_le(way).to_bitmask() as usize & (IN_FRONT.len() - 1);
        // All four are written, those that are due in front; the next four overwrite the others.
        let first = (LANES * four) as u32;
        for (lane, front) in IN_FRONT[set].iter().enumerate() {
            due[(count & (BLOCK - 1)) + lane] = first + front;
        }
        count += set.count_ones() as usize;
    }
    count.min(BLOCK)
}

/// Looks at four candidates.
fn look_at(scene: Scene, slots: &mut Slots, due: &[u32; LANES]) {
    let candidates = &mut slots.candidates;
    let bodies = due.map(|candidate| candidates.bodies(candidate as usize));
    let own = bodies.map(|pair| &scene.motions[pair.owner as usize]);
    let other = bodies.map(|pair| &scene.motions[pair.other as usize]);
    let [gap_x, gap_y, ..] = transpose(std::array::from_fn(|lane| other[lane].place - own[lane].place));
    // Each of the two has to go half of the gap, which is (distance² − reach²) / (distance + reach).
    let reach = lanes(|lane| own[lane].radius() + other[lane].radius());
    let excess = gap_x * gap_x + gap_y * gap_y - reach * reach;
    let sleep = Lanes::splat(scene.way) + excess.fast_max(Lanes::ZERO) * scene.half_gap;
    for (&candidate, until) in due.iter().zip(sleep.to_array()) {
        candidates.sleep(candidate as usize, until);
    }
    if !excess.simd_lt(Lanes::ZERO).any() {
        return;
    }
    for lane in 0..LANES {
        // Candidates that fill up the last four come again.
        let again = due[..lane].contains(&due[lane]);
        if excess.to_array()[lane] < 0.0 && !again {
            open(scene, slots, due[lane] as usize);
        }
    }
}

#[cold]
fn open(scene: Scene, slots: &mut Slots, candidate: usize) {
    let (owner, other) = slots.candidates.key(candidate);
    let (i, j) = (owner as usize, other as usize);
    let particles = scene.particles;
    let body = |id: usize| (particles.materials[id], particles.masses[id]);
    let law = scene.laws.pair_slot(body(i), body(j));
    slots.open(candidate, Traits { law, radii: [particles.radii[i], particles.radii[j]] });
}

/// A block between the stages of its step.
#[derive(Debug, Clone, Copy)]
struct Met {
    bodies: Pairs,
    meeting: Meeting,
    /// On the owners: force, x and y, and moment; then the moment on the others with its sign turned round.
    loads: [Lanes; LANES],
}

impl Met {
    fn none() -> Self {
        let (zero, none) = (Lanes::ZERO, Vec2Lanes { x: Lanes::ZERO, y: Lanes::ZERO });
        Self { bodies: Pairs::none(), meeting: Meeting { overlap: zero, normal: none }, loads: [zero; LANES] }
    }
}

/// Gathers the bodies of a block.
#[inline(always)]
fn meet(scene: Scene, ends: &Ends, traits: &TraitsLanes) -> Met {
    let motion = |id: u32| &scene.motions[id as usize];
    let (bodies, meeting) = Pairs::meet(ends.owner.map(motion), ends.other.map(motion), traits.radii);
    Met { bodies, meeting, loads: [Lanes::ZERO; LANES] }
}

/// Works out the first `count` contacts of a block; returns whether all of them still touch.
#[inline(always)]
fn work_out(
    (block, count): (&mut Block, usize),
    met: &mut Met,
    law: (&LinearLanes, Lanes, f64),
    flows: &mut FlowLanes,
) -> bool {
    let (pairs, history, used) = (met.bodies, block.history(), in_use(count));
    let now = settle(&pairs, (met.meeting, &history), law, used, flows);
    block.remember(&now);
    let force = now.force();
    let own_moment = pairs.own_arm(now.overlap) * now.tangential_force;
    let other_moment = pairs.other_arm(now.overlap) * now.tangential_force;
    met.loads = [force.x, force.y, own_moment, -other_moment];
    !(used & now.overlap.simd_le(Lanes::ZERO)).any()
}

/// Brings the loads of the first `count` contacts of a block to their particles, in key order.
#[inline(always)]
fn load((ends, count): (&Ends, usize), loads: &[Lanes; LANES], sink: &mut Sink) {
    for (lane, row) in transpose(*loads).into_iter().enumerate().take(count) {
        sink.add(ends.owner[lane], row);
        let [x, y, own_moment, other_moment] = row.to_array();
        sink.take_off(ends.other[lane], Lanes::new([x, y, other_moment, own_moment]));
    }
}
