//! Window means and their errors: which samples a window takes, what is left undefined, blocks, the time step.

use crate::common::*;
use drumrs::observe::averages::BlockError;
use drumrs::observe::summary::summarize;
use drumrs::simulation::Simulation;

fn tumbled(seconds: f64) -> Simulation {
    let mut simulation = Simulation::new(baseline(40, 3), 2, 1).unwrap();
    run(&mut simulation, seconds);
    simulation
}

fn optional(simulation: &Simulation, name: &str, window: [f64; 2]) -> Option<f64> {
    let statistics = summarize(simulation.series(), simulation.mass(), window[0], window[1]).unwrap();
    statistics.iter().find(|entry| entry.0 == name).unwrap().1
}

#[test]
fn a_window_snaps_to_the_nearest_samples() {
    let simulation = tumbled(0.05);
    let times = column(&simulation, "time");
    let bounds = |start, end| {
        ["window_start", "window_end"].map(|name| {
            let time = statistic(&simulation, name, start, end);
            times.iter().position(|&sample| sample == time).unwrap()
        })
    };
    assert_eq!(bounds(0.0, 0.05), [0, 50]);
    assert_eq!(bounds(0.0104, 0.0206), [10, 21]);
    assert_eq!(bounds(-3.0, 100.0), [0, times.len() - 1]);
    assert_eq!(bounds(0.0314, 0.0316), [31, 32]);
}

#[test]
fn windows_without_two_samples_are_refused() {
    let simulation = tumbled(0.02);
    for (start, end) in [(0.01, 0.01), (0.015, 0.005), (5.0, 6.0), (0.0101, 0.0102), (f64::NAN, 0.01)] {
        let error = summarize(simulation.series(), 1.0, start, end).unwrap_err().to_string();
        let expected = format!(
            "run.window is [{start}, {end}], but must be a window that holds at least two samples of the run"
        );
        assert_eq!(error, expected);
    }
}

#[test]
fn powers_are_differences_of_energies() {
    let simulation = tumbled(0.3);
    let value = |name| statistic(&simulation, name, 0.1, 0.3);
    let change = |name| {
        let energies = column(&simulation, name);
        (energies[300] - energies[100])
            / (column(&simulation, "time")[300] - column(&simulation, "time")[100])
    };
    let near = |one: f64, other: f64| (one - other).abs() <= 1e-12 * one.abs().max(other.abs());
    assert!(value("drum_power") != 0.0);
    assert!(near(value("drum_power"), change("drum_work")));
    assert!(near(value("drum_specific_power"), change("drum_work") / simulation.mass()));
    assert!(near(value("drum_torque"), change("drum_work") / SPEED));
    let normal = change("dissipated_normal") + change("elastic_normal");
    let tangential = change("dissipated_sliding") + change("elastic_tangential");
    assert!(near(value("normal_power"), normal) && near(value("tangential_power"), tangential));
    assert!(near(value("work_ratio"), normal / tangential));
    assert!(near(value("normal_power"), normal) && near(value("tangential_power"), tangential));
    // Springs, dashpots, sliding and the numerical share make up the work into contacts: what the drum gives and motion
    // does not take.
    let shares = normal + tangential + value("numerical_power");
    let motion = change("kinetic_translation") + change("kinetic_rotation") + change("gravitational");
    assert!((shares + motion - value("drum_power")).abs() < 1e-9 * shares.abs());
    // Interval means average to the window's mean; the interval that ends at the window's start is not in it.
    let powers = &column(&simulation, "drum_power")[101..=300];
    assert!((powers.iter().sum::<f64>() / 200.0 / value("drum_power") - 1.0).abs() < 1e-9);
    let greatest = column(&simulation, "max_overlap_ratio")[101..=300].iter().copied().fold(0.0, f64::max);
    assert_eq!(value("max_overlap_ratio"), greatest);
}

