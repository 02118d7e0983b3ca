//! What follows from the configuration and the particles' sizes, and never changes.

use crate::contact::block::Traits;
use crate::contact::laws::Laws;
use crate::error::Error;
use crate::io::config::SimulationConfig;
use crate::physics::drum::Drum;
use crate::physics::particles::Particles;
use crate::physics::vector::Vec2;
use crate::start;

/// What follows from the configuration and the particles' sizes.
#[derive(Debug)]
pub(super) struct Fixed {
    pub(super) drum: Drum,
    pub(super) laws: Laws,
    pub(super) time_step: f64,
    pub(super) gravity: Vec2,
    pub(super) mass: f64,
    pub(super) least_radius: f64,
    /// The radius of all bundles where they are of one size.
    pub(super) radius: Option<f64>,
    /// What contacts between bundles follow from, where all are equal.
    pub(super) pair: Option<Traits>,
    pub(super) sample_steps: u64,
    pub(super) frame_steps: u64,
    /// The drum's speed where it is constant.
    pub(super) steady_speed: Option<f64>,
}

impl Fixed {
    pub(super) fn new(config: &SimulationConfig, particles: &Particles) -> Result<Self, Error> {
        let laws = Laws::new(&config.contact.bundle, &config.contact.drum);
        let time_step = start::time_step(config, &laws, particles)?;
        let least_radius = particles.radii.iter().copied().fold(f64::INFINITY, f64::min);
        let every = |interval: f64| ((interval / time_step).round() as u64).max(1);
        let radius = (least_radius == particles.largest_radius()).then_some(least_radius);
        Ok(Self {
            pair: radius.and_then(|radius| same_pair(&laws, particles, radius)),
            radius,
            drum: Drum::new(&config.drum)?,
            laws,
            time_step,
            gravity: Vec2::new(config.gravity[0], config.gravity[1]),
            mass: particles.total_mass(),
            least_radius,
            sample_steps: every(config.run.sample_every),
            frame_steps: every(config.run.frame_every),
            steady_speed: config.rotation.is_constant().then(|| config.rotation.angular_velocity(0.0)),
        })
    }
}

/// What contacts follow from between bundles of one radius, if they are equal in all else.
fn same_pair(laws: &Laws, particles: &Particles, radius: f64) -> Option<Traits> {
    let body = (*particles.materials.first()?, *particles.masses.first()?);
    let bodies = particles.materials.iter().copied().zip(particles.masses.iter().copied());
    let are_equal = bodies.into_iter().all(|other| other == body);
    are_equal.then(|| Traits { law: laws.pair_slot(body, body), radii: [radius; 2] })
}
