//! The eight impact tests of Chung & Ooi (Granular Matter 13 (2011) 643) in their disc form (I = m r²/2).
//!
//! Without damping and with kₛ/kₙ = 1/3 the spring swings along the tangent as fast as along the normal, since a disc's
//! tangential mass is m*/3. Then every impact has a closed form: with the slip s and the closing speed w before it, the
//! tangential impulse is ⅔ m* s, which turns the slip round, where that is below the impulse of sliding all the way,
//! 2 μ m* w; and else it is that.

use crate::common::{self, *};
use drumrs::io::config::SimulationConfig;
use drumrs::physics::vector::Vec2;
use drumrs::simulation::Simulation;
use drumrs::simulation::initial_state::InitialState;

const FRICTION: f64 = 0.15;
const CLOSING: f64 = 0.5;
/// Fine enough that a formula holds to 1e-3 of the speeds: an impact takes some 200 steps.
const FINE_STEP: f64 = TIME_STEP / 4.0;

fn elastic(mut config: SimulationConfig) -> SimulationConfig {
    for law in [&mut config.contact.bundle, &mut config.contact.drum] {
        law.restitution = Some(1.0);
        law.stiffness_ratio = 1.0 / 3.0;
        law.friction = FRICTION;
    }
    config.run.time_step = Some(FINE_STEP);
    config.run.sample_every = FINE_STEP;
    config
}

/// Runs through one impact; returns (greatest overlap, its duration in time).
fn watch(simulation: &mut Simulation) -> (f64, f64) {
    let (mut deepest, mut steps) = (0.0_f64, 0);
    for _ in 0..100_000 {
        simulation.run(1).unwrap();
        let contacts = simulation.contacts();
        let touching = contacts.pairs.iter().chain(&contacts.walls).next();
        match touching {
            Some(contact) => {
                deepest = deepest.max(contact.overlap);
                steps += 1;
            }
            None if steps > 0 => return (deepest, f64::from(steps) * simulation.time_step()),
            None => {}
        }
    }
    panic!("no impact");
}

/// Whether `value` is `expected` within 1e-3 of `scale`.
fn close(value: f64, expected: f64, scale: f64) -> bool {
    (value - expected).abs() < 1e-3 * scale
}

/// J / m*: the tangential impulse over the effective mass.
fn tangential_impulse(slip: f64, closing: f64) -> f64 {
    (2.0 / 3.0 * slip.abs()).min(2.0 * FRICTION * closing).copysign(slip)
}

/// Test 1: Two equal bodies head on: a half sine of the springs, and the speeds change places.
#[test]
fn two_bodies_exchange_their_speeds() {
    let config = elastic(free_space());
    let half = RADIUS + 1e-6;
    let bodies = [([-half, 0.0], [1.25, 0.0], 0.0), ([half, 0.0], [-0.25, 0.0], 0.0)];
    let mut simulation = start(&config, several(&bodies));
    let (deepest, duration) = watch(&mut simulation);
    let frequency = (9.25e7 / (0.5 * mass())).sqrt();
    assert!(close(deepest * frequency, 1.5, 1.5), "{deepest}");
    assert!((duration - std::f64::consts::PI / frequency).abs() < 1.5 * FINE_STEP, "{duration}");
    let velocities = &simulation.state().particles.velocities;
    assert!(close(velocities[0].x, -0.25, 1.5) && close(velocities[1].x, 1.25, 1.5), "{velocities:?}");
    assert!(velocities[0].y == 0.0 && velocities[1].y == 0.0);
}

/// Test 2: A body head on against a wall.
#[test]
fn a_wall_gives_the_speed_back() {
    let config = elastic(floor([0.0, 0.0]));
    let mut simulation = start(&config, single([0.0, RADIUS + 1e-6], [0.0, -1.5], 0.0));
    let (deepest, duration) = watch(&mut simulation);
    let frequency = (9.70e7 / mass()).sqrt();
    assert!(close(deepest * frequency, 1.5, 1.5), "{deepest}");
    assert!((duration - std::f64::consts::PI / frequency).abs() < 1.5 * FINE_STEP, "{duration}");
    assert!(close(simulation.state().particles.velocities[0].y, 1.5, 1.5));
}

/// Test 3: A body head on against a wall, with every restitution. A single onset within a step errs in first order, so the
/// mean over onsets is held against the formula.
#[test]
fn restitutions_from_a_tenth_to_one() {
    let mut config = floor([0.0, 0.0]);
    config.run.time_step = Some(FINE_STEP);
    for tenths in 1..=10 {
        let restitution = f64::from(tenths) / 10.0;
        config.contact.drum.restitution = Some(restitution);
        let onsets = 24;
        let rebound = |k: i32| {
            let gap = (1.0 + (f64::from(k) + 0.5) / f64::from(onsets)) * FINE_STEP;
            let mut simulation = start(&config, single([0.0, RADIUS + gap], [0.0, -1.0], 0.0));
            watch(&mut simulation);
            simulation.state().particles.velocities[0].y
        };
        let mean = (0..onsets).map(rebound).sum::<f64>() / f64::from(onsets);
        assert!(close(mean, restitution, 1.0), "{mean} for {restitution}");
    }
}

