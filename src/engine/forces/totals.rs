//! What the ledger is told of a chunk's contacts: sums by lane over all steps since they were last folded.

use serde::{Deserialize, Serialize};

use crate::engine::simd::{F64x4, LANES, greatest, sum};
use crate::physics::columns::Columns;
use crate::physics::contact::Flows;
use crate::physics::scalar::Scalar;

/// Sums over contacts, lane by lane. They belong to the state: a checkpoint between two samples keeps them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Totals {
    /// Power that contacts take out of the particles, force at the start of a step and at its end added [W/m].
    power: [f64; LANES],
    /// Energy taken, flow by flow [J/m].
    flows: [[f64; LANES]; Flows::NAMES.len()],
    /// Greatest overlap over the smaller radius.
    deepest: [f64; LANES],
}

impl Default for Totals {
    fn default() -> Self {
        Self { power: [0.0; LANES], flows: [[0.0; LANES]; Flows::NAMES.len()], deepest: [0.0; LANES] }
    }
}

/// The same while they are added to.
#[derive(Debug, Clone, Copy)]
pub struct LaneTotals {
    /// Power [W/m].
    pub power: F64x4,
    /// Energy taken [J/m].
    pub flows: Flows<F64x4>,
    /// Greatest depth, in any unit.
    pub deepest: F64x4,
}

/// The sums, as the ledger takes them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FoldedTotals {
    /// Power at the start and at the end of all steps [W/m].
    pub power: f64,
    /// Energy taken [J/m].
    pub flows: Flows<f64>,
    /// Greatest overlap over the smaller radius.
    pub deepest: f64,
}

impl Totals {
    /// To be added to; depths begin anew, as they are in a unit of their own.
    #[inline(always)]
    pub fn open(&self) -> LaneTotals {
        LaneTotals {
            power: F64x4::new(self.power),
            flows: Flows::build(|flow| F64x4::new(self.flows[flow])),
            deepest: F64x4::ZERO,
        }
    }

    /// Keeps them; depths are in units of `unit`.
    #[inline(always)]
    pub fn close(&mut self, totals: &LaneTotals, unit: f64) {
        self.power = totals.power.to_array();
        for (flow, kept) in self.flows.iter_mut().enumerate() {
            *kept = Flows::field(&totals.flows, flow).to_array();
        }
        let ratios = totals.deepest * F64x4::splat(1.0 / unit);
        self.deepest = ratios.larger(F64x4::new(self.deepest)).to_array();
    }

    /// The greatest overlap over the smaller radius.
    pub fn deepest(&self) -> f64 {
        greatest(self.deepest)
    }

    /// The sums over the lanes, in their order; they begin anew.
    pub fn fold(&mut self) -> FoldedTotals {
        let Self { power, flows, .. } = *self;
        let deepest = self.deepest();
        *self = Self::default();
        FoldedTotals { power: sum(power), flows: Flows::build(|flow| sum(flows[flow])), deepest }
    }
}

impl FoldedTotals {
    /// These and others.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            power: self.power + other.power,
            flows: Flows::build(|flow| Flows::field(&self.flows, flow) + Flows::field(&other.flows, flow)),
            deepest: self.deepest.max(other.deepest),
        }
    }
}

impl LaneTotals {
    /// Adds the flows of a set; the others are none.
    #[inline(always)]
    pub fn add_flows(&mut self, set: Flows<bool>, flows: &Flows<F64x4>) {
        self.flows = Flows::build(|flow| {
            let (sum, new) = (Flows::field(&self.flows, flow), Flows::field(flows, flow));
            if Flows::field(&set, flow) { sum + new } else { sum }
        });
    }
}
