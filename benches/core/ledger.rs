//! The ledger on its own: charging a step, and the sums over the load that a sample asks for.

use std::hint::black_box;

use criterion::{Criterion, Throughput};
use drumrs::physics::energy::{EnergyLedger, MomentBalance, StoredEnergy, SurfaceLoad};
use drumrs::physics::vector::Vec2;

use crate::{keep_short, scenes};

pub fn accounts(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("ledger");
    keep_short(&mut group);
    // Rim and three baffles.
    let surfaces = [SurfaceLoad { force: Vec2::new(3.0, 40.0), moment: -1.7 }; 4];
    let (mass_moment, outer_moment) = (Vec2::new(2.0, -9.0), -19.6);
    let moments = MomentBalance::open(mass_moment, outer_moment, 0.0);
    let mut ledger = EnergyLedger::open(StoredEnergy::default(), moments, &surfaces);
    group.throughput(Throughput::Elements(1));
    group.bench_function("step", |bencher| {
        bencher.iter(|| {
            ledger.charge_surfaces(black_box(&surfaces), 2e-5, 3.7e-6);
            ledger.moments.charge(black_box(mass_moment), black_box(outer_moment), 2e-5, 3.7e-6);
        });
    });
    group.throughput(Throughput::Elements(1_000));
    // Made when the bench is not filtered out, and once.
    let mut simulation = None;
    group.bench_function("stored", |bencher| {
        let simulation = simulation.get_or_insert_with(|| scenes::tumbling(1_000, 3));
        bencher.iter(|| black_box(&*simulation).stored());
    });
    group.finish();
}
