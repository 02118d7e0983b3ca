//! Contacts: what a law is told (`Kinematics`), what it answers (`Response`), what survives a step (`ContactState`).
//!
//! # Sign convention
//! Body `i` owns the contact, body `j` (a later particle, or the drum) is the other side. The normal `n` points from `i` to
//! `j`, the tangent `t` is `n` turned by +90°. A positive normal force pushes the two apart: the force on `j` is
//!
//! > F = Fₙ n − Fₜ t,
//!
//! on `i` the opposite. With the spring's stretch ξ growing as `j` moves along `t` relative to `i` (spin included),
//! Fₜ = kₛ ξ. The moments about the centers are M = a Fₜ + Mᵣ on `i`, with a the arm from its center to the contact and
//! Mᵣ the rolling moment, and a' Fₜ − Mᵣ on `j`.

pub mod adhesion;
mod friction;
pub mod gross_work;
pub mod hertz;
mod kinematics;
pub mod law;
pub mod linear;
pub mod model;
pub mod parameters;
pub mod rolling;
pub mod species;
pub mod tally;
pub mod tangential_dashpot;
mod with_records;

pub use kinematics::{Kinematics, RelativeMotion};

use crate::physics::columns::columns;
use crate::physics::scalar::Scalar;

columns! {
    /// What every contact keeps between two steps, whatever its law: what the next step's kinematics and work need. All zero
    /// before the bodies first touch.
    pub struct ContactState {
        /// Overlap δ [m]. Above zero exactly while the bodies touch.
        overlap,
        /// Rate at which the bodies parted in the middle of the last step [m/s].
        separation_rate,
        /// x of the force on body j [N/m].
        force_x,
        /// y of the force on body j [N/m].
        force_y,
        /// Moment on body i about its center [N m/m].
        moment,
    }
}

columns! {
    /// Energy that leaves the load, by where it goes [J/m]; never negative.
    pub struct Flows {
        /// taken by normal damping
        dissipated_normal,
        /// taken by sliding
        dissipated_sliding,
        /// taken by tangential damping
        dissipated_tangential,
        /// taken by rolling
        dissipated_rolling,
    }
}

columns! {
    /// Energy that contacts hold, by where it is [J/m].
    pub struct Stored {
        /// held by normal springs
        elastic_normal,
        /// held by tangential springs
        elastic_tangential,
        /// held by rolling springs
        elastic_rolling,
        /// of adhesion, below zero while bodies touch
        adhesion,
    }
}

/// What a law answers. All is zero where the bodies have separated, but for the flows.
#[derive(Debug, Clone, Copy)]
pub struct Response<S: Scalar> {
    /// Net normal force Fₙ [N/m], positive when it pushes.
    pub normal_force: S,
    /// Tangential force Fₜ [N/m].
    pub tangential_force: S,
    /// Rolling moment Mᵣ [N m/m].
    pub rolling_moment: S,
    /// The force that presses the bodies together [N/m]: that of spring and dashpot. It limits friction and rolling.
    pub pressing_force: S,
    /// The greatest tangential force that friction allows [N/m].
    pub friction_limit: S,
    /// Where the tangential spring has not been truncated in this step.
    pub sticking: S::Mask,
    /// Energy taken during the step [J/m].
    pub flows: Flows<S>,
}
