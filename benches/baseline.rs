//! The loads for `instructions.sh`, which counts what a step costs: `settle FILE COUNT BAFFLES` makes one in the tumble and prints its
//! contacts per bundle, with `mixed` one of sizes 1 : 2, with `recorded` one of which all is recorded that can be; `run FILE
//! STEPS` goes on with it.

mod scenes;

use drumrs::simulation::Simulation;

/// What a load in Table 1's drum needs to come into the tumble [s].
const SETTLING: f64 = 5.0;
/// Larger loads start as a bed, and have moved on from it after these steps.
const LARGE_STEPS: u64 = 2_000;

fn number(word: &str) -> usize {
    word.parse().expect("a number")
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let words: Vec<&str> = arguments[1..].iter().map(String::as_str).collect();
    match words[..] {
        ["settle", file, count, baffles, ref more @ ..] => {
            let (count, baffles) = (number(count), number(baffles));
            let mut simulation = match more {
                [] => scenes::started(count, baffles),
                ["mixed"] => scenes::mixed(count, 2.0),
                _ => scenes::started_with(count, baffles, scenes::ALL_RECORDS),
            };
            let steps = match count {
                0..=300 => (SETTLING / simulation.time_step()).round() as u64,
                _ => LARGE_STEPS,
            };
            simulation.run(steps).expect("a stable run");
            let bytes = simulation.to_checkpoint().expect("a stable load");
            std::fs::write(file, bytes).expect("a file to write");
            let (pairs, walls) = simulation.contacts().counts();
            println!("{:.2}", (pairs + walls) as f64 / count as f64);
        }
        ["run", file, steps] => {
            let bytes = std::fs::read(file).expect("a file to read");
            let mut simulation = Simulation::from_checkpoint(&bytes, 1).expect("a settled load");
            simulation.run(number(steps) as u64).expect("a stable run");
        }
        _ => panic!("settle FILE COUNT BAFFLES [mixed | recorded], or run FILE STEPS"),
    }
}
