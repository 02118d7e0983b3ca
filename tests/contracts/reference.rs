//! Positions after a few steps from stored states, as another implementation of the same scheme found them: the core as it
//! was up to physics version 2. Sums in another order and the rate of separation remembered along the old normal make the
//! difference.

use std::fs;

use drumrs::engine::contacts::ContactRecord;
use drumrs::engine::forces::Lists;
use drumrs::io::config::SimulationConfig;
use drumrs::physics::vector::{Vec2, cross, perpendicular};
use drumrs::simulation::Simulation;
use drumrs::simulation::initial_state::InitialState;
use serde_json::Value;

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("numbers").iter().map(number).collect()
}

fn vector(value: &Value) -> Vec2 {
    Vec2::new(number(&value[0]), number(&value[1]))
}

fn vectors(value: &Value) -> Vec<Vec2> {
    value.as_array().expect("vectors").iter().map(vector).collect()
}

/// The configuration of a stored state, in the present form, from its time on.
fn config(stored: &Value) -> SimulationConfig {
    let mut config = stored["config"].clone();
    let contact = config["contact"].as_object_mut().expect("a table");
    contact.insert("species".into(), 1.into());
    for table in ["bundle", "drum"] {
        for term in ["adhesion", "tangential_damping_ratio", "rolling_friction"] {
            contact[table][term] = 0.0.into();
        }
        contact[table]["base"] = "linear".into();
        contact[table]["young_modulus"] = Value::Null;
        contact[table]["poisson_ratio"] = 0.3.into();
    }
    contact.insert("pairs".into(), Value::Array(Vec::new()));
    contact.insert("walls".into(), Value::Array(Vec::new()));
    config["load"]["species"] = Value::Array(Vec::new());
    let drum = config["drum"].as_object_mut().expect("a table");
    drum.insert("shell".into(), Value::Null);
    let baffles = drum.get_mut("baffles").expect("baffles");
    baffles["name"] = "baffle".into();
    baffles["corner_radius"] = 0.0.into();
    baffles["chord_error"] = 1e-4.into();
    *baffles = Value::Array(vec![baffles.take()]);
    config["load"]["share_by"] = "mass".into();
    let mut config = SimulationConfig::from_json(&config.to_string()).expect("a valid configuration");
    let time = number(&stored["time"]);
    let (mut knots, now) = (Vec::new(), config.rotation.angular_velocity(time));
    knots.push([0.0, now]);
    knots.extend(
        config.rotation.knots.iter().filter(|knot| knot[0] > time).map(|knot| [knot[0] - time, knot[1]]),
    );
    config.rotation.knots = knots;
    config
}

/// A contact as it was, and what it did half a step before: the rate at which its bodies parted.
fn record(contact: &Value, other: u32, mid: &[(Vec2, f64)], radii: &[f64], walls: bool) -> ContactRecord {
    let particle = contact[if walls { "particle" } else { "i" }].as_u64().expect("an id") as u32;
    let (normal, overlap) = (vector(&contact["normal"]), number(&contact["overlap"]));
    let (push, pull) = (number(&contact["normal_force"]), number(&contact["tangential_force"]));
    let force = normal * push - perpendicular(normal) * pull;
    let own = particle as usize;
    let (arm, other_arm, velocity) = if walls {
        (radii[own] - overlap, 0.0, -mid[own].0)
    } else {
        let other = other as usize;
        (radii[own] - 0.5 * overlap, radii[other] - 0.5 * overlap, mid[other].0 - mid[own].0)
    };
    let mut history = [0.0; ContactRecord::MOST_COLUMNS];
    history[0] = number(&contact["tangential_displacement"]);
    ContactRecord {
        particle,
        other,
        overlap,
        separation_rate: velocity.dot(&normal),
        force: force.into(),
        moments: [arm * pull, other_arm * pull],
        history,
    }
}

fn compare(name: &str, tolerances: [f64; 2]) {
    let text = fs::read_to_string(format!("tests/data/reference/{name}.json")).expect("a stored state");
    let stored: Value = serde_json::from_str(&text).expect("JSON");
    let particles = &stored["particles"];
    let config = config(&stored);
    let (velocities, spins) = (vectors(&particles["velocities"]), numbers(&particles["angular_velocities"]));
    let accelerations = vectors(&particles["accelerations"]);
    let half = 0.5 * number(&stored["time_step"]);
    let mid: Vec<(Vec2, f64)> =
        velocities.iter().zip(&accelerations).zip(&spins).map(|((v, a), &w)| (v - a * half, w)).collect();
    let (positions, radii) = (vectors(&particles["positions"]), numbers(&particles["radii"]));
    let angular_velocity = number(&stored["angular_velocity"]);
    let pairs = stored["pairs"].as_array().expect("contacts").iter();
    let walls = stored["walls"].as_array().expect("contacts").iter();
    let contacts = Lists {
        pairs: pairs
            .map(|c| record(c, c["j"].as_u64().expect("an id") as u32, &mid, &radii, false))
            .collect(),
        walls: walls
            .map(|c| {
                let feature = c["feature"].as_u64().expect("a feature") as u32;
                let mut record = record(c, feature, &mid, &radii, true);
                // The surface moves along the normal, too, but for the rim.
                let normal = vector(&c["normal"]);
                let point = positions[record.particle as usize]
                    + normal * (radii[record.particle as usize] - record.overlap);
                record.separation_rate += angular_velocity * cross(point, normal);
                record
            })
            .collect(),
        ..Lists::default()
    };
    let given = contacts.clone();
    let initial = InitialState {
        positions: vectors(&particles["positions"]),
        velocities: Some(velocities),
        angles: Some(numbers(&particles["angles"])),
        angular_velocities: Some(spins),
        radii: Some(radii),
        species: None,
        drum_angle: number(&stored["drum_angle"]),
        contacts,
    };
    let mut simulation = Simulation::with_state(config, 1, 1, initial).expect("a valid state");
    assert_eq!(simulation.contacts().pairs.len(), given.pairs.len(), "{name}: all contacts were taken");
    assert_eq!(simulation.contacts().walls.len(), given.walls.len(), "{name}: all contacts were taken");
    for ((steps, more), tolerance) in [(2, 2), (20, 18)].into_iter().zip(tolerances) {
        simulation.run(more).expect("a stable run");
        let expected = vectors(&stored["after"][steps.to_string()]["positions"]);
        let found = &simulation.state().particles.positions;
        let worst = found.iter().zip(&expected).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        println!("{name} after {steps} steps: {worst:.1e} m");
        assert!(worst <= tolerance, "{name} after {steps} steps: {worst:e} m");
    }
}

#[test]
fn bare_drums() {
    compare("bare_100", [1e-11, 1e-9]);
    compare("bare_300", [1e-11, 1e-9]);
}

#[test]
fn baffles() {
    compare("baffles_100", [1e-11, 1e-9]);
}

#[test]
fn mixed_radii() {
    compare("mixed_100", [1e-11, 1e-9]);
}

#[test]
fn reversing_program() {
    compare("reversing_100", [1e-11, 1e-9]);
}

#[test]
fn clipped_tension() {
    compare("clipped_100", [1e-11, 1e-9]);
}
