//! Rows of four that move up or down by one: how a list of blocks takes a contact in or lets one go.

use super::block::{Block, Ends, TraitsBlock};
use crate::lanes::LANES;

/// Four of something, in order.
pub trait Four {
    /// Those from `lane` on give way to the one after them; the first of `next` comes last.
    fn pull(&mut self, lane: usize, next: &Self);
    /// Those from `lane` on make room for the last of `previous`, or for anybody.
    fn push(&mut self, lane: usize, previous: &Self);
}

impl<T: Copy> Four for [T; LANES] {
    #[inline(always)]
    fn pull(&mut self, lane: usize, next: &Self) {
        self.copy_within(lane + 1.., lane);
        self[LANES - 1] = next[0];
    }

    #[inline(always)]
    fn push(&mut self, lane: usize, previous: &Self) {
        self.copy_within(lane..LANES - 1, lane + 1);
        self[lane] = previous[LANES - 1];
    }
}

/// A block moves as its columns do.
macro_rules! by_columns {
    ($block:ty: $($column:ident),*) => {
        impl Four for $block {
            #[inline(always)]
            fn pull(&mut self, lane: usize, next: &Self) {
                $(self.$column.pull(lane, &next.$column);)*
            }

            #[inline(always)]
            fn push(&mut self, lane: usize, previous: &Self) {
                $(self.$column.push(lane, &previous.$column);)*
            }
        }
    };
}

by_columns!(Ends: owner, other);
by_columns!(Block: overlap, tangential_displacement, normal_force, tangential_force, normal_x, normal_y);
by_columns!(TraitsBlock: damping, own_radius, other_radius, law);

/// Moves all entries after entry `index` up by one; the last one is then anything.
pub fn close_gap<F: Four + Copy>(fours: &mut [F], index: usize) {
    let fours = &mut fours[index / LANES..];
    let (Some(first), Some(&last)) = (fours.first().copied(), fours.last()) else { return };
    let next = fours.get(1).copied().unwrap_or(first);
    with_lane(&mut fours[0], index % LANES, |four, lane| four.pull(lane, &next));
    for four in 1..fours.len() {
        let next = fours.get(four + 1).copied().unwrap_or(last);
        fours[four].pull(0, &next);
    }
}

/// Moves entry `index` and all after it down by one; the last one is lost, and entry `index` is then anything.
pub fn open_gap<F: Four + Copy>(fours: &mut [F], index: usize) {
    let fours = &mut fours[index / LANES..];
    for four in (1..fours.len()).rev() {
        let previous = fours[four - 1];
        fours[four].push(0, &previous);
    }
    if let Some(first) = fours.first_mut() {
        let own = *first;
        with_lane(first, index % LANES, |four, lane| four.push(lane, &own));
    }
}

/// Calls `change` with a lane that the compiler knows, so that it is a few moves.
#[inline(always)]
fn with_lane<F>(four: &mut F, lane: usize, change: impl Fn(&mut F, usize)) {
    match lane {
        0 => change(four, 0),
        1 => change(four, 1),
        2 => change(four, 2),
        _ => change(four, 3),
    }
}
