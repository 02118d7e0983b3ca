//! The drift, four particles at a time, and the sums that it makes on the way.

use super::Motion;
use super::pull::{Pull, Pulls};
use super::quad::{four_vectors, put_rest, rest_of, two_by_two};
use crate::lanes::{LANES, Lanes};
use crate::threads::{CHUNK, Chunked, PATCH};
use crate::vector::{Vec2, larger};

/// What a drift changes.
pub(super) struct Moved<'a> {
    pub(super) positions: &'a mut [Vec2],
    pub(super) velocities: &'a mut [Vec2],
    pub(super) angles: &'a mut [f64],
    pub(super) spins: &'a mut [f64],
}

impl Moved<'_> {
    fn split(self, at: usize) -> (Self, Self) {
        let (positions, more_positions) = self.positions.split_at_mut(at);
        let (velocities, more_velocities) = self.velocities.split_at_mut(at);
        let (angles, more_angles) = self.angles.split_at_mut(at);
        let (spins, more_spins) = self.spins.split_at_mut(at);
        (
            Self { positions, velocities, angles, spins },
            Self {
                positions: more_positions,
                velocities: more_velocities,
                angles: more_angles,
                spins: more_spins,
            },
        )
    }
}

pub(super) struct Drift<'a, P> {
    pub(super) pull: P,
    pub(super) moved: Moved<'a>,
    pub(super) masses: &'a [f64],
    pub(super) motions: &'a mut [Motion],
    /// By chunk: Σ m x.
    pub(super) sums: &'a mut [Vec2],
    /// By patch: the square of the longest way.
    pub(super) ways: &'a mut [f64],
}

impl<P: Pull> Drift<'_, P> {
    pub(super) fn run(mut self, time_step: f64, turn: f64) {
        let mut sums = QuadSums::new(turn);
        self.move_quads(time_step, &mut sums);
        if !self.motions.len().is_multiple_of(LANES) {
            self.move_rest(time_step, &mut sums);
        }
        if let Some(chunk) = self.sums.first_mut() {
            *chunk = sums.mass_moment();
        }
    }

    fn move_quads(&mut self, time_step: f64, sums: &mut QuadSums) {
        let quads = self.motions.len() / LANES;
        // Slices of one known length let the compiler drop the bounds checks.
        let positions = &mut self.moved.positions.as_chunks_mut().0[..quads];
        let velocities = &mut self.moved.velocities.as_chunks_mut().0[..quads];
        let angles = &mut self.moved.angles.as_chunks_mut().0[..quads];
        let spins = &mut self.moved.spins.as_chunks_mut().0[..quads];
        let masses = &self.masses.as_chunks().0[..quads];
        let motions = &mut self.motions.as_chunks_mut().0[..quads];
        for (patch, way) in self.ways.iter_mut().enumerate() {
            let first = patch * (PATCH / LANES);
            for quad in first..quads.min(first + PATCH / LANES) {
                let pulls = self.pull.of(quad, quads);
                let mut four = Quad {
                    positions: &mut positions[quad],
                    velocities: &mut velocities[quad],
                    angles: &mut angles[quad],
                    spins: &mut spins[quad],
                };
                four.advance::<P>(pulls, time_step, (&masses[quad], sums), &mut motions[quad]);
            }
            *way = sums.take_longest();
        }
    }

    fn move_rest(&mut self, time_step: f64, sums: &mut QuadSums) {
        let pulls = self.pull.of_rest();
        let mut positions = rest_of(self.moved.positions);
        let mut velocities = rest_of(self.moved.velocities);
        let mut angles = rest_of(self.moved.angles);
        let mut spins = rest_of(self.moved.spins);
        let (_, rest) = self.motions.as_chunks_mut::<LANES>();
        let mut motions = std::array::from_fn(|lane| rest[lane.min(rest.len() - 1)]);
        let mut four = Quad {
            positions: &mut positions,
            velocities: &mut velocities,
            angles: &mut angles,
            spins: &mut spins,
        };
        four.advance::<P>(pulls, time_step, (&rest_of(self.masses), sums), &mut motions);
        put_rest(self.moved.positions, &positions);
        put_rest(self.moved.velocities, &velocities);
        put_rest(self.moved.angles, &angles);
        put_rest(self.moved.spins, &spins);
        put_rest(self.motions, &motions);
        if let Some(way) = self.ways.last_mut() {
            *way = larger(*way, sums.take_longest());
        }
    }
}

