//! What the physics computes with: one number, or as many at once as a CPU takes.
//!
//! Laws are written once, generic over `Scalar`. Tests use plain `f64`, the engine uses lanes; both go through the same
//! operations in the same order, none fused, so that they agree bit for bit.

use std::fmt::Debug;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// A number, or some of them side by side.
pub trait Scalar:
    Copy
    + Debug
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The answer to a comparison.
    type Mask: Copy
        + Debug
        + BitAnd<Output = Self::Mask>
        + BitOr<Output = Self::Mask>
        + Not<Output = Self::Mask>;

    /// The same number everywhere.
    fn splat(value: f64) -> Self;
    /// Square root.
    #[must_use]
    fn sqrt(self) -> Self;
    /// Magnitude.
    #[must_use]
    fn abs(self) -> Self;
    /// The larger of two; `other` where they are equal or either is not a number.
    #[must_use]
    fn larger(self, other: Self) -> Self;
    /// The smaller of two; `other` where they are equal or either is not a number.
    #[must_use]
    fn smaller(self, other: Self) -> Self;
    /// Where this is greater than `other`.
    fn exceeds(self, other: Self) -> Self::Mask;
    /// Where this equals `other`.
    fn equals(self, other: Self) -> Self::Mask;
    /// `yes` where the mask holds, `no` elsewhere.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// This where the mask holds, 0 elsewhere.
    #[must_use]
    #[inline(always)]
    fn within(self, mask: Self::Mask) -> Self {
        Self::select(mask, self, Self::zero())
    }
    /// Whether a mask holds anywhere.
    fn any(mask: Self::Mask) -> bool;

    /// Zero.
    #[inline(always)]
    fn zero() -> Self {
        Self::splat(0.0)
    }

    /// The number closest to this one within ±`limit`; `limit` is not negative.
    #[must_use]
    #[inline(always)]
    fn clamped(self, limit: Self) -> Self {
        self.larger(-limit).smaller(limit)
    }
}

impl Scalar for f64 {
    type Mask = bool;

    fn splat(value: f64) -> Self {
        value
    }

    fn sqrt(self) -> Self {
        self.sqrt()
    }

    fn abs(self) -> Self {
        self.abs()
    }

    fn larger(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    fn smaller(self, other: Self) -> Self {
        if self < other { self } else { other }
    }

    fn exceeds(self, other: Self) -> bool {
        self > other
    }

    fn equals(self, other: Self) -> bool {
        self == other
    }

    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }

    fn any(mask: bool) -> bool {
        mask
    }
}
