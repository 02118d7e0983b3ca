//! Checkpoints: a versioned, digested snapshot of configuration and state, from which a run goes on bit for bit, with the
//! records that have not been taken yet.
//!
//! Layout: magic (8 bytes), version (u32, little endian), SHA-256 of the rest (32 bytes), the rest in postcard.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::PHYSICS_VERSION;
use crate::engine::contacts::ContactRecord;
use crate::engine::parallel::chunk_count;
use crate::error::Error;
use crate::io::config::SimulationConfig;
use crate::observe::contact_rows::ContactRow;
use crate::observe::frames::Frames;
use crate::observe::memory;
use crate::physics::drum::Drum;
use crate::simulation::initial_state::sorted_keys;
use crate::simulation::state::{EngineState, State};
use crate::simulation::{Records, Simulation};

const MAGIC: &[u8; 8] = b"DRUMRS\r\n";
/// Version of the layout below; a checkpoint of another one is refused.
pub const FORMAT_VERSION: u32 = 10;
/// Beyond this, step × time step is no longer exact to a step.
const MOST_STEPS: u64 = 1 << 53;
const HEADER: usize = MAGIC.len() + 4 + 32;

/// What a checkpoint holds: borrowed where it is written, since the records may be larger than all the rest.
#[derive(Serialize, Deserialize)]
struct Snapshot<'a> {
    physics_version: u32,
    config: String,
    seed: u64,
    state: Cow<'a, State>,
    engine: EngineState,
    rows: Cow<'a, [f64]>,
    frames: Cow<'a, Frames>,
    contacts: Cow<'a, [ContactRow]>,
}

fn refuse(reason: impl Into<String>) -> Error {
    Error::Checkpoint { reason: reason.into() }
}

impl Simulation {
    /// This simulation as bytes.
    ///
    /// # Errors
    /// The error that stopped the simulation, if one did: there is nothing good to keep. `Error::Memory` where there is no
    /// room for the bytes.
    pub fn to_checkpoint(&self) -> Result<Vec<u8>, Error> {
        let snapshot = self.snapshot()?;
        let refused = |error: postcard::Error| refuse(error.to_string());
        let size = HEADER + write(&snapshot, None).map_err(refused)?;
        let mut bytes = Vec::new();
        memory::reserve(&mut bytes, size, "writing a checkpoint")?;
        bytes.resize(size, 0);
        let (header, body) = bytes.split_at_mut(HEADER);
        write(&snapshot, Some(body)).map_err(refused)?;
        let (magic, rest) = header.split_at_mut(MAGIC.len());
        let (version, digest) = rest.split_at_mut(4);
        magic.copy_from_slice(MAGIC);
        version.copy_from_slice(&FORMAT_VERSION.to_le_bytes());
        digest.copy_from_slice(&Sha256::digest(&*body));
        Ok(bytes)
    }

    /// The simulation that these bytes hold.
    pub fn from_checkpoint(bytes: &[u8], threads: usize) -> Result<Self, Error> {
        // What is read takes up to twice as much while its lists grow.
        memory::reserve(&mut Vec::<u8>::new(), bytes.len().saturating_mul(2), "reading a checkpoint")?;
        let snapshot = read(bytes)?;
        let config =
            SimulationConfig::from_json(&snapshot.config).map_err(|error| refuse(error.to_string()))?;
        snapshot.resume(config, threads)
    }

    /// This simulation under another configuration: it goes on from the same state, with the records that were not taken.
    ///
    /// # Errors
    /// As `to_checkpoint` and `from_checkpoint`, of which it is the same without the bytes.
    pub fn with_config(&self, config: SimulationConfig) -> Result<Self, Error> {
        memory::reserve(&mut Vec::<u8>::new(), self.untaken_size(), "changing a configuration")?;
        self.snapshot()?.resume(config, self.threads())
    }

    fn snapshot(&self) -> Result<Snapshot<'_>, Error> {
        if let Some(failure) = self.failure() {
            return Err(failure.clone());
        }
        Ok(Snapshot {
            physics_version: PHYSICS_VERSION,
            config: self.config().to_json(),
            seed: self.seed(),
            state: Cow::Borrowed(self.state()),
            engine: self.engine_state(),
            rows: self.records().untaken_rows().into(),
            frames: Cow::Borrowed(self.frames()),
            contacts: self.records().contacts.as_slice().into(),
        })
    }
}

impl Snapshot<'_> {
    /// The simulation that goes on from it under a configuration.
    fn resume(self, config: SimulationConfig, threads: usize) -> Result<Simulation, Error> {
        let drum = check(&self.state, &self.engine, &config)?;
        let mut records = Records::new(&drum, &config.run.record);
        records.series.prepend(&self.rows)?;
        records.frames = self.frames.into_owned();
        records.contacts = self.contacts.into_owned();
        check_records(&self.state, &records, self.rows.len())?;
        let state = self.state.into_owned();
        let simulation = Simulation::resume(config, self.seed, threads, state, &self.engine, records)?;
        if simulation.has_whole_log(&self.engine) {
            return Ok(simulation);
        }
        Err(refuse("its sums of contacts, fields or visits are not those of its bundles and its drum"))
    }
}

