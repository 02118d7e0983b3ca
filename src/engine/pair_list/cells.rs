//! A uniform grid of cells, filled by counting sort.

use crate::engine::parallel::Threads;
use crate::physics::vector::Vec2;

/// Particles by cell; within a cell in memory order.
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
    /// The cell of each member, in the order in which they were given.
    cells: Vec<u32>,
}

impl CellGrid {
    /// Sorts some particles, which are within the corners (left and low, right and high), into cells of this size [m];
    /// finite positions and a positive size are the caller's care.
    ///
    /// Where a few particles are far from the rest, the cells grow instead of their number, so that memory stays in
    /// proportion to the particles.
    pub fn fill(
        &mut self,
        particles: &[u32],
        positions: &[Vec2],
        (low, high): (Vec2, Vec2),
        mut size: f64,
        threads: &Threads,
    ) {
        let most = 4 * particles.len() + 16;
        let (columns, rows) = loop {
            let (columns, rows) = ((high.x - low.x) / size + 1.0, (high.y - low.y) / size + 1.0);
            if columns * rows <= most as f64 {
                break (columns, rows);
            }
            size *= 2.0;
        };
        (self.columns, self.rows) = (columns as usize, rows as usize);
        (self.origin, self.inverse_size) = (low, 1.0 / size);
        let mut cells = std::mem::take(&mut self.cells);
        cells.resize(particles.len(), 0);
        threads.set_each(&mut cells, |i| {
            let [column, row] = self.place(positions[particles[i] as usize]);
            (row * self.columns + column) as u32
        });
        self.cells = cells;
        self.sort(particles, positions);
    }

    fn sort(&mut self, particles: &[u32], positions: &[Vec2]) {
        self.starts.clear();
        self.starts.resize(self.columns * self.rows + 1, 0);
        for &cell in &self.cells {
            self.starts[cell as usize + 1] += 1;
        }
        for cell in 0..self.columns * self.rows {
            self.starts[cell + 1] += self.starts[cell];
        }
        self.members.resize(particles.len(), (0, Vec2::zeros()));
        // Filling from the back turns each cell's end into its start without a second array of cursors.
        for (&cell, &particle) in self.cells.iter().zip(particles).rev() {
            let start = &mut self.starts[cell as usize + 1];
            *start -= 1;
            self.members[*start as usize] = (particle, positions[particle as usize]);
        }
        self.starts.remove(0);
        self.starts.push(particles.len() as u32);
    }

    /// Column and row of a position; of one outside, the nearest ones.
    fn place(&self, position: Vec2) -> [usize; 2] {
        let place = (position - self.origin) * self.inverse_size;
        [(place.x as usize).min(self.columns - 1), (place.y as usize).min(self.rows - 1)]
    }

    /// The members within `reach` [m] of a position along x and y, and others of the same cells.
    #[inline]
    pub fn around(&self, position: Vec2, reach: f64) -> impl Iterator<Item = &(u32, Vec2)> {
        // Wider by more than round-off.
        let reach = Vec2::repeat(reach * (1.0 + 1e-6));
        let [[left, low], [right, high]] = [self.place(position - reach), self.place(position + reach)];
        let members = move |row: usize| {
            let first = row * self.columns;
            self.starts[first + left] as usize..self.starts[first + right + 1] as usize
        };
        (low..=high).flat_map(move |row| &self.members[members(row)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_particle_is_in_its_cell_once_and_in_order() {
        let positions: Vec<Vec2> =
            (0..50).map(|k| Vec2::new(f64::from(k * 7 % 13), f64::from(k * 5 % 11))).collect();
        let some: Vec<u32> = (0..50).filter(|k| k % 3 > 0).collect();
        let mut grid = CellGrid::default();
        let bounds = (Vec2::zeros(), Vec2::new(12.0, 10.0));
        grid.fill(&some, &positions, bounds, 2.0, &Threads::new(1).unwrap());
        let mut members: Vec<u32> = grid.members.iter().map(|member| member.0).collect();
        members.sort_unstable();
        assert_eq!(members, some);
        for cell in 0..grid.columns * grid.rows {
            let inside = &grid.members[grid.starts[cell] as usize..grid.starts[cell + 1] as usize];
            assert!(inside.is_sorted_by_key(|member| member.0));
            let place = [cell % grid.columns, cell / grid.columns];
            assert!(inside.iter().all(|&(_, position)| grid.place(position) == place));
        }
        for reach in [0.5, 2.0, 5.0] {
            for one in &positions {
                let is_near = |j: &&u32| (positions[**j as usize] - one).norm() < reach;
                let is_found =
                    |j: &u32| grid.around(*one, reach).filter(|member| member.0 == *j).count() == 1;
                assert!(some.iter().filter(is_near).all(is_found));
            }
        }
        assert!(grid.around(positions[0], 2.0).count() < 10);
    }

    #[test]
    fn far_particles_do_not_cost_memory() {
        let mut grid = CellGrid::default();
        let far = Vec2::new(1e9, 1e9);
        grid.fill(&[0, 1], &[Vec2::zeros(), far], (Vec2::zeros(), far), 1e-3, &Threads::new(1).unwrap());
        assert!(grid.starts.len() < 32);
    }
}
