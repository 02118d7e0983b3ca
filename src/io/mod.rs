//! Configurations and checkpoints.

pub mod checkpoint;
pub mod config;
