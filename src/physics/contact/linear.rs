//! The linear spring–dashpot with a Coulomb-limited tangential spring: Park & Wassgren's Eqs. 1 and 2.

use std::f64::consts::PI;

use super::law::{BodyPair, ContactLaw};
use super::parameters::{ContactParameters, Tension};
use super::{Flows, Kinematics, Response, Stored};
use crate::physics::columns::{Columns, columns};
use crate::physics::scalar::Scalar;

columns! {
    /// Linear spring–dashpot with a Coulomb-limited tangential spring.
    ///
    /// Fₙ = kₙ δ + νₙ δ̇,   Fₜ = kₛ ξ  with |Fₜ| ≤ μ |Fₙ|
    ///
    /// Where the tangential spring would exceed μ |Fₙ|, it is truncated to it, and the lost stretch is sliding. Source:
    /// Cundall & Strack, Géotechnique 29 (1979) 47, doi:10.1680/geot.1979.29.1.47; the truncated form is Park & Wassgren's
    /// Eq. 2.
    pub struct LinearLaw {
        /// Normal stiffness kₙ [N/m].
        normal_stiffness,
        /// Tangential stiffness kₛ [N/m].
        tangential_stiffness,
        /// Normal damping νₙ [N s/m].
        damping,
        /// μ / kₛ [m per N/m]: the stretch at which a unit of normal force lets the contact slide.
        slip_compliance,
        /// The least normal force [N/m]: 0 where tension is clipped, −∞ where it is allowed.
        least_normal_force,
    }
}

columns! {
    /// What a law with such a spring remembers.
    pub struct SpringHistory {
        /// Stretch ξ of the tangential spring [m].
        tangential_displacement,
    }
}

/// The linear law; without `CLIPS` no least normal force is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Linear<const CLIPS: bool>;

impl<const CLIPS: bool> ContactLaw for Linear<CLIPS> {
    type Parameters = LinearLaw;
    type History = SpringHistory;
    const FLOWS: Flows<bool> = Flows { dissipated_normal: true, dissipated_sliding: true, ..Flows::NONE };
    const ROLLS: bool = false;
    const CLIPS: bool = CLIPS;

    fn between(parameters: &ContactParameters, bodies: BodyPair) -> LinearLaw<f64> {
        let tangential_stiffness = parameters.stiffness_ratio * parameters.normal_stiffness;
        LinearLaw {
            normal_stiffness: parameters.normal_stiffness,
            tangential_stiffness,
            damping: damping(parameters, bodies.effective_mass),
            slip_compliance: parameters.friction / tangential_stiffness,
            least_normal_force: parameters.tension.least_normal_force(),
        }
    }

    #[inline(always)]
    fn respond<S: Scalar>(
        law: &LinearLaw<S>,
        contact: &Kinematics<S>,
        history: &SpringHistory<S>,
    ) -> (Response<S>, SpringHistory<S>) {
        let mut force = law.normal_stiffness * contact.overlap - law.damping * contact.separation_rate;
        if CLIPS {
            force = force.larger(law.least_normal_force);
        }
        let normal_force = force.within(contact.touching);
        let limit = law.slip_compliance * normal_force.abs();
        let spring = TruncatedSpring::new(
            law.tangential_stiffness,
            limit,
            history.tangential_displacement,
            contact.slip,
        );
        let response = Response {
            normal_force,
            tangential_force: spring.force,
            rolling_moment: S::zero(),
            pressing_force: normal_force,
            friction_limit: law.tangential_stiffness * limit,
            sticking: spring.sticking,
            flows: Flows {
                dissipated_normal: dashpot_loss::<S, CLIPS>(law, contact),
                dissipated_sliding: spring.dissipated,
                ..Flows::build(|_| S::zero())
            },
        };
        (response, SpringHistory { tangential_displacement: spring.displacement })
    }

    fn stored(law: &LinearLaw<f64>, overlap: f64, history: &SpringHistory<f64>) -> Stored<f64> {
        let stretch = history.tangential_displacement;
        Stored {
            elastic_normal: 0.5 * law.normal_stiffness * overlap * overlap,
            elastic_tangential: 0.5 * law.tangential_stiffness * stretch * stretch,
            ..Stored::build(|_| 0.0)
        }
    }
}

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

/// The dashpot's force at mid-step times the travel. Where the whole force is clipped, the dashpot holds just the spring.
#[inline(always)]
fn dashpot_loss<S: Scalar, const CLIPS: bool>(law: &LinearLaw<S>, contact: &Kinematics<S>) -> S {
    let mut force = -(law.damping * contact.last_rate);
    if CLIPS {
        let mean_overlap = (contact.overlap + contact.last_overlap) * S::splat(0.5);
        force = force.larger(law.least_normal_force - law.normal_stiffness * mean_overlap);
    }
    (force * contact.travel).larger(S::zero())
}

