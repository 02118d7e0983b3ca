//! Bundles at baffles: rolling round a tip, the foot, the torque of each part, programmes.

use crate::common::*;
use drumrs::error::Error;
use drumrs::physics::contact::linear;
use drumrs::physics::drum::RIM;
use drumrs::physics::drum::baffle::BaffleShape;
use drumrs::physics::vector::Vec2;
use drumrs::simulation::Simulation;

/// A disc pressed onto the tip of a wedge and rolling over it: the contact passes from edge to vertex to edge; force
/// and spring must not jump.
#[test]
fn force_and_spring_survive_a_tip() {
    // The tip is at the origin, the flanks fall off to both sides, gravity presses the disc onto it.
    let mut config = floor([0.0, -GRAVITY]);
    config.drum.walls = vec![vec![[-1.0, -0.3], [0.0, 0.0], [1.0, -0.3]]];
    config.run.time_step = Some(2e-6);
    let length = (1.0_f64 + 0.09).sqrt();
    // The disc stands on the left flank near the tip and rolls to the right, slowly enough to stay in contact.
    let (normal, along) = ([-0.3 / length, 1.0 / length], [1.0 / length, 0.3 / length]);
    let distance = RADIUS - mass() * GRAVITY / length / 9.70e7;
    let foot = [-0.004 * along[0], -0.004 * along[1]];
    let center = [foot[0] + distance * normal[0], foot[1] + distance * normal[1]];
    let speed = 0.3;
    let velocity = [speed * along[0], speed * along[1]];
    let mut simulation = start(&config, single(center, velocity, -speed / RADIUS));
    let mut features = Vec::new();
    // On the vertex the center's path bends, so the force changes by m v²/r, damped, over a collision time; the first
    // step takes the dashpot's share of it, νₙ (v²/r) Δt, and foretells half as much again.
    let damping = linear::damping(&simulation.config().contact.drum, mass());
    let bend = 1.5 * damping * speed * speed / RADIUS * simulation.time_step();
    let mut last_force = None;
    let (mut last_stretch, mut greatest) = (0.0_f64, 0.0_f64);
    // Nothing damps the tangential spring: it swings with ω² = 3 kₛ/m, and within a step by ω Δt of its amplitude.
    let swing = (3.0 * 9.70e7 / mass()).sqrt() * simulation.time_step();
    for _ in 0..30_000 {
        simulation.run(1).unwrap();
        let touching = simulation.contacts().walls;
        if touching.is_empty() {
            break;
        }
        assert_eq!(touching.len(), 1, "a corner counts once");
        let (feature, force, [stretch, ..]) =
            (touching[0].other, Vec2::from(touching[0].force), touching[0].history);
        let jump = last_force.map_or(0.0, |last: Vec2| (force - last).norm());
        assert!(jump < bend, "the force jumps by {jump} at feature {feature}, {bend} allowed");
        if features.last() != Some(&feature) {
            if !features.is_empty() {
                let change = (stretch - last_stretch).abs();
                assert!(last_stretch.abs() > 2.0 * swing * greatest, "a loss of the spring would not show");
                assert!(change < swing * greatest, "{change} {last_stretch}");
            }
            features.push(feature);
        }
        last_force = Some(force);
        last_stretch = stretch;
        greatest = greatest.max(last_stretch.abs());
    }
    assert_eq!(features.len(), 3, "edge, vertex, edge: {features:?}");
}

/// The speed at which a disc leaves that falls at 1 m/s on the tip of a roof, or on what is drawn instead.
fn rebound(walls: Vec<Vec<[f64; 2]>>, restitution: f64) -> f64 {
    let mut config = free_space();
    config.drum.walls = walls;
    config.contact.drum.restitution = Some(restitution);
    config.contact.drum.friction = 0.0;
    config.run.time_step = Some(1e-6);
    let mut simulation = start(&config, single([0.0, RADIUS + 1e-4], [0.0, -1.0], 0.0));
    run_through_contact(&mut simulation, 10_000);
    simulation.state().particles.velocities[0].norm()
}

