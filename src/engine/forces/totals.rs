//! What the ledger is told of a chunk's contacts: sums by lane over all steps since they were last folded.

use std::ops::Add;

use serde::{Deserialize, Serialize};

use crate::engine::simd::{F64x4, LANES, greatest, sum};
use crate::physics::columns::{Columns, Field};
use crate::physics::contact::Flows;
use crate::physics::contact::gross_work::GrossWork;
use crate::physics::scalar::Scalar;

/// Sums over contacts: kept lane by lane, added to in registers, folded to numbers. They belong to the state: a checkpoint
/// between two samples keeps them.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Totals<T = [f64; LANES]> {
    /// Power that contacts take out of the particles, force at the start of a step and at its end added [W/m].
    pub power: T,
    /// Energy taken, flow by flow [J/m].
    pub flows: Flows<T>,
    /// Gross work, 0 where it is not recorded [J/m].
    pub gross_work: GrossWork<T>,
    /// Greatest overlap over the smaller radius.
    pub deepest: T,
}

impl<T: Field> Totals<T> {
    #[inline(always)]
    fn map<U: Field>(&self, convert: impl Fn(T) -> U) -> Totals<U> {
        Totals {
            power: convert(self.power),
            flows: Flows::map(&self.flows, &convert),
            gross_work: GrossWork::map(&self.gross_work, &convert),
            deepest: convert(self.deepest),
        }
    }
}

impl Totals {
    /// To be added to by contacts, but for gross work; depths begin anew, as they are in a unit of their own.
    #[inline(always)]
    pub fn open(&self) -> Totals<F64x4> {
        Totals {
            power: F64x4::new(self.power),
            flows: Flows::map(&self.flows, F64x4::new),
            gross_work: GrossWork::build(|_| F64x4::ZERO),
            deepest: F64x4::ZERO,
        }
    }

    /// Keeps them, but for gross work; depths are in units of `unit`.
    #[inline(always)]
    pub fn close(&mut self, totals: &Totals<F64x4>, unit: f64) {
        let ratios = totals.deepest * F64x4::splat(1.0 / unit);
        self.deepest = ratios.larger(F64x4::new(self.deepest)).to_array();
        self.power = totals.power.to_array();
        self.flows = Flows::map(&totals.flows, F64x4::to_array);
    }

    /// The greatest overlap over the smaller radius.
    pub fn deepest(&self) -> f64 {
        greatest(self.deepest)
    }

    /// The sums over the lanes, in their order; they begin anew.
    pub fn fold(&mut self) -> Totals<f64> {
        let deepest = self.deepest();
        Totals { deepest, ..std::mem::take(self).map(sum) }
    }
}

impl Totals<f64> {
    /// These and others.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            power: self.power + other.power,
            flows: Flows::zip(&self.flows, &other.flows, f64::add),
            gross_work: GrossWork::zip(&self.gross_work, &other.gross_work, f64::add),
            deepest: self.deepest.max(other.deepest),
        }
    }
}

impl Totals<F64x4> {
    /// Adds the flows of a set; the others are none.
    #[inline(always)]
    pub fn add_flows(&mut self, set: Flows<bool>, flows: &Flows<F64x4>) {
        self.flows = Flows::build(|flow| {
            let (sum, new) = (Flows::field(&self.flows, flow), Flows::field(flows, flow));
            if Flows::field(&set, flow) { sum + new } else { sum }
        });
    }
}
