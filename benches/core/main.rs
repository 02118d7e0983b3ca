//! The benches of the core, one program: a group a file, named in [benches/README.md](../README.md).

#[path = "../scenes/mod.rs"]
mod scenes;

mod contact;
mod ledger;
mod neighbors;
mod packing;
mod step;

use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, criterion_group, criterion_main};

/// Times that suffice for a ratio, so that all benches take minutes.
pub fn keep_short(group: &mut BenchmarkGroup<WallTime>) {
    group.sample_size(20).warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(3));
}

criterion_group!(
    benches,
    contact::responses,
    ledger::accounts,
    neighbors::rebuilds,
    packing::beds,
    step::steps
);
criterion_main!(benches);
