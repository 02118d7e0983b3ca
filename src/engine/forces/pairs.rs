//! Contacts between particles, four at a time, and what a block of four does in a step, be it of pairs or of walls.
//!
//! Eight blocks go through the stages together: gathering the positions, root and division first, then law, work and
//! scattering. The root of one block then overlaps with the work on others; in one stage each block waits for its own.

use super::Totals;
use super::pass::{ChunkStep, ChunkSums, Scratch};
use super::tallies::{self, BlockRecords};
use crate::engine::contacts::{
    Block, BlockTally, ContactList, Geometry, Ids, ListParameters, PairParameters,
};
use crate::engine::motion::{MotionView, at_offset};
use crate::engine::pair_list::{NearBlock, Neighbors};
use crate::engine::simd::{F64x4, LANES, Vec2x4, differences, lanes};
use crate::physics::columns::{Columns, Of};
use crate::physics::contact::gross_work::GrossWork;
use crate::physics::contact::law::ContactLaw;
use crate::physics::contact::{ContactState, Kinematics, RelativeMotion};
use crate::physics::scalar::Scalar;

/// Blocks that go through the stages together; 4 and 16 are no faster.
const GROUP: usize = 8;

/// Where the bodies of a block meet.
#[derive(Debug, Clone, Copy, Default)]
struct ContactGeometry {
    normal: Vec2x4,
    /// Overlap; below zero where they are apart.
    overlap: F64x4,
}

/// Where the bodies of a group meet. Written before it is read; kept, since clearing it takes time.
#[derive(Debug, Clone, Default)]
pub struct GroupGeometry([ContactGeometry; GROUP]);

/// One step of the contacts between particles: those that open, then all, then those that end.
pub fn evaluate<L: ContactLaw, V: MotionView>(
    list: &mut ContactList<L>,
    neighbors: &mut Neighbors,
    step: &mut ChunkStep<V>,
) {
    find_touching(neighbors, step);
    if !step.open(list, neighbors) {
        return;
    }
    let ContactList { ids, blocks, other_moments, tallies, parameters, .. } = list;
    let lists = PassLists { ids, blocks, other_moments, tallies };
    match parameters {
        ListParameters::Same(same) => {
            let unit = same.1.radius.min(same.1.other_radius);
            let parameters = || {
                let own = PairParameters::<L>::map(same, F64x4::splat);
                move |_| own
            };
            // Equal bodies have one moment unless the law rolls: code for the other case would never run.
            if L::ROLLS {
                run::<L, V, _, true, false>(lists, parameters, unit, step);
            } else {
                run::<L, V, _, false, false>(lists, parameters, unit, step);
            }
        }
        ListParameters::Each(each) => {
            let parameters = || |block: usize| PairParameters::<L>::map(&each[block], F64x4::new);
            run::<L, V, _, true, true>(lists, parameters, 1.0, step);
        }
    }
    step.close(list, neighbors);
}

/// Takes the pairs that touch out of the near list.
fn find_touching<V: MotionView>(neighbors: &mut Neighbors, step: &mut ChunkStep<V>) {
    let (motion, bodies, opened) = (step.motion, step.inputs.bodies, &mut step.scratch.opened);
    let squared_distance = |near: &NearBlock| {
        let (own, other) = (|lane: usize| near.own[lane], |lane: usize| near.other[lane]);
        let apart = differences(|lane| motion.position(own(lane)), |lane| motion.position(other(lane)));
        apart.dot(apart)
    };
    // A loop for each: one that asks takes 3 % more instructions in all.
    if let Some(radius) = bodies.radius {
        let reach = F64x4::splat((radius + radius) * (radius + radius));
        neighbors.near.take_where(opened, |near| reach.simd_gt(squared_distance(near)).to_bitmask());
    } else {
        let radius = |offset: u32| bodies.radius_of(at_offset(offset));
        neighbors.near.take_where(opened, |near| {
            let reach = lanes(|lane| radius(near.own[lane]) + radius(near.other[lane]));
            (reach * reach).simd_gt(squared_distance(near)).to_bitmask()
        });
    }
}

/// What a pass goes through, by block.
struct PassLists<'a, L: ContactLaw> {
    ids: &'a [Ids],
    blocks: &'a mut [Block<L>],
    other_moments: &'a mut [[f64; LANES]],
    tallies: &'a mut [BlockTally],
}

