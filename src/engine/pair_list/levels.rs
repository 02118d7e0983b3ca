//! Particles by size, each size in a grid of cells of its own.
//!
//! The textbook sizes cells by the largest particle: a small one then looks at all the small ones in nine large cells, 40 times
//! as many as it needs to where sizes are 1 : 10. Here a level holds the particles of which none is more than twice as large as
//! another, in cells of their size, and each particle looks into all levels, as far as it and a particle of that level may
//! touch (the hierarchical grid of Ogarko & Luding, Comput. Phys. Commun. 183, 2012). Equal particles are one level.

use super::cells::CellGrid;
use crate::engine::forces::Bodies;
use crate::engine::parallel::Threads;
use crate::physics::vector::Vec2;

/// Particles of similar size.
#[derive(Debug, Clone, Default)]
pub struct Level {
    /// The greatest radius that there may be [m].
    pub largest: f64,
    /// Where they are.
    pub grid: CellGrid,
    particles: Vec<u32>,
}

/// All levels, the largest particles first.
#[derive(Debug, Clone)]
pub struct Levels(Vec<Level>);

impl Levels {
    /// For particles of which the largest has this radius [m].
    pub fn new(largest: f64) -> Self {
        Self(vec![Level { largest, ..Level::default() }])
    }

    /// Sorts the particles by size, then each level's into cells; `skin` is the margin of the pair list [m].
    pub fn fill(
        &mut self,
        positions: &[Vec2],
        bodies: &Bodies,
        bounds: (Vec2, Vec2),
        skin: f64,
        threads: &Threads,
    ) {
        self.0.iter_mut().for_each(|level| level.particles.clear());
        for particle in 0..positions.len() as u32 {
            let radius = bodies.radius_of(particle);
            let mut level = 0;
            while radius <= 0.5 * self.0[level].largest {
                level += 1;
                if level == self.0.len() {
                    let largest = 0.5 * self.0[level - 1].largest;
                    self.0.push(Level { largest, ..Level::default() });
                }
            }
            self.0[level].particles.push(particle);
        }
        for Level { largest, grid, particles } in &mut self.0 {
            grid.fill(particles, positions, bounds, 2.0 * *largest + skin, threads);
        }
    }

    /// The levels.
    pub fn iter(&self) -> impl Iterator<Item = &Level> {
        self.0.iter()
    }
}
