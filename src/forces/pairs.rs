//! Contacts between particles: candidates that are awake are looked at, contacts are worked out four at a time.

use std::array;
use std::ops::Range;

use super::Scene;
use super::ahead::Ahead;
use super::bodies::{FlowLanes, Met, Pairs, settle};
use super::motions::Motions;
use super::post::Sink;
use crate::contact::block::{Block, Ends, TraitsLanes};
use crate::contact::candidates::{Candidate, Candidates};
use crate::contact::clock::StepClock;
use crate::contact::linear::LinearLanes;
use crate::contact::list::ListTraits;
use crate::contact::table::Slots;
use crate::lanes::{
    EIGHT_IN_FRONT, LANES, Lanes, ROW, Row, Vec2Lanes, WholeRow, align_stack, lanes, transpose,
};
use crate::physics::energy::StepFlows;

/// Candidates that are looked at together at most; a power of two.
const MOST_DUE: usize = 512;

/// Blocks of contacts that go through the stages of a step together: so many that the stages' latencies overlap, so few
/// that they stay in the cache.
const GROUP: usize = 8;

/// Steps that a candidate may sleep: so few that clocks, which are numbers of half the size, count exactly.
const LONGEST_SLEEP: f64 = 1e6;

/// What the work on a chunk writes before it reads; kept, since clearing it costs small loads a twentieth.
#[derive(Debug, Clone)]
pub struct Scratch {
    /// Candidates that are due, in fours of one patch.
    due: [u32; MOST_DUE + ROW],
    bodies: [Candidate; MOST_DUE + ROW],
    /// The patches of the fours.
    patches: [u32; MOST_DUE / LANES + 1],
    fours: usize,
    met: [Met; GROUP],
    loads: [[Lanes; LANES]; GROUP],
}

impl Default for Scratch {
    fn default() -> Self {
        Self {
            due: [0; MOST_DUE + ROW],
            bodies: [Candidate { owner: 0, other: 0 }; MOST_DUE + ROW],
            patches: [0; MOST_DUE / LANES + 1],
            fours: 0,
            met: [Met::none(); GROUP],
            loads: [[Lanes::ZERO; LANES]; GROUP],
        }
    }
}

/// Evaluates the pairs of one chunk in key order.
pub fn evaluate(
    scene: Scene<impl Motions>,
    slots: &mut Slots<StepClock>,
    (sink, ahead): (&mut Sink, &mut Ahead<impl Motions>),
    scratch: &mut Scratch,
) -> StepFlows {
    align_stack();
    open_contacts(scene, slots, ahead, scratch);
    let laws = scene.laws.pairs();
    if slots.contacts.is_empty() {
        return StepFlows::default();
    }
    let (ends, blocks, traits) = slots.contacts.parts_mut();
    let (all_touch, flows) = match traits {
        // In a load of equal bundles law and traits are read once.
        ListTraits::Same(same) => {
            let (law, traits) = (LinearLanes::splat(&laws[same.law.law as usize]), TraitsLanes::splat(same));
            let of = |_| (law, traits);
            let flows = work_through(scene, (ends, blocks), (sink, ahead, scratch), of, |overlap, _| overlap);
            (flows.all_touch(), flows.total(same.radii[0].min(same.radii[1])))
        }
        ListTraits::Each(each) => {
            let of = |block: usize| {
                let own = &each[block];
                (LinearLanes::new(|lane| &laws[own.laws()[lane] as usize]), own.lanes())
            };
            let ratio = |overlap, [own, other]: [Lanes; 2]| overlap / own.fast_min(other);
            let flows = work_through(scene, (ends, blocks), (sink, ahead, scratch), of, ratio);
            (flows.all_touch(), flows.total(1.0))
        }
    };
    if !all_touch {
        slots.close_ended();
    }
    flows
}

/// Works out all contacts. `depth` is what an overlap between bodies of the given radii is judged by.
#[inline(always)]
fn work_through(
    scene: Scene<impl Motions>,
    (ends, blocks): (&[Ends], &mut [Block]),
    (sink, ahead, scratch): (&mut Sink, &mut Ahead<impl Motions>, &mut Scratch),
    traits_of: impl Fn(usize) -> (LinearLanes, TraitsLanes),
    depth: impl Fn(Lanes, [Lanes; 2]) -> Lanes,
) -> FlowLanes {
    let mut flows = FlowLanes::zero();
    let Scratch { met, loads, .. } = scratch;
    for (group, (blocks, ends)) in blocks.chunks_mut(GROUP).zip(ends.chunks(GROUP)).enumerate() {
        ahead.ask();
        let first = GROUP * group;
        for (index, (ends, met)) in ends.iter().zip(&mut *met).enumerate() {
            *met = meet(scene, ends, &traits_of(first + index).1);
        }
        for (index, (block, (met, loads))) in blocks.iter_mut().zip(met.iter().zip(&mut *loads)).enumerate() {
            let (law, traits) = traits_of(first + index);
            *loads = work_out(block, met, (scene.step_rate, &law, &traits), &depth, &mut flows);
        }
        for (ends, loads) in ends.iter().zip(&*loads) {
            load(ends, loads, sink);
        }
    }
    flows
}

