//! drumrs: loads tumbling in a rotating drum, simulated as discs with soft contacts (2-D DEM).
//!
//! Everything is SI and per metre of drum depth. The drum turns about the origin; positive angles are
//! counter-clockwise.
//!
//! What happens is `physics`, how it is computed fast is `engine`; a module imports only from lower levels:
//!
//! | level | modules                                                                                                |
//! |-------|--------------------------------------------------------------------------------------------------------|
//! | 0     | [`error`], [`physics::columns`], [`physics::scalar`], [`physics::vector`]                              |
//! | 1     | [`physics::contact`], [`physics::drum`], [`physics::particles`], [`physics::rotation`]                 |
//! | 2     | [`physics::energy`], [`physics::load`]                                                                 |
//! | 3     | [`engine`], [`io::config`], [`observe`]                                                                |
//! | 4     | [`simulation`]                                                                                         |
//! | 5     | [`io::checkpoint`]                                                                                     |
//! | 6     | `python`, which only the feature of that name builds                                                   |
//!
//! `tests/architecture.rs` reads this table and checks it.
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
