//! Whole-drum identities: the ledger closes, three powers agree, the numerical column falls with the time step.

use crate::common::*;
use drumrs::io::config::SimulationConfig;
use drumrs::physics::contact::parameters::Tension;
use drumrs::simulation::Simulation;
use drumrs::simulation::initial_state::InitialState;

fn tumbled(config: &SimulationConfig, seconds: f64) -> Simulation {
    let mut simulation = Simulation::new(config.clone(), 3, 1).expect("a load that fits");
    run(&mut simulation, seconds);
    simulation
}

fn cases() -> Vec<(&'static str, SimulationConfig)> {
    let bare = baseline(100, 0);
    let mut frictionless = baseline(100, 0);
    frictionless.contact.bundle.friction = 0.0;
    frictionless.contact.drum.friction = 0.0;
    let mut clipped = baseline(200, 3);
    clipped.contact.bundle.tension = Tension::Clipped;
    clipped.contact.drum.tension = Tension::Clipped;
    let mut overdamped = baseline(100, 3);
    for law in [&mut overdamped.contact.bundle, &mut overdamped.contact.drum] {
        law.restitution = None;
        law.normal_damping = Some(2.0e4);
    }
    let mut washing = baseline(160, 3);
    washing.rotation.knots = vec![[0.0, 0.0], [0.1, SPEED], [0.3, SPEED], [0.5, -SPEED]];
    let mut coarse = baseline(100, 3);
    coarse.run.time_step = Some(1.5e-5);
    let mut locked = baseline(100, 3);
    locked.load.spin_locked = true;
    vec![
        ("bare", bare),
        ("frictionless", frictionless),
        ("clipped, baffles, 50 %", clipped),
        ("75 %", baseline(300, 0)),
        ("overdamped", overdamped),
        ("wash programme", washing),
        ("coarse step", coarse),
        ("spins locked", locked),
    ]
}

#[test]
fn the_ledger_closes_and_three_powers_agree() {
    for (name, config) in cases() {
        let simulation = tumbled(&config, 0.6);
        let residual = statistic(&simulation, "energy_residual", 0.3, simulation.time());
        assert!(residual < 1e-11, "{name}: {residual:e}");
        let disagreement = statistic(&simulation, "power_disagreement", 0.3, simulation.time());
        assert!(disagreement < 1e-9, "{name}: {disagreement:e}");
        for quantity in ["dissipated_normal", "dissipated_sliding"] {
            assert!(column(&simulation, quantity).is_sorted(), "{name}: {quantity} runs backwards");
        }
    }
}

/// Over a short run the ledger keeps to round-off, whatever is in the drum and however it turns.
#[test]
fn short_runs_leave_nothing_but_round_off() {
    let mut reversing = baseline(160, 3);
    reversing.rotation.knots = vec![[0.0, 2.0 * SPEED], [0.02, -2.0 * SPEED], [0.05, SPEED], [0.06, 0.0]];
    let mut jumping = baseline(160, 3);
    jumping.rotation.knots = vec![[0.03, SPEED], [0.03, -SPEED], [0.05, -SPEED], [0.05, 0.0]];
    let mut locked = baseline(160, 3);
    locked.load.spin_locked = true;
    let cases = [
        ("bare", baseline(300, 0)),
        ("baffles", baseline(200, 3)),
        ("reversing", reversing),
        ("jumping", jumping),
        ("locked", locked),
    ];
    for (name, mut config) in cases {
        config.load.start_speed = 2.0;
        let equal = Simulation::new(config.clone(), 3, 1).expect("a load that fits");
        let p = &equal.state().particles;
        let mixed = InitialState {
            positions: p.positions.clone(),
            velocities: Some(p.velocities.clone()),
            radii: Some((0..p.len()).map(|i| RADIUS * (1.0 - 0.02 * (i * 37 % 31) as f64)).collect()),
            ..InitialState::default()
        };
        config.run.time_step = None;
        for mut simulation in [start(&config, mixed), equal] {
            run(&mut simulation, 0.08);
            let residuals = column(&simulation, "energy_residual");
            let worst = residuals.into_iter().fold(0.0, f64::max);
            assert!(worst < 1e-12, "{name}: {worst:e}");
            assert!(last(&simulation, "dissipated_normal") > 0.0);
            let disagreement = statistic(&simulation, "power_disagreement", 0.0, simulation.time());
            assert!(disagreement < 1e-11, "{name}: {disagreement:e}");
        }
    }
}