/// One pass over a list. With `BOTH`, moments on bodies j are kept apart from those on bodies i; with `MIXED`, radii differ,
/// and depths are ratios: otherwise lengths in units of `unit`.
///
/// Parameters become lanes, and sums are opened and closed, in here: handed over, they would go through memory once more, which
/// is some 30 instructions of a step.
#[inline(never)]
fn run<L: ContactLaw, V: MotionView, P, const BOTH: bool, const MIXED: bool>(
    PassLists { ids, blocks, other_moments, tallies }: PassLists<L>,
    parameters: impl FnOnce() -> P,
    unit: f64,
    step: &mut ChunkStep<V>,
) where
    P: Fn(usize) -> Of<PairParameters<L>, F64x4>,
{
    let (parameters, mut totals) = (parameters(), step.totals.open());
    let records_gross_work = L::IS_RECORDED && step.inputs.records_gross_work;
    let ChunkStep {
        sums,
        totals: kept,
        scratch: Scratch { group: GroupGeometry(geometries), ended, .. },
        ..
    } = step;
    let (motion, time) = (step.motion, step.inputs.time);
    for (group, (blocks, ids)) in blocks.chunks_mut(GROUP).zip(ids.chunks(GROUP)).enumerate() {
        let first = GROUP * group;
        contact_geometries(|block| parameters(first + block).1, ids, motion, geometries);
        for (index, ((block, ids), geometry)) in blocks.iter_mut().zip(ids).zip(&*geometries).enumerate() {
            let index = first + index;
            let other = if BOTH { Some(&mut other_moments[index]) } else { None };
            let tally = if L::IS_RECORDED { tallies.get_mut(index) } else { None };
            let touching = advance::<L, V, BOTH, MIXED>(
                block,
                ids,
                geometry,
                &parameters(index),
                other,
                motion,
                time,
                sums,
                &mut totals,
                BlockRecords {
                    gross_work: records_gross_work.then_some(&mut kept.gross_work),
                    tally,
                    at_wall: false,
                },
            );
            ended.note(index, touching);
        }
    }
    step.totals.close(&totals, unit);
}

/// Where the bodies of some blocks meet. A function of its own, for which the registers suffice.
#[inline(never)]
fn contact_geometries(
    radii: impl Fn(usize) -> Geometry<F64x4>,
    ids: &[Ids],
    motion: impl MotionView,
    geometries: &mut [ContactGeometry; GROUP],
) {
    for (index, (ids, geometry)) in ids.iter().zip(geometries).enumerate() {
        let Geometry { radius, other_radius } = radii(index);
        let apart = between(ids, |particle| motion.position(particle));
        let distance = apart.dot(apart).sqrt();
        let normal = apart.scaled(F64x4::ONE / distance);
        *geometry = ContactGeometry { normal, overlap: (radius + other_radius) - distance };
    }
}

/// One step of a block: relative motion, law, work, forces. Returns which lanes touch.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
fn advance<L: ContactLaw, V: MotionView, const BOTH: bool, const MIXED: bool>(
    block: &mut Block<L>,
    ids: &Ids,
    &ContactGeometry { normal, overlap }: &ContactGeometry,
    (law, geometry): &Of<PairParameters<L>, F64x4>,
    other_moment: Option<&mut [f64; LANES]>,
    view: V,
    time: [f64; 2],
    sums: &mut ChunkSums<V>,
    totals: &mut Totals<F64x4>,
    records: BlockRecords,
) -> u32 {
    let velocity = between(ids, |particle| view.velocity(particle));
    let spin = lanes(|lane| view.angular_velocity(ids.own[lane]));
    let other_spin = lanes(|lane| view.angular_velocity(ids.other[lane]));
    // Bodies touch halfway into the overlap.
    let half = overlap.larger(F64x4::ZERO) * 0.5;
    let (arm, other_arm) = (geometry.radius - half, geometry.other_radius - half);
    let turning = if BOTH { arm * spin + other_arm * other_spin } else { arm * (spin + other_spin) };
    let motion = RelativeMotion {
        overlap,
        separation_rate: velocity.dot(normal),
        slip_rate: normal.cross(velocity) - turning,
        rolling_rate: spin - other_spin,
    };
    let step = evaluate_block::<L>(block, law, &motion, (normal, arm), time, totals, records);

    let moment = step.moment;
    let moment_on_other = if BOTH { other_arm * step.tangential - step.rolling_moment } else { moment };
    // Each force is charged half of the displacement: the trapezoid of the step.
    let both = Vec2x4 { x: step.force.x + step.last.force_x, y: step.force.y + step.last.force_y };
    let mut power = both.dot(velocity);
    if let Some(kept) = other_moment {
        power += (moment + step.last.moment) * spin + (moment_on_other + F64x4::new(*kept)) * other_spin;
        *kept = moment_on_other.to_array();
    } else {
        power += (moment + step.last.moment) * (spin + other_spin);
    }
    totals.power -= power;
    let depth = if MIXED { overlap / geometry.radius.smaller(geometry.other_radius) } else { step.overlap };
    totals.deepest = depth.larger(totals.deepest);
    let (moments, other_moments) = (moment.to_array(), moment_on_other.to_array());
    for (lane, force) in step.force.to_array().into_iter().enumerate() {
        sums.subtract(ids.own[lane], force, moments[lane]);
        sums.add(ids.other[lane], force, other_moments[lane]);
    }
    step.touching
}

