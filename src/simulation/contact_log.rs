//! What is recorded of contacts on request, added up: by kinds of bodies, along the drum's outline, by disc.
//!
//! Every energy that contacts take is in the ledger, too: each of these splits adds up to its columns, contacts that are still
//! open included. Sums grow when a contact ends, in the order in which contacts end, and as it moves along the drum's outline.

use serde::{Deserialize, Serialize};

use crate::engine::contacts::{ContactEvent, ContactTally, EventKind};
use crate::observe::contact_rows::{ContactRow, NO_BODY};
use crate::physics::columns::{Columns, Of};
use crate::physics::contact::Flows;
use crate::physics::contact::tally::{Exertion, Tally};
use crate::physics::drum::Drum;
use crate::physics::energy::Sum;
use crate::physics::particles::Particles;
use crate::physics::vector::{Vec2, dot};

/// Columns of a bin of the profile along the drum's outline.
pub const PROFILE_WIDTH: usize = 6;

/// Contacts that took less than the floor, all together.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct BelowFloor {
    /// How many they are.
    pub count: u64,
    /// What they took, as in a row [J/m].
    pub dissipated: [Sum; 3],
}

/// What contacts did to a disc, and its flights: spells without any contact.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct DiscAccount {
    /// Energy that its contacts took, half of it where the other body is a disc as well [J/m].
    pub received: Flows<Sum>,
    /// Contacts that it has.
    pub contacts: u32,
    /// Flights that have begun, one that it starts with included.
    pub flights: u32,
    /// Steps of the flights that have ended.
    pub flight_steps: u64,
    /// Flights that were falls.
    pub falls: u32,
    /// Flights that ended on the drum, and on another disc.
    pub landings: [u32; 2],
    /// The step at whose end the last flight began.
    taken_off: u64,
    /// How high the disc was then, against gravity [m].
    height: f64,
}

impl DiscAccount {
    fn take_off(&mut self, step: u64, height: f64) {
        (self.taken_off, self.height) = (step, height);
        self.flights = self.flights.saturating_add(1);
    }

    /// A contact more. Where it ends a flight, `least` says how long [steps] and how deep [m] a fall is at least.
    fn touch(&mut self, step: u64, height: f64, is_wall: bool, least: (f64, f64)) {
        self.contacts = self.contacts.saturating_add(1);
        if self.contacts > 1 {
            return;
        }
        let steps = step.saturating_sub(self.taken_off);
        self.flight_steps = self.flight_steps.saturating_add(steps);
        let landings = &mut self.landings[usize::from(!is_wall)];
        *landings = landings.saturating_add(1);
        if steps as f64 > least.0 && self.height - height > least.1 {
            self.falls = self.falls.saturating_add(1);
        }
    }

    fn part(&mut self, step: u64, height: f64) {
        self.contacts = self.contacts.saturating_sub(1);
        if self.contacts == 0 {
            self.take_off(step, height);
        }
    }

    /// Steps in flight so far.
    pub fn steps_in_flight(&self, now: u64) -> u64 {
        let current = if self.contacts == 0 { now.saturating_sub(self.taken_off) } else { 0 };
        self.flight_steps.saturating_add(current)
    }
}

/// The sums; those that are not asked for are empty.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ContactLog {
    /// Contacts below the floor.
    pub below_floor: BelowFloor,
    /// Energy taken [J/m], by pair of species, then by species and surface of the drum.
    pub split: Vec<Flows<Sum>>,
    /// By bin: energy taken as in a row, impulse, work of friction over μ, Finnie's integral.
    pub profile: Vec<[Sum; PROFILE_WIDTH]>,
    /// By disc, in id order.
    pub discs: Vec<DiscAccount>,
}

/// What the sums are made with.
#[derive(Debug, Clone, Copy)]
pub struct LogInputs<'a> {
    /// The discs.
    pub particles: &'a Particles,
    /// The drum.
    pub drum: &'a Drum,
    /// Number of species.
    pub species: usize,
    /// Gravity [m/s²].
    pub gravity: Vec2,
    /// Length of a step [s].
    pub time_step: f64,
}

impl LogInputs<'_> {
    /// Rows of the ledger's split.
    pub fn split_count(&self) -> usize {
        self.pair_count() + self.species * self.drum.surface_count()
    }

    fn pair_count(&self) -> usize {
        self.species * (self.species + 1) / 2
    }

    /// The row of a contact in the split of the ledger.
    fn split_of(&self, (particle, other): (u32, u32), is_wall: bool) -> usize {
        let species = |particle: u32| usize::from(self.particles.species[particle as usize]);
        let own = species(particle);
        if is_wall {
            return self.pair_count() + own * self.drum.surface_count() + self.drum.surface_of(other);
        }
        let (low, high) = (own.min(species(other)), own.max(species(other)));
        // Pairs are in the order of the first, then of the second, which is not before it.
        low * self.species - low * low.saturating_sub(1) / 2 + (high - low)
    }

    /// How high a point is, against gravity [m].
    fn height(&self, point: [f64; 2]) -> f64 {
        let strength = self.gravity.norm();
        if strength > 0.0 { -dot(self.gravity, point.into()) / strength } else { 0.0 }
    }

    /// A fall takes longer than half the time, and goes deeper than the length, of a fall by a diameter: [steps], [m].
    fn least_fall(&self, particle: u32) -> (f64, f64) {
        let diameter = 2.0 * self.particles.radii[particle as usize];
        (0.5 * (2.0 * diameter / self.gravity.norm()).sqrt() / self.time_step, diameter)
    }
}

