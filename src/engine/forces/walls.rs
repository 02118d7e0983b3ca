//! Contacts of particles with the drum, four at a time: the rim, and the edges and vertices of outlines.

use wide::f64x2;

use super::accumulate::Accumulator;
use super::pairs::Ended;
use super::totals::{LaneTotals, Totals};
use super::{StepInputs, SurfaceLoad};
use crate::engine::contacts::{Block, ContactList, Ids, ListParameters, PairParameters};
use crate::engine::motion::{MotionView, offset};
use crate::engine::simd::{F64x4, LANES, Vec2x4, lanes, rows, sum};
use crate::physics::columns::{Columns, Of};
use crate::physics::contact::law::ContactLaw;
use crate::physics::contact::{ContactState, Kinematics, RelativeMotion};
use crate::physics::scalar::Scalar;
use crate::physics::vector::Vec2;

/// Four particles at the drum.
#[derive(Debug, Clone, Copy)]
struct Bodies {
    position: Vec2x4,
    velocity: Vec2x4,
    spin: F64x4,
}

/// Where they meet it.
#[derive(Debug, Clone, Copy)]
struct ContactGeometry {
    /// Towards the drum.
    normal: Vec2x4,
    /// Overlap; not above zero where they are apart.
    overlap: F64x4,
    /// From the centers to the points of contact, which are on the drum's surface [m].
    arm: F64x4,
    /// Velocity of the surface there, along the normal and along the tangent [m/s].
    surface_rates: [F64x4; 2],
}

/// What four contacts do to the load.
struct Reaction {
    /// Force on the drum.
    force: Vec2x4,
    /// Moment on the particles about their centers.
    moment: F64x4,
    touching: u32,
}

/// Evaluates the contacts with the rim, and tells in which blocks some have ended.
pub fn evaluate_rim<L: ContactLaw>(
    list: &mut ContactList<L>,
    motion: impl MotionView,
    inputs: &StepInputs,
    sums: &mut impl Accumulator,
    totals: &mut Totals,
    ended: &mut Ended,
) -> SurfaceLoad {
    ended.clear(list.blocks());
    let ContactList { ids, blocks, parameters, .. } = list;
    let mut lanes = totals.open();
    match parameters {
        ListParameters::Same(same) => {
            let own = PairParameters::<L>::map(same, F64x4::splat);
            let load = rim_pass::<L, false>(ids, blocks, |_| own, motion, inputs, sums, &mut lanes, ended);
            totals.close(&lanes, same.1.radius);
            load
        }
        ListParameters::Each(each) => {
            let of = |block: usize| PairParameters::<L>::map(&each[block], F64x4::new);
            let load = rim_pass::<L, true>(ids, blocks, of, motion, inputs, sums, &mut lanes, ended);
            totals.close(&lanes, 1.0);
            load
        }
    }
}

/// One pass over the contacts with the rim.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
fn rim_pass<L: ContactLaw, const MIXED: bool>(
    ids: &[Ids],
    blocks: &mut [Block<L>],
    parameters: impl Fn(usize) -> Of<PairParameters<L>, F64x4>,
    motion: impl MotionView,
    inputs: &StepInputs,
    sums: &mut impl Accumulator,
    totals: &mut LaneTotals,
    ended: &mut Ended,
) -> SurfaceLoad {
    let Some(rim) = inputs.drum.radius() else { return SurfaceLoad::default() };
    let zero = F64x4::ZERO;
    let (mut moment, mut force) = (zero, Vec2x4 { x: zero, y: zero });
    let (rim, speed) = (F64x4::splat(rim), F64x4::splat(inputs.angular_velocity));
    for (index, (block, ids)) in blocks.iter_mut().zip(ids).enumerate() {
        let parameters = parameters(index);
        let bodies = Bodies::gather(ids, motion);
        let distance = bodies.position.dot(bodies.position).sqrt();
        let overlap = distance - (rim - parameters.1.radius);
        let arm = parameters.1.radius - overlap.larger(zero);
        let meeting = ContactGeometry {
            normal: bodies.position.scaled(F64x4::ONE / distance),
            overlap,
            arm,
            // The rim moves along itself.
            surface_rates: [zero, speed * (distance + arm)],
        };
        let reaction = advance::<L, MIXED>(block, &bodies, &meeting, &parameters, inputs, totals);
        moment += reaction.moment - bodies.position.cross(reaction.force);
        force = force.plus(reaction.force);
        ended.note(index, reaction.touching);
        scatter(ids, &reaction, sums);
    }
    let total = |lanes: F64x4| sum(lanes.to_array());
    SurfaceLoad { force: Vec2::new(-total(force.x), -total(force.y)), moment: total(moment) }
}

/// Where one particle meets a feature of an outline.
#[derive(Debug, Clone, Copy, Default)]
pub struct Spot {
    /// Overlap; not above zero where they are apart.
    pub overlap: f64,
    /// Towards the drum.
    pub normal: Vec2,
}

impl Spot {
    /// None where some other feature answers.
    #[inline]
    pub fn of(particle: u32, feature: u32, motion: impl MotionView, inputs: &StepInputs) -> Option<Self> {
        let [x, y] = motion.position(offset(particle));
        let near = inputs.drum.proximity(feature, inputs.rotation.apply_inverse(Vec2::new(x, y)))?;
        let overlap = inputs.bodies.radius_of(particle) - near.distance;
        Some(Self { overlap, normal: inputs.rotation.apply(near.direction) })
    }
}

