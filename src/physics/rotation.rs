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

#[cfg(test)]
mod tests {
    use super::*;

    fn program() -> RotationSchedule {
        RotationSchedule { knots: vec![[0.5, 2.0], [1.5, -1.0], [1.75, -1.0], [4.0, 6.0]] }
    }

    /// The angle by Simpson's rule: exact but for the few short intervals that hold a knot.
    fn integrated(schedule: &RotationSchedule, from: f64, to: f64) -> f64 {
        let count = 4000;
        let width = (to - from) / f64::from(count);
        let interval = |k: i32| {
            let start = from + f64::from(k) * width;
            let [a, b, c] = [0.0, 0.5, 1.0].map(|part| schedule.angular_velocity(start + part * width));
            (a + 4.0 * b + c) * width / 6.0
        };
        (0..count).map(interval).sum()
    }

    #[test]
    fn velocity_is_linear_between_knots_and_constant_outside() {
        let times = [0.0, 0.5, 1.0, 1.5, 1.6, 2.875, 4.0, 9.0];
        assert_eq!(times.map(|t| program().angular_velocity(t)), [2.0, 2.0, 0.5, -1.0, -1.0, 2.5, 6.0, 6.0]);
    }

    #[test]
    fn angle_is_the_integral_of_the_velocity() {
        for time in [0.0, 0.25, 0.5, 0.875, 1.5, 1.625, 3.0, 4.0, 8.0] {
            assert!((program().angle(time) - integrated(&program(), 0.0, time)).abs() < 2e-6, "{time}");
        }
        // 0.5 s at 2, ramp to −1 in 1 s, 0.25 s at −1, ramp to 6 in 2.25 s, 1 s at 6.
        assert_eq!(program().angle(5.0), 1.0 + 0.5 - 0.25 + 5.625 + 6.0);
        assert_eq!(program().angle(0.0), 0.0);
        assert_eq!(RotationSchedule::constant(5.5).angle(1e6 + 0.25), 5.5 * (1e6 + 0.25));
    }

    #[test]
    fn increments_are_integrals_and_add_up_to_the_angle() {
        let steps = 1 << 12;
        let step = 6.0 / f64::from(steps);
        let sum: f64 =
            (0..steps).map(|k| program().angle_increment(f64::from(k) * step, f64::from(k + 1) * step)).sum();
        assert!((sum - program().angle(6.0)).abs() < 1e-12);
        for (from, to) in [(0.25, 0.3), (0.3, 1.25), (1.0, 5.0), (4.5, 4.75)] {
            assert!((program().angle_increment(from, to) - integrated(&program(), from, to)).abs() < 2e-6);
            assert_eq!(program().angle_increment(to, from), -program().angle_increment(from, to));
        }
    }

    #[test]
    fn late_increments_lose_no_digits() {
        let mut knots = program().knots;
        knots.push([2e6, 5.0]);
        let (start, step) = (1_048_576.0, 1.0 / 262_144.0);
        let increment = RotationSchedule { knots }.angle_increment(start, start + step);
        let rate = 6.0 - (start + 0.5 * step - 4.0) / (2e6 - 4.0);
        assert!((increment / (rate * step) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn reversed_schedule_turns_by_exactly_the_opposite_angle() {
        let reversed =
            RotationSchedule { knots: program().knots.iter().map(|&[t, rate]| [t, -rate]).collect() };
        for time in [0.0, 0.1, 0.7, 1.3, 1.7, 3.3, 7.7] {
            assert_eq!(reversed.angle(time), -program().angle(time));
            assert_eq!(reversed.angle_increment(0.3, time), -program().angle_increment(0.3, time));
        }
    }

    #[test]
    fn scaled_time_gives_the_same_angle_bit_for_bit() {
        let slow = RotationSchedule {
            knots: program().knots.iter().map(|&[t, rate]| [2.0 * t, 0.5 * rate]).collect(),
        };
        for time in [0.1, 0.7, 1.3, 1.7, 3.3, 7.7] {
            assert_eq!(slow.angle(2.0 * time).to_bits(), program().angle(time).to_bits());
            let (increment, expected) =
                (slow.angle_increment(0.6, 2.0 * time), program().angle_increment(0.3, time));
            assert_eq!(increment.to_bits(), expected.to_bits());
        }
    }

    #[test]
    fn pose_gathers_angle_velocity_and_rotation() {
        let pose = program().pose(1.0);
        assert_eq!((pose.angle, pose.angular_velocity), (program().angle(1.0), 0.5));
        assert_eq!(pose.rotation, Rotation::new(pose.angle));
    }

    #[test]
    fn constant_schedules_are_recognized() {
        assert!(RotationSchedule::constant(3.0).is_constant());
        assert!(RotationSchedule { knots: vec![[0.0, 1.0], [2.0, 1.0]] }.is_constant());
        assert!(!program().is_constant());
    }

    #[test]
    fn unusable_schedules_are_refused() {
        let message = |knots: Vec<[f64; 2]>| RotationSchedule { knots }.validate().unwrap_err().to_string();
        assert_eq!(
            message(vec![]),
            "rotation.program is empty, but must be a list of at least one time and speed"
        );
        assert_eq!(message(vec![[0.0, f64::NAN]]), "rotation.program is NaN, but must be a finite number");
        assert_eq!(
            message(vec![[-1.0, 2.0]]),
            "rotation.program is a list that starts at -1 s, but must be a list that starts at 0 s or later"
        );
        assert_eq!(
            message(vec![[0.0, 2.0], [3.0, 1.0], [3.0, 4.0]]),
            "rotation.program is a list with 3 s after 3 s, but must be a list of strictly increasing times"
        );
        assert!(program().validate().is_ok());
    }
}
