//! The drum as a user describes it, and what of it is refused.

use serde::{Deserialize, Serialize};

use super::baffle::BaffleParameters;
use super::graph::Graph;
use super::{network, polygon};
use crate::error::{Error, require, require_finite, require_positive};
use crate::physics::vector::Vec2;

/// Rim, baffles and straight walls, as a user describes them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DrumParameters {
    /// Radius of the rim [m]; none leaves the drum without a rim.
    #[serde(deserialize_with = "Option::deserialize")]
    pub radius: Option<f64>,
    /// The baffles.
    pub baffles: BaffleParameters,
    /// Polylines without thickness, felt from both sides, as points [m] in the drum's frame; they turn with it. A
    /// polyline that ends at its first point is closed. Where polylines share a point, end to end or in a T or X,
    /// they are one: a disc feels the joint as it feels a corner.
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
        self.walls.iter().enumerate().try_for_each(|(index, wall)| validate_wall(index + 1, wall))?;
        self.joined_walls().map(drop)
    }

    /// The walls, validated one by one, as outlines: what meets is one.
    pub(super) fn joined_walls(&self) -> Result<Vec<Graph>, Error> {
        let baffles = if self.radius.is_some() { self.baffles.count } else { 0 };
        network::join(&self.walls, 1 + baffles)
    }

    /// Refuses outlines of so many corners that they would take memory and time without bound.
    fn validate_size(&self) -> Result<(), Error> {
        let (each, all) = MOST_CORNERS;
        let corners = self.baffles.corner_count();
        let longest = self.walls.iter().map(Vec::len).max().unwrap_or(0);
        let of_walls = self.walls.iter().map(Vec::len).sum::<usize>();
        let total = of_walls + self.baffles.count.saturating_mul(corners);
        for (key, found, limit, place) in [
            ("drum.baffles.points", corners, each, ""),
            ("drum.walls", longest, each, " in one wall"),
            ("drum", total, all, " in baffles and walls together"),
        ] {
            require(
                found <= limit,
                key,
                format!("of {found} corners{place}"),
                format!("of at most {limit}"),
            )?;
        }
        Ok(())
    }
}

/// The most corners that one outline may have, and all together: a corner may be hidden by every edge of its
/// outline, so that time and memory to find out grow with the square of the one and with the product of both.
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
    let segments = polygon::segments(&points, false);
    if let Some(index) = polygon::empty_segment(&segments) {
        let problem = format!("has a side {} without length", index + 1);
        return refuse(problem, "a list of walls of distinct points");
    }
    match segments.windows(2).position(|pair| polygon::folds_back(&pair[0], &pair[1])) {
        Some(corner) => {
            refuse(format!("folds back on itself at point {}", corner + 2), "a list of walls that do not")
        }
        None => Ok(()),
    }
}
