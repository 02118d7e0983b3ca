//! The third of the three powers of the drum, Ω (M g x + dL/dt): from the balance of moments about the axis.

use serde::{Deserialize, Serialize};

use super::sum::{Integrals, Sum};
use crate::physics::vector::Vec2;

/// ∫ Ω (dL/dt − outer moment) dt, and ∫ Σ m x dt.
///
/// While the drum's speed is constant the angular momentum L telescopes: it is needed only at the ends of such a spell, and
/// in every step in between where the speed changes.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct MomentBalance {
    /// Of the outer moment over the angle turned, and of Σ m x and Σ m y over time.
    integrals: Integrals,
    /// ∫ Ω dL, but for the spell since `angular_momentum` was last noted.
    accelerated: Sum,
    angular_momentum: f64,
}

impl MomentBalance {
    /// Opened with Σ m x [kg], the moment of what acts from outside [N m/m] and the angular momentum [kg m/s].
    pub fn open(mass_moment: Vec2, outer_moment: f64, angular_momentum: f64) -> Self {
        Self {
            integrals: Integrals::from([outer_moment, mass_moment.x, mass_moment.y, 0.0]),
            accelerated: Sum::default(),
            angular_momentum,
        }
    }

    /// Charges a step of the length `time_step` [s] in which the drum turned by `turn` [rad].
    #[inline]
    pub fn charge(&mut self, mass_moment: Vec2, outer_moment: f64, turn: f64, time_step: f64) {
        let half = 0.5 * time_step;
        self.integrals
            .advance([outer_moment, mass_moment.x, mass_moment.y, 0.0], [0.5 * turn, half, half, 0.0]);
    }

    /// Charges what the angular momentum has changed by since it was last noted, at the drum's speed in that time [rad/s].
    pub fn charge_angular_momentum(&mut self, now: f64, angular_velocity: f64) {
        self.accelerated.add((now - self.angular_momentum) * angular_velocity);
        self.angular_momentum = now;
    }

    /// Brings the sums of the last steps to the others.
    pub fn fold(&mut self) {
        self.integrals.fold();
    }

    /// The work [J/m]; the angular momentum must have been charged up to now.
    pub fn work(&self) -> f64 {
        self.accelerated.value() - self.integrals.value(0)
    }

    /// ∫ Σ m x dt [kg s], x and y.
    pub fn mass_moment_integral(&self) -> [f64; 2] {
        [self.integrals.value(1), self.integrals.value(2)]
    }

    /// Σ m x now [kg].
    pub fn mass_moment(&self) -> Vec2 {
        let [_, x, y, _] = self.integrals.last();
        Vec2::new(x, y)
    }
}
