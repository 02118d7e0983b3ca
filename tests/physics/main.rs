//! Parts of the physics by themselves, each held against its formulas.

#[path = "../common/mod.rs"]
mod common;
mod damping;
mod drum;
mod packing;
mod particles;
mod rotation;
mod sums;
mod vector;
