//! Gross work: known answers for single contacts, and that recording it changes nothing else.

use crate::common::*;
use drumrs::io::config::SimulationConfig;
use drumrs::observe::recorder::Recording;
use drumrs::physics::contact::parameters::{Base, Tension};
use drumrs::simulation::Simulation;

/// Fine enough that a formula holds to 2e-3: an impact takes some 200 steps.
const FINE_STEP: f64 = TIME_STEP / 4.0;

fn recorded(mut config: SimulationConfig) -> SimulationConfig {
    config.run.record = vec![Recording::GrossWork];
    config
}

/// Without damping, and with the tangential spring that swings as fast as the normal one.
fn elastic(mut config: SimulationConfig) -> SimulationConfig {
    for law in [&mut config.contact.bundle, &mut config.contact.drum] {
        law.restitution = Some(1.0);
        law.stiffness_ratio = 1.0 / 3.0;
        law.friction = 10.0;
    }
    config.run.time_step = Some(FINE_STEP);
    config.run.sample_every = FINE_STEP;
    recorded(config)
}

/// (N, T) at the last sample.
fn gross_work(simulation: &Simulation) -> [f64; 2] {
    ["gross_work_normal", "gross_work_tangential"].map(|name| last(simulation, name))
}

fn assert_near(value: f64, expected: f64) {
    assert!((value - expected).abs() < 2e-3 * expected, "{value:e} for {expected:e}");
}

/// A spring takes ½ m* w² and gives it back: the net work is nothing, the gross work twice that.
#[test]
fn an_elastic_impact_exchanges_its_energy_twice() {
    let half = RADIUS + 1e-6;
    let bodies = [([-half, 0.0], [1.25, 0.0], 0.0), ([half, 0.0], [-0.25, 0.0], 0.0)];
    let mut simulation = start(&elastic(free_space()), several(&bodies));
    run_through_contact(&mut simulation, 10_000);
    let [normal, tangential] = gross_work(&simulation);
    assert_near(normal, 0.5 * mass() * 1.5 * 1.5);
    assert_eq!(tangential, 0.0);
    assert!(last(&simulation, "normal_work").abs() < 1e-3 * normal);
}

/// The tangential mass of two discs is m*/3: their slip s is turned round, and its energy m* s² / 6 exchanged twice.
#[test]
fn a_sticking_impact_exchanges_the_energy_of_its_slip_twice() {
    let half = RADIUS + 1e-6;
    let (closing, slip) = (1.0, 0.6);
    let spin = 0.5 * slip / RADIUS;
    let bodies = [([-half, 0.0], [0.5 * closing, 0.0], spin), ([half, 0.0], [-0.5 * closing, 0.0], spin)];
    let mut simulation = start(&elastic(free_space()), several(&bodies));
    run_through_contact(&mut simulation, 10_000);
    let [normal, tangential] = gross_work(&simulation);
    assert_near(normal, 0.5 * mass() * closing * closing);
    assert_near(tangential, 0.5 * mass() * slip * slip / 3.0);
}

/// What slides steadily neither loads nor unloads a spring: the gross work is the heat, μ m g times the way.
#[test]
fn steady_sliding_exchanges_what_it_dissipates() {
    let mut config = recorded(floor([0.0, -GRAVITY]));
    config.load.spin_locked = true;
    let rest = RADIUS - mass() * GRAVITY / config.contact.drum.normal_stiffness;
    let mut simulation = start(&config, single([0.0, rest], [1.0, 0.0], 0.0));
    run(&mut simulation, 0.1);
    let way = simulation.state().particles.positions[0].x;
    let [normal, tangential] = gross_work(&simulation);
    assert_near(tangential, 0.5 * mass() * GRAVITY * way);
    assert_near(tangential, last(&simulation, "dissipated_sliding"));
    assert!(normal < 1e-6 * tangential, "{normal:e}");
}

/// All columns but those of the gross work.
fn others(simulation: &Simulation) -> Vec<Vec<f64>> {
    let columns = simulation.series().columns().iter();
    let others = columns.enumerate().filter(|(_, column)| !column.name.starts_with("gross_work"));
    others.map(|(place, _)| simulation.series().column(place)).collect()
}

