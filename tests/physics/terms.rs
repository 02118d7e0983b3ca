//! The terms beside the base law: rolling resistance, tangential dashpot, adhesion; alone, where a formula says what comes,
//! and all at once, where the promises must hold.
//!
//! Formulas for discs (I = m r²/2); what the scheme leaves of them is derived in `drumrs verify`.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::common::*;
use drumrs::io::config::{PairLaw, SimulationConfig, WallLaw};
use drumrs::observe::recorder::contact_energies;
use drumrs::physics::contact::adhesion::Adhesion;
use drumrs::physics::contact::law::{BodyPair, ContactLaw};
use drumrs::physics::contact::linear::{Linear, SpringHistory};
use drumrs::physics::contact::model::Model;
use drumrs::physics::contact::parameters::{ContactParameters, Tension};
use drumrs::physics::contact::{ContactState, Kinematics, RelativeMotion};
use drumrs::simulation::Simulation;
use drumrs::simulation::initial_state::InitialState;

const WALL: f64 = 9.70e7;
/// Friction that does not yield.
const STICKS: f64 = 2.0;

fn weight() -> f64 {
    mass() * GRAVITY
}

/// A floor with rolling resistance, under gravity turned by an angle.
fn rolling_floor(rolling: f64, slope: f64) -> SimulationConfig {
    let (sin, cos) = libm::sincos(slope);
    let mut config = floor([GRAVITY * sin, -GRAVITY * cos]);
    config.contact.drum.rolling_friction = rolling;
    config.contact.drum.friction = STICKS;
    config.run.time_step = Some(1e-5);
    config
}

#[test]
fn rolling_friction_stops_a_disc() {
    let (rolling, speed) = (0.2, 0.5);
    let overlap = weight() / WALL;
    let initial = single([0.0, RADIUS - overlap], [speed, 0.0], -speed / (RADIUS - overlap));
    let mut simulation = start(&rolling_floor(rolling, 0.0), initial);
    let stop = 1.5 * speed / (rolling * GRAVITY);
    run(&mut simulation, 0.5 * stop);
    let velocity = simulation.state().particles.velocities[0].x;
    assert!((velocity / (0.5 * speed) - 1.0).abs() < 1e-3, "decelerates by ⅔ μ_r g: {velocity}");
    run(&mut simulation, 0.7 * stop);
    let p = &simulation.state().particles;
    assert!((p.positions[0].x / (0.5 * speed * stop) - 1.0).abs() < 1e-3, "{}", p.positions[0].x);
    assert!(p.velocities[0].norm() < 3e-4, "{}", p.velocities[0]);
    let loss = last(&simulation, "dissipated_rolling") / (0.75 * mass() * speed * speed);
    assert!((loss - 1.0).abs() < 1e-3, "{loss}");
    for none in ["dissipated_sliding", "dissipated_tangential", "adhesion"] {
        assert_eq!(last(&simulation, none), 0.0, "{none}");
    }
    assert!(last(&simulation, "energy_residual") < 1e-11);
}

#[test]
fn a_disc_rests_on_a_slope_up_to_its_rolling_friction() {
    let rolling = 0.2;
    for degrees in [5.0_f64, 11.0, 11.6, 15.0, 30.0] {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        let config = rolling_floor(rolling, degrees.to_radians());
        let initial = single([0.0, RADIUS - weight() * cos / WALL], [0.0, 0.0], 0.0);
        let mut simulation = start(&config, initial);
        run(&mut simulation, 0.1);
        let seen = simulation.state().particles.velocities[0].x / simulation.time();
        let expected = (2.0 / 3.0 * GRAVITY * (sin - rolling * cos)).max(0.0);
        // Springs that start relaxed swing at g sin α/ω at most.
        assert!((seen - expected).abs() < GRAVITY * sin * 2e-3, "{degrees}°: {seen}, {expected}");
    }
}

