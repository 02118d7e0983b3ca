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
    [a, b, c, d]: &mut [Motion; LANES],
    (accelerations, spin_rates): Pulls,
    time_step: f64,
    sums: &mut QuadSums,
) -> [Lanes; 2] {
    let one = advance_two::<P>([a, b], (accelerations[0], spin_rates[0]), time_step, sums);
    let other = advance_two::<P>([c, d], (accelerations[1], spin_rates[1]), time_step, sums);
    [one, other]
}

#[inline(always)]
fn advance_two<P: Pull>(
    [one, other]: [&mut Motion; 2],
    (acceleration, spin_rate): (Lanes, Lanes),
    time_step: f64,
    sums: &mut QuadSums,
) -> Lanes {
    let half = 0.5 * time_step;
    let (kick, twist) = (acceleration * half, spin_rate * half);
    let [before, mut velocity] = halves(one.place, other.place);
    let [_, mut spin] = halves(one.pace, other.pace);
    if P::UNFINISHED {
        velocity += kick;
        spin += twist;
    }
    velocity += kick;
    spin += twist;
    // Angular velocities stay as they are, angles grow.
    let [a, _, b, _] = spin.to_array();
    spin += Lanes::new([a, a, b, b]) * Lanes::new([0.0, time_step, 0.0, time_step]);
    [one.pace, other.pace] = halves(velocity + kick, spin);
    let way = velocity * time_step;
    let position = before + way;
    [one.place, other.place] = halves(position, velocity);
    sums.note(before, way, kick);
    position
}

/// Sums over the quads of a chunk.
struct QuadSums {
    /// Σ m x and Σ m y of the particles with even, then with odd numbers.
    mass_moment: Lanes,
    /// The squares of the longest way and the greatest half kick, of the particles with even, then with odd numbers.
    most_squared: Lanes,
    /// The angle by which the drum turns, as the factors of y and x.
    turns: Lanes,
    time_step: f64,
}

impl QuadSums {
    fn new(turn: f64, time_step: f64) -> Self {
        let turns = Lanes::new([-turn, turn, -turn, turn]);
        let zero = Lanes::ZERO;
        Self { mass_moment: zero, most_squared: zero, turns, time_step }
    }

    /// Takes note of the ways of two particles, as seen from the drum, and of half kicks.
    #[inline(always)]
    fn note(&mut self, before: Lanes, way: Lanes, kick: Lanes) {
        let [a, b, c, d] = before.to_array();
        let seen = way - Lanes::new([b, a, d, c]) * self.turns;
        let ([a, b, c, d], [e, f, g, h]) = ((seen * seen).to_array(), (kick * kick).to_array());
        // In the order in which CPUs add neighbors.
        let squares = Lanes::new([a, e, c, g]) + Lanes::new([b, f, d, h]);
        self.most_squared = squares.fast_max(self.most_squared);
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
        let [way, kick, other_way, other_kick] =
            std::mem::replace(&mut self.most_squared, Lanes::ZERO).to_array();
        let change = 2.0 * larger(kick, other_kick).sqrt() * self.time_step;
        PatchMotion { way: larger(way, other_way).sqrt(), change }
    }
}