/// Makes contacts of the candidates that touch; puts the others to sleep until the particles could have closed the gap.
fn open_contacts(
    scene: Scene<impl Motions>,
    slots: &mut Slots<StepClock>,
    ahead: &mut Ahead<impl Motions>,
    scratch: &mut Scratch,
) {
    slots.candidates.follow(scene.patches, |clock, most| clock.advance(most.change + scene.round_off));
    scratch.fours = 0;
    for patch in 0..slots.candidates.patches() {
        debug_assert!(sleepers_are_apart(scene, &slots.candidates, patch), "two bodies touch unseen");
        let mut rows = slots.candidates.rows(patch);
        while !rows.is_empty() {
            if LANES * scratch.fours + ROW > MOST_DUE {
                look_at_due(scene, slots, ahead, scratch);
            }
            ahead.ask();
            let room = (MOST_DUE - LANES * scratch.fours) / ROW;
            let some = rows.start..rows.end.min(rows.start + room);
            rows.start = some.end;
            find_due(&slots.candidates, patch, some, scratch);
        }
    }
    look_at_due(scene, slots, ahead, scratch);
}

/// Looks at the candidates that have been found due.
fn look_at_due(
    scene: Scene<impl Motions>,
    slots: &mut Slots<StepClock>,
    ahead: &mut Ahead<impl Motions>,
    scratch: &mut Scratch,
) {
    align_stack();
    let Scratch { due, patches, bodies, .. } = scratch;
    let due = &due.as_chunks().0[..scratch.fours];
    // All are fetched before any is looked at: where they have left the cache, many reads are then under way at once.
    let bodies = &mut bodies.as_chunks_mut().0[..due.len()];
    for (bodies, due) in bodies.iter_mut().zip(due) {
        *bodies = due.map(|candidate| *slots.candidates.bodies(candidate as usize));
    }
    let fours = bodies.iter().zip(due).zip(&*patches);
    for (index, ((bodies, due), &patch)) in fours.enumerate() {
        if index.is_multiple_of(GROUP) {
            ahead.ask();
        }
        look_at(scene, slots, patch as usize, (due, bodies));
    }
    scratch.fours = 0;
}

/// Whether none of a patch's candidates that sleep touch. Only asked in tests: not to look is what sleep is for.
fn sleepers_are_apart(scene: Scene<impl Motions>, candidates: &Candidates<StepClock>, patch: usize) -> bool {
    let waking = candidates.waking(patch);
    let rows = candidates.rows(patch);
    let wakes = candidates.wakes(rows.clone()).as_flattened();
    wakes.iter().zip(ROW * rows.start..).all(|(&wake, candidate)| {
        // Those that never wake are contacts, or fill a row up.
        if wake <= waking || wake == f32::INFINITY {
            return true;
        }
        let pair = candidates.bodies(candidate);
        let (own, other) = (scene.motions.of(pair.owner), scene.motions.of(pair.other));
        (other.position() - own.position()).norm_squared()
            >= (scene.matter.radius_of(pair.owner) + scene.matter.radius_of(pair.other)).powi(2)
    })
}

/// Finds the candidates that are due in some rows of a patch, without a branch that a CPU could not foretell.
#[inline(always)]
fn find_due(candidates: &Candidates<StepClock>, patch: usize, rows: Range<usize>, scratch: &mut Scratch) {
    let Scratch { due, patches, fours, .. } = scratch;
    let waking = Row::splat(candidates.waking(patch));
    let mut first = WholeRow::splat((ROW * rows.start) as u32);
    let mut count = LANES * *fours;
    for &wakes in candidates.wakes(rows) {
        let set = Row::new(wakes).simd_le(waking).to_bitmask() as usize & (EIGHT_IN_FRONT.len() - 1);
        // The whole row is written, those that are due in front; the next row overwrites the others.
        let place = count & (MOST_DUE - 1);
        due[place..place + ROW].copy_from_slice((WholeRow::new(EIGHT_IN_FRONT[set]) + first).as_array());
        count += set.count_ones() as usize;
        first += WholeRow::splat(ROW as u32);
    }
    // The last four of a patch are filled up with the last one.
    let last = due[count.saturating_sub(1)];
    due[count..count + LANES].fill(last);
    let end = count.div_ceil(LANES);
    patches[*fours..end].fill(patch as u32);
    *fours = end;
}

