//! The table of laws by species: which parameters act between two species, and between a species and the drum.

use super::law::BodyPair;
use super::parameters::{Base, ContactParameters, Tension};
use super::{hertz, linear};
use crate::error::Error;

/// Parameters for all pairs of species, and for each species against the drum.
#[derive(Debug, Clone, PartialEq)]
pub struct SpeciesTable {
    count: usize,
    /// Between species `a` and `b`: entry `a · count + b`.
    pairs: Vec<ContactParameters>,
    /// Between each species and the drum.
    walls: Vec<ContactParameters>,
}

impl SpeciesTable {
    /// `count` species that meet each other with `bundle` and the drum with `drum`, until `set_pair` and `set_wall` say
    /// otherwise.
    pub fn new(count: usize, bundle: &ContactParameters, drum: &ContactParameters) -> Self {
        Self { count, pairs: vec![bundle.clone(); count * count], walls: vec![drum.clone(); count] }
    }

    /// Sets what acts between two species, in either order; refuses one that is not there.
    pub fn set_pair(&mut self, one: u16, other: u16, parameters: &ContactParameters) -> Result<(), Error> {
        let (a, b) = (self.index(one)?, self.index(other)?);
        self.pairs[a * self.count + b] = parameters.clone();
        self.pairs[b * self.count + a] = parameters.clone();
        Ok(())
    }

    /// Sets what acts between a species and the drum; refuses one that is not there.
    pub fn set_wall(&mut self, species: u16, parameters: &ContactParameters) -> Result<(), Error> {
        let index = self.index(species)?;
        self.walls[index] = parameters.clone();
        Ok(())
    }

    fn index(&self, species: u16) -> Result<usize, Error> {
        let index = usize::from(species);
        if index < self.count {
            return Ok(index);
        }
        let limit = format!("below {}, the number of species", self.count);
        Err(Error::config("a species", species, limit))
    }

    /// Number of species; a particle's species is below it.
    pub fn count(&self) -> usize {
        self.count
    }

    /// What acts between two species.
    pub fn pair(&self, one: u16, other: u16) -> &ContactParameters {
        &self.pairs[usize::from(one) * self.count + usize::from(other)]
    }

    /// What acts between a species and the drum.
    pub fn wall(&self, species: u16) -> &ContactParameters {
        &self.walls[usize::from(species)]
    }

    /// All parameters that there are.
    pub fn all(&self) -> impl Iterator<Item = &ContactParameters> {
        self.pairs.iter().chain(&self.walls)
    }

    /// Whether tension is clipped anywhere.
    pub fn clips(&self) -> bool {
        self.all().any(|parameters| parameters.tension == Tension::Clipped)
    }

    /// The base law, which all pairs share.
    pub fn base(&self) -> Base {
        self.pairs.first().map_or(Base::Linear, |parameters| parameters.base)
    }

    /// Shortest collision times [s], (between particles, with the drum): of the lightest particle of each species, given as (mass,
    /// radius); none where there is no such particle.
    pub fn collision_times(&self, lightest: &[Option<(f64, f64)>]) -> (f64, f64) {
        let (mut pairs, mut walls) = (f64::INFINITY, f64::INFINITY);
        let bodies = || (0_u16..).zip(lightest).filter_map(|(species, body)| Some((species, (*body)?)));
        for (one, body) in bodies() {
            walls = collision_time(self.wall(one), BodyPair::at_wall(body)).min(walls);
            for (other, second) in bodies() {
                let bodies =
                    if one == other { BodyPair::of_equals(body) } else { BodyPair::of_discs(body, second) };
                pairs = collision_time(self.pair(one, other), bodies).min(pairs);
            }
        }
        (pairs, walls)
    }
}

/// How long a collision lasts that a step has to resolve [s].
pub fn collision_time(parameters: &ContactParameters, bodies: BodyPair) -> f64 {
    match parameters.base {
        Base::Linear => linear::collision_time(parameters, bodies.effective_mass),
        Base::Hertz => hertz::collision_time(parameters, bodies),
    }
}
