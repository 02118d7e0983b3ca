//! The arrays that move, and how contacts read them.

pub mod verlet;

use std::ops::Range;

use crate::engine::forces::Bodies;
use crate::physics::contact::species::SpeciesTable;
use crate::physics::particles::Particles;

/// Numbers in a flat array of vectors: as many as an offset of 16 bits can reach.
const FLAT: usize = 1 << 16;

/// Numbers in a flat array with one for each particle.
const HALF: usize = 1 << 15;

/// A place far from everything: its distance from any particle is finite, and no contact.
const FAR: f64 = 1e150;

/// Where a particle's vectors are in flat arrays: twice its number. Contacts keep offsets, not numbers, which spares a shift
/// wherever they read or write a vector.
#[inline(always)]
pub fn offset(particle: u32) -> u32 {
    2 * particle
}

/// The particle at an offset.
#[inline(always)]
pub fn at_offset(offset: u32) -> u32 {
    offset / 2
}

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

impl<'a> MotionArrays<'a> {
    /// Those of some particles, and what the particles are made of.
    pub fn and_bodies(
        particles: &'a mut Particles,
        radius: Option<f64>,
        table: &'a SpeciesTable,
    ) -> (Self, Bodies<'a>) {
        let Particles { positions, velocities, angles, angular_velocities, forces, torques, .. } = particles;
        let arrays = Self {
            position: bytemuck::must_cast_slice_mut(positions),
            velocity: bytemuck::must_cast_slice_mut(velocities),
            angle: angles,
            angular_velocity: angular_velocities,
            force: bytemuck::must_cast_slice_mut(forces),
            torque: torques,
        };
        let Particles { radii, masses, species, .. } = particles;
        (arrays, Bodies { radius, radii, masses, species, table })
    }

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

/// The moving part of a load that 16 bits of offset reach, in arrays whose length the compiler knows: no index needs to be
/// compared with it. The textbook compares every one, here some 50 instructions of 290 for a block of contacts are saved.
/// The arrays are much longer than most loads; memory that is not used is not touched.
#[derive(Debug, Clone)]
pub struct FlatArrays {
    position: Box<[f64; FLAT + 1]>,
    velocity: Box<[f64; FLAT]>,
    force: Box<[f64; FLAT]>,
    angle: Box<[f64; HALF]>,
    angular_velocity: Box<[f64; HALF]>,
    torque: Box<[f64; HALF]>,
}

/// Zeros that take no memory until they are written to.
fn zeros<const N: usize>() -> Box<[f64; N]> {
    vec![0.0; N].into_boxed_slice().try_into().expect("a slice of this length")
}

impl FlatArrays {
    /// Whether they can hold `count` particles, and two places more.
    pub fn can_hold(count: usize) -> bool {
        count + 2 <= HALF
    }

    /// Room for `count` particles. Lanes without a contact refer to the places after the last one: a particle far from
    /// everything, and one at `inside`, where it touches no rim.
    pub fn new(count: usize, inside: f64) -> Self {
        let mut position = zeros();
        position[2 * count] = FAR;
        position[2 * (count + 1)] = inside;
        Self {
            position,
            velocity: zeros(),
            force: zeros(),
            angle: zeros(),
            angular_velocity: zeros(),
            torque: zeros(),
        }
    }

    /// Takes what moves from the particles.
    pub fn load(&mut self, particles: &mut Particles) {
        let count = particles.len();
        let (own, other) = (self.part(0..count), MotionArrays::of(particles));
        own.position.copy_from_slice(other.position);
        own.velocity.copy_from_slice(other.velocity);
        own.force.copy_from_slice(other.force);
        own.angle.copy_from_slice(other.angle);
        own.angular_velocity.copy_from_slice(other.angular_velocity);
        own.torque.copy_from_slice(other.torque);
    }

    /// Brings it back to them.
    pub fn store(&mut self, particles: &mut Particles) {
        let count = particles.len();
        let (own, other) = (self.part(0..count), MotionArrays::of(particles));
        other.position.copy_from_slice(own.position);
        other.velocity.copy_from_slice(own.velocity);
        other.force.copy_from_slice(own.force);
        other.angle.copy_from_slice(own.angle);
        other.angular_velocity.copy_from_slice(own.angular_velocity);
        other.torque.copy_from_slice(own.torque);
    }

    /// How the particles move, to read; forces and torques, to write to.
    #[inline(always)]
    pub fn lend_whole(&mut self) -> (FlatView<'_>, FlatSums<'_>) {
        let Self { position, velocity, angular_velocity, force, torque, .. } = self;
        (FlatView { position, velocity, angular_velocity }, FlatSums { force, torque })
    }
}

/// The arrays that move, however they are kept.
pub trait Motion {
    /// How they are read.
    type View<'a>: MotionView
    where
        Self: 'a;

    /// How the particles move, to read; forces and torques of the first `count`, to write to.
    fn lend(&mut self, count: usize) -> (Self::View<'_>, &mut [[f64; 2]], &mut [f64]);

    /// The arrays of some of the particles.
    fn part(&mut self, range: Range<usize>) -> MotionArrays<'_>;
}

impl Motion for FlatArrays {
    type View<'a> = FlatView<'a>;

