//! Contacts that have ended, one row each.

use serde::{Deserialize, Serialize};

/// What stands for a second particle, or for a part of the drum, where there is none.
pub const NO_BODY: u32 = u32::MAX;

/// A contact from first touch to opening, or until now.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct ContactRow {
    /// The step at whose end the bodies touched for the first time; 0 where they did at the start.
    pub opened: u64,
    /// The step at whose end they no longer touched, or the last one.
    pub ended: u64,
    /// Id of the particle; of two, the smaller one.
    pub particle: u32,
    /// Id of the other particle; `NO_BODY` at the drum.
    pub other: u32,
    /// The surface of the drum; `NO_BODY` between particles.
    pub part: u32,
    /// Energy taken by normal damping, by sliding and tangential damping, by rolling [J/m].
    pub dissipated: [f64; 3],
    /// Speed of approach along the normal at first touch, and speed of slip [m/s].
    pub speeds: [f64; 2],
    /// Greatest normal force [N/m].
    pub greatest_force: f64,
    /// Where the bodies touched first [m].
    pub point: [f64; 2],
}

impl ContactRow {
    /// The whole energy that the contact has taken [J/m].
    pub fn energy(&self) -> f64 {
        self.dissipated.iter().sum()
    }
}
