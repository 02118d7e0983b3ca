//! The drift, four particles at a time, and the sums that it makes on the way.

use super::constants::{Constants, Each, Inertia};
use super::pull::{Fresh, Known, Pull, Pulls};
use super::quad::{halves, put_rest};
use super::{Load, Motion};
use crate::lanes::{LANES, Lanes};
use crate::patch::{PATCH, PatchMotion};
use crate::threads::{CHUNK, Chunked};
use crate::vector::{Vec2, larger};

/// What is the same for all particles in one drift.
#[derive(Debug, Clone, Copy)]
pub(super) struct Setting<'a> {
    pub(super) constants: &'a Constants,
    pub(super) time_step: f64,
    /// The angle by which the drum turns [rad].
    pub(super) turn: f64,
    pub(super) gravity: Vec2,
}

/// The drift of whole chunks of particles.
#[derive(Debug)]
pub struct Drift<'a> {
    /// The first of the particles.
    pub(super) first: usize,
    /// By patch: the most that anyone does.
    pub(super) patches: &'a mut [PatchMotion],
    /// By chunk: Σ m x.
    pub(super) mass_moments: &'a mut [Vec2],
    pub(super) setting: Setting<'a>,
}

impl Drift<'_> {
    /// The first of the chunks.
    pub fn chunk(&self) -> usize {
        self.first / CHUNK
    }

    /// The same for a while.
    pub fn lend(&mut self) -> Drift<'_> {
        Drift {
            first: self.first,
            patches: self.patches,
            mass_moments: self.mass_moments,
            setting: self.setting,
        }
    }

    /// The second half of a kick by `loads`, which are taken, then the first half of the next one and the drift: one
    /// chunk.
    pub fn kick_and_run(self, motions: &mut [Motion], loads: &mut [Load]) {
        let gravity = self.setting.gravity;
        self.run(motions, Fresh { loads, gravity });
    }

    /// Half a kick with the accelerations that the particles carry, then the drift: one chunk.
    fn run_on(self, motions: &mut [Motion], (accelerations, spin_rates): (&[Vec2], &[f64])) {
        self.run(motions, Known { accelerations, spin_rates });
    }

    fn run(mut self, motions: &mut [Motion], mut pull: impl Pull) {
        let mut sums = QuadSums::new(self.setting.turn, self.setting.time_step);
        let each = self.setting.constants.of(self.first, motions.len());
        match self.setting.constants.same() {
            Some(same) => self.move_quads(motions, &mut pull, same, &mut sums),
            None => self.move_quads(motions, &mut pull, each, &mut sums),
        }
        if !motions.len().is_multiple_of(LANES) {
            each.with_rest(|each| self.move_rest(motions, &mut pull, each, &mut sums));
        }
        if let Some(chunk) = self.mass_moments.first_mut() {
            *chunk = sums.mass_moment();
        }
    }

    fn move_quads<P: Pull, I: Inertia>(
        &mut self,
        motions: &mut [Motion],
        pull: &mut P,
        inertia: I,
        sums: &mut QuadSums,
    ) {
        let quads = motions.len() / LANES;
        // Slices of one known length let the compiler drop the bounds checks.
        let motions = &mut motions.as_chunks_mut().0[..quads];
        for (patch, most) in self.patches.iter_mut().enumerate() {
            let first = patch * (PATCH / LANES);
            let of_patch = first..quads.min(first + PATCH / LANES);
            let motions = motions.get_mut(of_patch.clone()).unwrap_or_default();
            for (quad, four) in of_patch.zip(motions) {
                let pulls = pull.of(quad, quads, inertia);
                let positions = advance::<P>(four, pulls, self.setting.time_step, sums);
                sums.weigh::<I>(positions, inertia.of(quad, quads).masses);
            }
            *most = sums.take_most();
        }
        sums.end_weighing(inertia);
    }

    fn move_rest<P: Pull>(
        &mut self,
        motions: &mut [Motion],
        pull: &mut P,
        inertia: Each,
        sums: &mut QuadSums,
    ) {
        let pulls = pull.of_rest(inertia);
        let (_, rest) = motions.as_chunks_mut::<LANES>();
        let mut last = std::array::from_fn(|lane| rest[lane.min(rest.len() - 1)]);
        let positions = advance::<P>(&mut last, pulls, self.setting.time_step, sums);
        sums.weigh::<Each>(positions, inertia.of(0, 1).masses);
        put_rest(motions, &last);
        if let Some(most) = self.patches.last_mut() {
            *most = most.and(sums.take_most());
        }
    }
}

impl Chunked for Drift<'_> {
    fn chunks(&self) -> usize {
        self.mass_moments.len()
    }

    fn split(self, chunks: usize) -> (Self, Self) {
        let at = chunks * CHUNK;
        let (patches, more_patches) = self.patches.split_at_mut(at.div_ceil(PATCH));
        let (mass_moments, more_mass_moments) = self.mass_moments.split_at_mut(chunks);
        let (first, setting) = (self.first, self.setting);
        (
            Self { first, patches, mass_moments, setting },
            Self { first: first + at, patches: more_patches, mass_moments: more_mass_moments, setting },
        )
    }
}

/// The drift of whole chunks with the accelerations that their particles carry.
pub(super) struct Start<'a> {
    pub(super) drift: Drift<'a>,
    pub(super) motions: &'a mut [Motion],
    pub(super) accelerations: &'a [Vec2],
    pub(super) spin_rates: &'a [f64],
}

