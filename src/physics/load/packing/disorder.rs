//! What makes a bed random: insertion at random points, and random moves of discs that sit on a pattern.

use rand::Rng;

use super::cells::Cells;
use super::draws::{below, in_square};
use super::{Room, tries};
use crate::physics::vector::Vec2;

/// Moves of a shuffle, in all, and the limits of the sweeps that this means.
const MOVES: usize = 10_000_000;
const SWEEPS: (usize, usize) = (20, 2000);

/// Inserts discs one by one wherever a random point has room for one; `None` if that stalls.
pub(super) fn insert(room: &Room, count: usize, random: &mut impl Rng) -> Option<Cells> {
    let mut bed = Cells::new(room.reach, room.spacing, count);
    for _ in 0..tries(count) {
        let center = in_square(room.reach, random);
        // The solids come last: their distance may cost more than everything else.
        if room.bounds(center) && bed.is_free(center, None) && room.admits(center) {
            bed.push(center);
            if bed.len() == count {
                return Some(bed);
            }
        }
    }
    None
}

/// Puts `count` discs on sites chosen at random, then shuffles them by random moves that never make an overlap.
///
/// Up to some thousand discs the bed forgets its pattern wherever it is loose enough to; larger ones, of fewer
/// sweeps, keep a part of its order.
pub(super) fn shuffled(room: &Room, sites: &[Vec2], count: usize, random: &mut impl Rng) -> Cells {
    let mut bed = Cells::new(room.reach, room.spacing, count);
    // Taken in the order of the pattern, neighbors stay near each other in memory.
    for (index, site) in sites.iter().enumerate() {
        if below(sites.len() - index, random) < count - bed.len() {
            bed.push(*site);
        }
    }
    let mut length = 0.25 * room.spacing;
    for _ in 0..(MOVES / count).clamp(SWEEPS.0, SWEEPS.1) {
        let moved = sweep(room, &mut bed, length, random);
        // Moves of which about half are possible carry farthest.
        let factor = if 2 * moved > count { 1.1 } else { 0.9 };
        length = (length * factor).min(room.spacing);
    }
    bed
}

/// Tries to move every disc once by at most `length` along x and y; tells how many moved.
fn sweep(room: &Room, bed: &mut Cells, length: f64, random: &mut impl Rng) -> usize {
    let mut moved = 0;
    for disc in 0..bed.len() {
        let center = bed.center(disc) + in_square(length, random);
        if room.bounds(center) && bed.is_free(center, Some(disc)) && room.admits(center) {
            bed.relocate(disc, center);
            moved += 1;
        }
    }
    moved
}
