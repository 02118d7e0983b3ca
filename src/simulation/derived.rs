//! What follows from the configuration and the particles' sizes, and never changes.

use crate::engine::World;
use crate::error::Error;
use crate::io::config::SimulationConfig;
use crate::physics::contact::species::SpeciesTable;
use crate::physics::drum::Drum;
use crate::physics::particles::Particles;
use crate::physics::vector::Vec2;

/// What follows from the configuration and the particles' sizes.
#[derive(Debug)]
pub(super) struct Derived {
    pub(super) drum: Drum,
    pub(super) table: SpeciesTable,
    pub(super) time_step: f64,
    pub(super) gravity: Vec2,
    pub(super) mass: f64,
    pub(super) least_radius: f64,
    pub(super) sample_steps: u64,
    pub(super) frame_steps: u64,
    /// The drum's speed where it is constant.
    pub(super) steady_speed: Option<f64>,
}

impl Derived {
    pub(super) fn new(config: &SimulationConfig, particles: &Particles) -> Result<Self, Error> {
        let table = config.contact.table()?;
        let time_step = time_step(config, &table, particles)?;
        let every = |interval: f64| ((interval / time_step).round() as u64).max(1);
        Ok(Self {
            drum: Drum::new(&config.drum)?,
            table,
            time_step,
            gravity: Vec2::new(config.gravity[0], config.gravity[1]),
            mass: particles.total_mass(),
            least_radius: particles.radii.iter().copied().fold(f64::INFINITY, f64::min),
            sample_steps: every(config.run.sample_every),
            frame_steps: every(config.run.frame_every),
            steady_speed: config.rotation.is_constant().then(|| config.rotation.angular_velocity(0.0)),
        })
    }

    /// What the engine needs of it.
    pub(super) fn world(&self) -> World<'_> {
        World { drum: &self.drum, table: &self.table, time_step: self.time_step, gravity: self.gravity }
    }
}

/// The configured time step, or the shortest collision time / 50.
///
/// # Errors
/// `Error::Config` for a step above a tenth of the shortest collision time, which could not resolve a contact.
fn time_step(config: &SimulationConfig, table: &SpeciesTable, particles: &Particles) -> Result<f64, Error> {
    let (bundle, drum) = collision_times(table, particles);
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
pub(super) fn collision_times(table: &SpeciesTable, particles: &Particles) -> (f64, f64) {
    let least = |values: &[f64]| values.iter().copied().fold(f64::INFINITY, f64::min);
    table.collision_times((least(&particles.masses), least(&particles.radii)))
}
