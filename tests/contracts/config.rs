//! The configuration at the border: every key is there, is required, survives the round trip in every bit, and has its
//! limits.

use crate::common::*;
use drumrs::io::config::SimulationConfig;
use drumrs::physics::drum::baffle::BaffleShape;
use serde_json::Value;

/// Every key of a configuration; `knots`, `walls`, `points` and `gravity` are lists.
const KEYS: &[&str] = &[
    "contact.bundle.adhesion",
    "contact.bundle.base",
    "contact.bundle.friction",
    "contact.bundle.normal_damping",
    "contact.bundle.normal_stiffness",
    "contact.bundle.poisson_ratio",
    "contact.bundle.restitution",
    "contact.bundle.rolling_friction",
    "contact.bundle.stiffness_ratio",
    "contact.bundle.tangential_damping_ratio",
    "contact.bundle.tension",
    "contact.bundle.young_modulus",
    "contact.drum.adhesion",
    "contact.drum.base",
    "contact.drum.friction",
    "contact.drum.normal_damping",
    "contact.drum.normal_stiffness",
    "contact.drum.poisson_ratio",
    "contact.drum.restitution",
    "contact.drum.rolling_friction",
    "contact.drum.stiffness_ratio",
    "contact.drum.tangential_damping_ratio",
    "contact.drum.tension",
    "contact.drum.young_modulus",
    "contact.pairs",
    "contact.species",
    "contact.walls",
    "drum.baffles",
    "drum.radius",
    "drum.shell",
    "drum.walls",
    "gravity",
    "load.count",
    "load.density",
    "load.diameter",
    "load.share_by",
    "load.species",
    "load.spin_locked",
    "load.start_speed",
    "rotation.knots",
    "run.arc_bin",
    "run.cell",
    "run.contact_floor",
    "run.frame_every",
    "run.overlap_limit",
    "run.record",
    "run.sample_every",
    "run.skin",
    "run.sums_from",
    "run.time_step",
    "run.zones",
];

fn tree(config: &SimulationConfig) -> Value {
    serde_json::from_str(&config.to_json()).unwrap()
}

fn keys_of(value: &Value, prefix: &str, keys: &mut Vec<String>) {
    match value.as_object() {
        Some(table) => {
            for (name, inner) in table {
                let dot = if prefix.is_empty() { "" } else { "." };
                keys_of(inner, &format!("{prefix}{dot}{name}"), keys);
            }
        }
        None => keys.push(prefix.to_owned()),
    }
}

/// The table that holds `key`.
fn table_of<'a>(tree: &'a mut Value, key: &str) -> &'a mut serde_json::Map<String, Value> {
    let folders = key.rsplit_once('.').map_or("", |(path, _)| path);
    let pointer = if folders.is_empty() { String::new() } else { format!("/{}", folders.replace('.', "/")) };
    tree.pointer_mut(&pointer).and_then(Value::as_object_mut).expect("a table")
}

fn refusal(tree: &Value) -> String {
    SimulationConfig::from_json(&tree.to_string()).unwrap_err().to_string()
}

/// A configuration with every option taken and numbers that have no short decimal form.
fn elaborate() -> SimulationConfig {
    let mut config = baseline(7, 4);
    config.drum.baffles[0].shape = BaffleShape::Polygon;
    config.drum.baffles[0].points = Some(vec![[0.0, 0.1 + 0.2 - 0.28], [1.0 / 30.0, 0.01], [0.0, -0.02]]);
    config.drum.baffles[0].phase = -std::f64::consts::PI / 7.0;
    config.drum.walls = vec![vec![[0.1 / 3.0, -0.05], [f64::MIN_POSITIVE, 1e-300]]];
    config.rotation.knots = vec![[0.1, SPEED], [2.0 / 3.0, -SPEED / 3.0]];
    config.contact.drum.restitution = None;
    config.contact.drum.normal_damping = Some(7.74e3 / 3.0);
    config.gravity = [-0.0, -9.806_65];
    config.run.time_step = Some(1e-6 / 3.0);
    config.run.skin = Some(0.0);
    config
}

