//! Any bytes as a configuration: see `config` in `tests/contracts/hostile.rs`.
#![no_main]

#[path = "../../tests/contracts/hostile.rs"]
#[allow(dead_code)] // Each target uses its own part.
mod hostile;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| hostile::config(bytes));
