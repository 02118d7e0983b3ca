//! What stops a run that has lost its meaning.

use super::Simulation;
use crate::engine::DrumMotion;
use crate::error::{Error, Incident};
use crate::physics::vector::{Rotation, Vec2, perpendicular};

impl Simulation {
    /// In every step: no particle has moved farther than half the smallest radius as seen from the drum, so that none can
    /// pass through another or through a wall between two checks. `longest_displacement` is a bound; only beyond it displacements are measured.
    pub(super) fn guard_displacements(
        &mut self,
        longest_displacement: f64,
        drum: DrumMotion,
    ) -> Result<(), Error> {
        let limit = 0.5 * self.derived.least_radius;
        // What is not a number is looked at, too.
        if longest_displacement < limit {
            return Ok(());
        }
        self.engine.write_back(&mut self.state.particles);
        // Measuring would pass over what is no number.
        self.guard_finite()?;
        let displacement =
            self.engine.measure_displacements(&self.state.particles, self.derived.world(), drum);
        if displacement < limit {
            return Ok(());
        }
        let fastest = |speed: &dyn Fn(usize) -> f64| {
            let all = 0..self.state.particles.len();
            all.max_by(|&a, &b| speed(a).total_cmp(&speed(b))).unwrap_or(0)
        };
        let particles = &self.state.particles;
        let speed_over_surface = |i: usize| {
            let surface = perpendicular(particles.positions[i]) * drum.angular_velocity;
            (particles.velocities[i] - surface).norm()
        };
        let place = fastest(&speed_over_surface);
        Err(Error::TooFast { incident: self.incident(place), displacement, limit })
    }

    /// At fixed steps: everything is finite, no overlap is too deep, no center is inside a solid.
    pub(super) fn guard(&self, mass_moment: Vec2) -> Result<(), Error> {
        if !(mass_moment.x + mass_moment.y).is_finite() {
            self.guard_finite()?;
        }
        self.guard_solids()?;
        self.guard_overlaps()
    }

    fn guard_finite(&self) -> Result<(), Error> {
        match self.state.particles.first_non_finite() {
            Some(place) => Err(Error::NonFinite { incident: self.incident(place) }),
            None => Ok(()),
        }
    }

    fn guard_overlaps(&self) -> Result<(), Error> {
        let limit = self.config.run.overlap_limit;
        let ratio = self.engine.pass().deepest().max(self.state.ledger.overlap_ratio);
        if ratio <= limit {
            return Ok(());
        }
        let deepest = self.engine.pass().contacts().deepest(&self.state.particles.radii);
        let place = deepest.map_or(0, |(_, (particle, _), _)| particle as usize);
        Err(Error::Overlap { incident: self.incident(place), ratio, limit })
    }

    fn guard_solids(&self) -> Result<(), Error> {
        let drum = &self.derived.drum;
        let (particles, rotation) = (&self.state.particles, Rotation::new(self.drum_angle()));
        // Nearly all particles are so far from everything that their distance from the axis tells.
        let clear = drum.clear_radius() * drum.clear_radius();
        let near =
            particles.positions.iter().enumerate().filter(|(_, position)| position.norm_squared() >= clear);
        let inside = |position: &Vec2| drum.solid_at(rotation.apply_inverse(*position));
        match near.into_iter().find_map(|(place, position)| Some((place, inside(position)?))) {
            Some((place, surface)) => Err(Error::Escaped {
                incident: self.incident(place),
                surface: drum.surface_name(surface).to_owned(),
            }),
            None => Ok(()),
        }
    }

    /// Which particle something happened to, when and where.
    fn incident(&self, place: usize) -> Incident {
        let particles = &self.state.particles;
        Incident {
            particle: self.id_of(place),
            step: self.state.step,
            time: self.time(),
            position: particles.positions[place].into(),
            speed: particles.velocities[place].norm(),
        }
    }
}
