//! Discs of any sizes, by the cells of a square grid that they reach into.

use crate::physics::vector::Vec2;

/// Each disc is listed in every cell that its bounding box touches, so discs that overlap share a cell, whatever their
/// sizes: a large one is in many cells, but no small one has to look far for it.
pub(super) struct Grid {
    half: f64,
    width: f64,
    across: usize,
    cells: Vec<Vec<u32>>,
}

impl Grid {
    /// An empty grid over the square |x|, |y| ≤ `half` for `count` discs, of cells about as wide as `diameter` [m], but of no
    /// more cells than suit the count.
    pub(super) fn new(half: f64, diameter: f64, count: usize) -> Self {
        let width = diameter.max(2.0 * half / (count as f64).sqrt());
        let across = (2.0 * half / width) as usize + 1;
        Self { half, width, across, cells: vec![Vec::new(); across * across] }
    }

    /// Forgets all discs, keeping the memory.
    pub(super) fn clear(&mut self) {
        self.cells.iter_mut().for_each(Vec::clear);
    }

    /// Adds a disc.
    pub(super) fn push(&mut self, disc: u32, center: Vec2, radius: f64) {
        for cell in self.touched(center, radius) {
            self.cells[cell].push(disc);
        }
    }

    /// The discs that may overlap one here; some of them more than once.
    pub(super) fn near(&self, center: Vec2, radius: f64) -> impl Iterator<Item = u32> {
        self.touched(center, radius).flat_map(|cell| self.cells[cell].iter().copied())
    }

    /// Every two discs that may overlap, the later one first; some of them more than once.
    pub(super) fn pairs(&self) -> impl Iterator<Item = (u32, u32)> {
        self.cells.iter().flat_map(|cell| {
            let earlier = cell.iter().enumerate();
            earlier.flat_map(|(count, &later)| cell[..count].iter().map(move |&one| (later, one)))
        })
    }

    /// The cells that the box round a disc touches. What is outside of the square counts to its border.
    fn touched(&self, center: Vec2, radius: f64) -> impl Iterator<Item = usize> + use<> {
        let (across, half, width) = (self.across, self.half, self.width);
        let place = move |x: f64| (((x + half) / width) as usize).min(across - 1);
        let [columns, rows] = [center.x, center.y].map(|x| place(x - radius)..=place(x + radius));
        rows.flat_map(move |row| columns.clone().map(move |column| row * across + column))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Discs of radii from 0.01 to 0.3 in a grid of cells 0.1 wide.
    #[test]
    fn discs_that_overlap_share_a_cell() {
        let number = |index: u32, factor: f64| (f64::from(index) * factor).fract();
        let disc = |index| {
            let center =
                Vec2::new(2.0 * number(index, 0.754_877_7) - 1.0, 2.0 * number(index, 0.569_840_3) - 1.0);
            (center, if index % 8 == 0 { 0.3 } else { 0.01 + 0.05 * number(index, 0.618_034) })
        };
        let mut grid = Grid::new(1.0, 0.1, 400);
        (0..200).for_each(|index| grid.push(index, disc(index).0, disc(index).1));
        let pairs: Vec<(u32, u32)> = grid.pairs().collect();
        let mut overlapping = 0;
        for later in 0..200 {
            for one in 0..later {
                let [(a, r), (b, s)] = [disc(one), disc(later)];
                if (a - b).norm() < r + s {
                    overlapping += 1;
                    assert!(pairs.contains(&(later, one)) && grid.near(a, r).any(|near| near == later));
                }
            }
        }
        assert!(overlapping > 100 && pairs.len() < 200 * 199 / 4, "{overlapping} in {} pairs", pairs.len());
    }
}