/// Four particles.
struct Quad<'a> {
    positions: &'a mut [Vec2; LANES],
    velocities: &'a mut [Vec2; LANES],
    angles: &'a mut [f64; LANES],
    spins: &'a mut [f64; LANES],
}

impl Quad<'_> {
    /// Kicks and moves them.
    #[inline(always)]
    fn advance<P: Pull>(
        &mut self,
        (accelerations, spin_rates): Pulls,
        time_step: f64,
        (masses, sums): (&[f64; LANES], &mut QuadSums),
        motions: &mut [Motion; LANES],
    ) {
        let (step, half) = (Lanes::splat(time_step), Lanes::splat(0.5 * time_step));
        let (kicks, twists) = (accelerations.map(|a| a * half), spin_rates * half);
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
        let before = two_by_two(self.positions);
        let positions = [before[0] + displacements[0], before[1] + displacements[1]];
        *self.positions = four_vectors(positions);
        sums.note(before, displacements);
        sums.weigh(positions, masses);
        let turns = spins * step;
        *self.angles = (Lanes::new(*self.angles) + turns).to_array();

        let foretold = [velocities[0] + kicks[0], velocities[1] + kicks[1]].map(Lanes::to_array);
        let (places, ways) = (positions.map(Lanes::to_array), displacements.map(Lanes::to_array));
        let turns = turns.to_array();
        for (lane, motion) in motions.iter_mut().enumerate() {
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
    /// The angle by which the drum turns, as the factors of y and x.
    turns: Lanes,
}

impl QuadSums {
    fn new(turn: f64) -> Self {
        let turns = Lanes::new([-turn, turn, -turn, turn]);
        Self { mass_moment: Lanes::ZERO, longest_squared: Lanes::ZERO, turns }
    }

    /// Takes note of the ways as seen from the drum.
    #[inline(always)]
    fn note(&mut self, positions: [Lanes; 2], displacements: [Lanes; 2]) {
        let squares = std::array::from_fn::<_, 2, _>(|two| {
            let [a, b, c, d] = positions[two].to_array();
            let way = displacements[two] - Lanes::new([b, a, d, c]) * self.turns;
            (way * way).to_array()
        });
        let lengths = Lanes::new([squares[0][0], squares[0][2], squares[1][0], squares[1][2]])
            + Lanes::new([squares[0][1], squares[0][3], squares[1][1], squares[1][3]]);
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

    /// The square of the longest way since it was last taken.
    fn take_longest(&mut self) -> f64 {
        std::mem::replace(&mut self.longest_squared, Lanes::ZERO).to_array().into_iter().fold(0.0, larger)
    }
}

impl<P: Pull> Chunked for Drift<'_, P> {
    fn chunks(&self) -> usize {
        self.sums.len()
    }

    fn split(self, chunks: usize) -> (Self, Self) {
        let at = chunks * CHUNK;
        let (pull, more_pull) = self.pull.split(at);
        let (moved, more_moved) = self.moved.split(at);
        let (masses, more_masses) = self.masses.split_at(at);
        let (motions, more_motions) = self.motions.split_at_mut(at);
        let (sums, more_sums) = self.sums.split_at_mut(chunks);
        let (ways, more_ways) = self.ways.split_at_mut(at / PATCH);
        (
            Self { pull, moved, masses, motions, sums, ways },
            Self {
                pull: more_pull,
                moved: more_moved,
                masses: more_masses,
                motions: more_motions,
                sums: more_sums,
                ways: more_ways,
            },
        )
    }
}
