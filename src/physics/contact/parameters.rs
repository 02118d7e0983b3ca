//! What a user sets of a contact: the keys of a `contact` table.

use serde::{Deserialize, Serialize};

use crate::error::{Error, require_non_negative, require_positive};

/// Stiffness, damping, friction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ContactParameters {
    /// Normal stiffness kₙ [N/m].
    pub normal_stiffness: f64,
    /// kₛ / kₙ.
    pub stiffness_ratio: f64,
    /// Restitution e of a head-on impact, or none where the damping is given.
    #[serde(deserialize_with = "Option::deserialize")]
    pub restitution: Option<f64>,
    /// Normal damping νₙ [N s/m], or none where the restitution is given.
    #[serde(deserialize_with = "Option::deserialize")]
    pub normal_damping: Option<f64>,
    /// Friction coefficient μ.
    pub friction: f64,
    /// Whether the dashpot may pull.
    pub tension: Tension,
    /// Rolling friction μᵣ; 0 for none.
    pub rolling_friction: f64,
    /// Damping ratio ζₜ of the dashpot beside the tangential spring; 0 for none.
    pub tangential_damping_ratio: f64,
    /// Pull `F_c` while the bodies touch [N/m]; 0 for none.
    pub adhesion: f64,
}

/// What happens where spring and dashpot together would pull the bodies towards each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Tension {
    /// They pull (the paper's law).
    Allowed,
    /// The normal force is zero instead.
    Clipped,
}

impl ContactParameters {
    /// Checks every field; `key` is the prefix that a user writes, such as `contact.bundle`.
    pub fn validate(&self, key: &str) -> Result<(), Error> {
        require_positive(&format!("{key}.normal_stiffness"), self.normal_stiffness)?;
        require_positive(&format!("{key}.stiffness_ratio"), self.stiffness_ratio)?;
        require_non_negative(&format!("{key}.friction"), self.friction)?;
        require_non_negative(&format!("{key}.rolling_friction"), self.rolling_friction)?;
        require_non_negative(&format!("{key}.tangential_damping_ratio"), self.tangential_damping_ratio)?;
        require_non_negative(&format!("{key}.adhesion"), self.adhesion)?;
        self.validate_damping(key)
    }

    /// Whether any term acts beside the base law.
    pub fn has_terms(&self) -> bool {
        [self.rolling_friction, self.tangential_damping_ratio, self.adhesion].iter().any(|&term| term > 0.0)
    }

    fn validate_damping(&self, key: &str) -> Result<(), Error> {
        match (self.restitution, self.normal_damping) {
            (Some(restitution), None) if restitution > 0.0 && restitution <= 1.0 => Ok(()),
            (Some(restitution), None) => {
                Err(Error::config(format!("{key}.restitution"), restitution, "above 0 and at most 1"))
            }
            (None, Some(damping)) => require_non_negative(&format!("{key}.normal_damping"), damping),
            (given, _) => Err(Error::config(
                format!("{key}.restitution"),
                if given.is_some() { "given beside normal_damping" } else { "missing" },
                "given exactly when normal_damping is not",
            )),
        }
    }
}
