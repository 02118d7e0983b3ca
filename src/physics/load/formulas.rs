//! Size laws that are formulas: the share F of the load that is smaller than a diameter d.

use serde::{Deserialize, Serialize};

use crate::error::{Error, require_positive};

/// A formula for F(d), before its ends are cut off.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub enum Formula {
    /// F = (d / top size)^modulus, what grinding leaves.
    GaudinSchuhmann {
        /// F = 1 from this diameter on [m].
        top_size: f64,
        /// The exponent.
        modulus: f64,
    },
    /// F = 1 − exp(−(d / size)^modulus).
    RosinRammler {
        /// The diameter below which 63.2 % lie, 1 − 1/e [m].
        size_63: f64,
        /// The exponent.
        modulus: f64,
    },
    /// ln d is normal.
    Lognormal {
        /// Median of d [m].
        median: f64,
        /// Standard deviation of ln d.
        sigma: f64,
    },
    /// d is normal.
    Normal {
        /// Mean of d [m].
        mean: f64,
        /// Standard deviation of d [m].
        sigma: f64,
    },
}

/// A formula without an end is cut off where this share is beyond.
pub const CUT: f64 = 1e-3;
/// How many standard deviations from its median a normal distribution has `CUT` beyond.
const DEVIATIONS: f64 = 3.090_232_306_167_813_5;

impl Formula {
    /// Checks its parameters; `key` is what a user writes before them.
    pub fn validate(&self, key: &str) -> Result<(), Error> {
        let [(first, size), (second, width)] = match *self {
            Self::GaudinSchuhmann { top_size, modulus } => [("top_size", top_size), ("modulus", modulus)],
            Self::RosinRammler { size_63, modulus } => [("size_63", size_63), ("modulus", modulus)],
            Self::Lognormal { median, sigma } => [("median", median), ("sigma", sigma)],
            Self::Normal { mean, sigma } => [("mean", mean), ("sigma", sigma)],
        };
        require_positive(&format!("{key}.{first}"), size)?;
        require_positive(&format!("{key}.{second}"), width)
    }

    /// F(d).
    pub fn below(&self, diameter: f64) -> f64 {
        let normal = |deviations: f64| 0.5 * libm::erfc(-deviations * std::f64::consts::FRAC_1_SQRT_2);
        match *self {
            Self::GaudinSchuhmann { top_size, modulus } => libm::pow(diameter / top_size, modulus).min(1.0),
            Self::RosinRammler { size_63, modulus } => -libm::expm1(-libm::pow(diameter / size_63, modulus)),
            Self::Lognormal { median, sigma } => normal(libm::log(diameter / median) / sigma),
            Self::Normal { mean, sigma } => normal((diameter - mean) / sigma),
        }
    }

    /// The diameters below which `CUT`, and above which `CUT` or nothing, lies [m].
    pub fn ends(&self) -> (f64, f64) {
        match *self {
            Self::GaudinSchuhmann { top_size, modulus } => {
                (top_size * libm::pow(CUT, 1.0 / modulus), top_size)
            }
            Self::RosinRammler { size_63, modulus } => {
                let at = |share: f64| size_63 * libm::pow(-libm::log1p(-share), 1.0 / modulus);
                (at(CUT), at(1.0 - CUT))
            }
            Self::Lognormal { median, sigma } => {
                let factor = libm::exp(DEVIATIONS * sigma);
                (median / factor, median * factor)
            }
            Self::Normal { mean, sigma } => (mean - DEVIATIONS * sigma, mean + DEVIATIONS * sigma),
        }
    }

    /// The modulus, where F is of the mass and small discs are without number: F ∝ d^modulus there, and the number that is
    /// larger than d as d^(modulus − 2).
    pub fn swarming(&self) -> Option<f64> {
        match *self {
            Self::GaudinSchuhmann { modulus, .. } | Self::RosinRammler { modulus, .. } if modulus <= 2.0 => {
                Some(modulus)
            }
            _ => None,
        }
    }
}
