//! `SimulationConfig`: everything that defines a simulation, composed from the parameters of its parts.
//!
//! All values are SI and per metre of drum depth. Defaults live in the Python package only: here every field has to
//! be given, and unknown fields are refused. (Serde lets a missing `Option` pass as none, unless a field names how to read
//! it.)

use serde::{Deserialize, Serialize};

use crate::error::{Error, require, require_finite, require_non_negative, require_positive};
use crate::observe::recorder::Recording;
use crate::physics::contact::parameters::ContactParameters;
use crate::physics::contact::species::SpeciesTable;
use crate::physics::drum::DrumParameters;
use crate::physics::drum::zone::ZoneParameters;
use crate::physics::load::composition::{Composition, Discs, SpeciesParameters};
use crate::physics::load::shares::Measure;
use crate::physics::rotation::RotationSchedule;

/// A complete simulation, as it crosses the border from Python in JSON.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SimulationConfig {
    /// Rim, baffles and straight walls.
    pub drum: DrumParameters,
    /// Angular velocity over time.
    pub rotation: RotationSchedule,
    /// The bundles.
    pub load: LoadParameters,
    /// The contact laws.
    pub contact: ContactTables,
    /// Gravity [m/s²], (x, y).
    pub gravity: [f64; 2],
    /// Time step, recording, guards.
    pub run: RunParameters,
}

/// The load: equal discs, or species. (A given initial state may hold discs of any size.)
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LoadParameters {
    /// Number of bundles.
    pub count: usize,
    /// Diameter d [m] where there are no species.
    pub diameter: f64,
    /// Density ρ [kg/m³], likewise; a bundle's mass is ρ π d²/4 per metre of depth.
    pub density: f64,
    /// What the load is made of; none for equal bundles.
    pub species: Vec<SpeciesParameters>,
    /// What their shares are counted by.
    pub share_by: Measure,
    /// Every bundle starts with this speed [m/s] in a random direction; 0 starts at rest.
    pub start_speed: f64,
    /// Bundles do not spin, as if their moment of inertia were infinite.
    pub spin_locked: bool,
}

/// What acts between two species.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PairLaw {
    /// The two, by their place in the list of species; the same twice for two bundles of one species.
    pub between: [u16; 2],
    /// What a user writes before its keys.
    pub key: String,
    /// The law.
    pub parameters: ContactParameters,
}

/// What acts between a species and the drum.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WallLaw {
    /// Its place in the list of species.
    pub species: u16,
    /// What a user writes before its keys.
    pub key: String,
    /// The law.
    pub parameters: ContactParameters,
}

/// One law for two bundles, one for a bundle and the drum; others between species.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ContactTables {
    /// Bundle against bundle.
    pub bundle: ContactParameters,
    /// Bundle against rim, baffle or wall.
    pub drum: ContactParameters,
    /// Number of species.
    pub species: usize,
    /// What acts between two species instead of `bundle`.
    pub pairs: Vec<PairLaw>,
    /// What acts between a species and the drum instead of `drum`.
    pub walls: Vec<WallLaw>,
}

/// The most species that a load may have: the table of laws grows with the square.
pub const MOST_SPECIES: usize = 256;

impl ContactTables {
    /// The table of laws.
    pub fn table(&self) -> Result<SpeciesTable, Error> {
        let is_possible = (1..=MOST_SPECIES).contains(&self.species);
        let limit = format!("between 1 and {MOST_SPECIES}");
        require(is_possible, "the number of species", self.species, limit)?;
        let mut table = SpeciesTable::new(self.species, &self.bundle, &self.drum);
        for PairLaw { between: [one, other], parameters, .. } in &self.pairs {
            table.set_pair(*one, *other, parameters)?;
        }
        for WallLaw { species, parameters, .. } in &self.walls {
            table.set_wall(*species, parameters)?;
        }
        Ok(table)
    }

    /// The key of what acts between two species; of several that say it, the last counts.
    pub fn pair_key(&self, one: u16, other: u16) -> String {
        let is_theirs = |law: &&PairLaw| law.between == [one, other] || law.between == [other, one];
        self.pairs.iter().rfind(is_theirs).map_or("contact.bundle", |law| &law.key).into()
    }

    /// The key of what acts between a species and the drum.
    pub fn wall_key(&self, species: u16) -> String {
        self.walls.iter().rfind(|law| law.species == species).map_or("contact.drum", |law| &law.key).into()
    }

    fn validate(&self) -> Result<(), Error> {
        self.bundle.validate("contact.bundle")?;
        self.drum.validate("contact.drum")?;
        self.pairs.iter().try_for_each(|law| law.parameters.validate(&law.key))?;
        self.walls.iter().try_for_each(|law| law.parameters.validate(&law.key))?;
        let table = self.table()?;
        if let Some(other) = table.all().find(|parameters| parameters.base != self.bundle.base) {
            let (found, base) = (format!("{:?}", other.base), format!("{:?}", self.bundle.base));
            let limit = format!("{} in every table: a run has one base law", base.to_lowercase());
            return Err(Error::config("contact.base", found.to_lowercase(), limit));
        }
        Ok(())
    }
}

