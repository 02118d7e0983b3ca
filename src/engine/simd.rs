//! Four numbers at a time.
//!
//! A lane goes through the same operations, rounded in the same way, as a number alone would; nothing is reordered or
//! fused. So the number of lanes, and the CPU, never show in a result.

use wide::f64x2;
pub use wide::f64x4 as F64x4;

use crate::physics::scalar::Scalar;

/// Numbers per `F64x4`.
pub const LANES: usize = 4;

/// The bits of a mask that holds in every lane.
pub const ALL_LANES: u32 = (1 << LANES) - 1;

impl Scalar for F64x4 {
    type Mask = F64x4;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        F64x4::splat(value)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        self.fast_max(other)
    }

    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        self.fast_min(other)
    }

    #[inline(always)]
    fn exceeds(self, other: Self) -> F64x4 {
        self.simd_gt(other)
    }

    #[inline(always)]
    fn equals(self, other: Self) -> F64x4 {
        self.simd_eq(other)
    }

    #[inline(always)]
    fn select(mask: F64x4, yes: Self, no: Self) -> Self {
        mask.select(yes, no)
    }

    #[inline(always)]
    fn any(mask: F64x4) -> bool {
        mask.any()
    }
}

/// The sum of the lanes, in their order.
#[inline(always)]
pub fn sum(lanes: [f64; LANES]) -> f64 {
    let [a, b, c, d] = lanes;
    ((a + b) + c) + d
}

/// The greatest lane.
#[inline(always)]
pub fn greatest(lanes: [f64; LANES]) -> f64 {
    lanes.into_iter().fold(f64::NEG_INFINITY, f64::max)
}

/// Four vectors.
#[derive(Debug, Clone, Copy, Default)]
pub struct Vec2x4 {
    /// Their x.
    pub x: F64x4,
    /// Their y.
    pub y: F64x4,
}

impl Vec2x4 {
    /// From rows of two vectors each: those of lanes 0 and 2, those of lanes 1 and 3.
    #[inline(always)]
    pub fn from_rows([even, odd]: [F64x4; 2]) -> Self {
        let ([a, b, c, d], [e, f, g, h]) = (even.to_array(), odd.to_array());
        Self { x: F64x4::new([a, e, c, g]), y: F64x4::new([b, f, d, h]) }
    }

    /// One by one.
    #[inline(always)]
    pub fn to_array(self) -> [f64x2; LANES] {
        let ([a, b, c, d], [e, f, g, h]) = (self.x.to_array(), self.y.to_array());
        [f64x2::new([a, e]), f64x2::new([b, f]), f64x2::new([c, g]), f64x2::new([d, h])]
    }

    /// Scalar products.
    #[inline(always)]
    pub fn dot(self, other: Self) -> F64x4 {
        self.x * other.x + self.y * other.y
    }

    /// The z components of the cross products.
    #[inline(always)]
    pub fn cross(self, other: Self) -> F64x4 {
        self.x * other.y - self.y * other.x
    }

    /// Each times a number.
    #[must_use]
    #[inline(always)]
    pub fn scaled(self, factor: F64x4) -> Self {
        Self { x: self.x * factor, y: self.y * factor }
    }

    /// Sums.
    #[must_use]
    #[inline(always)]
    pub fn plus(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y }
    }
}

/// Four vectors in the rows that `Vec2x4::from_rows` takes.
#[inline(always)]
fn rows(vector: impl Fn(usize) -> [f64; 2]) -> [F64x4; 2] {
    let row = |one: usize, other: usize| {
        let ([a, b], [c, d]) = (vector(one), vector(other));
        F64x4::new([a, b, c, d])
    };
    [row(0, 2), row(1, 3)]
}

/// Four vectors.
#[inline(always)]
pub fn vectors(vector: impl Fn(usize) -> [f64; 2]) -> Vec2x4 {
    Vec2x4::from_rows(rows(vector))
}

/// What four vectors have that four others have not: b − a.
#[inline(always)]
pub fn differences(a: impl Fn(usize) -> [f64; 2], b: impl Fn(usize) -> [f64; 2]) -> Vec2x4 {
    let ([even, odd], [other_even, other_odd]) = (rows(a), rows(b));
    Vec2x4::from_rows([other_even - even, other_odd - odd])
}

/// A number for each lane.
#[inline(always)]
pub fn lanes(number: impl Fn(usize) -> f64) -> F64x4 {
    F64x4::new([number(0), number(1), number(2), number(3)])
}
