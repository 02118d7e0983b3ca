//! Sums over discs and contacts in square cells, of which fields of density, velocity and stress are made.
//!
//! A disc counts in the cell of its center, a contact in every cell that its branch goes through, by the share of its length
//! there: from center to center between discs, from the center to the point of contact at the drum. This is coarse graining with a
//! weight that is one in the cell and zero elsewhere, walls included.
//! Sources: I. Goldhirsch, Granular Matter 12 (2010) 239; T. Weinhart et al., Granular Matter 14 (2012) 289.

use serde::{Deserialize, Serialize};

use crate::error::{Error, require};
use crate::physics::particles::Particles;
use crate::physics::vector::Vec2;

/// Columns of a cell: mass [kg/m], area [m²], momentum x, y [kg/s], momentum times velocity xx, xy, yy [N], then force on the other
/// body times branch xx, xy, yx, yy [N]; per meter of depth.
pub const FIELD_WIDTH: usize = 11;
const CONTACT: usize = 7;

/// The most cells of a grid.
const MOST_CELLS: f64 = 1e6;

/// What has been summed up, in moments that are equally long apart.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct FieldSums {
    /// Number of moments.
    pub moments: u64,
    /// By cell: x by x, and y within.
    pub cells: Vec<[f64; FIELD_WIDTH]>,
}

/// Square cells about the axis, in the laboratory's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FieldGrid {
    /// Side of a cell [m].
    pub side: f64,
    /// Cells from the axis to the grid's end.
    half: usize,
}

impl FieldGrid {
    /// Cells that cover a drum of some radius [m].
    ///
    /// # Errors
    /// `Error::Config` where they would be too many.
    pub fn new(side: f64, radius: f64) -> Result<Self, Error> {
        let half = (radius / side).ceil();
        let least = 2.0 * radius / MOST_CELLS.sqrt();
        let limit = format!("at least {least:.3e}, for {MOST_CELLS:e} cells");
        require(4.0 * half * half <= MOST_CELLS, "run.cell", side, limit)?;
        Ok(Self { side, half: half as usize })
    }

    /// Number of cells.
    pub fn cell_count(&self) -> usize {
        4 * self.half * self.half
    }

    /// Where the cells of a row have their middles [m].
    pub fn middles(&self) -> impl Iterator<Item = f64> + use<> {
        let Self { side, half } = *self;
        (0..2 * half).map(move |index| (index as f64 + 0.5 - half as f64) * side)
    }

    /// A place in sides of a cell, from the grid's corner.
    fn place(&self, point: Vec2) -> [f64; 2] {
        [point.x, point.y].map(|coordinate| coordinate / self.side + self.half as f64)
    }

    fn index(&self, cell: [f64; 2]) -> usize {
        let [column, row] = cell.map(|coordinate| (coordinate.max(0.0) as usize).min(2 * self.half - 1));
        column * 2 * self.half + row
    }

    /// The cells that a line goes through, each with the share of the line in it.
    fn visit_line(&self, start: Vec2, line: Vec2, mut visit: impl FnMut(usize, f64)) {
        let from = self.place(start);
        let step = [line.x, line.y].map(|component| component / self.side);
        let mut cell = from.map(f64::floor);
        let mut at = 0.0;
        loop {
            // The share of the line at which it leaves the cell through a side across each axis.
            let leave = [0, 1].map(|axis| {
                let border = cell[axis] + f64::from(u8::from(step[axis] > 0.0));
                if step[axis] == 0.0 { f64::INFINITY } else { (border - from[axis]) / step[axis] }
            });
            let axis = usize::from(leave[1] < leave[0]);
            let is_last = leave[axis] >= 1.0 || leave[axis].is_nan();
            let end = if is_last { 1.0 } else { leave[axis].max(at) };
            visit(self.index(cell), end - at);
            if is_last {
                return;
            }
            at = end;
            cell[axis] += step[axis].signum();
        }
    }
}

impl FieldSums {
    /// Nothing yet.
    pub fn new(grid: &FieldGrid) -> Self {
        Self { moments: 0, cells: vec![[0.0; FIELD_WIDTH]; grid.cell_count()] }
    }

    /// Adds the discs of a moment.
    pub fn add_discs(&mut self, grid: &FieldGrid, particles: &Particles) {
        self.moments += 1;
        for (index, &position) in particles.positions.iter().enumerate() {
            let (mass, radius) = (particles.masses[index], particles.radii[index]);
            let [x, y]: [f64; 2] = particles.velocities[index].into();
            let area = std::f64::consts::PI * radius * radius;
            let terms = [mass, area, mass * x, mass * y, mass * x * x, mass * x * y, mass * y * y];
            let cell = &mut self.cells[grid.index(grid.place(position))];
            for (sum, term) in cell.iter_mut().zip(terms) {
                *sum += term;
            }
        }
    }

    /// Adds a contact: the force on the other body [N/m], and the branch from the center of the one to that of the other, or to
    /// the point at which it touches the drum [m].
    pub fn add_contact(&mut self, grid: &FieldGrid, center: Vec2, branch: Vec2, force: Vec2) {
        let products = [force.x * branch.x, force.x * branch.y, force.y * branch.x, force.y * branch.y];
        grid.visit_line(center, branch, |cell, share| {
            for (sum, product) in self.cells[cell][CONTACT..].iter_mut().zip(products) {
                *sum += share * product;
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Shares by cell of a grid of 4 × 4 cells of side 1.
    fn shares(start: [f64; 2], line: [f64; 2]) -> Vec<(usize, f64)> {
        let grid = FieldGrid::new(1.0, 2.0).expect("a small grid");
        let mut found = Vec::new();
        grid.visit_line(start.into(), line.into(), |cell, share| found.push((cell, share)));
        found.retain(|&(_, share)| share > 0.0);
        found
    }

    #[test]
    fn a_line_is_shared_by_the_cells_that_it_goes_through() {
        // Cells are numbered upwards, column by column from the left.
        assert_eq!(shares([0.5, 0.5], [0.25, 0.0]), [(10, 1.0)]);
        assert_eq!(shares([0.5, 0.5], [-1.0, 0.0]), [(10, 0.5), (6, 0.5)]);
        let up = shares([0.5, -1.5], [0.0, 3.0]);
        for ((cell, share), expected) in up.into_iter().zip([(8, 0.5), (9, 1.0), (10, 1.0), (11, 0.5)]) {
            assert!(cell == expected.0 && (3.0 * share - expected.1).abs() < 1e-15, "{cell} {share}");
        }
        // Through a corner, and without length.
        assert_eq!(shares([0.5, 0.5], [1.0, 1.0]), [(10, 0.5), (15, 0.5)]);
        assert_eq!(shares([0.5, 0.5], [0.0, 0.0]), [(10, 1.0)]);
    }

    #[test]
    fn shares_of_any_line_add_up_to_one() {
        for angle in 0..50 {
            let (sin, cos) = libm::sincos(f64::from(angle));
            let found = shares([0.1 * cos, 0.3], [1.6 * cos, 1.5 * sin]);
            assert!((found.iter().map(|own| own.1).sum::<f64>() - 1.0).abs() < 1e-15, "{found:?}");
        }
    }

    #[test]
    fn a_grid_of_too_many_cells_is_refused() {
        let error = FieldGrid::new(1e-6, 0.24).expect_err("a refusal");
        assert!(error.key() == Some("run.cell") && error.limit().contains("4.800e-4"), "{error}");
    }
}
