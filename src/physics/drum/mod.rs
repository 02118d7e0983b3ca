//! The drum in its own frame: a rim, handled analytically, or the shell of a drum that is not round, and outlines
//! (baffles, straight walls), whose edges are queried with parry2d.
//!
//! A `Drum` never moves; `rotation` says how its frame turns. What a disc can touch is counted in features:
//! the rim, and every edge and vertex of the outlines. Each contact belongs to one of them. Walls that meet are
//! one outline. A shell is an outline whose solid lies outside of it; to users it is the rim. Lengths enter by
//! comparison with each other only, so that a drum four times as large answers with the same bits, scaled.

pub mod baffle;
pub mod bins;
mod feature;
mod graph;
mod network;
mod outline;
mod parameters;
mod polygon;
mod rounding;
mod segment;
mod validate;
mod visibility;
pub mod zone;

use crate::error::Error;
use crate::physics::vector::Vec2;
use baffle::part_names;
use feature::{Feature, FeatureShape};
use graph::Graph;
use outline::Outline;
pub use parameters::DrumParameters;
use polygon::length;
use segment::Segment;
pub use validate::MOST_BAFFLES;

/// A smooth part of the boundary that can carry one contact: the rim, an edge or a vertex. The rim is 0; the
/// outlines follow, baffles first, each in boundary order: vertex, edge, vertex, edge, …
pub type FeatureId = u32;

/// The rim's feature; reserved even where the drum has no rim.
pub const RIM: FeatureId = 0;

/// Where the boundary is, seen from the center of a disc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Proximity {
    /// Distance [m] to the closest point of the feature, at least 0.
    pub distance: f64,
    /// Unit vector towards that point.
    pub direction: Vec2,
}

/// A validated drum in its body frame.
#[derive(Debug, Clone)]
pub struct Drum {
    radius: Option<f64>,
    bounding_radius: Option<f64>,
    /// The points of a shell, in clockwise order.
    shell: Option<Vec<Vec2>>,
    baffle_count: usize,
    /// The points of the baffles, then of the walls, as users see them.
    shapes: Vec<Vec<Vec2>>,
    /// What users call the surfaces.
    names: Vec<String>,
    /// The shell, the baffles, then what the walls make up.
    outlines: Vec<Outline>,
    /// Number of those that are solid: shell and baffles.
    solid_count: usize,
    /// All features by id.
    features: Vec<Feature>,
    /// The edges of all outlines.
    segments: Vec<Segment>,
    /// Every solid but the rim lies at least this far [m] from the axis.
    free_radius: f64,
}

impl Drum {
    /// Builds the drum; refuses what `DrumParameters::validate` refuses.
    pub fn new(parameters: &DrumParameters) -> Result<Self, Error> {
        parameters.validate()?;
        let sets = &parameters.baffles;
        let baffles: Vec<_> = sets.iter().flat_map(|set| set.outlines(parameters.radius)).collect();
        let walls = parameters.walls.iter().map(|wall| polygon::vectors(wall));
        let named = sets.iter().map(|set| (set.name.as_str(), set.count));
        let parts = part_names(named.chain([("wall", parameters.walls.len())]));
        let mut drum = Self {
            radius: parameters.radius,
            bounding_radius: parameters.bounding_radius(),
            shell: parameters.shell_corners(),
            baffle_count: baffles.len(),
            shapes: baffles.iter().cloned().chain(walls).collect(),
            names: std::iter::once("rim".to_owned()).chain(parts).collect(),
            outlines: Vec::new(),
            solid_count: 0,
            features: vec![Feature { shape: FeatureShape::Rim, links: [].into(), surface: 0 }],
            segments: Vec::new(),
            free_radius: f64::INFINITY,
        };
        if let Some(shell) = drum.shell.clone() {
            drum.push(&Graph::solid(shell, 0));
        }
        for (index, points) in baffles.into_iter().enumerate() {
            drum.push(&Graph::solid(points, 1 + index));
        }
        drum.solid_count = drum.outlines.len();
        let clearances = drum.outlines.iter().map(|solid| solid.signed_distance(Vec2::zeros()));
        drum.free_radius = clearances.fold(f64::INFINITY, f64::min);
        parameters.joined_walls()?.iter().for_each(|walls| drum.push(walls));
        Ok(drum)
    }

    /// Appends an outline.
    fn push(&mut self, graph: &Graph) {
        let (outline, features) = Outline::new(graph, self.feature_count(), self.segments.len() as u32);
        self.features.extend(features);
        self.segments.extend_from_slice(outline.segments());
        self.outlines.push(outline);
    }

    /// Radius of the rim [m].
    pub fn radius(&self) -> Option<f64> {
        self.radius
    }

    /// Radius [m] of the smallest circle round the axis that holds all free space; none where that has no end.
    pub fn bounding_radius(&self) -> Option<f64> {
        self.bounding_radius
    }

    /// The corners of the shell in the body frame, clockwise, where the drum has one for a rim.
    pub fn shell(&self) -> Option<&[Vec2]> {
        self.shell.as_deref()
    }

