//! Reactions on particles of other chunks.
//!
//! A chunk adds its contacts to its own particles and keeps the reactions on particles of later chunks. Then every chunk
//! gathers what is meant for it, in the order of the chunks that sent it. That order depends on neither threads nor lists.

use crate::engine::motion::MotionArrays;
use crate::engine::parallel::CHUNK;

/// A reaction on a particle of another chunk.
#[derive(Debug, Clone, Copy)]
struct Reaction {
    particle: u32,
    force: [f64; 2],
    moment: f64,
}

/// What one chunk's contacts do in this step to particles of later chunks, by chunk.
#[derive(Debug, Clone, Default)]
pub struct RemoteReactions {
    /// The chunks that contacts may be with; ascending.
    targets: Vec<u32>,
    reactions: Vec<Vec<Reaction>>,
}

impl RemoteReactions {
    /// Makes room for the chunks of `others`, the particles that contacts may be with; `own` is the chunk they are of.
    pub fn prepare(&mut self, own: usize, others: impl Iterator<Item = u32>) {
        self.targets.clear();
        let mut last = own as u32;
        for chunk in others.map(|other| other / CHUNK as u32) {
            // Most are of the same chunk as the one before.
            if chunk != last && chunk != own as u32 {
                self.targets.push(chunk);
            }
            last = chunk;
        }
        self.targets.sort_unstable();
        self.targets.dedup();
        self.reactions.resize(self.targets.len(), Vec::new());
        self.clear();
    }

    /// The chunks that contacts may be with; ascending.
    pub fn targets(&self) -> &[u32] {
        &self.targets
    }

    /// Forgets the last step's.
    pub fn clear(&mut self) {
        for reactions in &mut self.reactions {
            reactions.clear();
        }
    }

    /// Keeps a reaction; one on a particle that is none is dropped.
    #[cold]
    #[inline(never)]
    pub fn send(&mut self, particle: u32, force: [f64; 2], moment: f64) {
        let target = particle / CHUNK as u32;
        if let Ok(index) = self.targets.binary_search(&target) {
            self.reactions[index].push(Reaction { particle, force, moment });
        }
    }

    /// Adds what is meant for chunk `chunk` to its sums.
    pub fn gather(&self, chunk: usize, arrays: &mut MotionArrays) {
        let Ok(index) = self.targets.binary_search(&(chunk as u32)) else { return };
        for reaction in &self.reactions[index] {
            let own = reaction.particle as usize - chunk * CHUNK;
            let ([.., forces], [.., torques]) = (&mut arrays.vectors, &mut arrays.scalars);
            let (Some(force), Some(torque)) = (forces.get_mut(own), torques.get_mut(own)) else { continue };
            force[0] += reaction.force[0];
            force[1] += reaction.force[1];
            *torque += reaction.moment;
        }
    }
}
