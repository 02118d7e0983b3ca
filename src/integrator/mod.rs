//! Kick, drift, kick: velocity Verlet for centers and spins.
//!
//! Between the kicks a particle moves with its half-step velocity; contacts are told that displacement. The velocity at
//! the end of the step, which the dashpots need before the force is known, is foretold with the last acceleration.

mod constants;
mod drift;
mod pull;
mod quad;

use crate::lanes::Lanes;
use crate::patch::{PATCH, PatchMotion};
use crate::physics::particles::Particles;
use crate::physics::vector::Vec2;
use crate::threads::{CHUNK, Threads, Values, chunk_count};
use constants::Constants;
pub use drift::Drift;
use drift::{Setting, Start, Ways};

/// Where a particle is and how it moves, as two rows that load at once; one cache line.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C, align(64))]
pub struct Motion {
    /// Center at the end of the step [m], x and y; velocity with which it got there [m/s], x and y.
    pub place: Lanes,
    /// Velocity foretold for the end of the step [m/s], x and y; angular velocity during the step [rad/s]; angle [rad].
    pub pace: Lanes,
}

impl Motion {
    /// That of particle `i`, up to date.
    fn new(particles: &Particles, i: usize) -> Self {
        let (position, velocity) = (particles.positions[i], particles.velocities[i]);
        Self {
            place: Lanes::new([position.x, position.y, velocity.x, velocity.y]),
            pace: Lanes::new([velocity.x, velocity.y, particles.angular_velocities[i], particles.angles[i]]),
        }
    }

    /// Center at the end of the step [m].
    #[inline(always)]
    pub fn position(&self) -> Vec2 {
        let [x, y, _, _] = self.place.to_array();
        Vec2::new(x, y)
    }

    /// Velocity during the step [m/s]; at its end once it has been kicked.
    fn velocity(&self) -> Vec2 {
        let [_, _, x, y] = self.place.to_array();
        Vec2::new(x, y)
    }

    /// Angular velocity during the step [rad/s]; at its end once it has been kicked.
    #[inline(always)]
    pub fn spin(&self) -> f64 {
        self.pace.as_array()[2]
    }

    /// Angle at the end of the step [rad].
    fn angle(&self) -> f64 {
        self.pace.as_array()[3]
    }

    /// Adds to velocity [m/s] and angular velocity [rad/s].
    fn kick(&mut self, kick: Vec2, twist: f64) {
        self.place += Lanes::new([0.0, 0.0, kick.x, kick.y]);
        self.pace += Lanes::new([0.0, 0.0, twist, 0.0]);
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

/// Scratch of the integrator; nothing in it outlives a step but what follows from the particles' constants. While steps
/// follow each other unseen, the motions alone know where the particles are and how they move.
#[derive(Debug, Clone)]
pub struct Integrator {
    /// What the contacts are told, by particle.
    pub motions: Vec<Motion>,
    /// The most that anyone did in the last step, by patch.
    pub patches: Vec<PatchMotion>,
    /// The same of the step under way: chunks move on while others still read what was done in the last.
    next_patches: Vec<PatchMotion>,
    /// Σ m x, by chunk.
    mass_moments: Vec<Vec2>,
    constants: Constants,
    time_step: f64,
    gravity: Vec2,
    /// Steps since the ways of all were measured.
    unmeasured: u32,
    /// The angle by which the drum turned in the last step [rad], and the longest way in it [m].
    last: (f64, f64),
}

/// What the particles of some chunks are told: centers and velocities; angular velocities and angles.
type Shown<'a> = ((Values<'a, Vec2>, Values<'a, Vec2>), (Values<'a, f64>, Values<'a, f64>));

/// What a step brings up to date at its end, if somebody looks: motions; accelerations and angular accelerations.
type Kicked<'a> = (Values<'a, Motion>, (Values<'a, Vec2>, Values<'a, f64>));

/// Steps from one measurement of all ways to the next; in between they are bounded by how much displacements change.
const MEASURED_EVERY: u32 = 16;

impl Integrator {
    /// For these particles, which have not moved yet.
    pub fn new(particles: &Particles, time_step: f64, gravity: Vec2) -> Self {
        Self {
            motions: (0..particles.len()).map(|i| Motion::new(particles, i)).collect(),
            patches: vec![PatchMotion::default(); particles.len().div_ceil(PATCH)],
            next_patches: vec![PatchMotion::default(); particles.len().div_ceil(PATCH)],
            mass_moments: vec![Vec2::zeros(); chunk_count(particles.len())],
            constants: Constants::new(particles),
            time_step,
            gravity,
            unmeasured: MEASURED_EVERY,
            last: (0.0, 0.0),
        }
    }

