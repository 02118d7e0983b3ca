//! Friction and rolling: slip to roll, the incline, the spin-locked disc in a turning drum, a stack at rest,
//! co-rotation.

use crate::common::*;
use drumrs::physics::contact::parameters::Tension;
use drumrs::physics::vector::{Vec2, cross};

/// A floor whose contacts are stiff enough that the overlap under gravity hardly matters, and damped strongly.
fn calm_floor(gravity: [f64; 2]) -> drumrs::io::config::SimulationConfig {
    let mut config = floor(gravity);
    config.contact.drum.tension = Tension::Clipped;
    config.run.time_step = Some(1e-5);
    config
}

/// Height of a disc's center at rest on the floor.
fn rest_height(stiffness: f64, weight: f64) -> f64 {
    RADIUS - weight / stiffness
}

#[test]
fn a_sliding_disc_comes_to_roll_at_two_thirds_of_its_speed() {
    let config = calm_floor([0.0, -GRAVITY]);
    let (speed, friction) = (0.5, 0.5);
    let height = rest_height(9.70e7, mass() * GRAVITY);
    let mut simulation = start(&config, single([0.0, height], [speed, 0.0], 0.0));
    let time_to_roll = speed / (3.0 * friction * GRAVITY);
    run(&mut simulation, 0.95 * time_to_roll);
    let velocity = |s: &drumrs::simulation::Simulation| s.state().particles.velocities[0].x;
    let still_sliding = speed - friction * GRAVITY * simulation.time();
    assert!((velocity(&simulation) - still_sliding).abs() < 1e-3, "friction decelerates by μ g");
    assert!(velocity(&simulation) > speed * 2.0 / 3.0 * 1.01);
    run(&mut simulation, 0.3 * time_to_roll);
    assert!((velocity(&simulation) - speed * 2.0 / 3.0).abs() < 1e-3, "{}", velocity(&simulation));
    let spin = simulation.state().particles.angular_velocities[0];
    assert!((spin + speed * 2.0 / 3.0 / RADIUS).abs() < 0.2, "rolls without slip");
    run(&mut simulation, 0.1);
    let expected = mass() * speed * speed / 6.0;
    assert!((last(&simulation, "dissipated_sliding") / expected - 1.0).abs() < 0.01);
    assert!(last(&simulation, "energy_residual") < 1e-11);
}

/// On an incline of angle α (gravity turned by α) a disc rolls if μ ≥ tan α / 3, and then accelerates with
/// (2/3) g sin α; else it slides with g (sin α − μ cos α).
#[test]
fn the_incline() {
    for (degrees, friction) in [(20.0_f64, 0.5), (45.0, 0.4), (45.0, 0.2)] {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        let mut config = calm_floor([GRAVITY * sin, -GRAVITY * cos]);
        config.contact.drum.friction = friction;
        let height = rest_height(9.70e7, mass() * GRAVITY * cos);
        let mut simulation = start(&config, single([0.0, height], [0.0, 0.0], 0.0));
        run(&mut simulation, 0.2);
        let rolls = friction >= sin / cos / 3.0;
        let acceleration = if rolls { 2.0 / 3.0 * GRAVITY * sin } else { GRAVITY * (sin - friction * cos) };
        let seen = simulation.state().particles.velocities[0].x / simulation.time();
        assert!((seen / acceleration - 1.0).abs() < 2e-3, "{degrees}° μ {friction}: {seen}, {acceleration}");
    }
}

/// A disc that may not spin rests in a slowly turning smooth drum where gravity's pull along the rim equals μ N: at
/// θ = atan μ. The torque is m g R' sin θ with R' the radius of the contact point, here R; all power is sliding.
#[test]
fn a_spin_locked_disc_rests_at_the_friction_angle() {
    let mut config = baseline(1, 0);
    config.load.spin_locked = true;
    config.contact.drum.friction = 0.3;
    config.rotation.knots = vec![[0.0, 1.0]];
    let angle = libm::atan(0.3);
    let orbit = DRUM_RADIUS - RADIUS + mass() * GRAVITY * libm::cos(angle) / 9.70e7;
    let at = polar(orbit, angle - std::f64::consts::FRAC_PI_2);
    let mut simulation = start(&config, single(at, [0.0, 0.0], 0.0));
    run(&mut simulation, 0.5);
    let value = |name| statistic(&simulation, name, 0.1, 0.5);
    let position = simulation.state().particles.positions[0];
    let rests_at = libm::atan2(position.x, -position.y);
    assert!((rests_at - angle).abs() < 2e-3, "{rests_at} {angle}");
    let torque = mass() * GRAVITY * DRUM_RADIUS * libm::sin(angle);
    assert!((value("drum_torque") / torque - 1.0).abs() < 3e-3, "{} {torque}", value("drum_torque"));
    assert!((value("tangential_power") / value("drum_power") - 1.0).abs() < 3e-3);
    assert!(value("power_disagreement") < 1e-9, "{}", value("power_disagreement"));
    assert!(value("energy_residual") < 1e-11);
}

