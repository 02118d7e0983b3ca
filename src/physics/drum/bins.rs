//! The boundary in bins of arc length, for profiles along walls.
//!
//! Each part of the drum is divided into equal bins along its outline: a round rim from its angle 0 on, counter-clockwise; the
//! others in the order of their points. A wall that is felt from both sides has one row of bins for both.

use super::feature::FeatureShape;
use super::polygon::length;
use super::segment::{Segment, SegmentRegion};
use super::{Drum, FeatureId, RIM};
use crate::error::Error;
use crate::physics::vector::{Vec2, perpendicular};

/// The most bins of a drum.
const MOST_BINS: f64 = 1e6;

/// A bin of a part's outline, in the drum's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArcBin {
    /// The surface that it is part of.
    pub surface: usize,
    /// Where it begins and ends, along the part's outline [m].
    pub arc: [f64; 2],
    /// Its middle [m].
    pub middle: Vec2,
    /// The unit normal there: into the drum, away from a solid; to the right of a wall as it is drawn.
    pub normal: Vec2,
}

/// All bins of a drum, and which of them a contact falls into.
#[derive(Debug, Clone)]
pub struct ArcBins {
    /// By part, in the order of the outlines.
    pub bins: Vec<ArcBin>,
    /// By surface, its first bin and how many there are in a meter.
    of_surfaces: Vec<(usize, f64)>,
    /// By feature, where an edge begins or a vertex lies, along its part's outline [m].
    arcs: Vec<f64>,
}

impl ArcBins {
    /// Bins of some `width` [m], a little narrower where a part needs it to have whole ones.
    ///
    /// # Errors
    /// `Error::Config` where they would be too many.
    pub fn new(drum: &Drum, width: f64) -> Result<Self, Error> {
        let surfaces = drum.surface_count();
        let rim_length = drum.radius.map_or(0.0, |radius| std::f64::consts::TAU * radius);
        let mut lengths = vec![0.0; surfaces];
        lengths[0] = rim_length;
        let mut arcs = vec![0.0; drum.features.len()];
        let mut edges: Vec<Vec<Segment>> = vec![Vec::new(); surfaces];
        for (arc, feature) in arcs.iter_mut().zip(&drum.features) {
            if let FeatureShape::Edge(edge) = &feature.shape {
                *arc = lengths[feature.surface];
                lengths[feature.surface] += length(edge.segment.vector());
                edges[feature.surface].push(edge.segment);
            }
        }
        for (id, feature) in drum.features.iter().enumerate() {
            if let FeatureShape::Vertex(vertex) = &feature.shape {
                let own = |edge: &&FeatureId| drum.features[**edge as usize].surface == feature.surface;
                // Edges that end here come first; the last one starts here, where any does.
                let Some(&edge) = feature.links.iter().rfind(own) else { continue };
                if let FeatureShape::Edge(shape) = &drum.features[edge as usize].shape {
                    let starts_here = shape.segment.start == vertex.point;
                    let along = if starts_here { 0.0 } else { length(shape.segment.vector()) };
                    arcs[id] = arcs[edge as usize] + along;
                }
            }
        }
        let total: f64 = lengths.iter().map(|length| (length / width).ceil()).sum();
        if total > MOST_BINS {
            let least = lengths.iter().sum::<f64>() / MOST_BINS;
            return Err(Error::config(
                "run.arc_bin",
                width,
                format!("at least {least:.3e}, for {MOST_BINS:e} bins"),
            ));
        }
        let (mut bins, mut of_surfaces) = (Vec::new(), Vec::new());
        for (surface, (&length, edges)) in lengths.iter().zip(&edges).enumerate() {
            let count = (length / width).ceil();
            of_surfaces.push((bins.len(), if length > 0.0 { count / length } else { 0.0 }));
            for index in 0..count as usize {
                let arc = [index, index + 1].map(|end| end as f64 * (length / count));
                let at = 0.5 * (arc[0] + arc[1]);
                let (middle, normal) = match drum.radius.filter(|_| surface == 0) {
                    Some(radius) => {
                        let (sin, cos) = libm::sincos(at / radius);
                        (Vec2::new(cos, sin) * radius, Vec2::new(-cos, -sin))
                    }
                    None => point_at(edges, at),
                };
                bins.push(ArcBin { surface, arc, middle, normal });
            }
        }
        Ok(Self { bins, of_surfaces, arcs })
    }

    /// The bin in which `point` of a feature lies, in the drum's frame.
    pub fn bin_of(&self, drum: &Drum, feature: FeatureId, point: Vec2) -> u32 {
        let surface = drum.surface_of(feature);
        let arc = if feature == RIM {
            let angle = libm::atan2(point.y, point.x);
            let turned = if angle < 0.0 { angle + std::f64::consts::TAU } else { angle };
            turned * drum.radius.unwrap_or_default()
        } else {
            let along = match &drum.features[feature as usize].shape {
                FeatureShape::Edge(edge) => match edge.segment.project(point).region {
                    SegmentRegion::Start => 0.0,
                    SegmentRegion::Between(fraction) => fraction * length(edge.segment.vector()),
                    SegmentRegion::End => length(edge.segment.vector()),
                },
                _ => 0.0,
            };
            self.arcs[feature as usize] + along
        };
        let (first, density) = self.of_surfaces[surface];
        let next = self.of_surfaces.get(surface + 1).map_or(self.bins.len(), |(next, _)| *next);
        // At the very end of an outline the last bin is meant.
        (first + (arc * density) as usize).min(next.saturating_sub(1)) as u32
    }
}

/// The point at an arc length along some edges, and the normal to their right.
fn point_at(edges: &[Segment], arc: f64) -> (Vec2, Vec2) {
    let mut left = arc;
    for edge in edges {
        let own = length(edge.vector());
        if left <= own {
            let along = edge.vector() / own;
            return (edge.start + along * left, -perpendicular(along));
        }
        left -= own;
    }
    edges
        .last()
        .map_or((Vec2::zeros(), Vec2::zeros()), |edge| (edge.end, -perpendicular(edge.vector().normalize())))
}