    /// A drift of all particles, none of which is farther than `farthest` from the axis [m], while the drum turns by `turn`
    /// [rad], still to be run chunk by chunk; what it moves; and by patch, the most that anyone did in the last step.
    pub fn drift(&mut self, turn: f64, farthest: f64) -> (Drift<'_>, &mut [Motion], &[PatchMotion]) {
        let (constants, time_step, gravity) = (&self.constants, self.time_step, self.gravity);
        self.unmeasured += 1;
        let ways = if self.unmeasured >= MEASURED_EVERY {
            self.unmeasured = 0;
            Ways::Measured { turn }
        } else {
            // As seen from the drum a displacement also changes as it is turned, and with the drum's speed.
            let (last_turn, way) = self.last;
            let turned = turn.abs() * (way + last_turn.abs() * farthest);
            Ways::Bounded { before: &self.patches, more: turned + (turn - last_turn).abs() * farthest }
        };
        self.last.0 = turn;
        let drift = Drift {
            first: 0,
            patches: &mut self.next_patches,
            mass_moments: &mut self.mass_moments,
            setting: Setting { constants, time_step, gravity, ways },
        };
        (drift, &mut self.motions, &self.patches)
    }

    /// Half a kick with the accelerations that the particles carry, then the drift; the motions must be up to date.
    pub fn start(
        &mut self,
        particles: &Particles,
        (turn, farthest): (f64, f64),
        threads: &Threads,
    ) -> DriftSums {
        let (drift, motions, _) = self.drift(turn, farthest);
        let (accelerations, spin_rates) = (&particles.accelerations, &particles.angular_accelerations);
        let work = Start { drift, motions, accelerations, spin_rates };
        threads.for_each_chunk(accelerations.len(), work, &Start::run);
        self.end_drift()
    }

    /// Sums up what a drift did that has been run on all chunks.
    pub fn end_drift(&mut self) -> DriftSums {
        std::mem::swap(&mut self.patches, &mut self.next_patches);
        let mass_moment = self.mass_moments.iter().fold(Vec2::zeros(), |sum, part| sum + part);
        let longest_way = self.patches.iter().fold(0.0, |most: f64, patch| most.max(patch.way));
        self.last.1 = longest_way;
        DriftSums { mass_moment, longest_way }
    }

    /// Accelerations from the loads and gravity, then the second half of the kick: motions and particles are up to date.
    pub fn finish(&mut self, particles: &mut Particles, loads: &[Load], threads: &Threads) {
        let (constants, half_step, gravity) = (&self.constants, 0.5 * self.time_step, self.gravity);
        let Particles { accelerations, angular_accelerations, .. } = particles;
        let rates = (Values::of_all(accelerations), Values::of_all(angular_accelerations));
        let work = (Values::of_all(&mut self.motions), rates);
        threads.for_each_chunk(loads.len(), work, &|(motions, rates): Kicked| {
            let (accelerations, spin_rates) = rates;
            let own = constants.of(motions.first, motions.values.len());
            for (i, motion) in motions.values.iter_mut().enumerate() {
                let load = loads[motions.first + i];
                let acceleration = load.force() * own.inverse_masses[i] + gravity;
                let spin_rate = load.moment() * own.inverse_inertias[i];
                motion.kick(acceleration * half_step, spin_rate * half_step);
                (accelerations.values[i], spin_rates.values[i]) = (acceleration, spin_rate);
            }
        });
        self.show(particles, threads);
    }

