//! For how long a near list holds: a bound on how far two bodies can approach.
//!
//! Let u be the displacement of a particle in a step, and c the most by which any u of the particles concerned changes from
//! one step to the next. Two particles at the distance d whose displacements bring them closer by a in a step are then, k
//! steps later, no closer than
//!
//! > d − a k − 2 S,   S = Σ (k + 1 − q) c_q, the sum of the sums of the changes so far.
//!
//! Each step adds its greatest change to one sum and that to another; a list made for gaps of at least a k + B holds for k
//! steps, or until 2 S exceeds the budget B.

/// Steps for which a near list is made. Flat from 24 to 48.
pub const STEPS: u32 = 32;

/// The budget over what the changes of the last steps would use: so that a list seldom ends before its steps are over.
const HEADROOM: f64 = 2.0;

/// The part of its expectation that a horizon keeps from one list to the next, if less happens.
const DECAY: f64 = 0.5;

/// Until when a near list holds.
#[derive(Debug, Clone, Copy)]
pub struct Horizon {
    /// Steps for which a list is made.
    steps: u32,
    steps_left: u32,
    /// Σ c.
    changes: f64,
    /// Σ Σ c.
    displaced: f64,
    /// B [m].
    budget: f64,
    /// The change that is expected in a step [m].
    expected: f64,
}

impl Horizon {
    /// Of lists that are made for so many steps, at least one; there is none yet.
    pub fn of(steps: u32) -> Self {
        Self { steps: steps.max(1), steps_left: 0, changes: 0.0, displaced: 0.0, budget: 0.0, expected: 0.0 }
    }

    /// Steps for which a list is made.
    pub fn steps(&self) -> u32 {
        self.steps
    }

    /// Whether the list has to be made anew.
    #[inline]
    pub fn is_over(&self) -> bool {
        // What is not a number is over, too.
        !(self.steps_left > 0 && 2.0 * self.displaced <= self.budget)
    }

    /// Takes note of a step in which no displacement changed by more than `change` [m].
    #[inline]
    pub fn advance(&mut self, change: f64) {
        // Where there is no list, nothing may be known of the changes either.
        if self.steps_left == 0 {
            return;
        }
        self.steps_left -= 1;
        self.changes += change;
        self.displaced += self.changes;
    }

    /// Begins a list for the next steps.
    pub fn restart(&mut self) {
        let steps_done = self.steps - self.steps_left.min(self.steps - 1);
        self.expected = (DECAY * self.expected).max(self.changes / f64::from(steps_done));
        let steps_of_steps = 0.5 * f64::from(self.steps) * f64::from(self.steps + 1);
        self.budget = 2.0 * HEADROOM * self.expected * steps_of_steps;
        (self.steps_left, self.changes, self.displaced) = (self.steps, 0.0, 0.0);
    }

    /// Ends the list at once.
    pub fn end(&mut self) {
        self.steps_left = 0;
    }

    /// What two bodies may come closer by changes of their displacements while the list holds [m].
    pub fn budget(&self) -> f64 {
        self.budget
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two particles that use all that their changes allow them, in lists made at any moment.
    #[test]
    fn no_pair_comes_closer_than_the_horizon_says() {
        let mut horizon = Horizon::of(STEPS);
        let (mut rate, mut gone, mut lists) = (0.0, 0.0, 0);
        let (mut approach, mut steps) = (0.0, 0);
        for step in 0..4000_i32 {
            if horizon.is_over() {
                horizon.restart();
                (approach, gone, steps) = (rate, 0.0, 0);
                lists += 1;
            }
            // Where the list is read, the bodies have come closer by this since it was made.
            assert!(gone <= approach * f64::from(steps) + horizon.budget(), "step {step}");
            let change = if step % 700 < 100 { 9.0 } else { 0.1 + f64::from(step * 7919 % 100) / 100.0 };
            rate += 2.0 * change;
            gone += rate;
            steps += 1;
            horizon.advance(change);
        }
        assert!(lists < 4000 / 16, "{lists}");
        horizon.advance(f64::NAN);
        assert!(horizon.is_over());
    }
}
