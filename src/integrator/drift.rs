//! The drift, four particles at a time, and the sums that it makes on the way.

use std::f64::consts::SQRT_2;

use super::constants::Constants;
use super::pull::{Fresh, Known, Pull, Pulls};
use super::quad::{four_vectors, put_rest, rest_of, two_by_two};
use super::{Load, Motion};
use crate::cache::{ask_for, share_of};
use crate::lanes::{LANES, Lanes};
use crate::patch::{PATCH, PatchMotion};
use crate::threads::{CHUNK, Chunked, chunk_count};
use crate::vector::{Vec2, larger};

/// What a drift changes of particles, but for what contacts are told of them.
#[derive(Debug)]
pub struct Moved<'a> {
    /// Velocities [m/s].
    pub velocities: &'a mut [Vec2],
    /// Angles [rad].
    pub angles: &'a mut [f64],
    /// Angular velocities [rad/s].
    pub spins: &'a mut [f64],
}

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
    pub(super) moved: Moved<'a>,
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
        let Moved { velocities, angles, spins } = &mut self.moved;
        Drift {
            first: self.first,
            moved: Moved { velocities, angles, spins },
            patches: self.patches,
            mass_moments: self.mass_moments,
            setting: self.setting,
        }
    }

    /// Asks memory for a share of what one chunk moves.
    #[inline(always)]
    pub fn ask_for(&self, share: usize) {
        let count = self.moved.spins.len().min(CHUNK);
        ask_for(share_of(&self.moved.velocities[..count], share));
        ask_for(share_of(&self.moved.angles[..count], share));
        ask_for(share_of(&self.moved.spins[..count], share));
    }

    /// The second half of a kick by `loads`, which are taken, then the first half of the next one and the drift: one
    /// chunk.
    pub fn kick_and_run(self, motions: &mut [Motion], loads: &mut [Load]) {
        let constants = self.setting.constants.of(self.first, loads.len());
        let gravity = self.setting.gravity;
        self.run(motions, Fresh { loads, constants, gravity });
    }

    /// Half a kick with the accelerations that the particles carry, then the drift: one chunk.
    fn run_on(self, motions: &mut [Motion], (accelerations, spin_rates): (&[Vec2], &[f64])) {
        self.run(motions, Known { accelerations, spin_rates });
    }

    fn run(mut self, motions: &mut [Motion], mut pull: impl Pull) {
        let mut sums = QuadSums::new(self.setting.turn, self.setting.time_step);
        let masses = self.setting.constants.of(self.first, motions.len()).masses;
        self.move_quads(motions, &mut pull, masses, &mut sums);
        if !motions.len().is_multiple_of(LANES) {
            self.move_rest(motions, &mut pull, masses, &mut sums);
        }
        if let Some(chunk) = self.mass_moments.first_mut() {
            *chunk = sums.mass_moment();
        }
    }

    fn move_quads<P: Pull>(
        &mut self,
        motions: &mut [Motion],
        pull: &mut P,
        masses: &[f64],
        sums: &mut QuadSums,
    ) {
        let quads = motions.len() / LANES;
        // Slices of one known length let the compiler drop the bounds checks.
        let velocities = &mut self.moved.velocities.as_chunks_mut().0[..quads];
        let angles = &mut self.moved.angles.as_chunks_mut().0[..quads];
        let spins = &mut self.moved.spins.as_chunks_mut().0[..quads];
        let masses = &masses.as_chunks().0[..quads];
        let motions = &mut motions.as_chunks_mut().0[..quads];
        for (patch, most) in self.patches.iter_mut().enumerate() {
            let first = patch * (PATCH / LANES);
            for quad in first..quads.min(first + PATCH / LANES) {
                let pulls = pull.of(quad, quads);
                let mut four = Quad {
                    velocities: &mut velocities[quad],
                    angles: &mut angles[quad],
                    spins: &mut spins[quad],
                    motions: &mut motions[quad],
                };
                four.advance::<P>(pulls, self.setting.time_step, &masses[quad], sums);
            }
            *most = sums.take_most();
        }
    }

    fn move_rest<P: Pull>(
        &mut self,
        motions: &mut [Motion],
        pull: &mut P,
        masses: &[f64],
        sums: &mut QuadSums,
    ) {
        let pulls = pull.of_rest();
        let mut velocities = rest_of(self.moved.velocities);
        let mut angles = rest_of(self.moved.angles);
        let mut spins = rest_of(self.moved.spins);
        let (_, rest) = motions.as_chunks_mut::<LANES>();
        let mut last = std::array::from_fn(|lane| rest[lane.min(rest.len() - 1)]);
        let mut four =
            Quad { velocities: &mut velocities, angles: &mut angles, spins: &mut spins, motions: &mut last };
        four.advance::<P>(pulls, self.setting.time_step, &rest_of(masses), sums);
        put_rest(self.moved.velocities, &velocities);
        put_rest(self.moved.angles, &angles);
        put_rest(self.moved.spins, &spins);
        put_rest(motions, &last);
        if let Some(most) = self.patches.last_mut() {
            *most = most.and(sums.take_most());
        }
    }
}

