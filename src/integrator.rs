//! Kick, drift, kick: velocity Verlet for centers and spins.
//!
//! Between the kicks a particle moves with its half-step velocity; contacts are told that displacement. The velocity at
//! the end of the step, which the dashpots need before the force is known, is foretold with the last acceleration.

use crate::lanes::{LANES, Lanes};
use crate::particles::Particles;
use crate::threads::{CHUNK, Chunked, Threads, chunk_count};
use crate::vector::{Vec2, larger};

/// What contacts need of a particle in one step, as two rows that load at once; one cache line.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C, align(64))]
pub struct Motion {
    /// Center at the end of the step [m], x and y; how it got there [m], x and y.
    pub place: Lanes,
    /// Velocity foretold for the end of the step [m/s], x and y; angle turned during the step [rad]; radius [m].
    pub pace: Lanes,
}

impl Motion {
    /// Center at the end of the step [m].
    #[inline(always)]
    pub fn position(&self) -> Vec2 {
        let [x, y, _, _] = self.place.to_array();
        Vec2::new(x, y)
    }

    /// Radius [m].
    #[inline(always)]
    pub fn radius(&self) -> f64 {
        self.pace.to_array()[3]
    }
}

/// Sums over particles at the end of the drift.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DriftSums {
    /// Σ m x [kg].
    pub mass_moment: Vec2,
    /// Longest way of a particle in this step as seen from the drum [m].
    pub longest_way: f64,
}

/// Force of all contacts on a particle [N/m], x and y, and their moment about its center [N m/m]; the fourth number means
/// nothing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Load(pub Lanes);

impl Default for Load {
    fn default() -> Self {
        Self(Lanes::ZERO)
    }
}

impl Load {
    /// Force [N/m].
    #[inline(always)]
    pub fn force(&self) -> Vec2 {
        let [x, y, _, _] = self.0.to_array();
        Vec2::new(x, y)
    }

    /// Moment about the center [N m/m].
    #[inline(always)]
    pub fn moment(&self) -> f64 {
        self.0.to_array()[2]
    }
}

/// Scratch of the integrator; nothing in it outlives a step but what follows from the particles' constants.
#[derive(Debug, Clone)]
pub struct Integrator {
    /// What the contacts are told, by particle.
    pub motions: Vec<Motion>,
    /// 1/m [m/kg], by particle.
    inverse_masses: Vec<f64>,
    /// 1/I, 0 where the spin is locked.
    inverse_inertias: Vec<f64>,
    /// Per chunk: Σ m x and the square of the longest way.
    chunks: Vec<(Vec2, f64)>,
    time_step: f64,
    gravity: Vec2,
}

impl Integrator {
    /// For these particles at rest in time: the motions say where they are and how fast, with no displacement.
    pub fn new(particles: &Particles, time_step: f64, gravity: Vec2) -> Self {
        let still = |i: usize| {
            let (position, velocity) = (particles.positions[i], particles.velocities[i]);
            Motion {
                place: Lanes::new([position.x, position.y, 0.0, 0.0]),
                pace: Lanes::new([velocity.x, velocity.y, 0.0, particles.radii[i]]),
            }
        };
        let inverse = |value: &f64| if *value > 0.0 { 1.0 / value } else { 0.0 };
        Self {
            motions: (0..particles.len()).map(still).collect(),
            inverse_masses: particles.masses.iter().map(inverse).collect(),
            inverse_inertias: particles.inertias.iter().map(inverse).collect(),
            chunks: vec![(Vec2::zeros(), 0.0); chunk_count(particles.len())],
            time_step,
            gravity,
        }
    }

    /// Half a kick with the known accelerations, then the drift, while the drum turns by `turn` [rad].
    pub fn drift(&mut self, particles: &mut Particles, turn: f64, threads: &Threads) -> DriftSums {
        let known =
            Known { accelerations: &particles.accelerations, spin_rates: &particles.angular_accelerations };
        let moved = Moved {
            positions: &mut particles.positions,
            velocities: &mut particles.velocities,
            angles: &mut particles.angles,
            spins: &mut particles.angular_velocities,
        };
        let (time_step, masses) = (self.time_step, &particles.masses);
        let work = Drift { pull: known, moved, masses, motions: &mut self.motions, sums: &mut self.chunks };
        threads.for_each_chunk(masses.len(), work, &|chunk: Drift<Known>| chunk.run(time_step, turn));
        self.sum()
    }

    /// The second half of a kick and a `drift` in one pass over the particles, for steps between which nobody looks:
    /// the same operations, but accelerations are not kept.
    pub fn kick_and_drift(
        &mut self,
        particles: &mut Particles,
        loads: &mut [Load],
        turn: f64,
        threads: &Threads,
    ) -> DriftSums {
        let fresh = Fresh {
            loads,
            inverse_masses: &self.inverse_masses,
            inverse_inertias: &self.inverse_inertias,
            gravity: self.gravity,
        };
        let moved = Moved {
            positions: &mut particles.positions,
            velocities: &mut particles.velocities,
            angles: &mut particles.angles,
            spins: &mut particles.angular_velocities,
        };
        let (time_step, masses) = (self.time_step, &particles.masses);
        let work = Drift { pull: fresh, moved, masses, motions: &mut self.motions, sums: &mut self.chunks };
        threads.for_each_chunk(masses.len(), work, &|chunk: Drift<Fresh>| chunk.run(time_step, turn));
        self.sum()
    }

