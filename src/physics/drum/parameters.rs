//! The drum as a user describes it, and what of it is refused.

use serde::{Deserialize, Serialize};

use super::baffle::BaffleParameters;
use super::graph::Graph;
use super::network;
use super::polygon::{self, vectors};
use super::validate::{MOST_BAFFLES, require_all_finite, simple_polygon, validate_spacing, validate_unit};
use crate::error::{Error, require, require_positive};
use crate::physics::vector::Vec2;

/// Rim or shell, baffles and straight walls, as a user describes them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DrumParameters {
    /// Radius of the rim [m]; none leaves the drum without a rim.
    #[serde(deserialize_with = "Option::deserialize")]
    pub radius: Option<f64>,
    /// A closed outline round the axis, as points [m] in the drum's frame: the boundary of a drum that is not round,
    /// instead of a rim.
    #[serde(deserialize_with = "Option::deserialize")]
    pub shell: Option<Vec<[f64; 2]>>,
    /// Sets of equal baffles or lifters.
    pub baffles: Vec<BaffleParameters>,
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
        self.validate_shell()?;
        self.baffles.iter().try_for_each(|set| set.validate(self.radius))?;
        self.validate_size()?;
        validate_spacing(&self.baffles, self.radius)?;
        for (index, wall) in self.walls.iter().enumerate() {
            validate_wall(&format!("drum.walls[{index}]"), wall, self.radius)?;
        }
        self.joined_walls().map(drop)
    }

    /// Radius [m] of the smallest circle round the axis that holds all free space; none where that has no end.
    pub fn bounding_radius(&self) -> Option<f64> {
        let corners = self.shell.iter().flatten().map(|&corner| polygon::length(corner.into()));
        self.radius.or_else(|| corners.reduce(f64::max))
    }

    /// The corners of the shell in clockwise order: the solid lies outside, to their left.
    pub(super) fn shell_corners(&self) -> Option<Vec<Vec2>> {
        let mut corners = vectors(self.shell.as_ref()?);
        if corners.len() > 3 && corners.first() == corners.last() {
            corners.pop();
        }
        if polygon::signed_area(&corners) > 0.0 {
            corners.reverse();
        }
        Some(corners)
    }

    fn validate_shell(&self) -> Result<(), Error> {
        let (Some(shell), Some(corners)) = (&self.shell, self.shell_corners()) else { return Ok(()) };
        let key = "drum.liner";
        require_all_finite(key, shell)?;
        let limit = "false where a closed outline is the drum itself";
        require(self.radius.is_none(), "drum.rim", "true", limit)?;
        let found = format!("an outline of {} corners", corners.len());
        require(corners.len() >= 3, key, found, "an outline of at least 3 corners")?;
        let sides = simple_polygon(key, &corners)?;
        let axis = Vec2::zeros();
        let surrounds = polygon::contains(&sides, axis) && !sides.iter().any(|side| side.holds(axis));
        require(surrounds, key, "an outline beside the drum's axis", "an outline round the axis for a shell")
    }

    /// The walls, validated one by one, as outlines: what meets is one.
    pub(super) fn joined_walls(&self) -> Result<Vec<Graph>, Error> {
        let baffles: usize = self.baffles.iter().map(|set| set.count).sum();
        network::join(&self.walls, 1 + baffles)
    }

    /// Refuses outlines of so many corners that they would take memory and time without bound.
    fn validate_size(&self) -> Result<(), Error> {
        let (each, all) = MOST_CORNERS;
        let sizes: Vec<_> =
            self.baffles.iter().map(|set| (set.count, set.corner_count(self.radius))).collect();
        let corners = sizes.iter().map(|&(_, corners)| corners).max().unwrap_or(0);
        let of_baffles = sizes.iter().map(|&(count, corners)| count.saturating_mul(corners)).sum::<usize>();
        let count: usize = sizes.iter().map(|&(count, _)| count).sum();
        let shell = self.shell.as_ref().map_or(0, Vec::len);
        let longest = self.walls.iter().map(Vec::len).max().unwrap_or(0);
        let of_walls = self.walls.iter().map(Vec::len).sum::<usize>();
        let total = of_walls + of_baffles + shell;
        let limit = format!("at most {MOST_BAFFLES}");
        require(count <= MOST_BAFFLES, "drum.baffles.count", count, limit)?;
        for (key, found, limit, place) in [
            ("drum.baffles.points", corners, each, " in one baffle"),
            ("drum.liner", shell, each, " in its shell"),
            ("drum.walls", longest, each, " in one wall"),
            ("drum", total, all, " in baffles and walls together"),
        ] {
            let corners = format!("of {found} corners{place}");
            require(found <= limit, key, corners, format!("of at most {limit}"))?;
        }
        Ok(())
    }
}

/// The most corners that one outline may have, and all together: a corner may be hidden by every edge of its
/// outline, so that time and memory to find out grow with the square of the one and with the product of both.
const MOST_CORNERS: (usize, usize) = (1000, 20_000);

/// Checks a wall, given its key and the radius of the rim.
fn validate_wall(key: &str, wall: &[[f64; 2]], radius: Option<f64>) -> Result<(), Error> {
    require_all_finite(key, wall)?;
    let found = format!("a line of {} points", wall.len());
    require(wall.len() >= 2, key, found, "a line of at least 2 points")?;
    let points = vectors(wall);
    let segments = polygon::segments(&points, false);
    if let Some(side) = polygon::empty_segment(&segments) {
        let found = format!("a line whose points {} and {} are the same", side + 1, side + 2);
        return Err(Error::config(key, found, "a line of distinct points"));
    }
    if let Some(corner) = segments.windows(2).position(|pair| polygon::folds_back(&pair[0], &pair[1])) {
        let found = format!("a line that folds back on itself at point {}", corner + 2);
        return Err(Error::config(key, found, "a line that does not"));
    }
    radius.map_or(Ok(()), |radius| validate_unit(key, &points, radius))
}
