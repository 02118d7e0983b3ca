//! What stands in front of what: which sides of an outline may hide another of its features.
//!
//! A disc may be larger than a baffle or the bend of a wall is thick. It must not feel the far face through
//! the near one, so a feature answers only where the line of sight to it is free. All of this that depends on
//! the outline alone is found once, here; a convex baffle has nothing left to test.

use super::outline::{Corner, Kind};
use super::segment::Segment;
use crate::physics::vector::{Vec2, dot, perpendicular};

/// For each edge the fraction of it that the edge before it overhangs, counted from its start, and the edge
/// after it, counted from its end. Up to there a line of sight from behind the neighbor is blocked. Positive
/// at acute corners only.
pub(super) fn overhangs(sides: &[Segment], corners: &[Corner]) -> Vec<[f64; 2]> {
    let mut fractions = vec![[0.0; 2]; sides.len()];
    for corner in corners {
        if let (Some(before), Some(after)) = (corner.before, corner.after) {
            let (back, forth) = (-sides[before].vector(), sides[after].vector());
            fractions[before][1] = dot(back, forth) / dot(back, back);
            fractions[after][0] = dot(back, forth) / dot(forth, forth);
        }
    }
    fractions
}

/// For each feature the sides that reach into its region, neighbors apart, and so may hide it from a point
/// there.
pub(super) fn occluders(kind: Kind, sides: &[Segment], corners: &[Corner]) -> Vec<Vec<usize>> {
    let mut lists = Vec::with_capacity(corners.len() + sides.len());
    for (index, corner) in corners.iter().enumerate() {
        lists.push(far_sides(sides, &[corner.before, corner.after], &vertex_region(sides, corner)));
        if let Some(side) = sides.get(index) {
            let next = &corners[(index + 1) % corners.len()];
            lists.push(far_sides(sides, &[corner.before, Some(index), next.after], &edge_region(kind, side)));
        }
    }
    lists
}

/// The half plane of all points x with normal · (x − origin) ≥ 0.
struct HalfPlane {
    normal: Vec2,
    origin: Vec2,
}

/// Where both edges of a vertex clamp to it.
fn vertex_region(sides: &[Segment], corner: &Corner) -> Vec<HalfPlane> {
    let beyond = corner.before.map(|edge| sides[edge].vector());
    let ahead = corner.after.map(|edge| -sides[edge].vector());
    beyond.into_iter().chain(ahead).map(|normal| HalfPlane { normal, origin: corner.point }).collect()
}

/// Where the projection on an edge falls between its ends, outside of a solid.
fn edge_region(kind: Kind, side: &Segment) -> Vec<HalfPlane> {
    let along = side.vector();
    let mut region = vec![
        HalfPlane { normal: along, origin: side.start() },
        HalfPlane { normal: -along, origin: side.end() },
    ];
    if kind == Kind::Solid {
        region.push(HalfPlane { normal: -perpendicular(along), origin: side.start() });
    }
    region
}

/// The sides outside `own` of which some part lies in the region, the intersection of the half planes.
fn far_sides(sides: &[Segment], own: &[Option<usize>], region: &[HalfPlane]) -> Vec<usize> {
    (0..sides.len()).filter(|&index| !own.contains(&Some(index)) && reaches(&sides[index], region)).collect()
}

/// Whether some part of `side` lies in the region.
fn reaches(side: &Segment, region: &[HalfPlane]) -> bool {
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    for HalfPlane { normal, origin } in region {
        let at_start = dot(*normal, side.start() - origin);
        let at_end = dot(*normal, side.end() - origin);
        if at_start < 0.0 && at_end < 0.0 {
            return false;
        }
        let border = at_start / (at_start - at_end);
        if at_start < 0.0 {
            low = low.max(border);
        } else if at_end < 0.0 {
            high = high.min(border);
        }
    }
    low <= high
}

#[cfg(test)]
mod tests {
    use super::super::outline::corners;
    use super::super::polygon::sides;
    use super::*;

    #[test]
    fn only_sides_that_reach_into_the_region_block() {
        // The region: right of x = 0 and below y = 1.
        let region = [
            HalfPlane { normal: Vec2::new(2.0, 0.0), origin: Vec2::new(0.0, 7.0) },
            HalfPlane { normal: Vec2::new(0.0, -1.0), origin: Vec2::new(3.0, 1.0) },
        ];
        let sides = [
            Segment::new(Vec2::new(-2.0, 0.0), Vec2::new(-1.0, 0.0)),
            Segment::new(Vec2::new(-2.0, 0.0), Vec2::new(1.0, 0.0)),
            Segment::new(Vec2::new(-1.0, 0.5), Vec2::new(1.0, 2.0)),
            Segment::new(Vec2::new(-1.0, -0.5), Vec2::new(1.0, 2.0)),
            Segment::new(Vec2::new(1.0, 0.0), Vec2::new(2.0, 0.0)),
        ];
        assert_eq!(far_sides(&sides, &[Some(4), None], &region), [1, 3]);
        assert_eq!(far_sides(&sides, &[], &region), [1, 3, 4]);
    }

    #[test]
    fn nothing_hides_a_feature_of_a_convex_solid() {
        let points: Vec<Vec2> =
            [[0.2, 0.03], [0.15, 0.01], [0.15, -0.02], [0.2, -0.03]].map(Vec2::from).to_vec();
        let sides = sides(&points, true);
        assert!(occluders(Kind::Solid, &sides, &corners(&sides, true)).iter().all(Vec::is_empty));
        // Seen from both sides, opposite walls do hide each other.
        assert!(!occluders(Kind::Wall, &sides, &corners(&sides, true)).iter().all(Vec::is_empty));
    }

    #[test]
    fn acute_corners_overhang() {
        let points = [[0.0, 0.0], [4.0, 0.0], [3.0, 3.0], [9.0, 3.0]].map(Vec2::from);
        let sides = sides(&points, false);
        let fractions = overhangs(&sides, &corners(&sides, false));
        assert_eq!(fractions[0], [0.0, 0.25]);
        assert!(fractions[1][0] > 0.0 && fractions[1][1] > 0.0 && fractions[2][0] > 0.0);
        assert_eq!(fractions[2][1], 0.0);
    }
}
