//! One straight edge of an outline, queried with parry2d.

use parry2d::math::Vector;
use parry2d::query::PointQueryWithLocation;
use parry2d::shape::{Segment as ParrySegment, SegmentPointLocation};

use crate::physics::vector::{Vec2, cross, dot};

/// A directed straight line from its start to its end, of non-zero length.
#[derive(Debug, Clone, Copy)]
pub(super) struct Segment {
    pub(super) start: Vec2,
    pub(super) end: Vec2,
}

/// Where on a segment the closest point lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum SegmentRegion {
    /// At the start; the projection falls on it or before it.
    Start,
    /// Between the ends, at this fraction of the way from the start.
    Between(f64),
    /// At the end; the projection falls on it or beyond it.
    End,
}

/// The point of a segment closest to some other point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Projection {
    /// The closest point.
    pub(super) point: Vec2,
    /// Where on the segment it lies.
    pub(super) region: SegmentRegion,
}

impl Segment {
    pub(super) fn new(start: Vec2, end: Vec2) -> Self {
        Self { start, end }
    }

    /// From the start to the end, in full length [m].
    #[inline]
    pub(super) fn vector(&self) -> Vec2 {
        self.end - self.start
    }

    /// The point of this segment closest to `point`.
    ///
    /// Parry compares scalar products only, so the answer has no length scale of its own. (Its flag
    /// `is_inside` has a tolerance; it is not used.)
    #[inline]
    pub(super) fn project(&self, point: Vec2) -> Projection {
        let [start, end, point] = [self.start, self.end, point].map(|v| Vector::new(v.x, v.y));
        let (closest, location) =
            ParrySegment::new(start, end).project_local_point_and_get_location(point, false);
        let region = match location {
            SegmentPointLocation::OnVertex(0) => SegmentRegion::Start,
            SegmentPointLocation::OnVertex(_) => SegmentRegion::End,
            SegmentPointLocation::OnEdge([_, fraction]) => SegmentRegion::Between(fraction),
        };
        Projection { point: Vec2::new(closest.point.x, closest.point.y), region }
    }

    /// Squared distance [m²] from `point`.
    #[inline]
    pub(super) fn distance_squared(&self, point: Vec2) -> f64 {
        let offset = self.project(point).point - point;
        dot(offset, offset)
    }

    /// Positive left of the line through this segment, negative right of it, zero on it.
    #[inline]
    pub(super) fn left_of(&self, point: Vec2) -> f64 {
        cross(self.vector(), point - self.start)
    }

    /// Whether two segments cross at a point inside both.
    #[inline]
    pub(super) fn crosses(&self, other: &Self) -> bool {
        opposite(self.left_of(other.start), self.left_of(other.end))
            && opposite(other.left_of(self.start), other.left_of(self.end))
    }

    /// Whether two segments share any point at all.
    pub(super) fn meets(&self, other: &Self) -> bool {
        self.crosses(other)
            || self.holds(other.start)
            || self.holds(other.end)
            || other.holds(self.start)
            || other.holds(self.end)
    }

    /// Whether `point` lies on this segment.
    pub(super) fn holds(&self, point: Vec2) -> bool {
        let Self { start, end } = *self;
        let between = |a: f64, b: f64, value: f64| a.min(b) <= value && value <= a.max(b);
        self.left_of(point) == 0.0 && between(start.x, end.x, point.x) && between(start.y, end.y, point.y)
    }
}

/// Whether two numbers have opposite signs, neither being zero.
#[inline]
fn opposite(a: f64, b: f64) -> bool {
    (a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn segment(start: [f64; 2], end: [f64; 2]) -> Segment {
        Segment::new(start.into(), end.into())
    }

    #[test]
    fn projection_names_its_region() {
        let segment = segment([1.0, 1.0], [5.0, 1.0]);
        assert_eq!(segment.project(Vec2::new(1.0, 3.0)).region, SegmentRegion::Start);
        assert_eq!(segment.project(Vec2::new(5.0, 0.0)).region, SegmentRegion::End);
        let between = segment.project(Vec2::new(2.0, 3.0));
        assert_eq!((between.point, between.region), (Vec2::new(2.0, 1.0), SegmentRegion::Between(0.25)));
        assert_eq!(segment.distance_squared(Vec2::new(8.0, 5.0)), 25.0);
    }

    #[test]
    fn left_is_positive() {
        assert!(segment([0.0, 0.0], [1.0, 0.0]).left_of(Vec2::new(0.3, 0.1)) > 0.0);
        assert!(segment([1.0, 0.0], [0.0, 0.0]).left_of(Vec2::new(0.3, 0.1)) < 0.0);
    }

    #[test]
    fn crossing_and_touching_differ() {
        let base = segment([0.0, 0.0], [2.0, 0.0]);
        let (crossing, touching) = (segment([1.0, -1.0], [1.0, 1.0]), segment([1.0, 0.0], [1.0, 1.0]));
        let (collinear, beyond) = (segment([1.0, 0.0], [3.0, 0.0]), segment([2.5, 0.0], [3.0, 0.0]));
        assert!(base.crosses(&crossing) && base.meets(&crossing));
        assert!(!base.crosses(&touching) && base.meets(&touching) && touching.meets(&base));
        assert!(!base.crosses(&collinear) && base.meets(&collinear));
        assert!(!base.meets(&beyond) && !base.meets(&segment([0.0, 1.0], [2.0, 0.5])));
    }
}
