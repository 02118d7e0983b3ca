//! One step of a tumbling drum, ledger and recording on: 25 % fill of Table 1's drum at N = 100, 75 % at 300, and
//! drums grown with their load (40 % fill, same Froude number) above.

#[path = "../tests/common/mod.rs"]
mod common;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use drumrs::config::SimulationConfig;
use drumrs::simulation::Simulation;

/// Table 1's drum up to 300 bundles, a larger one beyond.
fn drum_for(count: usize, baffle_count: usize) -> SimulationConfig {
    let mut config = common::baseline(count, baffle_count);
    if count > 300 {
        let radius = common::RADIUS * (count as f64 / 0.4).sqrt();
        config.drum.radius = Some(radius);
        config.rotation.knots = vec![[0.0, (0.774 * common::GRAVITY / radius).sqrt()]];
    }
    config
}

fn steps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("step");
    group.sample_size(20);
    for baffle_count in [0, 3] {
        for count in [100, 300, 1_000, 10_000] {
            let config = drum_for(count, baffle_count);
            let mut simulation = Simulation::new(config, 1, 1).expect("a load that fits");
            // Out of the random start, into the tumble; the larger ones have further to fall.
            simulation.run(if count > 1_000 { 20_000 } else { 200_000 }).expect("a stable run");
            let batch = (100_000 / count).max(10) as u64;
            group.throughput(Throughput::Elements(batch * count as u64));
            let name = if baffle_count == 0 { "bare" } else { "baffles" };
            group.bench_function(BenchmarkId::new(name, count), |bencher| {
                bencher.iter(|| simulation.run(batch).expect("a stable run"));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, steps);
criterion_main!(benches);