impl ContactLog {
    /// Takes note of the contacts of discs at the start, each told by its place in memory; others are in flight.
    pub fn open(&mut self, inputs: LogInputs, visit_bodies: impl FnOnce(&mut dyn FnMut(usize))) {
        let Particles { ids, positions, .. } = inputs.particles;
        let Some(last) = self.discs.len().checked_sub(1) else { return };
        visit_bodies(&mut |place| self.discs[(ids[place] as usize).min(last)].contacts += 1);
        for (&id, &position) in ids.iter().zip(positions) {
            let disc = &mut self.discs[id as usize];
            if disc.contacts == 0 {
                disc.take_off(0, inputs.height(position.into()));
            }
        }
    }

    /// Takes note of an event. Returns the contact that has ended.
    pub fn note(&mut self, event: &ContactEvent, inputs: LogInputs) -> Option<ContactRow> {
        let &ContactEvent { step, kind, is_wall, key, ref centers, ref contact } = event;
        let count = if self.discs.is_empty() { 0 } else { 1 + usize::from(!is_wall) };
        let bodies = [key.0, key.1].into_iter().zip(centers).take(count);
        match kind {
            EventKind::Moved => {
                self.add_to_profile(contact);
                return None;
            }
            EventKind::Opened => {
                for (particle, &center) in bodies {
                    let disc = &mut self.discs[inputs.particles.ids[particle as usize] as usize];
                    disc.touch(step, inputs.height(center), is_wall, inputs.least_fall(particle));
                }
                return None;
            }
            EventKind::Ended => {
                for (particle, &center) in bodies {
                    let disc = &mut self.discs[inputs.particles.ids[particle as usize] as usize];
                    disc.part(step, inputs.height(center));
                }
            }
        }
        self.add(key, is_wall, contact, inputs);
        Some(row(step, key, is_wall, contact, inputs))
    }

    /// Adds what a contact has taken.
    pub fn add(&mut self, key: (u32, u32), is_wall: bool, contact: &ContactTally, inputs: LogInputs) {
        let (flows, _) = &contact.tally;
        if let Some(sums) = self.split.get_mut(inputs.split_of(key, is_wall)) {
            add_flows(sums, flows, 1.0);
        }
        if is_wall {
            self.add_to_profile(contact);
        }
        if !self.discs.is_empty() {
            let disc = |particle: u32| inputs.particles.ids[particle as usize] as usize;
            let share = if is_wall { 1.0 } else { 0.5 };
            add_flows(&mut self.discs[disc(key.0)].received, flows, share);
            if !is_wall {
                add_flows(&mut self.discs[disc(key.1)].received, flows, share);
            }
        }
    }

    /// Adds what a contact has done since it came into its bin.
    fn add_to_profile(&mut self, contact: &ContactTally) {
        let Some(bin) = self.profile.get_mut(contact.opening.bin as usize) else { return };
        let since = Tally::build(|column| {
            Tally::field(&contact.tally, column) - Tally::field(&contact.opening.told, column)
        });
        for (sum, value) in bin.iter_mut().zip(profile_values(&since)) {
            sum.add(value);
        }
    }

    /// Takes a contact below the floor.
    pub fn add_below_floor(&mut self, row: &ContactRow) {
        self.below_floor.count = self.below_floor.count.saturating_add(1);
        for (sum, &energy) in self.below_floor.dissipated.iter_mut().zip(&row.dissipated) {
            sum.add(energy);
        }
    }
}

/// A contact that ended, or is open, at a step.
pub fn row(
    step: u64,
    (particle, other): (u32, u32),
    is_wall: bool,
    contact: &ContactTally,
    inputs: LogInputs,
) -> ContactRow {
    let id = |particle: u32| inputs.particles.ids[particle as usize];
    let (own, other, part) = if is_wall {
        (id(particle), NO_BODY, inputs.drum.surface_of(other) as u32)
    } else {
        (id(particle).min(id(other)), id(particle).max(id(other)), NO_BODY)
    };
    let (flows, Exertion { greatest_force, .. }) = contact.tally;
    ContactRow {
        opened: contact.opening.step,
        ended: step,
        particle: own,
        other,
        part,
        dissipated: by_direction(&flows),
        speeds: contact.opening.speeds,
        greatest_force,
        point: contact.opening.point,
    }
}

/// Energies by the direction in which they were taken: along the normal, along the tangent, by rolling.
pub fn by_direction(flows: &Flows<f64>) -> [f64; 3] {
    [
        flows.dissipated_normal,
        flows.dissipated_sliding + flows.dissipated_tangential,
        flows.dissipated_rolling,
    ]
}

fn profile_values((flows, exertion): &Of<Tally, f64>) -> [f64; PROFILE_WIDTH] {
    let [normal, tangential, rolling] = by_direction(flows);
    let Exertion { normal_impulse, normal_force_slip, finnie, .. } = *exertion;
    [normal, tangential, rolling, normal_impulse, normal_force_slip, finnie]
}

fn add_flows(sums: &mut Flows<Sum>, flows: &Flows<f64>, share: f64) {
    for flow in 0..Flows::COUNT {
        Flows::field_mut(sums, flow).add(share * Flows::field(flows, flow));
    }
}
