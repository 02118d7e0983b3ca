//! Hertz–Mindlin: greatest overlap, duration, restitution at any speed, accounts, promises.

use crate::common::*;
use drumrs::io::config::SimulationConfig;
use drumrs::physics::contact::hertz::Hertz;
use drumrs::physics::contact::law::{BodyPair, ContactLaw};
use drumrs::physics::contact::parameters::{Base, ContactParameters, Tension};
use drumrs::simulation::Simulation;
use drumrs::simulation::initial_state::InitialState;

const YOUNG: f64 = 1e8;

fn hertzian(law: &mut ContactParameters) {
    (law.base, law.young_modulus, law.poisson_ratio) = (Base::Hertz, Some(YOUNG), 0.25);
}

fn with_hertz(mut config: SimulationConfig) -> SimulationConfig {
    hertzian(&mut config.contact.bundle);
    hertzian(&mut config.contact.drum);
    config
}

/// k = 4/3 E* √R* / h of a bundle at a wall.
fn stiffness() -> f64 {
    let modulus = YOUNG / (2.0 * (1.0 - 0.25 * 0.25));
    4.0 / 3.0 * modulus * RADIUS.sqrt() / (2.0 * RADIUS)
}

/// A head-on impact on a floor in steps of which a hundred make up the contact.
fn fallen(speed: f64, restitution: f64, tension: Tension, phase: f64) -> Simulation {
    let mut config = with_hertz(floor([0.0, 0.0]));
    let law = &mut config.contact.drum;
    (law.restitution, law.tension) = (Some(restitution), tension);
    let step = 0.01 * 2.943 * deepest(speed) / speed;
    config.run.time_step = Some(step);
    config.run.sample_every = step;
    let mut simulation =
        start(&config, single([0.0, RADIUS + (2.0 + phase) * speed * step], [0.0, -speed], 0.0));
    run_through_contact(&mut simulation, 100_000);
    simulation.run(2).unwrap();
    simulation
}

/// (5 m v² / (4 k))^{2/5}
fn deepest(speed: f64) -> f64 {
    libm::pow(1.25 * mass() * speed * speed / stiffness(), 0.4)
}

#[test]
fn an_elastic_impact_is_as_deep_and_as_long_as_hertz_says() {
    for speed in [0.01, 0.1, 1.0] {
        let simulation = fallen(speed, 1.0, Tension::Allowed, 0.3);
        let depth = column(&simulation, "max_overlap_ratio").into_iter().fold(0.0, f64::max) * RADIUS;
        assert!((depth / deepest(speed) - 1.0).abs() < 1e-3, "{speed}: {depth}, {}", deepest(speed));
        let steps: f64 = column(&simulation, "contact_count").iter().sum();
        assert!((steps - 100.0).abs() <= 1.0, "{speed}: {steps} hundredths of 2.943 δ/v");
        let held = column(&simulation, "elastic_normal").into_iter().fold(0.0, f64::max);
        assert!((held / (0.5 * mass() * speed * speed) - 1.0).abs() < 2e-3, "{held}");
        assert!((simulation.state().particles.velocities[0].y / speed - 1.0).abs() < 1e-3);
        assert!(last(&simulation, "energy_residual") < 1e-12);
    }
}

#[test]
fn restitution_is_what_was_asked_for_at_any_speed() {
    for tension in [Tension::Allowed, Tension::Clipped] {
        for restitution in [0.3, 0.6, 0.9] {
            for speed in [0.01, 0.3, 3.0] {
                let after = |k: u32| {
                    let simulation = fallen(speed, restitution, tension, f64::from(k) / 20.0);
                    let velocity = simulation.state().particles.velocities[0].y;
                    let lost = last(&simulation, "dissipated_normal") / (0.5 * mass() * speed * speed);
                    [velocity / speed / 20.0, lost / 20.0]
                };
                let seen = (0..20).map(after).fold([0.0; 2], |sum, one| [sum[0] + one[0], sum[1] + one[1]]);
                let place = format!("{tension:?} {restitution} {speed}");
                assert!((seen[0] / restitution - 1.0).abs() < 0.01, "{place}: {seen:?}");
                assert!((seen[1] - (1.0 - restitution * restitution)).abs() < 0.01, "{place}: {seen:?}");
            }
        }
    }
}

/// kₜ over dFₙ/dδ is Mindlin's 2 (1 − ν)/(2 − ν).
#[test]
fn the_tangential_stiffness_is_mindlins() {
    let mut parameters = law(1.0);
    hertzian(&mut parameters);
    let law = Hertz::between(&parameters, BodyPair::at_wall((mass(), RADIUS)));
    assert!((law.normal_stiffness / stiffness() - 1.0).abs() < 1e-12);
    let ratio = law.tangential_stiffness / (1.5 * law.normal_stiffness);
    assert!((ratio - 2.0 * 0.75 / 1.75).abs() < 1e-12, "{ratio}");
}

