//! The drum in its own frame: a rim, handled analytically, and outlines (baffles, straight walls), queried
//! with parry2d.
//!
//! A `Drum` never moves; `rotation` says how its frame turns. What a disc can touch is counted in features:
//! the rim, and every edge and vertex of the outlines. Each contact belongs to one of them. Lengths enter by
//! comparison with each other only, so that a drum four times as large answers with the same bits, scaled.

pub mod baffle;
mod outline;
mod polygon;
mod segment;
#[cfg(test)]
mod tests;
mod validate;
mod visibility;

use serde::{Deserialize, Serialize};

use crate::error::{Error, require_finite, require_positive};
use crate::physics::vector::Vec2;
use baffle::BaffleParameters;
use outline::{Kind, Outline};
use polygon::length;

/// A smooth part of the boundary that can carry one contact: the rim, an edge or a vertex. The rim is 0; the
/// outlines follow, baffles first, each in boundary order: vertex 0, edge 0, vertex 1, edge 1, …
pub type FeatureId = u32;

/// The rim's feature; reserved even where the drum has no rim.
pub const RIM: FeatureId = 0;

/// Rim, baffles and straight walls, as a user describes them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DrumParameters {
    /// Radius of the rim [m]; none leaves the drum without a rim.
    #[serde(deserialize_with = "Option::deserialize")]
    pub radius: Option<f64>,
    /// The baffles.
    pub baffles: BaffleParameters,
    /// Open polylines without thickness, felt from both sides, as points [m] in the drum's frame; they turn
    /// with it. A polyline that ends at its first point is closed. Walls do not know of each other: a corner
    /// belongs inside one polyline.
    pub walls: Vec<Vec<[f64; 2]>>,
}

impl DrumParameters {
    /// Checks every number, and the shapes against the rim, the axis and each other.
    pub fn validate(&self) -> Result<(), Error> {
        if let Some(radius) = self.radius {
            // Users write the diameter.
            require_positive("drum.diameter", 2.0 * radius)?;
        }
        self.baffles.validate(self.radius)?;
        self.validate_size()?;
        self.walls.iter().enumerate().try_for_each(|(index, wall)| validate_wall(index + 1, wall))
    }

    /// Refuses outlines of so many corners that they would take memory and time without bound.
    fn validate_size(&self) -> Result<(), Error> {
        let (each, all) = MOST_CORNERS;
        let corners = self.baffles.corner_count();
        let longest = self.walls.iter().map(Vec::len).max().unwrap_or(0);
        let of_walls = self.walls.iter().map(Vec::len).sum::<usize>();
        let refuse = |key: &str, found: usize, limit: usize, of: &str| {
            Err(Error::config(key, format!("of {found} corners{of}"), format!("of at most {limit}")))
        };
        if corners > each {
            refuse("drum.baffles.points", corners, each, "")
        } else if longest > each {
            refuse("drum.walls", longest, each, " in one wall")
        } else if of_walls + self.baffles.count.saturating_mul(corners) > all {
            let found = of_walls + self.baffles.count.saturating_mul(corners);
            refuse("drum", found, all, " in baffles and walls together")
        } else {
            Ok(())
        }
    }
}

/// The most corners that one outline may have, and all together: a corner may be hidden by every side of its outline, so
/// that time and memory to find out grow with the square of the one and with the product of both.
const MOST_CORNERS: (usize, usize) = (1000, 20_000);

/// Checks the wall that a user counts as `number`.
fn validate_wall(number: usize, wall: &[[f64; 2]]) -> Result<(), Error> {
    for coordinate in wall.iter().flatten() {
        require_finite("drum.walls", *coordinate)?;
    }
    let refuse = |problem: String, limit: &str| {
        Err(Error::config("drum.walls", format!("a list whose wall {number} {problem}"), limit))
    };
    if wall.len() < 2 {
        let plural = if wall.len() == 1 { "" } else { "s" };
        return refuse(format!("has {} point{plural}", wall.len()), "a list of walls of at least 2 points");
    }
    let points: Vec<Vec2> = wall.iter().map(|&point| point.into()).collect();
    let sides = polygon::sides(&points, false);
    if let Some(side) = polygon::empty_side(&sides) {
        let problem = format!("has a side {} without length", side + 1);
        return refuse(problem, "a list of walls of distinct points");
    }
    if let Some(corner) = sides.windows(2).position(|pair| polygon::folds_back(&pair[0], &pair[1])) {
        let problem = format!("folds back on itself at point {}", corner + 2);
        return refuse(problem, "a list of walls that do not");
    }
    Ok(())
}

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
    baffle_count: usize,
    /// Baffles, then walls.
    outlines: Vec<Outline>,
    /// The feature of each outline's first vertex.
    firsts: Vec<FeatureId>,
    /// The outline of each feature but the rim: entry f − 1 for feature f.
    owners: Vec<u32>,
    /// Every baffle lies at least this far [m] from the axis.
    free_radius: f64,
}

