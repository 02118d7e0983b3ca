//! Until when candidates may sleep: clocks that go with what the particles of a patch do.

use crate::physics::vector::larger;

/// What the wakes of candidates are compared with.
pub trait Clock: Clone + Copy + Default {
    /// What it shows; a candidate is due as soon as that is not below its wake.
    fn reading(&self) -> f64;
}

/// Shows how far anyone can have moved since the list was built [m].
#[derive(Debug, Clone, Copy, Default)]
pub struct WayClock {
    way: f64,
}

impl WayClock {
    /// Follows a step in which nobody moved farther than `way`, to first order in the drum's turn, and `arc` more.
    pub fn advance(&mut self, way: f64, arc: f64) {
        self.way += way + arc;
    }
}

impl Clock for WayClock {
    #[inline(always)]
    fn reading(&self) -> f64 {
        self.way
    }
}

/// Shows the number of steps since the list was built, and more where somebody's displacement changes from one step to the
/// next by more than a limit. Where it changes by far more, everybody is due.
///
/// Two particles whose gap is g, and which approach by c in a step, cannot touch before the clock has gone on by k if
///
/// > g > c k + L k (k + 1)
///
/// with the limit L: each may change the displacements of all steps that follow. A change of x L does what those of x steps
/// do, so the clock goes on by x; as steps are fewer then, what they make of c is less.
#[derive(Debug, Clone, Copy, Default)]
pub struct StepClock {
    steps: f64,
    limit: f64,
    is_exceeded: bool,
}

/// Changes of so many limits wake everybody, as the limit is too low; speed is flat from 2 to 8.
const FAR_MORE: f64 = 4.0;
/// The part of itself by which the limit falls in a step; speed is flat from 1/256 to 1/16.
const DECAY: f64 = 1.0 / 64.0;

impl StepClock {
    /// Follows a step in which nobody's displacement departed from that of the step before by more than `change` [m].
    pub fn advance(&mut self, change: f64) {
        self.is_exceeded = change > FAR_MORE * self.limit;
        // Who sleeps relies on the limit: it may fall at any time, but rise only where everybody is woken.
        if self.is_exceeded {
            self.steps += 1.0;
            self.limit = change;
        } else {
            self.steps += larger(1.0, change / self.limit);
            self.limit = larger(self.limit * (1.0 - DECAY), change.min(self.limit));
        }
    }

    /// What it shows, as long as nobody is woken.
    #[inline(always)]
    pub fn steps(&self) -> f64 {
        self.steps
    }

    /// The most by which a displacement may depart from that of the step before [m].
    #[inline(always)]
    pub fn limit(&self) -> f64 {
        self.limit
    }
}

impl Clock for StepClock {
    #[inline(always)]
    fn reading(&self) -> f64 {
        if self.is_exceeded { f64::INFINITY } else { self.steps }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clock_of_steps_goes_on_by_changes_beyond_its_limit() {
        let mut clock = StepClock::default();
        let mut reading = |change: f64| {
            clock.advance(change);
            clock.reading()
        };
        assert_eq!(reading(1.0), f64::INFINITY, "nothing is known before the first step");
        assert_eq!(reading(1.0), 2.0);
        assert_eq!(reading(2.5), 4.5);
        assert_eq!(reading(4.5), f64::INFINITY);
        assert_eq!(reading(0.1), 6.5);
        let falls = (0..200).map(|_| reading(0.1)).all(f64::is_finite);
        assert!(falls);
        assert_eq!(reading(4.5), f64::INFINITY, "the limit falls when little happens");
    }

    /// Two particles that use all that their changes allow them.
    #[test]
    fn nobody_comes_closer_than_the_clock_says() {
        let mut clock = StepClock::default();
        clock.advance(1.0);
        let (limit, approach) = (clock.limit(), 0.5);
        let (mut pace, mut way, began) = (approach, 0.0, clock.steps());
        for step in 0..200_i32 {
            let change = 0.2 + 3.5 * f64::from(step * 7919 % 100) / 100.0;
            clock.advance(change);
            if clock.reading() == f64::INFINITY {
                break;
            }
            pace += 2.0 * change;
            way += pace;
            let gone = clock.steps() - began;
            assert!(way <= (approach + limit * (gone + 1.0)) * gone * (1.0 + 1e-12), "step {step}");
        }
    }

    #[test]
    fn a_limit_rises_only_where_everybody_is_woken() {
        let mut clock = StepClock::default();
        for step in 0..1000 {
            let before = clock.limit();
            clock.advance(1.0 + 9.0 * f64::from(step * 7919 % 100) / 100.0);
            assert!(clock.limit() <= before || clock.reading() == f64::INFINITY, "step {step}");
        }
    }
}
