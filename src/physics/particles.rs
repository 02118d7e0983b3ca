//! The bundles: structure of arrays, one entry a particle, in memory order (see `engine::memory_order`). What leaves the core is in id
//! order.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::error::{Error, require};
use crate::physics::vector::{Vec2, cross};

/// Equal-length vectors of everything that a particle is.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Particles {
    /// Centers [m].
    pub positions: Vec<Vec2>,
    /// Velocities [m/s] at the time of the positions.
    pub velocities: Vec<Vec2>,
    /// Angles [rad]; they only serve pictures.
    pub angles: Vec<f64>,
    /// Angular velocities [rad/s].
    pub angular_velocities: Vec<f64>,
    /// Forces of all contacts at the time of the positions [N/m].
    pub forces: Vec<Vec2>,
    /// Moments of all contacts about the centers at that time [N m/m].
    pub torques: Vec<f64>,
    /// Radii [m].
    pub radii: Vec<f64>,
    /// Masses [kg/m].
    pub masses: Vec<f64>,
    /// Moments of inertia I = m r²/2 [kg m]; 0 marks a spin that is locked.
    pub inertias: Vec<f64>,
    /// Their species.
    pub species: Vec<u16>,
    /// The ids: where each particle stood at the start.
    pub ids: Vec<u32>,
}

impl Particles {
    /// Discs at rest at `positions`, of the given radii, species and densities [kg/m³].
    pub fn at_rest(
        positions: Vec<Vec2>,
        radii: Vec<f64>,
        species: Vec<u16>,
        density_of: impl Fn(u16) -> f64,
        spin_locked: bool,
    ) -> Self {
        let count = positions.len();
        let mass = |(radius, &species): (&f64, &u16)| density_of(species) * PI * radius * radius;
        let masses: Vec<f64> = radii.iter().zip(&species).map(mass).collect();
        let inertia =
            |(mass, radius): (&f64, &f64)| if spin_locked { 0.0 } else { 0.5 * mass * radius * radius };
        Self {
            velocities: vec![Vec2::zeros(); count],
            angles: vec![0.0; count],
            angular_velocities: vec![0.0; count],
            forces: vec![Vec2::zeros(); count],
            torques: vec![0.0; count],
            inertias: masses.iter().zip(&radii).map(inertia).collect(),
            species,
            ids: (0..count as u32).collect(),
            positions,
            radii,
            masses,
        }
    }

    /// Number of particles.
    pub fn len(&self) -> usize {
        self.ids.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.ids.is_empty()
    }

    /// Puts particle `order[k]` at place `k`.
    pub fn reorder(&mut self, order: &[u32]) {
        fn permute<T: Copy>(values: &mut Vec<T>, order: &[u32]) {
            *values = order.iter().map(|&i| values[i as usize]).collect();
        }
        permute(&mut self.positions, order);
        permute(&mut self.velocities, order);
        permute(&mut self.angles, order);
        permute(&mut self.angular_velocities, order);
        permute(&mut self.forces, order);
        permute(&mut self.torques, order);
        permute(&mut self.radii, order);
        permute(&mut self.masses, order);
        permute(&mut self.inertias, order);
        permute(&mut self.species, order);
        permute(&mut self.ids, order);
    }

    /// One of the vectors above in id order.
    pub fn by_id<T: Copy>(&self, values: &[T]) -> Vec<T> {
        let mut sorted = values.to_vec();
        for (&id, &value) in self.ids.iter().zip(values) {
            sorted[id as usize] = value;
        }
        sorted
    }

    /// Mass of all particles [kg/m].
    pub fn total_mass(&self) -> f64 {
        // In id order, so that memory order does not show.
        self.by_id(&self.masses).iter().sum()
    }

    /// Mass [kg/m] and radius [m] of the lightest particle of each of so many species; none where there is none. Those of a species
    /// have one density: it is the smallest, too.
    pub fn lightest(&self, species: usize) -> Vec<Option<(f64, f64)>> {
        let mut lightest: Vec<Option<(f64, f64)>> = vec![None; species];
        for (i, &own) in self.species.iter().enumerate() {
            let (body, found) = ((self.masses[i], self.radii[i]), &mut lightest[usize::from(own)]);
            if found.is_none_or(|(mass, _)| body.0 < mass) {
                *found = Some(body);
            }
        }
        lightest
    }

    /// The largest radius [m], 0 without particles.
    pub fn largest_radius(&self) -> f64 {
        self.radii.iter().copied().fold(0.0, f64::max)
    }

