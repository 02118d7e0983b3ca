//! Walls that meet, joined: wherever walls share a point they become one outline.
//!
//! Drawings come as loose lines. Were each an outline of its own, a disc at a joint would touch two of them
//! and be pushed twice. So all walls are cut where they meet or cross each other, ends that coincide become
//! one vertex, and of edges that lie upon each other only the first stays.

use std::collections::BTreeSet;

use super::graph::{Graph, GraphEdge, UnionFind};
use super::polygon::length;
use super::segment::{Segment, SegmentRegion};
use crate::error::Error;
use crate::physics::sorting::sort;
use crate::physics::vector::{Vec2, bounds, cross};

/// Points coincide within this fraction of the extent of all walls …
const OF_EXTENT: f64 = 1e-6;

/// … and within this fraction of the shorter of the two segments: small parts of a large drawing keep their
/// shape.
const OF_SEGMENT: f64 = 1e-4;

/// The most corners of walls that hang together: the occluders of an outline grow with their square.
const MOST_CONNECTED: usize = 4000;

/// The most places where walls may cut each other; their number grows with the square of the walls'.
const MOST_CUTS: usize = 20_000;

/// The connected parts of these walls, the surface of the first being `first_surface`; walls that meet no other
/// keep every bit of their points.
pub(super) fn join(walls: &[Vec<[f64; 2]>], first_surface: usize) -> Result<Vec<Graph>, Error> {
    let mut drawing = Drawing::new(walls, first_surface);
    drawing.join_pieces()?;
    let components = drawing.graph().components();
    let largest = components.iter().map(|part| part.vertices.len()).max().unwrap_or(0);
    if largest > MOST_CONNECTED {
        let value = format!("of {largest} corners in walls that meet");
        return Err(Error::config("drum.walls", value, format!("of at most {MOST_CONNECTED}")));
    }
    Ok(components)
}

/// A straight piece of a wall, as drawn.
#[derive(Debug)]
struct Piece {
    segment: Segment,
    length: f64,
    /// Its ends in `Drawing::points`.
    ends: [usize; 2],
    surface: usize,
    /// Where others meet it.
    cuts: Vec<Cut>,
}

/// A place where a piece is cut.
#[derive(Debug, Clone, Copy)]
struct Cut {
    /// How far along the piece, from 0 to 1.
    fraction: f64,
    /// The point it is cut at.
    point: usize,
}

/// All walls, with what is known of how they meet.
#[derive(Debug, Default)]
struct Drawing {
    /// The points as drawn, then the crossings.
    points: Vec<Vec2>,
    pieces: Vec<Piece>,
    /// Which points are one.
    same: UnionFind,
    /// Points that meet a piece between its ends, with their feet on it: there they belong, as it is straight.
    feet: Vec<(usize, Vec2)>,
    cut_count: usize,
}

impl Drawing {
    fn new(walls: &[Vec<[f64; 2]>], first_surface: usize) -> Self {
        let mut drawing = Self::default();
        for (index, wall) in walls.iter().enumerate() {
            let first = drawing.points.len();
            drawing.points.extend(wall.iter().map(|&point| Vec2::from(point)));
            for start in first..drawing.points.len() - 1 {
                let segment = Segment::new(drawing.points[start], drawing.points[start + 1]);
                let (length, ends) = (length(segment.vector()), [start, start + 1]);
                let surface = first_surface + index;
                drawing.pieces.push(Piece { segment, length, ends, surface, cuts: Vec::new() });
            }
        }
        drawing.same = UnionFind::new(drawing.points.len());
        drawing
    }

    /// Finds out where pieces meet, and cuts them there.
    fn join_pieces(&mut self) -> Result<(), Error> {
        let Some((low, high)) = bounds(&self.points) else { return Ok(()) };
        let size = high - low;
        let extent = size.x.max(size.y);
        let tolerance = OF_EXTENT * extent;
        // Lengths whose squares are no ordinary numbers cannot be compared.
        if (tolerance * tolerance).is_normal() && (extent * extent).is_finite() {
            self.sweep(usize::from(size.y > size.x), tolerance)?;
        }
        (0..self.pieces.len()).for_each(|piece| self.merge_cuts(piece, tolerance));
        Ok(())
    }

