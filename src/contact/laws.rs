//! The laws of a simulation: which one, with which damping, acts between two materials or a material and the drum.

use super::linear::{LinearLaw, LinearParameters};

/// What a contact's slot needs of its law, worked out once when the slot is made.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SlotLaw {
    /// Damping νₙ of this pair of bodies [N s/m].
    pub damping: f64,
    /// Index into the laws of this kind of contact.
    pub law: u32,
}

/// Laws for all pairs of materials, and for each material against the drum.
#[derive(Debug, Clone, PartialEq)]
pub struct Laws {
    materials: usize,
    /// Between materials `a` and `b`: entry `a · materials + b`.
    pairs: Vec<LinearLaw>,
    /// Between each material and the drum.
    walls: Vec<LinearLaw>,
}

impl Laws {
    /// The laws of one material.
    pub fn new(bundle: &LinearParameters, drum: &LinearParameters) -> Self {
        Self { materials: 1, pairs: vec![bundle.into()], walls: vec![drum.into()] }
    }

    /// Number of materials; a particle's index is below it.
    pub fn materials(&self) -> usize {
        self.materials
    }

    /// The law of a slot between particles.
    #[inline]
    pub fn pair(&self, slot: SlotLaw) -> &LinearLaw {
        &self.pairs[slot.law as usize]
    }

    /// The law of a slot between a particle and the drum.
    #[inline]
    pub fn wall(&self, slot: SlotLaw) -> &LinearLaw {
        &self.walls[slot.law as usize]
    }

    /// The laws between particles.
    pub fn pairs(&self) -> &[LinearLaw] {
        &self.pairs
    }

    /// The laws between particles and the drum.
    pub fn walls(&self) -> &[LinearLaw] {
        &self.walls
    }

    /// The slot between two particles, each given as (material, mass); m* = m₁ m₂ / (m₁ + m₂).
    pub fn pair_slot(&self, one: (u16, f64), two: (u16, f64)) -> SlotLaw {
        let law = usize::from(one.0) * self.materials + usize::from(two.0);
        let effective_mass = one.1 * two.1 / (one.1 + two.1);
        SlotLaw { damping: self.pairs[law].damping(effective_mass), law: law as u32 }
    }

    /// The slot between a particle, given as (material, mass), and the drum, whose mass is infinite: m* = m.
    pub fn wall_slot(&self, particle: (u16, f64)) -> SlotLaw {
        let law = usize::from(particle.0);
        SlotLaw { damping: self.walls[law].damping(particle.1), law: law as u32 }
    }

    /// Shortest collision times [s] for particles no lighter than `mass`: (between particles, with the drum).
    pub fn collision_times(&self, mass: f64) -> (f64, f64) {
        let shortest = |laws: &[LinearLaw], effective_mass: f64| {
            laws.iter().map(|law| law.collision_time(effective_mass)).fold(f64::INFINITY, f64::min)
        };
        (shortest(&self.pairs, 0.5 * mass), shortest(&self.walls, mass))
    }
}
