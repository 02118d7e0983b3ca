//! The search of the cells: which bodies are near each particle of a chunk.

use super::chunk::ChunkNeighbors;
use super::levels::Levels;
use crate::engine::forces::StepInputs;
use crate::engine::parallel::CHUNK;
use crate::physics::drum::RIM;
use crate::physics::vector::{Vec2, dot};

/// Where a search looks.
#[derive(Debug, Clone, Copy)]
pub struct Search<'a> {
    pub levels: &'a Levels,
    /// Positions in the drum's frame.
    pub anchors: &'a [Vec2],
    pub positions: &'a [Vec2],
    /// The margin [m].
    pub skin: f64,
}

impl Search<'_> {
    /// Finds the neighbors of one chunk's particles.
    pub fn run(&self, chunk: &mut ChunkNeighbors, inputs: &StepInputs) {
        chunk.pairs.clear();
        chunk.features.clear();
        chunk.watched.clear();
        chunk.rim.clear();
        chunk.horizon.end();
        let mut features = Vec::new();
        for particle in chunk.particles.clone() {
            self.find_particles(chunk, particle, inputs);
            let (center, reach) =
                (self.anchors[particle as usize], inputs.bodies.radius_of(particle) + self.skin);
            if inputs.drum.radius().is_some_and(|rim| center.norm() >= rim - reach) {
                chunk.rim.push(particle, RIM);
            }
            features.clear();
            inputs.drum.features_near(center, reach, &mut features);
            for &feature in &features {
                chunk.features.push(particle, feature);
            }
        }
        chunk.watched.sort_unstable();
        chunk.watched.dedup();
    }

    /// Finds the later particles near one.
    fn find_particles(&self, chunk: &mut ChunkNeighbors, particle: u32, inputs: &StepInputs) {
        let (own, radius) =
            (self.positions[particle as usize], inputs.bodies.radius_of(particle) + self.skin);
        let start = chunk.pairs.pairs().len();
        for level in self.levels.iter() {
            for &(other, position) in level.grid.around(own, radius + level.largest) {
                let (apart, reach) = (position - own, radius + inputs.bodies.radius_of(other));
                if other > particle && dot(apart, apart) < reach * reach {
                    chunk.pairs.push(particle, other);
                }
            }
        }
        chunk.pairs.sort_from(start);
        let of_chunk = |other: u32| other / CHUNK as u32;
        let own = of_chunk(particle);
        if let Some(&(_, last)) = chunk.pairs.pairs().last()
            && of_chunk(last) != own
        {
            let others = chunk.pairs.pairs()[start..].iter().map(|pair| of_chunk(pair.1));
            chunk.watched.extend(others.filter(|&other| other != own));
        }
    }
}