/// tan θ = μᵣ, torque m g (R − r) sin θ; what the drum gives, rolling takes.
#[test]
fn rolling_friction_holds_a_disc_up_in_a_turning_drum() {
    let mut config = baseline(1, 0);
    let rolling = 0.3;
    config.contact.drum.rolling_friction = rolling;
    config.contact.drum.friction = STICKS;
    config.rotation.knots = vec![[0.0, 1.0]];
    let angle = libm::atan(rolling);
    let overlap = weight() * libm::cos(angle) / WALL;
    let at = polar(DRUM_RADIUS - RADIUS + overlap, angle - FRAC_PI_2);
    let mut simulation = start(&config, single(at, [0.0, 0.0], DRUM_RADIUS / (RADIUS - overlap)));
    run(&mut simulation, 0.5);
    let position = simulation.state().particles.positions[0];
    assert!((libm::atan2(position.x, -position.y) - angle).abs() < 1e-3);
    let value = |name| statistic(&simulation, name, 0.1, 0.5);
    let torque = weight() * (DRUM_RADIUS - RADIUS) * libm::sin(angle);
    assert!((value("drum_torque") / torque - 1.0).abs() < 1e-3, "{} {torque}", value("drum_torque"));
    let share = last(&simulation, "dissipated_rolling") / last(&simulation, "drum_work");
    assert!((share - 1.0).abs() < 1e-3, "{share}");
    assert!(value("power_disagreement") < 1e-9 && value("energy_residual") < 1e-11);
}

/// A disc that neither slides nor rolls swings in two modes, ω² = ½ (5 ∓ √17) kₛ/m, as kᵣ = kₛ r².
#[test]
fn a_stuck_disc_swings_in_its_two_modes() {
    for sign in [-1.0, 1.0] {
        let square = 0.5 * (5.0 + sign * 17.0_f64.sqrt());
        let (frequency, share) = ((square * WALL / mass()).sqrt(), square - 1.0);
        let speed = 1e-9 * frequency;
        let mut config = rolling_floor(0.5, 0.0);
        config.run.time_step = Some(TIME_STEP / 4.0);
        let initial = single([0.0, RADIUS - weight() / WALL], [speed, 0.0], share * speed / RADIUS);
        let mut simulation = start(&config, initial);
        for quarter in 1..=24 {
            let steps = (f64::from(quarter) * FRAC_PI_2 / frequency / simulation.time_step()).round() as u64;
            simulation.run(steps - simulation.state().step).unwrap();
            let p = &simulation.state().particles;
            let expected = speed * libm::cos(frequency * simulation.time());
            assert!((p.velocities[0].x - expected).abs() < 5e-3 * speed, "{quarter}: {}", p.velocities[0].x);
            let spin = p.angular_velocities[0] * RADIUS / share;
            assert!((spin - expected).abs() < 5e-3 * speed, "{quarter}: {spin} {expected}");
        }
        assert_eq!(last(&simulation, "dissipated_rolling"), 0.0);
    }
}

/// The slip of two discs that adhesion holds together, after `count` half waves over that at the start.
fn slip_after(ratio: f64, count: u32) -> f64 {
    let mut config = free_space();
    let law = &mut config.contact.bundle;
    (law.adhesion, law.tangential_damping_ratio) = (4.0, ratio);
    config.run.time_step = Some(TIME_STEP / 16.0);
    let half = RADIUS - 0.5 * 4.0 / 9.25e7;
    let spin = 5e-3;
    let mut simulation =
        start(&config, several(&[([-half, 0.0], [0.0; 2], spin), ([half, 0.0], [0.0; 2], spin)]));
    let frequency = (3.0 * 9.25e7 / (0.5 * mass()) * (1.0 - ratio * ratio)).sqrt();
    simulation.run((f64::from(count) * PI / frequency / simulation.time_step()).round() as u64).unwrap();
    let p = &simulation.state().particles;
    let along = p.velocities[1].y - p.velocities[0].y;
    (half * (p.angular_velocities[0] + p.angular_velocities[1]) - along) / (2.0 * half * spin)
}

#[test]
fn slip_swings_out_by_the_decrement_of_the_damping_ratio() {
    for ratio in [0.0, 0.05, 0.2, 0.5] {
        let decrement = PI * ratio / (1.0 - ratio * ratio).sqrt();
        for count in [1, 2] {
            let (seen, sign) = (slip_after(ratio, count), if count == 1 { -1.0 } else { 1.0 });
            let expected = sign * libm::exp(-f64::from(count) * decrement);
            // Half a step of the phase at most, and θ² of the decrement.
            assert!((seen - expected).abs() < 6e-3, "ζ {ratio}, {count}: {seen}, {expected}");
        }
    }
}

