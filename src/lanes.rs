//! Four numbers at a time: the hot loop works on four contacts at once.
//!
//! A lane goes through the same operations, rounded in the same way, as a number alone would; nothing is reordered or
//! fused. So the number of lanes, and the CPU, never show in a result.

use std::ops::{Add, Mul, Neg, Sub};

use wide::{f32x8, f64x4, u32x8};

use crate::physics::vector::Vec2;

/// Four numbers.
pub type Lanes = f64x4;

/// Numbers per `Lanes`.
pub const LANES: usize = 4;

/// Eight numbers of half the size, where that is precise enough.
pub type Row = f32x8;

/// Numbers per `Row`.
pub const ROW: usize = 8;

/// As many whole numbers.
pub type WholeRow = u32x8;

/// For each set of eight lanes, as bits: its lanes in front, in their order.
pub const EIGHT_IN_FRONT: [[u32; ROW]; 1 << ROW] = {
    let mut table = [[0; ROW]; 1 << ROW];
    let mut set = 0;
    while set < table.len() {
        let (mut lane, mut count) = (0, 0);
        while lane < ROW {
            if set >> lane & 1 == 1 {
                table[set][count] = lane as u32;
                count += 1;
            }
            lane += 1;
        }
        set += 1;
    }
    table
};

/// The numbers in the lanes of a set, given as bits, in front, in their order; what comes after them means nothing.
#[inline(always)]
pub fn in_front(numbers: WholeRow, set: usize) -> WholeRow {
    let lanes = EIGHT_IN_FRONT[set & (EIGHT_IN_FRONT.len() - 1)];
    #[cfg(target_feature = "avx2")]
    {
        use safe_arch::{m256i, shuffle_av_i32_all_m256i};
        let moved = shuffle_av_i32_all_m256i(m256i::from(numbers.to_array()), m256i::from(lanes));
        WholeRow::new(moved.into())
    }
    #[cfg(not(target_feature = "avx2"))]
    {
        let numbers = numbers.to_array();
        WholeRow::new(lanes.map(|lane| numbers[lane as usize]))
    }
}

/// Aligns the stack of the function that calls it, where compilers would spill rows of numbers at any multiple of 16 bytes:
/// as the system happens to place the stack, every second one could then lie across two lines of the cache.
#[inline(always)]
pub fn align_stack() {
    std::hint::black_box(&mut Lanes::splat(0.0));
}

/// A number for each index.
#[inline(always)]
pub fn lanes(number: impl Fn(usize) -> f64) -> Lanes {
    Lanes::new([number(0), number(1), number(2), number(3)])
}

/// Rows to columns: entry `k` of row `l` becomes entry `l` of row `k`.
#[inline(always)]
pub fn transpose(rows: [Lanes; LANES]) -> [Lanes; LANES] {
    Lanes::transpose(rows)
}

/// Four vectors.
#[derive(Debug, Clone, Copy)]
pub struct Vec2Lanes {
    /// Their x.
    pub x: Lanes,
    /// Their y.
    pub y: Lanes,
}

impl Vec2Lanes {
    /// A vector for each index.
    #[inline(always)]
    pub fn new(vector: impl Fn(usize) -> Vec2) -> Self {
        let vectors = [vector(0), vector(1), vector(2), vector(3)];
        Self { x: lanes(|lane| vectors[lane].x), y: lanes(|lane| vectors[lane].y) }
    }

    /// Scalar products.
    #[inline(always)]
    pub fn dot(self, other: Self) -> Lanes {
        self.x * other.x + self.y * other.y
    }

    /// Turned by +90°.
    #[must_use]
    #[inline(always)]
    pub fn perpendicular(self) -> Self {
        Self { x: -self.y, y: self.x }
    }

    /// The vectors, one by one.
    #[inline(always)]
    pub fn to_array(self) -> [Vec2; LANES] {
        let (x, y) = (self.x.to_array(), self.y.to_array());
        std::array::from_fn(|lane| Vec2::new(x[lane], y[lane]))
    }
}

impl Add for Vec2Lanes {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y }
    }
}

impl Sub for Vec2Lanes {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y }
    }
}

impl Neg for Vec2Lanes {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y }
    }
}

impl Mul<Lanes> for Vec2Lanes {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: Lanes) -> Self {
        Self { x: self.x * factor, y: self.y * factor }
    }
}