/// At Table 1's step, some 50 to a collision, the mean over all moments of first touch within a step.
#[test]
fn restitution_at_table_1s_step_is_a_tenth() {
    let phases = 64;
    let phase = |k: u32| (f64::from(k) + 0.5) / f64::from(phases);
    let mean =
        |rebound: &dyn Fn(f64) -> f64| (0..phases).map(phase).map(rebound).sum::<f64>() / f64::from(phases);
    let of_pair = mean(&|phase| {
        let half = RADIUS + 0.5 * (1.0 + phase) * TIME_STEP;
        let bodies = [([-half, 0.0], [0.5, 0.0], 0.0), ([half, 0.0], [-0.5, 0.0], 0.0)];
        let mut simulation = start(&free_space(), several(&bodies));
        watch(&mut simulation);
        let velocities = &simulation.state().particles.velocities;
        velocities[1].x - velocities[0].x
    });
    let of_wall = mean(&|phase| {
        let height = RADIUS + (1.0 + phase) * TIME_STEP;
        let mut simulation = start(&floor([0.0, 0.0]), single([0.0, height], [0.0, -1.0], 0.0));
        watch(&mut simulation);
        simulation.state().particles.velocities[0].y
    });
    for mean in [of_pair, of_wall] {
        assert!((mean - 0.1).abs() < 0.001, "{of_pair} {of_wall}");
    }
}

/// Against a floor with the given velocity and spin; holds the rebound against the closed form.
fn against_the_floor(tangential: f64, normal: f64, spin: f64) {
    let config = elastic(floor([0.0, 0.0]));
    let mut simulation = start(&config, single([0.0, RADIUS + 1e-6], [tangential, -normal], spin));
    watch(&mut simulation);
    simulation.run(4).unwrap();
    let slip = tangential + RADIUS * spin;
    let impulse = tangential_impulse(slip, normal);
    let scale = normal + slip.abs();
    let (velocity, seen_spin) =
        (simulation.state().particles.velocities[0], simulation.state().particles.angular_velocities[0]);
    let case = format!("v_t {tangential}, v_n {normal}, spin {spin}: {velocity}, {seen_spin}");
    assert!(close(velocity.y, normal, scale), "{case}");
    assert!(close(velocity.x, tangential - impulse, scale), "{case}");
    assert!(close(RADIUS * seen_spin, RADIUS * spin - 2.0 * impulse, 2.0 * scale), "{case}");
    // Sliding takes the tangential work, to the truncation of a spring at the end of the impact.
    let loss = mass() * (impulse * slip - 1.5 * impulse * impulse);
    assert!(close(last(&simulation, "dissipated_sliding"), loss, mass() * scale * scale), "{case}");
    assert!(last(&simulation, "energy_residual") < 1e-12);
}

/// Test 4: One speed at 5 … 85° from the normal.
#[test]
fn oblique_impacts_at_every_angle() {
    for degrees in (5..=85).step_by(5) {
        let (sin, cos) = libm::sincos(f64::from(degrees).to_radians());
        against_the_floor(sin, cos, 0.0);
        against_the_floor(-sin, cos, 0.0);
    }
}

/// Test 5: One closing speed, tangential speeds from sticking to sliding.
#[test]
fn tangential_speeds_from_sticking_to_sliding() {
    for factor in [0.0, 0.5, 2.9, 3.1, 4.0, 5.9, 6.1, 20.0] {
        against_the_floor(factor * FRICTION * CLOSING, CLOSING, 0.0);
    }
}

/// Test 6: One closing speed, spins from sticking to sliding.
#[test]
fn spins_from_sticking_to_sliding() {
    for factor in [-20.0, -4.0, -1.0, 0.5, 2.9, 3.1, 6.1, 20.0] {
        against_the_floor(0.0, CLOSING, factor * FRICTION * CLOSING / RADIUS);
        against_the_floor(0.1, CLOSING, factor * FRICTION * CLOSING / RADIUS);
    }
}

