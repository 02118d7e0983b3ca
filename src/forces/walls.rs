//! Slots between particles and the drum: rim, edges, vertices.

use super::batch::{Batch, in_use};
use super::bodies::{FlowLanes, Meeting, Walls, settle};
use super::slots::SlotSlice;
use super::{Scene, Sink};
use crate::contact::HistoryLanes;
use crate::contact::table::Record;
use crate::drum::{Drum, FeatureId, RIM};
use crate::energy::{StepFlows, SurfaceLoad};
use crate::integrator::Motion;
use crate::lanes::{LANES, Vec2Lanes, lanes};
use crate::vector::{Vec2, cross, dot};

/// Evaluates the slots in their order and adds the loads by surface.
pub fn evaluate(
    scene: Scene,
    slots: SlotSlice,
    surfaces: &mut [SurfaceLoad],
    sink: &mut impl Sink,
) -> StepFlows {
    let mut pass = Pass { scene, slots, surfaces, flows: FlowLanes::zero() };
    if pass.surfaces.len() > 1 {
        for (start, end) in rows(pass.slots.owner) {
            let particle = pass.slots.owner[start] as usize;
            hand_over(scene, particle, &pass.slots.other[start..end], &mut pass.slots.records[start..end]);
        }
    }
    // Contacts wait here until there are four of them.
    let (mut waiting, mut spots, mut count) = ([0_u32; LANES], [Spot::default(); LANES], 0);
    for slot in 0..pass.slots.owner.len() {
        if pass.slots.wake[slot] > scene.way {
            continue;
        }
        let Some(spot) = pass.contact(slot) else { continue };
        (waiting[count], spots[count]) = (slot as u32, spot);
        count += 1;
        if count == LANES {
            pass.work_out(&Batch::full(&waiting), &spots, sink);
            count = 0;
        }
    }
    if count > 0 {
        pass.work_out(&Batch::partial(&waiting[..count]), &spots, sink);
    }
    pass.flows.total()
}

/// Where one particle meets the drum.
#[derive(Debug, Clone, Copy, Default)]
struct Spot {
    overlap: f64,
    normal: Vec2,
}

struct Pass<'a> {
    scene: Scene<'a>,
    slots: SlotSlice<'a>,
    surfaces: &'a mut [SurfaceLoad],
    flows: FlowLanes,
}

impl Pass<'_> {
    /// Where a slot's particle touches its feature, or touched it at the last step; if it does not, the slot sleeps
    /// where its gap is known.
    #[inline]
    fn contact(&mut self, slot: usize) -> Option<Spot> {
        let own = &self.scene.motions[self.slots.owner[slot] as usize];
        let touched = self.slots.records[slot].history.is_touching();
        let spot = meet(self.scene, own, self.slots.other[slot], touched)?;
        if spot.overlap > 0.0 || touched {
            self.slots.wake[slot] = 0.0;
            return Some(spot);
        }
        // Only the particle moves, as seen from the drum. Slightly less than the gap covers round-off.
        self.slots.wake[slot] = self.scene.way - (1.0 - 1e-6) * spot.overlap;
        None
    }

    /// Works out the slots of a batch, whose particles meet the drum at `spots`.
    fn work_out(&mut self, batch: &Batch, spots: &[Spot; LANES], sink: &mut impl Sink) {
        let slots = batch.slots;
        let bodies = slots.map(|slot| &self.scene.motions[self.slots.owner[slot] as usize]);
        let walls = Walls::new(bodies, self.scene.turn, self.scene.angular_velocity);
        let meeting = Meeting {
            overlap: lanes(|lane| spots[lane].overlap),
            normal: Vec2Lanes::new(|lane| spots[lane].normal),
        };
        let history = HistoryLanes::new(|lane| &self.slots.records[slots[lane]].history);
        let keys = slots.map(|slot| self.slots.records[slot].law);
        let law = self.scene.laws.wall_lanes(keys);
        let law = (&law, lanes(|lane| keys[lane].damping), self.scene.step_rate);
        let now = settle(&walls, (meeting, &history), law, in_use(batch.count), &mut self.flows);

        let forces = now.force().to_array();
        let moments = (walls.arm(now.overlap) * now.tangential_force).to_array();
        let points = walls.point(now.overlap, now.normal).to_array();
        let histories = now.to_array();
        for lane in 0..batch.count {
            let slot = slots[lane];
            self.slots.records[slot].history = histories[lane];
            sink.add(self.slots.owner[slot] as usize, forces[lane], moments[lane]);
            let surface = &mut self.surfaces[self.scene.drum.surface_of(self.slots.other[slot])];
            surface.force += forces[lane];
            surface.moment += cross(points[lane], forces[lane]);
        }
    }
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
fn meet(scene: Scene, own: &Motion, feature: FeatureId, touching: bool) -> Option<Spot> {
    if feature == RIM {
        return meet_rim(scene.drum, own, touching);
    }
    let center = scene.rotation.apply_inverse(own.position);
    match scene.drum.proximity(feature, center) {
        Some(near) => {
            Some(Spot { overlap: own.radius - near.distance, normal: scene.rotation.apply(near.direction) })
        }
        None => touching.then(|| Spot { overlap: 0.0, normal: Vec2::zeros() }),
    }
}

#[inline]
fn meet_rim(drum: &Drum, own: &Motion, touching: bool) -> Option<Spot> {
    let rim = drum.radius()?;
    let distance_squared = dot(own.position, own.position);
    let free = rim - own.radius;
    if distance_squared <= free * free && !touching {
        return None;
    }
    let distance = distance_squared.sqrt();
    Some(Spot { overlap: own.radius - (rim - distance), normal: own.position * (1.0 / distance) })
}

/// Passes the history of a contact to the neighboring feature when a particle rolls from one to the other.
fn hand_over(scene: Scene, particle: usize, features: &[u32], records: &mut [Record]) {
    let own = &scene.motions[particle];
    for slot in 0..features.len() {
        if features[slot] == RIM || !records[slot].history.is_touching() {
            continue;
        }
        let center = scene.rotation.apply_inverse(own.position);
        if scene.drum.proximity(features[slot], center).is_some() {
            continue;
        }
        let heir = (0..features.len()).find(|&other| {
            features[other] != RIM
                && !records[other].history.is_touching()
                && scene.drum.adjacent(features[slot], features[other])
                && scene
                    .drum
                    .proximity(features[other], center)
                    .is_some_and(|near| near.distance < own.radius)
        });
        if let Some(heir) = heir {
            records[heir].history = std::mem::take(&mut records[slot].history);
        }
    }
}
