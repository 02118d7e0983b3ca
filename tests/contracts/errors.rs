//! Every message that a user may meet, and the initial states that are refused.

use crate::common::*;
use drumrs::error::{Error, Incident, Value};
use drumrs::physics::vector::Vec2;
use drumrs::simulation::Simulation;
use drumrs::simulation::initial_state::InitialState;

fn refusal(config: &drumrs::io::config::SimulationConfig, initial: InitialState) -> String {
    Simulation::with_state(config.clone(), 1, 1, initial).unwrap_err().to_string()
}

#[test]
fn every_variant_has_its_message() {
    let config = Error::config("load.density", -1.0, "a positive finite number");
    assert_eq!(config.to_string(), "load.density is -1, but must be a positive finite number");
    let packing = Error::Packing { requested: 400, fits: 361, diameters: [0.02375; 2] };
    assert_eq!(
        packing.to_string(),
        "load.count is 400, but must be at most 361: no more bundles of diameter 0.02375 m fit into this drum"
    );
    let mixed = Error::Packing { requested: 400, fits: 361, diameters: [0.02, 0.028] };
    assert_eq!(
        mixed.to_string(),
        "load.count is 400, but must be at most about 361: no more bundles of this mix, 2.000e-2 to 2.800e-2 m in \
         diameter, fit into this drum"
    );
    let incident =
        Incident { particle: 812, step: 40_210, time: 0.148_777, position: [0.200_04, -0.1], speed: 1.25 };
    let non_finite = Error::NonFinite { incident: incident.clone() };
    assert_eq!(
        non_finite.to_string(),
        "the state of bundle 812 is no longer finite at step 40210 (t = 0.148777 s); shorten run.time_step"
    );
    let overlap = Error::Overlap { incident: incident.clone(), ratio: 0.61, limit: 0.5 };
    assert_eq!(
        overlap.to_string(),
        "the overlap of bundle 812 reached 0.610 of its radius at step 40210 (t = 0.148777 s) near \
         [0.2000, -0.1000] m at 1.250 m/s, beyond run.overlap_limit = 0.5; shorten run.time_step or raise the \
         stiffness"
    );
    let escaped = Error::Escaped { incident: incident.clone(), surface: "rim".into() };
    assert_eq!(
        escaped.to_string(),
        "bundle 812 passed through the rim by step 40210 (t = 0.148777 s) near [0.2000, -0.1000] m at 1.250 m/s; \
         shorten run.time_step or raise the stiffness"
    );
    let too_fast = Error::TooFast { incident, displacement: 0.0123, limit: 0.0059 };
    assert_eq!(
        too_fast.to_string(),
        "bundle 812 moved 1.230e-2 m in one step at step 40210 (t = 0.148777 s) near [0.2000, -0.1000] m at \
         1.250 m/s, as seen from the drum, more than half of the smallest radius, 5.900e-3 m; shorten \
         run.time_step, or start slower"
    );
    let checkpoint = Error::Checkpoint { reason: "it is damaged".into() };
    assert_eq!(checkpoint.to_string(), "cannot use this checkpoint: it is damaged");
    let system = Error::System { action: "reading run.ckpt".into(), reason: "no such file".into() };
    assert_eq!(system.to_string(), "reading run.ckpt: no such file");
}

/// Callers ask for the parts of which a message is made.
#[test]
fn errors_have_parts() {
    let error = Error::Config {
        key: "run.time_step".into(),
        value: 1e-3.into(),
        limit: "at most 2e-5".into(),
        bound: Some(2e-5),
        hint: "or set run.time_step = \"auto\"",
    };
    assert_eq!(error.key(), Some("run.time_step"));
    assert_eq!(error.problem(), "is 0.001, but must be at most 2e-5");
    assert_eq!(error.limit(), "at most 2e-5");
    assert_eq!(
        error.to_string(),
        "run.time_step is 0.001, but must be at most 2e-5; or set run.time_step = \"auto\""
    );
    let packing = Error::Packing { requested: 400, fits: 361, diameters: [0.02375; 2] };
    assert_eq!((packing.key(), packing.hint()), (Some("load.count"), ""));
    assert_eq!(Value::from(1e300).to_string(), "1e300");
    assert_eq!(Value::from(-0.5).to_string(), "-0.5");
}

/// A simulation ends in each of the errors that a simulation can end in.
#[test]
fn failures_carry_step_and_bundle() {
    let overfull = Simulation::new(baseline(5000, 0), 1, 1).unwrap_err();
    assert!(matches!(overfull, Error::Packing { requested: 5000, fits: 300..=400, .. }), "{overfull}");

    // 300 m/s go a bundle's radius deep into the rim in ten steps.
    let at_speed = |speed: f64| {
        let mut simulation = start(&baseline(1, 0), single([0.2, 0.0], [speed, 0.0], 0.0));
        simulation.run(1000).unwrap_err()
    };
    let deep = at_speed(300.0);
    let Error::Overlap { incident, ratio, limit } = deep else { panic!("{deep}") };
    assert_eq!((incident.particle, incident.step, limit), (0, 32, 0.5), "the whole load is looked at then");
    assert!(ratio > 0.5 && incident.position[0] > 0.22 && incident.time == 32.0 * TIME_STEP, "{incident}");
    // The particles stay where they were when it happened, as if somebody had looked at every step.
    let thrown = || start(&baseline(1, 0), single([0.2, 0.0], [300.0, 0.0], 0.0));
    let (mut at_once, mut in_steps) = (thrown(), thrown());
    at_once.run(1000).unwrap_err();
    while in_steps.run(1).is_ok() {}
    assert_eq!(at_once.state().step, in_steps.state().step);
    assert_eq!(at_once.state().particles, in_steps.state().particles);
    assert_eq!(at_once.failure(), in_steps.failure());

    // 1.5 km/s pass through the rim; 1.6 km/s are more than half a radius a step, wherever that leads to.
    let through = at_speed(1500.0);
    assert!(
        matches!(&through, Error::Escaped { incident, surface } if incident.step == 32 && surface == "rim"),
        "{through}"
    );
    let fast = at_speed(1700.0);
    let Error::TooFast { incident, displacement, limit } = fast else { panic!("{fast}") };
    assert_eq!((incident.step, limit), (1, 0.5 * RADIUS));
    assert!(
        (displacement - 1700.0 * TIME_STEP).abs() < 1e-3 * displacement && incident.speed > 1699.0,
        "{displacement} {incident}"
    );
}