/// Without rolling resistance a free disc ends at the bottom, spinning with the rim; it takes no power. The drum is soft
/// here, so that the lever arm shows: contact is on the drum's surface, at r − δ from the center.
#[test]
fn a_free_disc_rests_at_the_bottom_spinning() {
    let mut config = baseline(1, 0);
    config.contact.drum.normal_stiffness = 1e4;
    config.run.time_step = Some(1.5e-5);
    config.rotation.knots = vec![[0.0, 2.0]];
    let overlap = mass() * GRAVITY / 1e4;
    let spin = 2.0 * DRUM_RADIUS / (RADIUS - overlap);
    let orbit = DRUM_RADIUS - RADIUS + overlap;
    let mut simulation = start(&config, single([0.0, -orbit], [0.0, 0.0], spin));
    run(&mut simulation, 2.0);
    let power = statistic(&simulation, "drum_specific_power", 1.0, 2.0);
    assert!(power.abs() < 1e-4, "{power}");
    let p = &simulation.state().particles;
    assert!(p.positions[0].x.abs() < 1e-4 && p.velocities[0].norm() < 1e-3, "{}", p.positions[0]);
    assert!((p.angular_velocities[0] / spin - 1.0).abs() < 1e-3, "{} {spin}", p.angular_velocities[0]);
}

#[test]
fn a_stack_at_rest_carries_its_weight() {
    let mut config = calm_floor([0.0, -GRAVITY]);
    config.run.time_step = Some(5e-6);
    let count = 5;
    let bundles: Vec<_> =
        (0..count).map(|k| ([0.0, RADIUS * (1.0 + 2.0 * f64::from(k))], [0.0, 0.0], 0.0)).collect();
    let mut simulation = start(&config, several(&bundles));
    run(&mut simulation, 0.2);
    let p = &simulation.state().particles;
    let heights: Vec<f64> = p.positions.iter().map(|position| position.y).collect();
    for level in 0..count as usize {
        let above = (count as usize - level) as f64 * mass() * GRAVITY;
        let (overlap, stiffness) = if level == 0 {
            (RADIUS - heights[0], 9.70e7)
        } else {
            (2.0 * RADIUS - (heights[level] - heights[level - 1]), 9.25e7)
        };
        assert!(
            (overlap * stiffness / above - 1.0).abs() < 1e-4,
            "level {level}: {}",
            overlap * stiffness / above
        );
    }
}

/// A disc on the rim and one upon it, carried rigidly with the drum and pressed outwards by the centrifugal force alone,
/// keep their tangential springs relaxed.
#[test]
fn co_rotation_leaves_the_springs_alone() {
    let speed = 30.0;
    let mut config = baseline(1, 0);
    config.gravity = [0.0, 0.0];
    config.rotation.knots = vec![[0.0, speed]];
    let carried = |orbit: f64| ([orbit, 0.0], [0.0, orbit * speed], speed);
    // At rest in the drum's frame: each spring holds the centrifugal force of what it carries.
    let centrifugal = |orbit: f64| mass() * orbit * speed * speed;
    let (mut outer, mut inner) = (DRUM_RADIUS - RADIUS, DRUM_RADIUS - 3.0 * RADIUS);
    for _ in 0..20 {
        outer = DRUM_RADIUS - RADIUS + (centrifugal(outer) + centrifugal(inner)) / 9.70e7;
        inner = outer - 2.0 * RADIUS + centrifugal(inner) / 9.25e7;
    }
    let mut simulation = start(&config, several(&[carried(outer), carried(inner)]));
    let load = centrifugal(inner);
    for _ in 0..10 {
        run(&mut simulation, 0.02);
        let contacts = simulation.contacts();
        assert_eq!(contacts.counts(), (1, 1));
        let outwards = simulation.state().particles.positions[0].normalize();
        for contact in contacts.pairs.iter().chain(&contacts.walls) {
            let force = Vec2::from(contact.force);
            let (pressed, held) = (force.dot(&outwards).abs(), cross(force, outwards));
            assert!(pressed > 0.99 * load, "{pressed} of {load}");
            assert!(held.abs() < 1e-6 * load, "{held} of {load}");
        }
    }
    assert_eq!(last(&simulation, "dissipated_sliding"), 0.0);
}

/// Beyond centrifuging a closed ring of bundles turns as a rigid body: neither dissipation nor mean torque is left.
#[test]
fn a_centrifuged_ring_takes_no_power() {
    let (count, speed) = (60, 25.0);
    let mut config = baseline(1, 0);
    // The ring is closed: bundles on the rim just touch their neighbors, and are pressed into each other a little.
    let half_angle = std::f64::consts::PI / f64::from(count);
    let orbit = RADIUS / libm::sin(half_angle) * (1.0 - 1e-4);
    config.drum.radius = Some(orbit + RADIUS);
    config.rotation.knots = vec![[0.0, speed]];
    let bundles: Vec<_> = (0..count)
        .map(|k| {
            let (sin, cos) = libm::sincos(f64::from(2 * k) * half_angle);
            ([orbit * cos, orbit * sin], [-orbit * sin * speed, orbit * cos * speed], speed)
        })
        .collect();
    let mut simulation = start(&config, several(&bundles));
    let turn = std::f64::consts::TAU / speed;
    run(&mut simulation, 8.05 * turn);
    let end = (8.0 * turn / 1e-3).round() * 1e-3;
    let value = |name| statistic(&simulation, name, end - 4.0 * turn, end);
    let scale = GRAVITY * orbit * speed * simulation.mass();
    for name in ["drum_power", "dissipated_normal_power", "dissipated_sliding_power"] {
        assert!(value(name).abs() < 1e-3 * scale, "{name}: {} of {scale}", value(name));
    }
}
