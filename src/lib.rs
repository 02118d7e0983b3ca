//! drumrs: loads tumbling in a rotating drum, simulated as discs with soft contacts (2-D DEM).
//!
//! Everything is SI and per metre of drum depth. The drum turns about the origin; positive angles are
//! counter-clockwise.
//!
//! | level | modules                                                                |
//! |-------|------------------------------------------------------------------------|
//! | 0     | [`vector`], [`error`], [`cache`]                                               |
//! | 1     | [`lanes`], [`threads`], [`patch`], [`particles`], [`drum`], [`energy`] |
//! | 2     | [`contact`], [`order`], [`packing`], [`integrator`], [`recorder`]      |
//! | 3     | [`config`], [`neighbors`], [`forces`], [`state`], [`summary`]          |
//! | 4     | [`start`]                                                              |
//! | 5     | [`simulation`]                                                         |
//! | 6     | [`checkpoint`]; `python`, which only the feature of that name builds   |
//!
//! A module imports only from lower levels; `tests/architecture.rs` reads this table and checks it.
//!
//! A drum that speeds up to 5 rad/s within a second, and the angle it has turned after two, in closed form:
//!
//! ```
//! use drumrs::physics::rotation::RotationSchedule;
//!
//! let washing = RotationSchedule { knots: vec![[0.0, 0.0], [1.0, 5.0]] };
//! assert_eq!(washing.angle(2.0), 7.5);
//! ```
//!
//! `examples/one_turn.rs` runs a whole drum.

pub mod engine;
pub mod error;
pub mod io;
pub mod observe;
pub mod physics;
#[cfg(feature = "python")]
mod python;
pub mod simulation;

/// Changes whenever the same configuration and seed give other numbers; part of every result's identity.
pub const PHYSICS_VERSION: u32 = 3;
