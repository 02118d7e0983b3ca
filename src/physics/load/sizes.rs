//! Size laws: how large the discs of a species are, as shares of its mass or number, and discs that obey them.
//!
//! The mass of a disc goes as d², so a share f dd of the mass holds a number that goes as f/d² dd; for spheres it would be
//! f/d³ dd. The discs of a species have one density: shares of its area are shares of its mass.
//!
//! A law is a table of shares, linear in d between two entries: exact for a sieve analysis, within 10⁻⁶ for a formula, which
//! is tabulated. Numbers and mean squares follow in closed form.

use rand::Rng;
use serde::{Deserialize, Serialize};

use super::formulas::{CUT, Formula};
use super::packing::unit;
use super::shares::{Measure, largest_remainder, normalized, require_whole};
use crate::error::{Error, require, require_positive};

/// A law of diameters [m].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub enum SizeLaw {
    /// A few diameters, each with its share.
    Mix {
        /// What shares are counted by.
        by: Measure,
        /// The diameters [m].
        diameters: Vec<f64>,
        /// Their shares.
        shares: Vec<f64>,
    },
    /// A sieve analysis: the share that passes each diameter, linear in between.
    Table {
        /// What shares are counted by.
        by: Measure,
        /// Diameters [m], rising.
        diameters: Vec<f64>,
        /// The share below each of them, from 0 to 1.
        passing: Vec<f64>,
    },
    /// A formula.
    Formula {
        /// What shares are counted by.
        by: Measure,
        /// The formula.
        formula: Formula,
        /// The smallest diameter [m]; none for where the formula ends.
        #[serde(deserialize_with = "Option::deserialize")]
        smallest: Option<f64>,
        /// The largest diameter [m]; none likewise.
        #[serde(deserialize_with = "Option::deserialize")]
        largest: Option<f64>,
    },
}

/// Entries of the table of a formula, evenly spaced in ln d.
const ENTRIES: usize = 2048;

impl SizeLaw {
    /// Equal discs.
    pub fn equal(diameter: f64) -> Self {
        Self::Mix { by: Measure::Number, diameters: vec![diameter], shares: vec![1.0] }
    }

    /// The diameter of equal discs; none where they differ.
    pub fn single(&self) -> Option<f64> {
        match self {
            Self::Mix { diameters, .. } if diameters.len() == 1 => Some(diameters[0]),
            _ => None,
        }
    }

    /// How discs of this law are distributed; `key` is what a user writes before its keys, such as `load.species[0].sizes`.
    pub fn distribution(&self, key: &str) -> Result<SizeDistribution, Error> {
        match self {
            Self::Mix { by, diameters, shares } => mix(key, *by, diameters, shares),
            Self::Table { by, diameters, passing } => {
                check_table(key, diameters, passing)?;
                Ok(SizeDistribution::tabulated(*by, diameters.clone(), passing))
            }
            Self::Formula { by, formula, smallest, largest } => {
                formula.validate(key)?;
                let (smallest, largest) = ends(key, *by, formula, (*smallest, *largest))?;
                let step = libm::log(largest / smallest) / ENTRIES as f64;
                let between = (0..ENTRIES).map(|k| smallest * libm::exp(k as f64 * step));
                let diameters: Vec<f64> = between.chain([largest]).collect();
                let below: Vec<f64> = diameters.iter().map(|&diameter| formula.below(diameter)).collect();
                let holds = format!("such that some of the law lies between it and the largest, {largest}");
                require(below[ENTRIES] > below[0], format!("{key}.smallest"), smallest, holds)?;
                Ok(SizeDistribution::tabulated(*by, diameters, &below))
            }
        }
    }
}

fn mix(key: &str, by: Measure, diameters: &[f64], shares: &[f64]) -> Result<SizeDistribution, Error> {
    require_same_length(key, diameters, ("shares", shares), 1)?;
    for (k, (&diameter, &share)) in diameters.iter().zip(shares).enumerate() {
        require_positive(&format!("{key}.diameters[{k}]"), diameter)?;
        require_positive(&format!("{key}.shares[{k}]"), share)?;
    }
    require_whole(&format!("{key}.shares"), shares)?;
    let weight = |diameter: f64| if by == Measure::Number { 1.0 } else { 1.0 / (diameter * diameter) };
    let numbers = diameters.iter().zip(shares).map(|(&diameter, share)| share * weight(diameter));
    let numbers = normalized(numbers.collect());
    Ok(SizeDistribution { diameters: diameters.to_vec(), numbers, within: Within::Nothing })
}

fn check_table(key: &str, diameters: &[f64], passing: &[f64]) -> Result<(), Error> {
    require_same_length(key, diameters, ("passing", passing), 2)?;
    require_positive(&format!("{key}.diameters[0]"), diameters[0])?;
    for (k, (sizes, shares)) in diameters.windows(2).zip(passing.windows(2)).enumerate() {
        let rises = sizes[1] > sizes[0] && sizes[1].is_finite();
        let limit = format!("a finite number above the one before it, {}", sizes[0]);
        require(rises, format!("{key}.diameters[{}]", k + 1), sizes[1], limit)?;
        let limit =
            format!("at least the one before it, {}: what passes a sieve, not what it retains", shares[0]);
        require(shares[1] >= shares[0], format!("{key}.passing[{}]", k + 1), shares[1], limit)?;
    }
    let last = passing.len() - 1;
    let ends = [
        (0, 0.0, "0, at a diameter that nothing is smaller than"),
        (last, 1.0, "1, at a diameter that all is smaller than"),
    ];
    ends.into_iter().try_for_each(|(k, end, limit)| {
        require(passing[k] == end, format!("{key}.passing[{k}]"), passing[k], limit)
    })
}

