//! What a load is made of: how many discs of each species, and how large each of them is.

use std::f64::consts::PI;

use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;
use serde::{Deserialize, Serialize};

use super::packing::unit;
use super::shares::{Measure, largest_remainder, normalized, require_whole};
use super::sizes::{SizeDistribution, SizeLaw};
use crate::error::{Error, require, require_positive};

/// Discs of one material.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SpeciesParameters {
    /// Its share of the load; all of them sum to 1.
    pub share: f64,
    /// Density [kg/m³], with the water that it holds.
    pub density: f64,
    /// How large its discs are.
    pub sizes: SizeLaw,
}

/// The discs of a load, each with its radius and its species.
#[derive(Debug, Clone, PartialEq)]
pub struct Discs {
    /// Radii [m].
    pub radii: Vec<f64>,
    /// Species, by their place in the list.
    pub species: Vec<u16>,
}

impl Discs {
    /// Equal discs of the first species.
    pub fn equal(count: usize, radius: f64) -> Self {
        Self { radii: vec![radius; count], species: vec![0; count] }
    }
}

/// Species in the shares of a load.
#[derive(Debug, Clone, PartialEq)]
pub struct Composition {
    sizes: Vec<SizeDistribution>,
    /// Shares of the number.
    numbers: Vec<f64>,
    /// Area of a disc of the load, on average [m²].
    pub mean_area: f64,
    /// Mass of a disc of the load, on average [kg/m].
    pub mean_mass: f64,
}

impl Composition {
    /// Species with their shares, counted by a measure.
    pub fn new(species: &[SpeciesParameters], share_by: Measure) -> Result<Self, Error> {
        let mut sizes = Vec::new();
        for (index, own) in species.iter().enumerate() {
            let key = format!("load.species[{index}]");
            require_positive(&format!("{key}.share"), own.share)?;
            require_positive(&format!("{key}.density"), own.density)?;
            sizes.push(own.sizes.distribution(&format!("{key}.sizes"))?);
        }
        let shares: Vec<f64> = species.iter().map(|own| own.share).collect();
        require_whole("the share of load.species", &shares)?;
        let areas: Vec<f64> = sizes.iter().map(|sizes| 0.25 * PI * sizes.mean_square()).collect();
        let masses: Vec<f64> = species.iter().zip(&areas).map(|(own, area)| own.density * area).collect();
        let weight = |index: usize| match share_by {
            Measure::Mass => masses[index],
            Measure::Area => areas[index],
            Measure::Number => 1.0,
        };
        let numbers = shares.iter().enumerate().map(|(index, share)| share / weight(index));
        let numbers = normalized(numbers.collect());
        let mean = |values: &[f64]| values.iter().zip(&numbers).map(|(value, number)| value * number).sum();
        Ok(Self { mean_area: mean(&areas), mean_mass: mean(&masses), sizes, numbers })
    }

    /// Refuses discs that are as large as a drum of this radius [m].
    pub fn require_smaller(&self, rim: f64) -> Result<(), Error> {
        self.sizes.iter().enumerate().try_for_each(|(index, sizes)| {
            let (smallest, largest) = sizes.range();
            let limit = format!("smaller than drum.diameter = {}", 2.0 * rim);
            let (key, found) = if smallest == largest {
                ("diameter", largest.to_string())
            } else {
                ("sizes", format!("up to {largest:.4} m"))
            };
            require(largest < 2.0 * rim, format!("load.species[{index}].{key}"), found, limit)
        })
    }

    /// How many of `count` discs are of each species.
    pub fn counts(&self, count: usize) -> Vec<usize> {
        largest_remainder(count, &self.numbers)
    }

    /// Discs of this composition, in random order: a load that is packed from bottom to top is mixed.
    ///
    /// # Errors
    /// `Error::Config` where a species gets none of so few.
    pub fn discs(&self, count: usize, seed: u64) -> Result<Discs, Error> {
        let counts = self.counts(count);
        if let Some(index) = counts.iter().position(|&own| own == 0) {
            let share = format!("{:.3e} of the number", self.numbers[index]);
            let limit = format!("enough for one of {count} bundles: raise it, or the amount of the load");
            return Err(Error::config(format!("load.species[{index}].share"), share, limit));
        }
        let mut discs: Vec<(f64, u16)> = Vec::with_capacity(count);
        for ((species, sizes), &own) in (0_u16..).zip(&self.sizes).zip(&counts) {
            // Each species has a stream of its own: another one beside it does not change its sizes.
            let mut random = Pcg64Mcg::seed_from_u64(seed ^ ((u64::from(species) + 1) << 48));
            discs.extend(sizes.diameters(own, &mut random).into_iter().map(|size| (0.5 * size, species)));
        }
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        for last in (1..discs.len()).rev() {
            discs.swap(last, (unit(&mut random) * (last + 1) as f64) as usize);
        }
        let (radii, species) = discs.into_iter().unzip();
        Ok(Discs { radii, species })
    }
}
