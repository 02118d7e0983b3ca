//! Another configuration takes over under way, by its state alone.

use crate::common::*;
use drumrs::simulation::Simulation;

fn tumbling() -> Simulation {
    let mut config = baseline(100, 3);
    config.load.start_speed = 4.0;
    config.run.frame_every = 0.001;
    let mut simulation = Simulation::new(config, 7, 1).expect("a load that fits");
    simulation.run(1501).expect("a stable run");
    simulation
}

#[test]
fn the_same_configuration_changes_no_bit() {
    let mut simulation = tumbling();
    let saved = simulation.to_checkpoint().unwrap();
    let mut again = simulation.with_config(simulation.config().clone()).unwrap();
    assert_eq!(saved, again.to_checkpoint().unwrap(), "records that were not taken among it");
    simulation.run(400).unwrap();
    again.run(400).unwrap();
    assert_eq!(bits(&simulation), bits(&again));
}

#[test]
fn another_speed_to_come_is_as_if_it_had_been_there_from_the_start() {
    let simulation = tumbling();
    let mut config = simulation.config().clone();
    config.rotation.knots.extend([[0.006, SPEED], [0.008, 2.0 * SPEED]]);
    let mut changed = simulation.with_config(config.clone()).unwrap();
    let mut whole = Simulation::new(config, 7, 1).unwrap();
    changed.run(2000).unwrap();
    whole.run(3501).unwrap();
    assert_eq!(bits(&changed), bits(&whole));
    assert_ne!(bits(&changed), {
        let mut untouched = simulation.with_config(simulation.config().clone()).unwrap();
        untouched.run(2000).unwrap();
        bits(&untouched)
    });
}

/// A state belongs to its drum, and a simulation that is refused another one goes on.
#[test]
fn what_does_not_belong_to_the_state_is_refused() {
    let mut simulation = tumbling();
    let mut bare = simulation.config().clone();
    bare.drum.baffles.clear();
    let refused = simulation.with_config(bare).unwrap_err().to_string();
    assert!(refused.contains("its accounts are not those of its drum"), "{refused}");
    let mut backward = simulation.config().clone();
    backward.rotation.knots = vec![[1.0, 0.0], [0.5, 0.0]];
    assert!(simulation.with_config(backward).is_err());
    simulation.run(10).unwrap();
}
