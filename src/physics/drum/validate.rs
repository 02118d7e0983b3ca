//! Which baffles are possible: their numbers, their shape inside the rim, and the space between them.

use super::baffle::{BaffleParameters, BaffleShape, half_chord};
use super::polygon::{contains, empty_segment, first_crossing, length, segments};
use super::segment::Segment;
use crate::error::{Error, require, require_finite, require_non_negative, require_positive};
use crate::physics::vector::Vec2;

/// The most baffles a drum may have; each has columns of its own in the recorded series.
pub const MOST_BAFFLES: usize = 1000;

impl BaffleParameters {
    /// Checks the numbers, and that the shapes stand free of the axis and of each other inside a rim of this
    /// radius [m], itself validated.
    pub(super) fn validate(&self, radius: Option<f64>) -> Result<(), Error> {
        self.validate_numbers()?;
        let Some(radius) = radius else {
            return require(self.count == 0, "drum.baffles.count", self.count, "0 where the drum has no rim");
        };
        if self.count == 0 {
            return Ok(());
        }
        require(
            self.count <= MOST_BAFFLES,
            "drum.baffles.count",
            self.count,
            format!("at most {MOST_BAFFLES}"),
        )?;
        match self.shape {
            BaffleShape::Triangle => self.validate_base(radius)?,
            BaffleShape::Trapezoid => self.validate_base(radius).and_then(|()| self.validate_tip(radius))?,
            BaffleShape::Polygon => self.validate_points(radius)?,
        }
        self.validate_spacing(radius)
    }

    fn validate_numbers(&self) -> Result<(), Error> {
        require_positive("drum.baffles.height", self.height)?;
        require_positive("drum.baffles.base", self.base)?;
        require_non_negative("drum.baffles.tip", self.tip)?;
        require_finite("drum.baffles.phase", self.phase)?;
        for coordinate in self.points.iter().flatten().flatten() {
            require_finite("drum.baffles.points", *coordinate)?;
        }
        Ok(())
    }

    fn validate_base(&self, radius: f64) -> Result<(), Error> {
        let diameter = 2.0 * radius;
        let limit = format!("smaller than the drum's diameter {diameter}");
        require(self.base < diameter, "drum.baffles.base", self.base, limit)?;
        let limit = format!("smaller than the drum's radius {radius}, so that it ends before the axis");
        require(self.height < radius, "drum.baffles.height", self.height, limit)?;
        let foot = half_chord(radius, 0.5 * self.base);
        let limit = format!("greater than {}, the depth of the rim behind the base", radius - foot);
        require(radius - self.height < foot, "drum.baffles.height", self.height, limit)
    }

    fn validate_tip(&self, radius: f64) -> Result<(), Error> {
        require_positive("drum.baffles.tip", self.tip)?;
        let widest = 2.0 * half_chord(radius, radius - self.height);
        let limit = format!("smaller than {widest}, the width of the drum at that height");
        require(self.tip < widest, "drum.baffles.tip", self.tip, limit)
    }

    fn validate_points(&self, radius: f64) -> Result<(), Error> {
        let Some(points) = &self.points else {
            return Err(Error::config("drum.baffles.points", "missing", "given for the shape 'polygon'"));
        };
        let found = format!("a list of length {}", points.len());
        require(points.len() >= 3, "drum.baffles.points", found, "a list of at least 3 points")?;
        // In the user's order, which `profile` may reverse: the messages count segments.
        let corners: Vec<Vec2> =
            points.iter().map(|&[inwards, across]| [radius - inwards, across].into()).collect();
        let segments = segments(&corners, true);
        if let Some(index) = empty_segment(&segments) {
            let found = format!("a polygon whose side {} has no length", index + 1);
            return Err(Error::config("drum.baffles.points", found, "a polygon of distinct corners"));
        }
        if let Some((a, b)) = first_crossing(&segments) {
            let found = format!("a polygon whose sides {} and {} cross or touch", a + 1, b + 1);
            return Err(Error::config("drum.baffles.points", found, "a polygon that never meets itself"));
        }
        validate_position(&segments, radius)
    }

    /// Refuses baffles that touch or overlap. It is enough to compare neighbors: by Hopf's theorem on the
    /// chords of plane continua, a shape that is clear of its copy one step on is clear of every other copy.
    /// And congruent shapes cannot contain one another, so comparing their edges is enough too.
    fn validate_spacing(&self, radius: f64) -> Result<(), Error> {
        if self.count < 2 {
            return Ok(());
        }
        let profile = self.profile(radius);
        let [first, second] = [0, 1].map(|index| segments(&self.copy(&profile, index), true));
        let are_clear = !first.iter().any(|segment| second.iter().any(|other| segment.meets(other)));
        let limit = "so small that neighboring baffles of this size neither touch nor overlap";
        require(are_clear, "drum.baffles.count", self.count, limit)
    }
}

/// Refuses a polygon on the axis or wholly outside the rim.
fn validate_position(segments: &[Segment], radius: f64) -> Result<(), Error> {
    let (key, axis) = ("drum.baffles.points", Vec2::zeros());
    let covers = contains(segments, axis) || segments.iter().any(|segment| segment.holds(axis));
    require(!covers, key, "a polygon that covers the drum's axis", "a polygon beside the axis")?;
    let is_inside = |segment: &Segment| length(segment.project(axis).point) < radius;
    let reaches = segments.iter().any(is_inside);
    require(reaches, key, "a polygon outside the rim", "a polygon that reaches into the drum")
}
