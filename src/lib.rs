//! drumrs: loads tumbling in a rotating drum, simulated as discs with soft contacts (2-D DEM).
//!
//! Everything is SI and per metre of drum depth. The drum turns about the origin; positive angles are
//! counter-clockwise.
//!
//! | level | modules                                                           |
//! |-------|-------------------------------------------------------------------|
//! | 0     | [`vector`], [`error`], [`threads`]                                |
//! | 1     | [`particles`], [`drum`], [`contact`] (laws)                       |
//! | 2     | [`config`], [`neighbors`], [`contact::table`], [`energy`]         |
//! | 3     | [`packing`], [`start`], [`integrator`], [`forces`], [`recorder`], [`summary`], [`state`] |
//! | 4     | [`checkpoint`], [`simulation`]                                    |
//! | 5     | the Python module, behind the feature `python`                    |
//!
//! A module imports only from lower levels; `tests/architecture.rs` checks it.

pub mod checkpoint;
pub mod config;
pub mod contact;
pub mod drum;
pub mod energy;
pub mod error;
pub mod forces;
pub mod integrator;
pub mod lanes;
pub mod neighbors;
pub mod packing;
pub mod particles;
#[cfg(feature = "python")]
mod python;
pub mod recorder;
pub mod simulation;
pub mod start;
pub mod state;
pub mod summary;
pub mod threads;
pub mod vector;

/// Changes whenever the same configuration and seed give other numbers; part of every result's identity.
pub const PHYSICS_VERSION: u32 = 1;