/// Where a formula begins and ends, as given or by itself.
fn ends(
    key: &str,
    by: Measure,
    formula: &Formula,
    (smallest, largest): (Option<f64>, Option<f64>),
) -> Result<(f64, f64), Error> {
    if let Some(modulus) = formula.swarming().filter(|_| by != Measure::Number && smallest.is_none()) {
        let limit = format!(
            "given where the modulus is at most 2, here {modulus}: the number of discs goes as mass/d² and has no bound towards small ones"
        );
        return Err(Error::config(format!("{key}.smallest"), "missing", limit));
    }
    let (first, last) = formula.ends();
    let found =
        smallest.map_or_else(|| format!("missing and would be {first:.4}"), |given| given.to_string());
    let limit = format!("a positive finite number; where it is missing, {CUT} of all is smaller");
    let (smallest, largest) = (smallest.unwrap_or(first), largest.unwrap_or(last));
    require(smallest > 0.0 && smallest.is_finite(), format!("{key}.smallest"), found, limit)?;
    let limit = format!("a finite number above the smallest, {smallest}");
    require(largest > smallest && largest.is_finite(), format!("{key}.largest"), largest, limit)?;
    Ok((smallest, largest))
}

fn require_same_length(
    key: &str,
    diameters: &[f64],
    (name, values): (&str, &[f64]),
    least: usize,
) -> Result<(), Error> {
    let length = |count: usize| format!("of length {count}");
    let (count, found) = (diameters.len(), values.len());
    require(count >= least, format!("{key}.diameters"), length(count), format!("of length {least} or more"))?;
    let limit = format!("{}, as {key}.diameters is", length(count));
    require(found == count, format!("{key}.{name}"), length(found), limit)
}

/// How many discs of a species have which diameter.
#[derive(Debug, Clone, PartialEq)]
pub struct SizeDistribution {
    /// The diameters, or the ends of the cells of a table [m].
    diameters: Vec<f64>,
    /// Share of the number at each diameter, or in each cell.
    numbers: Vec<f64>,
    within: Within,
}

/// What lies between two diameters.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Within {
    /// Nothing.
    Nothing,
    /// A mass that is even in d: a number that goes as 1/d².
    EvenMass,
    /// A number that is even in d.
    EvenNumber,
}

impl SizeDistribution {
    /// Of a table of shares.
    fn tabulated(by: Measure, diameters: Vec<f64>, below: &[f64]) -> Self {
        let cells = diameters.windows(2).zip(below.windows(2));
        // ∫ dd/d² over a cell, over its width, is 1 over the product of its ends.
        let number = |(ends, shares): (&[f64], &[f64])| match by {
            Measure::Number => shares[1] - shares[0],
            _ => (shares[1] - shares[0]) / (ends[0] * ends[1]),
        };
        let numbers = normalized(cells.map(number).collect());
        let within = if by == Measure::Number { Within::EvenNumber } else { Within::EvenMass };
        Self { diameters, numbers, within }
    }

    /// Mean of d² over all discs [m²].
    pub fn mean_square(&self) -> f64 {
        let squares: Vec<f64> = match self.within {
            Within::Nothing => self.diameters.iter().map(|d| d * d).collect(),
            Within::EvenMass => self.diameters.windows(2).map(|ends| ends[0] * ends[1]).collect(),
            Within::EvenNumber => {
                let mean = |ends: &[f64]| (ends[0] * ends[0] + ends[0] * ends[1] + ends[1] * ends[1]) / 3.0;
                self.diameters.windows(2).map(mean).collect()
            }
        };
        squares.iter().zip(&self.numbers).map(|(square, number)| square * number).sum()
    }

    /// The smallest and the largest diameter that a disc may have [m].
    pub fn range(&self) -> (f64, f64) {
        let fold =
            |pick: fn(f64, f64) -> f64| self.diameters.iter().copied().reduce(pick).unwrap_or(f64::NAN);
        (fold(f64::min), fold(f64::max))
    }

    /// Diameters of `count` discs [m]. Of a mix, each diameter has its share, rounded. Otherwise the number is cut into as many equal
    /// parts as there are discs, each of which gives one at random, the small ones first: few discs obey the law as
    /// many do, and where the next disc lies is open by one.
    pub fn diameters(&self, count: usize, random: &mut impl Rng) -> Vec<f64> {
        if self.within == Within::Nothing {
            let counts = largest_remainder(count, &self.numbers);
            return self.diameters.iter().zip(counts).flat_map(|(&d, own)| vec![d; own]).collect();
        }
        let (mut cell, mut before) = (0, 0.0);
        let draw = |i: usize| {
            let quantile = (i as f64 + unit(random)) / count as f64;
            while cell + 1 < self.numbers.len() && before + self.numbers[cell] < quantile {
                before += self.numbers[cell];
                cell += 1;
            }
            let part = ((quantile - before) / self.numbers[cell].max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
            let (low, high) = (self.diameters[cell], self.diameters[cell + 1]);
            match self.within {
                Within::EvenMass => low * high / (high - part * (high - low)),
                _ => low + part * (high - low),
            }
        };
        (0..count).map(draw).collect()
    }
}