    /// Compares all pieces whose extents along an axis (0 for x, 1 for y) overlap.
    fn sweep(&mut self, axis: usize, tolerance: f64) -> Result<(), Error> {
        let extent = |piece: &Piece| {
            let (start, end) = (piece.segment.start, piece.segment.end);
            // Twice the tolerance covers round-off.
            (start.inf(&end), start.sup(&end).add_scalar(2.0 * tolerance))
        };
        let mut boxes: Vec<_> = self.pieces.iter().map(extent).enumerate().collect();
        sort(&mut boxes, &|(_, (a, _)), (_, (b, _))| a[axis].total_cmp(&b[axis]));
        let across = 1 - axis;
        for (rank, (i, (low, high))) in boxes.iter().enumerate() {
            for (j, (other_low, other_high)) in &boxes[rank + 1..] {
                if other_low[axis] > high[axis] {
                    break;
                }
                if other_low[across] <= high[across] && low[across] <= other_high[across] {
                    self.join_two(*i.min(j), *i.max(j), tolerance);
                }
            }
            if self.cut_count > MOST_CUTS {
                let value = format!("of walls that meet in more than {MOST_CUTS} places");
                return Err(Error::config("drum.walls", value, "of walls that meet in fewer"));
            }
        }
        Ok(())
    }