    fn sum(&self) -> DriftSums {
        let start = (Vec2::zeros(), 0.0_f64);
        let (mass_moment, longest_squared) =
            self.chunks.iter().fold(start, |sum, chunk| (sum.0 + chunk.0, sum.1.max(chunk.1)));
        DriftSums { mass_moment, longest_way: longest_squared.sqrt() }
    }

    /// Accelerations from the loads and gravity, then the second half of the kick.
    pub fn kick(&self, particles: &mut Particles, loads: &[Load], threads: &Threads) {
        let count = particles.len();
        let (half_step, gravity) = (0.5 * self.time_step, self.gravity);
        let work = Kick {
            velocities: &mut particles.velocities,
            spins: &mut particles.angular_velocities,
            accelerations: &mut particles.accelerations,
            spin_rates: &mut particles.angular_accelerations,
            loads,
            inverse_masses: &self.inverse_masses,
            inverse_inertias: &self.inverse_inertias,
        };
        threads.for_each_chunk(count, work, &|chunk: Kick| chunk.run(half_step, gravity));
    }

    /// Accelerations from the loads and gravity alone: the start of a simulation, before the first kick.
    pub fn accelerate(&self, particles: &mut Particles, loads: &[Load]) {
        for (i, load) in loads.iter().enumerate() {
            particles.accelerations[i] = load.force() * self.inverse_masses[i] + self.gravity;
            particles.angular_accelerations[i] = load.moment() * self.inverse_inertias[i];
        }
    }
}

/// The accelerations of four particles: x and y of the first two, of the last two, and about their centers.
type Pulls = ([Lanes; 2], Lanes);

/// Where a drift takes its accelerations from.
trait Pull: Send + Sized {
    /// Whether the velocities still lack the second half of the last kick.
    const UNFINISHED: bool;
    /// The accelerations of the four particles of quad `quad` of `quads`.
    fn of(&mut self, quad: usize, quads: usize) -> Pulls;
    /// The accelerations of the particles after the last whole quad.
    fn of_rest(&mut self) -> Pulls;
    fn split(self, at: usize) -> (Self, Self);
}

/// The accelerations that the particles carry.
struct Known<'a> {
    accelerations: &'a [Vec2],
    spin_rates: &'a [f64],
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

    fn split(self, at: usize) -> (Self, Self) {
        let (accelerations, more_accelerations) = self.accelerations.split_at(at);
        let (spin_rates, more_spin_rates) = self.spin_rates.split_at(at);
        (
            Self { accelerations, spin_rates },
            Self { accelerations: more_accelerations, spin_rates: more_spin_rates },
        )
    }
}

/// Accelerations from the loads of the last force pass, which are taken: the next pass finds them empty.
struct Fresh<'a> {
    loads: &'a mut [Load],
    inverse_masses: &'a [f64],
    inverse_inertias: &'a [f64],
    gravity: Vec2,
}

impl Pull for Fresh<'_> {
    const UNFINISHED: bool = true;

    #[inline(always)]
    fn of(&mut self, quad: usize, quads: usize) -> Pulls {
        let loads = &mut self.loads.as_chunks_mut().0[..quads];
        let inverse_masses = &self.inverse_masses.as_chunks().0[..quads];
        let inverse_inertias = &self.inverse_inertias.as_chunks().0[..quads];
        let taken = std::mem::take(&mut loads[quad]);
        pulls(&taken, &inverse_masses[quad], &inverse_inertias[quad], self.gravity)
    }

    fn of_rest(&mut self) -> Pulls {
        let taken = rest_of(self.loads);
        self.loads.as_chunks_mut::<LANES>().1.fill(Load::default());
        pulls(&taken, &rest_of(self.inverse_masses), &rest_of(self.inverse_inertias), self.gravity)
    }

    fn split(self, at: usize) -> (Self, Self) {
        let (loads, more_loads) = self.loads.split_at_mut(at);
        let (inverse_masses, more_inverse_masses) = self.inverse_masses.split_at(at);
        let (inverse_inertias, more_inverse_inertias) = self.inverse_inertias.split_at(at);
        let gravity = self.gravity;
        (
            Self { loads, inverse_masses, inverse_inertias, gravity },
            Self {
                loads: more_loads,
                inverse_masses: more_inverse_masses,
                inverse_inertias: more_inverse_inertias,
                gravity,
            },
        )
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

/// What comes after the last whole quad, filled up with zeros.
fn rest_of<T: Copy + Default>(values: &[T]) -> [T; LANES] {
    let (_, rest) = values.as_chunks::<LANES>();
    let mut padded = [T::default(); LANES];
    padded[..rest.len()].copy_from_slice(rest);
    padded
}

/// Replaces what comes after the last whole quad.
fn put_rest<T: Copy>(values: &mut [T], new: &[T; LANES]) {
    let (_, rest) = values.as_chunks_mut::<LANES>();
    rest.copy_from_slice(&new[..rest.len()]);
}

/// Four vectors as two rows: x and y of the first two, then of the last two.
#[inline(always)]
fn two_by_two(v: &[Vec2; LANES]) -> [Lanes; 2] {
    [Lanes::new([v[0].x, v[0].y, v[1].x, v[1].y]), Lanes::new([v[2].x, v[2].y, v[3].x, v[3].y])]
}

/// The inverse of `two_by_two`.
#[inline(always)]
fn four_vectors(rows: [Lanes; 2]) -> [Vec2; LANES] {
    let [[a, b, c, d], [e, f, g, h]] = rows.map(Lanes::to_array);
    [Vec2::new(a, b), Vec2::new(c, d), Vec2::new(e, f), Vec2::new(g, h)]
}

/// What a drift changes.
struct Moved<'a> {
    positions: &'a mut [Vec2],
    velocities: &'a mut [Vec2],
    angles: &'a mut [f64],
    spins: &'a mut [f64],
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

struct Drift<'a, P> {
    pull: P,
    moved: Moved<'a>,
    masses: &'a [f64],
    motions: &'a mut [Motion],
    sums: &'a mut [(Vec2, f64)],
}

