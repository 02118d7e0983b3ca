//! Contacts of particles with the drum: rim, edges, vertices.

use super::Scene;
use super::bodies::{FlowLanes, Meeting, Walls, settle};
use super::motions::Motions;
use super::post::Sink;
use crate::contact::block::{Block, Ends, Traits, TraitsLanes};
use crate::contact::clock::{Clock, WayClock};
use crate::contact::linear::LinearLanes;
use crate::contact::list::ListTraits;
use crate::contact::table::Slots;
use crate::lanes::{LANES, ROW, Vec2Lanes, lanes, transpose};
use crate::physics::drum::{FeatureId, RIM};
use crate::physics::energy::{StepFlows, SurfaceLoad};
use crate::physics::vector::{Vec2, cross, dot};

/// Evaluates the contacts of one chunk with the drum in key order and adds the loads by surface.
pub fn evaluate(
    scene: Scene<impl Motions>,
    slots: &mut Slots<WayClock>,
    surfaces: &mut [SurfaceLoad],
    sink: &mut Sink,
) -> StepFlows {
    if surfaces.len() > 1 {
        hand_over(scene, slots);
    }
    open_contacts(scene, slots);
    let mut flows = FlowLanes::zero();
    let laws = scene.laws.walls();
    let (ends, blocks, list_traits) = slots.contacts.parts_mut();
    for (index, (block, ends)) in blocks.iter_mut().zip(ends).enumerate() {
        let (law, traits) = match list_traits {
            ListTraits::Same(same) => {
                (LinearLanes::splat(&laws[same.law.law as usize]), TraitsLanes::splat(same))
            }
            ListTraits::Each(each) => {
                (LinearLanes::new(|lane| &laws[each[index].laws()[lane] as usize]), each[index].lanes())
            }
        };
        work_out(scene, (ends, block), (&law, &traits), &mut flows, &mut (&mut *surfaces, sink));
    }
    if !flows.all_touch() {
        slots.close_ended();
    }
    flows.total(1.0)
}

/// Where one particle meets the drum.
#[derive(Debug, Clone, Copy, Default)]
struct Spot {
    overlap: f64,
    normal: Vec2,
}

/// Makes contacts of the candidates that touch; puts the others to sleep where their gap is known.
fn open_contacts(scene: Scene<impl Motions>, slots: &mut Slots<WayClock>) {
    slots.candidates.follow(scene.patches, |clock, most| clock.advance(most.way, scene.arc));
    for patch in 0..slots.candidates.patches() {
        let (waking, rows) = (slots.candidates.waking(patch), slots.candidates.rows(patch));
        let way = slots.candidates.clock(patch).reading();
        for candidate in ROW * rows.start..ROW * rows.end {
            if !slots.candidates.is_due(candidate, waking) {
                continue;
            }
            let (id, feature) = slots.candidates.key(candidate);
            // Only the particle moves, as seen from the drum. Slightly less than the gap covers round-off.
            match gap(scene, id, feature) {
                Some(gap) if gap >= 0.0 => {
                    slots.candidates.sleep(candidate, (way + (1.0 - 1e-6) * gap) as f32);
                }
                Some(_) => open(scene, slots, candidate),
                None => {}
            }
        }
    }
}

#[cold]
fn open(scene: Scene<impl Motions>, slots: &mut Slots<WayClock>, candidate: usize) {
    let id = slots.candidates.key(candidate).0 as usize;
    let matter = scene.matter;
    let law = scene.laws.wall_slot((matter.materials[id], matter.masses[id]));
    slots.open(candidate, Traits { law, radii: [matter.radii[id], 0.0] });
}

/// The gap between a particle and a feature of the drum, below zero where they overlap, or slightly less than the gap;
/// none where it is some other feature's turn.
#[inline]
fn gap(scene: Scene<impl Motions>, particle: u32, feature: FeatureId) -> Option<f64> {
    if feature != RIM {
        return meet(scene, particle, feature).map(|spot| -spot.overlap);
    }
    let rim = scene.drum.radius()?;
    let (position, radius) = (scene.motions.of(particle).position(), scene.matter.radius_of(particle));
    let free = rim - radius;
    // free − distance = (free² − distance²) / (free + distance), whose divisor is below 2 rim.
    let excess = free * free - dot(position, position);
    if excess > 0.0 {
        return Some(excess * (0.5 / rim));
    }
    Some((rim - dot(position, position).sqrt()) - radius)
}

