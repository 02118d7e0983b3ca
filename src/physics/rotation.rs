//! How the drum turns: a schedule of angular velocities, and its angle in closed form.

use serde::{Deserialize, Serialize};

use crate::error::{Error, require, require_finite};

/// The drum's angular velocity over time: linear between knots, constant before the first and after the last. Two knots of
/// one time are a jump.
///
/// Ω(t) = Ωᵢ + (Ωᵢ₊₁ − Ωᵢ) (t − tᵢ)/(tᵢ₊₁ − tᵢ),   θ(t) = ∫₀ᵗ Ω dt
///
/// The angle is a sum of trapezoids, exact for this Ω, jumps included, and never accumulated by steps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RotationSchedule {
    /// (time [s], angular velocity [rad/s], positive counter-clockwise), in order of time.
    pub knots: Vec<[f64; 2]>,
}

/// Beyond this a sum of two speeds or times may be infinite.
const GREATEST: f64 = 1e300;

impl RotationSchedule {
    /// The same angular velocity [rad/s] at all times.
    pub fn constant(angular_velocity: f64) -> Self {
        Self { knots: vec![[0.0, angular_velocity]] }
    }

    /// Checks that there are knots, finite, in order of time from t = 0 on.
    pub fn validate(&self) -> Result<(), Error> {
        let key = "rotation.program";
        for value in self.knots.iter().flatten() {
            require_finite(key, *value)?;
            require(value.abs() <= GREATEST, key, *value, "a list of numbers within ±1e300")?;
        }
        let Some(&[start, _]) = self.knots.first() else {
            return Err(Error::config(key, "empty", "a list of at least one time and speed"));
        };
        let found = format!("a list that starts at {start} s");
        require(start >= 0.0, key, found, "a list that starts at 0 s or later")?;
        self.knots.windows(2).try_for_each(|pair| {
            let [before, after] = [pair[0][0], pair[1][0]];
            let found = format!("a list with {after} s after {before} s");
            require(after >= before, key, found, "a list of increasing times")
        })?;
        self.knots.windows(3).try_for_each(|knots| {
            let time = knots[0][0];
            let found = format!("a list with three knots at {time} s");
            require(
                knots[2][0] > time,
                key,
                found,
                "a list of at most two knots at one time, before and after a jump",
            )
        })
    }

    /// Whether the drum turns at one angular velocity at all times.
    pub fn is_constant(&self) -> bool {
        self.knots.windows(2).all(|pair| pair[0][1] == pair[1][1])
    }

    /// Whether the drum turns at one angular velocity from one time to another [s].
    pub fn is_steady(&self, from: f64, to: f64) -> bool {
        let speed = self.angular_velocity(from);
        let between = self.knots[self.first_after(from)..].iter().take_while(|knot| knot[0] < to);
        between.map(|knot| knot[1]).all(|rate| rate == speed) && self.angular_velocity(to) == speed
    }

    /// The greatest magnitude of Ω [rad/s].
    pub fn greatest_speed(&self) -> f64 {
        self.knots.iter().fold(0.0, |most, knot| most.max(knot[1].abs()))
    }

    /// Ω at `time` [s], in rad/s; at a jump the one after it.
    pub fn angular_velocity(&self, time: f64) -> f64 {
        let next = self.first_after(time);
        let before = next.checked_sub(1).and_then(|index| self.knots.get(index));
        match (before, self.knots.get(next)) {
            (Some(&[start, from]), Some(&[end, to])) => from + (to - from) * ((time - start) / (end - start)),
            (Some(&[_, rate]), None) | (None, Some(&[_, rate])) => rate,
            (None, None) => 0.0,
        }
    }

    /// Ω just before `time` [s], in rad/s.
    fn angular_velocity_before(&self, time: f64) -> f64 {
        match self.knots.get(self.knots.partition_point(|knot| knot[0] < time)) {
            Some(&[at, rate]) if at == time => rate,
            _ => self.angular_velocity(time),
        }
    }

    /// θ at `time` [s], in rad; 0 at t = 0.
    pub fn angle(&self, time: f64) -> f64 {
        self.angle_increment(0.0, time)
    }

    /// θ at every knot, for `angle_by`.
    pub fn angles_at_knots(&self) -> Vec<f64> {
        let first = self.knots.first().map_or(0.0, |&[time, rate]| trapezoid(time, rate, rate));
        let turns =
            self.knots.windows(2).map(|pair| trapezoid(pair[1][0] - pair[0][0], pair[0][1], pair[1][1]));
        let sums = turns.scan(first, |angle, turn| {
            *angle += turn;
            Some(*angle)
        });
        std::iter::once(first).chain(sums).collect()
    }

    /// θ at `time` [s], the same bits as `angle`, in a time that does not grow with the number of knots.
    pub fn angle_by(&self, angles_at_knots: &[f64], time: f64) -> f64 {
        match self.first_after(time).checked_sub(1) {
            Some(last) => {
                let [start, rate] = self.knots[last];
                angles_at_knots[last] + trapezoid(time - start, rate, self.angular_velocity(time))
            }
            None => self.angle(time),
        }
    }

    /// The angle [rad] turned between two times [s], as precise for a short step late in a run as at its
    /// start.
    pub fn angle_increment(&self, from: f64, to: f64) -> f64 {
        if to < from {
            return -self.angle_increment(to, from);
        }
        let (mut time, mut rate, mut angle) = (from, self.angular_velocity(from), 0.0);
        for &[next_time, next_rate] in &self.knots[self.first_after(from)..] {
            if next_time >= to {
                break;
            }
            angle += trapezoid(next_time - time, rate, next_rate);
            (time, rate) = (next_time, next_rate);
        }
        angle + trapezoid(to - time, rate, self.angular_velocity_before(to))
    }

    /// Index of the first knot later than `time`.
    fn first_after(&self, time: f64) -> usize {
        self.knots.partition_point(|knot| knot[0] <= time)
    }
}

/// The angle turned in a time at a speed that changes evenly.
fn trapezoid(duration: f64, rate: f64, next: f64) -> f64 {
    duration * (0.5 * (rate + next))
}