impl Start<'_> {
    /// Moves one chunk.
    pub(super) fn run(self) {
        self.drift.run_on(self.motions, (self.accelerations, self.spin_rates));
    }
}

impl Chunked for Start<'_> {
    fn chunks(&self) -> usize {
        self.drift.chunks()
    }

    fn split(self, chunks: usize) -> (Self, Self) {
        let at = chunks * CHUNK;
        let (drift, more_drift) = self.drift.split(chunks);
        let (motions, more_motions) = self.motions.split_at_mut(at);
        let (accelerations, more_accelerations) = self.accelerations.split_at(at);
        let (spin_rates, more_spin_rates) = self.spin_rates.split_at(at);
        (
            Self { drift, motions, accelerations, spin_rates },
            Self {
                drift: more_drift,
                motions: more_motions,
                accelerations: more_accelerations,
                spin_rates: more_spin_rates,
            },
        )
    }
}

/// Kicks and moves four particles. Returns where they come, as two rows.
#[inline(always)]
fn advance<P: Pull>(
    motions: &mut [Motion; LANES],
    (accelerations, spin_rates): Pulls,
    time_step: f64,
    sums: &mut QuadSums,
) -> [Lanes; 2] {
    let (step, half) = (Lanes::splat(time_step), Lanes::splat(0.5 * time_step));
    let to_angles = Lanes::new([0.0, time_step, 0.0, time_step]);
    let moved = [0, 1].map(|pair| {
        let [one, other] = [2 * pair, 2 * pair + 1];
        let (kick, twist) = (accelerations[pair] * half, spin_rates[pair] * half);
        let [before, mut velocities] = halves(motions[one].place, motions[other].place);
        let [_, mut spins] = halves(motions[one].pace, motions[other].pace);
        if P::UNFINISHED {
            velocities += kick;
            spins += twist;
        }
        velocities += kick;
        spins += twist;
        let displacements = velocities * step;
        let positions = before + displacements;
        // Angular velocities stay as they are, angles grow.
        let [a, _, b, _] = spins.to_array();
        spins += Lanes::new([a, a, b, b]) * to_angles;
        [motions[one].place, motions[other].place] = halves(positions, velocities);
        [motions[one].pace, motions[other].pace] = halves(velocities + kick, spins);
        (before, displacements, positions, kick)
    });
    sums.note(moved.map(|pair| pair.0), moved.map(|pair| pair.1));
    sums.note_kicks(moved.map(|pair| pair.3));
    moved.map(|pair| pair.2)
}

/// Sums over the quads of a chunk.
struct QuadSums {
    /// Σ m x and Σ m y of the particles with even, then with odd numbers.
    mass_moment: Lanes,
    /// The squares of the longest ways.
    longest_squared: Lanes,
    /// The squares of the greatest half kicks.
    greatest_squared: Lanes,
    /// The angle by which the drum turns, as the factors of y and x.
    turns: Lanes,
    time_step: f64,
}

impl QuadSums {
    fn new(turn: f64, time_step: f64) -> Self {
        let turns = Lanes::new([-turn, turn, -turn, turn]);
        let zero = Lanes::ZERO;
        Self { mass_moment: zero, longest_squared: zero, greatest_squared: zero, turns, time_step }
    }

    /// Takes note of the ways as seen from the drum.
    #[inline(always)]
    fn note(&mut self, positions: [Lanes; 2], displacements: [Lanes; 2]) {
        let ways = std::array::from_fn(|two| {
            let [a, b, c, d] = positions[two].to_array();
            displacements[two] - Lanes::new([b, a, d, c]) * self.turns
        });
        self.longest_squared = squared_lengths(ways).fast_max(self.longest_squared);
    }

    /// Takes note of half kicks.
    #[inline(always)]
    fn note_kicks(&mut self, kicks: [Lanes; 2]) {
        self.greatest_squared = squared_lengths(kicks).fast_max(self.greatest_squared);
    }

    /// Adds particles to Σ m x, which stays without m where it is the same for all.
    #[inline(always)]
    fn weigh<I: Inertia>(&mut self, positions: [Lanes; 2], masses: [Lanes; 2]) {
        for (positions, masses) in positions.into_iter().zip(masses) {
            self.mass_moment += if I::SAME { positions } else { positions * masses };
        }
    }

    /// Brings m in where it is the same for all.
    fn end_weighing<I: Inertia>(&mut self, inertia: I) {
        if I::SAME {
            self.mass_moment *= inertia.of(0, 1).masses[0];
        }
    }

    fn mass_moment(&self) -> Vec2 {
        let [x, y, more_x, more_y] = self.mass_moment.to_array();
        Vec2::new(x + more_x, y + more_y)
    }

    /// The most that anyone did since it was last taken.
    fn take_most(&mut self) -> PatchMotion {
        let most = |squares: &mut Lanes| {
            std::mem::replace(squares, Lanes::ZERO).to_array().into_iter().fold(0.0, larger).sqrt()
        };
        let kick = 2.0 * most(&mut self.greatest_squared);
        PatchMotion { way: most(&mut self.longest_squared), change: kick * self.time_step }
    }
}

/// The squared lengths of four vectors in two rows, in any order.
#[inline(always)]
fn squared_lengths(rows: [Lanes; 2]) -> Lanes {
    let [[a, b, c, d], [e, f, g, h]] = rows.map(|row| (row * row).to_array());
    // In the order in which CPUs add neighbors.
    Lanes::new([a, e, c, g]) + Lanes::new([b, f, d, h])
}
