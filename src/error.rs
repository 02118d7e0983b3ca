//! What can go wrong, as one enum; each message says what was found and what would have been accepted.

use std::fmt;

/// Every failure of the core.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Error {
    /// A parameter outside its limits. `key` is the name a user writes, such as `contact.bundle.friction`.
    #[error("{key} is {value}, but must be {limit}")]
    Config {
        /// The dotted key.
        key: String,
        /// The value found.
        value: String,
        /// What would have been accepted.
        limit: String,
    },

    /// More bundles than the packing can place.
    #[error(
        "load.count is {requested}, but must be at most {fits}: no more bundles of diameter {diameter} m fit into this drum"
    )]
    Packing {
        /// Bundles asked for.
        requested: usize,
        /// Bundles that the densest packing found can place.
        fits: usize,
        /// Their diameter [m].
        diameter: f64,
    },

    /// Bodies that overlap at the start.
    #[error(
        "{one} and {other} overlap by {:.3} % of the smaller radius, but may by at most {:.0} %: springs would throw them apart; move them, or start from a state of a simulation, which brings its contacts along",
        100.0 * .ratio, 100.0 * .limit
    )]
    StartOverlap {
        /// The key of a bundle.
        one: String,
        /// The index of another one, or a part of the drum.
        other: String,
        /// Overlap over the smaller radius.
        ratio: f64,
        /// The limit of that ratio.
        limit: f64,
    },

    /// A particle's state stopped being a number.
    #[error("the state of bundle {} is no longer finite at {}; shorten run.time_step", .incident.particle, .incident.moment())]
    NonFinite {
        /// Which particle, when and where.
        incident: Incident,
    },

    /// A contact was pressed deeper than the model can mean.
    #[error(
        "the overlap of bundle {} reached {ratio:.3} of its radius at {incident}, beyond run.overlap_limit = {limit}; shorten run.time_step or raise the stiffness",
        .incident.particle
    )]
    Overlap {
        /// Which particle, when and where.
        incident: Incident,
        /// Overlap over the smaller radius.
        ratio: f64,
        /// The limit of that ratio.
        limit: f64,
    },

    /// A particle's center is inside a solid.
    #[error(
        "bundle {} passed through the {surface} by {incident}; shorten run.time_step or raise the stiffness",
        .incident.particle
    )]
    Escaped {
        /// Which particle, when and where.
        incident: Incident,
        /// What it passed through.
        surface: String,
    },

    /// A particle moved so far in a step that it could pass through others unseen.
    #[error(
        "bundle {} moved {displacement:.3e} m in one step at {incident}, as seen from the drum, more than half of the smallest radius, {limit:.3e} m; shorten run.time_step, or start slower",
        .incident.particle
    )]
    TooFast {
        /// Which particle, when and where.
        incident: Incident,
        /// How far it moved [m].
        displacement: f64,
        /// The limit [m].
        limit: f64,
    },

    /// A checkpoint that cannot be used.
    #[error("cannot use this checkpoint: {reason}")]
    Checkpoint {
        /// What is wrong with it.
        reason: String,
    },

    /// Memory that there is none of. What was being done is not done; everything before it is whole.
    #[error("{action}: there is no memory for {bytes} bytes more")]
    Memory {
        /// What was being done.
        action: &'static str,
        /// How much was asked for.
        bytes: usize,
    },

    /// A thread pool or file that the system refused.
    #[error("{action}: {reason}")]
    System {
        /// What was being done.
        action: String,
        /// What the system answered.
        reason: String,
    },
}

/// Which particle something happened to, when and where.
#[derive(Debug, Clone, PartialEq)]
pub struct Incident {
    /// The bundle's id.
    pub particle: usize,
    /// Step at which it was seen.
    pub step: u64,
    /// Time of that step [s].
    pub time: f64,
    /// Where the bundle was [m].
    pub position: [f64; 2],
    /// Its speed [m/s].
    pub speed: f64,
}

impl Incident {
    /// When it happened.
    fn moment(&self) -> String {
        format!("step {} (t = {:.6} s)", self.step, self.time)
    }
}

impl fmt::Display for Incident {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        let (Self { position: [x, y], speed, .. }, moment) = (self, self.moment());
        write!(formatter, "{moment} near [{x:.4}, {y:.4}] m at {speed:.3} m/s")
    }
}

impl Error {
    /// An `Error::Config` from anything that prints.
    #[allow(clippy::needless_pass_by_value)] // Callers hand over numbers and fresh strings.
    pub fn config(key: impl Into<String>, value: impl ToString, limit: impl Into<String>) -> Self {
        Self::Config { key: key.into(), value: value.to_string(), limit: limit.into() }
    }
}

/// An `Error::Config` unless the condition holds.
#[allow(clippy::needless_pass_by_value)] // As in `Error::config`.
pub fn require(
    condition: bool,
    key: impl Into<String>,
    value: impl ToString,
    limit: impl Into<String>,
) -> Result<(), Error> {
    if condition { Ok(()) } else { Err(Error::config(key, value, limit)) }
}

/// Accepts a finite number above zero.
pub fn require_positive(key: &str, value: f64) -> Result<(), Error> {
    require(value.is_finite() && value > 0.0, key, value, "a positive finite number")
}

/// Accepts a finite number of at least zero.
pub fn require_non_negative(key: &str, value: f64) -> Result<(), Error> {
    require(value.is_finite() && value >= 0.0, key, value, "a finite number of at least 0")
}

/// Accepts a finite number.
pub fn require_finite(key: &str, value: f64) -> Result<(), Error> {
    require(value.is_finite(), key, value, "a finite number")
}
