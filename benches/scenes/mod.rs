//! Loads that the benches measure.

#![allow(dead_code)] // Each bench uses its own part.

#[path = "../../tests/common/mod.rs"]
pub mod common;

use drumrs::io::config::SimulationConfig;
use drumrs::observe::recorder::Recording;
use drumrs::physics::drum::Drum;
use drumrs::physics::drum::zone::{ZoneFrame, ZoneParameters};
use drumrs::physics::load::composition::SpeciesParameters;
use drumrs::physics::load::shares::Measure;
use drumrs::physics::load::sizes::SizeLaw;
use drumrs::physics::vector::{Vec2, perpendicular};
use drumrs::simulation::Simulation;
use drumrs::simulation::initial_state::InitialState;

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

/// All that is recorded on request.
pub const ALL_RECORDS: &[Recording] = &[
    Recording::GrossWork,
    Recording::Contacts,
    Recording::WallProfile,
    Recording::LedgerSplit,
    Recording::Discs,
    Recording::Fields,
];

/// A load before its first step. Large ones, which would fall for longer than is spent here, start as a bed.
pub fn started(count: usize, baffle_count: usize) -> Simulation {
    started_with(count, baffle_count, &[])
}

/// The same, of which some things are recorded on request.
pub fn started_with(count: usize, baffle_count: usize, record: &[Recording]) -> Simulation {
    let mut config = drum_for(count, baffle_count);
    config.run.record = record.to_vec();
    if !record.is_empty() {
        let corners = vec![[-0.1, -0.2], [0.0, -0.2], [0.1, 0.1], [0.0, 0.1]];
        config.run.zones =
            vec![ZoneParameters { name: "spray".into(), corners, frame: ZoneFrame::Laboratory }];
    }
    if count > 1_000 {
        let bed = bed(&config);
        Simulation::with_state(config, 1, 1, bed).expect("a bed inside the drum")
    } else {
        Simulation::new(config, 1, 1).expect("a load that fits")
    }
}

/// A load before its first step, of which the largest bundles are `ratio` times as wide as the smallest, with as much mass of
/// any size as of any other. Number and mass are those of equal bundles.
pub fn mixed(count: usize, ratio: f64) -> Simulation {
    let mut config = drum_for(count, 0);
    let smallest = config.load.diameter / ratio.sqrt();
    let diameters = vec![smallest, smallest * ratio];
    let sizes = SizeLaw::Table { by: Measure::Mass, diameters, passing: vec![0.0, 1.0] };
    config.load.species = vec![SpeciesParameters { share: 1.0, density: config.load.density, sizes }];
    config.run.time_step = None;
    Simulation::new(config, 1, 1).expect("a load that fits")
}

/// A load in the tumble.
pub fn tumbling(count: usize, baffle_count: usize) -> Simulation {
    let mut simulation = started(count, baffle_count);
    let steps = match count {
        _ if !measuring() => 10,
        0..=1_000 => 200_000,
        _ => 2_000,
    };
    simulation.run(steps).expect("a stable run");
    simulation
}

/// Rows at the bottom of the drum that turn with it. They are not quite regular, so that about half of all neighbors
/// touch.
fn bed(config: &SimulationConfig) -> InitialState {
    let drum = Drum::new(&config.drum).expect("a valid drum");
    let (rim, spacing) = (drum.radius().expect("a rim"), 2.0 * common::RADIUS);
    let across = (2.0 * rim / spacing) as usize;
    let jitter = |k: usize| 1e-4 * spacing * ((k * 7919 % 1000) as f64 / 500.0 - 1.0);
    let site = |k: usize| {
        let (row, column) = (k / across, k % across);
        let shift = 0.5 * (row % 2) as f64;
        let x = -rim + spacing * (column as f64 + shift) + jitter(k);
        Vec2::new(x, -rim + spacing * 0.75_f64.sqrt() * row as f64 + jitter(k + 1))
    };
    let sites = (0..across * across).map(site).filter(|&site| drum.clearance(site) > common::RADIUS);
    let positions: Vec<Vec2> = sites.take(config.load.count).collect();
    let speed = config.rotation.angular_velocity(0.0);
    InitialState {
        velocities: Some(positions.iter().map(|&position| perpendicular(position) * speed).collect()),
        angular_velocities: Some(vec![speed; positions.len()]),
        positions,
        ..InitialState::default()
    }
}
