//! The arrays that move, and how contacts read them.

pub mod verlet;

use std::ops::Range;

use crate::physics::particles::Particles;

/// Particles of a load that is one chunk, two places left for those that lanes without a contact refer to.
pub const SMALL: usize = 512;

/// A place far from everything: its distance from any particle is finite, and no contact.
const FAR: f64 = 1e150;

/// The moving part of the particles, flat.
#[derive(Debug)]
pub struct MotionArrays<'a> {
    pub position: &'a mut [[f64; 2]],
    pub velocity: &'a mut [[f64; 2]],
    pub angle: &'a mut [f64],
    pub angular_velocity: &'a mut [f64],
    pub force: &'a mut [[f64; 2]],
    pub torque: &'a mut [f64],
}

impl<'a> MotionArrays<'a> {
    /// Those of some particles.
    pub fn of(particles: &'a mut Particles) -> Self {
        Self {
            position: bytemuck::must_cast_slice_mut(&mut particles.positions),
            velocity: bytemuck::must_cast_slice_mut(&mut particles.velocities),
            angle: &mut particles.angles,
            angular_velocity: &mut particles.angular_velocities,
            force: bytemuck::must_cast_slice_mut(&mut particles.forces),
            torque: &mut particles.torques,
        }
    }
}

impl MotionArrays<'_> {
    /// The arrays of some of the particles.
    pub fn part(&mut self, range: Range<usize>) -> MotionArrays<'_> {
        MotionArrays {
            position: &mut self.position[range.clone()],
            velocity: &mut self.velocity[range.clone()],
            angle: &mut self.angle[range.clone()],
            angular_velocity: &mut self.angular_velocity[range.clone()],
            force: &mut self.force[range.clone()],
            torque: &mut self.torque[range],
        }
    }

    /// How the particles move, to read; forces and torques, to write to.
    pub fn lend(&mut self) -> (LargeView<'_>, &mut [[f64; 2]], &mut [f64]) {
        let view = LargeView {
            position: self.position,
            velocity: self.velocity,
            angular_velocity: self.angular_velocity,
        };
        (view, self.force, self.torque)
    }
}

impl<'a> MotionArrays<'a> {
    /// The arrays of the first `count` particles.
    pub fn part_of(self, count: usize) -> MotionArrays<'a> {
        self.split_at(count).0
    }

    /// The arrays before and from a particle on.
    pub fn split_at(self, particle: usize) -> (MotionArrays<'a>, MotionArrays<'a>) {
        let (position, more_position) = self.position.split_at_mut(particle);
        let (velocity, more_velocity) = self.velocity.split_at_mut(particle);
        let (angle, more_angle) = self.angle.split_at_mut(particle);
        let (angular_velocity, more_angular_velocity) = self.angular_velocity.split_at_mut(particle);
        let (force, more_force) = self.force.split_at_mut(particle);
        let (torque, more_torque) = self.torque.split_at_mut(particle);
        (
            Self { position, velocity, angle, angular_velocity, force, torque },
            Self {
                position: more_position,
                velocity: more_velocity,
                angle: more_angle,
                angular_velocity: more_angular_velocity,
                force: more_force,
                torque: more_torque,
            },
        )
    }
}

/// Gives the moving arrays places beyond the last particle while steps are done: lanes without a contact refer to them.
/// One is far from everything, the next at `inside`, where it touches no rim.
pub fn pad(particles: &mut Particles, inside: f64) {
    let count = particles.len();
    let places = if is_small(count) { SMALL } else { count + 2 };
    let Particles { positions, velocities, angles, angular_velocities, forces, torques, .. } = particles;
    for vectors in [&mut *positions, velocities, forces] {
        vectors.resize(places, nalgebra::zero());
    }
    for numbers in [angles, angular_velocities, torques] {
        numbers.resize(places, 0.0);
    }
    positions[count].x = FAR;
    positions[count + 1].x = inside;
}

/// Takes these places away.
pub fn unpad(particles: &mut Particles) {
    let count = particles.len();
    let Particles { positions, velocities, angles, angular_velocities, forces, torques, .. } = particles;
    for vectors in [positions, velocities, forces] {
        vectors.truncate(count);
    }
    for numbers in [angles, angular_velocities, torques] {
        numbers.truncate(count);
    }
}

/// Whether a load of `count` particles is one chunk whose arrays have a length that the compiler knows.
pub fn is_small(count: usize) -> bool {
    count + 2 <= SMALL
}

/// The place of the particle far from everything, in a load of `count`.
pub fn far(count: usize) -> u32 {
    count as u32
}

/// The place of the particle inside the rim, in a load of `count`.
pub fn inside(count: usize) -> u32 {
    count as u32 + 1
}

/// How particles move, as contacts read it.
pub trait MotionView: Copy {
    /// Center of a particle [m].
    fn position(self, particle: u32) -> [f64; 2];
    /// Velocity in the middle of the step [m/s].
    fn velocity(self, particle: u32) -> [f64; 2];
    /// Angular velocity in the middle of the step [rad/s].
    fn angular_velocity(self, particle: u32) -> f64;
}

/// A small load. Indices are masked, so that none can be out of bounds and none has to be compared with them: some 20
/// instructions of 250 for a block of contacts.
#[derive(Debug, Clone, Copy)]
pub struct SmallView<'a> {
    pub position: &'a [[f64; 2]; SMALL],
    pub velocity: &'a [[f64; 2]; SMALL],
    pub angular_velocity: &'a [f64; SMALL],
}

/// The place of a particle of a small load.
#[inline(always)]
pub fn masked(particle: u32) -> usize {
    particle as usize & (SMALL - 1)
}

impl MotionView for SmallView<'_> {
    #[inline(always)]
    fn position(self, particle: u32) -> [f64; 2] {
        self.position[masked(particle)]
    }

    #[inline(always)]
    fn velocity(self, particle: u32) -> [f64; 2] {
        self.velocity[masked(particle)]
    }

    #[inline(always)]
    fn angular_velocity(self, particle: u32) -> f64 {
        self.angular_velocity[masked(particle)]
    }
}

/// A load of any size.
#[derive(Debug, Clone, Copy)]
pub struct LargeView<'a> {
    pub position: &'a [[f64; 2]],
    pub velocity: &'a [[f64; 2]],
    pub angular_velocity: &'a [f64],
}

impl MotionView for LargeView<'_> {
    #[inline(always)]
    fn position(self, particle: u32) -> [f64; 2] {
        self.position[particle as usize]
    }

    #[inline(always)]
    fn velocity(self, particle: u32) -> [f64; 2] {
        self.velocity[particle as usize]
    }

    #[inline(always)]
    fn angular_velocity(self, particle: u32) -> f64 {
        self.angular_velocity[particle as usize]
    }
}
