//! The ledger on its own: charging a step, and the sums over the load that a sample asks for.

mod scenes;

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use drumrs::physics::energy::{Balance, EnergyLedger, StepFlows, StoredEnergy, SurfaceLoad};
use drumrs::physics::vector::Vec2;

fn accounts(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("ledger");
    scenes::keep_short(&mut group);
    // Rim and three baffles.
    let surfaces = [SurfaceLoad { force: Vec2::new(3.0, 40.0), moment: -1.7 }; 4];
    let flows = StepFlows {
        work_normal: 1e-4,
        work_tangential: -3e-5,
        dissipated_normal: 7e-5,
        ..StepFlows::default()
    };
    let balance = Balance { mass_moment: Vec2::new(2.0, -9.0), outer_moment: -19.6, ..Balance::default() };
    let mut ledger = EnergyLedger::open(StoredEnergy::default(), balance, &surfaces);
    group.throughput(Throughput::Elements(1));
    group.bench_function("step", |bencher| {
        bencher.iter(|| {
            ledger.charge(black_box(&flows), black_box(&surfaces), 2e-5, 3.7e-6);
            ledger.charge_balance(black_box(balance), 2e-5, 3.7e-6, true);
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

criterion_group!(benches, accounts);
criterion_main!(benches);
