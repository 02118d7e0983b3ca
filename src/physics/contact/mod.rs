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
pub mod gross_work;
pub mod hertz;
pub mod law;
pub mod linear;
pub mod model;
pub mod parameters;
pub mod rolling;
pub mod species;
pub mod tally;
pub mod tangential_dashpot;
pub mod with_records;

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

/// How two bodies move at their contact, in the frame of contact: rates in the middle of the step that led here.
#[derive(Debug, Clone, Copy)]
pub struct RelativeMotion<S: Scalar> {
    /// Overlap δ [m] now; not above zero when the bodies are apart.
    pub overlap: S,
    /// Rate along the normal, positive when the bodies part [m/s].
    pub separation_rate: S,
    /// Rate along the tangent, spin included [m/s]; positive where the tangential spring stretches.
    pub slip_rate: S,
    /// Angular velocity of i relative to j [rad/s].
    pub rolling_rate: S,
}

/// What a law sees of two bodies that touch now, or touched at the last step.
///
/// Springs and work use the displacements of the step that has happened. Dashpots use rates foretold for the time of the
/// force, half a step later than those displacements' mean: 1.5 u − 0.5 u' from the last two steps. A lagged dashpot makes
/// every collision too lossy at practical time steps.
///
/// # The step in which a contact opens
/// Only the part after first touch counts as contact: it is found from the rate of approach, and the slip of the step is
/// scaled by it. The rate of the step before is taken to be the same.
#[derive(Debug, Clone, Copy)]
pub struct Kinematics<S: Scalar> {
    /// Where the bodies touch now.
    pub touching: S::Mask,
    /// Overlap δ [m], at least 0.
    pub overlap: S,
    /// Overlap at the last step [m].
    pub last_overlap: S,
    /// By how much the overlap grew in the step, as if there had been contact throughout [m].
    pub approach: S,
    /// The part of that which fell within the contact [m].
    pub travel: S,
    /// Displacement along the tangent within the contact [m].
    pub slip: S,
    /// Rotation of i relative to j within the contact [rad].
    pub roll: S,
    /// Rate of separation at the time of the force [m/s].
    pub separation_rate: S,
    /// Rate of separation in the middle of the step [m/s], to be remembered.
    pub last_rate: S,
    /// Rate of slip in the middle of the step [m/s].
    pub slip_rate: S,
    /// Whether the contact has just opened.
    pub opening: S::Mask,
    /// Length of the step [s].
    pub time_step: S,
    /// Its inverse [1/s].
    pub step_rate: S,
}

impl<S: Scalar> Kinematics<S> {
    /// Of bodies that move like this, and were like that at the last step; `time_step` is the step's length and its inverse.
    #[inline(always)]
    pub fn new(motion: &RelativeMotion<S>, last: &ContactState<S>, [time_step, step_rate]: [S; 2]) -> Self {
        let zero = S::zero();
        let touching = motion.overlap.exceeds(zero);
        let overlap = motion.overlap.larger(zero);
        let opening = touching & !last.overlap.exceeds(zero);
        let travel = overlap - last.overlap;
        let mut approach = motion.overlap - last.overlap;
        let mut slip = (motion.slip_rate * time_step).within(touching);
        let mut roll = (motion.rolling_rate * time_step).within(touching);
        // By how much the bodies parted in the step; the velocity along the normal at its end also turns with the normal.
        let mut rate = -(approach * step_rate);
        let mut last_rate = last.separation_rate;
        if S::any(opening) {
            rate = S::select(opening, motion.separation_rate, rate);
            last_rate = S::select(opening, motion.separation_rate, last_rate);
            approach = S::select(opening, -(motion.separation_rate * time_step), approach);
            let is_shorter = opening & approach.exceeds(travel);
            let contact_fraction = S::select(is_shorter, travel / approach, S::splat(1.0));
            slip = slip * contact_fraction;
            roll = roll * contact_fraction;
        }
        let foretold = rate * S::splat(1.5) - last_rate * S::splat(0.5);
        Self {
            touching,
            overlap,
            last_overlap: last.overlap,
            approach,
            travel,
            slip,
            roll,
            separation_rate: foretold,
            last_rate: rate,
            slip_rate: motion.slip_rate,
            opening,
            time_step,
            step_rate,
        }
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
