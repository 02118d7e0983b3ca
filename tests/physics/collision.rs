//! Single damped impacts: restitution with and without tension, its convergence, conservation, gross sliding.
//!
//! Formulas for discs (I = m r²/2). Source of the clipped restitution: Schwager & Pöschel, Granular Matter 9 (2007) 465.

use crate::common::{self, *};
use drumrs::physics::contact::law::ContactLaw;
use drumrs::physics::contact::linear::{Linear, SpringHistory};
use drumrs::physics::contact::parameters::{ContactParameters, Tension};
use drumrs::physics::vector::cross;
use drumrs::simulation::Simulation;

/// Head-on impact of two bundles; returns the ratio of the speeds after and before. `phase` in [0, 1) says where
/// within a step they first touch.
fn restitution(phase: f64, time_step: f64, damping_ratio: Option<f64>, tension: Tension) -> f64 {
    let mut config = free_space();
    config.run.time_step = Some(time_step);
    config.contact.bundle.tension = tension;
    if let Some(ratio) = damping_ratio {
        let stiffness = config.contact.bundle.normal_stiffness;
        config.contact.bundle.restitution = None;
        config.contact.bundle.normal_damping = Some(2.0 * ratio * (stiffness * 0.5 * mass()).sqrt());
    }
    let speed = 1.0;
    let gap = (3.0 + phase) * speed * time_step;
    let half = RADIUS + 0.5 * gap;
    let mut simulation =
        start(&config, several(&[([-half, 0.0], [0.5, 0.0], 0.0), ([half, 0.0], [-0.5, 0.0], 0.0)]));
    run_through_contact(&mut simulation, 100_000);
    let velocities = &simulation.state().particles.velocities;
    velocities[1].x - velocities[0].x
}

fn mean_restitution(time_step: f64, tension: Tension, ratio: Option<f64>) -> f64 {
    let phases = 400;
    let phase = |k| (f64::from(k) + 0.5) / f64::from(phases);
    (0..phases).map(|k| restitution(phase(k), time_step, ratio, tension)).sum::<f64>() / f64::from(phases)
}

#[test]
fn restitution_at_table_1s_time_step_is_within_one_per_cent() {
    let mean = mean_restitution(TIME_STEP, Tension::Allowed, None);
    // A dashpot that saw the half-step velocity would give 0.092.
    assert!((mean - 0.1).abs() < 0.001, "{mean}");
}

#[test]
fn mean_restitution_converges_with_second_order() {
    let error = |divisor: f64| mean_restitution(TIME_STEP / divisor, Tension::Allowed, None) - 0.1;
    // Over four halvings: from one to the next the number of steps in a contact makes the order wobble round 2.
    let errors = [error(0.5), error(8.0)];
    let order = (errors[0] / errors[1]).abs().log2() / 4.0;
    assert!(order > 1.85 && order < 2.3, "order {order} from errors {errors:?}");
}

#[test]
fn clipped_restitution_meets_schwager_and_poschel() {
    for (ratio, expected) in [(0.1, 0.7441), (0.3, 0.4510), (0.6, 0.2488), (0.8, 0.1798)] {
        let mean = mean_restitution(0.25 * TIME_STEP, Tension::Clipped, Some(ratio));
        assert!((mean - expected).abs() < 0.002, "damping ratio {ratio}: {mean}, expected {expected}");
    }
}

#[test]
fn prescribed_restitution_is_met_with_either_tension() {
    for tension in [Tension::Allowed, Tension::Clipped] {
        for restitution in [0.1, 0.5, 0.9] {
            let mut config = free_space();
            config.contact.bundle.tension = tension;
            config.contact.bundle.restitution = Some(restitution);
            config.run.time_step = None;
            let mean = (0..40).map(|k| head_on(&config, f64::from(k) / 40.0)).sum::<f64>() / 40.0;
            assert!((mean - restitution).abs() < 0.002, "{tension:?}: {mean}, expected {restitution}");
        }
    }
}

