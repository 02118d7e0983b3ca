//! The linear spring–dashpot with a Coulomb-limited tangential spring: Park & Wassgren's Eqs. 1 and 2.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use super::{Encounter, History, HistoryLanes, Response};
use crate::error::{Error, require_non_negative, require_positive};
use crate::lanes::{Lanes, lanes};

/// What a user sets: stiffness, damping, friction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LinearParameters {
    /// Normal stiffness kₙ [N/m].
    pub normal_stiffness: f64,
    /// kₛ / kₙ.
    pub stiffness_ratio: f64,
    /// Restitution e of a head-on impact, or none where the damping is given.
    #[serde(deserialize_with = "Option::deserialize")]
    pub restitution: Option<f64>,
    /// Normal damping νₙ [N s/m], or none where the restitution is given.
    #[serde(deserialize_with = "Option::deserialize")]
    pub normal_damping: Option<f64>,
    /// Friction coefficient μ.
    pub friction: f64,
    /// Whether the dashpot may pull.
    pub tension: Tension,
}

/// What happens where spring and dashpot together would pull the bodies towards each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Tension {
    /// They pull (the paper's law).
    Allowed,
    /// The normal force is zero instead.
    Clipped,
}

impl LinearParameters {
    /// Checks every field; `key` is the prefix that a user writes, such as `contact.bundle`.
    pub fn validate(&self, key: &str) -> Result<(), Error> {
        require_positive(&format!("{key}.normal_stiffness"), self.normal_stiffness)?;
        require_positive(&format!("{key}.stiffness_ratio"), self.stiffness_ratio)?;
        require_non_negative(&format!("{key}.friction"), self.friction)?;
        match (self.restitution, self.normal_damping) {
            (Some(restitution), None) if restitution > 0.0 && restitution <= 1.0 => Ok(()),
            (Some(restitution), None) => {
                Err(Error::config(format!("{key}.restitution"), restitution, "above 0 and at most 1"))
            }
            (None, Some(damping)) => require_non_negative(&format!("{key}.normal_damping"), damping),
            (given, _) => Err(Error::config(
                format!("{key}.restitution"),
                if given.is_some() { "given beside normal_damping" } else { "missing" },
                "given exactly when normal_damping is not",
            )),
        }
    }
}

/// The damping ratio ζ that gives the restitution e.
///
/// Tension allowed: e = exp(−π ζ / √(1 − ζ²)), so ζ = −ln e / √(π² + ln² e).
/// Clipped: the contact ends when the force vanishes; with φ = acos ζ, e = exp(−2 φ / tan φ), and beyond critical
/// damping, φ = acosh ζ, e = exp(−2 φ / tanh φ) (Schwager & Pöschel, Granular Matter 9 (2007) 465), solved by bisection.
fn damping_ratio_for(restitution: f64, tension: Tension) -> f64 {
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
    if ratio < 1.0 {
        let phase = libm::acos(ratio);
        2.0 * phase / libm::tan(phase)
    } else if ratio == 1.0 {
        2.0
    } else {
        let phase = libm::acosh(ratio);
        2.0 * phase / libm::tanh(phase)
    }
}

/// Linear spring–dashpot with a Coulomb-limited tangential spring.
///
/// Fₙ = kₙ δ + νₙ δ̇,   Fₜ = kₛ ξ  with |Fₜ| ≤ μ |Fₙ|
///
/// | symbol | field                               | unit  |
/// |--------|-------------------------------------|-------|
/// | kₙ, kₛ | `…_stiffness`                       | N/m   |
/// | νₙ     | `Encounter::damping`                | N s/m |
/// | μ / kₛ | `slip_compliance`                   | m²/N  |
/// | ξ      | `History::tangential_displacement`  | m     |
///
/// Where the spring would exceed μ |Fₙ|, it is truncated to it, and the lost stretch is sliding. There is no tangential
/// dashpot. Source: Cundall & Strack, Géotechnique 29 (1979) 47, doi:10.1680/geot.1979.29.1.47; the truncated form
/// is Park & Wassgren's Eq. 2. Does not model cohesion or rolling resistance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearLaw {
    /// kₙ [N/m].
    pub normal_stiffness: f64,
    /// kₛ [N/m].
    pub tangential_stiffness: f64,
    /// Where νₙ comes from.
    pub damping: Damping,
    /// μ / kₛ [m per N/m]: the stretch at which a unit of normal force lets the contact slide.
    pub slip_compliance: f64,
    /// The least normal force [N/m]: 0 where tension is clipped, −∞ where it is allowed.
    pub least_normal_force: f64,
}

/// Where the normal damping comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Damping {
    /// The damping ratio ζ = νₙ / (2 √(kₙ m*)), the same for bodies of any mass.
    Ratio(f64),
    /// The coefficient νₙ itself [N s/m].
    Coefficient(f64),
}