impl Drum {
    /// Builds the drum; refuses what `DrumParameters::validate` refuses.
    pub fn new(parameters: &DrumParameters) -> Result<Self, Error> {
        parameters.validate()?;
        let baffles = parameters.radius.map_or_else(Vec::new, |radius| parameters.baffles.outlines(radius));
        let baffle_count = baffles.len();
        let walls = parameters.walls.iter().map(|wall| wall.iter().map(|&point| point.into()).collect());
        let outlines: Vec<Outline> = (baffles.into_iter().map(|points| Outline::new(points, Kind::Solid)))
            .chain(walls.map(|points| Outline::new(points, Kind::Wall)))
            .collect();
        let (mut firsts, mut owners) = (Vec::new(), Vec::new());
        for (index, outline) in outlines.iter().enumerate() {
            firsts.push(owners.len() as FeatureId + RIM + 1);
            owners.resize(owners.len() + outline.feature_count(), index as u32);
        }
        let clearances = outlines[..baffle_count].iter().map(|baffle| baffle.signed_distance(Vec2::zeros()));
        let free_radius = clearances.fold(f64::INFINITY, f64::min);
        Ok(Self { radius: parameters.radius, baffle_count, outlines, firsts, owners, free_radius })
    }

    /// Radius of the rim [m].
    pub fn radius(&self) -> Option<f64> {
        self.radius
    }

    /// The points of every outline in the body frame, baffles (closed polygons, counter-clockwise) then
    /// walls.
    pub fn outlines(&self) -> impl Iterator<Item = &[Vec2]> {
        self.outlines.iter().map(Outline::points)
    }

    /// Number of baffles.
    pub fn baffle_count(&self) -> usize {
        self.baffle_count
    }

    /// Number of walls.
    pub fn wall_count(&self) -> usize {
        self.outlines.len() - self.baffle_count
    }

    /// Number of features, the rim included; every feature's id is below it.
    pub fn feature_count(&self) -> FeatureId {
        self.owners.len() as FeatureId + 1
    }

    /// Number of surfaces that forces and work are counted for: the rim, each baffle, each wall.
    pub fn surface_count(&self) -> usize {
        1 + self.outlines.len()
    }

    /// The surface that a feature is part of: 0 the rim, then the outlines.
    #[inline]
    pub fn surface_of(&self, feature: FeatureId) -> usize {
        self.owner(feature).map_or(0, |owner| owner + 1)
    }

    /// Appends, in ascending order, every feature of an outline (never the rim) whose distance from `center`
    /// (body frame) is at most `reach` [m].
    pub fn features_near(&self, center: Vec2, reach: f64, found: &mut Vec<FeatureId>) {
        let clear_of_baffles = length(center) + reach < self.free_radius;
        let skipped = if clear_of_baffles { self.baffle_count } else { 0 };
        for (outline, &first) in self.outlines.iter().zip(&self.firsts).skip(skipped) {
            outline.features_near(center, reach, first, found);
        }
    }

    /// Proximity of `center` (body frame) to a feature of an outline.
    ///
    /// None where the closest point of the outline locally belongs to another feature: an edge answers where
    /// the projection falls between its ends, a vertex where both its edges clamp to it, the end of a wall
    /// where its one edge does. So exactly one answers round a convex corner, with distance and direction
    /// continuous; in a concave corner both edges do, and the vertex never. None also inside a baffle, where
    /// another side of the same outline stands in between, and for the rim.
    #[inline]
    pub fn proximity(&self, feature: FeatureId, center: Vec2) -> Option<Proximity> {
        let owner = self.owner(feature)?;
        self.outlines[owner].proximity((feature - self.firsts[owner]) as usize, center)
    }

    /// Whether the history of a contact passes between two features: they are parts of the same outline, at
    /// most two places apart along it. Two, because a disc may pass a blunt vertex within one step.
    pub fn adjacent(&self, a: FeatureId, b: FeatureId) -> bool {
        match (self.owner(a), self.owner(b)) {
            (Some(owner), Some(other)) if owner == other => {
                let first = self.firsts[owner];
                self.outlines[owner].places_apart((a - first) as usize, (b - first) as usize) <= 2
            }
            _ => a == b,
        }
    }

    /// Signed distance [m] from `point` (body frame) to the nearest solid: negative outside the rim or inside
    /// a baffle, infinite where there is no boundary at all.
    pub fn clearance(&self, point: Vec2) -> f64 {
        let rim = self.radius.map_or(f64::INFINITY, |radius| radius - length(point));
        self.outlines.iter().map(|outline| outline.signed_distance(point)).fold(rim, f64::min)
    }

    /// Whether the clearance of `point` is at least `distance` [m]; outlines far away cost next to nothing.
    pub fn is_clear(&self, point: Vec2, distance: f64) -> bool {
        self.radius.is_none_or(|radius| radius - length(point) >= distance)
            && self.outlines.iter().all(|outline| {
                outline.is_beyond(point, distance) || outline.signed_distance(point) >= distance
            })
    }

    /// The index of the outline that a feature is part of; none for the rim.
    #[inline]
    fn owner(&self, feature: FeatureId) -> Option<usize> {
        self.owners.get((feature as usize).checked_sub(1)?).map(|&owner| owner as usize)
    }
}