    /// Finds out whether two pieces meet: at an end of both, at an end of one, or between all ends.
    fn join_two(&mut self, first: usize, second: usize, tolerance: f64) {
        let shorter = self.pieces[first].length.min(self.pieces[second].length);
        let tolerance = tolerance.min(OF_SEGMENT * shorter);
        let ends = [first, second].map(|piece| self.pieces[piece].ends);
        let mut is_shared = [[false; 2]; 2];
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let (a, b) = (ends[0][i], ends[1][j]);
            if a == b || length(self.points[a] - self.points[b]) <= tolerance {
                self.same.unite(a, b);
                is_shared[0][i] = true;
                is_shared[1][j] = true;
            }
        }
        let mut met = is_shared[0].contains(&true);
        for (own, other) in [(0, second), (1, first)] {
            for end in 0..2 {
                met |= !is_shared[own][end] && self.cut_at_end(other, ends[own][end], tolerance);
            }
        }
        if !met && self.pieces[first].segment.crosses(&self.pieces[second].segment) {
            self.cut_at_crossing(first, second);
        }
    }

    /// Cuts a piece at a point that lies on it between its ends; returns whether it does.
    fn cut_at_end(&mut self, piece: usize, point: usize, tolerance: f64) -> bool {
        let projection = self.pieces[piece].segment.project(self.points[point]);
        let SegmentRegion::Between(fraction) = projection.region else { return false };
        let meets = length(projection.point - self.points[point]) <= tolerance;
        if meets {
            self.cut_count += 1;
            self.pieces[piece].cuts.push(Cut { fraction, point });
            self.feet.push((point, projection.point));
        }
        meets
    }

    /// Cuts two pieces where they cross.
    fn cut_at_crossing(&mut self, first: usize, second: usize) {
        let (one, other) = (self.pieces[first].segment, self.pieces[second].segment);
        let scale = cross(one.vector(), other.vector());
        let offset = other.start - one.start;
        let fraction = cross(offset, other.vector()) / scale;
        let point = self.points.len();
        self.points.push(one.start + one.vector() * fraction);
        self.same.push();
        self.cut_count += 1;
        self.pieces[first].cuts.push(Cut { fraction, point });
        let fraction = cross(offset, one.vector()) / scale;
        self.pieces[second].cuts.push(Cut { fraction, point });
    }

    /// Sorts the cuts of a piece; those that coincide with each other or with an end become one point.
    fn merge_cuts(&mut self, piece: usize, tolerance: f64) {
        let Self { pieces, same, .. } = self;
        let Piece { cuts, ends, length, .. } = &mut pieces[piece];
        sort(cuts, &|a, b| a.fraction.total_cmp(&b.fraction));
        let close = (tolerance / *length).min(OF_SEGMENT);
        let mut previous = Cut { fraction: 0.0, point: ends[0] };
        for &cut in cuts.iter().chain([&Cut { fraction: 1.0, point: ends[1] }]) {
            if cut.fraction - previous.fraction <= close {
                same.unite(previous.point, cut.point);
            }
            previous = cut;
        }
    }

    /// The pieces between their cuts. Of those with the same ends the first stays.
    fn graph(mut self) -> Graph {
        let mut vertices = self.points;
        let mut is_placed = vec![false; vertices.len()];
        for (point, foot) in self.feet {
            let vertex = self.same.find(point);
            if !std::mem::replace(&mut is_placed[vertex], true) {
                vertices[vertex] = foot;
            }
        }
        let (mut edges, mut known) = (Vec::new(), BTreeSet::new());
        for Piece { ends, cuts, surface, .. } in self.pieces {
            let mut start = self.same.find(ends[0]);
            for point in cuts.into_iter().map(|cut| cut.point).chain([ends[1]]) {
                let end = self.same.find(point);
                if start != end && known.insert((start.min(end), start.max(end))) {
                    edges.push(GraphEdge { ends: [start, end], surface });
                }
                start = end;
            }
        }
        Graph::new(vertices, edges)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Coordinates of the start and end of each edge, with its surface, per connected part.
    fn joined(walls: &[&[[f64; 2]]]) -> Vec<Vec<([f64; 4], usize)>> {
        let walls: Vec<Vec<[f64; 2]>> = walls.iter().map(|wall| wall.to_vec()).collect();
        let edges = |part: &Graph| {
            let coordinates = |edge: &GraphEdge| {
                let [start, end] = edge.ends.map(|vertex| part.vertices[vertex]);
                ([start.x, start.y, end.x, end.y], edge.surface)
            };
            part.edges.iter().map(coordinates).collect()
        };
        join(&walls, 1).unwrap().iter().map(edges).collect()
    }

    #[test]
    fn walls_apart_stay_as_they_are() {
        let parts = joined(&[&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]], &[[0.0, 1e-5], [0.5, 0.5]]]);
        assert_eq!(
            parts,
            [vec![([0.0, 0.0, 1.0, 0.0], 1), ([1.0, 0.0, 1.0, 1.0], 1)], vec![([0.0, 1e-5, 0.5, 0.5], 2)]]
        );
    }

    #[test]
    fn ends_that_all_but_coincide_are_one_vertex() {
        for gap in [0.0, 1e-9, -1e-9] {
            let parts = joined(&[&[[0.0, 0.0], [1.0, 0.0]], &[[1.0 + gap, gap], [2.0, 1.0]]]);
            assert_eq!(parts, [[([0.0, 0.0, 1.0, 0.0], 1), ([1.0, 0.0, 2.0, 1.0], 2)]]);
        }
    }

    #[test]
    fn a_wall_is_cut_where_another_ends_on_it() {
        for gap in [0.0, 1e-9, -1e-9] {
            let parts = joined(&[&[[0.0, 0.0], [2.0, 0.0]], &[[1.0, gap], [1.0, 1.0]]]);
            let edges = [[0.0, 0.0, 1.0, 0.0], [1.0, 0.0, 2.0, 0.0], [1.0, 0.0, 1.0, 1.0]];
            assert_eq!(parts, [[(edges[0], 1), (edges[1], 1), (edges[2], 2)]]);
        }
    }

    #[test]
    fn what_lies_upon_each_other_counts_once() {
        let parts =
            joined(&[&[[0.0, 0.0], [2.0, 0.0]], &[[3.0, 0.0], [1.0, 0.0]], &[[0.0, 0.0], [2.0, 0.0]]]);
        let edges = [[0.0, 0.0, 1.0, 0.0], [1.0, 0.0, 2.0, 0.0], [3.0, 0.0, 2.0, 0.0]];
        assert_eq!(parts, [[(edges[0], 1), (edges[1], 1), (edges[2], 2)]]);
    }

    #[test]
    fn crossing_walls_are_cut_at_one_point() {
        let crossing: [&[[f64; 2]]; 3] =
            [&[[-1.0, 0.0], [1.0, 0.0]], &[[0.0, -1.0], [0.0, 1.0]], &[[-1.0, -1.0], [1.0, 1.0]]];
        let parts = joined(&crossing);
        assert_eq!((parts.len(), parts[0].len()), (1, 6));
        assert!(parts[0].iter().all(|(ends, _)| ends[..2] == [0.0, 0.0] || ends[2..] == [0.0, 0.0]));
        let bow_tie = joined(&[&[[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]]]);
        assert_eq!(bow_tie[0].len(), 5);
    }
}
