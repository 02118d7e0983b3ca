//! What is recorded of contacts on request: tallies of what each has done, and events when it opens, moves on and ends.
//!
//! A tally lies beside its contact's block, and goes where the contact goes. Events are left with the chunk that owns the
//! contact; whoever goes through them does so step by step, in the order of the chunks, so that neither threads nor the time of
//! going through them shows.

use super::outlines::Spot;
use super::pass::{ChunkStep, Scratch};
use crate::engine::contacts::{BlockTally, ContactEvent, ContactList, EventKind, ListKind, NO_BIN, Opening};
use crate::engine::motion::{MotionView, offset};
use crate::engine::simd::{F64x4, LANES};
use crate::physics::columns::Columns;
use crate::physics::contact::gross_work::GrossWork;
use crate::physics::contact::law::ContactLaw;
use crate::physics::contact::tally::Exertion;
use crate::physics::contact::{Flows, Kinematics, Response};
use crate::physics::drum::RIM;
use crate::physics::vector::{Vec2, dot, perpendicular};

/// Steps from one look at the bins of the contacts with the drum to the next: in that time a bundle slides a small part of one.
const BIN_STEPS: u64 = 32;

/// What is recorded of a block.
pub struct BlockRecords<'a> {
    /// The sums of gross work, where that is: in memory, which costs other runs nothing but to ask.
    pub gross_work: Option<&'a mut GrossWork<[f64; LANES]>>,
    /// What its contacts have done since they opened, where that is.
    pub tally: Option<&'a mut BlockTally>,
    /// Whether they are with the drum.
    pub at_wall: bool,
}

/// Adds one step of a block.
#[inline(always)]
pub fn add<L: ContactLaw>(
    tally: &mut BlockTally,
    contact: &Kinematics<F64x4>,
    response: &Response<F64x4>,
    at_wall: bool,
) {
    for (flow, sum) in tally.iter_mut().enumerate().take(Flows::COUNT) {
        if Flows::field(&L::FLOWS, flow) {
            *sum = (F64x4::new(*sum) + Flows::field(&response.flows, flow)).to_array();
        }
    }
    // The columns of `Exertion` come after those of `Flows`.
    if at_wall {
        let before = Exertion::build(|column| F64x4::new(tally[Flows::COUNT + column]));
        let now = before.plus(Exertion::of_wall_step(contact, response));
        for column in 0..Exertion::COUNT {
            tally[Flows::COUNT + column] = Exertion::field(&now, column).to_array();
        }
    } else {
        let greatest = &mut tally[Flows::COUNT];
        *greatest = response.normal_force.fast_max(F64x4::new(*greatest)).to_array();
    }
}

/// Adds the gross work of one step of a block.
#[inline(always)]
pub fn add_gross_work(sums: &mut GrossWork<[f64; LANES]>, new: &GrossWork<F64x4>) {
    *sums = GrossWork::build(|way| {
        (F64x4::new(GrossWork::field(sums, way)) + GrossWork::field(new, way)).to_array()
    });
}

