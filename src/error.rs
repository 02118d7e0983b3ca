//! What can go wrong, as one enum. A message is made of its parts, each of which callers can ask for: the key, what is wrong
//! with it, the way out.

use std::fmt;

/// Every failure of the core.
#[derive(Debug, Clone, PartialEq)]
pub enum Error {
    /// A parameter outside its limits.
    Config {
        /// The name a user writes, such as `contact.bundle.friction`.
        key: String,
        /// What was found.
        value: Value,
        /// What would have been accepted, in words.
        limit: String,
        /// The limit as a number, where it is a single one.
        bound: Option<f64>,
        /// What to do instead, where there is more to say than the limit.
        hint: &'static str,
    },

    /// More bundles than the packing can place.
    Packing {
        /// Bundles asked for.
        requested: usize,
        /// Bundles that the densest packing found can place; of several sizes about as many, in the same mix.
        fits: usize,
        /// The least and the greatest of their diameters [m].
        diameters: [f64; 2],
    },

    /// Bodies that overlap at the start.
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
    NonFinite {
        /// Which particle, when and where.
        incident: Incident,
    },

    /// A contact was pressed deeper than the model can mean.
    Overlap {
        /// Which particle, when and where.
        incident: Incident,
        /// Overlap over the smaller radius.
        ratio: f64,
        /// The limit of that ratio.
        limit: f64,
    },

    /// A particle's center is inside a solid.
    Escaped {
        /// Which particle, when and where.
        incident: Incident,
        /// What it passed through.
        surface: String,
    },

    /// A particle moved so far in a step that it could pass through others unseen.
    TooFast {
        /// Which particle, when and where.
        incident: Incident,
        /// How far it moved [m].
        displacement: f64,
        /// The limit [m].
        limit: f64,
    },

    /// A checkpoint that cannot be used.
    Checkpoint {
        /// What is wrong with it.
        reason: String,
    },

    /// Memory that there is none of. What was being done is not done; everything before it is whole.
    Memory {
        /// What was being done.
        action: &'static str,
        /// How much was asked for.
        bytes: usize,
    },

    /// A thread pool or file that the system refused.
    System {
        /// What was being done.
        action: String,
        /// What the system answered.
        reason: String,
    },
}

/// What was found where something else is needed.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// A whole number.
    Count(usize),
    /// Text, where it is no single number.
    Text(String),
}

impl fmt::Display for Value {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        match self {
            // Without a power of ten 1e300 is three hundred zeros.
            Self::Number(number) if *number != 0.0 && !(1e-4..1e16).contains(&number.abs()) => {
                write!(formatter, "{number:e}")
            }
            Self::Number(number) => write!(formatter, "{number}"),
            Self::Count(count) => write!(formatter, "{count}"),
            Self::Text(text) => formatter.write_str(text),
        }
    }
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<usize> for Value {
    fn from(count: usize) -> Self {
        Self::Count(count)
    }
}

impl From<u16> for Value {
    fn from(count: u16) -> Self {
        Self::Count(count.into())
    }
}

impl From<&str> for Value {
    fn from(text: &str) -> Self {
        Self::Text(text.into())
    }
}

impl From<String> for Value {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
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

impl std::error::Error for Error {}

/// "KEY PROBLEM; HINT", without the parts that there are none of.
impl fmt::Display for Error {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        if let Some(key) = self.key() {
            write!(formatter, "{key} ")?;
        }
        formatter.write_str(&self.problem())?;
        match self.hint() {
            "" => Ok(()),
            hint => write!(formatter, "; {hint}"),
        }
    }
}

impl Error {
    /// An `Error::Config` without further advice.
    pub fn config(key: impl Into<String>, value: impl Into<Value>, limit: impl Into<String>) -> Self {
        Self::Config { key: key.into(), value: value.into(), limit: limit.into(), bound: None, hint: "" }
    }

    /// The same error with advice, where it is an `Error::Config`.
    #[must_use]
    pub fn with_hint(mut self, advice: &'static str) -> Self {
        if let Self::Config { hint, .. } = &mut self {
            *hint = advice;
        }
        self
    }

    /// The name of what is refused, as a user writes it.
    pub fn key(&self) -> Option<&str> {
        match self {
            Self::Config { key, .. } => Some(key),
            Self::Packing { .. } => Some("load.count"),
            Self::StartOverlap { one, .. } => Some(one),
            _ => None,
        }
    }

    /// What is wrong, or what has happened: the message without its key and its hint.
    pub fn problem(&self) -> String {
        match self {
            Self::Config { value, limit, .. } => format!("is {value}, but must be {limit}"),
            Self::Packing { requested, .. } => format!("is {requested}, but must be {}", self.limit()),
            Self::StartOverlap { other, ratio, .. } => {
                format!(
                    "and {other} overlap by {:.3} % of the smaller radius, but may by {}: springs would throw them apart",
                    100.0 * ratio,
                    self.limit()
                )
            }
            Self::NonFinite { incident } => {
                format!(
                    "the state of bundle {} is no longer finite at {}",
                    incident.particle,
                    incident.moment()
                )
            }
            Self::Overlap { incident, ratio, limit } => format!(
                "the overlap of bundle {} reached {ratio:.3} of its radius at {incident}, beyond run.overlap_limit = {limit}",
                incident.particle
            ),
            Self::Escaped { incident, surface } => {
                format!("bundle {} passed through the {surface} by {incident}", incident.particle)
            }
            Self::TooFast { incident, displacement, limit } => format!(
                "bundle {} moved {displacement:.3e} m in one step at {incident}, as seen from the drum, more than half of the smallest radius, {limit:.3e} m",
                incident.particle
            ),
            Self::Checkpoint { reason } => format!("cannot use this checkpoint: {reason}"),
            Self::Memory { action, bytes } => format!("{action}: there is no memory for {bytes} bytes more"),
            Self::System { action, reason } => format!("{action}: {reason}"),
        }
    }

    /// What a refused configuration would have had to be, in words.
    pub fn limit(&self) -> String {
        match self {
            Self::Config { limit, .. } => limit.clone(),
            Self::Packing { fits, diameters: [smallest, largest], .. } if smallest == largest => {
                format!("at most {fits}: no more bundles of diameter {largest} m fit into this drum")
            }
            Self::Packing { fits, diameters: [smallest, largest], .. } => format!(
                "at most about {fits}: no more bundles of this mix, {smallest:.3e} to {largest:.3e} m in diameter, fit into this drum"
            ),
            Self::StartOverlap { limit, .. } => format!("at most {:.0} %", 100.0 * limit),
            _ => String::new(),
        }
    }

    /// What to do instead.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Config { hint, .. } => hint,
            Self::StartOverlap { .. } => {
                "move them, or start from a state of a simulation, which brings its contacts along"
            }
            Self::NonFinite { .. } => "shorten run.time_step",
            Self::Overlap { .. } | Self::Escaped { .. } => "shorten run.time_step or raise the stiffness",
            Self::TooFast { .. } => "shorten run.time_step, or start slower",
            _ => "",
        }
    }
}

/// An `Error::Config` unless the condition holds.
pub fn require(
    condition: bool,
    key: impl Into<String>,
    value: impl Into<Value>,
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