    fn lend(&mut self, count: usize) -> (FlatView<'_>, &mut [[f64; 2]], &mut [f64]) {
        let Self { position, velocity, angular_velocity, force, torque, .. } = self;
        let view = FlatView { position, velocity, angular_velocity };
        (view, force[..2 * count].as_chunks_mut().0, &mut torque[..count])
    }

    fn part(&mut self, range: Range<usize>) -> MotionArrays<'_> {
        let flat = 2 * range.start..2 * range.end;
        MotionArrays {
            position: self.position[flat.clone()].as_chunks_mut().0,
            velocity: self.velocity[flat.clone()].as_chunks_mut().0,
            force: self.force[flat].as_chunks_mut().0,
            angle: &mut self.angle[range.clone()],
            angular_velocity: &mut self.angular_velocity[range.clone()],
            torque: &mut self.torque[range],
        }
    }
}

impl Motion for MotionArrays<'_> {
    type View<'a>
        = LargeView<'a>
    where
        Self: 'a;

    fn lend(&mut self, count: usize) -> (LargeView<'_>, &mut [[f64; 2]], &mut [f64]) {
        let Self { position, velocity, angular_velocity, force, torque, .. } = self;
        (LargeView { position, velocity, angular_velocity }, &mut force[..count], &mut torque[..count])
    }

    fn part(&mut self, range: Range<usize>) -> MotionArrays<'_> {
        MotionArrays {
            position: &mut self.position[range.clone()],
            velocity: &mut self.velocity[range.clone()],
            angle: &mut self.angle[range.clone()],
            angular_velocity: &mut self.angular_velocity[range.clone()],
            force: &mut self.force[range.clone()],
            torque: &mut self.torque[range],
        }
    }
}

/// Where a simulation's moving arrays are while steps are done.
#[derive(Debug)]
pub enum Arrays<'a> {
    /// Arrays of a length that the compiler knows.
    Flat(&'a mut FlatArrays),
    /// The particles' own, two places longer than usual.
    Large(MotionArrays<'a>),
}

/// Forces and torques of flat arrays.
#[derive(Debug)]
pub struct FlatSums<'a> {
    /// Forces [N/m].
    pub force: &'a mut [f64; FLAT],
    /// Torques [N m/m].
    pub torque: &'a mut [f64; HALF],
}

/// Gives the moving arrays places beyond the last particle while steps are done: lanes without a contact refer to them, see
/// `FlatArrays`.
pub fn pad(particles: &mut Particles, inside: f64) {
    let count = particles.len();
    let Particles { positions, velocities, angles, angular_velocities, forces, torques, .. } = particles;
    for vectors in [&mut *positions, velocities, forces] {
        vectors.resize(count + 2, nalgebra::zero());
    }
    for numbers in [angles, angular_velocities, torques] {
        numbers.resize(count + 2, 0.0);
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

/// The place of the particle far from everything, in a load of `count`.
pub fn far(count: usize) -> u32 {
    count as u32
}

/// The place of the particle inside the rim, in a load of `count`.
pub fn inside(count: usize) -> u32 {
    count as u32 + 1
}

/// How particles move, as contacts read it, by their offsets.
pub trait MotionView: Copy + Send + Sync {
    /// Center of a particle [m].
    fn position(self, offset: u32) -> [f64; 2];
    /// Velocity in the middle of the step [m/s].
    fn velocity(self, offset: u32) -> [f64; 2];
    /// Angular velocity in the middle of the step [rad/s].
    fn angular_velocity(self, offset: u32) -> f64;
}

/// The motion in flat arrays.
#[derive(Debug, Clone, Copy)]
pub struct FlatView<'a> {
    position: &'a [f64; FLAT + 1],
    velocity: &'a [f64; FLAT],
    angular_velocity: &'a [f64; HALF],
}

/// An offset as an index that is even and within flat arrays for sure.
#[inline(always)]
pub fn flat(offset: u32) -> usize {
    (offset & (FLAT as u32 - 2)) as usize
}

impl MotionView for FlatView<'_> {
    #[inline(always)]
    fn position(self, offset: u32) -> [f64; 2] {
        // Positions alone are read without a number beside them: an offset need not be known to be even.
        let x = usize::from(offset as u16);
        [self.position[x], self.position[x + 1]]
    }

    #[inline(always)]
    fn velocity(self, offset: u32) -> [f64; 2] {
        [self.velocity[flat(offset)], self.velocity[flat(offset) + 1]]
    }

    #[inline(always)]
    fn angular_velocity(self, offset: u32) -> f64 {
        self.angular_velocity[flat(offset) / 2]
    }
}

/// The motion of a load of any size.
#[derive(Debug, Clone, Copy)]
pub struct LargeView<'a> {
    position: &'a [[f64; 2]],
    velocity: &'a [[f64; 2]],
    angular_velocity: &'a [f64],
}

impl MotionView for LargeView<'_> {
    #[inline(always)]
    fn position(self, offset: u32) -> [f64; 2] {
        self.position[at_offset(offset) as usize]
    }

    #[inline(always)]
    fn velocity(self, offset: u32) -> [f64; 2] {
        self.velocity[at_offset(offset) as usize]
    }

    #[inline(always)]
    fn angular_velocity(self, offset: u32) -> f64 {
        self.angular_velocity[at_offset(offset) as usize]
    }
}
