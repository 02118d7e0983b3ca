//! One rebuild of the pair list: cells and search.

use criterion::{BenchmarkId, Criterion, Throughput};
use drumrs::engine::forces::{Bodies, StepInputs};
use drumrs::engine::pair_list::PairList;
use drumrs::engine::parallel::Threads;
use drumrs::physics::vector::Rotation;

use crate::{keep_short, scenes};

pub fn rebuilds(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("rebuild");
    keep_short(&mut group);
    let threads = Threads::new(1).expect("one thread");
    for count in [1_000, 10_000, 100_000] {
        group.throughput(Throughput::Elements(count as u64));
        // Made when the bench is not filtered out, and once.
        let mut simulation = None;
        group.bench_function(BenchmarkId::from_parameter(count), |bencher| {
            let simulation = simulation.get_or_insert_with(|| scenes::tumbling(count, 3));
            let particles = &simulation.state().particles;
            let table = simulation.config().contact.table().expect("one species");
            let step = simulation.time_step();
            let radius = scenes::common::RADIUS;
            let inputs = StepInputs {
                time: [step, 1.0 / step],
                drum: simulation.drum(),
                rotation: Rotation::new(simulation.drum_angle()),
                angular_velocity: simulation.config().rotation.angular_velocity(simulation.time()),
                bodies: Bodies {
                    radius: Some(radius),
                    radii: &particles.radii,
                    masses: &particles.masses,
                    species: &particles.species,
                    table: &table,
                },
                step: 0,
                records_gross_work: false,
                profile: None,
            };
            let mut list = PairList::new(count, 0.5 * radius, radius);
            bencher.iter(|| list.rebuild(&particles.positions, &inputs, &threads));
        });
    }
    group.finish();
}
