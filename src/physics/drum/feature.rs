//! One feature of an outline, an edge or a vertex, and the proximity of a point to it.
//!
//! The plane around an outline is divided among its features: an edge answers where the projection falls
//! between its ends, a vertex where all its edges clamp to it. Both ask the same clamped projection, so that
//! neither gap nor overlap opens between them. Features keep copies of the segments around them: this is asked
//! for every contact in every step, and nothing has to be looked up.

use super::polygon::length;
use super::segment::{Segment, SegmentRegion};
use super::{FeatureId, Proximity};
use crate::physics::vector::{Vec2, perpendicular};

/// A feature and its neighbors.
#[derive(Debug, Clone)]
pub(super) struct Feature {
    pub(super) shape: FeatureShape,
    /// The edges of a vertex, the vertices of an edge.
    pub(super) links: Box<[FeatureId]>,
    /// The surface that it is part of.
    pub(super) surface: usize,
}

/// A feature with all that its proximity needs.
#[derive(Debug, Clone)]
pub(super) enum FeatureShape {
    /// The rim, which is not asked here.
    Rim,
    Vertex(Vertex),
    Edge(Edge),
}

/// A point where edges meet, or where a wall ends.
#[derive(Debug, Clone)]
pub(super) struct Vertex {
    pub(super) point: Vec2,
    /// The edges that end here, then those that start here; at least one.
    pub(super) spokes: Box<[Spoke]>,
    /// Whether it is a corner of a solid whose angle outside is below 180°.
    pub(super) is_concave: bool,
    /// The segments that may stand in front of it, as indices.
    pub(super) occluders: Box<[u32]>,
}

/// An edge of a vertex.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spoke {
    pub(super) segment: Segment,
    /// Where the closest point of the segment lies for points that are the vertex's.
    pub(super) region: SegmentRegion,
}

/// A straight part of an outline.
#[derive(Debug, Clone)]
pub(super) struct Edge {
    pub(super) segment: Segment,
    /// Whether it is felt from its right side only, the left being inside of a solid.
    pub(super) is_solid: bool,
    /// The fractions of the edge from its start and from its end within which neighbors have a say.
    pub(super) contested: [f64; 2],
    /// The edges it shares a vertex with, as far as they may have a say.
    pub(super) neighbors: Box<[Neighbor]>,
    /// The segments that may stand in front of it, as indices.
    pub(super) occluders: Box<[u32]>,
}

/// An edge that shares a vertex with another one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Neighbor {
    pub(super) segment: Segment,
    /// At which end of the other edge it is: 0 its start, 1 its end.
    pub(super) end: usize,
    /// The sign of the other edge's `left_of` where the neighbor lies; 0 where that goes straight on.
    pub(super) edge_sign: f64,
    /// The sign of the neighbor's own `left_of` where the other edge lies; 0 where that goes straight on.
    pub(super) own_sign: f64,
    /// The fraction of the other edge that the neighbor overhangs, counted from their vertex; positive at acute
    /// corners only.
    pub(super) overhang: f64,
    /// Whether it has the say where both claim a point.
    pub(super) precedes: bool,
}

impl Feature {
    /// The point of the feature that is closest to `center`.
    #[inline]
    pub(super) fn closest_point(&self, center: Vec2) -> Option<Vec2> {
        match &self.shape {
            FeatureShape::Rim => None,
            FeatureShape::Vertex(vertex) => Some(vertex.point),
            FeatureShape::Edge(edge) => Some(edge.segment.project(center).point),
        }
    }

    /// Proximity of `center`; none where another feature has the say, where `center` is inside the solid, or
    /// where another of these `segments` hides the feature.
    #[inline]
    pub(super) fn proximity(&self, center: Vec2, segments: &[Segment]) -> Option<Proximity> {
        match &self.shape {
            FeatureShape::Rim => None,
            FeatureShape::Vertex(vertex) => vertex.proximity(center, segments),
            FeatureShape::Edge(edge) => edge.proximity(center, segments),
        }
    }
}

impl Vertex {
    #[inline]
    fn proximity(&self, center: Vec2, segments: &[Segment]) -> Option<Proximity> {
        let clamps = |spoke: &Spoke| spoke.segment.project(center).region == spoke.region;
        if !self.spokes.iter().all(clamps) {
            return None;
        }
        // All clamp to a concave corner only inside the solid, or by round-off where it is all but straight.
        if self.is_concave && self.spokes.iter().any(|spoke| spoke.segment.left_of(center) > 0.0) {
            return None;
        }
        let last = self.spokes.last()?;
        is_visible(self.point, center, &self.occluders, segments)
            .then(|| toward(self.point, center, &last.segment))
    }
}

impl Edge {
    #[inline]
    fn proximity(&self, center: Vec2, segments: &[Segment]) -> Option<Proximity> {
        let projection = self.segment.project(center);
        let SegmentRegion::Between(fraction) = projection.region else { return None };
        if self.is_solid && self.segment.left_of(center) > 0.0 {
            return None;
        }
        let from_ends = [fraction, 1.0 - fraction];
        let is_contested = from_ends[0] < self.contested[0] || from_ends[1] < self.contested[1];
        if is_contested && self.yields(from_ends, center) {
            return None;
        }
        is_visible(projection.point, center, &self.occluders, segments)
            .then(|| toward(projection.point, center, &self.segment))
    }

    /// Whether a neighbor stands in front of it, or claims `center` as well though the corner between them is
    /// convex on that side: then only round-off lets both projections fall between the ends.
    fn yields(&self, from_ends: [f64; 2], center: Vec2) -> bool {
        let left = self.segment.left_of(center);
        self.neighbors.iter().any(|neighbor| {
            if neighbor.own_sign * neighbor.segment.left_of(center) > 0.0 {
                false
            } else if neighbor.edge_sign * left > 0.0 {
                from_ends[neighbor.end] < neighbor.overhang
            } else {
                neighbor.precedes
                    && matches!(neighbor.segment.project(center).region, SegmentRegion::Between(_))
            }
        })
    }
}

/// Whether none of the occluders stands between `center` and `point`.
#[inline]
fn is_visible(point: Vec2, center: Vec2, occluders: &[u32], segments: &[Segment]) -> bool {
    if occluders.is_empty() {
        return true;
    }
    let ray = Segment::new(center, point);
    !occluders.iter().any(|&index| segments[index as usize].crosses(&ray))
}

/// The proximity of `center` to `point`. Where they coincide any normal serves, so the left one of `segment` does.
#[inline]
fn toward(point: Vec2, center: Vec2, segment: &Segment) -> Proximity {
    let offset = point - center;
    let distance = length(offset);
    if distance > 0.0 {
        return Proximity { distance, direction: offset / distance };
    }
    let normal = perpendicular(segment.vector());
    Proximity { distance, direction: normal / length(normal) }
}