/// How to run: time step, recording intervals, guards.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunParameters {
    /// Time step [s]; none takes the shortest collision time / 50.
    #[serde(deserialize_with = "Option::deserialize")]
    pub time_step: Option<f64>,
    /// Interval between samples of the series [s].
    pub sample_every: f64,
    /// Interval between frames [s].
    pub frame_every: f64,
    /// Margin of the neighbor list [m]; none takes the measured best. It never changes a result.
    #[serde(deserialize_with = "Option::deserialize")]
    pub skin: Option<f64>,
    /// What is recorded beside what always is.
    pub record: Vec<Recording>,
    /// Energy [J/m] below which contacts are not listed one by one.
    pub contact_floor: f64,
    /// Width of the bins along the drum's outline [m]; none takes a twentieth of the drum's radius.
    #[serde(deserialize_with = "Option::deserialize")]
    pub arc_bin: Option<f64>,
    /// Side of the cells of fields [m]; none takes the mean radius of the bundles.
    #[serde(deserialize_with = "Option::deserialize")]
    pub cell: Option<f64>,
    /// Zones whose visits are counted.
    pub zones: Vec<ZoneParameters>,
    /// Time [s] from which fields are summed up and visits counted.
    pub sums_from: f64,
    /// Greatest overlap allowed, as a fraction of the smaller radius.
    pub overlap_limit: f64,
}

impl SimulationConfig {
    /// Reads a configuration from JSON and checks it.
    pub fn from_json(text: &str) -> Result<Self, Error> {
        let config: Self = serde_json::from_str(text)
            .map_err(|error| Error::config("config", format!("'{error}'"), "valid JSON with every field"))?;
        config.validate()?;
        Ok(config)
    }

    /// The configuration as JSON; reading it back gives the same bits.
    #[allow(clippy::missing_panics_doc)] // It cannot: the tree has string keys and plain values only.
    pub fn to_json(&self) -> String {
        serde_json::to_string(self).expect("a tree of plain structs always serializes")
    }

    /// Checks every field against its limits, and the fields against each other.
    pub fn validate(&self) -> Result<(), Error> {
        self.drum.validate()?;
        self.rotation.validate()?;
        self.load.validate(self.drum.bounding_radius())?;
        self.contact.validate()?;
        let (own, laws) = (self.load.species.len(), self.contact.species);
        let limit = format!("{own}, as many as there are of load.species");
        require(own == 0 || own == laws, "the number of species", laws, limit)?;
        for component in self.gravity {
            require_finite("gravity", component)?;
        }
        ZoneParameters::validate(&self.run.zones, self.drum.bounding_radius())?;
        self.run.validate()
    }
}

/// The most bundles of a load; the largest arrays of the engine hold 16 million.
pub const MOST_BUNDLES: usize = 10_000_000;

impl LoadParameters {
    /// The species in their shares.
    pub fn composition(&self) -> Result<Composition, Error> {
        Composition::new(&self.species, self.share_by)
    }

    /// The discs that the load is made of.
    pub fn discs(&self, seed: u64) -> Result<Discs, Error> {
        if self.species.is_empty() {
            return Ok(Discs::equal(self.count, 0.5 * self.diameter));
        }
        self.composition()?.discs(self.count, seed)
    }

    /// The density of a species [kg/m³].
    pub fn density_of(&self, species: u16) -> f64 {
        self.species.get(usize::from(species)).map_or(self.density, |own| own.density)
    }

    /// The radius of the bundles of a species [m]; none where they differ.
    pub fn radius_of(&self, species: u16) -> Option<f64> {
        let diameter = match self.species.get(usize::from(species)) {
            Some(own) => own.sizes.single(),
            None => Some(self.diameter),
        };
        diameter.map(|diameter| 0.5 * diameter)
    }

    fn validate(&self, drum_radius: Option<f64>) -> Result<(), Error> {
        let limit = format!("between 1 and {MOST_BUNDLES}");
        require((1..=MOST_BUNDLES).contains(&self.count), "load.count", self.count, limit)?;
        require_positive("load.diameter", self.diameter)?;
        require_positive("load.density", self.density)?;
        require_non_negative("load.start_speed", self.start_speed)?;
        if !self.species.is_empty() {
            let composition = self.composition()?;
            return drum_radius.map_or(Ok(()), |rim| composition.require_smaller(rim));
        }
        let Some(rim) = drum_radius else { return Ok(()) };
        let limit = format!("smaller than the drum's diameter {}", 2.0 * rim);
        require(self.diameter < 2.0 * rim, "load.diameter", self.diameter, limit)
    }
}

impl RunParameters {
    fn validate(&self) -> Result<(), Error> {
        if let Some(time_step) = self.time_step {
            require_positive("run.time_step", time_step)?;
            let limit = format!("at least {:e}", f64::MIN_POSITIVE);
            require(time_step.is_normal(), "run.time_step", format!("{time_step:e}"), limit)?;
        }
        require_positive("run.sample_every", self.sample_every)?;
        require_positive("run.frame_every", self.frame_every)?;
        if let Some(skin) = self.skin {
            require_non_negative("run.skin", skin)?;
        }
        require_non_negative("run.contact_floor", self.contact_floor)?;
        if let Some(width) = self.arc_bin {
            require_positive("run.arc_bin", width)?;
        }
        if let Some(side) = self.cell {
            require_positive("run.cell", side)?;
        }
        require_non_negative("run.window", self.sums_from)?;
        let is_possible = self.overlap_limit > 0.0 && self.overlap_limit < 1.0;
        require(is_possible, "run.overlap_limit", self.overlap_limit, "between 0 and 1")
    }
}
