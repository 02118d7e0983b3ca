//! What holds however a step is computed: bits, borders, messages, lists against brute force, any bytes as input.
//!
//! One program, not one a file: each would link the core once more, and that is most of the time that building takes.

#[path = "../common/mod.rs"]
mod common;

mod changes;
mod config;
mod contact_records;
mod determinism;
mod errors;
mod fuzz;
mod neighbors;
mod parts;
mod reference;
mod robustness;
mod simd;
mod summary;
