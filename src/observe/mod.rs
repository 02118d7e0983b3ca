//! What is recorded of a simulation, and the statistics of it.

pub mod averages;
pub mod contact_rows;
pub mod fields;
pub mod frames;
pub mod memory;
pub mod recorder;
pub mod summary;
pub mod visits;
