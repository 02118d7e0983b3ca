//! Contacts of particles with the drum, four at a time: those with the rim, and what all of them share.

use wide::f64x2;

use super::pairs::{BlockForces, evaluate_block};
use super::pass::{ChunkStep, ChunkSums, Scratch};
use super::tallies::BlockRecords;
use super::{StepInputs, SurfaceLoad, Totals};
use crate::engine::contacts::{
    Block, BlockTally, ContactList, Geometry, Ids, ListParameters, PairParameters,
};
use crate::engine::motion::{MotionView, at_offset};
use crate::engine::pair_list::Neighbors;
use crate::engine::simd::{F64x4, LANES, Vec2x4, lanes, sum, vectors};
use crate::physics::columns::{Columns, Of};
use crate::physics::contact::RelativeMotion;
use crate::physics::contact::law::ContactLaw;
use crate::physics::scalar::Scalar;
use crate::physics::vector::Vec2;

/// Where four particles meet the drum.
#[derive(Debug, Clone, Copy)]
pub struct ContactGeometry {
    /// Towards the drum.
    pub normal: Vec2x4,
    /// Overlap; not above zero where they are apart.
    pub overlap: F64x4,
    /// From the centers to the points of contact, which are on the drum's surface [m].
    pub arm: F64x4,
    /// Velocity of the surface there, along the normal and along the tangent [m/s].
    pub surface_rates: [F64x4; 2],
}

/// One step of the contacts with the rim: those that open, then all, then those that end. Returns what the rim does to the
/// load.
pub fn evaluate_rim<L: ContactLaw, V: MotionView>(
    list: &mut ContactList<L>,
    neighbors: &mut Neighbors,
    step: &mut ChunkStep<V>,
) -> SurfaceLoad {
    find_touching_rim(neighbors, step);
    if !step.open(list, neighbors) {
        return SurfaceLoad::default();
    }
    let ContactList { ids, blocks, tallies, parameters, .. } = list;
    let load = match parameters {
        // The plain law has code of its own for equal bodies: 1 % fewer instructions of a step. Others do without: there are many,
        // and each takes its share of the program's size.
        ListParameters::Same(same) if !L::HAS_TERMS && !L::IS_RECORDED => {
            let (law, radii) = PairParameters::<L>::map(same, F64x4::splat);
            rim_pass::<L, V>(ids, blocks, tallies, |_| (law, radii, F64x4::ONE), same.1.radius, step)
        }
        parameters => {
            let shared = parameters.shared();
            let by_block = parameters.by_block(&shared);
            // Depths of equal bodies become ratios at the end.
            let are_equal = F64x4::splat(f64::from(u8::from(shared.is_some()))).exceeds(F64x4::ZERO);
            let parameters = |block| {
                let (law, radii) = by_block.of(block);
                (law, radii, F64x4::select(are_equal, F64x4::ONE, radii.radius))
            };
            let unit = shared.map_or(1.0, |(_, radii)| radii.radius[0]);
            rim_pass::<L, V>(ids, blocks, tallies, parameters, unit, step)
        }
    };
    step.close(list, neighbors);
    load
}

/// Takes the particles that touch the rim out of the near list.
fn find_touching_rim<V: MotionView>(neighbors: &mut Neighbors, step: &mut ChunkStep<V>) {
    let (motion, bodies, opened) = (step.motion, step.inputs.bodies, &mut step.scratch.opened);
    let Some(rim) = step.inputs.drum.radius() else { return };
    let same = bodies.radius.map(|radius| F64x4::splat((rim - radius) * (rim - radius)));
    neighbors.near.take_where(opened, |near| {
        let position = vectors(|lane| motion.position(near.own[lane]));
        let free = same.unwrap_or_else(|| {
            let free = lanes(|lane| rim - bodies.radius_of(at_offset(near.own[lane])));
            free * free
        });
        position.dot(position).simd_gt(free).to_bitmask()
    });
}

