//! What happens: bodies, the drum, contact laws, energy. No threads, no lanes, no memory order.

pub mod columns;
pub mod contact;
pub mod drum;
pub mod energy;
pub mod load;
pub mod particles;
pub mod rotation;
pub mod scalar;
pub mod sorting;
pub mod vector;
