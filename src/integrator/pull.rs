//! Where a drift takes the accelerations from: what the particles carry, or the loads of the last pass.

use super::Load;
use super::constants::{Inertia, QuadConstants, before_zeros};
use super::quad::{halves, rest_of, two_by_two};
use crate::lanes::{LANES, Lanes};
use crate::physics::vector::Vec2;

/// The accelerations of four particles: x and y of the first two, of the last two; about their centers, each before a zero, of
/// the first two, of the last two.
pub(super) type Pulls = ([Lanes; 2], [Lanes; 2]);

/// Where a drift takes its accelerations from.
pub(super) trait Pull {
    /// Whether the velocities still lack the second half of the last kick.
    const UNFINISHED: bool;
    /// The accelerations of the four particles of quad `quad` of `quads`.
    fn of(&mut self, quad: usize, quads: usize, inertia: impl Inertia) -> Pulls;
    /// The accelerations of the particles after the last whole quad.
    fn of_rest(&mut self, inertia: impl Inertia) -> Pulls;
}

/// The accelerations that the particles carry.
pub(super) struct Known<'a> {
    pub(super) accelerations: &'a [Vec2],
    pub(super) spin_rates: &'a [f64],
}

impl Pull for Known<'_> {
    const UNFINISHED: bool = false;

    #[inline(always)]
    fn of(&mut self, quad: usize, quads: usize, _inertia: impl Inertia) -> Pulls {
        known(&self.accelerations.as_chunks().0[..quads][quad], self.spin_rates.as_chunks().0[..quads][quad])
    }

    fn of_rest(&mut self, _inertia: impl Inertia) -> Pulls {
        known(&rest_of(self.accelerations), rest_of(self.spin_rates))
    }
}

#[inline(always)]
fn known(accelerations: &[Vec2; LANES], [a, b, c, d]: [f64; LANES]) -> Pulls {
    (two_by_two(accelerations), [before_zeros(a, b), before_zeros(c, d)])
}

/// Accelerations from the loads of the last force pass, which are taken: the next pass finds them empty.
pub(super) struct Fresh<'a> {
    pub(super) loads: &'a mut [Load],
    pub(super) gravity: Vec2,
}

impl Pull for Fresh<'_> {
    const UNFINISHED: bool = true;

    #[inline(always)]
    fn of(&mut self, quad: usize, quads: usize, inertia: impl Inertia) -> Pulls {
        let loads = &mut self.loads.as_chunks_mut().0[..quads];
        pulls(&std::mem::take(&mut loads[quad]), &inertia.of(quad, quads), self.gravity)
    }

    fn of_rest(&mut self, inertia: impl Inertia) -> Pulls {
        let taken = rest_of(self.loads);
        self.loads.as_chunks_mut::<LANES>().1.fill(Load::default());
        pulls(&taken, &inertia.of(0, 1), self.gravity)
    }
}

/// Accelerations from loads and gravity.
#[inline(always)]
fn pulls(loads: &[Load; LANES], constants: &QuadConstants, gravity: Vec2) -> Pulls {
    let gravity = Lanes::new([gravity.x, gravity.y, gravity.x, gravity.y]);
    let [[one, one_moments], [two, two_moments]] =
        [halves(loads[0].0, loads[1].0), halves(loads[2].0, loads[3].0)];
    let QuadConstants { inverse_masses, inverse_inertias, .. } = constants;
    (
        [one * inverse_masses[0] + gravity, two * inverse_masses[1] + gravity],
        [one_moments * inverse_inertias[0], two_moments * inverse_inertias[1]],
    )
}
