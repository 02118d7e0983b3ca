//! The arrays that move, and how contacts read them.

pub mod verlet;

use std::ops::Range;

use crate::engine::parallel::CHUNK;
use crate::physics::particles::Particles;

/// Numbers in the flat force array of a chunk.
pub const CHUNK_FLAT: usize = 2 * CHUNK;

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
    /// The number of the first particle.
    pub first: usize,
    /// Centers [m], velocities [m/s], forces [N/m].
    pub vectors: [&'a mut [[f64; 2]]; 3],
    /// Angles [rad], angular velocities [rad/s], torques [N m/m].
    pub scalars: [&'a mut [f64]; 3],
}

impl<'a> MotionArrays<'a> {
    /// Those of some particles.
    pub fn of(particles: &'a mut Particles) -> Self {
        let Particles { positions, velocities, forces, angles, angular_velocities, torques, .. } = particles;
        let vectors = [positions, velocities, forces].map(|vectors| bytemuck::must_cast_slice_mut(vectors));
        Self { first: 0, vectors, scalars: [angles, angular_velocities, torques].map(Vec::as_mut_slice) }
    }

    /// Those of each chunk; the first of these particles is the first of all.
    pub fn chunks(self) -> impl Iterator<Item = Self> + Send {
        let [positions, velocities, forces] = self.vectors.map(|values| values.chunks_mut(CHUNK));
        let [angles, spins, torques] = self.scalars.map(|values| values.chunks_mut(CHUNK));
        let chunks = positions.zip(velocities).zip(forces).zip(angles.zip(spins).zip(torques)).enumerate();
        chunks.map(|(chunk, (((x, v), f), ((a, w), t)))| Self {
            first: CHUNK * chunk,
            vectors: [x, v, f],
            scalars: [a, w, t],
        })
    }

    /// Takes the values of others, of as many particles.
    pub fn copy_from(&mut self, other: &MotionArrays) {
        for (own, other) in self.vectors.iter_mut().zip(&other.vectors) {
            own.copy_from_slice(other);
        }
        for (own, other) in self.scalars.iter_mut().zip(&other.scalars) {
            own.copy_from_slice(other);
        }
    }
}

/// The moving part of a load, in arrays whose length the compiler knows, so that masked indices need not be compared with
/// it. The textbook compares every one; here some 30 instructions of 290 for a block of contacts are saved.
///
/// `N` is a power of two: the mask of offsets is N − 1. Arrays of vectors are `M` numbers long and arrays of scalars `H`, eleven
/// cache lines more than the masks reach. Without these a particle would be at the same place of a memory page in every
/// array, and a CPU that sees a load follow a store to such an address waits for the store. The arrays are longer than most
/// loads: memory that is not used is not touched.
#[derive(Debug, Clone)]
pub struct FlatArrays<const N: usize, const M: usize, const H: usize> {
    /// Positions, velocities, forces; angles, angular velocities, torques.
    numbers: Box<[f64]>,
    /// Where they begin: at a cache line, so that four numbers are never on two of them.
    start: usize,
}

/// Numbers of an array that no mask reaches: eleven cache lines.
const SKEW: usize = 11 * LINE;
/// Numbers in a cache line.
const LINE: usize = 8;

/// Arrays that offsets of 16 bits reach: the cheapest masks there are.
pub type SmallArrays = FlatArrays<{ 1 << 16 }, { (1 << 16) + SKEW }, { (1 << 15) + SKEW }>;
/// Arrays for 16 million particles.
pub type LargeArrays = FlatArrays<{ 1 << 25 }, { (1 << 25) + SKEW }, { (1 << 24) + SKEW }>;

/// Arrays of the size that a load needs.
#[derive(Debug, Clone)]
pub enum Arrays {
    /// Up to 32 766 particles.
    Small(SmallArrays),
    /// More.
    Large(LargeArrays),
}

/// Does the same with arrays of any size.
macro_rules! with_arrays {
    ($arrays:expr, $own:ident => $work:expr) => {
        match $arrays {
            $crate::engine::motion::Arrays::Small($own) => $work,
            $crate::engine::motion::Arrays::Large($own) => $work,
        }
    };
}
pub(crate) use with_arrays;

impl Arrays {
    /// Room for `count` particles. Lanes without a contact refer to the places after the last one: a particle far from
    /// everything, and one at `inside`, where it touches no rim.
    pub fn new(count: usize, inside: f64) -> Self {
        match count {
            0..=32_766 => Self::Small(FlatArrays::new(count, inside)),
            _ => Self::Large(FlatArrays::new(count, inside)),
        }
    }

    /// The arrays of the first `count` particles.
    pub fn motion(&mut self, count: usize) -> MotionArrays<'_> {
        with_arrays!(self, arrays => arrays.part(0..count))
    }
}

