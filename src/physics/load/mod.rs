//! The load: how many discs of which sizes, and where they start.

pub mod packing;