/// Two bodies of the given radii, meeting along an inclined normal with the given spins.
fn of_two_bodies(radii: [f64; 2], spins: [f64; 2]) {
    let mut config = elastic(free_space());
    let (sin, cos) = libm::sincos(0.3);
    let (normal, tangent) = (Vec2::new(cos, sin), Vec2::new(-sin, cos));
    let half_gap = normal * (0.5 * (radii[0] + radii[1]) + 5e-7);
    let velocities = [normal * (0.6 * CLOSING), normal * (-0.4 * CLOSING)];
    let initial = InitialState {
        positions: vec![-half_gap, half_gap],
        velocities: Some(velocities.to_vec()),
        angular_velocities: Some(spins.to_vec()),
        radii: Some(radii.to_vec()),
        ..InitialState::default()
    };
    // The lightest body sets the pace.
    let lightest = radii[0].min(radii[1]) / RADIUS;
    config.run.time_step = Some(FINE_STEP * lightest);
    config.run.sample_every = FINE_STEP * lightest;
    let mut simulation = start(&config, initial);
    watch(&mut simulation);
    simulation.run(4).unwrap();
    let p = &simulation.state().particles;
    let masses = [p.masses[0], p.masses[1]];
    let effective = masses[0] * masses[1] / (masses[0] + masses[1]);
    // The surfaces meet with v·t from both spins; what drags body 1 along +t drags body 2 along −t.
    let slip = -(radii[0] * spins[0] + radii[1] * spins[1]);
    let tangential = effective * tangential_impulse(slip, CLOSING);
    let along = 2.0 * effective * CLOSING;
    let scale = CLOSING + slip.abs();
    for (body, sign) in [(0, 1.0), (1, -1.0)] {
        let expected = velocities[body] + (tangent * tangential - normal * along) * (sign / masses[body]);
        let seen = p.velocities[body];
        let share = effective / masses[body];
        assert!(
            (seen - expected).norm() < 1e-3 * scale * 2.0 * share,
            "{radii:?} {spins:?}: {seen} {expected}"
        );
        let spin = spins[body] + 2.0 * tangential / (masses[body] * radii[body]);
        let reached = p.angular_velocities[body];
        assert!(close(reached * radii[body], spin * radii[body], 4.0 * scale * share), "{reached} {spin}");
    }
    assert!(last(&simulation, "energy_residual") < 1e-12);
}

/// Test 7: Two equal bodies with varied spins.
#[test]
fn equal_bodies_with_spins() {
    for spin in [-200.0, -30.0, 2.0, 9.0, 60.0] {
        of_two_bodies([RADIUS, RADIUS], [spin, spin]);
        of_two_bodies([RADIUS, RADIUS], [spin, 0.0]);
        // Like two wheels geared together: no slip.
        of_two_bodies([RADIUS, RADIUS], [spin, -spin]);
    }
}

/// Test 8: Two unequal bodies with varied spins.
#[test]
fn unequal_bodies_with_spins() {
    for spin in [-200.0, -30.0, 2.0, 9.0, 60.0] {
        of_two_bodies([RADIUS, 0.4 * RADIUS], [spin, spin]);
        of_two_bodies([0.3 * RADIUS, RADIUS], [0.0, spin]);
    }
}

/// With kₛ = kₙ the tangential spring swings √3 times as fast as the normal one: the bodies part while it is stretched,
/// and what it holds then is lost to sliding.
#[test]
fn a_spring_still_stretched_at_the_end_is_lost() {
    let mut config = elastic(floor([0.0, 0.0]));
    config.contact.drum.stiffness_ratio = 1.0;
    config.contact.drum.friction = 1e4;
    config.run.time_step = Some(FINE_STEP / 8.0);
    // Gently, for the lever arm r − δ changes the tangential mass.
    let speed = 0.02;
    let mut simulation = start(&config, single([0.0, RADIUS + 1e-7], [speed, -0.1], 0.0));
    watch(&mut simulation);
    simulation.run(64).unwrap();
    let (sin, cos) = libm::sincos(3.0_f64.sqrt() * std::f64::consts::PI);
    let p = &simulation.state().particles;
    let slip = p.velocities[0].x + RADIUS * p.angular_velocities[0];
    assert!((slip - speed * cos).abs() < 0.01 * speed, "{slip}");
    let lost = mass() * speed * speed / 6.0 * sin * sin;
    assert!((last(&simulation, "dissipated_sliding") / lost - 1.0).abs() < 0.02, "{lost}");
}

/// Of the step in which two bodies meet, only the part after first touch stretches the spring.
#[test]
fn a_step_before_first_touch_does_not_stretch_the_spring() {
    let law = linear_law(&common::law(9.25e7));
    let stretch = |overlap, last| respond(&law, overlap, [4e-6, 1e-8], last).1.tangential_displacement;
    assert_eq!(stretch(1e-6, [0.0; 2]), 0.25 * 1e-8);
    assert_eq!(stretch(4e-6, [0.0; 2]), 1e-8);
    assert_eq!(stretch(5e-6, [1e-6, 2e-8]), 2e-8 + 1e-8);
}