impl From<&LinearParameters> for LinearLaw {
    fn from(parameters: &LinearParameters) -> Self {
        let tangential_stiffness = parameters.stiffness_ratio * parameters.normal_stiffness;
        Self {
            normal_stiffness: parameters.normal_stiffness,
            tangential_stiffness,
            damping: match (parameters.restitution, parameters.normal_damping) {
                (Some(restitution), _) => Damping::Ratio(damping_ratio_for(restitution, parameters.tension)),
                (None, coefficient) => Damping::Coefficient(coefficient.unwrap_or(0.0)),
            },
            slip_compliance: parameters.friction / tangential_stiffness,
            least_normal_force: match parameters.tension {
                Tension::Allowed => f64::NEG_INFINITY,
                Tension::Clipped => 0.0,
            },
        }
    }
}

impl LinearLaw {
    /// Normal damping νₙ [N s/m] between bodies of the effective mass m* [kg/m].
    pub fn damping(&self, effective_mass: f64) -> f64 {
        match self.damping {
            Damping::Ratio(ratio) => 2.0 * ratio * (self.normal_stiffness * effective_mass).sqrt(),
            Damping::Coefficient(damping) => damping,
        }
    }

    /// The time [s] that a step has to resolve: the duration of a collision, π / (ω₀ √(1 − ζ²)), ω₀ = √(kₙ / m*),
    /// with tension clipped 2 acos ζ / (ω₀ √(1 − ζ²)).
    ///
    /// Strong damping stretches a collision without bound while the forces still change within 1/ω₀ and, beyond
    /// critical damping, within a fraction of it; the time is therefore never taken longer than
    /// π / (ω₀ · max(½, ζ)).
    pub fn collision_time(&self, effective_mass: f64) -> f64 {
        let frequency = (self.normal_stiffness / effective_mass).sqrt();
        let ratio = self.damping(effective_mass) / (2.0 * (self.normal_stiffness * effective_mass).sqrt());
        let resolved = PI / (frequency * ratio.max(0.5));
        if ratio >= 1.0 {
            return resolved;
        }
        let clipped = self.least_normal_force == 0.0;
        let phase = if clipped { 2.0 * libm::acos(ratio) } else { PI };
        resolved.min(phase / (frequency * (1.0 - ratio * ratio).sqrt()))
    }

    /// Energy held by the springs [J/m]: (normal, tangential).
    pub fn stored(&self, history: &History) -> (f64, f64) {
        let (overlap, stretch) = (history.overlap, history.tangential_displacement);
        (0.5 * self.normal_stiffness * overlap * overlap, 0.5 * self.tangential_stiffness * stretch * stretch)
    }
}

/// The laws of four contacts.
#[derive(Debug, Clone, Copy)]
pub struct LinearLanes {
    normal_stiffness: Lanes,
    tangential_stiffness: Lanes,
    slip_compliance: Lanes,
    least_normal_force: Lanes,
}

impl LinearLanes {
    /// One law for all.
    #[inline(always)]
    pub fn splat(law: &LinearLaw) -> Self {
        Self {
            normal_stiffness: Lanes::splat(law.normal_stiffness),
            tangential_stiffness: Lanes::splat(law.tangential_stiffness),
            slip_compliance: Lanes::splat(law.slip_compliance),
            least_normal_force: Lanes::splat(law.least_normal_force),
        }
    }

    /// A law for each index.
    pub fn new<'a>(law: impl Fn(usize) -> &'a LinearLaw) -> Self {
        Self {
            normal_stiffness: lanes(|lane| law(lane).normal_stiffness),
            tangential_stiffness: lanes(|lane| law(lane).tangential_stiffness),
            slip_compliance: lanes(|lane| law(lane).slip_compliance),
            least_normal_force: lanes(|lane| law(lane).least_normal_force),
        }
    }

    /// Forces and losses of one step.
    #[inline(always)]
    pub fn respond(&self, encounter: &Encounter, history: &HistoryLanes) -> Response {
        let zero = Lanes::ZERO;
        let overlap = encounter.overlap.fast_max(zero);
        let touching = encounter.overlap.simd_gt(zero);
        let touched = history.overlap.simd_gt(zero);
        // The step's whole change of overlap, and the part of it that fell within the contact.
        let (mut approach, travel) = (encounter.overlap - history.overlap, overlap - history.overlap);
        let mut share = touching & Lanes::ONE;
        if (touching & !touched).any() {
            approach = touched.select(approach, -encounter.displacement.parting);
            share = touched.select(share, touching & share_since_touch(travel, approach));
        }
        let dissipated_normal =
            self.dashpot_loss(encounter, (overlap + history.overlap) * 0.5, approach, travel);

        let normal_force = touching & self.normal_force(encounter);
        let slip = encounter.displacement.slip * share;
        let before = history.tangential_displacement;
        let trial = before + slip;
        let limit = self.slip_compliance * normal_force.abs();
        let stretch = trial.fast_max(-limit).fast_min(limit);
        Response {
            normal_force,
            tangential_force: self.tangential_stiffness * stretch,
            tangential_displacement: stretch,
            dissipated_normal,
            dissipated_sliding: self.sliding_loss(before, stretch, trial - stretch),
        }
    }

    /// Fₙ = kₙ δ + νₙ δ̇, or the least that is allowed.
    #[inline(always)]
    fn normal_force(&self, encounter: &Encounter) -> Lanes {
        let force = self.normal_stiffness * encounter.overlap - encounter.damping * encounter.parting_speed;
        force.fast_max(self.least_normal_force)
    }

    /// The dashpot's force at mid-step times the travel. Where the whole force is clipped, the dashpot holds just the
    /// spring.
    #[inline(always)]
    fn dashpot_loss(
        &self,
        encounter: &Encounter,
        mean_overlap: Lanes,
        approach: Lanes,
        travel: Lanes,
    ) -> Lanes {
        let force = encounter.damping * (approach * encounter.step_rate);
        let force = force.fast_max(self.least_normal_force - self.normal_stiffness * mean_overlap);
        (force * travel).fast_max(Lanes::ZERO)
    }

    /// Work of the friction force over the stretch that truncation took away: mean of the forces before and after, or
    /// the force after where sliding turned round within the step. Where the contact has opened, nothing is left after,
    /// and this is all that the spring held.
    #[inline(always)]
    fn sliding_loss(&self, before: Lanes, after: Lanes, slid: Lanes) -> Lanes {
        let turned = (before * after).simd_lt(Lanes::ZERO);
        let mean = turned.select(after, (before + after) * 0.5);
        self.tangential_stiffness * mean * slid
    }
}

