//! Memory order: particles near each other in the drum belong near each other in memory.
//!
//! A contact then finds both its bodies in the cache, and nearly all contacts stay within one chunk of particles.
//! Memory order is state, and the order of every sum. It changes at fixed step numbers only, from what a checkpoint
//! holds, so that neither threads, nor lists, nor a restart can show in a result.

use crate::engine::parallel::CHUNK;
use crate::physics::vector::{Vec2, bounds};

/// Loads of fewer particles keep the order of their ids: they fit into the cache.
pub const LEAST_COUNT: usize = 4 * CHUNK;

/// Steps between two sorts, within which neighbors do not part by more than a few diameters.
pub const INTERVAL: u64 = 8192;

/// Whether `count` particles are sorted before the step that follows step `step`.
pub fn is_due(count: usize, step: u64) -> bool {
    count >= LEAST_COUNT && step.is_multiple_of(INTERVAL)
}

/// The particles in the order in which Hilbert's curve meets them.
pub fn hilbert_order(positions: &[Vec2]) -> Vec<u32> {
    let Some((low, high)) = bounds(positions) else { return Vec::new() };
    let scale = f64::from(SIDE - 1) / (high.x - low.x).max(high.y - low.y);
    let key = |position: &Vec2| {
        let place = (position - low) * scale;
        u64::from(curve_index(place.x as u32, place.y as u32))
    };
    // Particles of one cell, and those that are not anywhere, stay in the order in which they are.
    let mut keyed: Vec<u64> =
        positions.iter().enumerate().map(|(i, position)| key(position) << 32 | i as u64).collect();
    keyed.sort_unstable();
    keyed.into_iter().map(|key| key as u32).collect()
}

/// Where each particle is, once particle `order[k]` is at place `k`.
pub fn places(order: &[u32]) -> Vec<u32> {
    let mut places = vec![0; order.len()];
    (0..).zip(order).for_each(|(place, &particle)| places[particle as usize] = place);
    places
}

/// Cells along a side of the square that the curve fills: fine enough for 10⁸ particles.
const SIDE: u32 = 1 << 16;

/// How many cells Hilbert's curve passes before it comes to the cell (x, y).
fn curve_index(mut x: u32, mut y: u32) -> u32 {
    let mut index = 0;
    let mut half = SIDE / 2;
    while half > 0 {
        let (right, upper) = (u32::from(x & half > 0), u32::from(y & half > 0));
        index += half * half * ((3 * right) ^ upper);
        if upper == 0 {
            if right == 1 {
                (x, y) = (SIDE - 1 - x, SIDE - 1 - y);
            }
            (x, y) = (y, x);
        }
        half /= 2;
    }
    index
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbors_along_the_curve_are_neighbors_in_the_plane() {
        // The corner of 64 × 64 cells where the curve begins.
        let mut cells: Vec<(u32, i64, i64)> = (0..64 * 64)
            .map(|cell| (curve_index(cell % 64, cell / 64), i64::from(cell % 64), i64::from(cell / 64)))
            .collect();
        cells.sort_unstable();
        for (index, cell) in cells.iter().enumerate() {
            assert_eq!(cell.0, index as u32);
        }
        assert!(cells.windows(2).all(|two| (two[0].1 - two[1].1).abs() + (two[0].2 - two[1].2).abs() == 1));
    }
}
