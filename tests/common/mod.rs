//! Scenes shared by the tests: Table 1 of Park & Wassgren, and the small worlds in which single laws show.

#![allow(dead_code)] // Each test binary uses its own part.

use drumrs::io::config::{ContactTables, LoadParameters, RunParameters, SimulationConfig};
use drumrs::observe::summary::summarize;
use drumrs::physics::contact::law::{BodyPair, ContactLaw};
use drumrs::physics::contact::linear::{Linear, LinearLaw, SpringHistory};
use drumrs::physics::contact::parameters::{Base, ContactParameters, Tension};
use drumrs::physics::contact::{ContactState, Kinematics, RelativeMotion, Response};
use drumrs::physics::drum::DrumParameters;
use drumrs::physics::drum::baffle::{BaffleParameters, BaffleShape};
use drumrs::physics::load::shares::Measure;
use drumrs::physics::rotation::RotationSchedule;
use drumrs::physics::vector::Vec2;
use drumrs::simulation::Simulation;
use drumrs::simulation::initial_state::InitialState;

pub const DRUM_RADIUS: f64 = 0.2375;
pub const RADIUS: f64 = 0.011_875;
pub const SPEED: f64 = 54.0 * std::f64::consts::TAU / 60.0;
pub const TIME_STEP: f64 = 3.7e-6;
pub const GRAVITY: f64 = 9.81;

/// Mass of a bundle of Table 1 [kg/m].
pub fn mass() -> f64 {
    1000.0 * std::f64::consts::PI * RADIUS * RADIUS
}

pub fn law(normal_stiffness: f64) -> ContactParameters {
    ContactParameters {
        base: Base::Linear,
        normal_stiffness,
        stiffness_ratio: 1.0,
        young_modulus: None,
        poisson_ratio: 0.3,
        restitution: Some(0.1),
        normal_damping: None,
        friction: 0.5,
        tension: Tension::Allowed,
        adhesion: 0.0,
        tangential_damping_ratio: 0.0,
        rolling_friction: 0.0,
    }
}

/// The linear law between two bundles of Table 1.
pub fn linear_law(parameters: &ContactParameters) -> LinearLaw<f64> {
    let bodies =
        BodyPair { effective_mass: 0.5 * mass(), effective_radius: 0.5 * RADIUS, layer: 2.0 * RADIUS };
    Linear::<true>::between(parameters, bodies)
}

/// A step for which a rate times its length and back is exact [s].
pub const EXACT_STEP: f64 = 1.0 / (1 << 18) as f64;

/// One step of the law, at whose end the bodies overlap by `overlap` [m]; in it they approached and slipped by so much [m],
/// and at its start they overlapped by `last_overlap` and stretched the tangential spring by `stretch` [m].
pub fn respond(
    law: &LinearLaw<f64>,
    overlap: f64,
    [approach, slip]: [f64; 2],
    [last_overlap, stretch]: [f64; 2],
) -> (Response<f64>, SpringHistory<f64>) {
    let [separation_rate, slip_rate] = [-approach, slip].map(|way| way / EXACT_STEP);
    let motion = RelativeMotion { overlap, separation_rate, slip_rate, rolling_rate: 0.0 };
    let last =
        ContactState { overlap: last_overlap, separation_rate, force_x: 0.0, force_y: 0.0, moment: 0.0 };
    let contact = Kinematics::new(&motion, &last, [EXACT_STEP, 1.0 / EXACT_STEP]);
    Linear::<true>::respond(law, &contact, &SpringHistory { tangential_displacement: stretch })
}

pub fn baffles(count: usize) -> BaffleParameters {
    BaffleParameters {
        name: "baffle".into(),
        count,
        shape: BaffleShape::Triangle,
        height: 0.05,
        base: 0.06,
        tip: 0.02,
        points: None,
        corner_radius: 0.0,
        chord_error: 1e-4,
        phase: 0.0,
    }
}

/// The drum of Table 1 with these baffles.
pub fn drum_with(baffles: BaffleParameters) -> DrumParameters {
    DrumParameters { radius: Some(DRUM_RADIUS), shell: None, baffles: vec![baffles], walls: Vec::new() }
}

