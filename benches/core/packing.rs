//! The start: random insertion into a loose bed, a shuffled pattern in a dense one, swelling where there are two sizes.

use criterion::{BenchmarkId, Criterion, Throughput};
use drumrs::physics::drum::Drum;
use drumrs::physics::load::packing::{pack, pack_mixed};

use crate::{keep_short, scenes};

pub fn beds(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("packing");
    keep_short(&mut group);
    group.sample_size(10);
    for count in [100, 300, 10_000] {
        let drum = Drum::new(&scenes::drum_for(count, 0).drum).expect("a valid drum");
        group.throughput(Throughput::Elements(count as u64));
        group.bench_function(BenchmarkId::from_parameter(count), |bencher| {
            bencher.iter(|| pack(&drum, count, scenes::common::RADIUS, 1).expect("a load that fits"));
        });
    }
    // They cover 0.59 of this drum.
    let drum = Drum::new(&scenes::drum_for(10_000, 0).drum).expect("a valid drum");
    let radius = |index| scenes::common::RADIUS * if index % 2 == 0 { 1.0 } else { 1.4 };
    let radii: Vec<f64> = (0..10_000).map(radius).collect();
    group.bench_function(BenchmarkId::new("two_sizes", radii.len()), |bencher| {
        bencher.iter(|| pack_mixed(&drum, &radii, 1).expect("a load that fits"));
    });
    group.finish();
}
