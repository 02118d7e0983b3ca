//! A uniform grid of cells, filled by counting sort.

use crate::lanes::LANES;
use crate::vector::{Vec2, bounds};

/// Particles by cell; within a cell in id order. A rim of empty cells spares those inside the bounds.
#[derive(Debug, Clone, Default)]
pub struct CellGrid {
    origin: Vec2,
    inverse_size: f64,
    columns: usize,
    rows: usize,
    /// Cell `c` holds the members `starts[c]..starts[c + 1]`.
    starts: Vec<u32>,
    /// The members and their positions: a search reads four in a row, which may be past the last one.
    members: Vec<u32>,
    x: Vec<f64>,
    y: Vec<f64>,
    /// The cell of each particle.
    cells: Vec<u32>,
}

/// The members of some cells in a row, four at a time.
#[derive(Debug, Clone, Copy)]
pub struct Fours<'a> {
    /// The place of the first.
    pub first: usize,
    /// How many there are; what comes after the last means nothing.
    pub count: usize,
    /// The particles.
    pub members: &'a [[u32; LANES]],
    /// Their positions.
    pub x: &'a [[f64; LANES]],
    /// The same.
    pub y: &'a [[f64; LANES]],
}

impl CellGrid {
    /// Sorts `positions` into cells wider than `size` by more than round-off; finite positions and a positive size are the
    /// caller's care.
    ///
    /// Where a few particles are far from the rest, the cells grow instead of their number, so that memory stays in
    /// proportion to the particles.
    pub fn fill(&mut self, positions: &[Vec2], size: f64) {
        let Some((low, high)) = bounds(positions) else {
            *self = Self::default();
            return;
        };
        let most = 4 * positions.len() + 16;
        let mut size = size * (1.0 + 1e-6);
        let (columns, rows) = loop {
            let (columns, rows) = ((high.x - low.x) / size + RIM, (high.y - low.y) / size + RIM);
            if columns * rows <= most as f64 {
                break (columns, rows);
            }
            size *= 2.0;
        };
        (self.columns, self.rows) = (columns as usize, rows as usize);
        (self.origin, self.inverse_size) = (low, 1.0 / size);
        self.sort(positions);
    }

    fn sort(&mut self, positions: &[Vec2]) {
        self.starts.clear();
        self.starts.resize(self.columns * self.rows + 1, 0);
        let mut cells = std::mem::take(&mut self.cells);
        cells.clear();
        cells.extend(positions.iter().map(|&position| self.cell_of(position)));
        for &cell in &cells {
            self.starts[cell as usize + 1] += 1;
        }
        for cell in 0..self.columns * self.rows {
            self.starts[cell + 1] += self.starts[cell];
        }
        self.members.resize(positions.len() + LANES, 0);
        self.x.resize(positions.len() + LANES, 0.0);
        self.y.resize(positions.len() + LANES, 0.0);
        // Filling from the back turns each cell's end into its start without a second array of cursors.
        for (id, (&cell, &position)) in cells.iter().zip(positions).enumerate().rev() {
            let start = &mut self.starts[cell as usize + 1];
            *start -= 1;
            let place = *start as usize;
            self.members[place] = id as u32;
            (self.x[place], self.y[place]) = (position.x, position.y);
        }
        self.starts.remove(0);
        self.starts.push(positions.len() as u32);
        self.cells = cells;
    }

    fn cell_of(&self, position: Vec2) -> u32 {
        let place = (position - self.origin) * self.inverse_size;
        (place.y as u32 + 1) * self.columns as u32 + place.x as u32 + 1
    }

    /// The particles in their places, cell by cell.
    pub fn members(&self) -> &[u32] {
        &self.members
    }

    /// Calls `visit` with the members of the cell of a particle and of its neighbors, row of cells by row.
    #[inline]
    pub fn for_each_near(&self, particle: usize, mut visit: impl FnMut(Fours)) {
        let cell = self.cells[particle] as usize;
        for row in [cell - self.columns, cell, cell + self.columns] {
            let (start, end) = (self.starts[row - 1] as usize, self.starts[row + 2] as usize);
            let fours = start..start + (end - start).next_multiple_of(LANES);
            visit(Fours {
                first: start,
                count: end - start,
                members: self.members[fours.clone()].as_chunks().0,
                x: self.x[fours.clone()].as_chunks().0,
                y: self.y[fours].as_chunks().0,
            });
        }
    }
}

/// Columns or rows beyond those that the extent of the particles fills: the last one that they begin, and one on each side.
const RIM: f64 = 3.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_particle_is_in_its_cell_once_and_in_order() {
        let positions: Vec<Vec2> =
            (0..50).map(|k| Vec2::new(f64::from(k * 7 % 13), f64::from(k * 5 % 11))).collect();
        let mut grid = CellGrid::default();
        grid.fill(&positions, 2.0);
        let mut members = grid.members[..50].to_vec();
        members.sort_unstable();
        assert_eq!(members, (0..50).collect::<Vec<u32>>());
        for cell in 0..grid.columns * grid.rows {
            let inside = &grid.members[grid.starts[cell] as usize..grid.starts[cell + 1] as usize];
            let (row, column) = (cell / grid.columns, cell % grid.columns);
            let at_rim = [0, grid.rows - 1].contains(&row) || [0, grid.columns - 1].contains(&column);
            assert!(inside.is_sorted() && (inside.is_empty() || !at_rim));
            assert!(inside.iter().all(|&id| grid.cell_of(positions[id as usize]) as usize == cell));
        }
    }

    #[test]
    fn far_particles_do_not_cost_memory() {
        let mut grid = CellGrid::default();
        grid.fill(&[Vec2::zeros(), Vec2::new(1e9, 1e9)], 1e-3);
        assert!(grid.starts.len() < 32);
    }
}
