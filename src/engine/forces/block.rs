//! One step of a block of four contacts: relative motion, law, new state; the same for pairs and for walls.

use super::tallies::{self, BlockRecords};
use super::totals::Totals;
use crate::engine::contacts::Block;
use crate::engine::simd::{F64x4, Vec2x4};
use crate::physics::columns::{Columns, Of};
use crate::physics::contact::gross_work::GrossWork;
use crate::physics::contact::law::ContactLaw;
use crate::physics::contact::{ContactState, Kinematics, RelativeMotion};

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
pub fn evaluate<L: ContactLaw>(
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
    let (push, pull) = (response.normal_force, response.tangential_force);
    let force = Vec2x4 { x: normal.x * push + normal.y * pull, y: normal.y * push - normal.x * pull };
    let moment = if L::ROLLS { arm * pull + response.rolling_moment } else { arm * pull };
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
        tallies::add_gross_work(sums, &GrossWork::of_step(&contact, last_force, [push, pull]));
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
        tangential: pull,
        rolling_moment: response.rolling_moment,
        moment,
        overlap: contact.overlap,
        last,
        touching: contact.touching.to_bitmask(),
    }
}
