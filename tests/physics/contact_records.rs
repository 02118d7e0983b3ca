//! What is recorded of contacts: known answers for single ones.

use crate::common::*;
use drumrs::io::config::SimulationConfig;
use drumrs::observe::contact_rows::{ContactRow, NO_BODY};
use drumrs::observe::recorder::Recording;
use drumrs::physics::contact::tally::Exertion;
use drumrs::physics::contact::{ContactState, Kinematics, RelativeMotion};
use drumrs::simulation::Simulation;

/// Fine enough that a formula holds to 5e-3: an impact takes some 200 steps.
const FINE_STEP: f64 = TIME_STEP / 4.0;
const NEAR: f64 = 5e-3;

fn recorded(mut config: SimulationConfig) -> SimulationConfig {
    config.run.record =
        vec![Recording::Contacts, Recording::WallProfile, Recording::LedgerSplit, Recording::Discs];
    config.run.time_step = Some(FINE_STEP);
    config.run.sample_every = 50.0 * FINE_STEP;
    config.run.arc_bin = Some(1.0);
    config
}

fn assert_near(value: f64, expected: f64) {
    assert!((value - expected).abs() < NEAR * expected.abs(), "{value:e} for {expected:e}");
}

/// The only contact that has ended.
fn only(simulation: &Simulation) -> ContactRow {
    let [row] = simulation.records().contacts[..] else { panic!("{:?}", simulation.records().contacts) };
    row
}

/// Of an impact on a wall: the dashpot takes ½ m v² (1 − e²), the wall gives the impulse m v (1 + e).
#[test]
fn an_impact_on_a_wall_is_one_row() {
    let (speed, restitution) = (1.5, 0.6);
    let mut config = recorded(floor([0.0, 0.0]));
    config.contact.drum.restitution = Some(restitution);
    let above = RADIUS + 1e-4;
    let mut simulation = start(&config, single([0.25, above], [0.0, -speed], 0.0));
    run_through_contact(&mut simulation, 100_000);
    let row = only(&simulation);
    let energy = 0.5 * mass() * speed * speed;
    assert_near(row.dissipated[0], energy * (1.0 - restitution * restitution));
    assert_eq!((row.particle, row.other, row.part), (0, NO_BODY, 1));
    assert_near(row.speeds[0], speed);
    assert_eq!(row.speeds[1], 0.0);
    assert!((row.point[0] - 0.25).abs() < 1e-9 && row.point[1].abs() < 2.0 * speed * FINE_STEP);
    let opened = row.opened as f64 - (above - RADIUS) / speed / FINE_STEP;
    assert!((0.0..=1.0).contains(&opened), "{opened} steps after they met");
    // Half a period of the damped spring; less than the undamped greatest force.
    let frequency = (9.70e7 / mass()).sqrt();
    let duration = (row.ended - row.opened) as f64 * FINE_STEP;
    assert!((0.98..1.06).contains(&(duration * frequency / std::f64::consts::PI)), "{duration}");
    assert!(row.greatest_force < speed * (9.70e7 * mass()).sqrt());
    assert!(row.greatest_force > 0.7 * speed * (9.70e7 * mass()).sqrt());

    let log = simulation.contact_log();
    let bins = simulation.profile_bins();
    let hit = bins.iter().position(|bin| bin.arc[0] <= 100.25 && 100.25 < bin.arc[1]).expect("a bin");
    let [normal, tangential, _, impulse, slip, finnie] = log.profile[hit].map(|sum| sum.value());
    assert_near(normal, row.dissipated[0]);
    assert_near(impulse, mass() * speed * (1.0 + restitution));
    assert_eq!((tangential, slip, finnie), (0.0, 0.0, 0.0));
    assert!(log.profile.iter().enumerate().all(|(index, bin)| index == hit || bin[3].value() == 0.0));
    assert_eq!((bins[hit].middle.y, bins[hit].normal.y.abs()), (0.0, 1.0));
}

/// Two discs in flight: a row between them, half of the loss each, none of it at a wall.
#[test]
fn an_impact_of_two_is_shared_by_them() {
    let half = RADIUS + 1e-6;
    let bodies = [([half, 0.0], [-0.25, 0.0], 0.0), ([-half, 0.0], [1.25, 0.0], 0.0)];
    let mut config = recorded(free_space());
    config.run.arc_bin = None;
    config.run.record.retain(|&recording| recording != Recording::WallProfile);
    config.contact.bundle.restitution = Some(0.6);
    let mut simulation = start(&config, several(&bodies));
    run_through_contact(&mut simulation, 10_000);
    let row = only(&simulation);
    assert_eq!((row.particle, row.other, row.part), (0, 1, NO_BODY));
    assert_near(row.dissipated[0], 0.25 * mass() * 1.5 * 1.5 * (1.0 - 0.6 * 0.6));
    assert_near(row.speeds[0], 1.5);
    let log = simulation.contact_log();
    for disc in &log.discs {
        assert_near(disc.received.dissipated_normal.value(), 0.5 * row.dissipated[0]);
        assert_eq!((disc.flights, disc.landings, disc.falls), (2, [0, 1], 0));
    }
    assert_near(log.split[0].dissipated_normal.value(), row.dissipated[0]);
}