/// Normal damping νₙ [N s/m] between bodies of the effective mass m* [kg/m].
pub fn damping(parameters: &ContactParameters, effective_mass: f64) -> f64 {
    match (parameters.restitution, parameters.normal_damping) {
        (Some(restitution), _) => {
            let ratio = damping_ratio_for(restitution, parameters.tension);
            2.0 * ratio * (parameters.normal_stiffness * effective_mass).sqrt()
        }
        (None, damping) => damping.unwrap_or(0.0),
    }
}

/// The damping ratio ζ = νₙ / (2 √(kₙ m*)) between bodies of the effective mass m* [kg/m].
pub fn damping_ratio(parameters: &ContactParameters, effective_mass: f64) -> f64 {
    damping(parameters, effective_mass) / (2.0 * (parameters.normal_stiffness * effective_mass).sqrt())
}

/// Restitution e of a head-on impact between bodies of the effective mass m* [kg/m].
pub fn restitution(parameters: &ContactParameters, effective_mass: f64) -> f64 {
    parameters.restitution.unwrap_or_else(|| {
        let ratio = damping_ratio(parameters, effective_mass);
        libm::exp(-match parameters.tension {
            Tension::Allowed if ratio < 1.0 => PI * ratio / (1.0 - ratio * ratio).sqrt(),
            Tension::Allowed => f64::INFINITY,
            Tension::Clipped => clipped_decay(ratio),
        })
    })
}

/// How long a collision without damping lasts [s]: π / ω₀, ω₀ = √(kₙ / m*).
pub fn undamped_collision_time(parameters: &ContactParameters, effective_mass: f64) -> f64 {
    PI / (parameters.normal_stiffness / effective_mass).sqrt()
}

/// The time [s] that a step has to resolve: the duration of a collision, π / (ω₀ √(1 − ζ²)), ω₀ = √(kₙ / m*), with tension
/// clipped 2 acos ζ / (ω₀ √(1 − ζ²)).
///
/// Strong damping stretches a collision without bound while the forces still change within 1/ω₀ and, beyond critical
/// damping, within a fraction of it; the time is therefore never taken longer than π / (ω₀ · max(½, ζ)).
pub fn collision_time(parameters: &ContactParameters, effective_mass: f64) -> f64 {
    let frequency = (parameters.normal_stiffness / effective_mass).sqrt();
    let ratio = damping_ratio(parameters, effective_mass);
    let resolved = PI / (frequency * ratio.max(0.5));
    if ratio >= 1.0 {
        return resolved;
    }
    let phase = match parameters.tension {
        Tension::Allowed => PI,
        Tension::Clipped => 2.0 * libm::acos(ratio),
    };
    resolved.min(phase / (frequency * (1.0 - ratio * ratio).sqrt()))
}

/// The damping ratio ζ that gives the restitution e.
///
/// Tension allowed: e = exp(−π ζ / √(1 − ζ²)), so ζ = −ln e / √(π² + ln² e).
/// Clipped: the contact ends when the force vanishes; with φ = acos ζ, e = exp(−2 φ / tan φ), and beyond critical
/// damping, φ = acosh ζ, e = exp(−2 φ / tanh φ) (Schwager & Pöschel, Granular Matter 9 (2007) 465), solved by bisection.
pub(super) fn damping_ratio_for(restitution: f64, tension: Tension) -> f64 {
    let decay = -libm::log(restitution);
    if decay <= 0.0 {
        return 0.0;
    }
    match tension {
        Tension::Allowed => decay / (PI * PI + decay * decay).sqrt(),
        Tension::Clipped => bisect_clipped_ratio(decay),
    }
}

/// Solves decay(ζ) = −ln e for the clipped law, whose decay grows with ζ from 0 without bound.
fn bisect_clipped_ratio(decay: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    while clipped_decay(high) < decay {
        high *= 2.0;
    }
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if clipped_decay(middle) < decay {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// −ln e of the clipped law at the damping ratio ζ.
fn clipped_decay(ratio: f64) -> f64 {
    if ratio == 0.0 {
        0.0
    } else if ratio < 1.0 {
        let phase = libm::acos(ratio);
        2.0 * phase / libm::tan(phase)
    } else if ratio == 1.0 {
        2.0
    } else {
        let phase = libm::acosh(ratio);
        2.0 * phase / libm::tanh(phase)
    }
}
