//! The baseline step for `instructions.sh`, which counts what it costs: `settle FILE BAFFLES` makes a load in the tumble,
//! `run FILE STEPS` goes on with it. Any other arguments, such as those of `cargo bench`, do nothing.

mod scenes;

use std::path::Path;

use drumrs::simulation::Simulation;

const COUNT: usize = 200;

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let words: Vec<&str> = arguments[1..].iter().map(String::as_str).collect();
    match words[..] {
        ["settle", file, baffles] => {
            let config = scenes::drum_for(COUNT, baffles.parse().expect("a number of baffles"));
            let mut simulation = Simulation::new(config, 1, 1).expect("a load that fits");
            simulation.run(200_000).expect("a stable run");
            simulation.save(Path::new(file)).expect("a file to write");
        }
        ["run", file, steps] => {
            let mut simulation = Simulation::load(Path::new(file), 1).expect("a settled load");
            simulation.run(steps.parse().expect("a number of steps")).expect("a stable run");
        }
        _ => {}
    }
}
