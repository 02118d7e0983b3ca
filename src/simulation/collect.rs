//! From the events of contacts to what is recorded of them, and how that is shown.

use super::Simulation;
use super::contact_log::{ContactLog, DiscAccount, LogInputs, row};
use super::state::EngineState;
use crate::engine::contacts::{ContactRecord, ContactTally, NO_BIN};
use crate::engine::forces::{Lists, Totals};
use crate::error::Error;
use crate::observe::contact_rows::{ContactRow, NO_BODY};
use crate::observe::memory;
use crate::observe::recorder::Recording;
use crate::physics::columns::Columns;
use crate::physics::contact::Flows;
use crate::physics::drum::bins::ArcBin;
use crate::physics::rotation::RotationSchedule;
use crate::physics::vector::{Rotation, Vec2};

impl Simulation {
    /// Whether something is recorded on request.
    pub fn is_recorded(&self, recording: Recording) -> bool {
        self.config.run.record.contains(&recording)
    }

    pub(super) fn log_inputs(&self) -> LogInputs<'_> {
        LogInputs {
            particles: &self.state.particles,
            drum: &self.derived.drum,
            species: self.derived.table.count(),
            gravity: self.derived.gravity,
            time_step: self.derived.time_step,
        }
    }

    /// Sums of nothing yet, of what is recorded.
    pub(super) fn empty_log(&self) -> ContactLog {
        let sized = |recording, count: usize| if self.is_recorded(recording) { count } else { 0 };
        let inputs = self.log_inputs();
        ContactLog {
            split: vec![Flows::default(); sized(Recording::LedgerSplit, inputs.split_count())],
            profile: vec![
                Default::default();
                self.derived.profile.as_ref().map_or(0, |bins| bins.bins.len())
            ],
            discs: vec![DiscAccount::default(); sized(Recording::Discs, inputs.particles.len())],
            ..ContactLog::default()
        }
    }

    /// Whether sums, tallies and events are those of this load in this drum: of a state that was read.
    pub(crate) fn has_whole_log(&self, engine: &EngineState) -> bool {
        let EngineState { contacts, events, .. } = engine;
        let (log, empty, count) = (&self.state.log, self.empty_log(), self.state.particles.len());
        let tallied = if self.derived.records_contacts { contacts.counts() } else { (0, 0) };
        let is_body = |&(particle, other): &(u32, u32), is_wall: bool| {
            let others = if is_wall { self.derived.drum.feature_count() as usize } else { count };
            (particle as usize) < count && (other as usize) < others
        };
        let surfaces = self.derived.drum.surface_count();
        let is_part = |row: &ContactRow| row.part == NO_BODY || (row.part as usize) < surfaces;
        (contacts.pair_tallies.len(), contacts.wall_tallies.len()) == tallied
            && [log.split.len(), log.profile.len(), log.discs.len()]
                == [empty.split.len(), empty.profile.len(), empty.discs.len()]
            && events.iter().all(|event| is_body(&event.key, event.is_wall))
            && self.records.contacts.iter().all(is_part)
            && self.has_whole_sums()
    }

    /// Begins the records of contacts; what opened them has happened before any step.
    pub(super) fn open_log(&mut self) {
        self.engine.pass_mut().set_events(Vec::new());
        let mut log = self.empty_log();
        log.open(self.log_inputs(), |visit| self.engine.pass().visit_bodies(visit));
        self.state.log = log;
    }

    /// Goes through what has happened to contacts since the last time. When it is done shows in no record.
    pub(super) fn collect(&mut self) -> Result<(), Error> {
        let count = self.engine.pass().event_count();
        if count == 0 {
            return Ok(());
        }
        let lists_contacts = self.is_recorded(Recording::Contacts);
        if lists_contacts {
            memory::reserve(&mut self.records.contacts, count, "recording contacts")?;
        }
        let mut events = self.engine.pass().events();
        self.engine.pass_mut().set_events(Vec::new());
        // Step by step; in a step those of a kind keep the order of the chunks.
        events.sort_by_key(|event| (event.step, event.kind));
        let mut log = std::mem::take(&mut self.state.log);
        for event in &events {
            let ended = log.note(event, self.log_inputs());
            if let Some(row) = ended.filter(|_| lists_contacts) {
                if row.energy() < self.config.run.contact_floor {
                    log.add_below_floor(&row);
                } else {
                    self.records.contacts.push(row);
                    self.state.recorded.contacts += 1;
                }
            }
        }
        self.state.log = log;
        Ok(())
    }

    /// Energy that contacts took from the start until now [J/m]: what each split adds up to.
    pub fn dissipated(&self) -> Flows<f64> {
        let chunks = self.engine.pass().totals();
        let since = chunks.into_iter().map(|mut totals| totals.fold()).fold(Totals::default(), Totals::plus);
        Flows::build(|flow| self.state.ledger.flow(flow) + Flows::field(&since.flows, flow))
    }

    /// The sums, contacts that are still open included.
    pub fn contact_log(&self) -> ContactLog {
        let (mut log, inputs) = (self.state.log.clone(), self.log_inputs());
        for (record, contact, is_wall) in self.open_contacts(&self.contacts()) {
            log.add(record.key(), is_wall, &contact, inputs);
        }
        log
    }

    /// The contacts that are still open, with what they have done so far; above the floor or not.
    pub fn open_rows(&self) -> Vec<ContactRow> {
        let (lists, inputs, step) = (self.contacts(), self.log_inputs(), self.state.step);
        let open = self.open_contacts(&lists);
        open.map(|(record, contact, is_wall)| row(step, record.key(), is_wall, &contact, inputs)).collect()
    }

    /// Contacts with their tallies, and whether they are with the drum.
    fn open_contacts<'a>(
        &'a self,
        lists: &'a Lists,
    ) -> impl Iterator<Item = (&'a ContactRecord, ContactTally, bool)> {
        let pairs =
            lists.pairs.iter().zip(&lists.pair_tallies).map(|(record, &contact)| (record, contact, false));
        let walls =
            lists.walls.iter().zip(&lists.wall_tallies).map(|(record, &contact)| (record, contact, true));
        pairs.chain(walls).map(|(record, mut contact, is_wall)| {
            if is_wall && contact.opening.bin == NO_BIN {
                contact.opening.bin = self.bin_of(record);
            }
            (record, contact, is_wall)
        })
    }

    fn bin_of(&self, record: &ContactRecord) -> u32 {
        let Some(bins) = &self.derived.profile else { return NO_BIN };
        let center: Vec2 = self.state.particles.positions[record.particle as usize];
        bins.bin_of(&self.derived.drum, record.other, Rotation::new(self.drum_angle()).apply_inverse(center))
    }

    /// The bins of the profile along the drum's outline, where it is recorded.
    pub fn profile_bins(&self) -> &[ArcBin] {
        self.derived.profile.as_ref().map_or(&[], |bins| &bins.bins)
    }

    /// The drum's angle at the end of a step [rad].
    pub fn drum_angle_at(&self, step: u64) -> f64 {
        let rotation: &RotationSchedule = &self.config.rotation;
        self.state.initial_angle + rotation.angle_by(&self.derived.angles_at_knots, self.time_at(step))
    }
}