    /// The points of every baffle (a closed polygon, counter-clockwise), then of every wall, as it was drawn, in
    /// the body frame.
    pub fn outlines(&self) -> impl Iterator<Item = &[Vec2]> {
        self.shapes.iter().map(Vec::as_slice)
    }

    /// Radius [m] of a circle about the axis that touches no solid.
    pub fn clear_radius(&self) -> f64 {
        self.radius.map_or(self.free_radius, |radius| radius.min(self.free_radius))
    }

    /// Number of baffles.
    pub fn baffle_count(&self) -> usize {
        self.baffle_count
    }

    /// Number of features, the rim included; every feature's id is below it.
    pub fn feature_count(&self) -> FeatureId {
        self.features.len() as FeatureId
    }

    /// Whether a disc can touch anything but a round rim.
    #[inline]
    pub fn has_outlines(&self) -> bool {
        !self.outlines.is_empty()
    }

    /// Number of surfaces that forces and work are counted for: the rim or shell, each baffle, each wall.
    pub fn surface_count(&self) -> usize {
        1 + self.shapes.len()
    }

    /// The surface that a feature is part of: 0 the rim, then the baffles, then the walls. The vertex at which
    /// walls meet is part of the first of them.
    #[inline]
    pub fn surface_of(&self, feature: FeatureId) -> usize {
        self.features.get(feature as usize).map_or(0, |feature| feature.surface)
    }

    /// What users call a surface: "rim" (a shell, too), "baffle 1", "lifter 3", "wall 2".
    pub fn surface_name(&self, surface: usize) -> &str {
        &self.names[surface]
    }

    /// What users call the surfaces, in their order.
    pub fn surface_names(&self) -> &[String] {
        &self.names
    }

    /// Appends, in ascending order, every feature of an outline (never the rim) whose distance from `center`
    /// (body frame) is at most `reach` [m].
    pub fn features_near(&self, center: Vec2, reach: f64, found: &mut Vec<FeatureId>) {
        let clear_of_solids = length(center) + reach < self.free_radius;
        let skipped = if clear_of_solids { self.solid_count } else { 0 };
        for outline in &self.outlines[skipped..] {
            outline.features_near((center, reach), &self.features, found);
        }
    }

    /// Proximity of `center` (body frame) to a feature of an outline.
    ///
    /// None where the closest point of the outline locally belongs to another feature: an edge answers where
    /// the projection falls between its ends, a vertex where all its edges clamp to it, the end of a wall where
    /// its one edge does. So exactly one answers round a convex corner, with distance and direction continuous;
    /// in a concave corner both edges do, and the vertex never. None also inside a baffle, where another edge of
    /// the same outline stands in between, and for the rim.
    #[inline]
    pub fn proximity(&self, feature: FeatureId, center: Vec2) -> Option<Proximity> {
        self.features.get(feature as usize)?.proximity(center, &self.segments)
    }

    /// Distance [m] of `center` (body frame) from a feature of an outline, whether that feature answers or not: never more
    /// than its proximity says. Infinite for the rim.
    pub fn distance_to(&self, feature: FeatureId, center: Vec2) -> f64 {
        let closest = self.features.get(feature as usize).and_then(|feature| feature.closest_point(center));
        closest.map_or(f64::INFINITY, |point| length(point - center))
    }

    /// Whether the history of a contact passes between two features: they are parts of the same outline, at
    /// most two places apart along it, through whatever vertex. Two, because a disc may pass a blunt vertex
    /// within one step.
    pub fn adjacent(&self, a: FeatureId, b: FeatureId) -> bool {
        let linked = |id: FeatureId| self.features.get(id as usize).map_or(&[][..], |feature| &feature.links);
        a == b || linked(a).iter().any(|&between| between == b || linked(between).contains(&b))
    }

    /// Signed distance [m] from `point` (body frame) to the nearest solid: negative outside the rim or shell or
    /// inside a baffle, infinite where there is no boundary at all.
    pub fn clearance(&self, point: Vec2) -> f64 {
        let rim = self.radius.map_or(f64::INFINITY, |radius| radius - length(point));
        self.outlines.iter().map(|outline| outline.signed_distance(point)).fold(rim, f64::min)
    }

    /// Whether the clearance of `point` is at least `distance` [m]; outlines far away cost next to nothing.
    pub fn is_clear(&self, point: Vec2, distance: f64) -> bool {
        self.radius.is_none_or(|radius| radius - length(point) >= distance)
            && self.outlines.iter().all(|outline| outline.is_clear(point, distance))
    }

    /// The surface whose solid contains `point` (body frame): the rim or shell outside of it, or a baffle. None in free
    /// space, which costs next to nothing to find out. Walls have no inside.
    #[inline]
    pub fn solid_at(&self, point: Vec2) -> Option<usize> {
        let distance = length(point);
        if self.radius.is_some_and(|radius| distance > radius) {
            return Some(0);
        }
        if distance < self.free_radius {
            return None;
        }
        let solid = self.outlines[..self.solid_count].iter().position(|solid| solid.contains(point))?;
        Some(solid + usize::from(self.shell.is_none()))
    }
}
