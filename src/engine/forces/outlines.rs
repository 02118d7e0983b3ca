//! Contacts of particles with edges and vertices of outlines, four at a time.

use super::pass::{ChunkStep, Scratch};
use super::walls::{ContactGeometry, advance, wall_records};
use super::{StepInputs, SurfaceLoad};
use crate::engine::contacts::ContactList;
use crate::engine::motion::{MotionView, at_offset, offset};
use crate::engine::pair_list::Neighbors;
use crate::engine::simd::{F64x4, LANES, Vec2x4, lanes, vectors};
use crate::physics::contact::law::ContactLaw;
use crate::physics::drum::RIM;
use crate::physics::scalar::Scalar;
use crate::physics::vector::Vec2;

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

/// One step of the contacts with outlines: those that open, then all, then those that end. Adds what outlines do to the load to
/// `surfaces`.
pub fn evaluate<L: ContactLaw, V: MotionView>(
    list: &mut ContactList<L>,
    neighbors: &mut Neighbors,
    step: &mut ChunkStep<V>,
    surfaces: &mut [SurfaceLoad],
) {
    find_spots(list, neighbors, step);
    if !step.open(list, neighbors) {
        return;
    }
    let mut totals = step.totals.open();
    let ChunkStep { motion, inputs, sums, totals: kept, scratch: Scratch { spots, ended, .. }, .. } =
        &mut *step;
    let motion = *motion;
    for (particle, feature) in (spots.len()..list.len()).map(|index| list.key(index)) {
        spots.push(Spot::of(particle, feature, motion, inputs).unwrap_or_default());
    }
    let speed = F64x4::splat(inputs.angular_velocity);
    let shared = list.parameters.shared();
    let by_block = list.parameters.by_block(&shared);
    for (index, spots) in spots.chunks(LANES).enumerate() {
        let parameters = by_block.of(index);
        let (block, ids) = (&mut list.blocks[index], &list.ids[index]);
        let records = wall_records::<L>(list.tallies.get_mut(index), kept, inputs);
        let position = vectors(|lane| motion.position(ids.own[lane]));
        let spot = |lane: usize| spots.get(lane).copied().unwrap_or_default();
        let overlap = lanes(|lane| spot(lane).overlap);
        let normal = Vec2x4 { x: lanes(|lane| spot(lane).normal.x), y: lanes(|lane| spot(lane).normal.y) };
        let arm = parameters.1.radius - overlap.larger(F64x4::ZERO);
        let point = position.plus(normal.scaled(arm));
        let surface_rates = [speed * point.cross(normal), speed * point.dot(normal)];
        let geometry = ContactGeometry { normal, overlap, arm, surface_rates };
        let forces = advance::<L, V>(
            block,
            ids,
            &geometry,
            &parameters.0,
            parameters.1.radius,
            motion,
            inputs,
            sums,
            &mut totals,
            records,
        );
        let moments = (forces.moment - position.cross(forces.force)).to_array();
        for (lane, force) in forces.force.to_array().into_iter().enumerate().take(spots.len()) {
            let surface = &mut surfaces[inputs.drum.surface_of(at_offset(ids.other[lane]))];
            let [x, y] = force.to_array();
            surface.force -= Vec2::new(x, y);
            surface.moment += moments[lane];
        }
        ended.note(index, forces.touching);
    }
    step.totals.close(&totals, 1.0);
    step.close(list, neighbors);
}

/// Where each contact meets the drum, and which neighbors have begun to touch.
fn find_spots<L: ContactLaw, V: MotionView>(
    list: &mut ContactList<L>,
    neighbors: &mut Neighbors,
    step: &mut ChunkStep<V>,
) {
    let (motion, inputs) = (step.motion, step.inputs);
    let Scratch { opened, spots, .. } = &mut *step.scratch;
    spots.clear();
    for index in 0..list.len() {
        let (particle, feature) = list.key(index);
        let spot = Spot::of(particle, feature, motion, inputs);
        let spot = spot.or_else(|| transfer_history(list, index, neighbors, motion, inputs));
        spots.push(spot.unwrap_or_default());
    }
    neighbors.near.take_where(opened, |near| {
        let touches = |&lane: &usize| {
            let (particle, feature) = (at_offset(near.own[lane]), at_offset(near.other[lane]));
            feature != RIM
                && Spot::of(particle, feature, motion, inputs).is_some_and(|spot| spot.overlap > 0.0)
        };
        (0..LANES).filter(touches).fold(0, |bits, lane| bits | 1 << lane)
    });
    // A history may have passed to a feature in the meantime.
    opened.retain(|&(_, place)| neighbors.is_apart(place as usize));
}

/// Passes the history of a contact to the neighboring feature of the outline when a particle rolls from one to the other.
/// The contact keeps its place; returns where it is now.
#[cold]
fn transfer_history<L: ContactLaw>(
    list: &mut ContactList<L>,
    index: usize,
    neighbors: &mut Neighbors,
    motion: impl MotionView,
    inputs: &StepInputs,
) -> Option<Spot> {
    let (particle, feature) = list.key(index);
    let (successor, spot) = neighbors.of(particle).find_map(|place| {
        let (_, other) = neighbors.pairs()[place];
        let spot = (neighbors.is_apart(place) && inputs.drum.adjacent(feature, other))
            .then(|| Spot::of(particle, other, motion, inputs))
            .flatten()
            .filter(|spot| spot.overlap > 0.0)?;
        Some((place, spot))
    })?;
    neighbors.release((particle, feature), list.neighbors[index]);
    neighbors.open(successor as u32);
    list.pass_to(index, neighbors.pairs()[successor].1, successor as u32);
    Some(spot)
}