/// Writes a snapshot where there is room for it, and returns how many bytes it takes. Counting goes through the same code as writing:
/// it would be compiled twice otherwise.
#[inline(never)]
fn write(snapshot: &Snapshot, room: Option<&mut [u8]>) -> postcard::Result<usize> {
    postcard::serialize_with_flavor(snapshot, Buffer { room, written: 0 })
}

struct Buffer<'a> {
    room: Option<&'a mut [u8]>,
    written: usize,
}

impl postcard::ser_flavors::Flavor for Buffer<'_> {
    type Output = usize;

    fn try_extend(&mut self, data: &[u8]) -> postcard::Result<()> {
        let end = self.written + data.len();
        if let Some(room) = &mut self.room {
            let place = room.get_mut(self.written..end).ok_or(postcard::Error::SerializeBufferFull)?;
            place.copy_from_slice(data);
        }
        self.written = end;
        Ok(())
    }

    fn try_push(&mut self, byte: u8) -> postcard::Result<()> {
        self.try_extend(&[byte])
    }

    fn finalize(self) -> postcard::Result<usize> {
        Ok(self.written)
    }
}

fn read(bytes: &[u8]) -> Result<Snapshot<'_>, Error> {
    if bytes.len() < HEADER || !bytes.starts_with(MAGIC) {
        return Err(refuse("it is not a drumrs checkpoint, or cut short"));
    }
    let (version, rest) = bytes[MAGIC.len()..].split_at(4);
    let (digest, body) = rest.split_at(32);
    if version != FORMAT_VERSION.to_le_bytes() {
        let found = version.iter().rev().fold(0_u32, |sum, &byte| (sum << 8) | u32::from(byte));
        return Err(refuse(format!(
            "it has format version {found}, this drumrs reads version {FORMAT_VERSION}"
        )));
    }
    if digest != Sha256::digest(body).as_slice() {
        return Err(refuse("its content does not match its digest: it is damaged or cut short"));
    }
    let snapshot: Snapshot =
        postcard::from_bytes(body).map_err(|error| refuse(format!("its content is malformed: {error}")))?;
    if snapshot.physics_version != PHYSICS_VERSION {
        return Err(refuse(format!(
            "it was made by physics version {}, this drumrs has version {PHYSICS_VERSION}",
            snapshot.physics_version
        )));
    }
    Ok(snapshot)
}

/// Refuses records that are not those of a state.
fn check_records(state: &State, records: &Records, values: usize) -> Result<(), Error> {
    let (samples, frames) = (records.series.len(), records.frames.len());
    let recorded = &state.recorded;
    let whole = values == samples * records.series.width() && records.frames.are_of(state.particles.len());
    let contacts = records.contacts.len() as u64;
    let counted = samples as u64 <= recorded.samples
        && frames as u64 <= recorded.frames
        && (contacts..=MOST_STEPS).contains(&recorded.contacts);
    // At most one of each in a step, and one of each at the start.
    if whole && counted && recorded.samples.max(recorded.frames) <= state.step + 1 {
        return Ok(());
    }
    Err(refuse("its series, frames or contacts are not those of its bundles"))
}

/// Refuses a state whose parts do not belong together, which a matching digest alone does not rule out; returns its drum.
fn check(state: &State, engine: &EngineState, config: &SimulationConfig) -> Result<Drum, Error> {
    let refused = |error: Error| refuse(error.to_string());
    let drum = Drum::new(&config.drum).map_err(refused)?;
    let table = config.contact.table().map_err(refused)?;
    state.particles.validate().map_err(refused)?;
    let ensure = |holds: bool, reason: &str| if holds { Ok(()) } else { Err(refuse(reason)) };
    let (particles, count) = (&state.particles, state.particles.len());
    let is_run = count > 0 && state.step <= MOST_STEPS && state.initial_angle.is_finite();
    ensure(is_run, "it holds no bundle, or more steps than a run can have")?;
    let is_there = |&species: &u16| usize::from(species) < table.count();
    ensure(particles.species.iter().all(is_there), "a bundle is of a species that is not there")?;
    let fits = drum.bounding_radius().is_none_or(|rim| particles.largest_radius() < rim);
    ensure(fits, "a bundle is larger than its drum")?;
    let has_accounts = state.ledger.surfaces.len() == drum.surface_count();
    ensure(has_accounts, "its accounts are not those of its drum")?;
    ensure(engine.totals.len() == chunk_count(count), "its sums are not those of its bundles")?;
    let EngineState { contacts, .. } = engine;
    let ordered = contacts.pairs.iter().all(|contact| contact.particle < contact.other);
    let known = |contacts: &[ContactRecord], others: u32| {
        let keys = sorted_keys(contacts);
        keys.iter().all(|&(particle, other)| (particle as usize) < count && other < others)
            && keys.windows(2).all(|two| two[0] != two[1])
            && contacts.iter().all(|contact| contact.overlap > 0.0)
    };
    let are_known =
        ordered && known(&contacts.pairs, count as u32) && known(&contacts.walls, drum.feature_count());
    ensure(are_known, "its contacts are not those of its bundles")?;
    Ok(drum)
}
