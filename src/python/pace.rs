//! How many steps a run does before it looks for signals and lets others have the simulation.

use std::time::{Duration, Instant};

use crate::error::Error;

/// How long a slice of a run takes, after which signals are looked for.
pub const SLICE: Duration = Duration::from_millis(30);
/// The least number of steps of a slice: to end one and to begin another costs a small part of a step.
const SLICE_STEPS: u64 = 50;
/// How long so many steps may take, so that a signal is heard within a second at any size.
const LONGEST_SLICE: Duration = Duration::from_millis(500);
/// Particles times steps of the first slice, whose speed is not known yet: a tenth of a second on a slow machine.
const FIRST_SLICE: u64 = 500_000;

/// Steps that fit into a slice, learnt while running.
pub struct Pace {
    steps: u64,
}

impl Pace {
    /// Of the first slice of a load.
    pub fn of(count: usize) -> Self {
        Self { steps: (FIRST_SLICE / (count as u64).max(1)).clamp(1, SLICE_STEPS) }
    }

    /// Has `run` do the steps of a slice, of which there are `left` at most.
    pub fn slice(&mut self, left: u64, run: impl FnOnce(u64) -> Result<(), Error>) -> Result<(), Error> {
        let steps = self.steps.min(left);
        let start = now();
        run(steps)?;
        self.adapt(steps, start.elapsed());
        Ok(())
    }

    fn adapt(&mut self, steps: u64, elapsed: Duration) {
        let step = (elapsed.as_secs_f64() / steps.max(1) as f64).max(1e-9);
        let fitting = |time: Duration| (time.as_secs_f64() / step) as u64;
        // The first steps are slower than the rest, and few: slices grow fast, but not at one bound.
        let wanted = fitting(SLICE).min(4 * self.steps);
        self.steps = wanted.max(SLICE_STEPS.min(fitting(LONGEST_SLICE))).max(1);
    }
}

#[allow(clippy::disallowed_methods)] // The clock only sets how long the interpreter is released.
fn now() -> Instant {
    Instant::now()
}
