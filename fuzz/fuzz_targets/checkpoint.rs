//! Any bytes as a checkpoint: see `checkpoint` in `tests/contracts/robustness.rs`.
#![no_main]

#[path = "../../tests/contracts/robustness.rs"]
#[allow(dead_code)] // Each target uses its own part.
mod robustness;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| robustness::checkpoint(bytes));
