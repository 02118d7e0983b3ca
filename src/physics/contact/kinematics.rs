//! The relative motion of two bodies at their contact, as a law sees it.

use super::ContactState;
use crate::physics::scalar::Scalar;

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