/// The part of a step's slip that stretches the spring of a contact that has just formed: what comes after first touch.
#[inline(always)]
fn share_since_touch(travel: Lanes, approach: Lanes) -> Lanes {
    approach.simd_gt(travel).select(travel / approach, Lanes::ONE)
}

#[cfg(test)]
mod tests {
    use super::super::Displacement;
    use super::*;

    fn table_1(tension: Tension) -> LinearParameters {
        LinearParameters {
            normal_stiffness: 9.25e7,
            stiffness_ratio: 1.0,
            restitution: Some(0.1),
            normal_damping: None,
            friction: 0.5,
            tension,
        }
    }

    const BUNDLE_MASS: f64 = 1000.0 * PI * 0.02375 * 0.02375 / 4.0;

    #[test]
    fn table_1_damping_and_collision_time_follow_from_the_restitution() {
        let bundle = LinearLaw::from(&table_1(Tension::Allowed));
        assert!((bundle.damping(0.5 * BUNDLE_MASS) - 5.35e3).abs() < 5.0);
        assert!((bundle.collision_time(0.5 * BUNDLE_MASS) - 1.906e-4).abs() < 1e-7);
        let drum = LinearLaw { normal_stiffness: 9.70e7, ..bundle };
        assert!((drum.damping(BUNDLE_MASS) - 7.75e3).abs() < 5.0);
    }

    #[test]
    fn clipped_restitution_matches_schwager_and_poschel() {
        for (ratio, restitution) in [(0.1, 0.7441), (0.3, 0.4510), (0.6, 0.2488), (0.8, 0.1798)] {
            assert!((libm::exp(-clipped_decay(ratio)) - restitution).abs() < 5e-5);
            assert!((damping_ratio_for(restitution, Tension::Clipped) - ratio).abs() < 3e-4);
        }
        assert!(damping_ratio_for(0.1, Tension::Clipped) > 1.0, "0.1 lies beyond critical damping");
    }

    #[test]
    fn losses_are_never_negative() {
        for tension in [Tension::Allowed, Tension::Clipped] {
            let law = LinearLaw::from(&table_1(tension));
            for k in 0..2000_i32 {
                let wave = |n: i32| f64::from((k * n) % 17 - 8) * 1e-6;
                let overlap = wave(3).max(0.0);
                let history = History {
                    overlap,
                    tangential_displacement: if overlap > 0.0 { wave(5) } else { 0.0 },
                    ..History::default()
                };
                let encounter = Encounter {
                    overlap: lanes(|_| wave(7)),
                    displacement: Displacement { parting: lanes(|_| wave(11)), slip: lanes(|_| wave(13)) },
                    parting_speed: lanes(|_| wave(2) * 1e5),
                    damping: lanes(|_| 5e3),
                    step_rate: 1.0 / 3.7e-6,
                };
                let response =
                    LinearLanes::new(|_| &law).respond(&encounter, &HistoryLanes::new(|_| &history));
                assert!(response.dissipated_normal.to_array()[0] >= 0.0, "{k}");
                assert!(response.dissipated_sliding.to_array()[0] >= 0.0, "{k}");
            }
        }
    }

    #[test]
    fn bad_parameters_are_named() {
        let both = LinearParameters { normal_damping: Some(1.0), ..table_1(Tension::Allowed) };
        let text = both.validate("contact.drum").unwrap_err().to_string();
        assert!(text.starts_with("contact.drum.restitution is given beside normal_damping"), "{text}");
        let elastic_plus = LinearParameters { restitution: Some(1.5), ..table_1(Tension::Allowed) };
        let text = elastic_plus.validate("contact.bundle").unwrap_err().to_string();
        assert_eq!(text, "contact.bundle.restitution is 1.5, but must be above 0 and at most 1");
    }
}
