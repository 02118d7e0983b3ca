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
    let mut lane = index % LANES;
    for four in 0..fours.len() {
        let next = fours[(four + 1).min(fours.len() - 1)];
        if lane > 0 {
            fours[four].pull(lane, &next);
        } else {
            // Nearly all are moved whole, by constant lanes.
            fours[four].pull(0, &next);
        }
        lane = 0;
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
        first.push(index % LANES, &own);
    }
}
