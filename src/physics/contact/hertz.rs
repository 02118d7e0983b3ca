//! Hertz–Mindlin: the law of elastic spheres, spread over a layer one disc diameter thick.

use super::law::{BodyPair, ContactLaw};
use super::linear::{SpringHistory, TruncatedSpring, damping_ratio_for};
use super::parameters::ContactParameters;
use super::{Flows, Kinematics, Response, Stored};
use crate::physics::columns::{Columns, columns};
use crate::physics::scalar::Scalar;

columns! {
    /// The Hertz–Mindlin law between two bodies.
    ///
    /// Fₙ = k δ^{3/2} + c δ^{1/4} δ̇,   Fₜ = kₜ √δ ξ  with |Fₜ| ≤ μ |Fₙ|
    ///
    /// k = 4/3 E* √R* / h and kₜ = 8 G* √R* / h, with 1/E* = 2 (1 − ν²)/E and 1/G* = 4 (2 − ν)(1 + ν)/E for two bodies of one
    /// material, and h the diameter of the smaller disc: discs have forces per meter, spheres have not.
    ///
    /// With x = δ^{5/4} and ds = δ^{1/4} dt an impact is x'' = −5/4 (k/m*) x − (c/m*) x', a damped oscillator, and the force
    /// vanishes where x'' does. So c = 2 ζ √(5/4 k m*) gives the restitution of a linear contact with the damping ratio ζ,
    /// with either tension and at any speed (Antypov & Elliott, EPL 94 (2011) 50004; Tsuji et al., Powder Technology 71 (1992)
    /// 239, fitted it).
    ///
    /// The tangential stiffness changes with the overlap. Where it grows, the force stays (Mindlin); where it falls, the
    /// stretch does. Either way the spring loses energy, to slip at the edge of the contact (Thornton et al., Powder Technology
    /// 233 (2013) 30): it counts as sliding.
    pub struct Hertz {
        /// Normal stiffness k [N/m^{5/2}].
        normal_stiffness,
        /// Tangential stiffness kₜ [N/m^{5/2}].
        tangential_stiffness,
        /// Normal damping c [N s/m^{9/4}].
        damping,
        /// Friction coefficient μ.
        friction,
        /// The least normal force [N/m]: 0 where tension is clipped, −∞ where it is allowed.
        least_normal_force,
    }
}

impl ContactLaw for Hertz {
    type Parameters = Self;
    type History = SpringHistory;
    const FLOWS: Flows<bool> = Flows { dissipated_normal: true, dissipated_sliding: true, ..Flows::NONE };
    const ROLLS: bool = false;

    fn between(parameters: &ContactParameters, bodies: BodyPair) -> Hertz<f64> {
        let stiffness = normal_stiffness(parameters, bodies);
        let ratio = damping_ratio_for(parameters.restitution.unwrap_or(1.0), parameters.tension);
        let poisson = parameters.poisson_ratio;
        Hertz {
            normal_stiffness: stiffness,
            // 8 G* over 4/3 E*.
            tangential_stiffness: 3.0 * (1.0 - poisson) / (2.0 - poisson) * stiffness,
            damping: 2.0 * ratio * (1.25 * stiffness * bodies.effective_mass).sqrt(),
            friction: parameters.friction,
            least_normal_force: parameters.tension.least_normal_force(),
        }
    }

    #[inline(always)]
    fn respond<S: Scalar>(
        law: &Hertz<S>,
        contact: &Kinematics<S>,
        history: &SpringHistory<S>,
    ) -> (Response<S>, SpringHistory<S>) {
        let root = contact.overlap.sqrt();
        let elastic = law.normal_stiffness * contact.overlap * root;
        let force = elastic - law.damping * root.sqrt() * contact.separation_rate;
        let normal_force = force.larger(law.least_normal_force).within(contact.touching);
        let (kept, edge_loss) = follow_overlap(law, contact, history.tangential_displacement);
        let stiffness = law.tangential_stiffness * root;
        let friction_limit = law.friction * normal_force.abs();
        let limit = (friction_limit / stiffness).within(contact.touching);
        let spring = TruncatedSpring::new(stiffness, limit, kept, contact.slip);
        let response = Response {
            normal_force,
            tangential_force: spring.force,
            rolling_moment: S::zero(),
            pressing_force: normal_force,
            friction_limit,
            sticking: spring.sticking,
            flows: Flows {
                dissipated_normal: dashpot_loss(law, contact),
                dissipated_sliding: spring.dissipated + edge_loss,
                ..Flows::build(|_| S::zero())
            },
        };
        (response, SpringHistory { tangential_displacement: spring.displacement })
    }

    fn stored(law: &Hertz<f64>, overlap: f64, history: &SpringHistory<f64>) -> Stored<f64> {
        let (stretch, root) = (history.tangential_displacement, overlap.sqrt());
        Stored {
            elastic_normal: 0.4 * law.normal_stiffness * overlap * overlap * root,
            elastic_tangential: 0.5 * law.tangential_stiffness * root * stretch * stretch,
            ..Stored::build(|_| 0.0)
        }
    }
}

/// The stretch after the overlap has changed, at constant force where it has grown; and the energy lost.
#[inline(always)]
fn follow_overlap<S: Scalar>(law: &Hertz<S>, contact: &Kinematics<S>, stretch: S) -> (S, S) {
    let (before, after) = (contact.last_overlap.sqrt(), contact.overlap.sqrt());
    // Not above zero where there is no contact and never was.
    let most = before.larger(after).larger(S::splat(f64::MIN_POSITIVE));
    let ratio = before.smaller(after) / most;
    let held = S::splat(0.5) * law.tangential_stiffness * before * stretch * stretch;
    (stretch * (before / most), held * (S::splat(1.0) - ratio))
}

/// The dashpot's force at mid-step times the travel. Where the whole force is clipped, the dashpot holds just the spring.
#[inline(always)]
fn dashpot_loss<S: Scalar>(law: &Hertz<S>, contact: &Kinematics<S>) -> S {
    let mean_overlap = (contact.overlap + contact.last_overlap) * S::splat(0.5);
    let root = mean_overlap.sqrt();
    let force = law.damping * root.sqrt() * contact.step_rate * contact.approach;
    let least = law.least_normal_force - law.normal_stiffness * mean_overlap * root;
    (force.larger(least) * contact.travel).larger(S::zero())
}

/// k = 4/3 E* √R* / h [N/m^{5/2}].
fn normal_stiffness(parameters: &ContactParameters, bodies: BodyPair) -> f64 {
    let poisson = parameters.poisson_ratio;
    let modulus = parameters.young_modulus.unwrap_or_default() / (2.0 * (1.0 - poisson * poisson));
    4.0 / 3.0 * modulus * bodies.effective_radius.sqrt() / bodies.layer
}

/// Overlap over R* of the impact whose duration a step has to resolve.
const DEEP: f64 = 0.01;

/// The time [s] that a step has to resolve: the duration of an elastic impact that overlaps by a hundredth of R*,
/// 2.943 δ/v with v² = 4/5 (k/m*) δ^{5/2}. Harder ones are hardly shorter, with the fifth root of their speed.
pub fn collision_time(parameters: &ContactParameters, bodies: BodyPair) -> f64 {
    let overlap = DEEP * bodies.effective_radius;
    let stiffness = normal_stiffness(parameters, bodies);
    let speed = (0.8 * stiffness / bodies.effective_mass * overlap * overlap * overlap.sqrt()).sqrt();
    2.943 * overlap / speed
}
