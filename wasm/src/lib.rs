//! The core for WebAssembly: what a page or a program in JavaScript needs of a simulation, and nothing that computes.
//!
//! Configurations are those that the core reads (`Config.to_core_json` in Python). A simulation has one thread. Vectors are
//! copies in the order of the bundles' ids, x and y of one after those of the other.

use drumrs::error::Error;
use drumrs::io::config::SimulationConfig;
use drumrs::physics::particles::Particles;
use drumrs::physics::vector::Vec2;
use wasm_bindgen::prelude::*;

/// A drum with its load, at some step.
#[wasm_bindgen]
pub struct Simulation {
    core: drumrs::simulation::Simulation,
}

#[wasm_bindgen]
impl Simulation {
    /// Packs the load at random into the turning drum.
    #[wasm_bindgen(constructor)]
    pub fn new(config: &str, seed: u32) -> Result<Self, JsError> {
        let config = SimulationConfig::from_json(config).map_err(told)?;
        let core = drumrs::simulation::Simulation::new(config, seed.into(), 1).map_err(told)?;
        Ok(Self { core })
    }

    /// Does so many steps. Frames are not kept: whoever wants to see the load asks for it.
    pub fn run(&mut self, steps: u32) -> Result<(), JsError> {
        self.core.run(steps.into()).map_err(told)?;
        self.core.take_frames();
        Ok(())
    }

    /// Goes on from this state under another configuration, with the samples to come.
    pub fn change(&mut self, config: &str) -> Result<(), JsError> {
        let config = SimulationConfig::from_json(config).map_err(told)?;
        self.core.take_rows().map_err(told)?;
        self.core = self.core.with_config(config).map_err(told)?;
        Ok(())
    }

    /// Number of steps done.
    #[wasm_bindgen(getter)]
    pub fn step(&self) -> f64 {
        self.core.state().step as f64
    }

    /// Time [s].
    #[wasm_bindgen(getter)]
    pub fn time(&self) -> f64 {
        self.core.time()
    }

    /// Length of a step [s].
    #[wasm_bindgen(getter)]
    pub fn time_step(&self) -> f64 {
        self.core.time_step()
    }

    /// Angle of the drum [rad].
    #[wasm_bindgen(getter)]
    pub fn drum_angle(&self) -> f64 {
        self.core.drum_angle()
    }

    /// Angular velocity of the drum [rad/s].
    #[wasm_bindgen(getter)]
    pub fn drum_angular_velocity(&self) -> f64 {
        self.core.config().rotation.angular_velocity(self.core.time())
    }

    /// Centers [m].
    pub fn positions(&self) -> Vec<f64> {
        self.pairs(|particles| &particles.positions)
    }

    /// Velocities [m/s].
    pub fn velocities(&self) -> Vec<f64> {
        self.pairs(|particles| &particles.velocities)
    }

    /// Angles [rad].
    pub fn angles(&self) -> Vec<f64> {
        self.by_id(|particles| &particles.angles)
    }

    /// Radii [m].
    pub fn radii(&self) -> Vec<f64> {
        self.by_id(|particles| &particles.radii)
    }

    /// Names of what is sampled, the ledger's energies among it.
    pub fn columns(&self) -> Vec<String> {
        self.core.series().columns().iter().map(|column| column.name.to_string()).collect()
    }

    /// The last sample, a number for each of the columns; empty before the first.
    pub fn last_sample(&self) -> Vec<f64> {
        let series = self.core.series();
        series.len().checked_sub(1).map_or_else(Vec::new, |last| series.rows_from(last).to_vec())
    }
}

impl Simulation {
    fn by_id<T: Copy>(&self, values: fn(&Particles) -> &[T]) -> Vec<T> {
        let particles = &self.core.state().particles;
        particles.by_id(values(particles))
    }

    fn pairs(&self, values: fn(&Particles) -> &[Vec2]) -> Vec<f64> {
        self.by_id(values).iter().flat_map(|vector| [vector.x, vector.y]).collect()
    }
}

/// An error of the core in a sentence, with the way out.
#[allow(clippy::needless_pass_by_value)] // What `map_err` gives.
fn told(error: Error) -> JsError {
    JsError::new(&error.to_string())
}