fn laws() -> Vec<(&'static str, SimulationConfig)> {
    let mut clipped = baseline(100, 3);
    clipped.contact.drum.tension = Tension::Clipped;
    let mut terms = baseline(100, 0);
    terms.contact.bundle.rolling_friction = 0.1;
    terms.contact.bundle.adhesion = 2.0;
    let mut hertz = baseline(100, 0);
    for law in [&mut hertz.contact.bundle, &mut hertz.contact.drum] {
        law.base = Base::Hertz;
        law.young_modulus = Some(1e7);
    }
    hertz.run.time_step = None;
    vec![("bare", baseline(100, 0)), ("clipped", clipped), ("terms", terms), ("hertz", hertz)]
}

#[test]
fn recording_it_changes_no_other_bit() {
    for (name, config) in laws() {
        let run = |config: &SimulationConfig| {
            let mut simulation = Simulation::new(config.clone(), 3, 1).expect("a load that fits");
            run(&mut simulation, 0.3);
            simulation
        };
        let (plain, with) = (run(&config), run(&recorded(config)));
        assert!(plain.series().place_of("gross_work_normal").is_none());
        assert_eq!(with.series().width(), plain.series().width() + 2);
        assert!(others(&plain) == others(&with), "{name}");
        assert_eq!(plain.state().particles, with.state().particles, "{name}");
        for way in ["normal", "tangential"] {
            let gross = column(&with, &format!("gross_work_{way}"));
            let net = column(&with, &format!("{way}_work"));
            assert!(gross.is_sorted() && gross.last() > Some(&0.0), "{name}: {way}");
            // The net work is that of the laws' formulas, which leave a little to the finite step.
            for (gross, net) in gross.iter().zip(&net) {
                assert!(*gross >= 0.95 * net, "{name}: {way} {gross:e} for {net:e}");
            }
        }
        assert_eq!(gross_work(&through_a_checkpoint(&with)), gross_work(&with));
    }
}

/// The same simulation through a checkpoint.
fn through_a_checkpoint(simulation: &Simulation) -> Simulation {
    let saved = simulation.to_checkpoint().expect("a checkpoint");
    Simulation::from_checkpoint(&saved, 1).expect("a simulation")
}

#[test]
fn threads_skins_and_restarts_do_not_show() {
    let mut config = recorded(baseline(1200, 3));
    config.drum.radius = Some(0.9);
    config.load.start_speed = 3.0;
    let after = |config: &SimulationConfig, threads: usize, pieces: &[u64]| {
        let mut simulation = Simulation::new(config.clone(), 5, threads).expect("a load that fits");
        for &steps in pieces {
            simulation.run(steps).expect("a stable run");
            let saved = simulation.to_checkpoint().expect("a checkpoint");
            simulation = Simulation::from_checkpoint(&saved, threads).expect("a simulation");
        }
        simulation
    };
    let one = after(&config, 1, &[12_000]);
    assert!(gross_work(&one).iter().all(|&work| work > 0.0));
    assert!(bits(&one) == bits(&after(&config, 2, &[12_000])), "threads");
    assert!(bits(&one) == bits(&after(&config, 3, &[5_001, 6_999])), "restart");
    config.run.skin = Some(0.1 * RADIUS);
    assert!(bits(&one) == bits(&after(&config, 1, &[12_000])), "skin");
}

#[test]
fn the_summary_has_the_ratio_where_it_is_recorded() {
    let mut simulation = Simulation::new(recorded(baseline(100, 0)), 3, 1).expect("a load that fits");
    run(&mut simulation, 0.6);
    let over = |name: &str| {
        let values = column(&simulation, name);
        values[values.len() - 1] - values[300]
    };
    let ratio = statistic(&simulation, "gross_work_ratio", 0.3, simulation.time());
    let expected = over("gross_work_normal") / over("gross_work_tangential");
    assert!((ratio - expected).abs() < 1e-2 * expected, "{ratio} for {expected}");
    assert!(ratio != statistic(&simulation, "work_ratio", 0.3, simulation.time()));
}