#[test]
fn a_simulation_needs_a_thread() {
    let error = Simulation::new(baseline(5, 0), 1, 0).unwrap_err();
    assert_eq!(error.to_string(), "threads is 0, but must be at least 1");
}

#[test]
fn bundles_start_inside_the_drum_and_outside_of_its_baffles() {
    let config = baseline(1, 3);
    let outside = single([0.3, 0.0], [0.0, 0.0], 0.0);
    assert_eq!(
        refusal(&config, outside),
        "state.positions[0] is [0.3, 0], but must be inside the drum and outside of its baffles: there is the \
         rim"
    );
    let inside_a_baffle = several(&[([0.0, 0.0], [0.0, 0.0], 0.0), ([0.22, 0.0], [0.0, 0.0], 0.0)]);
    assert!(refusal(&config, inside_a_baffle).starts_with("state.positions[1] is [0.22, 0]"));
    // The same place is free where there are no baffles, but for the overlap with the rim.
    assert!(Simulation::with_state(baseline(1, 0), 1, 1, single([0.22, 0.0], [0.0, 0.0], 0.0)).is_ok());
}

#[test]
fn states_that_overlap_too_deeply_are_refused() {
    let twice = several(&[([0.0, 0.0], [0.0, 0.0], 0.0), ([0.01, 0.0], [0.0, 0.0], 0.0)]);
    let error = Simulation::with_state(baseline(1, 0), 1, 1, twice).unwrap_err();
    let Error::StartOverlap { one, other, ratio, .. } = &error else { panic!("{error}") };
    assert!(one == "state.positions[0]" && other.contains('1'), "{one} {other}");
    assert!((ratio - (2.0 * RADIUS - 0.01) / RADIUS).abs() < 1e-12, "{ratio}");
}

#[test]
fn numbers_that_are_not_finite_are_refused() {
    let config = free_space();
    let states = [
        InitialState { positions: vec![Vec2::zeros(), Vec2::new(f64::NAN, 0.0)], ..Default::default() },
        single([1.0, 0.0], [0.0, f64::INFINITY], 0.0),
        single([1.0, 0.0], [0.0, 0.0], f64::NAN),
        InitialState { positions: vec![Vec2::zeros()], angles: Some(vec![f64::NAN]), ..Default::default() },
    ];
    for (bundle, state) in [1, 0, 0, 0].into_iter().zip(states) {
        assert_eq!(
            refusal(&config, state),
            format!("state of bundle {bundle} is not finite, but must be finite")
        );
    }
    for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let state =
            InitialState { positions: vec![Vec2::zeros()], radii: Some(vec![radius]), ..Default::default() };
        let expected = format!("state.radii[0] is {radius}, but must be a positive finite number");
        assert_eq!(refusal(&config, state), expected);
    }
}

#[test]
fn fields_of_a_wrong_length_are_refused() {
    let config = free_space();
    let state = || InitialState { positions: vec![Vec2::zeros(), Vec2::new(1.0, 0.0)], ..Default::default() };
    let states = [
        ("velocities", InitialState { velocities: Some(vec![Vec2::zeros()]), ..state() }),
        ("angles", InitialState { angles: Some(vec![0.0]), ..state() }),
        ("angular_velocities", InitialState { angular_velocities: Some(vec![0.0]), ..state() }),
        ("radii", InitialState { radii: Some(vec![RADIUS]), ..state() }),
    ];
    for (field, state) in states {
        assert_eq!(refusal(&config, state), format!("state.{field} is of length 1, but must be of length 2"));
    }
    let empty = InitialState::default();
    assert_eq!(refusal(&config, empty), "state.positions is empty, but must be of at least one bundle");
    let crowd = InitialState { positions: vec![Vec2::zeros(); 10_000_001], ..InitialState::default() };
    assert_eq!(
        refusal(&config, crowd),
        "state.positions is of 10000001 bundles, but must be of at most 10000000 bundles"
    );
}

#[test]
fn locked_spins_start_at_zero() {
    let mut config = free_space();
    config.load.spin_locked = true;
    let message = "state.angular_velocities is not 0, but must be 0 while load.spin_locked is true";
    assert_eq!(refusal(&config, single([0.0, 0.0], [1.0, 0.0], 2.0)), message);
    let mut simulation = start(&config, single([0.0, 0.0], [1.0, 0.0], 0.0));
    simulation.run(10).unwrap();
    assert_eq!(simulation.state().particles.angular_velocities[0], 0.0);
}

#[test]
fn a_step_that_cannot_resolve_a_contact_is_refused() {
    let mut config = baseline(5, 0);
    config.run.time_step = Some(1e-4);
    let message = Simulation::new(config, 1, 1).unwrap_err().to_string();
    assert!(message.starts_with("run.time_step is 0.0001, but must be at most 1.9"), "{message}");
    assert!(
        message.ends_with("a tenth of the shortest collision time; or set run.time_step = \"auto\""),
        "{message}"
    );
}
