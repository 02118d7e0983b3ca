//! What happens: bodies, the drum, contact laws, energy. No threads, no lanes, no memory order.

pub mod drum;
pub mod energy;
pub mod load;
pub mod particles;
pub mod rotation;
pub mod vector;