/// With kₛ/kₙ = 1/3 and the same damping ratio both half waves end together, and the slip turns round by the restitution.
#[test]
fn an_impact_that_sticks_has_the_restitution_of_its_dashpot() {
    for ratio in [0.1, 0.3] {
        let mut config = floor([0.0, 0.0]);
        let law = &mut config.contact.drum;
        (law.restitution, law.normal_damping) = (None, Some(2.0 * ratio * (WALL * mass()).sqrt()));
        (law.stiffness_ratio, law.friction, law.tangential_damping_ratio) = (1.0 / 3.0, 1e6, ratio);
        config.run.time_step = Some(TIME_STEP / 4.0);
        let mean = (0..40).map(|k| {
            let gap = (1.0 + f64::from(k) / 40.0) * 0.01 * TIME_STEP / 4.0;
            let mut simulation = start(&config, single([0.0, RADIUS + gap], [0.01, -0.01], 0.0));
            run_through_contact(&mut simulation, 100_000);
            let p = &simulation.state().particles;
            (p.velocities[0].x + RADIUS * p.angular_velocities[0]) / 0.01 / 40.0
        });
        let (mean, expected) = (mean.sum::<f64>(), -libm::exp(-PI * ratio / f64::sqrt(1.0 - ratio * ratio)));
        assert!((mean - expected).abs() < 2e-3, "ζ {ratio}: {mean}, {expected}");
    }
}

#[test]
fn a_disc_hangs_where_its_adhesion_carries_it() {
    for share in [0.9, 0.999, 1.001, 1.5, 3.0] {
        let mut config = baseline(1, 0);
        config.rotation.knots = vec![[0.0, 0.0]];
        config.contact.drum.adhesion = share * weight();
        let overlap = if share > 1.0 { share - 1.0 } else { 0.05 } * weight() / WALL;
        let top = DRUM_RADIUS - RADIUS;
        let mut simulation = start(&config, single([0.0, top + overlap], [0.0, 0.0], 0.0));
        run(&mut simulation, 0.03);
        let seen = (simulation.state().particles.positions[0].y - top) * WALL / weight();
        if share > 1.0 {
            assert!((seen - (share - 1.0)).abs() < 1e-6, "{share}: {seen}");
        } else {
            assert_eq!(simulation.contacts().counts(), (0, 0), "{share} of its weight");
            assert_eq!(last(&simulation, "adhesion"), 0.0);
        }
    }
}

/// The potential of the pull is −`F_c` δ: an elastic impact keeps its speed, and nothing is left once it is over. A damped one
/// may stay, with the overlap `F_c`/k.
#[test]
fn adhesion_gives_back_what_it_took() {
    let speed = 0.5;
    for tension in [Tension::Allowed, Tension::Clipped] {
        let mut config = floor([0.0, 0.0]);
        config.contact.drum.tension = tension;
        config.contact.drum.adhesion = (WALL * mass()).sqrt() * speed;
        config.run.time_step = Some(TIME_STEP / 16.0);
        config.run.sample_every = TIME_STEP / 16.0;
        let fall = || single([0.0, RADIUS + 1e-7], [0.0, -speed], 0.0);
        let mut caught = start(&config, fall());
        run(&mut caught, 5e-3);
        let overlap = config.contact.drum.adhesion / WALL;
        assert!(((RADIUS - caught.state().particles.positions[0].y) / overlap - 1.0).abs() < 1e-6);
        let held = -0.5 * WALL * overlap * overlap;
        let seen = last(&caught, "elastic_normal") + last(&caught, "adhesion");
        assert!((seen / held - 1.0).abs() < 1e-9, "{tension:?}");
        let loss = 0.5 * mass() * speed * speed - held;
        assert!((last(&caught, "dissipated_normal") / loss - 1.0).abs() < 0.02, "{tension:?}");
        config.contact.drum.restitution = Some(1.0);
        let mut simulation = start(&config, fall());
        run_through_contact(&mut simulation, 100_000);
        simulation.run(1).unwrap();
        // The pull jumps: half a step of it at either end.
        let after = simulation.state().particles.velocities[0].y;
        assert!((after / speed - 1.0).abs() < 5e-3, "{after}");
        assert_eq!(last(&simulation, "adhesion"), 0.0);
        assert!(column(&simulation, "adhesion").iter().any(|&energy| energy < held));
        assert!(last(&simulation, "energy_residual") < 1e-12);
    }
}