#[test]
fn the_keys_are_these() {
    let mut keys = Vec::new();
    keys_of(&tree(&baseline(1, 0)), "", &mut keys);
    keys.sort_unstable();
    assert_eq!(keys, KEYS);
}

#[test]
fn every_bit_survives_the_round_trip() {
    for config in [baseline(100, 3), free_space(), elaborate()] {
        let text = config.to_json();
        let read = SimulationConfig::from_json(&text).unwrap();
        assert_eq!(read, config);
        // Equality holds -0 for 0; the shortest decimal form does not.
        assert_eq!(read.to_json(), text);
    }
    assert_eq!(SimulationConfig::from_json(&elaborate().to_json()).unwrap().gravity[0].to_bits(), 1 << 63);
}

#[test]
fn unknown_fields_are_refused() {
    for key in KEYS {
        let mut tree = tree(&elaborate());
        table_of(&mut tree, key).insert("spin_speed".into(), 1.into());
        assert!(refusal(&tree).contains("unknown field `spin_speed`"), "{key}: {}", refusal(&tree));
    }
}

/// Where a restitution or a damping is missing, the other one decides; `ContactParameters` asks for exactly one.
#[test]
fn missing_fields_are_refused() {
    for key in KEYS {
        let mut tree = tree(&elaborate());
        let name = key.rsplit('.').next().unwrap();
        table_of(&mut tree, key).remove(name).unwrap();
        assert!(refusal(&tree).contains(&format!("missing field `{name}`")), "{key}: {}", refusal(&tree));
    }
}

#[test]
fn values_outside_their_limits_are_refused_by_name() {
    let numbers: &[(&str, f64, &str)] = &[
        ("drum.radius", 0.0, "drum.diameter is 0, but must be a positive finite number"),
        ("load.count", 0.0, "load.count is 0, but must be between 1 and 10000000"),
        ("load.diameter", -1.0, "load.diameter is -1, but must be a positive finite number"),
        (
            "load.diameter",
            0.475,
            "load.diameter is 0.475, but must be smaller than the drum's diameter 0.475",
        ),
        ("load.density", 0.0, "load.density is 0, but must be a positive finite number"),
        ("load.start_speed", -0.5, "load.start_speed is -0.5, but must be a finite number of at least 0"),
        (
            "contact.bundle.friction",
            -0.1,
            "contact.bundle.friction is -0.1, but must be a finite number of at least 0",
        ),
        (
            "contact.drum.stiffness_ratio",
            0.0,
            "contact.drum.stiffness_ratio is 0, but must be a positive finite number",
        ),
        (
            "contact.bundle.restitution",
            1.5,
            "contact.bundle.restitution is 1.5, but must be above 0 and at most 1",
        ),
        ("run.time_step", 0.0, "run.time_step is 0, but must be a positive finite number"),
        ("run.sample_every", -1.0, "run.sample_every is -1, but must be a positive finite number"),
        ("run.frame_every", 0.0, "run.frame_every is 0, but must be a positive finite number"),
        ("run.skin", -1e-3, "run.skin is -0.001, but must be a finite number of at least 0"),
        ("run.overlap_limit", 1.0, "run.overlap_limit is 1, but must be between 0 and 1"),
    ];
    for &(key, value, message) in numbers {
        let mut tree = tree(&baseline(10, 0));
        let name = key.rsplit('.').next().unwrap();
        let value = if key == "load.count" { (value as u64).into() } else { value.into() };
        table_of(&mut tree, key).insert(name.into(), value);
        assert_eq!(refusal(&tree), message);
    }
    // JSON has no infinity; a struct may hold one.
    let mut config = baseline(10, 0);
    config.gravity[1] = f64::NEG_INFINITY;
    assert_eq!(config.validate().unwrap_err().to_string(), "gravity is -inf, but must be a finite number");
}

#[test]
fn text_that_is_no_configuration_is_refused() {
    for text in ["", "{", "[]", "null", "{\"drum\": 3}"] {
        let message = SimulationConfig::from_json(text).unwrap_err().to_string();
        assert!(message.starts_with("config is '"), "{message}");
        assert!(message.ends_with("but must be valid JSON with every field"), "{message}");
    }
}
