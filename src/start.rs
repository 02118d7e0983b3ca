//! The start of a simulation, and sums over its state that are asked for now and then.

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::contact::laws::Laws;
use crate::contact::table::ContactTable;
use crate::error::Error;
use crate::io::config::SimulationConfig;
use crate::physics::drum::Drum;
use crate::physics::particles::Particles;
use crate::physics::vector::Vec2;

/// A given initial state; what is left out is zero, radii that are left out are the configured one.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct InitialState {
    /// Centers [m], in the frame at rest.
    pub positions: Vec<Vec2>,
    /// Velocities [m/s].
    pub velocities: Option<Vec<Vec2>>,
    /// Angles [rad].
    pub angles: Option<Vec<f64>>,
    /// Angular velocities [rad/s].
    pub angular_velocities: Option<Vec<f64>>,
    /// Radii [m].
    pub radii: Option<Vec<f64>>,
}

impl InitialState {
    /// The particles of this state.
    ///
    /// # Errors
    /// `Error::Config` naming the field.
    pub fn into_particles(self, config: &SimulationConfig) -> Result<Particles, Error> {
        let count = self.positions.len();
        if count == 0 {
            return Err(Error::config("state.positions", "empty", "of at least one bundle"));
        }
        let radii = self.radii.unwrap_or_else(|| vec![0.5 * config.load.diameter; count]);
        if radii.len() != count {
            let found = format!("of length {}", radii.len());
            return Err(Error::config("state.radii", found, format!("of length {count}")));
        }
        let locked = config.load.spin_locked;
        let mut particles = Particles::at_rest(self.positions, radii, config.load.density, locked);
        if let Some(velocities) = self.velocities {
            particles.velocities = velocities;
        }
        if let Some(angles) = self.angles {
            particles.angles = angles;
        }
        if let Some(spins) = self.angular_velocities {
            if locked && spins.iter().any(|&spin| spin != 0.0) {
                let limit = "0 while load.spin_locked is true";
                return Err(Error::config("state.angular_velocities", "not 0", limit));
            }
            particles.angular_velocities = spins;
        }
        particles.validate()?;
        Ok(particles)
    }
}

/// Refuses bundles whose centers are outside of the drum or within a baffle.
///
/// # Errors
/// `Error::Config` naming the first of them.
pub fn require_inside(drum: &Drum, particles: &Particles) -> Result<(), Error> {
    match particles.positions.iter().position(|&center| drum.clearance(center) <= 0.0) {
        None => Ok(()),
        Some(i) => {
            let (x, y) = (particles.positions[i].x, particles.positions[i].y);
            let limit = "inside the drum and outside of its baffles";
            Err(Error::config(format!("state.positions[{i}]"), format!("[{x}, {y}]"), limit))
        }
    }
}

/// The configured load at packed positions, each bundle with the start speed in a random direction.
pub fn packed(config: &SimulationConfig, positions: Vec<Vec2>, seed: u64) -> Particles {
    let load = &config.load;
    let radii = vec![0.5 * load.diameter; positions.len()];
    let mut particles = Particles::at_rest(positions, radii, load.density, load.spin_locked);
    if load.start_speed > 0.0 {
        // A stream of its own, so that the speed does not change where the bundles lie.
        let mut random = Pcg64Mcg::seed_from_u64(!seed);
        for velocity in &mut particles.velocities {
            let unit = (random.next_u64() >> 11) as f64 * (1.0 / (1_u64 << 53) as f64);
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * unit);
            *velocity = Vec2::new(cos, sin) * load.start_speed;
        }
    }
    particles
}

/// The configured time step, or the shortest collision time / 50.
///
/// # Errors
/// `Error::Config` for a step above a tenth of the shortest collision time, which could not resolve a contact.
pub fn time_step(config: &SimulationConfig, laws: &Laws, particles: &Particles) -> Result<f64, Error> {
    let (bundle, drum) = collision_times(laws, particles);
    let shortest = bundle.min(drum);
    match config.run.time_step {
        None if (shortest / 50.0).is_normal() => Ok(shortest / 50.0),
        None => Err(Error::config(
            "the shortest collision time",
            format!("{shortest:e} s"),
            "a positive finite number: change load.density, load.diameter or the stiffness",
        )),
        Some(time_step) if time_step <= shortest / 10.0 => Ok(time_step),
        Some(time_step) => Err(Error::config(
            "run.time_step",
            time_step,
            format!("at most {:e}, a tenth of the shortest collision time", shortest / 10.0),
        )),
    }
}

/// Shortest collision times [s]: (between bundles, with the drum).
pub fn collision_times(laws: &Laws, particles: &Particles) -> (f64, f64) {
    let lightest = particles.masses.iter().copied().fold(f64::INFINITY, f64::min);
    laws.collision_times(lightest)
}

/// Σ m x [kg].
pub fn mass_moment(particles: &Particles) -> Vec2 {
    particles.positions.iter().zip(&particles.masses).fold(Vec2::zeros(), |sum, (x, &mass)| sum + x * mass)
}

/// Energy in all springs [J/m]: (normal, tangential).
pub fn elastic_energies(table: &ContactTable, laws: &Laws) -> (f64, f64) {
    let mut sums = (0.0, 0.0);
    let pairs = table.pairs().map(|entry| (entry.contact.history, laws.pair(entry.traits.law)));
    let walls = table.walls().map(|entry| (entry.contact.history, laws.wall(entry.traits.law)));
    for (history, law) in pairs.chain(walls) {
        let (normal, tangential) = law.stored(&history);
        sums.0 += normal;
        sums.1 += tangential;
    }
    sums
}

/// The place of the particle with the deepest overlap, and that overlap over the smaller radius.
pub fn deepest_overlap(table: &ContactTable, particles: &Particles) -> (usize, f64) {
    let radius = |i: u32| particles.radii[i as usize];
    let pairs = (table.pairs().map(|entry| entry.contact))
        .map(|c| (c.particle, c.history.overlap / radius(c.particle).min(radius(c.other))));
    let walls = (table.walls().map(|entry| entry.contact))
        .map(|c| (c.particle, c.history.overlap / radius(c.particle)));
    pairs.chain(walls).fold(
        (0, 0.0),
        |deepest, (particle, ratio)| {
            if ratio > deepest.1 { (particle as usize, ratio) } else { deepest }
        },
    )
}
