//! What a user sets of a contact: the keys of a `contact` table.

use serde::{Deserialize, Serialize};

use crate::error::{Error, require, require_non_negative, require_positive};

/// Stiffness, damping, friction; which of them count depends on the base law.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ContactParameters {
    /// The base law, the same in every table of a simulation.
    pub base: Base,
    /// Normal stiffness kₙ [N/m].
    pub normal_stiffness: f64,
    /// kₛ / kₙ.
    pub stiffness_ratio: f64,
    /// Young's modulus E of both bodies [Pa]; none for the linear law.
    #[serde(deserialize_with = "Option::deserialize")]
    pub young_modulus: Option<f64>,
    /// Poisson's ratio ν of both bodies.
    pub poisson_ratio: f64,
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

/// The law that gives normal and tangential force.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Base {
    /// `linear`
    Linear,
    /// `hertz`
    Hertz,
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

impl Tension {
    /// The least force that spring and dashpot together may have [N/m].
    pub(super) fn least_normal_force(self) -> f64 {
        match self {
            Self::Allowed => f64::NEG_INFINITY,
            Self::Clipped => 0.0,
        }
    }
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
        self.validate_damping(key)?;
        match self.base {
            Base::Linear => self.validate_linear(key),
            Base::Hertz => self.validate_hertz(key),
        }
    }

    fn validate_linear(&self, key: &str) -> Result<(), Error> {
        self.young_modulus.map_or(Ok(()), |modulus| {
            let limit = "missing where contact.base is \"linear\", which takes normal_stiffness";
            Err(Error::config(format!("{key}.young_modulus"), modulus, limit))
        })
    }

    /// The terms that go with the tangential stiffness need one that stays.
    fn validate_hertz(&self, key: &str) -> Result<(), Error> {
        const HERTZ: &str = "where contact.base is \"hertz\"";
        let modulus = self.young_modulus.ok_or_else(|| {
            Error::config(format!("{key}.young_modulus"), "missing", format!("given {HERTZ}"))
        })?;
        require_positive(&format!("{key}.young_modulus"), modulus)?;
        let is_possible = (0.0..=0.5).contains(&self.poisson_ratio);
        let limit = "at least 0 and at most 0.5";
        require(is_possible, format!("{key}.poisson_ratio"), self.poisson_ratio, limit)?;
        if let Some(damping) = self.normal_damping {
            let limit = format!("missing {HERTZ}: give {key}.restitution instead");
            return Err(Error::config(format!("{key}.normal_damping"), damping, limit));
        }
        let terms = [
            ("rolling_friction", self.rolling_friction),
            ("tangential_damping_ratio", self.tangential_damping_ratio),
        ];
        terms.into_iter().try_for_each(|(name, value)| {
            require(value == 0.0, format!("{key}.{name}"), value, format!("0 {HERTZ}"))
        })
    }

    /// Whether any term acts beside the base law.
    pub fn has_terms(&self) -> bool {
        [self.rolling_friction, self.tangential_damping_ratio, self.adhesion].iter().any(|&term| term > 0.0)
    }

    fn validate_damping(&self, key: &str) -> Result<(), Error> {
        match (self.restitution, self.normal_damping) {
            (Some(restitution), None) => {
                let is_possible = restitution > 0.0 && restitution <= 1.0;
                require(is_possible, format!("{key}.restitution"), restitution, "above 0 and at most 1")
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
