//! One rebuild of the neighbor list: cells, search, and the link to the contacts.

mod scenes;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use drumrs::engine::parallel::Threads;
use drumrs::neighbors::{Surroundings, VerletList};
use drumrs::physics::vector::Rotation;

fn rebuilds(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("rebuild");
    scenes::keep_short(&mut group);
    let threads = Threads::new(1).expect("one thread");
    for count in [1_000, 10_000, 100_000] {
        group.throughput(Throughput::Elements(count as u64));
        // Made when the bench is not filtered out, and once.
        let mut simulation = None;
        group.bench_function(BenchmarkId::from_parameter(count), |bencher| {
            let simulation = simulation.get_or_insert_with(|| scenes::tumbling(count, 3));
            let around = Surroundings {
                particles: &simulation.state().particles,
                drum: simulation.drum(),
                rotation: Rotation::new(simulation.drum_angle()),
            };
            let mut table = simulation.contacts().clone();
            let mut list = VerletList::new(0.5 * scenes::common::RADIUS);
            bencher.iter(|| list.rebuild(around, &mut table, &threads));
        });
    }
    group.finish();
}

criterion_group!(benches, rebuilds);
criterion_main!(benches);
