//! What is recorded on request, of contacts, in cells and in zones, keeps the promises: the same bits for any number of threads, any margin, across restarts and
//! sorts of the memory; and recording changes nothing else.

use crate::common::*;
use drumrs::io::config::SimulationConfig;
use drumrs::observe::recorder::Recording;
use drumrs::physics::drum::zone::{ZoneFrame, ZoneParameters};
use drumrs::simulation::Simulation;

fn recorded(mut config: SimulationConfig) -> SimulationConfig {
    config.run.record = vec![
        Recording::Contacts,
        Recording::WallProfile,
        Recording::LedgerSplit,
        Recording::Discs,
        Recording::Fields,
    ];
    config.run.sample_every = 300.0 * TIME_STEP;
    config.run.sums_from = 100.0 * TIME_STEP;
    let radius = config.drum.radius.expect("a rim");
    let corners = vec![[-0.5 * radius, -radius], [0.5 * radius, -radius], [0.0, 0.3 * radius]];
    let zone = |name: &str, frame| ZoneParameters { name: name.into(), corners: corners.clone(), frame };
    config.run.zones = vec![zone("standing", ZoneFrame::Laboratory), zone("turning", ZoneFrame::Drum)];
    config.load.start_speed = 4.0;
    config
}

/// A load of many chunks, large enough for the parallel passes.
fn large() -> SimulationConfig {
    let mut config = recorded(baseline(9000, 3));
    config.drum.radius = Some(1.8);
    config.drum.baffles[0].height = 0.3;
    config.drum.baffles[0].base = 0.38;
    config
}

/// Loads of one chunk in a bare drum and in one with baffles, and one of several chunks.
fn loads() -> [SimulationConfig; 3] {
    let mut chunks = recorded(baseline(1200, 3));
    chunks.drum.radius = Some(0.55);
    [recorded(baseline(120, 0)), recorded(baseline(240, 3)), chunks]
}

fn started(config: &SimulationConfig, threads: usize) -> Simulation {
    Simulation::new(config.clone(), 7, threads).expect("a load that fits")
}

fn after(config: &SimulationConfig, threads: usize, steps: u64) -> Simulation {
    let mut simulation = started(config, threads);
    simulation.run(steps).expect("a stable run");
    simulation
}

/// Every bit of what is recorded of contacts; there must be contacts that have ended and open ones, at the drum, too.
fn records(simulation: &Simulation) -> Vec<u8> {
    let (rows, open) = (&simulation.records().contacts, simulation.open_rows());
    let is_wall = |row: &&drumrs::observe::contact_rows::ContactRow| row.part < 4;
    assert!(rows.len() > 20 && rows.iter().filter(is_wall).count() > 5 && !open.is_empty());
    let (fields, visits) = (&simulation.state().fields, &simulation.state().visits);
    let (come, stress) =
        (visits.iter().any(|own| own.entries > 0), fields.cells.iter().any(|cell| cell[10] > 0.0));
    assert!(fields.moments > 3 && stress && come);
    postcard::to_stdvec(&(simulation.contact_log(), rows, open, fields, visits)).expect("plain numbers")
}

#[test]
fn any_number_of_threads_records_the_same_contacts() {
    let config = large();
    let one = records(&after(&config, 1, 1500));
    for threads in [2, 3] {
        assert!(one == records(&after(&config, threads, 1500)), "{threads} threads");
    }
}

#[test]
fn any_margin_records_the_same_contacts() {
    for mut config in loads() {
        let reference = records(&after(&config, 1, 2401));
        for skin in [0.0, 0.1 * RADIUS, 2.0 * RADIUS] {
            config.run.skin = Some(skin);
            assert!(reference == records(&after(&config, 1, 2401)), "{} bundles, {skin}", config.load.count);
        }
    }
}

/// At odd steps, with contacts open.
#[test]
fn restarts_do_not_show_in_the_contacts() {
    for config in loads() {
        let mut straight = after(&config, 1, 1501);
        for steps in [1, 33, 476] {
            let saved = straight.to_checkpoint().unwrap();
            let mut resumed = Simulation::from_checkpoint(&saved, 2).unwrap();
            assert_eq!(saved, resumed.to_checkpoint().unwrap());
            straight.run(steps).unwrap();
            resumed.run(steps).unwrap();
            assert!(records(&straight) == records(&resumed), "{} bundles", config.load.count);
        }
    }
}

/// Where slices of a run end, and when events are gone through, does not show; nor does looking.
#[test]
fn slices_and_looks_do_not_show_in_the_contacts() {
    for config in loads() {
        let whole = after(&config, 1, 1700);
        let mut sliced = started(&config, 1);
        for steps in [1, 6, 93, 500, 1100] {
            sliced.run(steps).unwrap();
            let _ = (sliced.contact_log(), sliced.open_rows());
        }
        assert!(records(&whole) == records(&sliced), "{} bundles", config.load.count);
        assert_eq!(bits(&whole), bits(&sliced));
    }
}

/// A sort of the memory comes at step 8192.
#[test]
fn sorts_of_the_memory_keep_the_contacts() {
    let mut config = recorded(baseline(2100, 3));
    config.drum.radius = Some(0.72);
    let mut straight = after(&config, 1, 8100);
    let mut resumed = Simulation::from_checkpoint(&straight.to_checkpoint().unwrap(), 1).unwrap();
    straight.run(200).unwrap();
    for steps in [91, 1, 1, 107] {
        resumed.run(steps).unwrap();
    }
    assert!(records(&straight) == records(&resumed));
    let open = straight.contacts();
    let opened =
        |step: u64| open.pair_tallies.iter().chain(&open.wall_tallies).any(|own| own.opening.step < step);
    assert!(opened(8192), "no contact has come through the sort");
    let received: f64 =
        straight.contact_log().discs.iter().map(|disc| disc.received.dissipated_normal.value()).sum();
    let taken = straight.dissipated().dissipated_normal;
    assert!((received - taken).abs() < 1e-12 * taken, "{received:e} {taken:e}");
}

/// What is told is what there was at that time, be it read at once, later or after a restart; and a later time leaves nothing out.
#[test]
fn sums_by_place_are_told_as_they_were_at_a_time() {
    for config in loads() {
        let told = |simulation: &Simulation| {
            let (fields, visits) = simulation.told_sums();
            assert!(fields.moments > 1);
            postcard::to_stdvec(&(fields, visits)).expect("plain numbers")
        };
        let early = after(&config, 1, 1201);
        let mut simulation = started(&config, 1);
        simulation.tell_sums_until(1201.0 * TIME_STEP);
        for steps in [900, 301, 1, 600, 1000] {
            simulation.run(steps).unwrap();
        }
        assert!(told(&early) == told(&simulation), "{} bundles", config.load.count);
        let saved = simulation.to_checkpoint().unwrap();
        let mut resumed = Simulation::from_checkpoint(&saved, 1).unwrap();
        resumed.run(500).unwrap();
        assert!(told(&early) == told(&resumed));
        resumed.tell_sums_until(f64::INFINITY);
        assert!(told(&after(&config, 1, 3302)) == told(&resumed));
    }
}

#[test]
fn recording_contacts_changes_nothing_else() {
    for config in loads() {
        let mut bare = config.clone();
        bare.run.record.clear();
        bare.run.zones.clear();
        assert_eq!(bits(&after(&bare, 1, 1700)), bits(&after(&config, 1, 1700)));
    }
}
