//! One baffle or wall: its vertices and edges, and the proximity of a point to each.
//!
//! The features are counted in boundary order: vertex 0, edge 0, vertex 1, edge 1, … The plane around the
//! outline is divided among them: an edge answers where the projection falls between its ends, a vertex where
//! both its edges clamp to it. Both ask the same clamped projection, so that neither gap nor overlap opens
//! between them.

use super::Proximity;
use super::polygon::{contains, length, sides};
use super::segment::{Segment, SegmentRegion};
use super::visibility::{occluders, overhangs};
use crate::physics::vector::{Vec2, cross, dot, perpendicular};

/// What an outline bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Kind {
    /// A closed polygon, counter-clockwise: felt from outside only.
    Solid,
    /// A polyline without thickness: felt from both sides. It is closed where it ends at its first point.
    Wall,
}

/// A polygon or polyline in the body frame, with all that queries need precomputed.
#[derive(Debug, Clone)]
pub(super) struct Outline {
    kind: Kind,
    points: Vec<Vec2>,
    sides: Vec<Segment>,
    corners: Vec<Corner>,
    /// For each edge the fractions that the edges before it (from its start) and after it (from its end) overhang.
    overhangs: Vec<[f64; 2]>,
    /// For each feature the far sides that may hide it.
    occluders: Vec<Vec<usize>>,
    /// The bounding box.
    low: Vec2,
    high: Vec2,
}

/// A vertex and the edges that meet there; the end of a wall has only one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corner {
    /// Where it is.
    pub(super) point: Vec2,
    /// Index of the edge that ends here.
    pub(super) before: Option<usize>,
    /// Index of the edge that starts here.
    pub(super) after: Option<usize>,
    /// 1 where the outline turns left, −1 right, 0 straight on or at the end of a wall.
    pub(super) turn: f64,
}

impl Outline {
    /// From validated points: neighbors are distinct, and a solid's run counter-clockwise.
    pub(super) fn new(points: Vec<Vec2>, kind: Kind) -> Self {
        let sides = sides(&points, kind == Kind::Solid);
        let closed = kind == Kind::Solid || (points.len() > 2 && points.first() == points.last());
        let corners = corners(&sides, closed);
        let low = points.iter().copied().reduce(|a, b| a.inf(&b)).unwrap_or_default();
        let high = points.iter().copied().reduce(|a, b| a.sup(&b)).unwrap_or_default();
        let overhangs = overhangs(&sides, &corners);
        let occluders = occluders(kind, &sides, &corners);
        Self { kind, points, sides, corners, overhangs, occluders, low, high }
    }

    /// The points as given: a baffle's first point is not repeated at the end, a closed wall's is.
    pub(super) fn points(&self) -> &[Vec2] {
        &self.points
    }

    /// The number of vertices and edges together.
    pub(super) fn feature_count(&self) -> usize {
        self.corners.len() + self.sides.len()
    }

    /// How many places apart two features are along the boundary, the shorter way round where it is closed.
    pub(super) fn places_apart(&self, a: usize, b: usize) -> usize {
        let apart = a.abs_diff(b);
        let closed = self.corners.len() == self.sides.len();
        if closed { apart.min(self.feature_count() - apart) } else { apart }
    }

    /// Distance [m] from `point` to the outline, negative inside a solid.
    pub(super) fn signed_distance(&self, point: Vec2) -> f64 {
        let squared =
            self.sides.iter().map(|side| side.distance_squared(point)).fold(f64::INFINITY, f64::min);
        let inside = self.kind == Kind::Solid && contains(&self.sides, point);
        if inside { -squared.sqrt() } else { squared.sqrt() }
    }

    /// Whether the bounding box tells that every point of the outline is farther than `distance` [m], round-off included.
    pub(super) fn is_beyond(&self, point: Vec2, distance: f64) -> bool {
        self.is_outside(point, distance * (1.0 + 1e-9))
    }

    /// Whether `center` is more than `reach` [m] beside the bounding box.
    fn is_outside(&self, center: Vec2, reach: f64) -> bool {
        let outside = |value: f64, low: f64, high: f64| value < low - reach || value > high + reach;
        outside(center.x, self.low.x, self.high.x) || outside(center.y, self.low.y, self.high.y)
    }

    /// Appends `first` + index of every feature at most `reach` [m] away from `center`, in ascending order.
    pub(super) fn features_near(&self, center: Vec2, reach: f64, first: u32, found: &mut Vec<u32>) {
        if self.is_outside(center, reach) {
            return;
        }
        let within = |offset: Vec2| dot(offset, offset) <= reach * reach;
        for (index, corner) in self.corners.iter().enumerate() {
            if within(corner.point - center) {
                found.push(first + 2 * index as u32);
            }
            if self.sides.get(index).is_some_and(|side| within(side.project(center).point - center)) {
                found.push(first + 2 * index as u32 + 1);
            }
        }
    }

