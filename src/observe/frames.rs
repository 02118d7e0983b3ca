//! Frames: where the bundles are, now and then.

use serde::{Deserialize, Serialize};

use super::memory;
use crate::error::Error;
use crate::physics::particles::Particles;

/// Pictures of the load: single precision is plenty for them (15 nm in a drum of half a meter).
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Frames {
    /// Times [s].
    pub times: Vec<f64>,
    /// Angles of the drum [rad].
    pub drum_angles: Vec<f64>,
    /// Centers [m]: x, y of each particle in id order, frame after frame.
    pub positions: Vec<f32>,
    /// Angles of the particles [rad], within ±π.
    pub angles: Vec<f32>,
    /// Velocities [m/s], like the positions.
    pub velocities: Vec<f32>,
    /// Numbers of contacts of the particles; 0 in flight.
    pub contacts: Vec<u16>,
}

impl Frames {
    /// Reserves memory for frames of `count` particles, so that `push` cannot fail.
    ///
    /// # Errors
    /// `Error::Memory` naming `action` where there is none.
    pub fn reserve(&mut self, frames: usize, count: usize, action: &'static str) -> Result<(), Error> {
        memory::reserve(&mut self.times, frames, action)?;
        memory::reserve(&mut self.drum_angles, frames, action)?;
        memory::reserve(&mut self.positions, 2 * frames * count, action)?;
        memory::reserve(&mut self.angles, frames * count, action)?;
        memory::reserve(&mut self.velocities, 2 * frames * count, action)?;
        memory::reserve(&mut self.contacts, frames * count, action)
    }

    /// A copy of these frames of `count` particles.
    ///
    /// # Errors
    /// `Error::Memory` where there is no room for it.
    pub fn try_clone(&self, count: usize) -> Result<Self, Error> {
        let mut copy = Self::default();
        copy.reserve(self.len(), count, "reading the frames")?;
        copy.extend(self);
        Ok(copy)
    }

    /// Puts frames of `count` particles before those that are there.
    ///
    /// # Errors
    /// `Error::Memory` where there is no room for them; nothing has changed then.
    pub fn prepend(&mut self, mut earlier: Self, count: usize) -> Result<(), Error> {
        earlier.reserve(self.len(), count, "putting frames back")?;
        earlier.extend(self);
        *self = earlier;
        Ok(())
    }

    fn extend(&mut self, more: &Self) {
        self.times.extend_from_slice(&more.times);
        self.drum_angles.extend_from_slice(&more.drum_angles);
        self.positions.extend_from_slice(&more.positions);
        self.angles.extend_from_slice(&more.angles);
        self.velocities.extend_from_slice(&more.velocities);
        self.contacts.extend_from_slice(&more.contacts);
    }

    /// How much memory the frames take [bytes].
    pub fn size(&self) -> usize {
        8 * (self.times.len() + self.drum_angles.len())
            + 4 * (self.positions.len() + self.angles.len() + self.velocities.len())
            + 2 * self.contacts.len()
    }

    /// How much memory a frame of `count` particles takes [bytes].
    pub fn size_of_one(count: usize) -> usize {
        let (numbers, singles, shorts) = (2, 5, 1);
        8 * numbers + (4 * singles + 2 * shorts) * count
    }

    /// Appends a frame. Returns the numbers of contacts by id, all 0, to count in.
    pub fn push(&mut self, time: f64, drum_angle: f64, particles: &Particles) -> &mut [u16] {
        self.times.push(time);
        self.drum_angles.push(drum_angle);
        let (start, end) = (self.angles.len(), self.angles.len() + particles.len());
        self.positions.resize(2 * end, 0.0);
        self.angles.resize(end, 0.0);
        self.velocities.resize(2 * end, 0.0);
        self.contacts.resize(end, 0);
        for (i, &id) in particles.ids.iter().enumerate() {
            let place = start + id as usize;
            let (position, velocity, angle) =
                (particles.positions[i], particles.velocities[i], particles.angles[i]);
            let turns = (angle / std::f64::consts::TAU).round();
            for axis in 0..2 {
                self.positions[2 * place + axis] = position[axis] as f32;
                self.velocities[2 * place + axis] = velocity[axis] as f32;
            }
            self.angles[place] = (angle - turns * std::f64::consts::TAU) as f32;
        }
        &mut self.contacts[start..]
    }

    /// Whether these are whole frames of `count` particles.
    pub fn are_of(&self, count: usize) -> bool {
        let values = self.len() * count;
        self.drum_angles.len() == self.len()
            && self.positions.len() == 2 * values
            && self.angles.len() == values
            && self.velocities.len() == 2 * values
            && self.contacts.len() == values
    }

    /// Number of frames.
    pub fn len(&self) -> usize {
        self.times.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.times.is_empty()
    }
}
