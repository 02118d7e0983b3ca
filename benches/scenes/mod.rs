//! Loads that the benches measure.

#![allow(dead_code)] // Each bench uses its own part.

#[path = "../../tests/common/mod.rs"]
pub mod common;

use drumrs::config::SimulationConfig;
use drumrs::simulation::Simulation;

/// Whether this is `cargo bench`, and not a test that only sees each bench run once.
pub fn measuring() -> bool {
    std::env::args().any(|argument| argument == "--bench")
}

/// Table 1's drum up to 300 bundles; beyond, one grown with its load (40 % fill, same Froude number).
pub fn drum_for(count: usize, baffle_count: usize) -> SimulationConfig {
    let mut config = common::baseline(count, baffle_count);
    if count > 300 {
        let radius = common::RADIUS * (count as f64 / 0.4).sqrt();
        config.drum.radius = Some(radius);
        config.rotation.knots = vec![[0.0, (0.774 * common::GRAVITY / radius).sqrt()]];
    }
    config
}

/// A load out of its random start and in the tumble; larger ones have further to fall than the time that is spent here.
pub fn tumbling(count: usize, baffle_count: usize) -> Simulation {
    let mut simulation = Simulation::new(drum_for(count, baffle_count), 1, 1).expect("a load that fits");
    let steps = match count {
        _ if !measuring() => 10,
        0..=1_000 => 200_000,
        _ => 20_000,
    };
    simulation.run(steps).expect("a stable run");
    simulation
}
