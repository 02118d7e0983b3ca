//! One step of the contact law, for four contacts at once, over contacts that press, pull, slide, stick, open and close.

use std::hint::black_box;

use criterion::{Criterion, Throughput};
use drumrs::engine::simd::{F64x4, LANES, lanes};
use drumrs::physics::columns::Columns;
use drumrs::physics::contact::law::ContactLaw;
use drumrs::physics::contact::linear::{Linear, LinearLaw, SpringHistory};
use drumrs::physics::contact::{ContactState, Kinematics, RelativeMotion};
use drumrs::physics::scalar::Scalar;

use crate::keep_short;
use crate::scenes::common::{TIME_STEP, law, linear_law};

/// Numbers within ±1.
fn wave(first: usize, pace: usize) -> F64x4 {
    lanes(|lane| ((first + lane) * pace % 31) as f64 / 15.0 - 1.0)
}

/// How bodies move, what they were like before, what the law remembers of them.
type Contact = (RelativeMotion<F64x4>, ContactState<F64x4>, SpringHistory<F64x4>);

fn contacts(count: usize) -> Vec<Contact> {
    let contact = |first: usize| {
        let parted = wave(first, 3) * 1e-7;
        let overlap = (wave(first, 5) * 1.1 + 1.0) * 1e-6;
        let past = Scalar::larger(overlap + parted, F64x4::ZERO);
        let motion = RelativeMotion {
            overlap,
            separation_rate: parted / F64x4::splat(TIME_STEP),
            slip_rate: wave(first, 7) * 1e-7 / F64x4::splat(TIME_STEP),
            rolling_rate: F64x4::ZERO,
        };
        let last = ContactState {
            overlap: past,
            separation_rate: wave(first, 13) * 0.03,
            ..ContactState::build(|_| F64x4::ZERO)
        };
        (motion, last, SpringHistory { tangential_displacement: past * wave(first, 11) * 0.5 })
    };
    (0..count).step_by(LANES).map(contact).collect()
}

pub fn responses(criterion: &mut Criterion) {
    let contacts = contacts(1024);
    let law = LinearLaw::map(&linear_law(&law(9.25e7)), F64x4::splat);
    let time = [F64x4::splat(TIME_STEP), F64x4::splat(1.0 / TIME_STEP)];
    let mut group = criterion.benchmark_group("law");
    keep_short(&mut group);
    group.throughput(Throughput::Elements((contacts.len() * LANES) as u64));
    group.bench_function("linear", |bencher| {
        bencher.iter(|| {
            for (motion, last, history) in &contacts {
                let contact = Kinematics::new(black_box(motion), black_box(last), time);
                black_box(Linear::<false>::respond(&law, &contact, black_box(history)));
            }
        });
    });
    group.finish();
}
