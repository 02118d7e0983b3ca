//! The drift, four particles at a time, and the sums that it makes on the way.

use super::constants::{Constants, Each, Inertia};
use super::pull::{Fresh, Known, Pull, Pulls};
use super::quad::{halves, put_rest};
use super::{Load, Motion};
use crate::lanes::{LANES, Lanes};
use crate::patch::{PATCH, PatchMotion};
use crate::physics::vector::{Vec2, larger};
use crate::threads::{CHUNK, Chunked};

/// What is the same for all particles in one drift.
#[derive(Debug, Clone, Copy)]
pub(super) struct Setting<'a> {
    pub(super) constants: &'a Constants,
    pub(super) time_step: f64,
    pub(super) gravity: Vec2,
    pub(super) ways: Ways<'a>,
}

/// How the longest ways are known.
#[derive(Debug, Clone, Copy)]
pub(super) enum Ways<'a> {
    /// Measured, while the drum turns by so much [rad].
    Measured { turn: f64 },
    /// No longer than they were by patch, and the greatest change of a displacement, and `more` [m].
    Bounded { before: &'a [PatchMotion], more: f64 },
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

    fn run(self, motions: &mut [Motion], pull: impl Pull) {
        match self.setting.ways {
            Ways::Measured { .. } => self.run_with::<true>(motions, pull),
            Ways::Bounded { .. } => self.run_with::<false>(motions, pull),
        }
    }

    fn run_with<const MEASURES: bool>(mut self, motions: &mut [Motion], mut pull: impl Pull) {
        let mut sums = QuadSums::new(&self.setting);
        let each = self.setting.constants.of(self.first, motions.len());
        match self.setting.constants.same() {
            Some(same) => self.move_quads::<_, _, MEASURES>(motions, &mut pull, same, &mut sums),
            None => self.move_quads::<_, _, MEASURES>(motions, &mut pull, each, &mut sums),
        }
        if !motions.len().is_multiple_of(LANES) {
            each.with_rest(|each| self.move_rest::<_, MEASURES>(motions, &mut pull, each, &mut sums));
        }
        if let Some(chunk) = self.mass_moments.first_mut() {
            *chunk = sums.mass_moment();
        }
    }

    fn move_quads<P: Pull, I: Inertia, const MEASURES: bool>(
        &mut self,
        motions: &mut [Motion],
        pull: &mut P,
        inertia: I,
        sums: &mut QuadSums,
    ) {
        let quads = motions.len() / LANES;
        // Slices of one known length let the compiler drop the bounds checks.
        let motions = &mut motions.as_chunks_mut().0[..quads];
        let (own, ways) = (self.first / PATCH, self.setting.ways);
        for (patch, most) in self.patches.iter_mut().enumerate() {
            let first = patch * (PATCH / LANES);
            let of_patch = first..quads.min(first + PATCH / LANES);
            let motions = motions.get_mut(of_patch.clone()).unwrap_or_default();
            for (quad, four) in of_patch.zip(motions) {
                let pulls = pull.of(quad, quads, inertia);
                let positions = advance::<P, MEASURES>(four, pulls, self.setting.time_step, sums);
                sums.weigh::<I>(positions, inertia.of(quad, quads).masses);
            }
            *most = sums.take_most(ways, own + patch);
        }
        sums.end_weighing(inertia);
    }

    fn move_rest<P: Pull, const MEASURES: bool>(
        &mut self,
        motions: &mut [Motion],
        pull: &mut P,
        inertia: Each,
        sums: &mut QuadSums,
    ) {
        let pulls = pull.of_rest(inertia);
        let (_, rest) = motions.as_chunks_mut::<LANES>();
        let mut last = std::array::from_fn(|lane| rest[lane.min(rest.len() - 1)]);
        let positions = advance::<P, MEASURES>(&mut last, pulls, self.setting.time_step, sums);
        sums.weigh::<Each>(positions, inertia.of(0, 1).masses);
        put_rest(motions, &last);
        let last = self.first / PATCH + self.patches.len() - 1;
        if let Some(most) = self.patches.last_mut() {
            *most = most.and(sums.take_most(self.setting.ways, last));
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
fn advance<P: Pull, const MEASURES: bool>(
    [a, b, c, d]: &mut [Motion; LANES],
    (accelerations, spin_rates): Pulls,
    time_step: f64,
    sums: &mut QuadSums,
) -> [Lanes; 2] {
    let one = advance_two::<P>([a, b], (accelerations[0], spin_rates[0]), time_step);
    if MEASURES {
        sums.note(one.seen_way(sums.turns), one.kick);
    }
    let other = advance_two::<P>([c, d], (accelerations[1], spin_rates[1]), time_step);
    if MEASURES {
        sums.note(other.seen_way(sums.turns), other.kick);
    } else {
        sums.note(one.kick, other.kick);
    }
    [one.position, other.position]
}

/// What two particles did, as rows of x and y.
struct Moved {
    before: Lanes,
    way: Lanes,
    position: Lanes,
    /// Half a kick.
    kick: Lanes,
}

impl Moved {
    /// The ways as seen from the drum, which turns by the factors of y and x.
    #[inline(always)]
    fn seen_way(&self, turns: Lanes) -> Lanes {
        let [a, b, c, d] = self.before.to_array();
        self.way - Lanes::new([b, a, d, c]) * turns
    }
}

/// Kicks and moves two particles.
#[inline(always)]
fn advance_two<P: Pull>(
    [one, other]: [&mut Motion; 2],
    (acceleration, spin_rate): (Lanes, Lanes),
    time_step: f64,
) -> Moved {
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
    Moved { before, way, position, kick }
}

/// Sums over the quads of a chunk.
struct QuadSums {
    /// Σ m x and Σ m y of the particles with even, then with odd numbers.
    mass_moment: Lanes,
    /// The squares of the greatest lengths noted, which alternate: of one row and of the other.
    most_squared: Lanes,
    /// The angle by which the drum turns, as the factors of y and x.
    turns: Lanes,
    time_step: f64,
}

impl QuadSums {
    fn new(setting: &Setting) -> Self {
        let turn = if let Ways::Measured { turn } = setting.ways { turn } else { 0.0 };
        let (turns, zero) = (Lanes::new([-turn, turn, -turn, turn]), Lanes::ZERO);
        Self { mass_moment: zero, most_squared: zero, turns, time_step: setting.time_step }
    }

    /// Takes note of the lengths of vectors, two in each row: ways and half kicks, or half kicks alone.
    #[inline(always)]
    fn note(&mut self, one: Lanes, other: Lanes) {
        let ([a, b, c, d], [e, f, g, h]) = ((one * one).to_array(), (other * other).to_array());
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

    /// The most that anyone of patch `patch` did since this was last taken.
    fn take_most(&mut self, ways: Ways, patch: usize) -> PatchMotion {
        let [a, b, c, d] = std::mem::replace(&mut self.most_squared, Lanes::ZERO).to_array();
        let (one, other) = (larger(a, c).sqrt(), larger(b, d).sqrt());
        match ways {
            Ways::Measured { .. } => PatchMotion { way: one, change: 2.0 * other * self.time_step },
            Ways::Bounded { before, more } => {
                let change = 2.0 * larger(one, other) * self.time_step;
                PatchMotion { way: before[patch].way + change + more, change }
            }
        }
    }
}