/// What four contacts do in a step.
pub struct BlockForces {
    /// Force on body j.
    pub force: Vec2x4,
    /// Its part along the tangent.
    pub tangential: F64x4,
    /// Rolling moment on body i.
    pub rolling_moment: F64x4,
    /// Moment on body i about its center.
    pub moment: F64x4,
    /// Overlap, at least 0.
    pub overlap: F64x4,
    /// What was kept of the last step.
    pub last: ContactState<F64x4>,
    /// Which lanes touch.
    pub touching: u32,
}

/// Evaluates the law for bodies that move like this and meet along `normal`; `arm` is from the centers of bodies i to the points
/// of contact.
#[inline(always)]
pub fn evaluate_block<L: ContactLaw>(
    block: &mut Block<L>,
    law: &Of<L::Parameters, F64x4>,
    motion: &RelativeMotion<F64x4>,
    (normal, arm): (Vec2x4, F64x4),
    time: [f64; 2],
    totals: &mut Totals<F64x4>,
    records: BlockRecords,
) -> BlockForces {
    let last = ContactState::map(&block.state, F64x4::new);
    let history = L::History::map(&block.history, F64x4::new);
    let contact = Kinematics::new(motion, &last, time.map(F64x4::splat));
    let (response, history) = L::respond(law, &contact, &history);
    let (along_normal, tangential) = (response.normal_force, response.tangential_force);
    let force = Vec2x4 {
        x: normal.x * along_normal + normal.y * tangential,
        y: normal.y * along_normal - normal.x * tangential,
    };
    let moment = if L::ROLLS { arm * tangential + response.rolling_moment } else { arm * tangential };
    totals.add_flows(L::FLOWS, &response.flows);
    if L::IS_RECORDED
        && let Some(tally) = records.tally
    {
        tallies::add::<L>(tally, &contact, &response, records.at_wall);
    }
    if L::IS_RECORDED
        && let Some(sums) = records.gross_work
    {
        // The last force as the normal and the tangent of now see it.
        let (x, y) = (last.force_x, last.force_y);
        let last_force = [x * normal.x + y * normal.y, x * normal.y - y * normal.x];
        tallies::add_gross_work(sums, &GrossWork::of_step(&contact, last_force, [along_normal, tangential]));
    }
    block.state = ContactState {
        overlap: contact.overlap.to_array(),
        separation_rate: contact.last_rate.to_array(),
        force_x: force.x.to_array(),
        force_y: force.y.to_array(),
        moment: moment.to_array(),
    };
    block.history = L::History::map(&history, F64x4::to_array);
    BlockForces {
        force,
        tangential,
        rolling_moment: response.rolling_moment,
        moment,
        overlap: contact.overlap,
        last,
        touching: contact.touching.to_bitmask(),
    }
}

/// What the vectors of bodies j have that those of bodies i have not.
#[inline(always)]
fn between(ids: &Ids, vector: impl Fn(u32) -> [f64; 2]) -> Vec2x4 {
    differences(|lane| vector(ids.own[lane]), |lane| vector(ids.other[lane]))
}
