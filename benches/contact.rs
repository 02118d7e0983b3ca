//! One call of the contact law, over contacts that press, pull, slide, stick, open and close.

mod scenes;

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use drumrs::contact::linear::LinearLaw;
use drumrs::contact::{Displacement, Encounter, History};

fn encounters(law: &LinearLaw, count: i32) -> Vec<(Encounter, History)> {
    let wave = |k: i32, n: i32| f64::from((k * n) % 31 - 15) / 15.0;
    (0..count)
        .map(|k| {
            let displacement = Displacement { approach: 1e-7 * wave(k, 3), slip: 1e-7 * wave(k, 7) };
            let overlap = 1e-6 * (1.0 + 1.1 * wave(k, 5));
            let past = (overlap - displacement.approach).max(0.0);
            let history = History {
                overlap: past,
                tangential_displacement: 0.5 * past * wave(k, 11),
                normal_force: law.normal_stiffness * past,
                ..History::default()
            };
            let step_rate = 1.0 / scenes::common::TIME_STEP;
            let closing_speed = displacement.approach * step_rate;
            (Encounter { overlap, displacement, closing_speed, damping: 5.35e3, step_rate }, history)
        })
        .collect()
}

fn responses(criterion: &mut Criterion) {
    let law = LinearLaw::from(&scenes::common::law(9.25e7));
    let contacts = encounters(&law, 1024);
    let mut group = criterion.benchmark_group("law");
    group.throughput(Throughput::Elements(contacts.len() as u64));
    group.bench_function("linear", |bencher| {
        bencher.iter(|| {
            for (encounter, history) in &contacts {
                black_box(law.respond(black_box(encounter), black_box(history)));
            }
        });
    });
    group.finish();
}

criterion_group!(benches, responses);
criterion_main!(benches);
