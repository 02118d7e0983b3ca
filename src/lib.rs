//! drumrs: loads tumbling in a rotating drum, simulated as discs with soft contacts (2-D DEM).
//!
//! Everything is SI and per metre of drum depth. The drum turns about the origin; positive angles are
//! counter-clockwise.
//!
//! What happens is `physics`, how it is computed fast is `engine`; a module imports only from lower levels:
//!
//! | level | modules                                                                                                |
//! |-------|--------------------------------------------------------------------------------------------------------|
//! | 0     | [`error`], [`physics::columns`], [`physics::scalar`], [`physics::sorting`], [`physics::vector`]        |
//! | 1     | [`physics::contact`], [`physics::drum`], [`physics::particles`], [`physics::rotation`]                 |
//! | 2     | [`physics::energy`], [`physics::load`]                                                                 |
//! | 3     | [`engine`], [`observe`]                                                                                |
//! | 4     | [`io::config`]                                                                                         |
//! | 5     | [`simulation`]                                                                                         |
//! | 6     | [`io::checkpoint`]                                                                                     |
//! | 7     | `python`, which only the feature of that name builds                                                   |
//!
//! `tests/architecture.rs` reads this table and checks it.
//!
//! # A step
//!
//! The integrator is the leapfrog. When a step begins, the drift into it is done. What has no link is a method of
//! [`simulation::Simulation`], in `src/simulation/`:
//!
//! 1. `turn_of`: the angle by which the drum has turned, in closed form
//!    ([`angle_increment`](physics::rotation::RotationSchedule::angle_increment)).
//! 2. [`Engine::follow`](engine::Engine::follow): what the drift did is charged to the lists of pairs; a bound on the longest displacement.
//! 3. `guard_displacements`: no particle has moved by half the smallest radius.
//! 4. [`Engine::update_list`](engine::Engine::update_list): a new list of pairs, if the slack is used up.
//! 5. [`Engine::evaluate_and_advance`](engine::Engine::evaluate_and_advance), chunk by chunk: contacts open, are evaluated by
//!    their law ([`ContactLaw::respond`](physics::contact::law::ContactLaw::respond)), end; reactions from other chunks; kick and
//!    drift into the next step ([`Verlet::advance`](engine::motion::verlet::Verlet::advance)).
//! 6. `charge`: what the drum did to the load
//!    ([`EnergyLedger::charge_surfaces`](physics::energy::EnergyLedger::charge_surfaces)).
//!
//! Where something is due, a step goes on like this instead of 5 and 6 (`step_with_events`):
//!
//! 5. [`Engine::evaluate`](engine::Engine::evaluate): the forces alone; then `charge`.
//! 6. `guard`, every 32 steps and at samples: all is finite, no overlap too deep, no center inside a solid.
//! 7. [`Engine::finish`](engine::Engine::finish): the first half of the kick, after which velocities are those at the time of
//!    the positions; [`Engine::write_back`](engine::Engine::write_back) brings both to the particles.
//! 8. `record`: a sample, which folds the sums over contacts into the ledger, or a frame.
//! 9. [`Engine::start`](engine::Engine::start): the second half of the kick and the drift into the next step; after a sort of the
//!    memory where that is due ([`engine::memory_order`]).
//!
//! `docs/internals/step.md` has every function, and a drawing.
//!
//! # An example
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
