//! What outlines are made of: vertices, and straight edges between them.

use super::segment::Segment;
use crate::physics::vector::Vec2;

/// Vertices and the edges between them: a polygon, a polyline, or walls that meet in any number at a vertex.
#[derive(Debug, Clone)]
pub(super) struct Graph {
    /// Where each vertex is.
    pub(super) vertices: Vec<Vec2>,
    /// In the order in which they were drawn; no two have the same ends.
    pub(super) edges: Vec<GraphEdge>,
    /// The same as segments.
    pub(super) segments: Vec<Segment>,
    /// For each vertex its edges: first those that end there, then those that start there.
    pub(super) incidences: Vec<Vec<Incidence>>,
    /// Whether it is a closed polygon, felt from its right only: from outside where its points run counter-clockwise, from
    /// inside where they run clockwise. Others are lines felt from both sides.
    pub(super) is_solid: bool,
}

/// A directed straight edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct GraphEdge {
    /// The vertices it starts and ends at; they differ.
    pub(super) ends: [usize; 2],
    /// The surface that it is part of.
    pub(super) surface: usize,
}

/// A vertex or an edge, by index.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Element {
    Vertex(usize),
    Edge(usize),
}

/// An edge as seen from one of its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Incidence {
    /// Index of the edge.
    pub(super) edge: usize,
    /// 0 where the vertex is its start, 1 where it is its end.
    pub(super) end: usize,
}

impl Incidence {
    /// 1 where the edge runs away from the vertex, −1 where it runs towards it.
    pub(super) fn sign(self) -> f64 {
        if self.end == 0 { 1.0 } else { -1.0 }
    }
}

impl Graph {
    /// Lines without thickness.
    pub(super) fn new(vertices: Vec<Vec2>, edges: Vec<GraphEdge>) -> Self {
        let segment = |edge: &GraphEdge| Segment::new(vertices[edge.ends[0]], vertices[edge.ends[1]]);
        let segments = edges.iter().map(segment).collect();
        let mut incidences = vec![Vec::new(); vertices.len()];
        for end in [1, 0] {
            for (index, edge) in edges.iter().enumerate() {
                incidences[edge.ends[end]].push(Incidence { edge: index, end });
            }
        }
        Self { vertices, edges, segments, incidences, is_solid: false }
    }

    /// A solid, part of one surface.
    pub(super) fn solid(vertices: Vec<Vec2>, surface: usize) -> Self {
        let count = vertices.len();
        let edge = |index: usize| GraphEdge { ends: [index, (index + 1) % count], surface };
        Self { is_solid: true, ..Self::new(vertices, (0..count).map(edge).collect()) }
    }

    /// The vector of an edge, from the end that is seen to the other one.
    pub(super) fn away(&self, incidence: Incidence) -> Vec2 {
        self.segments[incidence.edge].vector() * incidence.sign()
    }

    /// Vertices and edges in boundary order: every edge after the vertex it starts at, and before the vertex it
    /// ends at if that has not come yet.
    pub(super) fn elements(&self) -> Vec<Element> {
        let mut listed = vec![false; self.vertices.len()];
        let mut elements = Vec::with_capacity(self.vertices.len() + self.edges.len());
        for (index, edge) in self.edges.iter().enumerate() {
            let [start, end] = edge.ends;
            if !std::mem::replace(&mut listed[start], true) {
                elements.push(Element::Vertex(start));
            }
            elements.push(Element::Edge(index));
            if !std::mem::replace(&mut listed[end], true) {
                elements.push(Element::Vertex(end));
            }
        }
        elements
    }

    /// The connected parts in the order of their first edges, their vertices counted in boundary order.
    pub(super) fn components(&self) -> Vec<Self> {
        let mut sets = UnionFind::new(self.vertices.len());
        for GraphEdge { ends: [start, end], .. } in &self.edges {
            sets.unite(*start, *end);
        }
        let mut component_of = vec![None; self.vertices.len()];
        let mut local = vec![None; self.vertices.len()];
        let mut components: Vec<(Vec<Vec2>, Vec<GraphEdge>)> = Vec::new();
        for &GraphEdge { ends, surface } in &self.edges {
            let index = *component_of[sets.find(ends[0])].get_or_insert(components.len());
            if index == components.len() {
                components.push(Default::default());
            }
            let (vertices, edges) = &mut components[index];
            let ends = ends.map(|vertex| {
                *local[vertex].get_or_insert_with(|| {
                    vertices.push(self.vertices[vertex]);
                    vertices.len() - 1
                })
            });
            edges.push(GraphEdge { ends, surface });
        }
        components.into_iter().map(|(vertices, edges)| Self::new(vertices, edges)).collect()
    }
}

/// Disjoint sets of the numbers 0, 1, … (union-find): points that coincide, edges that hang together. The least member stands for
/// its set.
#[derive(Debug, Clone, Default)]
pub(super) struct UnionFind {
    parents: Vec<usize>,
}

impl UnionFind {
    /// `count` sets of one member each.
    pub(super) fn new(count: usize) -> Self {
        Self { parents: (0..count).collect() }
    }

    /// Adds the next number as a set of its own.
    pub(super) fn push(&mut self) {
        self.parents.push(self.parents.len());
    }

    /// The least member of the set that `member` belongs to.
    pub(super) fn find(&mut self, mut member: usize) -> usize {
        while self.parents[member] != member {
            // Halves the path, so that later walks are short.
            self.parents[member] = self.parents[self.parents[member]];
            member = self.parents[member];
        }
        member
    }

    /// Makes one set of the sets of `a` and `b`.
    pub(super) fn unite(&mut self, a: usize, b: usize) {
        let (a, b) = (self.find(a), self.find(b));
        self.parents[a.max(b)] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn graph(ends: &[[usize; 2]], count: u32) -> Graph {
        let edges = ends.iter().map(|&ends| GraphEdge { ends, surface: 1 }).collect();
        Graph::new((0..count).map(|x| Vec2::new(f64::from(x), 0.0)).collect(), edges)
    }

    #[test]
    fn elements_come_in_boundary_order() {
        use Element::{Edge, Vertex};
        let open = graph(&[[0, 1], [1, 2]], 3);
        assert_eq!(open.elements(), [Vertex(0), Edge(0), Vertex(1), Edge(1), Vertex(2)]);
        let closed = graph(&[[0, 1], [1, 2], [2, 0]], 3);
        assert_eq!(closed.elements(), [Vertex(0), Edge(0), Vertex(1), Edge(1), Vertex(2), Edge(2)]);
        let last_first = |vertex: usize| closed.incidences[vertex].iter().map(|i| i.edge).collect::<Vec<_>>();
        assert_eq!([last_first(0), last_first(1)], [[2, 0], [0, 1]]);
    }

    #[test]
    fn components_are_what_hangs_together() {
        let parts = graph(&[[4, 2], [0, 1], [2, 3]], 5).components();
        let ends = |part: &Graph| part.edges.iter().map(|edge| edge.ends).collect::<Vec<_>>();
        assert_eq!(parts.iter().map(ends).collect::<Vec<_>>(), [vec![[0, 1], [1, 2]], vec![[0, 1]]]);
        assert_eq!(parts[0].vertices.iter().map(|vertex| vertex.x).collect::<Vec<_>>(), [4.0, 2.0, 3.0]);
    }
}
