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
//! Fₜ = kₛ ξ. Slip is positive where ξ grows; displacements along the normal are positive where bodies part.

pub mod block;
pub mod candidates;
pub mod clock;
pub mod laws;
pub mod linear;
pub mod list;
mod shift;
pub mod table;

use serde::{Deserialize, Serialize};

use crate::lanes::{Lanes, Vec2Lanes, lanes};
use crate::physics::vector::{Vec2, perpendicular};

/// What must survive a step, and nothing else: the tangential spring, and the force with the frame it acted in,
/// which the next step's work needs. All zero while the bodies do not touch.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[repr(C)]
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

/// One contact that has a history: its owner, its other side, and what it remembers.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Contact {
    /// The owner's id.
    pub particle: u32,
    /// A particle of higher id, or a feature of the drum.
    pub other: u32,
    /// What it remembers.
    pub history: History,
}

/// Histories of four contacts.
#[derive(Debug, Clone, Copy)]
pub struct HistoryLanes {
    /// Overlaps.
    pub overlap: Lanes,
    /// Stretches of the tangential springs.
    pub tangential_displacement: Lanes,
    /// Normal forces.
    pub normal_force: Lanes,
    /// Tangential forces.
    pub tangential_force: Lanes,
    /// Normals.
    pub normal: Vec2Lanes,
}

impl HistoryLanes {
    /// A history for each index.
    #[inline(always)]
    pub fn new<'a>(history: impl Fn(usize) -> &'a History) -> Self {
        Self {
            overlap: lanes(|lane| history(lane).overlap),
            tangential_displacement: lanes(|lane| history(lane).tangential_displacement),
            normal_force: lanes(|lane| history(lane).normal_force),
            tangential_force: lanes(|lane| history(lane).tangential_force),
            normal: Vec2Lanes::new(|lane| history(lane).normal),
        }
    }

    /// The forces on the other sides; those on the owners are the opposite.
    #[inline(always)]
    pub fn reaction(&self) -> Vec2Lanes {
        let (normal, push, pull) = (self.normal, self.normal_force, self.tangential_force);
        Vec2Lanes { x: normal.x * push + normal.y * pull, y: normal.y * push - normal.x * pull }
    }
}

/// The relative motion of two bodies at their contact, resolved along one normal and its tangent; four contacts.
#[derive(Debug, Clone, Copy)]
pub struct Displacement {
    /// Along the normal [m], positive when the bodies part.
    pub parting: Lanes,
    /// Along the tangent, spin included [m].
    pub slip: Lanes,
}

/// What a law sees of bodies that touch now, or touched at the last step; four contacts.
#[derive(Debug, Clone, Copy)]
pub struct Encounter {
    /// Overlap δ [m]; not above zero when the bodies have separated.
    pub overlap: Lanes,
    /// The displacement that happened during the step; spring and work use it.
    pub displacement: Displacement,
    /// Rate of parting at the time of the force [m/s], which is half a step later than the displacement's mean; the
    /// dashpot uses it.
    pub parting_speed: Lanes,
    /// Damping coefficient νₙ of each pair of bodies [N s/m].
    pub damping: Lanes,
    /// 1 / time step [1/s].
    pub step_rate: f64,
}

/// What a law answers; four contacts. All is zero where the bodies have separated, but for the losses.
#[derive(Debug, Clone, Copy)]
pub struct Response {
    /// Normal force Fₙ [N/m].
    pub normal_force: Lanes,
    /// Tangential force Fₜ [N/m].
    pub tangential_force: Lanes,
    /// Stretch ξ of the tangential spring [m].
    pub tangential_displacement: Lanes,
    /// Energy that the dashpot took during the step [J/m], never negative.
    pub dissipated_normal: Lanes,
    /// Energy that sliding took during the step [J/m], never negative.
    pub dissipated_sliding: Lanes,
}