fn head_on(config: &drumrs::io::config::SimulationConfig, phase: f64) -> f64 {
    let half = RADIUS + 0.5 * (3.0 + phase) * TIME_STEP;
    let mut simulation =
        start(config, several(&[([-half, 0.0], [0.5, 0.0], 0.0), ([half, 0.0], [-0.5, 0.0], 0.0)]));
    run_through_contact(&mut simulation, 100_000);
    let velocities = &simulation.state().particles.velocities;
    velocities[1].x - velocities[0].x
}

/// With either tension: where the force is clipped, the dashpot takes what the relaxing spring still holds.
#[test]
fn normal_dissipation_is_the_energy_that_restitution_takes() {
    for (tension, restitution) in [(Tension::Allowed, 0.1), (Tension::Clipped, 0.1), (Tension::Clipped, 0.5)]
    {
        let mut config = free_space();
        config.contact.bundle.tension = tension;
        config.contact.bundle.restitution = Some(restitution);
        config.run.time_step = Some(TIME_STEP / 2.0);
        config.run.sample_every = TIME_STEP;
        let mut total = 0.0;
        for k in 0..50 {
            let half = RADIUS + 0.5 * (3.0 + (f64::from(k) + 0.5) / 50.0) * TIME_STEP / 2.0;
            let mut simulation =
                start(&config, several(&[([-half, 0.0], [0.5, 0.0], 0.0), ([half, 0.0], [-0.5, 0.0], 0.0)]));
            run_through_contact(&mut simulation, 10_000);
            simulation.run(4).unwrap();
            assert!(last(&simulation, "energy_residual") < 1e-13);
            assert_eq!(last(&simulation, "dissipated_sliding"), 0.0);
            total += last(&simulation, "dissipated_normal") / 50.0;
        }
        let expected = 0.5 * (0.5 * mass()) * (1.0 - restitution * restitution);
        assert!((total / expected - 1.0).abs() < 0.004, "{tension:?} {restitution}: {total} of {expected}");
    }
}

/// Along the tangent the account closes in every step by itself: the work of the mean force is what the spring gains
/// and what sliding takes.
#[test]
fn friction_accounts_for_its_own_work() {
    let law = linear_law(&common::law(9.25e7));
    for (stretch, slip) in
        [(0.0, 3e-7), (4e-7, 3e-7), (4.9e-7, 5e-8), (5e-7, -2e-7), (-5e-7, -4e-7), (2e-7, 1e-8)]
    {
        let before = SpringHistory { tangential_displacement: stretch };
        let (response, after) = respond(&law, 1e-6, [0.0, slip], [1e-6, stretch]);
        let work = 0.5 * (law.tangential_stiffness * stretch + response.tangential_force) * slip;
        let [held, holds] = [before, after].map(|history| Linear::<true>::stored(&law, 1e-6, &history));
        let left =
            work - (holds.elastic_tangential - held.elastic_tangential) - response.flows.dissipated_sliding;
        assert!(left.abs() < 1e-12 * held.elastic_normal);
    }
}

/// Where friction ends within a step, as when the force that presses is clipped to nothing, the spring's last stretch is lost. Slip
/// against it, and beyond, brings none of it back.
#[test]
fn sliding_never_gives_energy() {
    let law = linear_law(&ContactParameters { friction: 0.0, ..common::law(9.25e7) });
    for (stretch, slip) in [(5e-7, -8e-7), (-5e-7, 8e-7), (5e-7, -3e-7), (5e-7, 3e-7)] {
        let (response, after) = respond(&law, 1e-6, [0.0, slip], [1e-6, stretch]);
        assert_eq!(after.tangential_displacement, 0.0);
        let taken = response.flows.dissipated_sliding;
        assert!(taken >= 0.0, "{stretch} {slip}: {taken}");
    }
}

/// Momentum (x, y) and angular momentum.
fn momenta(simulation: &Simulation) -> [f64; 3] {
    let p = &simulation.state().particles;
    let momentum =
        (0..p.len()).fold(nalgebra::Vector2::zeros(), |sum, i| sum + p.velocities[i] * p.masses[i]);
    let angular = (0..p.len()).fold(0.0, |sum, i| {
        sum + p.masses[i] * cross(p.positions[i], p.velocities[i]) + p.inertias[i] * p.angular_velocities[i]
    });
    [momentum.x, momentum.y, angular]
}