/// A disc that slides comes to roll at ⅔ of its speed, whatever the law of its springs.
#[test]
fn a_sliding_disc_comes_to_roll() {
    let mut config = with_hertz(floor([0.0, -GRAVITY]));
    config.contact.drum.tension = Tension::Clipped;
    config.run.time_step = Some(1e-5);
    let overlap = libm::pow(mass() * GRAVITY / stiffness(), 2.0 / 3.0);
    let mut simulation = start(&config, single([0.0, RADIUS - overlap], [0.5, 0.0], 0.0));
    run(&mut simulation, 0.3);
    let velocity = simulation.state().particles.velocities[0].x;
    assert!((velocity - 0.5 * 2.0 / 3.0).abs() < 2e-3, "{velocity}");
    let loss = last(&simulation, "dissipated_sliding") / (mass() * 0.25 / 6.0);
    assert!((loss - 1.0).abs() < 0.01, "{loss}");
    let height = simulation.state().particles.positions[0].y;
    assert!(((RADIUS - height) / overlap - 1.0).abs() < 1e-3, "rests at (m g/k)^⅔");
}

/// Work of a sticking impact that the law's own account leaves to the step, over the energy of the approach.
fn unaccounted(steps: f64) -> f64 {
    let speed = 0.1;
    let mut config = with_hertz(floor([0.0, 0.0]));
    (config.contact.drum.restitution, config.contact.drum.friction) = (Some(1.0), 10.0);
    let step = 2.943 * deepest(speed) / speed / steps;
    (config.run.time_step, config.run.sample_every) = (Some(step), step);
    let initial = single([0.0, RADIUS + 2.3 * speed * step], [speed, -speed], 0.0);
    let mut simulation = start(&config, initial);
    run_through_contact(&mut simulation, 100_000);
    simulation.run(2).unwrap();
    assert!(last(&simulation, "dissipated_sliding") > 1e-3 * mass() * speed * speed, "the edge slips");
    last(&simulation, "numerical").abs() / (mass() * speed * speed)
}

/// What a tangential spring loses as its stiffness changes is sliding at the edge of the contact, not an error of the step.
#[test]
fn a_changing_tangential_stiffness_has_its_account() {
    let [coarse, fine] = [100.0, 800.0].map(unaccounted);
    assert!(coarse < 0.02 && fine < 0.25 * coarse, "{coarse} {fine}");
}

fn drum_load(adhesion: f64, baffle_count: usize) -> (SimulationConfig, InitialState) {
    let mut config = with_hertz(baseline(100, baffle_count));
    config.load.start_speed = 1.0;
    config.run.time_step = None;
    (config.contact.bundle.adhesion, config.contact.drum.adhesion) = (adhesion, adhesion);
    let packed = Simulation::new(config.clone(), 7, 1).expect("a load that fits");
    let p = &packed.state().particles;
    let initial = InitialState {
        positions: p.positions.clone(),
        velocities: Some(p.velocities.clone()),
        radii: Some((0..p.len()).map(|i| RADIUS * (1.0 - 0.2 * (i % 3) as f64)).collect()),
        ..InitialState::default()
    };
    (config, initial)
}

#[test]
fn the_ledger_closes_and_its_numerical_part_is_small() {
    for (adhesion, baffle_count) in [(0.0, 0), (0.0, 3), (4.0, 3)] {
        let (config, initial) = drum_load(adhesion, baffle_count);
        let mut simulation = start(&config, initial);
        run(&mut simulation, 0.6);
        let end = simulation.time();
        let residual = statistic(&simulation, "energy_residual", 0.0, end);
        assert!(residual < 1e-11, "{residual:e}");
        assert!(statistic(&simulation, "power_disagreement", 0.5 * end, end) < 1e-9);
        for name in ["dissipated_normal", "dissipated_sliding"] {
            assert!(column(&simulation, name).is_sorted(), "{name} runs backwards");
        }
        let numerical = last(&simulation, "numerical") / last(&simulation, "drum_work");
        assert!(numerical.abs() < 0.02, "{numerical}");
    }
}

#[test]
fn skins_and_restarts_do_not_show() {
    let (mut config, initial) = drum_load(4.0, 3);
    let steps = 4000;
    let run = |config: &SimulationConfig, steps: u64| {
        let mut simulation = start(config, initial.clone());
        simulation.run(steps).expect("a stable run");
        simulation
    };
    let straight = run(&config, steps);
    let saved = run(&config, steps / 2 + 1).to_checkpoint().unwrap();
    let mut resumed = Simulation::from_checkpoint(&saved, 1).unwrap();
    resumed.run(steps / 2 - 1).unwrap();
    assert!(bits(&straight) == bits(&resumed));
    config.run.skin = Some(0.0);
    assert!(bits(&straight) == bits(&run(&config, steps)));
}

#[test]
fn what_does_not_go_with_hertz_is_refused() {
    type Change = fn(&mut SimulationConfig);
    let refusals: [(Change, &str); 5] = [
        (
            |config| config.contact.drum.base = Base::Linear,
            "contact.drum.young_modulus is 100000000, but must be missing where contact.base is \"linear\"",
        ),
        (
            |config| config.contact.drum = law(9.7e7),
            "contact.base is linear, but must be hertz in every table: a run has one base law",
        ),
        (|config| config.contact.bundle.young_modulus = None, "contact.bundle.young_modulus is missing"),
        (
            |config| config.contact.bundle.rolling_friction = 0.1,
            "contact.bundle.rolling_friction is 0.1, but must be 0 where contact.base is \"hertz\"",
        ),
        (|config| config.contact.bundle.poisson_ratio = 0.7, "contact.bundle.poisson_ratio is 0.7"),
    ];
    for (change, sentence) in refusals {
        let mut config = with_hertz(baseline(10, 0));
        change(&mut config);
        let text = config.validate().unwrap_err().to_string();
        assert!(text.starts_with(sentence), "{text}");
    }
}
