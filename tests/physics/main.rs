//! What happens, held against formulas: the parts of the physics by themselves, and small worlds in which single laws show.

#[path = "../common/mod.rs"]
mod common;

mod baffles;
mod collision;
mod contact_records;
mod damping;
mod drum;
mod energy;
mod friction;
mod gross_work;
mod hertz;
mod impacts;
mod packing;
mod particles;
mod rotation;
mod sizes;
mod sums;
mod terms;
mod vector;
