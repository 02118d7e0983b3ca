//! One turn of the paper's drum, from Rust: 100 bundles, three baffles. Run it with
//! `cargo run --release --example one_turn`.

use drumrs::error::Error;
use drumrs::io::config::SimulationConfig;
use drumrs::observe::summary::summarize;
use drumrs::simulation::Simulation;

/// Table 1 of Park & Wassgren (the baffles' shape is inferred), SI, 54 rpm.
const CONFIG: &str = r#"{
  "drum": {
    "radius": 0.2375,
    "shell": null,
    "baffles": [{"name": "baffle", "count": 3, "shape": "triangle", "height": 0.04, "base": 0.02, "tip": 0.01,
                 "corner_radius": 0.0, "chord_error": 1e-4, "points": null, "phase": 0.0}],
    "walls": []
  },
  "rotation": {"knots": [[0.0, 5.6548667764616276]]},
  "load": {"count": 100, "diameter": 0.02375, "density": 1000.0, "species": [], "share_by": "mass",
           "start_speed": 0.0, "spin_locked": false},
  "contact": {
    "bundle": {"base": "linear", "young_modulus": null, "poisson_ratio": 0.3, "normal_stiffness": 9.25e7, "stiffness_ratio": 1.0, "restitution": 0.1, "normal_damping": null,
               "friction": 0.5, "tension": "allowed", "rolling_friction": 0.0, "tangential_damping_ratio": 0.0,
               "adhesion": 0.0},
    "drum": {"base": "linear", "young_modulus": null, "poisson_ratio": 0.3, "normal_stiffness": 9.70e7, "stiffness_ratio": 1.0, "restitution": 0.1, "normal_damping": null,
             "friction": 0.5, "tension": "allowed", "rolling_friction": 0.0, "tangential_damping_ratio": 0.0,
               "adhesion": 0.0},
    "species": 1, "pairs": [], "walls": []
  },
  "gravity": [0.0, -9.81],
  "run": {"time_step": 3.7e-6, "sample_every": 0.002, "frame_every": 0.04, "skin": null, "record": [], "contact_floor": 0.0, "arc_bin": null, "cell": null, "zones": [], "sums_from": 0.0, "overlap_limit": 0.5}
}"#;

fn main() -> Result<(), Error> {
    let mut simulation = Simulation::new(SimulationConfig::from_json(CONFIG)?, 1, 1)?;
    let speed = simulation.config().rotation.angular_velocity(0.0);
    let turn = std::f64::consts::TAU / speed;
    simulation.run((turn / simulation.time_step()).ceil() as u64)?;
    let series = simulation.series();
    for (name, value) in summarize(series, simulation.mass(), 0.5 * turn, turn)? {
        println!("{name:26} {}", value.map_or("-".to_owned(), |value| format!("{value:.6e}")));
    }
    Ok(())
}
