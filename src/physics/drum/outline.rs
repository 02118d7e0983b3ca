//! One outline: a baffle, the shell of a drum that is not round, or walls that hang together. Its features and where
//! they are.

use super::FeatureId;
use super::feature::{Edge, Feature, FeatureShape, Spoke, Vertex};
use super::graph::{Element, Graph, GraphEdge, Incidence};
use super::polygon::{contains, signed_area};
use super::segment::{Segment, SegmentRegion};
use super::visibility::{edge_occluders, neighbors, vertex_occluders};
use crate::physics::vector::{Vec2, bounds, cross, dot};

/// Consecutive features that share a bounding box: enough to skip most of a long outline, few enough to be close
/// to each other.
const GROUP: usize = 16;

/// Boxes are widened by this part of a distance, which covers round-off.
const MARGIN: f64 = 1.0 + 1e-9;

/// An outline in the body frame.
#[derive(Debug, Clone)]
pub(super) struct Outline {
    is_solid: bool,
    /// Whether the solid is all that lies outside of it: its points run clockwise.
    is_shell: bool,
    segments: Vec<Segment>,
    /// The id of its first feature.
    first: FeatureId,
    /// Round all of it.
    bounds: Bounds,
    /// Round each `GROUP` of its features.
    groups: Vec<Bounds>,
    feature_count: usize,
}

/// A rectangle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    low: Vec2,
    high: Vec2,
}

impl Outline {
    /// The outline and its features, from a validated graph. Features are counted from `first`, edges from `first_segment`.
    pub(super) fn new(graph: &Graph, first: FeatureId, first_segment: u32) -> (Self, Vec<Feature>) {
        let elements = graph.elements();
        let outline = Self {
            is_solid: graph.is_solid,
            is_shell: graph.is_solid && signed_area(&graph.vertices) < 0.0,
            segments: graph.segments.clone(),
            first,
            bounds: Bounds::of(&graph.vertices),
            groups: elements.chunks(GROUP).map(|group| Bounds::of_elements(graph, group)).collect(),
            feature_count: elements.len(),
        };
        (outline, features(graph, &elements, first, first_segment))
    }

    /// Its edges.
    pub(super) fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// Distance [m] from `point` to the outline, negative inside a solid.
    pub(super) fn signed_distance(&self, point: Vec2) -> f64 {
        let squares = self.segments.iter().map(|segment| segment.distance_squared(point));
        let distance = squares.fold(f64::INFINITY, f64::min).sqrt();
        let inside = self.is_solid && contains(&self.segments, point) != self.is_shell;
        if inside { -distance } else { distance }
    }

    /// Whether `point` lies inside of a solid.
    pub(super) fn contains(&self, point: Vec2) -> bool {
        let is_enclosed = || !self.bounds.is_outside(point, 0.0) && contains(&self.segments, point);
        self.is_solid && is_enclosed() != self.is_shell
    }

    /// Whether the signed distance of `point` is at least `distance` [m]; far from a box round the outline it costs
    /// next to nothing.
    pub(super) fn is_clear(&self, point: Vec2, distance: f64) -> bool {
        let is_beyond = !self.is_shell && self.bounds.is_outside(point, distance * MARGIN);
        is_beyond || self.signed_distance(point) >= distance
    }

    /// Appends every feature at most `reach` [m] away from `center`, in ascending order; `features` are all of the
    /// drum's.
    pub(super) fn features_near(
        &self,
        (center, reach): (Vec2, f64),
        features: &[Feature],
        found: &mut Vec<FeatureId>,
    ) {
        if self.bounds.is_outside(center, reach) {
            return;
        }
        let own = &features[self.first as usize..][..self.feature_count];
        let within = |offset: Vec2| dot(offset, offset) <= reach * reach;
        for (index, (group, bounds)) in own.chunks(GROUP).zip(&self.groups).enumerate() {
            if self.groups.len() > 1 && bounds.is_outside(center, reach * MARGIN) {
                continue;
            }
            let first = self.first + (GROUP * index) as FeatureId;
            for (id, feature) in (first..).zip(group) {
                if feature.closest_point(center).is_some_and(|point| within(point - center)) {
                    found.push(id);
                }
            }
        }
    }
}

