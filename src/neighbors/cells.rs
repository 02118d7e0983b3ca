//! A uniform grid of cells, filled by counting sort.

use crate::lanes::{ROW, Row, WholeRow};
use crate::physics::vector::Vec2;
use crate::threads::Threads;

/// Particles by cell; within a cell in id order. A rim of empty cells spares those inside the bounds.
#[derive(Debug, Clone, Default)]
pub struct CellGrid {
    origin: Vec2,
    inverse_size: f64,
    columns: usize,
    rows: usize,
    /// Cell `c` holds the members `starts[c]..starts[c + 1]`.
    starts: Vec<u32>,
    /// By cell: the first member of the one before and the end of the one after it.
    spans: Vec<[u32; 2]>,
    /// The members and where they are, as seen from the origin [cells]: a search reads eight in a row, which may be past the
    /// last one.
    members: Vec<u32>,
    x: Vec<f32>,
    y: Vec<f32>,
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
            let (columns, rows) = ((high.x - low.x) / size + RIM, (high.y - low.y) / size + RIM);
            if columns * rows <= most as f64 {
                break (columns, rows);
            }
            size *= 2.0;
        };
        (self.columns, self.rows) = (columns as usize, rows as usize);
        (self.origin, self.inverse_size) = (low, 1.0 / size);
        let mut cells = std::mem::take(&mut self.cells);
        cells.resize(positions.len(), 0);
        threads.set_each(&mut cells, &|i| self.cell_of(positions[i]));
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
        self.members.resize(positions.len() + ROW, 0);
        self.x.resize(positions.len() + ROW, 0.0);
        self.y.resize(positions.len() + ROW, 0.0);
        // Filling from the back turns each cell's end into its start without a second array of cursors.
        for (id, (&cell, &position)) in self.cells.iter().zip(positions).enumerate().rev() {
            let start = &mut self.starts[cell as usize + 1];
            *start -= 1;
            let place = *start as usize;
            self.members[place] = id as u32;
            (self.x[place], self.y[place]) = self.seen(position);
        }
        self.starts.remove(0);
        self.starts.push(positions.len() as u32);
        self.spans.clear();
        self.spans.push([0; 2]);
        self.spans.extend(self.starts.windows(4).map(|starts| [starts[0], starts[3]]));
        self.spans.resize(self.starts.len(), [0; 2]);
    }

    /// Where a position is as seen from the origin, in cells.
    #[inline(always)]
    fn place(&self, position: Vec2) -> Vec2 {
        (position - self.origin) * self.inverse_size
    }

    fn cell_of(&self, position: Vec2) -> u32 {
        let place = self.place(position);
        (place.y as u32 + 1) * self.columns as u32 + place.x as u32 + 1
    }

    /// The same as `place`, in half the precision.
    #[inline(always)]
    pub fn seen(&self, position: Vec2) -> (f32, f32) {
        let place = self.place(position);
        (place.x as f32, place.y as f32)
    }

    /// More than the square of the distance [cells] that two particles are seen at where it is `distance` [m].
    #[inline(always)]
    pub fn seen_squared(&self, distance: f64) -> f32 {
        let round_off = 4.0 * f64::from(f32::EPSILON) * self.columns.max(self.rows) as f64;
        ((distance * self.inverse_size + round_off).powi(2) * (1.0 + 1e-5)) as f32
    }

    /// The places of the members of the cell of a particle and of its neighbors, row of cells by row: the first, and that
    /// after the last.
    #[inline(always)]
    pub fn near(&self, particle: usize) -> [[u32; 2]; 3] {
        let cell = self.cells[particle] as usize;
        [cell - self.columns, cell, cell + self.columns].map(|middle| self.spans[middle])
    }

    /// Eight members from a place on, and where they are seen; what comes after the last means nothing.
    #[inline(always)]
    pub fn eight_from(&self, place: u32) -> (WholeRow, Row, Row) {
        let place = place as usize;
        let (members, x, y) = (eight(&self.members, place), eight(&self.x, place), eight(&self.y, place));
        (WholeRow::new(members), Row::new(x), Row::new(y))
    }
}

#[inline(always)]
fn eight<T: Copy + Default>(values: &[T], place: usize) -> [T; ROW] {
    let mut eight = [T::default(); ROW];
    eight.copy_from_slice(&values[place..place + ROW]);
    eight
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
        let bounds = (Vec2::zeros(), Vec2::new(12.0, 10.0));
        grid.fill(&positions, bounds, 2.0, &Threads::new(1).unwrap());
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
    fn who_is_within_a_distance_is_seen_within_it() {
        let far = Vec2::new(900.0, 1100.0);
        let mut grid = CellGrid::default();
        grid.fill(&vec![far; 300_000], (Vec2::zeros(), far), 2.0, &Threads::new(1).unwrap());
        for k in 0..2000_i32 {
            let one = far * (f64::from(k * 7 % 1999) / 2000.0);
            let (sin, cos) = libm::sincos(f64::from(k));
            let ((x, y), (other_x, other_y)) = (grid.seen(one), grid.seen(one + Vec2::new(cos, sin) * 0.9));
            let (dx, dy) = (other_x - x, other_y - y);
            assert!(dx * dx + dy * dy < grid.seen_squared(0.9), "{k}");
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