impl Chunked for Drift<'_> {
    fn chunks(&self) -> usize {
        chunk_count(self.moved.spins.len())
    }

    fn split(self, chunks: usize) -> (Self, Self) {
        let at = chunks * CHUNK;
        let (velocities, more_velocities) = self.moved.velocities.split_at_mut(at);
        let (angles, more_angles) = self.moved.angles.split_at_mut(at);
        let (spins, more_spins) = self.moved.spins.split_at_mut(at);
        let (patches, more_patches) = self.patches.split_at_mut(at.div_ceil(PATCH));
        let (mass_moments, more_mass_moments) = self.mass_moments.split_at_mut(chunks);
        let (first, setting) = (self.first, self.setting);
        let moved = Moved { velocities, angles, spins };
        let more = Moved { velocities: more_velocities, angles: more_angles, spins: more_spins };
        (
            Self { first, moved, patches, mass_moments, setting },
            Self {
                first: first + at,
                moved: more,
                patches: more_patches,
                mass_moments: more_mass_moments,
                setting,
            },
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

/// Four particles.
struct Quad<'a> {
    velocities: &'a mut [Vec2; LANES],
    angles: &'a mut [f64; LANES],
    spins: &'a mut [f64; LANES],
    motions: &'a mut [Motion; LANES],
}

impl Quad<'_> {
    /// Kicks and moves them.
    #[inline(always)]
    fn advance<P: Pull>(
        &mut self,
        (accelerations, spin_rates): Pulls,
        time_step: f64,
        masses: &[f64; LANES],
        sums: &mut QuadSums,
    ) {
        let (step, half) = (Lanes::splat(time_step), Lanes::splat(0.5 * time_step));
        let (kicks, twists) = (accelerations.map(|a| a * half), spin_rates * half);
        sums.note_kicks(kicks);
        let mut velocities = two_by_two(self.velocities);
        let mut spins = Lanes::new(*self.spins);
        if P::UNFINISHED {
            velocities = [velocities[0] + kicks[0], velocities[1] + kicks[1]];
            spins += twists;
        }
        velocities = [velocities[0] + kicks[0], velocities[1] + kicks[1]];
        spins += twists;
        *self.velocities = four_vectors(velocities);
        *self.spins = spins.to_array();
        let displacements = velocities.map(|velocity| velocity * step);
        let before = two_by_two(&self.motions.map(|motion| motion.position()));
        let positions = [before[0] + displacements[0], before[1] + displacements[1]];
        sums.note(before, displacements);
        sums.weigh(positions, masses);
        let turns = spins * step;
        *self.angles = (Lanes::new(*self.angles) + turns).to_array();

        let foretold = [velocities[0] + kicks[0], velocities[1] + kicks[1]].map(Lanes::to_array);
        let (places, ways) = (positions.map(Lanes::to_array), displacements.map(Lanes::to_array));
        let turns = turns.to_array();
        for (lane, motion) in self.motions.iter_mut().enumerate() {
            let (two, x) = (lane / 2, 2 * (lane % 2));
            motion.place = Lanes::new([places[two][x], places[two][x + 1], ways[two][x], ways[two][x + 1]]);
            let radius = motion.radius();
            motion.pace = Lanes::new([foretold[two][x], foretold[two][x + 1], turns[lane], radius]);
        }
    }
}

/// Sums over the quads of a chunk.
struct QuadSums {
    /// Σ m x and Σ m y of the particles with even, then with odd numbers.
    mass_moment: Lanes,
    /// The squares of the longest ways.
    longest_squared: Lanes,
    /// The greatest x or y of half a kick.
    greatest_kick: Lanes,
    /// The angle by which the drum turns, as the factors of y and x.
    turns: Lanes,
    time_step: f64,
}

impl QuadSums {
    fn new(turn: f64, time_step: f64) -> Self {
        let turns = Lanes::new([-turn, turn, -turn, turn]);
        let zero = Lanes::ZERO;
        Self { mass_moment: zero, longest_squared: zero, greatest_kick: zero, turns, time_step }
    }

    /// Takes note of the ways as seen from the drum.
    #[inline(always)]
    fn note(&mut self, positions: [Lanes; 2], displacements: [Lanes; 2]) {
        let squares = std::array::from_fn::<_, 2, _>(|two| {
            let [a, b, c, d] = positions[two].to_array();
            let way = displacements[two] - Lanes::new([b, a, d, c]) * self.turns;
            (way * way).to_array()
        });
        // In the order in which sums of neighbors come.
        let lengths = Lanes::new([squares[0][0], squares[1][0], squares[0][2], squares[1][2]])
            + Lanes::new([squares[0][1], squares[1][1], squares[0][3], squares[1][3]]);
        self.longest_squared = lengths.fast_max(self.longest_squared);
    }

    #[inline(always)]
    fn weigh(&mut self, positions: [Lanes; 2], masses: &[f64; LANES]) {
        let [a, b, c, d] = *masses;
        self.mass_moment += positions[0] * Lanes::new([a, a, b, b]);
        self.mass_moment += positions[1] * Lanes::new([c, c, d, d]);
    }

    fn mass_moment(&self) -> Vec2 {
        let [x, y, more_x, more_y] = self.mass_moment.to_array();
        Vec2::new(x + more_x, y + more_y)
    }

    #[inline(always)]
    fn note_kicks(&mut self, kicks: [Lanes; 2]) {
        let kick = kicks[0].abs().fast_max(self.greatest_kick);
        self.greatest_kick = kicks[1].abs().fast_max(kick);
    }

    /// The most that anyone did since it was last taken.
    fn take_most(&mut self) -> PatchMotion {
        let most = |lanes: &mut Lanes| {
            std::mem::replace(lanes, Lanes::ZERO).to_array().into_iter().fold(0.0, larger)
        };
        // Two half kicks, of which x and y are known to be no greater.
        let kick = 2.0 * SQRT_2 * most(&mut self.greatest_kick);
        PatchMotion { way: most(&mut self.longest_squared).sqrt(), change: kick * self.time_step }
    }
}