impl Bounds {
    /// The box round these points; an empty one at the origin without any.
    fn of(points: &[Vec2]) -> Self {
        let (low, high) = bounds(points).unwrap_or_default();
        Self { low, high }
    }

    fn of_elements(graph: &Graph, elements: &[Element]) -> Self {
        let ends = |element: &Element| match *element {
            Element::Vertex(vertex) => [vertex; 2],
            Element::Edge(edge) => graph.edges[edge].ends,
        };
        let points: Vec<Vec2> = elements.iter().flat_map(ends).map(|vertex| graph.vertices[vertex]).collect();
        Self::of(&points)
    }

    /// The box round the ends of these segments.
    pub(super) fn of_segments(segments: &[Segment]) -> Self {
        let points: Vec<Vec2> = segments.iter().flat_map(|segment| [segment.start, segment.end]).collect();
        Self::of(&points)
    }

    /// Whether two boxes share a point.
    pub(super) fn overlaps(&self, other: &Self) -> bool {
        let apart = |axis: usize| self.low[axis] > other.high[axis] || other.low[axis] > self.high[axis];
        !apart(0) && !apart(1)
    }

    /// Whether `point` is more than `reach` [m] beside the box.
    #[inline]
    fn is_outside(&self, point: Vec2, reach: f64) -> bool {
        let outside = |value: f64, low: f64, high: f64| value < low - reach || value > high + reach;
        outside(point.x, self.low.x, self.high.x) || outside(point.y, self.low.y, self.high.y)
    }
}

/// The features of the elements of a graph.
fn features(graph: &Graph, elements: &[Element], first: FeatureId, first_segment: u32) -> Vec<Feature> {
    let (mut of_vertices, mut of_edges) = (vec![0; graph.vertices.len()], vec![0; graph.edges.len()]);
    for (id, element) in (first..).zip(elements) {
        match *element {
            Element::Vertex(vertex) => of_vertices[vertex] = id,
            Element::Edge(edge) => of_edges[edge] = id,
        }
    }
    // Edges of this outline as segments of the drum.
    let in_drum = |edges: Vec<usize>| edges.iter().map(|&edge| first_segment + edge as u32).collect();
    let feature = |element: &Element| match *element {
        Element::Vertex(vertex) => {
            let edges = graph.incidences[vertex].iter().map(|incidence| incidence.edge);
            Feature {
                surface: edges.clone().map(|edge| graph.edges[edge].surface).min().unwrap_or(0),
                links: edges.map(|edge| of_edges[edge]).collect(),
                shape: FeatureShape::Vertex(vertex_shape(
                    graph,
                    vertex,
                    in_drum(vertex_occluders(graph, vertex)),
                )),
            }
        }
        Element::Edge(index) => {
            let (neighbors, contested) = neighbors(graph, index);
            let GraphEdge { ends, surface } = graph.edges[index];
            let edge = Edge {
                segment: graph.segments[index],
                is_solid: graph.is_solid,
                contested,
                neighbors: neighbors.into(),
                occluders: in_drum(edge_occluders(graph, index)),
            };
            Feature {
                shape: FeatureShape::Edge(edge),
                links: ends.map(|vertex| of_vertices[vertex]).into(),
                surface,
            }
        }
    };
    elements.iter().map(feature).collect()
}

fn vertex_shape(graph: &Graph, vertex: usize, occluders: Box<[u32]>) -> Vertex {
    let spoke = |&Incidence { edge, end }: &Incidence| Spoke {
        segment: graph.segments[edge],
        region: if end == 0 { SegmentRegion::Start } else { SegmentRegion::End },
    };
    let spokes: Box<[Spoke]> = graph.incidences[vertex].iter().map(spoke).collect();
    let is_concave = graph.is_solid
        && matches!(&*spokes, [into, out] if cross(into.segment.vector(), out.segment.vector()) < 0.0);
    Vertex { point: graph.vertices[vertex], spokes, is_concave, occluders }
}
