//! What is summed up by place on request: fields in cells, at samples, and visits to zones, every 32 steps.

use super::Simulation;
use super::run::CHECK_STEPS;
use super::state::{PlaceSums, State};
use crate::observe::fields::{FieldGrid, FieldSums};
use crate::observe::visits::Visits;
use crate::physics::drum::RIM;
use crate::physics::drum::zone::Zone;
use crate::physics::vector::{Rotation, Vec2};

impl Simulation {
    /// Nothing yet, of what is summed up.
    pub(super) fn open_sums(&mut self) {
        self.state.fields = self.derived.grid.as_ref().map(FieldSums::new).unwrap_or_default();
        self.state.visits = vec![Visits::default(); self.visit_count()];
    }

    /// Whether sums are those of these cells, zones and discs: of a state that was read.
    pub(super) fn has_whole_sums(&self) -> bool {
        let cells = self.derived.grid.map_or(0, |grid| grid.cell_count());
        let is_whole = |fields: &FieldSums, visits: &[Visits]| {
            fields.cells.len() == cells && visits.len() == self.visit_count()
        };
        is_whole(&self.state.fields, &self.state.visits)
            && self.state.told.as_ref().is_none_or(|own| is_whole(&own.fields, &own.visits))
    }

    /// Lets fields and visits be told as they are at a time [s]. They are summed up beyond it, so that a later time, where the
    /// run goes on, leaves nothing out.
    pub fn tell_sums_until(&mut self, time: f64) {
        self.state.last_told = Some((time / self.derived.time_step).round() as u64);
        self.state.told = None;
    }

    /// The fields and the visits to be told: up to now, or to an earlier time that was asked for.
    pub fn told_sums(&self) -> (&FieldSums, &[Visits]) {
        match &self.state.told {
            Some(told) => (&told.fields, &told.visits),
            None => (&self.state.fields, &self.state.visits),
        }
    }

    /// Keeps the sums as they are, before what comes after the last step to be told is added.
    fn keep_told_sums(&mut self) {
        let State { step, last_told, told, fields, visits, .. } = &mut self.state;
        if last_told.is_some_and(|last| *step > last) && told.is_none() {
            *told = Some(PlaceSums { fields: fields.clone(), visits: visits.clone() });
        }
    }

    fn visit_count(&self) -> usize {
        self.derived.zones.len() * self.state.particles.len()
    }

    /// Looks which particle is in which zone, where that is due. The steps at which it is are fixed, so that nothing else shows in it.
    pub(super) fn count_visits(&mut self) {
        let (step, first) = (self.state.step, self.derived.first_summed.max(1));
        if self.derived.zones.is_empty() || step < first || !step.is_multiple_of(CHECK_STEPS) {
            return;
        }
        self.keep_told_sums();
        let (number, is_first) = (step / CHECK_STEPS, step - first < CHECK_STEPS);
        let turns = self.derived.zones.iter().any(Zone::turns);
        let drum = if turns { Rotation::new(self.drum_angle()) } else { Rotation::IDENTITY };
        let particles = &self.state.particles;
        let by_zone = self.state.visits.chunks_mut(particles.len());
        for (zone, visits) in self.derived.zones.iter().zip(by_zone) {
            for (&id, &position) in particles.ids.iter().zip(&particles.positions) {
                visits[id as usize].note(number, zone.contains(position, drum), is_first);
            }
        }
    }

    /// Adds what is here and now to the fields, where they are recorded.
    pub(super) fn add_to_fields(&mut self) {
        let Some(grid) = self.derived.grid.filter(|_| self.state.step >= self.derived.first_summed) else {
            return;
        };
        self.keep_told_sums();
        let mut sums = std::mem::take(&mut self.state.fields);
        let drum = Rotation::new(self.drum_angle());
        let positions = &self.state.particles.positions;
        sums.add_discs(&grid, &self.state.particles);
        self.engine.pass().visit_forces(&mut |(particle, other), is_wall, force| {
            let center = positions[particle as usize];
            let branch = if is_wall {
                self.branch_to_drum(other, center, drum)
            } else {
                positions[other as usize] - center
            };
            sums.add_contact(&grid, center, branch, force);
        });
        self.state.fields = sums;
    }

    /// From the center of a disc to where it touches a feature of the drum [m]. Where another feature answers for that one, no
    /// force acts either.
    fn branch_to_drum(&self, feature: u32, center: Vec2, drum: Rotation) -> Vec2 {
        if feature == RIM {
            let distance = center.norm();
            return center * (self.derived.drum.radius().unwrap_or(distance) / distance - 1.0);
        }
        let near = self.derived.drum.proximity(feature, drum.apply_inverse(center));
        near.map_or(Vec2::zeros(), |near| drum.apply(near.direction) * near.distance)
    }

    /// The cells of fields, where they are recorded.
    pub fn grid(&self) -> Option<FieldGrid> {
        self.derived.grid
    }

    /// Time between two looks at the zones [s].
    pub fn visit_interval(&self) -> f64 {
        CHECK_STEPS as f64 * self.derived.time_step
    }
}
