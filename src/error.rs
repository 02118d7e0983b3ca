//! What can go wrong, as one enum; each message says what was found and what would have been accepted.

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

    /// A particle's state stopped being a number.
    #[error("the state of bundle {particle} is no longer finite at step {step}; shorten run.time_step")]
    NonFinite {
        /// Step at which it was seen.
        step: u64,
        /// The bundle's id.
        particle: usize,
    },

    /// A contact was pressed deeper than the model can mean.
    #[error(
        "the overlap of bundle {particle} reached {ratio:.3} of its radius at step {step}, beyond run.overlap_limit = {limit}; shorten run.time_step or raise the stiffness"
    )]
    Overlap {
        /// Step at which it was seen.
        step: u64,
        /// The bundle's id.
        particle: usize,
        /// Overlap over the smaller radius.
        ratio: f64,
        /// The limit of that ratio.
        limit: f64,
    },

    /// A particle's center left the drum.
    #[error("bundle {particle} left the drum at step {step}; shorten run.time_step")]
    Escaped {
        /// Step at which it was seen.
        step: u64,
        /// The bundle's id.
        particle: usize,
    },

    /// A checkpoint that cannot be used.
    #[error("cannot use this checkpoint: {reason}")]
    Checkpoint {
        /// What is wrong with it.
        reason: String,
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

impl Error {
    /// An `Error::Config` from anything that prints.
    #[allow(clippy::needless_pass_by_value)] // Callers hand over numbers and fresh strings.
    pub fn config(key: impl Into<String>, value: impl ToString, limit: impl Into<String>) -> Self {
        Self::Config { key: key.into(), value: value.to_string(), limit: limit.into() }
    }
}

/// Accepts a finite number above zero.
pub fn require_positive(key: &str, value: f64) -> Result<(), Error> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(Error::config(key, value, "a positive finite number"))
    }
}

/// Accepts a finite number of at least zero.
pub fn require_non_negative(key: &str, value: f64) -> Result<(), Error> {
    if value.is_finite() && value >= 0.0 {
        Ok(())
    } else {
        Err(Error::config(key, value, "a finite number of at least 0"))
    }
}

/// Accepts a finite number.
pub fn require_finite(key: &str, value: f64) -> Result<(), Error> {
    if value.is_finite() { Ok(()) } else { Err(Error::config(key, value, "a finite number")) }
}
