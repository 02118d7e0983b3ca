//! Until when candidates may sleep: clocks that go with what the particles of a patch do.

use crate::vector::larger;

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

/// Shows the number of steps since the list was built, as long as nobody's displacement changes from one step to the next
/// by more than a limit. Where it does, everybody is due.
///
/// Two particles whose gap is g, and which approach by c in a step, cannot touch for k steps if
///
/// > g > c k + L k (k + 1)
///
/// with the limit L: each may change the displacements of all steps that follow.
#[derive(Debug, Clone, Copy, Default)]
pub struct StepClock {
    steps: f64,
    limit: f64,
    is_exceeded: bool,
}

/// The limit over the greatest change, so that it is seldom exceeded, and the part of itself by which it falls in a step.
/// Speed is flat from 1.2 to 2 and from 1/256 to 1/16.
const HEADROOM: f64 = 1.5;
const DECAY: f64 = 1.0 / 64.0;

impl StepClock {
    /// Follows a step in which nobody's displacement departed from that of the step before by more than `change` [m].
    pub fn advance(&mut self, change: f64) {
        self.steps += 1.0;
        self.is_exceeded = change > self.limit;
        let enough = HEADROOM * change;
        // Who sleeps relies on the limit: it may fall at any time, but rise only where everybody is woken.
        self.limit = if self.is_exceeded {
            enough
        } else {
            larger(self.limit * (1.0 - DECAY), enough.min(self.limit))
        };
    }

    /// Number of steps since the list was built.
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
    fn a_clock_of_steps_wakes_all_when_its_limit_is_exceeded() {
        let mut clock = StepClock::default();
        let mut reading = |change: f64| {
            clock.advance(change);
            clock.reading()
        };
        assert_eq!(reading(1.0), f64::INFINITY, "nothing is known before the first step");
        assert_eq!(reading(1.4), 2.0);
        assert_eq!(reading(2.2), f64::INFINITY);
        assert_eq!(reading(0.1), 4.0);
        let falls = (0..100).map(|_| reading(0.1)).all(f64::is_finite);
        assert!(falls);
        assert_eq!(reading(2.2), f64::INFINITY, "the limit falls when little happens");
    }

    #[test]
    fn a_limit_rises_only_where_everybody_is_woken() {
        let mut clock = StepClock::default();
        for step in 0..1000 {
            let before = clock.limit();
            clock.advance(1.0 + 0.3 * f64::from(step * 7919 % 100) / 100.0);
            assert!(clock.limit() <= before || clock.reading() == f64::INFINITY, "step {step}");
        }
    }
}
