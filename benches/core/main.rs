//! The benches of the core, one program: a group a file, named in [benches/README.md](../README.md).

#[path = "../scenes/mod.rs"]
mod scenes;

mod contact;
mod ledger;
mod neighbors;
mod packing;
mod step;

use criterion::{criterion_group, criterion_main};

criterion_group!(
    benches,
    contact::responses,
    ledger::accounts,
    neighbors::rebuilds,
    packing::beds,
    step::steps
);
criterion_main!(benches);