/// One pass over the contacts with the rim. By block, `parameters` tells law, radii, and the unit of depths, which are multiplied
/// by `1 / unit` at the end.
#[inline(always)]
fn rim_pass<L: ContactLaw, V: MotionView>(
    ids: &[Ids],
    blocks: &mut [Block<L>],
    tallies: &mut [BlockTally],
    parameters: impl Fn(usize) -> (Of<L::Parameters, F64x4>, Geometry<F64x4>, F64x4),
    unit: f64,
    step: &mut ChunkStep<V>,
) -> SurfaceLoad {
    let mut totals = step.totals.open();
    let ChunkStep { motion, inputs, sums, totals: kept, scratch: Scratch { ended, .. }, .. } = step;
    let motion = *motion;
    let Some(rim) = inputs.drum.radius() else { return SurfaceLoad::default() };
    let zero = F64x4::ZERO;
    let (mut moment, mut force) = (zero, Vec2x4::default());
    let (rim, speed) = (F64x4::splat(rim), F64x4::splat(inputs.angular_velocity));
    for (index, (block, ids)) in blocks.iter_mut().zip(ids).enumerate() {
        let (law, radii, depth_unit) = parameters(index);
        let position = vectors(|lane| motion.position(ids.own[lane]));
        let distance = position.dot(position).sqrt();
        let overlap = distance - (rim - radii.radius);
        let arm = radii.radius - overlap.larger(zero);
        let geometry = ContactGeometry {
            normal: position.scaled(F64x4::ONE / distance),
            overlap,
            arm,
            // The rim moves along itself.
            surface_rates: [zero, speed * (distance + arm)],
        };
        let records = wall_records::<L>(tallies.get_mut(index), kept, inputs);
        let step = advance::<L, V>(
            block,
            ids,
            &geometry,
            &law,
            depth_unit,
            motion,
            inputs,
            sums,
            &mut totals,
            records,
        );
        moment += step.moment - position.cross(step.force);
        force = force.plus(step.force);
        ended.note(index, step.touching);
    }
    kept.close(&totals, unit);
    let total = |lanes: F64x4| sum(lanes.to_array());
    SurfaceLoad { force: Vec2::new(-total(force.x), -total(force.y)), moment: total(moment) }
}

/// What is recorded of a block of contacts with the drum.
#[inline(always)]
pub fn wall_records<'a, L: ContactLaw>(
    tally: Option<&'a mut BlockTally>,
    kept: &'a mut Totals,
    inputs: &StepInputs,
) -> BlockRecords<'a> {
    let records_gross_work = L::IS_RECORDED && inputs.records_gross_work;
    BlockRecords {
        gross_work: records_gross_work.then_some(&mut kept.gross_work),
        tally: tally.filter(|_| L::IS_RECORDED),
        at_wall: true,
    }
}

/// One step of a block: relative motion, law, work on the particles, forces. Depths are in units of `unit`. Returns what it does to
/// the drum.
#[allow(clippy::too_many_arguments)]
#[inline(always)]
pub fn advance<L: ContactLaw, V: MotionView>(
    block: &mut Block<L>,
    ids: &Ids,
    geometry: &ContactGeometry,
    law: &Of<L::Parameters, F64x4>,
    unit: F64x4,
    view: V,
    inputs: &StepInputs,
    sums: &mut ChunkSums<V>,
    totals: &mut Totals<F64x4>,
    records: BlockRecords,
) -> BlockForces {
    let velocity = vectors(|lane| view.velocity(ids.own[lane]));
    let spin = lanes(|lane| view.angular_velocity(ids.own[lane]));
    let &ContactGeometry { normal, overlap, arm, surface_rates: [separation, sliding] } = geometry;
    let motion = RelativeMotion {
        overlap,
        separation_rate: separation - velocity.dot(normal),
        slip_rate: sliding - normal.cross(velocity) - arm * spin,
        rolling_rate: spin - F64x4::splat(inputs.angular_velocity),
    };
    let step = evaluate_block::<L>(block, law, &motion, (normal, arm), inputs.time, totals, records);
    let both = Vec2x4 { x: step.force.x + step.last.force_x, y: step.force.y + step.last.force_y };
    // What the drum does is charged to its surfaces: this is the work on the particles alone.
    totals.power -= (step.moment + step.last.moment) * spin - both.dot(velocity);
    totals.deepest = (step.overlap / unit).larger(totals.deepest);
    let moments = step.moment.to_array();
    let forces: [f64x2; LANES] = step.force.to_array();
    for lane in 0..LANES {
        sums.subtract(ids.own[lane], forces[lane], moments[lane]);
    }
    step
}
