//! How the drum turns: a schedule of angular velocities, and its angle in closed form.

use serde::{Deserialize, Serialize};

use crate::error::{Error, require_finite};
use crate::physics::vector::Rotation;

/// The drum's angular velocity over time: linear between knots, constant before the first and after the last.
///
/// Ω(t) = Ωᵢ + (Ωᵢ₊₁ − Ωᵢ) (t − tᵢ)/(tᵢ₊₁ − tᵢ),   θ(t) = ∫₀ᵗ Ω dt
///
/// The angle is a sum of trapezoids, exact for this Ω and never accumulated by steps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RotationSchedule {
    /// (time [s], angular velocity [rad/s], positive counter-clockwise), in order of time.
    pub knots: Vec<[f64; 2]>,
}

/// The drum at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Angle θ turned since t = 0 [rad].
    pub angle: f64,
    /// Angular velocity Ω [rad/s].
    pub angular_velocity: f64,
    /// The rotation by θ, from the drum's frame to the fixed one.
    pub rotation: Rotation,
}

/// Beyond this a sum of two speeds or times may be infinite.
const GREATEST: f64 = 1e300;

impl RotationSchedule {
    /// The same angular velocity [rad/s] at all times.
    pub fn constant(angular_velocity: f64) -> Self {
        Self { knots: vec![[0.0, angular_velocity]] }
    }

    /// Checks that there are knots, finite, in strict order of time from t = 0 on.
    pub fn validate(&self) -> Result<(), Error> {
        let refuse = |value: String, limit: &str| Err(Error::config("rotation.program", value, limit));
        for value in self.knots.iter().flatten() {
            require_finite("rotation.program", *value)?;
            if value.abs() > GREATEST {
                return refuse(format!("{value:e}"), "a list of numbers within ±1e300");
            }
        }
        match self.knots.first() {
            None => return refuse("empty".into(), "a list of at least one time and speed"),
            Some(&[time, _]) if time < 0.0 => {
                return refuse(
                    format!("a list that starts at {time} s"),
                    "a list that starts at 0 s or later",
                );
            }
            Some(_) => {}
        }
        match self.knots.windows(2).find(|pair| pair[1][0] <= pair[0][0]) {
            None => Ok(()),
            Some(pair) => refuse(
                format!("a list with {} s after {} s", pair[1][0], pair[0][0]),
                "a list of strictly increasing times",
            ),
        }
    }

    /// Whether the drum turns at one angular velocity at all times.
    pub fn is_constant(&self) -> bool {
        self.knots.windows(2).all(|pair| pair[0][1] == pair[1][1])
    }

    /// Ω at `time` [s], in rad/s.
    pub fn angular_velocity(&self, time: f64) -> f64 {
        let next = self.first_after(time);
        let before = next.checked_sub(1).and_then(|index| self.knots.get(index));
        match (before, self.knots.get(next)) {
            (Some(&[start, from]), Some(&[end, to])) => from + (to - from) * ((time - start) / (end - start)),
            (Some(&[_, rate]), None) | (None, Some(&[_, rate])) => rate,
            (None, None) => 0.0,
        }
    }

    /// θ at `time` [s], in rad; 0 at t = 0.
    pub fn angle(&self, time: f64) -> f64 {
        self.angle_increment(0.0, time)
    }

    /// The angle [rad] turned between two times [s], as precise for a short step late in a run as at its
    /// start.
    pub fn angle_increment(&self, from: f64, to: f64) -> f64 {
        if to < from {
            return -self.angle_increment(to, from);
        }
        let trapezoid = |duration: f64, rate: f64, next: f64| duration * (0.5 * (rate + next));
        let (mut time, mut rate, mut angle) = (from, self.angular_velocity(from), 0.0);
        for &[next_time, next_rate] in &self.knots[self.first_after(from)..] {
            if next_time >= to {
                break;
            }
            angle += trapezoid(next_time - time, rate, next_rate);
            (time, rate) = (next_time, next_rate);
        }
        angle + trapezoid(to - time, rate, self.angular_velocity(to))
    }

    /// The drum at `time` [s].
    pub fn pose(&self, time: f64) -> Pose {
        let angle = self.angle(time);
        Pose { angle, angular_velocity: self.angular_velocity(time), rotation: Rotation::new(angle) }
    }

    /// Index of the first knot later than `time`.
    fn first_after(&self, time: f64) -> usize {
        self.knots.partition_point(|knot| knot[0] <= time)
    }
}
