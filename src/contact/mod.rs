//! Contacts: what a law is told (`Encounter`), what it answers (`Response`), what survives a step (`History`).
//!
//! # Sign convention
//! Body `i` owns the contact, body `j` (a particle with a higher id, or the drum) is the other side. The normal `n`
//! points from `i` to `j`, the tangent `t` is `n` turned by +90°. A positive normal force pushes the two apart: the
//! force on `i` is
//!
//! > F = −Fₙ n + Fₜ t,
//!
//! on `j` the opposite. With the spring's stretch ξ growing as `j` moves along `t` relative to `i` (spin included),
//! Fₜ = kₛ ξ. Approach (growing overlap) and slip (growing ξ) are positive.

pub mod laws;
pub mod linear;
pub mod table;

use serde::{Deserialize, Serialize};

use crate::vector::{Vec2, perpendicular};

/// What must survive a step, and nothing else: the tangential spring, and the force with the frame it acted in,
/// which the next step's work needs. All zero while the bodies do not touch.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct History {
    /// Overlap δ [m]; the lever arms follow from it. Above zero exactly while the bodies touch.
    pub overlap: f64,
    /// Stretch ξ of the tangential spring [m].
    pub tangential_displacement: f64,
    /// Normal force Fₙ [N/m], positive when it pushes.
    pub normal_force: f64,
    /// Tangential force Fₜ [N/m].
    pub tangential_force: f64,
    /// Unit normal.
    pub normal: Vec2,
}

impl History {
    /// Whether the bodies touched at the last force evaluation.
    #[inline]
    pub fn is_touching(&self) -> bool {
        self.overlap > 0.0
    }

    /// The force on the contact's owner [N/m].
    #[inline]
    pub fn force(&self) -> Vec2 {
        perpendicular(self.normal) * self.tangential_force - self.normal * self.normal_force
    }
}

/// The relative motion of two bodies at their contact, resolved along one normal and its tangent.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Displacement {
    /// Along the normal [m], positive when the bodies approach.
    pub approach: f64,
    /// Along the tangent, spin included [m].
    pub slip: f64,
}

/// What a law sees of two bodies that touch now, or touched at the last step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Encounter {
    /// Overlap δ [m]; not above zero when the bodies have separated.
    pub overlap: f64,
    /// The displacement that happened during the step; spring and work use it.
    pub displacement: Displacement,
    /// Rate of approach at the time of the force [m/s], which is half a step later than the displacement's mean; the
    /// dashpot uses it.
    pub closing_speed: f64,
    /// Damping coefficient νₙ of this pair of bodies [N s/m].
    pub damping: f64,
    /// 1 / time step [1/s].
    pub step_rate: f64,
}

/// What a law answers.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Response {
    /// Normal force Fₙ [N/m].
    pub normal_force: f64,
    /// Tangential force Fₜ [N/m].
    pub tangential_force: f64,
    /// Stretch ξ of the tangential spring [m].
    pub tangential_displacement: f64,
    /// Energy that the dashpot took during the step [J/m], never negative.
    pub dissipated_normal: f64,
    /// Energy that sliding took during the step [J/m], never negative.
    pub dissipated_sliding: f64,
}