/// Where a particle meets a feature of an outline, or none where it is some other feature's turn.
#[inline]
fn meet(scene: Scene<impl Motions>, particle: u32, feature: FeatureId) -> Option<Spot> {
    let position = scene.motions.of(particle).position();
    let near = scene.drum.proximity(feature, scene.rotation.apply_inverse(position))?;
    Some(Spot {
        overlap: scene.matter.radius_of(particle) - near.distance,
        normal: scene.rotation.apply(near.direction),
    })
}

/// Works out a block.
fn work_out(
    scene: Scene<impl Motions>,
    (ends, block): (&Ends, &mut Block),
    (law, traits): (&LinearLanes, &TraitsLanes),
    flows: &mut FlowLanes,
    (surfaces, sink): &mut (&mut [SurfaceLoad], &mut Sink),
) {
    let own = ends.owner.map(|id| scene.motions.of(id));
    let walls = Walls::new(own, traits.radii[0], scene.time_step, (scene.turn, scene.angular_velocity));
    let (history, in_use) = (block.history(), block.in_use());
    let meeting = meetings(scene, (ends, block), &walls).within(in_use);
    let used = (in_use, |overlap| overlap / traits.radii[0]);
    let now = settle(&walls, (meeting, &history), (law, traits.damping, scene.step_rate), used, flows);
    block.remember(&now);

    let reaction = now.reaction();
    let moment = -(walls.arm(now.overlap) * now.tangential_force);
    let rows = transpose([reaction.x, reaction.y, moment, moment]);
    let (reactions, points) = (reaction.to_array(), walls.point(now.overlap, now.normal).to_array());
    for lane in 0..LANES {
        sink.take_off(ends.owner[lane], rows[lane]);
        let surface = &mut surfaces[scene.drum.surface_of(ends.other[lane])];
        surface.force -= reactions[lane];
        surface.moment -= cross(points[lane], reactions[lane]);
    }
}

/// Where the particles of a block meet their features. A contact that ends because another feature answers has an
/// overlap of zero, so that its last work is charged.
#[inline(always)]
fn meetings(scene: Scene<impl Motions>, (ends, block): (&Ends, &Block), walls: &Walls) -> Meeting {
    let rim = scene.drum.radius().map(|radius| walls.meet_rim(radius));
    if let Some(meeting) = rim
        && ends.other == [RIM; LANES]
    {
        return meeting;
    }
    let mut spots = [Spot::default(); LANES];
    if let Some(Meeting { overlap, normal }) = rim {
        let (overlaps, normals) = (overlap.to_array(), normal.to_array());
        spots = std::array::from_fn(|lane| Spot { overlap: overlaps[lane], normal: normals[lane] });
    }
    for (lane, spot) in spots.iter_mut().enumerate() {
        if ends.other[lane] != RIM && block.holds(lane) {
            *spot = meet(scene, ends.owner[lane], ends.other[lane]).unwrap_or_default();
        }
    }
    Meeting { overlap: lanes(|lane| spots[lane].overlap), normal: Vec2Lanes::new(|lane| spots[lane].normal) }
}

/// Passes the history of a contact to the neighboring feature when a particle rolls from one to the other.
fn hand_over(scene: Scene<impl Motions>, slots: &mut Slots<WayClock>) {
    let mut index = 0;
    while slots.contacts.lanes().contains(&index) {
        let (particle, feature) = slots.contacts.key(index);
        index += 1;
        if feature == RIM || !slots.contacts.holds(index - 1) || meet(scene, particle, feature).is_some() {
            continue;
        }
        if let Some(heir) = heir_of(scene, slots, particle, feature) {
            // What came after it has moved up.
            index -= 1;
            slots.pass_on(index, heir);
        }
    }
}

/// The candidate that a contact of `particle` with `feature` goes on as.
fn heir_of(
    scene: Scene<impl Motions>,
    slots: &Slots<WayClock>,
    particle: u32,
    feature: FeatureId,
) -> Option<usize> {
    let candidates = &slots.candidates;
    candidates.of(particle).find(|&candidate| {
        let (_, other) = candidates.key(candidate);
        other != RIM
            && candidates.is_free(candidate)
            && scene.drum.adjacent(feature, other)
            && meet(scene, particle, other).is_some_and(|spot| spot.overlap > 0.0)
    })
}
