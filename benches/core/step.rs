//! One step of a tumbling drum, ledger and recording on.

use criterion::{BenchmarkId, Criterion, Throughput};

use crate::{keep_short, scenes};

pub fn steps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("step");
    keep_short(&mut group);
    for (name, baffle_count) in [("bare", 0), ("baffles", 3)] {
        for count in [100, 200, 300, 1_000, 10_000, 100_000] {
            let batch = (100_000 / count).max(2) as u64;
            group.throughput(Throughput::Elements(batch * count as u64));
            // Made when the bench is not filtered out, and once.
            let mut simulation = None;
            group.bench_function(BenchmarkId::new(name, count), |bencher| {
                let simulation = simulation.get_or_insert_with(|| scenes::tumbling(count, baffle_count));
                bencher.iter(|| simulation.run(batch).expect("a stable run"));
            });
        }
    }
    group.finish();
}
