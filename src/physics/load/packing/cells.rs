//! The discs placed so far, on a square grid that finds the neighbors of a point.

use crate::physics::vector::{Vec2, dot};

/// Centers of equal discs, listed by the grid cell they are in.
///
/// Cells are at least as wide as the spacing, so whatever is too close to a point is in the 3 × 3 cells around it; a
/// rim of empty cells spares those the bounds.
pub(super) struct Cells {
    reach: f64,
    spacing: f64,
    width: f64,
    across: usize,
    /// The discs in each cell, the last to arrive at the end.
    discs: Vec<Vec<u32>>,
    centers: Vec<Vec2>,
}

impl Cells {
    /// An empty grid for centers within `reach` of the axis on both axes and at least `spacing` apart [m], of no more
    /// cells than suit `count` discs.
    pub(super) fn new(reach: f64, spacing: f64, count: usize) -> Self {
        let width = spacing.max(2.0 * reach / (count as f64).sqrt());
        let across = (2.0 * reach / width) as usize + 3;
        let discs = vec![Vec::new(); across * across];
        Self { reach, spacing, width, across, discs, centers: Vec::with_capacity(count) }
    }

    /// Number of discs.
    pub(super) fn len(&self) -> usize {
        self.centers.len()
    }

    /// The center of a disc.
    pub(super) fn center(&self, disc: usize) -> Vec2 {
        self.centers[disc]
    }

    /// Whether a disc centered here, within reach, overlaps none of those placed, apart from disc `except`.
    pub(super) fn is_free(&self, center: Vec2, except: Option<usize>) -> bool {
        let is_far = |&disc: &u32| {
            let apart = self.centers[disc as usize] - center;
            except == Some(disc as usize) || dot(apart, apart) >= self.spacing * self.spacing
        };
        let corner = self.cell(center) - self.across - 1;
        (0..3).all(|row| {
            let start = corner + row * self.across;
            self.discs[start..start + 3].iter().all(|discs| discs.iter().all(is_far))
        })
    }

    /// Adds a disc.
    pub(super) fn push(&mut self, center: Vec2) {
        let cell = self.cell(center);
        self.discs[cell].push(self.centers.len() as u32);
        self.centers.push(center);
    }

    /// Moves a disc.
    pub(super) fn relocate(&mut self, disc: usize, center: Vec2) {
        let (from, to) = (self.cell(self.centers[disc]), self.cell(center));
        self.centers[disc] = center;
        if from != to {
            self.discs[from].retain(|&other| other != disc as u32);
            self.discs[to].push(disc as u32);
        }
    }

    /// All centers, cell by cell: in rows from bottom to top, each from left to right.
    pub(super) fn into_rows(self) -> Vec<Vec2> {
        // Within a cell the last to arrive comes first.
        let discs = self.discs.iter().flat_map(|discs| discs.iter().rev());
        discs.map(|&disc| self.centers[disc as usize]).collect()
    }

    fn cell(&self, center: Vec2) -> usize {
        let column = ((center.x + self.reach) / self.width) as usize + 1;
        let row = ((center.y + self.reach) / self.width) as usize + 1;
        row * self.across + column
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points that fill the square of half width `half` without order.
    fn points(count: u32, half: f64) -> impl Iterator<Item = Vec2> {
        (0..count).map(move |index| {
            let (x, y) = (f64::from(index) * 0.754_877_7, f64::from(index) * 0.569_840_3);
            Vec2::new(2.0 * (x - x.floor()) - 1.0, 2.0 * (y - y.floor()) - 1.0) * half
        })
    }

    fn grid(centers: impl Iterator<Item = Vec2>) -> Cells {
        let mut cells = Cells::new(1.0, 0.1, 100);
        centers.for_each(|center| cells.push(center));
        cells
    }

    #[test]
    fn a_point_is_free_exactly_if_every_disc_is_far_enough() {
        let mut cells = grid(points(100, 0.7));
        for (disc, center) in points(100, 0.9).enumerate().step_by(2) {
            cells.relocate(disc, center);
        }
        let mut free = 0;
        for point in points(1000, 1.0) {
            let expected = cells.centers.iter().all(|center| (center - point).norm() >= 0.1);
            assert_eq!(cells.is_free(point, None), expected, "at {point}");
            free += usize::from(expected);
        }
        assert!((200..800).contains(&free), "a test of both answers needs both, but {free} of 1000 are free");
    }

    #[test]
    fn a_disc_does_not_stand_in_its_own_way() {
        let cells = grid([Vec2::new(0.5, 0.5), Vec2::new(0.3, 0.3)].into_iter());
        assert!(cells.is_free(Vec2::new(0.52, 0.5), Some(0)));
        assert!(!cells.is_free(Vec2::new(0.52, 0.5), Some(1)));
    }

    #[test]
    fn rows_hold_every_disc_once_from_bottom_to_top() {
        let rows = grid(points(100, 0.7)).into_rows();
        assert!(rows.windows(2).all(|pair| pair[1].y > pair[0].y - 0.2));
        assert!(points(100, 0.7).all(|point| rows.iter().filter(|center| **center == point).count() == 1));
    }
}
