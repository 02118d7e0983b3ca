//! What the motion of a particle depends on and no step changes.

use super::quad::rest_of;
use crate::lanes::{LANES, Lanes};
use crate::physics::particles::Particles;
use crate::threads::CHUNK;

/// Masses, and the inverses that turn loads into accelerations. Where all particles are equal, a chunk of each is kept.
#[derive(Debug, Clone)]
pub(super) struct Constants {
    masses: Vec<f64>,
    inverse_masses: Vec<f64>,
    /// 0 where the spin is locked.
    inverse_inertias: Vec<f64>,
    all_equal: bool,
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
    pub(super) fn of(&self, first: usize, count: usize) -> Each<'_> {
        let first = if self.all_equal { 0 } else { first };
        let range = first..first + count;
        Each {
            masses: &self.masses[range.clone()],
            inverse_masses: &self.inverse_masses[range.clone()],
            inverse_inertias: &self.inverse_inertias[range],
        }
    }

    /// Those of all particles, where they are equal.
    pub(super) fn same(&self) -> Option<Same> {
        let first = self.all_equal.then_some(0)?;
        Some(Same {
            mass: *self.masses.get(first)?,
            inverse_mass: self.inverse_masses[first],
            inverse_inertia: self.inverse_inertias[first],
        })
    }
}

/// The constants of some particles in a row, four at a time.
pub(super) trait Inertia: Copy {
    /// Whether they are the same for all.
    const SAME: bool;
    /// Those of quad `quad` of `quads`.
    fn of(&self, quad: usize, quads: usize) -> QuadConstants;
}

/// The constants of four particles, as rows of two that fit the rows of motions.
pub(super) struct QuadConstants {
    /// m [kg/m], for x and y.
    pub(super) masses: [Lanes; 2],
    /// 1/m [m/kg], for x and y.
    pub(super) inverse_masses: [Lanes; 2],
    /// 1/I, 0 where the spin is locked, each before a zero.
    pub(super) inverse_inertias: [Lanes; 2],
}

/// The constants of particles that are all equal.
#[derive(Debug, Clone, Copy)]
pub(super) struct Same {
    mass: f64,
    inverse_mass: f64,
    inverse_inertia: f64,
}

impl Inertia for Same {
    const SAME: bool = true;

    #[inline(always)]
    fn of(&self, _quad: usize, _quads: usize) -> QuadConstants {
        QuadConstants {
            masses: [Lanes::splat(self.mass); 2],
            inverse_masses: [Lanes::splat(self.inverse_mass); 2],
            inverse_inertias: [before_zeros(self.inverse_inertia, self.inverse_inertia); 2],
        }
    }
}

/// The constants of particles that may differ.
#[derive(Debug, Clone, Copy)]
pub(super) struct Each<'a> {
    /// m [kg/m].
    pub(super) masses: &'a [f64],
    /// 1/m [m/kg].
    pub(super) inverse_masses: &'a [f64],
    /// 1/I, 0 where the spin is locked.
    pub(super) inverse_inertias: &'a [f64],
}

impl Each<'_> {
    /// Shows `work` those after the last whole quad, filled up with zeros.
    pub(super) fn with_rest<R>(&self, work: impl FnOnce(Each) -> R) -> R {
        work(Each {
            masses: &rest_of(self.masses),
            inverse_masses: &rest_of(self.inverse_masses),
            inverse_inertias: &rest_of(self.inverse_inertias),
        })
    }
}

impl Inertia for Each<'_> {
    const SAME: bool = false;

    #[inline(always)]
    fn of(&self, quad: usize, quads: usize) -> QuadConstants {
        let four = |values: &[f64]| -> [f64; LANES] { values.as_chunks().0[..quads][quad] };
        let twice = |[a, b, c, d]: [f64; LANES]| [Lanes::new([a, a, b, b]), Lanes::new([c, c, d, d])];
        let [a, b, c, d] = four(self.inverse_inertias);
        QuadConstants {
            masses: twice(four(self.masses)),
            inverse_masses: twice(four(self.inverse_masses)),
            inverse_inertias: [before_zeros(a, b), before_zeros(c, d)],
        }
    }
}

/// Two numbers, each before a zero.
#[inline(always)]
pub(super) fn before_zeros(one: f64, other: f64) -> Lanes {
    Lanes::new([one, 0.0, other, 0.0])
}