/// Tension of spring and dashpot is clipped, not the pull; and what presses is theirs alone.
#[test]
fn where_tension_is_clipped_the_pull_stays() {
    let parameters = ContactParameters { tension: Tension::Clipped, adhesion: 7.0, ..law(WALL) };
    let law = <(Linear<true>, Adhesion)>::between(&parameters, BodyPair::at_wall((mass(), RADIUS)));
    let respond = |overlap: f64| {
        let separation_rate = (1e-7 - overlap) / EXACT_STEP;
        let motion = RelativeMotion { overlap, separation_rate, slip_rate: 1.0, rolling_rate: 0.0 };
        let last = ContactState { overlap: 1e-7, separation_rate, force_x: 0.0, force_y: 0.0, moment: 0.0 };
        let contact = Kinematics::new(&motion, &last, [EXACT_STEP, 1.0 / EXACT_STEP]);
        let history = (SpringHistory { tangential_displacement: 0.0 }, ());
        <(Linear<true>, Adhesion)>::respond(&law, &contact, &history).0
    };
    let parting = respond(1e-8);
    assert_eq!((parting.normal_force, parting.pressing_force, parting.tangential_force), (-7.0, 0.0, 0.0));
    let pressed = respond(2e-7);
    assert_eq!(pressed.normal_force, pressed.pressing_force - 7.0);
    assert!((pressed.tangential_force / (0.5 * pressed.pressing_force) - 1.0).abs() < 1e-12);
    assert_eq!(respond(-1e-9).normal_force, 0.0, "bodies that have parted do not pull");
}

/// What a law is given of terms: rolling resistance, dashpot, adhesion.
fn set(law: &mut ContactParameters, [rolling, dashpot, adhesion]: [f64; 3]) {
    law.rolling_friction = rolling;
    law.tangential_damping_ratio = dashpot;
    law.adhesion = adhesion;
}

const ALL: [f64; 3] = [0.2, 0.3, 4.0];

fn with(terms: [f64; 3], baffle_count: usize) -> SimulationConfig {
    let mut config = baseline(100, baffle_count);
    config.load.start_speed = 1.0;
    set(&mut config.contact.bundle, terms);
    set(&mut config.contact.drum, terms);
    config
}

/// The packed load of a configuration, with three sizes.
fn mixed(config: &SimulationConfig) -> InitialState {
    let packed = Simulation::new(config.clone(), 7, 1).expect("a load that fits");
    let p = &packed.state().particles;
    InitialState {
        positions: p.positions.clone(),
        velocities: Some(p.velocities.clone()),
        radii: Some((0..p.len()).map(|i| RADIUS * (1.0 - 0.2 * (i % 3) as f64)).collect()),
        angular_velocities: Some((0..p.len()).map(|i| 20.0 - (i % 41) as f64).collect()),
        ..InitialState::default()
    }
}

/// A run of `steps` from the load of mixed sizes.
fn tumbled(config: &SimulationConfig, steps: u64) -> Simulation {
    let mut simulation = start(config, mixed(config));
    simulation.run(steps).expect("a stable run");
    let touching = simulation.contacts().counts();
    assert!(touching.0 + touching.1 > 8, "{touching:?}");
    simulation
}

const STEPS: u64 = 50_000;

#[test]
fn the_ledger_closes_with_all_terms() {
    for baffle_count in [0, 3] {
        let simulation = tumbled(&with(ALL, baffle_count), 200_000);
        let end = simulation.time();
        let residual = statistic(&simulation, "energy_residual", 0.0, end);
        assert!(residual < 1e-12, "{baffle_count} baffles: {residual:e}");
        let disagreement = statistic(&simulation, "power_disagreement", 0.5 * end, end);
        assert!(disagreement < 1e-10, "{baffle_count} baffles: {disagreement:e}");
        for name in contact_energies() {
            let values = column(&simulation, name);
            assert!(*values.last().unwrap() != 0.0, "{name} is none");
            if name.starts_with("dissipated") {
                assert!(values.is_sorted(), "{name} runs backwards");
            }
        }
        // What the formulas of the terms leave to the finite step is small.
        let numerical = last(&simulation, "numerical") / last(&simulation, "dissipated_normal");
        assert!(numerical.abs() < 0.05, "{numerical}");
    }
}

