//! Slots between particles and the drum: rim, edges, vertices.

use super::bodies::{Meeting, Wall, settle};
use super::slots::SlotSlice;
use super::{Scene, Sink};
use crate::contact::History;
use crate::drum::{Drum, FeatureId, RIM};
use crate::energy::{StepFlows, SurfaceLoad};
use crate::integrator::Motion;
use crate::vector::{Vec2, cross, dot};

/// Evaluates the slots in their order and adds the loads by surface.
pub fn evaluate(
    scene: Scene,
    slots: SlotSlice,
    surfaces: &mut [SurfaceLoad],
    sink: &mut impl Sink,
) -> StepFlows {
    let mut flows = StepFlows::default();
    let SlotSlice { owner, other, laws, histories, .. } = slots;
    if surfaces.len() > 1 {
        for (start, end) in rows(owner) {
            hand_over(scene, owner[start] as usize, &other[start..end], &mut histories[start..end]);
        }
    }
    for (slot, history) in histories.iter_mut().enumerate() {
        let (i, feature, law) = (owner[slot] as usize, other[slot], laws[slot]);
        let own = &scene.motions[i];
        let Some(meeting) = meet(scene, own, feature, history.is_touching()) else { continue };
        if meeting.overlap <= 0.0 && !history.is_touching() {
            continue;
        }
        let wall = Wall { own, turn: scene.turn, angular_velocity: scene.angular_velocity };
        settle(&wall, meeting, (law.damping, scene.step_rate), history, &mut flows, |encounter, past| {
            scene.laws.wall(law).respond(encounter, past)
        });
        let force = history.force();
        sink.add(i, force, wall.arm(history.overlap) * history.tangential_force);
        let point = own.position + history.normal * wall.arm(history.overlap);
        let surface = &mut surfaces[scene.drum.surface_of(feature)];
        surface.force += force;
        surface.moment += cross(point, force);
    }
    flows
}

/// The ranges of slots that belong to one particle each.
fn rows(owner: &[u32]) -> impl Iterator<Item = (usize, usize)> + '_ {
    let mut start = 0;
    std::iter::from_fn(move || {
        let first = *owner.get(start)?;
        let length = owner[start..].iter().take_while(|&&i| i == first).count();
        let range = (start, start + length);
        start += length;
        Some(range)
    })
}

/// Where a particle meets a feature of the drum, or none where it is some other feature's turn. A contact that has just
/// ended is answered with an overlap of zero, so that its last work is charged.
#[inline]
fn meet(scene: Scene, own: &Motion, feature: FeatureId, touching: bool) -> Option<Meeting> {
    if feature == RIM {
        return meet_rim(scene.drum, own, touching);
    }
    let center = scene.rotation.apply_inverse(own.position);
    match scene.drum.proximity(feature, center) {
        Some(near) => Some(Meeting {
            overlap: own.radius - near.distance,
            normal: scene.rotation.apply(near.direction),
        }),
        None => touching.then(|| Meeting { overlap: 0.0, normal: Vec2::zeros() }),
    }
}

#[inline]
fn meet_rim(drum: &Drum, own: &Motion, touching: bool) -> Option<Meeting> {
    let rim = drum.radius()?;
    let distance_squared = dot(own.position, own.position);
    let free = rim - own.radius;
    if distance_squared <= free * free && !touching {
        return None;
    }
    let distance = distance_squared.sqrt();
    Some(Meeting { overlap: own.radius - (rim - distance), normal: own.position * (1.0 / distance) })
}

/// Passes the history of a contact to the neighbouring feature when a particle rolls from one to the other.
fn hand_over(scene: Scene, particle: usize, features: &[u32], histories: &mut [History]) {
    let own = &scene.motions[particle];
    for slot in 0..features.len() {
        if features[slot] == RIM || !histories[slot].is_touching() {
            continue;
        }
        let center = scene.rotation.apply_inverse(own.position);
        if scene.drum.proximity(features[slot], center).is_some() {
            continue;
        }
        let heir = (0..features.len()).find(|&other| {
            features[other] != RIM
                && !histories[other].is_touching()
                && scene.drum.adjacent(features[slot], features[other])
                && scene
                    .drum
                    .proximity(features[other], center)
                    .is_some_and(|near| near.distance < own.radius)
        });
        if let Some(heir) = heir {
            histories[heir] = std::mem::take(&mut histories[slot]);
        }
    }
}