/// Table 1 with `count` bundles and `baffle_count` baffles.
pub fn baseline(count: usize, baffle_count: usize) -> SimulationConfig {
    SimulationConfig {
        drum: drum_with(baffles(baffle_count)),
        rotation: RotationSchedule { knots: vec![[0.0, SPEED]] },
        load: LoadParameters {
            count,
            diameter: 2.0 * RADIUS,
            density: 1000.0,
            species: Vec::new(),
            share_by: Measure::Mass,
            start_speed: 0.0,
            spin_locked: false,
        },
        contact: ContactTables {
            bundle: law(9.25e7),
            drum: law(9.70e7),
            species: 1,
            pairs: Vec::new(),
            walls: Vec::new(),
        },
        gravity: [0.0, -GRAVITY],
        run: RunParameters {
            time_step: Some(TIME_STEP),
            sample_every: 0.001,
            frame_every: 0.04,
            skin: None,
            record: Vec::new(),
            contact_floor: 0.0,
            arc_bin: None,
            cell: None,
            zones: Vec::new(),
            sums_from: 0.0,
            overlap_limit: 0.5,
        },
    }
}

/// The point at `radius` from the axis in the direction `angle` [rad].
pub fn polar(radius: f64, angle: f64) -> [f64; 2] {
    [radius * libm::cos(angle), radius * libm::sin(angle)]
}

/// Bundles of Table 1 in free space without gravity: no drum, no walls.
pub fn free_space() -> SimulationConfig {
    let mut config = baseline(1, 0);
    config.drum.radius = None;
    config.rotation.knots = vec![[0.0, 0.0]];
    config.gravity = [0.0, 0.0];
    config
}

/// Free space above a straight floor along the x axis, with gravity `gravity`.
pub fn floor(gravity: [f64; 2]) -> SimulationConfig {
    let mut config = free_space();
    config.drum.walls = vec![vec![[-100.0, 0.0], [100.0, 0.0]]];
    config.gravity = gravity;
    config
}

/// One bundle of a given state.
pub fn single(position: [f64; 2], velocity: [f64; 2], spin: f64) -> InitialState {
    several(&[(position, velocity, spin)])
}

/// Bundles given as (position, velocity, spin).
pub fn several(bundles: &[([f64; 2], [f64; 2], f64)]) -> InitialState {
    InitialState {
        positions: bundles.iter().map(|bundle| bundle.0.into()).collect(),
        velocities: Some(bundles.iter().map(|bundle| bundle.1.into()).collect()),
        angular_velocities: Some(bundles.iter().map(|bundle| bundle.2).collect()),
        ..InitialState::default()
    }
}

pub fn start(config: &SimulationConfig, initial: InitialState) -> Simulation {
    Simulation::with_state(config.clone(), 1, 1, initial).expect("a valid scene")
}

/// Runs for `seconds`.
pub fn run(simulation: &mut Simulation, seconds: f64) {
    let steps = (seconds / simulation.time_step()).ceil() as u64;
    simulation.run(steps).expect("a stable run");
}

/// Runs until no contact is left after at least one was made; fails after `most` steps.
pub fn run_through_contact(simulation: &mut Simulation, most: u64) {
    let touching = |simulation: &Simulation| {
        let contacts = simulation.contacts();
        contacts.counts().0 + contacts.counts().1
    };
    let mut met = false;
    for _ in 0..most {
        simulation.run(1).expect("a stable run");
        let now = touching(simulation) > 0;
        if met && !now {
            return;
        }
        met |= now;
    }
    panic!("no contact came and went within {most} steps");
}

/// Every bit of what a simulation shows: step, particles, series.
pub fn bits(simulation: &Simulation) -> Vec<u64> {
    let particles = &simulation.state().particles;
    let vectors = |vectors: &[Vec2]| -> Vec<u64> {
        vectors.iter().flat_map(|v| [v.x.to_bits(), v.y.to_bits()]).collect()
    };
    let numbers = |numbers: &[f64]| -> Vec<u64> { numbers.iter().map(|number| number.to_bits()).collect() };
    let mut all = vec![simulation.state().step];
    all.extend(vectors(&particles.positions));
    all.extend(vectors(&particles.velocities));
    all.extend(vectors(&particles.forces));
    all.extend(numbers(&particles.angles));
    all.extend(numbers(&particles.angular_velocities));
    for index in 0..simulation.series().width() {
        all.extend(numbers(&simulation.series().column(index)));
    }
    all
}

/// A statistic over the samples from `start` to `end` [s].
pub fn statistic(simulation: &Simulation, name: &str, start: f64, end: f64) -> f64 {
    let statistics = summarize(simulation.series(), simulation.mass(), start, end);
    let statistics = statistics.expect("a window of samples");
    statistics.iter().find(|entry| entry.0 == name).expect("a known statistic").1.expect("a defined value")
}

/// The last value of a recorded quantity.
pub fn last(simulation: &Simulation, name: &str) -> f64 {
    *column(simulation, name).last().expect("at least one sample")
}

/// All values of a recorded quantity.
pub fn column(simulation: &Simulation, name: &str) -> Vec<f64> {
    simulation.series().column(simulation.series().place_of(name).expect("a recorded quantity"))
}