/// However the lines of a corner are drawn, a disc is hit by it once.
#[test]
fn walls_that_share_a_point_hit_once() {
    let (a, o, b, below) = ([-0.1, -0.1], [0.0, 0.0], [0.1, -0.1], [0.0, -0.1]);
    let (left, right, gaping) = ([-0.1, 0.0], [0.1, 0.0], [1e-9, -1e-9]);
    let drawings = [
        vec![vec![a, o], vec![o, b]],
        vec![vec![o, b], vec![o, a]],
        vec![vec![a, o], vec![gaping, b]],
        vec![vec![left, o], vec![right, o]],
        vec![vec![left, right], vec![o, below]],
        vec![vec![left, [0.01, 0.0]], vec![[-0.01, 0.0], right]],
        vec![vec![a, o], vec![o, b], vec![o, below]],
    ];
    for restitution in [0.1, 0.5] {
        let expected = rebound(vec![vec![a, o, b]], restitution);
        assert!((expected - restitution).abs() < 0.01 * restitution, "{expected}");
        for walls in &drawings {
            let speed = rebound(walls.clone(), restitution);
            assert!((speed - expected).abs() < 1e-6 * expected, "{speed} {expected} {walls:?}");
        }
    }
}

/// A disc that rolls over a floor of loose lines feels one line at a time, and moves as on a floor of one wall.
#[test]
fn a_floor_of_loose_lines_is_smooth() {
    let at = |k: u32| [0.01 * f64::from(k) - 0.1, 0.0];
    let roll = |walls: Vec<Vec<[f64; 2]>>| {
        let mut config = floor([0.0, -GRAVITY]);
        config.drum.walls = walls;
        let mut simulation = start(&config, single([-0.06, RADIUS], [0.5, 0.0], -0.5 / RADIUS));
        let mut features = Vec::new();
        while simulation.state().particles.positions[0].x < 0.06 {
            simulation.run(50).unwrap();
            features.extend(simulation.contacts().walls.iter().map(|contact| contact.other));
            assert!(simulation.contacts().counts().1 <= 1);
        }
        features.dedup();
        (simulation.state().particles.velocities[0], features)
    };
    let (whole, _) = roll(vec![vec![at(0), at(20)]]);
    let (loose, features) = roll((0..20).map(|k| vec![at(k), at(k + 1)]).collect());
    assert_eq!(features.len(), 13, "each line in turn: {features:?}");
    assert!((loose - whole).norm() < 1e-12, "{loose} {whole}");
}

/// A wall that turns towards a resting disc strikes it with the wall's own speed there: the disc leaves with (1 + e)
/// times that, and the wall has done the work of it. A single onset within a step errs in first order; means are held
/// against the formula.
#[test]
fn a_paddle_strikes_with_its_own_speed() {
    let (speed, arm, restitution, onsets) = (1.0, 0.5, 0.5, 24);
    let mut config = free_space();
    config.drum.walls = vec![vec![[0.2, 0.0], [0.8, 0.0]]];
    config.rotation.knots = vec![[0.0, speed]];
    config.contact.drum.restitution = Some(restitution);
    config.contact.drum.friction = 0.0;
    config.run.time_step = Some(TIME_STEP);
    config.run.sample_every = TIME_STEP;
    let (mut mean, mut work, mut loss) = (0.0, 0.0, 0.0);
    for k in 0..onsets {
        let gap = (2.0 + (f64::from(k) + 0.5) / f64::from(onsets)) * TIME_STEP * speed * arm;
        let mut simulation = start(&config, single([arm, RADIUS + gap], [0.0, 0.0], 0.0));
        run_through_contact(&mut simulation, 1000);
        simulation.run(2).unwrap();
        mean += simulation.state().particles.velocities[0].y / f64::from(onsets);
        work += last(&simulation, "wall_1_work") / f64::from(onsets);
        loss += last(&simulation, "dissipated_normal") / f64::from(onsets);
        assert!(last(&simulation, "energy_residual") < 1e-12);
    }
    let struck = speed * arm;
    assert!((mean / ((1.0 + restitution) * struck) - 1.0).abs() < 3e-3, "{mean}");
    assert!((work / (mass() * (1.0 + restitution) * struck * struck) - 1.0).abs() < 3e-3, "{work}");
    let lost = 0.5 * mass() * (1.0 - restitution * restitution) * struck * struck;
    assert!((loss / lost - 1.0).abs() < 1e-2, "{loss} of {lost}");
}