#[test]
fn one_term_fills_its_own_columns_only() {
    let own = |term: usize| match term {
        0 => &["dissipated_rolling", "elastic_rolling"][..],
        1 => &["dissipated_tangential"],
        _ => &["adhesion"],
    };
    for term in 0..3 {
        let mut terms = [0.0; 3];
        terms[term] = ALL[term];
        let simulation = tumbled(&with(terms, 3), STEPS);
        for other in 0..3 {
            for name in own(other) {
                let is_used = column(&simulation, name).iter().any(|&value| value != 0.0);
                assert_eq!(is_used, term == other, "{name} with term {term}");
            }
        }
    }
}

#[test]
fn terms_that_nobody_has_change_no_bit() {
    for baffle_count in [0, 3] {
        let plain = with([0.0; 3], baffle_count);
        assert_eq!(Model::of(&plain.contact.table().unwrap(), false), Model::Bare);
        let mut config = plain.clone();
        // A species without a bundle has them all.
        config.contact.species = 2;
        let mut law = plain.contact.drum.clone();
        set(&mut law, ALL);
        let key = String::from("contact.pair[0]");
        config.contact.walls = vec![WallLaw { species: 1, key: key.clone(), parameters: law.clone() }];
        config.contact.pairs = vec![PairLaw { between: [0, 1], key, parameters: law }];
        assert_eq!(Model::of(&config.contact.table().unwrap(), false), Model::Full);
        assert!(bits(&tumbled(&plain, STEPS)) == bits(&tumbled(&config, STEPS)), "{baffle_count} baffles");
    }
}

#[test]
fn skins_and_restarts_do_not_show_with_terms() {
    for baffle_count in [0, 3] {
        let mut config = with(ALL, baffle_count);
        let straight = tumbled(&config, STEPS);
        for skin in [0.0, 0.3 * RADIUS] {
            config.run.skin = Some(skin);
            assert!(bits(&straight) == bits(&tumbled(&config, STEPS)), "skin {skin}");
        }
        config.run.skin = None;
        let saved = tumbled(&config, STEPS / 2 + 1).to_checkpoint().unwrap();
        let mut resumed = Simulation::from_checkpoint(&saved, 2).unwrap();
        resumed.run(STEPS / 2 - 1).unwrap();
        assert!(bits(&straight) == bits(&resumed), "{baffle_count} baffles");
        assert_eq!(straight.to_checkpoint().unwrap(), resumed.to_checkpoint().unwrap());
    }
}

#[test]
fn threads_do_not_show_with_terms() {
    let mut config = with(ALL, 3);
    config.load.count = 9000;
    config.drum.radius = Some(1.8);
    config.load.start_speed = 5.0;
    let initial = mixed(&config);
    let run = |threads: usize| {
        let mut simulation =
            Simulation::with_state(config.clone(), 1, threads, initial.clone()).expect("a valid scene");
        simulation.run(2500).expect("a stable run");
        simulation
    };
    let one = run(1);
    assert!(one.contacts().counts().0 > 50, "{:?}", one.contacts().counts());
    for threads in [2, 3] {
        assert!(bits(&one) == bits(&run(threads)), "{threads} threads");
    }
}

#[test]
fn a_mirrored_drum_mirrors_with_terms() {
    let config = with(ALL, 0);
    let initial = mixed(&config);
    let mut other_config = config.clone();
    other_config.rotation.knots = vec![[0.0, -SPEED]];
    let mut other = initial.clone();
    other.positions.iter_mut().chain(other.velocities.iter_mut().flatten()).for_each(|v| v.x = -v.x);
    other.angular_velocities.iter_mut().flatten().for_each(|spin| *spin = -*spin);
    let mut runs = [start(&config, initial), start(&other_config, other)];
    for simulation in &mut runs {
        simulation.run(STEPS).unwrap();
    }
    let [one, other] = runs.each_ref().map(|simulation| &simulation.state().particles);
    for i in 0..one.len() {
        assert_eq!((one.positions[i].x, one.positions[i].y), (-other.positions[i].x, other.positions[i].y));
        assert_eq!(one.angular_velocities[i], -other.angular_velocities[i]);
    }
}