#[test]
fn the_greatest_overlap_is_that_of_its_interval() {
    let mut config = free_space();
    config.run.sample_every = 1e-4;
    let half = RADIUS + 1e-4;
    let bodies = [([-half, 0.0], [0.5, 0.0], 0.0), ([half, 0.0], [-0.5, 0.0], 0.0)];
    let mut simulation = start(&config, several(&bodies));
    run(&mut simulation, 1e-3);
    // They meet after 0.2 ms and part within another 0.2 ms.
    let ratios = column(&simulation, "max_overlap_ratio");
    assert!(ratios[..2].iter().chain(&ratios[5..]).all(|&ratio| ratio == 0.0), "{ratios:?}");
    assert!(ratios[3] > 0.0, "{ratios:?}");
}

#[test]
fn what_is_not_defined_is_none() {
    let mut config = free_space();
    config.run.sample_every = 1e-3;
    let mut simulation = start(&config, single([0.0, 0.0], [1.0, 0.0], 0.0));
    run(&mut simulation, 0.05);
    let window = [0.0, 0.05];
    assert_eq!(optional(&simulation, "work_ratio", window), None, "nothing touches");
    assert_eq!(optional(&simulation, "drum_torque", window), Some(0.0));
    assert_eq!(optional(&simulation, "power_disagreement", window), Some(0.0));
    assert_eq!(optional(&simulation, "energy_residual", window), Some(0.0));
    assert_eq!(optional(&simulation, "drum_specific_power_error", [0.0, 0.007]), None, "seven intervals");
    assert_eq!(
        optional(&simulation, "drum_specific_power_error", [0.0, 0.008]),
        Some(0.0),
        "eight intervals"
    );
}

/// A first-order autoregressive sequence: its integrated correlation time is ½ (1 + φ)/(1 − φ) intervals, and the mean
/// of n values has the variance σ²/n (1 + φ)/(1 − φ).
#[test]
fn block_errors_meet_an_autoregressive_sequence() {
    let (persistence, count, sequences) = (0.8_f64, 1 << 13, 20);
    let inflation = (1.0 + persistence) / (1.0 - persistence);
    let mut state = 9_u64;
    let mut uniform = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    let (mut error, mut time) = (0.0, 0.0);
    for _ in 0..sequences {
        let mut value = 0.0;
        let values: Vec<f64> = (0..count)
            .map(|_| {
                value = persistence * value + uniform();
                value
            })
            .collect();
        let spread = BlockError::of(&values, 0.01).unwrap();
        error += spread.error / f64::from(sequences);
        time += spread.correlation_time / f64::from(sequences);
    }
    let variance = 1.0 / 12.0 / (1.0 - persistence * persistence);
    let expected = (variance / f64::from(count) * inflation).sqrt();
    // The greatest of the block errors is taken, and those of few blocks scatter: it errs to the safe side.
    assert!(error / expected > 0.95 && error / expected < 1.6, "{}", error / expected);
    assert!(
        time / (0.005 * inflation) > 0.9 && time / (0.005 * inflation) < 2.5,
        "{}",
        time / (0.005 * inflation)
    );
}

/// Halving the time step changes the means of a window within their errors.
#[test]
fn half_the_time_step_gives_the_same_means() {
    let mean = |time_step: f64| {
        let mut config = baseline(60, 0);
        config.run.time_step = Some(time_step);
        let mut simulation = Simulation::new(config, 1, 1).unwrap();
        run(&mut simulation, 5.0);
        ["drum_specific_power", "drum_specific_power_error"]
            .map(|name| statistic(&simulation, name, 1.0, 5.0))
    };
    let ([coarse, coarse_error], [fine, fine_error]) = (mean(1.48e-5), mean(7.4e-6));
    let error = (coarse_error * coarse_error + fine_error * fine_error).sqrt();
    assert!(error < 0.05 * fine, "{fine} ± {error}");
    assert!((coarse - fine).abs() < 3.0 * error, "{coarse} against {fine} ± {error}");
}