/// A disc that slides with its spin locked: friction takes μ times the work of the normal force over the distance, and Archard's
/// integral is that work. The disc crosses the borders of bins, and the bins share what it does by their lengths.
#[test]
fn a_sliding_disc_shares_its_work_among_the_bins() {
    let mut config = recorded(floor([0.0, -GRAVITY]));
    config.load.spin_locked = true;
    config.contact.drum.friction = 0.3;
    config.run.arc_bin = Some(0.01);
    config.drum.walls = vec![vec![[0.0, 0.0], [1.0, 0.0]]];
    let depth = mass() * GRAVITY / 9.70e7;
    let mut simulation = start(&config, single([0.1003, RADIUS - depth], [1.0, 0.0], 0.0));
    run(&mut simulation, 0.06);
    let log = simulation.contact_log();
    let sliding = simulation.dissipated().dissipated_sliding;
    let slipped: f64 = log.profile.iter().map(|bin| bin[4].value()).sum();
    assert_near(slipped, sliding / 0.3);
    let distance = simulation.state().particles.positions[0].x - 0.1003;
    assert_near(slipped, mass() * GRAVITY * distance);
    for bin in 11..15 {
        let own = log.profile[bin][4].value();
        assert!((own / (mass() * GRAVITY * 0.01) - 1.0).abs() < 0.02, "bin {bin}: {own:e}");
    }
    assert_eq!(log.profile[9][4].value(), 0.0);
    assert!(simulation.records().contacts.is_empty(), "a contact that passes from bin to bin is one");
    assert_eq!(simulation.open_rows().len(), 1);
}

/// From four diameters above the floor, with e = 0.8: a fall, then a flight that ends as high as it began.
#[test]
fn falls_and_flights_are_told_apart() {
    let mut config = recorded(floor([0.0, -GRAVITY]));
    config.contact.drum.restitution = Some(0.8);
    config.run.time_step = Some(TIME_STEP);
    config.run.contact_floor = 1e3;
    let height = 8.0 * RADIUS;
    let mut simulation = start(&config, single([0.0, RADIUS + height], [0.0, 0.0], 0.0));
    let fall = (2.0 * height / GRAVITY).sqrt();
    run(&mut simulation, fall * (1.0 + 1.6 + 0.1));
    let disc = simulation.contact_log().discs[0];
    assert_eq!((disc.flights, disc.falls, disc.landings), (3, 1, [2, 0]));
    let in_flight = disc.steps_in_flight(simulation.state().step) as f64 * TIME_STEP;
    assert!((in_flight / simulation.time() - 1.0).abs() < 0.01, "{in_flight}");
    // Both impacts are below the floor.
    let below = &simulation.state().log.below_floor;
    assert!(simulation.records().contacts.is_empty());
    assert_eq!(below.count, 2);
    assert_near(below.dissipated[0].value(), simulation.dissipated().dissipated_normal);
}

/// f(γ) of Finnie: its two branches meet at tan γ = 1/3, at 0.3; none while bodies part.
#[test]
fn finnie_is_his_formula() {
    let force = 3.0;
    let of = |into: f64, along: f64| {
        let motion =
            RelativeMotion { overlap: 1e-6, separation_rate: -into, slip_rate: along, rolling_rate: 0.0 };
        let last = ContactState {
            overlap: 1e-6 - into * EXACT_STEP,
            separation_rate: -into,
            force_x: 0.0,
            force_y: 0.0,
            moment: 0.0,
        };
        let contact = Kinematics::new(&motion, &last, [EXACT_STEP, 1.0 / EXACT_STEP]);
        let (mut response, _) = respond(&linear_law(&law(1e7)), 1e-6, [0.0, 0.0], [1e-6, 0.0]);
        (response.normal_force, response.tangential_force) = (0.8 * force, 0.6 * force);
        let speed = into.hypot(along);
        Exertion::of_wall_step(&contact, &response).finnie / (2.0 * speed * force * EXACT_STEP)
    };
    for (angle, share) in
        [(5.0_f64, 0.150_86), (16.845, 0.302_78), (18.4349, 0.3), (45.0, 1.0 / 6.0), (90.0, 0.0)]
    {
        let angle = angle.to_radians();
        let found = of(0.01 * libm::sin(angle), 0.01 * libm::cos(angle));
        assert!((found - share).abs() < 1e-4, "{angle}: {found}, not {share}");
    }
    assert_eq!(of(-0.01, 0.01), 0.0);
}