/// Between the foot of a baffle and the rim, a disc has two contacts.
#[test]
fn a_disc_at_the_foot_has_two_contacts() {
    let mut config = baseline(1, 1);
    config.rotation.knots = vec![[0.0, 0.0]];
    // The baffle stands at the bottom; the disc lies beside it.
    config.drum.baffles[0].phase = -std::f64::consts::FRAC_PI_2;
    config.contact.drum.friction = 0.0;
    let angle = -std::f64::consts::FRAC_PI_2 + 0.25;
    let orbit = DRUM_RADIUS - RADIUS - 1e-4;
    let mut simulation = start(&config, single(polar(orbit, angle), [0.0, 0.0], 0.0));
    run(&mut simulation, 1.0);
    let features: Vec<u32> = simulation.contacts().walls.iter().map(|contact| contact.other).collect();
    assert_eq!(features.len(), 2, "{features:?}");
    assert_eq!(features[0], RIM);
    assert!(simulation.state().particles.velocities[0].norm() < 1e-4);
}

/// The torque of one baffle that lifts one bundle, from statics: all of the bundle's weight times its arm.
#[test]
fn a_lifted_bundle_gives_the_torque_of_its_weight() {
    let mut config = baseline(1, 3);
    config.rotation.knots = vec![[0.0, 0.5]];
    config.drum.baffles[0].phase = -1.0;
    let at = polar(DRUM_RADIUS - RADIUS - 2e-3, -1.0 + 0.25);
    let mut simulation = start(&config, single(at, [0.0, 0.0], 0.0));
    run(&mut simulation, 1.0);
    let value = |name| statistic(&simulation, name, 0.9, 1.0);
    let expected = mass() * GRAVITY * value("center_of_mass_x");
    assert!((value("drum_torque") / expected - 1.0).abs() < 0.02, "{} {expected}", value("drum_torque"));
}

#[test]
fn trapezoids_and_polygons_run_with_a_closed_ledger() {
    let points = vec![[0.0, 0.03], [0.03, 0.02], [0.03, 0.005], [0.06, 0.005], [0.06, -0.005], [0.0, -0.03]];
    for (shape, points) in [(BaffleShape::Trapezoid, None), (BaffleShape::Polygon, Some(points))] {
        let mut config = baseline(150, 4);
        config.drum.baffles[0].shape = shape;
        config.drum.baffles[0].points = points;
        let mut simulation = Simulation::new(config, 2, 1).unwrap();
        run(&mut simulation, 0.8);
        assert!(last(&simulation, "energy_residual") < 1e-11);
        assert!(last(&simulation, "baffle_4_work") != 0.0);
    }
}

#[test]
fn a_bundle_never_sits_inside_a_baffle() {
    let mut simulation = Simulation::new(baseline(150, 3), 5, 1).unwrap();
    for _ in 0..40 {
        run(&mut simulation, 0.02);
        let rotation = drumrs::physics::vector::Rotation::new(simulation.drum_angle());
        for &position in &simulation.state().particles.positions {
            let clearance = simulation.drum().clearance(rotation.apply_inverse(position));
            assert!(clearance > 0.97 * RADIUS, "{clearance}");
        }
    }
}

#[test]
fn unstable_runs_say_where_and_keep_saying_it() {
    let mut config = baseline(30, 0);
    config.load.start_speed = 400.0;
    let mut simulation = Simulation::new(config, 1, 1).unwrap();
    let error = simulation.run(100_000).unwrap_err();
    assert!(error.to_string().contains("step"), "{error}");
    assert!(error.to_string().contains("bundle"), "{error}");
    assert_eq!(simulation.run(1).unwrap_err(), error);
    assert_eq!(simulation.to_checkpoint().unwrap_err(), error);
}

#[test]
fn a_run_that_blows_up_is_not_finite() {
    // Springs so soft that a step is 10¹³⁸ s, in which gravity gives more speed than there are numbers.
    let mut config = free_space();
    config.contact.bundle.normal_stiffness = 1e-280;
    config.contact.drum.normal_stiffness = 1e-280;
    config.run.time_step = None;
    config.gravity = [0.0, -1e200];
    let mut simulation =
        start(&config, several(&[([0.0, 0.0], [0.0, 0.0], 0.0), ([1.0, 0.0], [0.0, 0.0], 0.0)]));
    let error = simulation.run(1_000_000).unwrap_err();
    let Error::NonFinite { incident } = &error else { panic!("{error}") };
    assert_eq!((incident.particle, incident.step), (0, 1));
    // Speed alone is no such thing.
    let mut simulation = start(&free_space(), single([0.0, 0.0], [1e308, 0.0], 0.0));
    let error = simulation.run(1_000_000).unwrap_err();
    assert!(matches!(error, Error::TooFast { .. }), "{error}");
}
