//! The module `drumrs._core`: one class, means over windows, and a description of this build.

mod arrays;
mod averages;
mod contact_arrays;
mod error;
mod fair_lock;
mod fork_guard;
mod pace;
mod simulation;

/// The compiled core of drumrs. Use the package `drumrs` instead.
#[pyo3::pymodule]
mod _core {
    use pyo3::prelude::*;
    use pyo3::types::PyDict;

    #[pymodule_export]
    use super::averages::{block_error, mean_rate, mean_ratio, mean_sampled, summary, window};
    #[pymodule_export]
    use super::simulation::Simulation;
    use crate::error::Error;
    use crate::io::config::{MOST_BUNDLES, MOST_SPECIES, SimulationConfig};
    use crate::physics::drum::MOST_BAFFLES;
    use crate::physics::load::composition::{Composition, SpeciesParameters};
    use crate::physics::load::shares::Measure;
    use crate::simulation::derived::DerivedParameters;
    /// The fewest blocks from which a standard error is taken.
    #[pymodule_export]
    const FEWEST_BLOCKS: usize = crate::observe::averages::FEWEST_BLOCKS;

    /// What this build is: version, profile, physics version, target, the instructions that it is made for, and the features of
    /// the CPU that it runs on.
    #[pyfunction]
    fn info(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
        let info = PyDict::new(py);
        info.set_item("version", env!("CARGO_PKG_VERSION"))?;
        info.set_item("build_profile", if cfg!(debug_assertions) { "debug" } else { "release" })?;
        info.set_item("physics_version", crate::PHYSICS_VERSION)?;
        info.set_item("target", format!("{}-{}", std::env::consts::ARCH, std::env::consts::OS))?;
        info.set_item("core", super::INSTRUCTION_SET)?;
        info.set_item("cpu_features", super::cpu_features())?;
        info.set_item("cpu_count", std::thread::available_parallelism().map_or(1, usize::from))?;
        Ok(info)
    }

    /// The greatest numbers that a configuration may have: of bundles, species, baffles.
    #[pyfunction]
    fn greatest_counts() -> (usize, usize, usize) {
        (MOST_BUNDLES, MOST_SPECIES, MOST_BAFFLES)
    }

    /// What a load is made of, given the core's `load.species` in JSON: area [m²] and mass [kg/m] of a disc, on average, and how many
    /// of `count` discs are of each species.
    #[pyfunction]
    fn composition(species: &str, share_by: &str, count: usize) -> Result<(f64, f64, Vec<usize>), Error> {
        let refuse = |error: serde_json::Error| Error::config("load.species", error.to_string(), "species");
        let species: Vec<SpeciesParameters> = serde_json::from_str(species).map_err(refuse)?;
        let share_by: Measure = serde_json::from_value(share_by.into()).map_err(refuse)?;
        let composition = Composition::new(&species, share_by)?;
        Ok((composition.mean_area, composition.mean_mass, composition.counts(count)))
    }

    /// What follows from a configuration, both in JSON, with a seed; see `drumrs.Config.derived`.
    #[pyfunction]
    fn derived(config: &str, seed: u64) -> Result<String, Error> {
        let derived = DerivedParameters::new(&SimulationConfig::from_json(config)?, seed)?;
        Ok(serde_json::to_string(&derived).expect("plain numbers"))
    }

    /// Before a fork: waits until no thread is inside a simulation, and keeps them out.
    #[pyfunction]
    fn close_fork_guard(py: Python<'_>) {
        py.detach(super::fork_guard::close);
    }

    /// After a fork, in the parent.
    #[pyfunction]
    fn open_fork_guard() {
        super::fork_guard::open();
    }

    /// After a fork, in the child.
    #[pyfunction]
    fn open_fork_guard_in_child() {
        super::fork_guard::open_in_child();
    }
}

/// The instructions that this build is made for; `drumrs.cores` chooses by it.
const INSTRUCTION_SET: &str = if cfg!(all(
    target_arch = "x86_64",
    target_feature = "avx2",
    target_feature = "bmi2",
    target_feature = "fma"
)) {
    "x86-64-v3"
} else if cfg!(target_arch = "x86_64") {
    "x86-64"
} else {
    std::env::consts::ARCH
};

/// Those features of this CPU that numeric code may care about.
#[cfg(target_arch = "x86_64")]
fn cpu_features() -> Vec<&'static str> {
    macro_rules! present {
        ($($name:tt),*) => {
            [$(($name, std::arch::is_x86_feature_detected!($name))),*]
        };
    }
    let features =
        present!("sse4.2", "avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "lzcnt", "movbe", "avx512f");
    features.iter().filter(|(_, present)| *present).map(|(name, _)| *name).collect()
}

/// Other CPUs have their features fixed by the target.
#[cfg(not(target_arch = "x86_64"))]
fn cpu_features() -> Vec<&'static str> {
    Vec::new()
}
