//! Plane geometry of closed polygons and open polylines, given as lists of points.

use super::segment::Segment;
use crate::physics::vector::{Vec2, cross, dot};

/// Points as vectors.
pub(super) fn vectors(points: &[[f64; 2]]) -> Vec<Vec2> {
    points.iter().map(|&point| point.into()).collect()
}

/// The segments of a polyline in order; a closed one ends with that from the last point to the first.
pub(super) fn segments(points: &[Vec2], closed: bool) -> Vec<Segment> {
    let closing = points.last().zip(points.first()).filter(|_| closed);
    let pairs = points.windows(2).map(|pair| (&pair[0], &pair[1]));
    pairs.chain(closing).map(|(start, end)| Segment::new(*start, *end)).collect()
}

/// The area [m²] inside a closed polygon: positive when its points run counter-clockwise.
pub(super) fn signed_area(points: &[Vec2]) -> f64 {
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return 0.0 };
    let open: f64 = points.windows(2).map(|pair| cross(pair[0], pair[1])).sum();
    0.5 * (open + cross(*last, *first))
}

/// Whether `point` lies inside the closed polygon with these edges: a ray from it towards +x crosses an odd
/// number.
pub(super) fn contains(segments: &[Segment], point: Vec2) -> bool {
    let crossed = segments.iter().filter(|segment| {
        let upwards = segment.start.y <= point.y && segment.end.y > point.y;
        let downwards = segment.end.y <= point.y && segment.start.y > point.y;
        (upwards && segment.left_of(point) > 0.0) || (downwards && segment.left_of(point) < 0.0)
    });
    crossed.count() % 2 == 1
}

/// The index of the first segment without length.
pub(super) fn empty_segment(segments: &[Segment]) -> Option<usize> {
    segments.iter().position(|segment| dot(segment.vector(), segment.vector()) == 0.0)
}

/// Whether `next`, which starts where `segment` ends, runs straight back over it.
pub(super) fn folds_back(segment: &Segment, next: &Segment) -> bool {
    cross(segment.vector(), next.vector()) == 0.0 && dot(segment.vector(), next.vector()) < 0.0
}

/// The first two segments of a closed polygon that share more than the corner between them.
pub(super) fn first_crossing(segments: &[Segment]) -> Option<(usize, usize)> {
    let last = segments.len().saturating_sub(1);
    let pairs = (0..segments.len()).flat_map(|i| (i + 1..segments.len()).map(move |j| (i, j)));
    let touch = |i: usize, j: usize| match (i, j) {
        (0, j) if j == last => folds_back(&segments[last], &segments[0]),
        (i, j) if j == i + 1 => folds_back(&segments[i], &segments[j]),
        _ => segments[i].meets(&segments[j]),
    };
    pairs.into_iter().find(|&(i, j)| touch(i, j))
}

/// The length [m] of a vector, in a fixed order of operations.
#[inline]
pub(super) fn length(v: Vec2) -> f64 {
    dot(v, v).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn closed(list: &[[f64; 2]]) -> Vec<Segment> {
        segments(&vectors(list), true)
    }

    #[test]
    fn area_has_the_sign_of_the_orientation() {
        let square = vectors(&[[1.0, 1.0], [3.0, 1.0], [3.0, 3.0], [1.0, 3.0]]);
        assert_eq!(signed_area(&square), 4.0);
        let reversed: Vec<Vec2> = square.into_iter().rev().collect();
        assert_eq!(signed_area(&reversed), -4.0);
    }

    #[test]
    fn inside_and_outside_of_a_notched_square() {
        let notched = closed(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 1.0], [0.0, 4.0]]);
        assert!(contains(&notched, Vec2::new(0.5, 2.0)) && contains(&notched, Vec2::new(3.5, 2.0)));
        assert!(!contains(&notched, Vec2::new(2.0, 2.0)) && !contains(&notched, Vec2::new(-1.0, 1.0)));
    }

    #[test]
    fn crossing_segments_are_found() {
        assert_eq!(first_crossing(&closed(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])), None);
        let bow_tie = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
        assert_eq!(first_crossing(&closed(&bow_tie)), Some((1, 3)));
        let touching = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 0.0], [0.0, 2.0]];
        assert_eq!(first_crossing(&closed(&touching)), Some((0, 2)));
        let flat = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]];
        assert_eq!(first_crossing(&closed(&flat)), Some((0, 2)));
    }
}
