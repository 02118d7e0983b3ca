//! A uniform grid of cells, filled by counting sort.

use crate::vector::{Vec2, bounds};

/// Particles by cell; within a cell in id order.
#[derive(Debug, Clone, Default)]
pub struct CellGrid {
    origin: Vec2,
    cell_size: f64,
    columns: usize,
    rows: usize,
    /// Cell `c` holds the members `starts[c]..starts[c + 1]`.
    starts: Vec<u32>,
    members: Vec<u32>,
    /// The members' positions: a search reads them in a row.
    places: Vec<Vec2>,
    /// The cell of each particle.
    cells: Vec<u32>,
}

impl CellGrid {
    /// Sorts `positions` into cells at least `size` wide; finite positions and a positive size are the caller's care.
    ///
    /// Where a few particles are far from the rest, the cells grow instead of their number, so that memory stays in
    /// proportion to the particles.
    pub fn fill(&mut self, positions: &[Vec2], size: f64) {
        let Some((low, high)) = bounds(positions) else {
            *self = Self::default();
            return;
        };
        let most = 4 * positions.len() + 16;
        self.origin = low;
        self.cell_size = size;
        loop {
            let columns = (high.x - low.x) / self.cell_size + 1.0;
            let rows = (high.y - low.y) / self.cell_size + 1.0;
            if columns * rows <= most as f64 {
                (self.columns, self.rows) = (columns as usize, rows as usize);
                break;
            }
            self.cell_size *= 2.0;
        }
        self.sort(positions);
    }

    fn sort(&mut self, positions: &[Vec2]) {
        self.starts.clear();
        self.starts.resize(self.columns * self.rows + 1, 0);
        let mut cells = std::mem::take(&mut self.cells);
        cells.clear();
        cells.extend(positions.iter().map(|&position| self.cell_of(position) as u32));
        for &cell in &cells {
            self.starts[cell as usize + 1] += 1;
        }
        for cell in 0..self.columns * self.rows {
            self.starts[cell + 1] += self.starts[cell];
        }
        self.members.resize(positions.len(), 0);
        self.places.resize(positions.len(), Vec2::zeros());
        // Filling from the back turns each cell's end into its start without a second array of cursors.
        for (id, (&cell, &position)) in cells.iter().zip(positions).enumerate().rev() {
            let start = &mut self.starts[cell as usize + 1];
            *start -= 1;
            self.members[*start as usize] = id as u32;
            self.places[*start as usize] = position;
        }
        self.starts.remove(0);
        self.starts.push(positions.len() as u32);
        self.cells = cells;
    }

    fn coordinates(&self, position: Vec2) -> (usize, usize) {
        let column = ((position.x - self.origin.x) / self.cell_size) as usize;
        let row = ((position.y - self.origin.y) / self.cell_size) as usize;
        (column.min(self.columns - 1), row.min(self.rows - 1))
    }

    fn cell_of(&self, position: Vec2) -> usize {
        let (column, row) = self.coordinates(position);
        row * self.columns + column
    }

    /// Calls `visit` with the members of the cell of `position` and of its neighbors and with their positions, as slices
    /// of one row of cells.
    #[inline]
    pub fn for_each_near(&self, position: Vec2, mut visit: impl FnMut(&[u32], &[Vec2])) {
        let (column, row) = self.coordinates(position);
        let (left, right) = (column.saturating_sub(1), (column + 1).min(self.columns - 1));
        for row in row.saturating_sub(1)..=(row + 1).min(self.rows - 1) {
            let start = self.starts[row * self.columns + left] as usize;
            let end = self.starts[row * self.columns + right + 1] as usize;
            visit(&self.members[start..end], &self.places[start..end]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_particle_is_in_its_cell_once_and_in_order() {
        let positions: Vec<Vec2> =
            (0..50).map(|k| Vec2::new(f64::from(k * 7 % 13), f64::from(k * 5 % 11))).collect();
        let mut grid = CellGrid::default();
        grid.fill(&positions, 2.0);
        let mut members = grid.members.clone();
        members.sort_unstable();
        assert_eq!(members, (0..50).collect::<Vec<u32>>());
        for cell in 0..grid.columns * grid.rows {
            let inside = &grid.members[grid.starts[cell] as usize..grid.starts[cell + 1] as usize];
            assert!(inside.is_sorted());
            assert!(inside.iter().all(|&id| grid.cell_of(positions[id as usize]) == cell));
        }
    }

    #[test]
    fn far_particles_do_not_cost_memory() {
        let mut grid = CellGrid::default();
        grid.fill(&[Vec2::zeros(), Vec2::new(1e9, 1e9)], 1e-3);
        assert!(grid.starts.len() < 32);
    }
}
