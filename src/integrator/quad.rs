//! Particles in fours: whole quads of a slice, the rest filled up, the rows of two particles taken apart and put together.

use crate::lanes::{LANES, Lanes};
use crate::physics::vector::Vec2;

/// What comes after the last whole quad, filled up with zeros.
pub(super) fn rest_of<T: Copy + Default>(values: &[T]) -> [T; LANES] {
    let (_, rest) = values.as_chunks::<LANES>();
    let mut padded = [T::default(); LANES];
    padded[..rest.len()].copy_from_slice(rest);
    padded
}

/// Replaces what comes after the last whole quad.
pub(super) fn put_rest<T: Copy>(values: &mut [T], new: &[T; LANES]) {
    let (_, rest) = values.as_chunks_mut::<LANES>();
    rest.copy_from_slice(&new[..rest.len()]);
}

/// Four vectors as two rows: x and y of the first two, then of the last two.
#[inline(always)]
pub(super) fn two_by_two(v: &[Vec2; LANES]) -> [Lanes; 2] {
    [Lanes::new([v[0].x, v[0].y, v[1].x, v[1].y]), Lanes::new([v[2].x, v[2].y, v[3].x, v[3].y])]
}

/// The first halves of two rows in one row, and their last halves; its own inverse.
#[inline(always)]
pub(super) fn halves(one: Lanes, other: Lanes) -> [Lanes; 2] {
    let ([a, b, c, d], [e, f, g, h]) = (one.to_array(), other.to_array());
    [Lanes::new([a, b, e, f]), Lanes::new([c, d, g, h])]
}
