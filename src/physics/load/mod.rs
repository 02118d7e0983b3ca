//! The load: how many discs of which species and sizes, and where they start.

pub mod composition;
pub mod formulas;
pub mod packing;
pub mod shares;
pub mod sizes;