    /// The first particle whose state is not finite.
    pub fn first_non_finite(&self) -> Option<usize> {
        (0..self.len()).find(|&i| {
            let numbers = [
                self.positions[i].x,
                self.positions[i].y,
                self.velocities[i].x,
                self.velocities[i].y,
                self.angles[i],
                self.angular_velocities[i],
            ];
            numbers.iter().any(|number| !number.is_finite())
        })
    }

    /// Whether forces, mass and moment of inertia of a particle are such as one can have.
    fn is_accelerable(&self, i: usize) -> bool {
        let forces = [self.forces[i].x, self.forces[i].y, self.torques[i]];
        let (mass, inertia) = (self.masses[i], self.inertias[i]);
        forces.iter().all(|force| force.is_finite())
            && (mass.is_finite() && mass > 0.0)
            && (inertia.is_finite() && inertia >= 0.0)
    }

    /// Kinetic energies (of translation, of rotation) [J/m] in the form ½ m v₋·v₊ over the velocities half a step
    /// before and after: with it, the work of a leapfrog step is exactly the trapezoid of the forces. The half-step
    /// velocities are v ∓ a h with h half the time step, so v₋·v₊ = v² − (a h)².
    pub fn kinetic_energies(&self, half_step: f64, gravity: Vec2) -> (f64, f64) {
        let mut translation = 0.0;
        let mut rotation = 0.0;
        for i in 0..self.len() {
            let (kick, angular_kick) = self.kick(i, half_step, gravity);
            let speed = self.angular_velocities[i];
            translation += 0.5 * self.masses[i] * (self.velocities[i].norm_squared() - kick.norm_squared());
            rotation += 0.5 * self.inertias[i] * (speed * speed - angular_kick * angular_kick);
        }
        (translation, rotation)
    }

    /// What forces and gravity change velocity and angular velocity of a particle by in half a step.
    fn kick(&self, i: usize, half_step: f64, gravity: Vec2) -> (Vec2, f64) {
        let kick = self.forces[i] * (half_step / self.masses[i]) + gravity * half_step;
        let inertia = self.inertias[i];
        let angular_kick = if inertia > 0.0 { self.torques[i] * (half_step / inertia) } else { 0.0 };
        (kick, angular_kick)
    }

    /// Σ m (x × v) + I ω about the drum's axis [kg m/s].
    pub fn angular_momentum(&self) -> f64 {
        self.angular_momentum_after(0.0, Vec2::zeros())
    }

    /// The same where the velocities still lack what forces and gravity give in half a step of this length [s].
    pub fn angular_momentum_after(&self, half_step: f64, gravity: Vec2) -> f64 {
        (0..self.len()).fold(0.0, |sum, i| {
            let (kick, angular_kick) = self.kick(i, half_step, gravity);
            let moment = cross(self.positions[i], self.velocities[i] + kick);
            sum + self.masses[i] * moment + self.inertias[i] * (self.angular_velocities[i] + angular_kick)
        })
    }

    /// Σ m x [kg].
    pub fn mass_moment(&self) -> Vec2 {
        let weighed = self.positions.iter().zip(&self.masses).map(|(position, &mass)| position * mass);
        weighed.fold(Vec2::zeros(), |sum, part| sum + part)
    }

    /// Checks that all vectors have one length and hold usable numbers, as after reading them from outside.
    pub fn validate(&self) -> Result<(), Error> {
        let count = self.len();
        let lengths = [
            ("positions", self.positions.len()),
            ("velocities", self.velocities.len()),
            ("angles", self.angles.len()),
            ("angular_velocities", self.angular_velocities.len()),
            ("forces", self.forces.len()),
            ("torques", self.torques.len()),
            ("radii", self.radii.len()),
            ("masses", self.masses.len()),
            ("inertias", self.inertias.len()),
            ("species", self.species.len()),
        ];
        for (name, length) in lengths {
            let limit = format!("of length {count}");
            require(length == count, format!("state.{name}"), format!("of length {length}"), limit)?;
        }
        let mut ids = self.ids.clone();
        ids.sort_unstable();
        let is_permutation = ids.iter().copied().eq(0..count as u32);
        require(is_permutation, "state.ids", "not every number once", "a permutation")?;
        if let Some(i) = self.first_non_finite() {
            return Err(Error::config(format!("state of bundle {i}"), "not finite", "finite"));
        }
        if let Some(i) = self.radii.iter().position(|&radius| !(radius.is_finite() && radius > 0.0)) {
            let limit = "a positive finite number";
            return Err(Error::config(format!("state.radii[{i}]"), self.radii[i], limit));
        }
        if let Some(i) = (0..count).find(|&i| !self.is_accelerable(i)) {
            let (key, found) = (format!("the mass of bundle {i}"), format!("{:e} kg/m", self.masses[i]));
            return Err(Error::config(key, found, "positive, finite and accelerable"));
        }
        Ok(())
    }
}
