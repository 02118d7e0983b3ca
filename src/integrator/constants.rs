//! What the motion of a particle depends on and no step changes.

use crate::particles::Particles;
use crate::threads::CHUNK;

/// Masses, and the inverses that turn loads into accelerations. Where all particles are equal, a chunk of each is kept,
/// which stays in the cache.
#[derive(Debug, Clone)]
pub(super) struct Constants {
    masses: Vec<f64>,
    inverse_masses: Vec<f64>,
    /// 0 where the spin is locked.
    inverse_inertias: Vec<f64>,
    all_equal: bool,
}

/// The constants of some particles in a row.
#[derive(Debug, Clone, Copy)]
pub(super) struct ConstantsOf<'a> {
    /// m [kg/m].
    pub(super) masses: &'a [f64],
    /// 1/m [m/kg].
    pub(super) inverse_masses: &'a [f64],
    /// 1/I, 0 where the spin is locked.
    pub(super) inverse_inertias: &'a [f64],
}

impl Constants {
    pub(super) fn new(particles: &Particles) -> Self {
        let (masses, inertias) = (&particles.masses, &particles.inertias);
        let is_same = |values: &[f64]| values.iter().all(|&value| value == values[0]);
        let all_equal = is_same(masses) && is_same(inertias);
        let kept = if all_equal { masses.len().min(CHUNK) } else { masses.len() };
        let inverse = |value: &f64| if *value > 0.0 { 1.0 / value } else { 0.0 };
        Self {
            masses: masses[..kept].to_vec(),
            inverse_masses: masses[..kept].iter().map(inverse).collect(),
            inverse_inertias: inertias[..kept].iter().map(inverse).collect(),
            all_equal,
        }
    }

    /// Those of `count` particles from `first` on, all of one chunk.
    #[inline]
    pub(super) fn of(&self, first: usize, count: usize) -> ConstantsOf<'_> {
        let first = if self.all_equal { 0 } else { first };
        let range = first..first + count;
        ConstantsOf {
            masses: &self.masses[range.clone()],
            inverse_masses: &self.inverse_masses[range.clone()],
            inverse_inertias: &self.inverse_inertias[range],
        }
    }
}