impl<V: MotionView> ChunkStep<'_, V> {
    /// Takes note of how the contacts from `first` on begin.
    #[cold]
    pub fn note_opened<L: ContactLaw>(&mut self, list: &mut ContactList<L>, first: usize) {
        for index in first..list.len() {
            let (particle, other) = list.key(index);
            let (normal, point) = self.touch(list.kind, particle, other);
            let own = self.velocity_at(particle, point);
            let theirs = if list.kind == ListKind::Walls {
                perpendicular(point) * self.inputs.angular_velocity
            } else {
                self.velocity_at(other, point)
            };
            let relative = theirs - own;
            list.openings[index] = Opening {
                step: self.inputs.step,
                speeds: [-dot(relative, normal), dot(relative, perpendicular(normal)).abs()],
                point: point.into(),
                bin: self.bin_of(list.kind, particle, other),
                ..Opening::default()
            };
            self.tell(EventKind::Opened, list, index);
        }
    }

    /// Takes note of the contacts that have ended.
    #[inline]
    pub fn note_ended<L: ContactLaw>(&mut self, list: &ContactList<L>) {
        let Scratch { ended, .. } = &*self.scratch;
        let blocks = ended.blocks(list.len());
        if !blocks.is_empty() {
            let blocks = blocks.to_vec();
            self.note_ended_in(&blocks, list);
        }
    }

    #[cold]
    fn note_ended_in<L: ContactLaw>(&mut self, blocks: &[u32], list: &ContactList<L>) {
        for index in
            blocks.iter().flat_map(|&block| (0..LANES).map(move |lane| LANES * block as usize + lane))
        {
            if index < list.len() && list.blocks[index / LANES].state.overlap[index % LANES] == 0.0 {
                self.tell(EventKind::Ended, list, index);
            }
        }
    }

    /// Takes note of contacts with the drum that have come into other bins.
    #[inline]
    pub fn note_moved<L: ContactLaw>(&mut self, list: &mut ContactList<L>) {
        let is_due = self.inputs.step.is_multiple_of(BIN_STEPS);
        if list.kind != ListKind::Walls || self.inputs.profile.is_none() || !is_due {
            return;
        }
        self.note_moved_in(list);
    }

    #[cold]
    fn note_moved_in<L: ContactLaw>(&mut self, list: &mut ContactList<L>) {
        for index in 0..list.len() {
            let (particle, feature) = list.key(index);
            let (bin, before) = (self.bin_of(list.kind, particle, feature), list.openings[index].bin);
            if bin != before {
                if before != NO_BIN {
                    self.tell(EventKind::Moved, list, index);
                }
                list.openings[index].told = list.tally(index).tally;
                list.openings[index].bin = bin;
            }
        }
    }

    fn tell<L: ContactLaw>(&mut self, kind: EventKind, list: &ContactList<L>, index: usize) {
        let key = list.key(index);
        let is_wall = list.kind == ListKind::Walls;
        let center = self.motion.position(offset(key.0));
        let other = if is_wall { center } else { self.motion.position(offset(key.1)) };
        let mut contact = list.tally(index);
        if contact.opening.bin == NO_BIN {
            contact.opening.bin = self.bin_of(list.kind, key.0, key.1);
        }
        let step = self.inputs.step;
        self.events.push(ContactEvent { step, kind, is_wall, key, centers: [center, other], contact });
    }

    /// Where two bodies meet: the normal from the first to the second, and the point in which they touch.
    fn touch(&self, kind: ListKind, particle: u32, other: u32) -> (Vec2, Vec2) {
        let position = |particle: u32| Vec2::from(self.motion.position(offset(particle)));
        let (center, radius) = (position(particle), self.inputs.bodies.radius_of(particle));
        let normal = match kind {
            ListKind::Walls if other == RIM => center.normalize(),
            ListKind::Walls => Spot::of(particle, other, self.motion, self.inputs).unwrap_or_default().normal,
            _ => (position(other) - center).normalize(),
        };
        (normal, center + normal * radius)
    }

    /// The velocity of a particle's material at a point [m/s].
    fn velocity_at(&self, particle: u32, point: Vec2) -> Vec2 {
        let offset = offset(particle);
        let lever = point - Vec2::from(self.motion.position(offset));
        Vec2::from(self.motion.velocity(offset)) + perpendicular(lever) * self.motion.angular_velocity(offset)
    }

    /// The bin of the drum's outline that a contact is in; none where there are no bins, or the other body is a particle.
    fn bin_of(&self, kind: ListKind, particle: u32, feature: u32) -> u32 {
        match self.inputs.profile {
            Some(bins) if kind == ListKind::Walls => {
                let center = Vec2::from(self.motion.position(offset(particle)));
                bins.bin_of(self.inputs.drum, feature, self.inputs.rotation.apply_inverse(center))
            }
            _ => NO_BIN,
        }
    }
}
