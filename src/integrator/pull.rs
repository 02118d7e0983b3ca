//! Where a drift takes the accelerations from: what the particles carry, or the loads of the last pass.

use super::Load;
use super::constants::ConstantsOf;
use super::quad::{rest_of, two_by_two};
use crate::lanes::{LANES, Lanes};
use crate::vector::Vec2;

/// The accelerations of four particles: x and y of the first two, of the last two, and about their centers.
pub(super) type Pulls = ([Lanes; 2], Lanes);

/// Where a drift takes its accelerations from.
pub(super) trait Pull {
    /// Whether the velocities still lack the second half of the last kick.
    const UNFINISHED: bool;
    /// The accelerations of the four particles of quad `quad` of `quads`.
    fn of(&mut self, quad: usize, quads: usize) -> Pulls;
    /// The accelerations of the particles after the last whole quad.
    fn of_rest(&mut self) -> Pulls;
}

/// The accelerations that the particles carry.
pub(super) struct Known<'a> {
    pub(super) accelerations: &'a [Vec2],
    pub(super) spin_rates: &'a [f64],
}

impl Pull for Known<'_> {
    const UNFINISHED: bool = false;

    #[inline(always)]
    fn of(&mut self, quad: usize, quads: usize) -> Pulls {
        let accelerations = &self.accelerations.as_chunks().0[..quads];
        let spin_rates = &self.spin_rates.as_chunks().0[..quads];
        (two_by_two(&accelerations[quad]), Lanes::new(spin_rates[quad]))
    }

    fn of_rest(&mut self) -> Pulls {
        (two_by_two(&rest_of(self.accelerations)), Lanes::new(rest_of(self.spin_rates)))
    }
}

/// Accelerations from the loads of the last force pass, which are taken: the next pass finds them empty.
pub(super) struct Fresh<'a> {
    pub(super) loads: &'a mut [Load],
    pub(super) constants: ConstantsOf<'a>,
    pub(super) gravity: Vec2,
}

impl Pull for Fresh<'_> {
    const UNFINISHED: bool = true;

    #[inline(always)]
    fn of(&mut self, quad: usize, quads: usize) -> Pulls {
        let loads = &mut self.loads.as_chunks_mut().0[..quads];
        let inverse_masses = &self.constants.inverse_masses.as_chunks().0[..quads];
        let inverse_inertias = &self.constants.inverse_inertias.as_chunks().0[..quads];
        let taken = std::mem::take(&mut loads[quad]);
        pulls(&taken, &inverse_masses[quad], &inverse_inertias[quad], self.gravity)
    }

    fn of_rest(&mut self) -> Pulls {
        let taken = rest_of(self.loads);
        self.loads.as_chunks_mut::<LANES>().1.fill(Load::default());
        let (masses, inertias) = (self.constants.inverse_masses, self.constants.inverse_inertias);
        pulls(&taken, &rest_of(masses), &rest_of(inertias), self.gravity)
    }
}

/// Accelerations from loads and gravity.
#[inline(always)]
fn pulls(
    loads: &[Load; LANES],
    inverse_masses: &[f64; LANES],
    inverse_inertias: &[f64; LANES],
    gravity: Vec2,
) -> Pulls {
    let gravity = Lanes::new([gravity.x, gravity.y, gravity.x, gravity.y]);
    let rows = loads.map(|load| load.0.to_array());
    let two = |i: usize| {
        let forces = Lanes::new([rows[i][0], rows[i][1], rows[i + 1][0], rows[i + 1][1]]);
        let masses = [inverse_masses[i], inverse_masses[i], inverse_masses[i + 1], inverse_masses[i + 1]];
        forces * Lanes::new(masses) + gravity
    };
    let moments = Lanes::new([rows[0][2], rows[1][2], rows[2][2], rows[3][2]]);
    ([two(0), two(2)], moments * Lanes::new(*inverse_inertias))
}
