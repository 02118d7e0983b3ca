//! Zones that a user marks, such as that of a spray: polygons in the laboratory or in the drum's frame, which nothing feels.

use serde::{Deserialize, Serialize};

use super::polygon::{contains, length};
use super::segment::Segment;
use super::validate::{simple_polygon, validate_unit};
use crate::error::{Error, require, require_finite};
use crate::physics::vector::{Rotation, Vec2, bounds};

/// The most zones of a run: each has a row for every disc.
const MOST_ZONES: usize = 64;

/// Whether a zone stands or turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ZoneFrame {
    /// It stands.
    Laboratory,
    /// It turns with the drum.
    Drum,
}

/// A zone as a user describes it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ZoneParameters {
    /// What it is called.
    pub name: String,
    /// Its corners [m], in either direction.
    pub corners: Vec<[f64; 2]>,
    /// The frame that they are in.
    pub frame: ZoneFrame,
}

impl ZoneParameters {
    /// Refuses zones that are too many, of one name, no simple polygons, or outside of a drum of this radius [m].
    ///
    /// # Errors
    /// `Error::Config` naming the key.
    pub fn validate(zones: &[Self], radius: Option<f64>) -> Result<(), Error> {
        let limit = format!("at most {MOST_ZONES} zones");
        require(zones.len() <= MOST_ZONES, "run.zone", format!("a list of {}", zones.len()), limit)?;
        for (index, zone) in zones.iter().enumerate() {
            if let Some(other) = zones[..index].iter().position(|other| other.name == zone.name) {
                let limit = format!("another name than that of run.zone[{other}]");
                return Err(Error::config(format!("run.zone[{index}].name"), zone.name.as_str(), limit));
            }
            zone.validate_corners(&format!("run.zone[{index}].corners"), radius)?;
        }
        Ok(())
    }

    fn validate_corners(&self, key: &str, radius: Option<f64>) -> Result<(), Error> {
        self.corners.iter().flatten().try_for_each(|&coordinate| require_finite(key, coordinate))?;
        let found = format!("a list of length {}", self.corners.len());
        require(self.corners.len() >= 3, key, found, "a list of at least 3 points")?;
        let corners: Vec<Vec2> = self.corners.iter().map(|&corner| corner.into()).collect();
        let sides = simple_polygon(key, &corners)?;
        let Some(radius) = radius else { return Ok(()) };
        validate_unit(key, &corners, radius)?;
        let axis = Vec2::zeros();
        let reaches =
            contains(&sides, axis) || sides.iter().any(|side| length(side.project(axis).point) < radius);
        let limit = format!("a polygon that reaches into the drum, whose radius is {radius} m");
        require(reaches, key, "a polygon outside the drum", limit)
    }
}

/// A validated zone.
#[derive(Debug, Clone)]
pub struct Zone {
    frame: ZoneFrame,
    sides: Vec<Segment>,
    bounds: (Vec2, Vec2),
}

impl Zone {
    /// The zone that a user has described.
    pub fn new(parameters: &ZoneParameters) -> Self {
        let corners: Vec<Vec2> = parameters.corners.iter().map(|&corner| corner.into()).collect();
        Self {
            frame: parameters.frame,
            sides: super::polygon::segments(&corners, true),
            bounds: bounds(&corners).unwrap_or_default(),
        }
    }

    /// Whether it turns with the drum.
    pub fn turns(&self) -> bool {
        self.frame == ZoneFrame::Drum
    }

    /// Whether a point of the laboratory lies in it while the drum is turned so.
    pub fn contains(&self, point: Vec2, drum: Rotation) -> bool {
        let point = if self.turns() { drum.apply_inverse(point) } else { point };
        let (low, high) = self.bounds;
        let is_near = low.x <= point.x && point.x <= high.x && low.y <= point.y && point.y <= high.y;
        is_near && contains(&self.sides, point)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn zone(corners: &[[f64; 2]], frame: ZoneFrame) -> ZoneParameters {
        ZoneParameters { name: "spray".into(), corners: corners.to_vec(), frame }
    }

    #[test]
    fn a_zone_stands_or_turns_with_the_drum() {
        let square = [[1.0, -0.5], [2.0, -0.5], [2.0, 0.5], [1.0, 0.5]];
        let quarter = Rotation::new(std::f64::consts::FRAC_PI_2);
        let (right, top) = (Vec2::new(1.5, 0.0), Vec2::new(0.0, 1.5));
        let standing = Zone::new(&zone(&square, ZoneFrame::Laboratory));
        assert!(standing.contains(right, quarter) && !standing.contains(top, quarter));
        let turning = Zone::new(&zone(&square, ZoneFrame::Drum));
        assert!(turning.contains(top, quarter) && !turning.contains(right, quarter));
    }

    #[test]
    fn zones_that_cannot_be_are_refused() {
        let refused = |zones: &[ZoneParameters]| {
            let error = ZoneParameters::validate(zones, Some(2.0)).expect_err("a refusal");
            (error.key().unwrap_or_default().to_owned(), error.problem())
        };
        let of = |corners: &[[f64; 2]]| refused(&[zone(corners, ZoneFrame::Laboratory)]);
        let corners = "run.zone[0].corners";
        for (points, problem) in [
            (&[[0.0, 0.0], [1.0, 1.0]][..], "a list of length 2"),
            (&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]], "sides 2 and 4 cross"),
            (&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]], "sides 1 and 3 cross or touch"),
            (&[[0.0, 0.0], [0.0, 0.0], [1.0, 0.0]], "side 1 has no length"),
            (&[[3.0, 0.0], [4.0, 0.0], [4.0, 1.0]], "outside the drum"),
            (&[[30.0, 0.0], [4.0, 0.0], [4.0, 1.0]], "as far as 30"),
            (&[[f64::NAN, 0.0], [4.0, 0.0], [4.0, 1.0]], "a finite number"),
        ] {
            let (key, found) = of(points);
            assert!(key == corners && found.contains(problem), "{key} {found}");
        }
        // All round the drum.
        let round = zone(&[[-2.5, -2.5], [2.5, -2.5], [2.5, 2.5], [-2.5, 2.5]], ZoneFrame::Drum);
        assert!(ZoneParameters::validate(std::slice::from_ref(&round), Some(2.0)).is_ok());
        let (key, found) = refused(&[round.clone(), round.clone()]);
        assert!(key == "run.zone[1].name" && found.contains("spray"), "{key} {found}");
        assert_eq!(refused(&vec![round; 65]).0, "run.zone");
    }
}