impl<const N: usize, const M: usize, const H: usize> FlatArrays<N, M, H> {
    fn new(count: usize, inside: f64) -> Self {
        // Zeros take no memory until they are written to.
        let numbers = vec![0.0; 3 * M + 3 * H + LINE].into_boxed_slice();
        let start = numbers.as_ptr().align_offset(LINE * size_of::<f64>()).min(LINE);
        let mut arrays = Self { numbers, start };
        let ([position, ..], _) = arrays.split();
        position[2 * count] = FAR;
        position[2 * (count + 1)] = inside;
        arrays
    }

    /// The arrays of vectors and of scalars.
    #[inline(always)]
    fn split(&mut self) -> ([&mut [f64; M]; 3], [&mut [f64; H]; 3]) {
        let (vectors, scalars) = self.numbers[self.start..].split_at_mut(3 * M);
        (three(vectors), three(scalars))
    }

    /// How the particles move, to read; forces and torques by chunk, to write to. `ONE_CHUNK`: there is no more than one.
    #[inline(always)]
    pub fn lend<const ONE_CHUNK: bool>(&mut self) -> (FlatView<'_, N, M, H, ONE_CHUNK>, ChunkForces<'_>) {
        let ([position, velocity, force], [_, angular_velocity, torque]) = self.split();
        let forces = ChunkForces { force: force.as_chunks_mut().0, torque: torque.as_chunks_mut().0 };
        (FlatView { position, velocity, angular_velocity }, forces)
    }

    /// The arrays of some of the particles.
    #[inline(always)]
    pub fn part(&mut self, range: Range<usize>) -> MotionArrays<'_> {
        let flat = 2 * range.start..2 * range.end;
        let (vectors, scalars) = self.split();
        MotionArrays {
            first: range.start,
            vectors: vectors.map(|values| values[flat.clone()].as_chunks_mut().0),
            scalars: scalars.map(|values| &mut values[range.clone()]),
        }
    }
}

/// Three arrays at the beginning of a slice.
#[inline(always)]
fn three<const N: usize>(numbers: &mut [f64]) -> [&mut [f64; N]; 3] {
    match numbers.as_chunks_mut().0 {
        [a, b, c, ..] => [a, b, c],
        _ => unreachable!("room for three arrays"),
    }
}

/// Forces and torques of whole chunks.
#[derive(Debug)]
pub struct ChunkForces<'a> {
    /// Forces [N/m].
    pub force: &'a mut [[f64; CHUNK_FLAT]],
    /// Torques [N m/m].
    pub torque: &'a mut [[f64; CHUNK]],
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
    /// Whether there is no more than one chunk.
    const ONE_CHUNK: bool;
    /// Center of a particle [m].
    fn position(self, offset: u32) -> [f64; 2];
    /// Velocity in the middle of the step [m/s].
    fn velocity(self, offset: u32) -> [f64; 2];
    /// Angular velocity in the middle of the step [rad/s].
    fn angular_velocity(self, offset: u32) -> f64;
}

/// The motion in flat arrays.
#[derive(Debug, Clone, Copy)]
pub struct FlatView<'a, const N: usize, const M: usize, const H: usize, const ONE_CHUNK: bool> {
    position: &'a [f64; M],
    velocity: &'a [f64; M],
    angular_velocity: &'a [f64; H],
}

impl<const N: usize, const M: usize, const H: usize, const ONE_CHUNK: bool> MotionView
    for FlatView<'_, N, M, H, ONE_CHUNK>
{
    const ONE_CHUNK: bool = ONE_CHUNK;

    #[inline(always)]
    fn position(self, offset: u32) -> [f64; 2] {
        // Positions alone are read without a number beside them: an offset need not be known to be even.
        let x = offset as usize & (N - 1);
        [self.position[x], self.position[x + 1]]
    }

    #[inline(always)]
    fn velocity(self, offset: u32) -> [f64; 2] {
        let x = offset as usize & (N - 2);
        [self.velocity[x], self.velocity[x + 1]]
    }

    #[inline(always)]
    fn angular_velocity(self, offset: u32) -> f64 {
        self.angular_velocity[(offset as usize & (N - 2)) / 2]
    }
}
