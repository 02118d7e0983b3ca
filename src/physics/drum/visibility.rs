//! What stands in front of what: which edges of an outline may hide another of its features.
//!
//! A disc may be larger than a baffle or the bend of a wall is thick. It must not feel the far face through
//! the near one, so a feature answers only where the line from the center to it is free. All of this that depends
//! on the outline alone is found once, here; a convex baffle has nothing left to test.

use super::feature::Neighbor;
use super::graph::{Graph, Incidence};
use super::segment::Segment;
use crate::physics::vector::{Vec2, cross, dot, perpendicular};

/// Projections on two edges at a convex corner fall between the ends of both by round-off only, so closer to the
/// corner than this fraction of an edge.
const TIE_ZONE: f64 = 1e-3;

/// Corners that bend by less than this angle [rad] are flat: only one edge answers on either side, although both
/// claim a sliver of the concave one. A line drawn in pieces bends by round-off, or by what its ends gape.
const FLAT: f64 = 1e-6;

/// The other edges at the two ends of the edge at `index`, as far as they may hide it or have the say over a
/// point that both claim; and how far from each end they do, as fractions of the edge.
pub(super) fn neighbors(graph: &Graph, index: usize) -> (Vec<Neighbor>, [f64; 2]) {
    let (mut found, mut contested) = (Vec::new(), [0.0_f64; 2]);
    for (end, vertex) in graph.edges[index].ends.into_iter().enumerate() {
        let own = Incidence { edge: index, end };
        let mut precedes = true;
        for &other in &graph.incidences[vertex] {
            if other == own {
                precedes = false;
                continue;
            }
            let neighbor = neighbor(graph, own, other, precedes);
            if neighbor.precedes || neighbor.overhang > 0.0 {
                let zone = if precedes { TIE_ZONE } else { 0.0 };
                contested[end] = contested[end].max(neighbor.overhang).max(zone);
                found.push(neighbor);
            }
        }
    }
    (found, contested)
}

/// How the edge `other` lies to the edge `own`, both seen from their vertex.
fn neighbor(graph: &Graph, own: Incidence, other: Incidence, precedes: bool) -> Neighbor {
    let (along, beside) = (graph.away(own), graph.away(other));
    let (turn, straightness) = (cross(along, beside), -dot(along, beside));
    let is_flat = turn.abs() <= FLAT * straightness;
    let turn = if is_flat { 0.0 } else { f64::from(i8::from(turn > 0.0) - i8::from(turn < 0.0)) };
    Neighbor {
        segment: graph.segments[other.edge],
        end: own.end,
        edge_sign: turn * own.sign(),
        own_sign: -turn * other.sign(),
        overhang: dot(along, beside) / dot(along, along),
        precedes,
    }
}

/// The edges that reach into the region of a vertex, its own apart, and so may hide it from a point there.
pub(super) fn vertex_occluders(graph: &Graph, vertex: usize) -> Vec<usize> {
    let (origin, own) = (graph.vertices[vertex], &graph.incidences[vertex]);
    let outwards = |&incidence: &Incidence| HalfPlane { normal: -graph.away(incidence), origin };
    let region: Vec<HalfPlane> = own.iter().map(outwards).collect();
    reaching(&graph.segments, &region, |edge| own.iter().any(|incidence| incidence.edge == edge))
}

/// The edges that reach into the region of the edge at `index`, its neighbors apart, and so may hide it: where the projection on
/// it falls between its ends, outside of a solid.
pub(super) fn edge_occluders(graph: &Graph, index: usize) -> Vec<usize> {
    let (ends, Segment { start, end }) = (graph.edges[index].ends, graph.segments[index]);
    let along = end - start;
    let mut region =
        vec![HalfPlane { normal: along, origin: start }, HalfPlane { normal: -along, origin: end }];
    if graph.is_solid {
        region.push(HalfPlane { normal: -perpendicular(along), origin: start });
    }
    reaching(&graph.segments, &region, |edge| graph.edges[edge].ends.iter().any(|end| ends.contains(end)))
}

/// The half plane of all points x with normal · (x − origin) ≥ 0.
struct HalfPlane {
    normal: Vec2,
    origin: Vec2,
}

/// The segments of which some part lies in the region, the intersection of the half planes, but for those that
/// `is_own` names.
fn reaching(segments: &[Segment], region: &[HalfPlane], is_own: impl Fn(usize) -> bool) -> Vec<usize> {
    (0..segments.len()).filter(|&index| reaches(&segments[index], region) && !is_own(index)).collect()
}

/// Whether some part of `segment` lies in the region.
fn reaches(segment: &Segment, region: &[HalfPlane]) -> bool {
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    for HalfPlane { normal, origin } in region {
        let at_start = dot(*normal, segment.start - origin);
        let at_end = dot(*normal, segment.end - origin);
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
    use super::*;

    fn polygon(points: &[[f64; 2]]) -> Graph {
        Graph::solid(points.iter().map(|&point| point.into()).collect(), 1)
    }

    #[test]
    fn only_segments_that_reach_into_the_region_occlude() {
        // The region: right of x = 0 and below y = 1.
        let region = [
            HalfPlane { normal: Vec2::new(2.0, 0.0), origin: Vec2::new(0.0, 7.0) },
            HalfPlane { normal: Vec2::new(0.0, -1.0), origin: Vec2::new(3.0, 1.0) },
        ];
        let segments = [
            Segment::new(Vec2::new(-2.0, 0.0), Vec2::new(-1.0, 0.0)),
            Segment::new(Vec2::new(-2.0, 0.0), Vec2::new(1.0, 0.0)),
            Segment::new(Vec2::new(-1.0, 0.5), Vec2::new(1.0, 2.0)),
            Segment::new(Vec2::new(-1.0, -0.5), Vec2::new(1.0, 2.0)),
            Segment::new(Vec2::new(1.0, 0.0), Vec2::new(2.0, 0.0)),
        ];
        assert_eq!(reaching(&segments, &region, |index| index == 4), [1, 3]);
        assert_eq!(reaching(&segments, &region, |_| false), [1, 3, 4]);
    }

    #[test]
    fn nothing_hides_a_feature_of_a_convex_solid() {
        let solid = polygon(&[[0.2, 0.03], [0.15, 0.01], [0.15, -0.02], [0.2, -0.03]]);
        let walls = Graph { is_solid: false, ..solid.clone() };
        for index in 0..4 {
            assert!(vertex_occluders(&solid, index).is_empty());
            assert!(edge_occluders(&solid, index).is_empty());
            // Seen from both sides, opposite walls do hide each other.
            assert_eq!(edge_occluders(&walls, index), [(index + 2) % 4]);
        }
    }

    #[test]
    fn acute_corners_overhang() {
        let graph = polygon(&[[0.0, 0.0], [4.0, 0.0], [3.0, 3.0], [-9.0, 3.0]]);
        // The corners at the end of edge 0 and between edges 2 and 3 are acute.
        let overhangs = |index: usize| {
            let (found, _) = neighbors(&graph, index);
            found.iter().filter(|n| n.overhang > 0.0).map(|n| (n.end, n.overhang)).collect::<Vec<_>>()
        };
        assert_eq!(overhangs(0), [(1, 0.25)]);
        assert_eq!(overhangs(2), [(1, 0.75)]);
        assert_eq!([overhangs(1), overhangs(3)].map(|list| list.len()), [1, 1]);
        let (_, contested) = neighbors(&graph, 0);
        assert_eq!(contested, [TIE_ZONE, 0.25]);
    }
}
