//! Contacts between particles, four at a time.
//!
//! Eight blocks go through the stages together: gathering the positions, root and division first, then law, work and
//! scattering. The root of one block then overlaps with the work on others; in one stage each block waits for its own.

use std::marker::PhantomData;

use super::StepTime;
use super::accumulate::Accumulator;
use super::totals::{LaneTotals, Totals};
use crate::engine::contacts::{Block, ContactList, Geometry, Ids, ListParameters, PairParameters};
use crate::engine::motion::MotionView;
use crate::engine::simd::{ALL_LANES, F64x4, LANES, Vec2x4, lanes, rows};
use crate::physics::columns::{Columns, Of};
use crate::physics::contact::law::ContactLaw;
use crate::physics::contact::{ContactState, Kinematics, RelativeMotion};
use crate::physics::scalar::Scalar;

/// Blocks that go through the stages together; 4 and 16 are no faster.
const GROUP: usize = 8;

/// Where the bodies of a block meet.
#[derive(Debug, Clone, Copy)]
struct ContactGeometry {
    normal: Vec2x4,
    /// Overlap; below zero where they are apart.
    overlap: F64x4,
}

/// Written before it is read; kept, since clearing it takes time.
#[derive(Debug, Clone)]
pub struct Scratch {
    meetings: [ContactGeometry; GROUP],
    /// The blocks with contacts that have ended.
    pub ended: Ended,
}

impl Default for Scratch {
    fn default() -> Self {
        let zero = F64x4::ZERO;
        let meeting = ContactGeometry { normal: Vec2x4 { x: zero, y: zero }, overlap: zero };
        Self { meetings: [meeting; GROUP], ended: Ended::default() }
    }
}

/// The blocks of a list with contacts that have ended.
///
/// There is room for all before a pass begins: where a list could grow in a loop, the sums would have to be in memory in every
/// turn, in case that fails.
#[derive(Debug, Clone, Default)]
pub struct Ended {
    blocks: Vec<u32>,
    count: usize,
}

impl Ended {
    /// None yet, of a list of so many blocks.
    pub fn clear(&mut self, blocks: usize) {
        if self.blocks.len() < blocks {
            self.blocks.resize(blocks, 0);
        }
        self.count = 0;
    }

    /// Takes note of a block of which these lanes touch.
    #[inline(always)]
    pub fn note(&mut self, block: usize, touching: u32) {
        if touching != ALL_LANES
            && let Some(next) = self.blocks.get_mut(self.count)
        {
            *next = block as u32;
            self.count += 1;
        }
    }

    /// The blocks, ascending.
    pub fn blocks(&self) -> &[u32] {
        &self.blocks[..self.count]
    }
}

/// Evaluates all contacts of a list; `scratch.ended` then tells in which blocks some have ended.
pub fn evaluate<L: ContactLaw>(
    list: &mut ContactList<L>,
    motion: impl MotionView,
    time: StepTime,
    sums: &mut impl Accumulator,
    totals: &mut Totals,
    scratch: &mut Scratch,
) {
    scratch.ended.clear(list.blocks());
    let mut lanes = totals.open();
    let ContactList { ids, blocks, other_moments, parameters, .. } = list;
    let unit = match parameters {
        ListParameters::Same(same) => {
            let own = PairParameters::<L>::map(same, F64x4::splat);
            let (of, moments) = (|_| own, other_moments.as_mut_slice());
            if moments.is_empty() {
                let pass = Pass::<L, _, _, false, false> { motion, time, parameters: of, law: PhantomData };
                pass.run(ids, blocks, moments, sums, &mut lanes, scratch);
            } else {
                let pass = Pass::<L, _, _, true, false> { motion, time, parameters: of, law: PhantomData };
                pass.run(ids, blocks, moments, sums, &mut lanes, scratch);
            }
            same.1.radius.min(same.1.other_radius)
        }
        ListParameters::Each(each) => {
            let of = |block: usize| PairParameters::<L>::map(&each[block], F64x4::new);
            let pass = Pass::<L, _, _, true, true> { motion, time, parameters: of, law: PhantomData };
            pass.run(ids, blocks, other_moments, sums, &mut lanes, scratch);
            1.0
        }
    };
    totals.close(&lanes, unit);
}

/// One pass over a list. With `BOTH`, moments on bodies j are kept apart from those on bodies i; with `MIXED`, radii differ,
/// and depths are ratios.
struct Pass<L, V, P, const BOTH: bool, const MIXED: bool>
where
    L: ContactLaw,
    P: Fn(usize) -> Of<PairParameters<L>, F64x4>,
{
    motion: V,
    time: StepTime,
    parameters: P,
    law: PhantomData<L>,
}

