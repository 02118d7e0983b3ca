//! Sums that lose nothing.

use serde::{Deserialize, Serialize};

/// A sum whose rounding errors are kept and added back (Neumaier's compensated summation).
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Sum {
    total: f64,
    lost: f64,
}

impl Sum {
    /// Adds `value`.
    #[inline]
    pub fn add(&mut self, value: f64) {
        let total = self.total + value;
        self.lost += if self.total.abs() >= value.abs() {
            (self.total - total) + value
        } else {
            (value - total) + self.total
        };
        self.total = total;
    }

    /// The sum so far.
    pub fn value(&self) -> f64 {
        self.total + self.lost
    }
}

/// Integrals of four rates by the trapezoid rule: plain sums over the steps since they were last folded, compensated ones
/// before.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Integrals {
    folded: [Sum; 4],
    pending: [f64; 4],
    last: [f64; 4],
}

impl Integrals {
    /// Integrals that begin at these rates.
    pub fn from(rates: [f64; 4]) -> Self {
        Self { last: rates, ..Self::default() }
    }

    /// Goes on by a step of these halved lengths, at whose end the rates are these.
    #[inline]
    pub fn advance(&mut self, rates: [f64; 4], half_steps: [f64; 4]) {
        for k in 0..4 {
            self.pending[k] += (self.last[k] + rates[k]) * half_steps[k];
        }
        self.last = rates;
    }

    /// Brings the sums of the last steps to the others.
    pub fn fold(&mut self) {
        for (sum, pending) in self.folded.iter_mut().zip(&mut self.pending) {
            sum.add(std::mem::take(pending));
        }
    }

    /// One of the integrals, as it was last folded.
    pub fn value(&self, index: usize) -> f64 {
        self.folded[index].value()
    }

    /// The rates at the end of the last step.
    pub fn last(&self) -> [f64; 4] {
        self.last
    }
}
