//! A tangential spring that friction truncates.

use crate::physics::scalar::Scalar;

/// What a truncated spring answers.
#[derive(Debug, Clone, Copy)]
pub(super) struct TruncatedSpring<S: Scalar> {
    /// Stretch ξ after the step [m].
    pub(super) displacement: S,
    /// Force Fₜ = kₛ ξ [N/m].
    pub(super) force: S,
    /// Energy that sliding took [J/m].
    pub(super) dissipated: S,
    /// Where nothing was truncated.
    pub(super) sticking: S::Mask,
}

impl<S: Scalar> TruncatedSpring<S> {
    /// A spring stretched by `last` that slips by `slip` more, of stiffness kₛ, and no farther than `limit` [m]: where it
    /// would be, it is truncated, and the lost stretch is sliding (Park & Wassgren, Eq. 2).
    #[inline(always)]
    pub(super) fn new(stiffness: S, limit: S, last: S, slip: S) -> Self {
        let trial = last + slip;
        let displacement = trial.clamped(limit);
        Self {
            displacement,
            force: stiffness * displacement,
            dissipated: sliding_loss(stiffness, last, displacement, trial - displacement),
            sticking: displacement.equals(trial),
        }
    }
}

/// Work of the friction force over the stretch that truncation took away: mean of the forces before and after, or the
/// force after where the bodies slid against the force before. Never below zero, since sliding goes the way of the force after.
/// Where the contact has ended, nothing is left after, and this is all that the spring held.
#[inline(always)]
fn sliding_loss<S: Scalar>(stiffness: S, before: S, after: S, slid: S) -> S {
    let turned = S::zero().exceeds(before * slid);
    let mean = S::select(turned, after, (before + after) * S::splat(0.5));
    stiffness * (mean * slid)
}