#[test]
fn pairs_conserve_momentum_and_angular_momentum() {
    for radii in [vec![RADIUS, RADIUS], vec![RADIUS, 0.4 * RADIUS]] {
        for spins in [[0.0, 0.0], [50.0, -20.0], [-300.0, 100.0]] {
            let reach = radii[0] + radii[1];
            let mut initial = several(&[
                ([0.1, 0.1], [0.7, -0.2], spins[0]),
                ([0.1 + 1.001 * reach, 0.1 + 0.3 * reach], [-0.6, 0.3], spins[1]),
            ]);
            initial.radii = Some(radii.clone());
            let mut config = free_space();
            config.run.time_step = Some(TIME_STEP / 4.0);
            let mut simulation = start(&config, initial);
            let before = momenta(&simulation);
            run_through_contact(&mut simulation, 100_000);
            let after = momenta(&simulation);
            for (one, other) in before.iter().zip(after) {
                assert!((one - other).abs() < 1e-13, "{before:?} {after:?}");
            }
        }
    }
}

/// What an oblique impact on a wall leaves: (tangential velocity, spin, energy lost to sliding), averaged over phases.
fn oblique(normal_speed: f64, tangential_speed: f64, tension: Tension) -> [f64; 3] {
    let mut config = floor([0.0, 0.0]);
    config.contact.drum.tension = tension;
    config.contact.drum.restitution = None;
    config.contact.drum.normal_damping = Some(7.74e3);
    config.contact.drum.friction = 0.1;
    config.run.time_step = Some(TIME_STEP / 4.0);
    config.run.sample_every = TIME_STEP;
    let phases = 20;
    let mut mean = [0.0; 3];
    for k in 0..phases {
        let height = RADIUS + (3.0 + f64::from(k) / f64::from(phases)) * normal_speed * TIME_STEP;
        let initial = single([0.0, height], [tangential_speed, -normal_speed], 0.0);
        let mut simulation = start(&config, initial);
        run_through_contact(&mut simulation, 100_000);
        simulation.run(8).unwrap();
        let p = &simulation.state().particles;
        let seen = [p.velocities[0].x, p.angular_velocities[0], last(&simulation, "dissipated_sliding")];
        for (sum, value) in mean.iter_mut().zip(seen) {
            *sum += value / f64::from(phases);
        }
    }
    mean
}

#[test]
fn oblique_impact_in_gross_sliding() {
    let ratio = 7.74e3 / (2.0 * (9.70e7 * mass()).sqrt());
    let wild = (1.0 - ratio * ratio).sqrt();
    let clipped = libm::exp(-(ratio / wild) * (std::f64::consts::PI - 2.0 * libm::asin(ratio)));
    let allowed = libm::exp(-std::f64::consts::PI * ratio / wild);
    // With tension, friction acts on |F_n| in the pulling phase too.
    for (tension, impulse) in
        [(Tension::Clipped, 1.0 + clipped), (Tension::Allowed, 1.0 + 2.0 * clipped - allowed)]
    {
        let (friction, normal_speed, tangential_speed) = (0.1, 0.5, 5.0);
        let [tangential, spin, loss] = oblique(normal_speed, tangential_speed, tension);
        let change = friction * impulse * normal_speed;
        assert!((tangential_speed - tangential - change).abs() < 0.01 * change, "{tension:?} {tangential}");
        // The floor drags the disc's lower side back: it spins clockwise while moving to the right.
        assert!((spin + 2.0 * change / RADIUS).abs() < 0.015 * 2.0 * change / RADIUS, "{tension:?} {spin}");
        let expected = mass() * change * (tangential_speed - 1.5 * change);
        assert!((loss / expected - 1.0).abs() < 0.015, "{tension:?} {loss} {expected}");
    }
}
