//! The motions that contacts read, while chunks that nobody reads any more already move on.

use crate::integrator::Motion;
use crate::threads::CHUNK;

/// What contacts read.
pub trait Motions: Copy {
    /// The motion of one particle.
    fn of(&self, particle: u32) -> &Motion;
    /// The same where it is at hand.
    fn get(&self, particle: u32) -> Option<&Motion>;
    /// Those of the chunk that begins with particle `first`.
    fn of_chunk(&self, first: usize) -> &[Motion];
}

/// The motions of particles in a row that a thread holds, and where those of others are.
#[derive(Debug, Clone, Copy)]
pub struct Held<'a, O> {
    own: &'a [Motion],
    others: O,
}

impl<'a, O: Others> Held<'a, O> {
    /// These in a row, and others.
    pub fn new(own: &'a [Motion], others: O) -> Self {
        Self { own, others }
    }
}

impl<O: Others> Motions for Held<'_, O> {
    #[inline(always)]
    fn of(&self, particle: u32) -> &Motion {
        self.get(particle).unwrap_or_else(|| self.others.of(particle))
    }

    #[inline(always)]
    fn get(&self, particle: u32) -> Option<&Motion> {
        self.own.get(particle as usize - self.others.first())
    }

    fn of_chunk(&self, first: usize) -> &[Motion] {
        let own = &self.own[first - self.others.first()..];
        &own[..own.len().min(CHUNK)]
    }
}

/// Where to find the motions of particles that a thread does not hold.
pub trait Others: Copy {
    /// The first particle that it does hold.
    fn first(&self) -> usize;
    /// The motion of one that it does not.
    fn of(&self, particle: u32) -> &Motion;
}

/// There are no others.
#[derive(Debug, Clone, Copy)]
pub struct Nobody;

impl Others for Nobody {
    #[inline(always)]
    fn first(&self) -> usize {
        0
    }

    // Who is missing is not told: to have the number at hand costs every read an instruction.
    #[cold]
    #[inline(never)]
    fn of(&self, _particle: u32) -> &Motion {
        panic!("a contact has a particle that does not exist")
    }
}

/// Other threads have the others, and there are copies.
#[derive(Debug, Clone, Copy)]
pub struct Elsewhere<'a> {
    /// The first particle that is held here.
    pub first: usize,
    /// By chunk.
    pub copies: &'a [Copies],
}

impl Others for Elsewhere<'_> {
    #[inline(always)]
    fn first(&self) -> usize {
        self.first
    }

    #[cold]
    #[inline(never)]
    fn of(&self, particle: u32) -> &Motion {
        self.copies[particle as usize / CHUNK].of(particle)
    }
}

/// Copies of the motions of those of a chunk's particles that earlier stretches read.
#[derive(Debug, Clone, Default)]
pub struct Copies {
    particles: Vec<u32>,
    motions: Vec<Motion>,
}

impl Copies {
    /// Has all of a chunk's particles forgotten.
    pub fn clear(&mut self) {
        self.particles.clear();
    }

    /// Takes note that a particle will be read.
    pub fn add(&mut self, particle: u32) {
        self.particles.push(particle);
    }

    /// Puts the particles in order, each once.
    pub fn sort(&mut self) {
        self.particles.sort_unstable();
        self.particles.dedup();
    }

    /// Copies the motions anew. `motions` are those of the chunk, which begins with particle `first`.
    pub fn renew(&mut self, first: usize, motions: &[Motion]) {
        self.motions.clear();
        self.motions.extend(self.particles.iter().map(|&particle| motions[particle as usize - first]));
    }

    fn of(&self, particle: u32) -> &Motion {
        &self.motions[self.particles.partition_point(|&own| own < particle)]
    }
}
