//! One call of the contact law, for four contacts at once, over contacts that press, pull, slide, stick, open and close.

mod scenes;

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use drumrs::contact::linear::{LinearLanes, LinearLaw};
use drumrs::contact::{Displacement, Encounter, History, HistoryLanes};
use drumrs::lanes::{LANES, Lanes, lanes};

/// Numbers within ±1.
fn wave(first: usize, pace: usize) -> Lanes {
    lanes(|lane| ((first + lane) * pace % 31) as f64 / 15.0 - 1.0)
}

fn encounters(law: &LinearLaw, count: usize) -> Vec<(Encounter, HistoryLanes)> {
    let none = History::default();
    let encounter = |first: usize| {
        let displacement = Displacement { parting: wave(first, 3) * 1e-7, slip: wave(first, 7) * 1e-7 };
        let overlap = (wave(first, 5) * 1.1 + 1.0) * 1e-6;
        let past = (overlap + displacement.parting).fast_max(Lanes::ZERO);
        let history = HistoryLanes {
            overlap: past,
            tangential_displacement: past * wave(first, 11) * 0.5,
            normal_force: past * law.normal_stiffness,
            ..HistoryLanes::new(|_| &none)
        };
        let step_rate = 1.0 / scenes::common::TIME_STEP;
        let parting_speed = displacement.parting * step_rate;
        let damping = Lanes::splat(5.35e3);
        (Encounter { overlap, displacement, parting_speed, damping, step_rate }, history)
    };
    (0..count).step_by(LANES).map(encounter).collect()
}

fn responses(criterion: &mut Criterion) {
    let law = LinearLaw::from(&scenes::common::law(9.25e7));
    let contacts = encounters(&law, 1024);
    let laws = LinearLanes::splat(&law);
    let mut group = criterion.benchmark_group("law");
    scenes::keep_short(&mut group);
    group.throughput(Throughput::Elements((contacts.len() * LANES) as u64));
    group.bench_function("linear", |bencher| {
        bencher.iter(|| {
            for (encounter, history) in &contacts {
                black_box(laws.respond(black_box(encounter), black_box(history)));
            }
        });
    });
    group.finish();
}

criterion_group!(benches, responses);
criterion_main!(benches);