    /// Proximity of `center` to the feature at `index`; none where another feature has the say, where
    /// `center` is inside the solid, or where another side hides the feature.
    #[inline]
    pub(super) fn proximity(&self, index: usize, center: Vec2) -> Option<Proximity> {
        if index.is_multiple_of(2) {
            self.vertex_proximity(index / 2, center)
        } else {
            self.edge_proximity(index / 2, center)
        }
    }

    fn vertex_proximity(&self, vertex: usize, center: Vec2) -> Option<Proximity> {
        let corner = &self.corners[vertex];
        let (before, after) =
            (corner.before.map(|edge| &self.sides[edge]), corner.after.map(|edge| &self.sides[edge]));
        if before.is_some_and(|side| side.project(center).place != SegmentRegion::End)
            || after.is_some_and(|side| side.project(center).place != SegmentRegion::Start)
        {
            return None;
        }
        // Both edges clamp to a concave vertex only inside the solid, or by round-off where it is all but straight.
        let inside = |side: &Segment| side.left_of(center) > 0.0;
        let concave = self.kind == Kind::Solid && corner.turn < 0.0;
        if concave && (before.is_some_and(inside) || after.is_some_and(inside)) {
            return None;
        }
        let side = after.or(before)?;
        self.seen(2 * vertex, center, corner.point).then(|| toward(corner.point, center, side))
    }

    fn edge_proximity(&self, edge: usize, center: Vec2) -> Option<Proximity> {
        let side = &self.sides[edge];
        let projection = side.project(center);
        let SegmentRegion::Between(fraction) = projection.place else { return None };
        let left = side.left_of(center);
        if (self.kind == Kind::Solid && left > 0.0)
            || self.yields_to_previous(edge, fraction, left, center)
            || self.yields_to_next(edge, fraction, left, center)
        {
            return None;
        }
        self.seen(2 * edge + 1, center, projection.point).then(|| toward(projection.point, center, side))
    }

    /// Whether the edge before this one stands in front of it, or claims `center` as well though the corner
    /// between them is convex on that side: then only round-off lets both projections fall between the ends.
    fn yields_to_previous(&self, edge: usize, fraction: f64, left: f64, center: Vec2) -> bool {
        let corner = &self.corners[edge];
        let Some(previous) = corner.before.map(|index| &self.sides[index]) else { return false };
        if corner.turn * previous.left_of(center) > 0.0 {
            return false;
        }
        if corner.turn * left > 0.0 {
            fraction < self.overhangs[edge][0]
        } else {
            matches!(previous.project(center).place, SegmentRegion::Between(_))
        }
    }

    /// Whether the edge after this one stands in front of it.
    fn yields_to_next(&self, edge: usize, fraction: f64, left: f64, center: Vec2) -> bool {
        let corner = &self.corners[self.end_of(edge)];
        1.0 - fraction < self.overhangs[edge][1]
            && corner.turn * left > 0.0
            && corner.after.is_some_and(|next| corner.turn * self.sides[next].left_of(center) <= 0.0)
    }

    /// Whether nothing but neighbors stands between `center` and a point of the feature at `index`.
    #[inline]
    fn seen(&self, index: usize, center: Vec2, point: Vec2) -> bool {
        let occluders = &self.occluders[index];
        let sight = Segment::new(center, point);
        !occluders.iter().any(|&side| self.sides[side].crosses(&sight))
    }

    /// The vertex at which an edge ends.
    #[inline]
    fn end_of(&self, edge: usize) -> usize {
        if edge + 1 < self.corners.len() { edge + 1 } else { 0 }
    }
}

/// The vertices of an outline with these sides.
pub(super) fn corners(sides: &[Segment], closed: bool) -> Vec<Corner> {
    let count = if closed { sides.len() } else { sides.len() + 1 };
    let corner = |vertex: usize| {
        let before = if vertex > 0 { Some(vertex - 1) } else { closed.then(|| sides.len() - 1) };
        let after = (vertex < sides.len()).then_some(vertex);
        let point = after.map_or_else(|| sides[vertex - 1].end(), |edge| sides[edge].start());
        let turn = before.zip(after).map_or(0.0, |(before, after)| {
            let turn = cross(sides[before].vector(), sides[after].vector());
            f64::from(i8::from(turn > 0.0) - i8::from(turn < 0.0))
        });
        Corner { point, before, after, turn }
    };
    (0..count).map(corner).collect()
}

/// The proximity of `center` to `point`. Where they coincide any normal serves, so the left one of `side` does.
#[inline]
fn toward(point: Vec2, center: Vec2, side: &Segment) -> Proximity {
    let offset = point - center;
    let distance = length(offset);
    if distance > 0.0 {
        return Proximity { distance, direction: offset / distance };
    }
    let normal = perpendicular(side.vector());
    Proximity { distance, direction: normal / length(normal) }
}
