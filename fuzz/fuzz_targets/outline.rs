//! Any bytes as a drum's outlines: see `outline` in `tests/hostile/mod.rs`.
#![no_main]

#[path = "../../tests/hostile/mod.rs"]
#[allow(dead_code)] // Each target uses its own part.
mod hostile;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| hostile::outline(bytes));