impl<L, V, P, const BOTH: bool, const MIXED: bool> Pass<L, V, P, BOTH, MIXED>
where
    L: ContactLaw,
    V: MotionView,
    P: Fn(usize) -> Of<PairParameters<L>, F64x4>,
{
    #[inline(never)]
    fn run(
        &self,
        ids: &[Ids],
        blocks: &mut [Block<L>],
        other_moments: &mut [[f64; LANES]],
        sums: &mut impl Accumulator,
        totals: &mut LaneTotals,
        scratch: &mut Scratch,
    ) {
        let Scratch { meetings, ended } = scratch;
        for (group, (blocks, ids)) in blocks.chunks_mut(GROUP).zip(ids.chunks(GROUP)).enumerate() {
            let first = GROUP * group;
            self.contact_geometries(first, ids, meetings);
            for (index, ((block, ids), meeting)) in blocks.iter_mut().zip(ids).zip(&*meetings).enumerate() {
                let index = first + index;
                let other = if BOTH { Some(&mut other_moments[index]) } else { None };
                let touching =
                    self.advance(block, ids, meeting, &(self.parameters)(index), other, sums, totals);
                ended.note(index, touching);
            }
        }
    }

    /// Where the bodies of some blocks meet, the first of which is `first`. A function of its own, for which the registers
    /// suffice.
    #[inline(never)]
    fn contact_geometries(&self, first: usize, ids: &[Ids], meetings: &mut [ContactGeometry; GROUP]) {
        for (index, (ids, meeting)) in ids.iter().zip(meetings).enumerate() {
            *meeting = self.contact_geometry(ids, &(self.parameters)(first + index).1);
        }
    }

    /// Where the bodies of a block meet.
    #[inline(always)]
    fn contact_geometry(&self, ids: &Ids, geometry: &Geometry<F64x4>) -> ContactGeometry {
        let apart = between(ids, |particle| self.motion.position(particle));
        let distance = apart.dot(apart).sqrt();
        let normal = apart.scaled(F64x4::ONE / distance);
        ContactGeometry { normal, overlap: (geometry.radius + geometry.other_radius) - distance }
    }

    /// One step of a block: relative motion, law, work, new state, forces. Returns which lanes touch.
    #[inline(always)]
    #[allow(clippy::too_many_arguments)]
    fn advance(
        &self,
        block: &mut Block<L>,
        ids: &Ids,
        meeting: &ContactGeometry,
        (law, geometry): &Of<PairParameters<L>, F64x4>,
        other_moment: Option<&mut [f64; LANES]>,
        sums: &mut impl Accumulator,
        totals: &mut LaneTotals,
    ) -> u32 {
        let ContactGeometry { normal, overlap } = *meeting;
        let velocity = between(ids, |particle| self.motion.velocity(particle));
        let spin = lanes(|lane| self.motion.angular_velocity(ids.own[lane]));
        let other_spin = lanes(|lane| self.motion.angular_velocity(ids.other[lane]));
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
        let last = ContactState::map(&block.state, F64x4::new);
        let history = L::History::map(&block.history, F64x4::new);
        let contact = Kinematics::new(&motion, &last, self.time.lanes());
        let (response, history) = L::respond(law, &contact, &history);

        let (push, pull) = (response.normal_force, response.tangential_force);
        let force = Vec2x4 { x: normal.x * push + normal.y * pull, y: normal.y * push - normal.x * pull };
        let moment = if BOTH { arm * pull + response.rolling_moment } else { arm * pull };
        let moment_on_other = if BOTH { other_arm * pull - response.rolling_moment } else { moment };
        // Each force is charged half of the displacement: the trapezoid of the step.
        let both = Vec2x4 { x: force.x + last.force_x, y: force.y + last.force_y };
        let mut power = both.dot(velocity);
        if let Some(kept) = other_moment {
            power += (moment + last.moment) * spin + (moment_on_other + F64x4::new(*kept)) * other_spin;
            *kept = moment_on_other.to_array();
        } else {
            power += (moment + last.moment) * (spin + other_spin);
        }
        totals.power -= power;
        let depth =
            if MIXED { overlap / geometry.radius.smaller(geometry.other_radius) } else { contact.overlap };
        totals.deepest = depth.larger(totals.deepest);
        totals.add_flows(L::FLOWS, &response.flows);
        block.state = ContactState {
            overlap: contact.overlap.to_array(),
            separation_rate: contact.last_rate.to_array(),
            force_x: force.x.to_array(),
            force_y: force.y.to_array(),
            moment: moment.to_array(),
        };
        block.history = L::History::map(&history, F64x4::to_array);
        let (moments, other_moments) = (moment.to_array(), moment_on_other.to_array());
        for (lane, force) in force.to_array().into_iter().enumerate() {
            sums.subtract(ids.own[lane], force, moments[lane]);
            sums.add(ids.other[lane], force, other_moments[lane]);
        }
        contact.touching.to_bitmask()
    }
}

/// What the vectors of bodies j have that those of bodies i have not.
#[inline(always)]
fn between(ids: &Ids, vector: impl Fn(u32) -> [f64; 2]) -> Vec2x4 {
    let [own, own_odd] = rows(|lane| vector(ids.own[lane]));
    let [other, other_odd] = rows(|lane| vector(ids.other[lane]));
    Vec2x4::from_rows([other - own, other_odd - own_odd])
}