/// Evaluates the contacts with outlines, which meet at `spots`, adds what they do to the load to `surfaces`, and tells in
/// which blocks some have ended.
#[allow(clippy::too_many_arguments)]
pub fn evaluate_outlines<L: ContactLaw>(
    list: &mut ContactList<L>,
    spots: &[Spot],
    motion: impl MotionView,
    inputs: &StepInputs,
    sums: &mut impl Accumulator,
    totals: &mut Totals,
    surfaces: &mut [SurfaceLoad],
    ended: &mut Ended,
) {
    ended.clear(list.blocks());
    let mut open_totals = totals.open();
    let speed = F64x4::splat(inputs.angular_velocity);
    let ContactList { ids, blocks, parameters, .. } = list;
    for (index, ((block, ids), spots)) in
        blocks.iter_mut().zip(ids.iter()).zip(spots.chunks(LANES)).enumerate()
    {
        let parameters = parameters_of::<L>(parameters, index);
        let bodies = Bodies::gather(ids, motion);
        let spot = |lane: usize| spots.get(lane).copied().unwrap_or_default();
        let overlap = lanes(|lane| spot(lane).overlap);
        let normal = Vec2x4 { x: lanes(|lane| spot(lane).normal.x), y: lanes(|lane| spot(lane).normal.y) };
        let arm = parameters.1.radius - overlap.larger(F64x4::ZERO);
        let point = bodies.position.plus(normal.scaled(arm));
        let surface_rates = [speed * point.cross(normal), speed * point.dot(normal)];
        let meeting = ContactGeometry { normal, overlap, arm, surface_rates };
        let reaction = advance::<L, true>(block, &bodies, &meeting, &parameters, inputs, &mut open_totals);
        let moments = (reaction.moment - bodies.position.cross(reaction.force)).to_array();
        for (lane, force) in reaction.force.to_array().into_iter().enumerate().take(spots.len()) {
            let surface = &mut surfaces[inputs.drum.surface_of(ids.other[lane])];
            let [x, y] = force.to_array();
            surface.force -= Vec2::new(x, y);
            surface.moment += moments[lane];
        }
        ended.note(index, reaction.touching);
        scatter(ids, &reaction, sums);
    }
    totals.close(&open_totals, 1.0);
}

#[inline(always)]
fn parameters_of<L: ContactLaw>(
    parameters: &ListParameters<L>,
    block: usize,
) -> Of<PairParameters<L>, F64x4> {
    match parameters {
        ListParameters::Same(same) => PairParameters::<L>::map(same, F64x4::splat),
        ListParameters::Each(each) => PairParameters::<L>::map(&each[block], F64x4::new),
    }
}

impl Bodies {
    #[inline(always)]
    fn gather(ids: &Ids, motion: impl MotionView) -> Self {
        Self {
            position: Vec2x4::from_rows(rows(|lane| motion.position(ids.own[lane]))),
            velocity: Vec2x4::from_rows(rows(|lane| motion.velocity(ids.own[lane]))),
            spin: lanes(|lane| motion.angular_velocity(ids.own[lane])),
        }
    }
}

/// One step of a block: relative motion, law, work on the particles, new state. With `MIXED`, radii differ, and depths are
/// ratios.
#[inline(always)]
fn advance<L: ContactLaw, const MIXED: bool>(
    block: &mut Block<L>,
    bodies: &Bodies,
    meeting: &ContactGeometry,
    (law, geometry): &Of<PairParameters<L>, F64x4>,
    inputs: &StepInputs,
    totals: &mut LaneTotals,
) -> Reaction {
    let ContactGeometry { normal, overlap, arm, surface_rates: [separation, sliding] } = *meeting;
    let Bodies { velocity, spin, .. } = *bodies;
    let motion = RelativeMotion {
        overlap,
        separation_rate: separation - velocity.dot(normal),
        slip_rate: sliding - normal.cross(velocity) - arm * spin,
        rolling_rate: spin - F64x4::splat(inputs.angular_velocity),
    };
    let last = ContactState::map(&block.state, F64x4::new);
    let history = L::History::map(&block.history, F64x4::new);
    let contact = Kinematics::new(&motion, &last, inputs.time.lanes());
    let (response, history) = L::respond(law, &contact, &history);

    let (push, pull) = (response.normal_force, response.tangential_force);
    let force = Vec2x4 { x: normal.x * push + normal.y * pull, y: normal.y * push - normal.x * pull };
    let moment = arm * pull + response.rolling_moment;
    let both = Vec2x4 { x: force.x + last.force_x, y: force.y + last.force_y };
    // What the drum does is charged to its surfaces: this is the work on the particles alone.
    totals.power -= (moment + last.moment) * spin - both.dot(velocity);
    let depth = if MIXED { contact.overlap / geometry.radius } else { contact.overlap };
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
    Reaction { force, moment, touching: contact.touching.to_bitmask() }
}

#[inline(always)]
fn scatter(ids: &Ids, reaction: &Reaction, sums: &mut impl Accumulator) {
    let moments = reaction.moment.to_array();
    let forces: [f64x2; LANES] = reaction.force.to_array();
    for lane in 0..LANES {
        sums.subtract(ids.own[lane], forces[lane], moments[lane]);
    }
}