impl<P: Pull> Drift<'_, P> {
    fn run(mut self, time_step: f64, turn: f64) {
        let mut sums = QuadSums::new(turn);
        self.move_quads(time_step, &mut sums);
        if !self.motions.len().is_multiple_of(LANES) {
            self.move_rest(time_step, &mut sums);
        }
        if let Some(chunk) = self.sums.first_mut() {
            *chunk = sums.total();
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
        for quad in 0..quads {
            let pulls = self.pull.of(quad, quads);
            let mut four = Quad {
                positions: &mut positions[quad],
                velocities: &mut velocities[quad],
                angles: &mut angles[quad],
                spins: &mut spins[quad],
            };
            four.advance::<P>(pulls, time_step, (&masses[quad], sums), &mut motions[quad]);
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

    fn total(&self) -> (Vec2, f64) {
        let [x, y, more_x, more_y] = self.mass_moment.to_array();
        let longest = self.longest_squared.to_array().into_iter().fold(0.0, larger);
        (Vec2::new(x + more_x, y + more_y), longest)
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
        (
            Self { pull, moved, masses, motions, sums },
            Self {
                pull: more_pull,
                moved: more_moved,
                masses: more_masses,
                motions: more_motions,
                sums: more_sums,
            },
        )
    }
}

struct Kick<'a> {
    velocities: &'a mut [Vec2],
    spins: &'a mut [f64],
    accelerations: &'a mut [Vec2],
    spin_rates: &'a mut [f64],
    loads: &'a [Load],
    inverse_masses: &'a [f64],
    inverse_inertias: &'a [f64],
}

impl Kick<'_> {
    fn run(self, half_step: f64, gravity: Vec2) {
        let n = self.loads.len();
        let (velocities, spins) = (&mut self.velocities[..n], &mut self.spins[..n]);
        let (accelerations, spin_rates) = (&mut self.accelerations[..n], &mut self.spin_rates[..n]);
        let (inverse_masses, inverse_inertias) = (&self.inverse_masses[..n], &self.inverse_inertias[..n]);
        for (i, load) in self.loads.iter().enumerate() {
            let acceleration = load.force() * inverse_masses[i] + gravity;
            let spin_rate = load.moment() * inverse_inertias[i];
            velocities[i] += acceleration * half_step;
            spins[i] += spin_rate * half_step;
            accelerations[i] = acceleration;
            spin_rates[i] = spin_rate;
        }
    }
}

impl Chunked for Kick<'_> {
    fn chunks(&self) -> usize {
        chunk_count(self.loads.len())
    }

    fn split(self, chunks: usize) -> (Self, Self) {
        let at = chunks * CHUNK;
        let (velocities, velocities_rest) = self.velocities.split_at_mut(at);
        let (spins, spins_rest) = self.spins.split_at_mut(at);
        let (accelerations, accelerations_rest) = self.accelerations.split_at_mut(at);
        let (spin_rates, spin_rates_rest) = self.spin_rates.split_at_mut(at);
        let (loads, loads_rest) = self.loads.split_at(at);
        let (inverse_masses, inverse_masses_rest) = self.inverse_masses.split_at(at);
        let (inverse_inertias, inverse_inertias_rest) = self.inverse_inertias.split_at(at);
        (
            Self { velocities, spins, accelerations, spin_rates, loads, inverse_masses, inverse_inertias },
            Self {
                velocities: velocities_rest,
                spins: spins_rest,
                accelerations: accelerations_rest,
                spin_rates: spin_rates_rest,
                loads: loads_rest,
                inverse_masses: inverse_masses_rest,
                inverse_inertias: inverse_inertias_rest,
            },
        )
    }
}