/// The work that no formula accounts for comes from the steps in which contacts open and close, and from quadrature.
/// It belongs to the method: halving the time step must take most of it away.
#[test]
fn the_numerical_column_falls_with_the_time_step() {
    let share = |time_step: f64| {
        let mut config = baseline(60, 0);
        config.load.start_speed = 1.0;
        config.gravity = [0.0, 0.0];
        config.rotation.knots = vec![[0.0, 0.0]];
        config.run.time_step = Some(time_step);
        (1..=6)
            .map(|seed| {
                let mut simulation = Simulation::new(config.clone(), seed, 1).unwrap();
                run(&mut simulation, 0.05);
                last(&simulation, "numerical") / last(&simulation, "dissipated_normal")
            })
            .sum::<f64>()
            / 6.0
    };
    let (coarse, fine) = (share(1.6e-5), share(4e-6));
    assert!(coarse.abs() < 0.1, "{coarse}");
    assert!(fine.abs() < 0.25 * coarse.abs(), "{fine} against {coarse}");
}

/// Averaged over seconds the drum carries the weight, and its power lies between none and the whole load lifted at the
/// rim.
#[test]
fn forces_and_power_are_those_of_the_weight() {
    for baffle_count in [0, 3] {
        let simulation = tumbled(&baseline(100, baffle_count), 3.0);
        let mut vertical = 0.0;
        for part in ["rim", "baffle_1", "baffle_2", "baffle_3"].iter().take(1 + baffle_count) {
            let forces = column(&simulation, &format!("{part}_force_y"));
            let window = &forces[forces.len() / 2..];
            vertical += window.iter().sum::<f64>() / window.len() as f64;
        }
        let weight = 100.0 * mass() * GRAVITY;
        assert!((vertical / weight + 1.0).abs() < 0.02, "{}", vertical / weight);
        let value = |name| statistic(&simulation, name, 1.5, simulation.time());
        let scaled = value("drum_specific_power") / (GRAVITY * DRUM_RADIUS * SPEED);
        assert!(scaled > 0.05 && scaled < 1.0, "{scaled}");
        assert!(value("max_overlap_ratio") < 0.02);
    }
}

#[test]
fn the_drums_work_is_the_sum_of_its_parts() {
    let simulation = tumbled(&baseline(100, 3), 0.5);
    let parts: f64 = ["rim_work", "baffle_1_work", "baffle_2_work", "baffle_3_work"]
        .map(|p| last(&simulation, p))
        .iter()
        .sum();
    assert!((parts / last(&simulation, "drum_work") - 1.0).abs() < 1e-12);
    assert!(last(&simulation, "baffle_2_work") != 0.0);
}

/// At a constant speed a part's work over an interval is its mean torque times the angle turned.
#[test]
fn torque_times_angle_is_work_for_every_part() {
    let simulation = tumbled(&baseline(100, 3), 0.5);
    let angles = column(&simulation, "drum_angle");
    for part in ["drum", "rim", "baffle_1", "baffle_2", "baffle_3"] {
        let name = if part == "drum" { "drum_torque".into() } else { format!("{part}_torque") };
        let torques = column(&simulation, &name);
        let works = column(&simulation, &format!("{part}_work"));
        let scale = works.iter().fold(0.0, |most: f64, work| most.max(work.abs()));
        for k in 1..works.len() {
            let work = torques[k] * (angles[k] - angles[k - 1]);
            assert!((work - (works[k] - works[k - 1])).abs() < 1e-12 * scale, "{part} at sample {k}");
        }
        assert!(scale > 0.0);
    }
}

/// A drum that stands still does no work, but holds a load that lies on one side: torque and force tell.
#[test]
fn a_drum_at_rest_has_a_torque() {
    let mut config = baseline(1, 0);
    config.load.spin_locked = true;
    config.rotation.knots = vec![[0.0, 0.0]];
    let angle = 0.2;
    let orbit = DRUM_RADIUS - RADIUS + mass() * GRAVITY * libm::cos(angle) / 9.70e7;
    let at = polar(orbit, angle - std::f64::consts::FRAC_PI_2);
    let mut simulation = start(&config, single(at, [0.0, 0.0], 0.0));
    run(&mut simulation, 0.1);
    let torque = mass() * GRAVITY * DRUM_RADIUS * libm::sin(angle);
    let seen = statistic(&simulation, "drum_torque", 0.0, 0.1);
    assert!((seen / torque - 1.0).abs() < 0.01, "{seen} {torque}");
    assert_eq!(statistic(&simulation, "drum_power", 0.0, 0.1), 0.0);
}
