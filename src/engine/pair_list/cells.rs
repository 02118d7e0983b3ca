//! A uniform grid of cells, filled by counting sort.

use crate::engine::parallel::Threads;
use crate::physics::vector::Vec2;

/// Particles by cell; within a cell in memory order. A border of empty cells spares looking at bounds.
#[derive(Debug, Clone, Default)]
pub struct CellGrid {
    origin: Vec2,
    inverse_size: f64,
    columns: usize,
    rows: usize,
    /// Cell `c` holds the members `starts[c]..starts[c + 1]`.
    starts: Vec<u32>,
    /// The members, with their positions at hand.
    members: Vec<(u32, Vec2)>,
    /// The cell of each particle.
    cells: Vec<u32>,
}

impl CellGrid {
    /// Sorts `positions`, which are within the corners (left and low, right and high), into cells wider than `size` by more
    /// than round-off; finite positions and a positive size are the caller's care.
    ///
    /// Where a few particles are far from the rest, the cells grow instead of their number, so that memory stays in
    /// proportion to the particles.
    pub fn fill(&mut self, positions: &[Vec2], (low, high): (Vec2, Vec2), size: f64, threads: &Threads) {
        let most = 4 * positions.len() + 16;
        let mut size = size * (1.0 + 1e-6);
        let (columns, rows) = loop {
            let (columns, rows) = ((high.x - low.x) / size + BORDER, (high.y - low.y) / size + BORDER);
            if columns * rows <= most as f64 {
                break (columns, rows);
            }
            size *= 2.0;
        };
        (self.columns, self.rows) = (columns as usize, rows as usize);
        (self.origin, self.inverse_size) = (low, 1.0 / size);
        let mut cells = std::mem::take(&mut self.cells);
        cells.resize(positions.len(), 0);
        threads.set_each(&mut cells, |i| self.cell_of(positions[i]));
        self.cells = cells;
        self.sort(positions);
    }

    fn sort(&mut self, positions: &[Vec2]) {
        self.starts.clear();
        self.starts.resize(self.columns * self.rows + 1, 0);
        for &cell in &self.cells {
            self.starts[cell as usize + 1] += 1;
        }
        for cell in 0..self.columns * self.rows {
            self.starts[cell + 1] += self.starts[cell];
        }
        self.members.resize(positions.len(), (0, Vec2::zeros()));
        // Filling from the back turns each cell's end into its start without a second array of cursors.
        for (particle, (&cell, &position)) in self.cells.iter().zip(positions).enumerate().rev() {
            let start = &mut self.starts[cell as usize + 1];
            *start -= 1;
            self.members[*start as usize] = (particle as u32, position);
        }
        self.starts.remove(0);
        self.starts.push(positions.len() as u32);
    }

    fn cell_of(&self, position: Vec2) -> u32 {
        let place = (position - self.origin) * self.inverse_size;
        (place.y as u32 + 1) * self.columns as u32 + place.x as u32 + 1
    }

    /// The members of the cell of a particle and of the cells around it.
    #[inline]
    pub fn around(&self, particle: usize) -> impl Iterator<Item = &(u32, Vec2)> {
        let cell = self.cells[particle] as usize;
        let rows = [cell - self.columns, cell, cell + self.columns];
        let members = |middle: usize| self.starts[middle - 1] as usize..self.starts[middle + 2] as usize;
        rows.into_iter().flat_map(move |middle| &self.members[members(middle)])
    }
}

/// Columns or rows beyond those that the extent of the particles fills: the last one that they begin, and one on each side.
const BORDER: f64 = 3.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_particle_is_in_its_cell_once_and_in_order() {
        let positions: Vec<Vec2> =
            (0..50).map(|k| Vec2::new(f64::from(k * 7 % 13), f64::from(k * 5 % 11))).collect();
        let mut grid = CellGrid::default();
        let bounds = (Vec2::zeros(), Vec2::new(12.0, 10.0));
        grid.fill(&positions, bounds, 2.0, &Threads::new(1).unwrap());
        let mut members: Vec<u32> = grid.members.iter().map(|member| member.0).collect();
        members.sort_unstable();
        assert_eq!(members, (0..50).collect::<Vec<u32>>());
        for cell in 0..grid.columns * grid.rows {
            let inside = &grid.members[grid.starts[cell] as usize..grid.starts[cell + 1] as usize];
            let (row, column) = (cell / grid.columns, cell % grid.columns);
            let at_border = [0, grid.rows - 1].contains(&row) || [0, grid.columns - 1].contains(&column);
            assert!(inside.is_sorted_by_key(|member| member.0) && (inside.is_empty() || !at_border));
            assert!(inside.iter().all(|&(_, position)| grid.cell_of(position) as usize == cell));
        }
        for (i, one) in positions.iter().enumerate() {
            let near = |j: usize| (positions[j] - one).norm() < 2.0;
            assert!((0..50).filter(|&j| near(j)).all(|j| grid.around(i).any(|member| member.0 == j as u32)));
        }
    }

    #[test]
    fn far_particles_do_not_cost_memory() {
        let mut grid = CellGrid::default();
        let far = Vec2::new(1e9, 1e9);
        grid.fill(&[Vec2::zeros(), far], (Vec2::zeros(), far), 1e-3, &Threads::new(1).unwrap());
        assert!(grid.starts.len() < 32);
    }
}