    /// Tells the particles where they are and how they move.
    pub fn show(&self, particles: &mut Particles, threads: &Threads) {
        let Particles { positions, velocities, angular_velocities, angles, .. } = particles;
        let centers = (Values::of_all(positions), Values::of_all(velocities));
        let turns = (Values::of_all(angular_velocities), Values::of_all(angles));
        threads.for_each_chunk(self.motions.len(), (centers, turns), &|(centers, turns): Shown| {
            let ((positions, velocities), (spins, angles)) = (centers, turns);
            let motions = &self.motions[positions.first..];
            for (i, (position, motion)) in positions.values.iter_mut().zip(motions).enumerate() {
                *position = motion.position();
                velocities.values[i] = motion.velocity();
                spins.values[i] = motion.spin();
                angles.values[i] = motion.angle();
            }
        });
    }

    /// Tells the particles where they are.
    pub fn place(&self, positions: &mut [Vec2], threads: &Threads) {
        threads.set_each(positions, &|i| self.motions[i].position());
    }

    /// Accelerations from the loads and gravity alone: the start of a simulation, before the first kick.
    pub fn accelerate(&self, particles: &mut Particles, loads: &[Load]) {
        for (chunk, loads) in loads.chunks(CHUNK).enumerate() {
            let constants = self.constants.of(chunk * CHUNK, loads.len());
            for (i, load) in loads.iter().enumerate() {
                let particle = chunk * CHUNK + i;
                particles.accelerations[particle] = load.force() * constants.inverse_masses[i] + self.gravity;
                particles.angular_accelerations[particle] = load.moment() * constants.inverse_inertias[i];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::vector::perpendicular;

    /// Particles that are kicked about while the drum starts, turns and stops: as seen from it, nobody goes farther than is
    /// said of their patch, nor than everybody.
    #[test]
    fn ways_are_measured_or_bounded() {
        let wave = |k: usize, pace: usize| (k * pace % 1009) as f64 / 504.5 - 1.0;
        let place = |i: usize| Vec2::new(wave(i, 577), wave(i, 911));
        let count = 2 * PATCH + 3;
        let mut particles =
            Particles::at_rest((0..count).map(place).collect(), vec![0.01; count], 1.0, false);
        particles.velocities = (0..count).map(|i| Vec2::new(wave(i, 313), wave(i, 717)) * 0.3).collect();
        let (time_step, farthest) = (1e-3, 2.0);
        let mut integrator = Integrator::new(&particles, time_step, Vec2::new(0.0, -9.81));
        let mut exact = 0;
        for step in 0..200 {
            let turn = if step < 100 { 1e-4 * wave(step, 7) } else { 2e-3 };
            let before: Vec<Vec2> = integrator.motions.iter().map(Motion::position).collect();
            let push = |i: usize| Lanes::new([wave(i + step, 17), wave(i, 29 + step), 0.0, 0.0]) * 0.01;
            let mut loads: Vec<Load> = (0..count).map(|i| Load(push(i))).collect();
            let (drift, motions, _) = integrator.drift(turn, farthest);
            drift.kick_and_run(motions, &mut loads);
            let longest = integrator.end_drift().longest_way;
            let way = |i: usize| {
                let motion: &Motion = &integrator.motions[i];
                (motion.velocity() * time_step - perpendicular(before[i]) * turn).norm()
            };
            for (patch, most) in integrator.patches.iter().enumerate() {
                let members = patch * PATCH..count.min((patch + 1) * PATCH);
                let farthest_gone = members.map(way).fold(0.0, f64::max);
                assert!(farthest_gone <= most.way * (1.0 + 1e-12), "step {step}, patch {patch}");
                assert!(most.way <= longest);
                exact += usize::from(most.way <= farthest_gone * (1.0 + 1e-12));
            }
        }
        assert!(
            exact >= 2 * 200 / MEASURED_EVERY as usize,
            "whole patches are measured now and then: {exact}"
        );
    }
}
