//! Patches: particles in a row, neighbors in large loads, whose motion is followed together.

use crate::physics::vector::larger;

/// Particles per patch; a chunk has several.
pub const PATCH: usize = 128;

/// The most that a particle of some patch did in a step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PatchMotion {
    /// How far it went as seen from the drum [m].
    pub way: f64,
    /// How much its displacement changed from that of the step before [m].
    pub change: f64,
}

impl PatchMotion {
    /// The most of two.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self { way: larger(self.way, other.way), change: larger(self.change, other.change) }
    }
}