/// Looks at four candidates of a patch.
fn look_at(
    scene: Scene<impl Motions>,
    slots: &mut Slots<StepClock>,
    patch: usize,
    (due, bodies): (&[u32; LANES], &[Candidate; LANES]),
) {
    let candidates = &mut slots.candidates;
    let clock = *candidates.clock(patch);
    let own = bodies.map(|pair| scene.motions.of(pair.owner));
    let other = bodies.map(|pair| scene.motions.of(pair.other));
    let [gap_x, gap_y, apart_x, apart_y] =
        transpose(array::from_fn(|lane| other[lane].place - own[lane].place));
    let (between, apart) = (Vec2Lanes { x: gap_x, y: gap_y }, Vec2Lanes { x: apart_x, y: apart_y });
    let time_step = scene.time_step;
    let [reach, share] = scene.matter.radius.map_or_else(
        || {
            let radius = |id: u32| scene.matter.radii[id as usize];
            let reach = lanes(|lane| radius(bodies[lane].owner) + radius(bodies[lane].other));
            [reach, Lanes::splat(time_step) / reach]
        },
        |radius| [radius + radius, time_step / (radius + radius)].map(Lanes::splat),
    );
    // The gap is (distance² − reach²) / (distance + reach); the approach in a step is over the distance, which is no less
    // than reach.
    let excess = between.dot(between) - reach * reach;
    let gap = excess.fast_max(Lanes::ZERO) * scene.inverse_reach;
    let approach = -between.dot(apart).fast_min(Lanes::ZERO) * share;
    let sleep = steps_to_touch(gap, approach, Lanes::splat(clock.limit()));
    let sleep = Lanes::splat(clock.steps()) + sleep.fast_min(Lanes::splat(LONGEST_SLEEP));
    // All are rounded before any is written: that takes one instruction.
    let until = sleep.to_array().map(|until| until as f32);
    for (&candidate, until) in due.iter().zip(until) {
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

/// Fewer steps than two particles need to touch, for their gap, for what they approach in a step, and for a limit L of the
/// change of a displacement: k of gap = approach k + L k (k + 1).
#[inline(always)]
fn steps_to_touch(gap: Lanes, approach: Lanes, limit: Lanes) -> Lanes {
    let linear = approach + limit;
    (gap + gap) * (1.0 - 1e-6) / (linear + (linear * linear + limit * gap * 4.0).sqrt())
}

#[cold]
fn open(scene: Scene<impl Motions>, slots: &mut Slots<StepClock>, candidate: usize) {
    let (owner, other) = slots.candidates.key(candidate);
    slots.open(candidate, scene.matter.pair(scene.laws, owner, other));
}

/// Gathers the bodies of a block.
#[inline(always)]
fn meet(scene: Scene<impl Motions>, ends: &Ends, traits: &TraitsLanes) -> Met {
    let motion = |id: u32| scene.motions.of(id);
    Met::new(ends.owner.map(motion), ends.other.map(motion), traits.radii, scene.time_step)
}

/// Works out a block. Returns the forces on the others, x and y, and the moments on them; then the moments on the owners
/// with their sign turned round.
#[inline(always)]
fn work_out(
    block: &mut Block,
    met: &Met,
    (step_rate, law, traits): (f64, &LinearLanes, &TraitsLanes),
    depth: &impl Fn(Lanes, [Lanes; 2]) -> Lanes,
    flows: &mut FlowLanes,
) -> [Lanes; LANES] {
    let pairs = Pairs { met, radii: traits.radii };
    let (history, in_use) = (block.history(), block.in_use());
    let meeting = pairs.meeting().within(in_use);
    let used = (in_use, |overlap| depth(overlap, traits.radii));
    let now = settle(&pairs, (meeting, &history), (law, traits.damping, step_rate), used, flows);
    block.remember(&now);
    let reaction = now.reaction();
    let own_moment = pairs.own_arm(now.overlap) * now.tangential_force;
    let other_moment = pairs.other_arm(now.overlap) * now.tangential_force;
    [reaction.x, reaction.y, other_moment, -own_moment]
}

/// Brings the loads of a block to their particles, in key order; those of vacant lanes are zero.
#[inline(always)]
fn load(ends: &Ends, loads: &[Lanes; LANES], sink: &mut Sink) {
    for (lane, row) in transpose(*loads).into_iter().enumerate() {
        let [x, y, other_moment, own_moment] = row.to_array();
        sink.take_off(ends.owner[lane], Lanes::new([x, y, own_moment, other_moment]));
        sink.react(ends.other[lane], row);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nobody_touches_sooner_than_the_steps_say() {
        for k in 1..3000 {
            let wave = |pace: i32| f64::from(k * pace % 97) / 97.0;
            let (gap, approach, limit) = (wave(31) * 1e-4, wave(57) * 1e-6, 1e-9 + wave(17) * 1e-7);
            let steps =
                steps_to_touch(Lanes::splat(gap), Lanes::splat(approach), Lanes::splat(limit)).to_array()[0];
            // The worst that may happen: from step to step both speed up by the limit.
            let left = |steps: f64| gap - approach * steps - limit * steps * (steps + 1.0);
            assert!(left(steps.floor()) >= 0.0, "{gap} {approach} {limit}");
            assert!(left(steps.floor() + 2.0) < 0.0, "a longer sleep would do: {gap} {approach} {limit}");
        }
    }
}
