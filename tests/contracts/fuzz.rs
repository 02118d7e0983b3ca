//! The short form of the fuzz targets: the kept bytes of `fuzz/seeds`, each changed in some hundred ways.

use std::fs;
use std::path::Path;

use drumrs::io::config::SimulationConfig;
use drumrs::simulation::Simulation;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::robustness;

/// The kept bytes of a target, by name.
fn seeds(target: &str) -> Vec<Vec<u8>> {
    let folder = Path::new("fuzz/seeds").join(target);
    let mut paths: Vec<_> =
        fs::read_dir(folder).expect("kept bytes").map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    paths.iter().map(|path| fs::read(path).expect("a file")).collect()
}

/// Checkpoints of the kept configurations: made here, for the format may change.
fn checkpoints() -> Vec<Vec<u8>> {
    let of = |text: &Vec<u8>| {
        let config = SimulationConfig::from_json(std::str::from_utf8(text).expect("text")).expect("a seed");
        let mut simulation = Simulation::new(config, 1, 1).expect("a load that fits");
        simulation.run(300).expect("a stable run");
        simulation.to_checkpoint().expect("a good simulation")
    };
    seeds("config").iter().map(of).collect()
}

/// Hands a target its seeds and changed copies of them.
fn changed(seeds: Vec<Vec<u8>>, copies: usize, check: fn(&[u8])) {
    let mut random = Pcg64::seed_from_u64(1);
    let mut below = |most: usize| (random.next_u64() % most.max(1) as u64) as usize;
    for seed in seeds {
        check(&seed);
        for _ in 0..copies {
            let mut bytes = seed.clone();
            for _ in 0..=below(4) {
                let at = below(bytes.len());
                match below(5) {
                    0 => bytes.truncate(at),
                    // Lengths and counts that no memory could hold.
                    1 => bytes.splice(at..at, [255; 9]).for_each(drop),
                    2 => bytes.splice(at..at, *b"9e").for_each(drop),
                    _ if bytes.is_empty() => {}
                    3 => bytes[at] ^= 1 << below(8),
                    _ => bytes[at] = below(256) as u8,
                }
            }
            check(&bytes);
        }
    }
}

#[test]
fn any_bytes_as_a_configuration_are_an_error_or_a_simulation() {
    changed(seeds("config"), 300, robustness::config);
}

#[test]
fn any_bytes_as_a_checkpoint_are_an_error_or_a_simulation() {
    changed(checkpoints(), 300, robustness::checkpoint);
}

#[test]
fn every_byte_of_a_checkpoint_may_be_any_other() {
    let seed = checkpoints().into_iter().min_by_key(Vec::len).expect("a seed");
    for at in 0..seed.len() {
        let mut bytes = seed.clone();
        bytes[at] ^= 1 << (at % 8);
        robustness::checkpoint(&bytes);
        robustness::checkpoint(&seed[..at]);
    }
}

/// Not a test: what `cargo fuzz run checkpoint` starts from.
#[test]
#[ignore = "writes fuzz/seeds/checkpoint"]
fn write_checkpoints_to_start_from() {
    fs::create_dir_all("fuzz/seeds/checkpoint").expect("a folder");
    for (number, bytes) in checkpoints().iter().enumerate() {
        fs::write(format!("fuzz/seeds/checkpoint/{number}.bin"), bytes).expect("a file");
    }
}

#[test]
fn any_bytes_as_outlines_are_an_error_or_a_drum() {
    changed(seeds("outline"), 500, robustness::outline);
}

#[test]
fn any_bytes_as_a_program_are_an_error_or_a_rotation() {
    changed(seeds("rotation"), 2000, robustness::rotation);
}
