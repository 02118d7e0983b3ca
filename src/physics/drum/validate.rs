//! Which baffles are possible: their numbers, their shape inside the rim, and the space between them.

use super::baffle::{BaffleParameters, BaffleShape, half_chord};
use super::polygon::{contains, empty_segment, first_crossing, length, segments};
use super::segment::Segment;
use crate::error::{Error, require_finite, require_non_negative, require_positive};
use crate::physics::vector::Vec2;

/// The most baffles a drum may have; each has columns of its own in the recorded series.
const MOST: usize = 1000;

impl BaffleParameters {
    /// Checks the numbers, and that the shapes stand free of the axis and of each other inside a rim of this
    /// radius [m], itself validated.
    pub(super) fn validate(&self, radius: Option<f64>) -> Result<(), Error> {
        self.validate_numbers()?;
        if self.count == 0 {
            return Ok(());
        }
        let Some(radius) = radius else {
            return Err(Error::config("drum.baffles.count", self.count, "0 where the drum has no rim"));
        };
        if self.count > MOST {
            return Err(Error::config("drum.baffles.count", self.count, format!("at most {MOST}")));
        }
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
        if self.base >= 2.0 * radius {
            let limit = format!("smaller than the drum's diameter {}", 2.0 * radius);
            return Err(Error::config("drum.baffles.base", self.base, limit));
        }
        if self.height >= radius {
            let limit = format!("smaller than the drum's radius {radius}, so that it ends before the axis");
            return Err(Error::config("drum.baffles.height", self.height, limit));
        }
        let foot = half_chord(radius, 0.5 * self.base);
        if radius - self.height >= foot {
            let limit = format!("greater than {}, the depth of the rim behind the base", radius - foot);
            return Err(Error::config("drum.baffles.height", self.height, limit));
        }
        Ok(())
    }

    fn validate_tip(&self, radius: f64) -> Result<(), Error> {
        require_positive("drum.baffles.tip", self.tip)?;
        let widest = 2.0 * half_chord(radius, radius - self.height);
        if self.tip < widest {
            Ok(())
        } else {
            let limit = format!("smaller than {widest}, the width of the drum at that height");
            Err(Error::config("drum.baffles.tip", self.tip, limit))
        }
    }

    fn validate_points(&self, radius: f64) -> Result<(), Error> {
        let Some(points) = &self.points else {
            return refuse_points("missing", "given for the shape 'polygon'");
        };
        if points.len() < 3 {
            return refuse_points(
                format!("a list of length {}", points.len()),
                "a list of at least 3 points",
            );
        }
        // In the user's order, which `profile` may reverse: the messages count segments.
        let corners: Vec<Vec2> =
            points.iter().map(|&[inwards, across]| [radius - inwards, across].into()).collect();
        let segments = segments(&corners, true);
        if let Some(index) = empty_segment(&segments) {
            let value = format!("a polygon whose side {} has no length", index + 1);
            return refuse_points(value, "a polygon of distinct corners");
        }
        if let Some((a, b)) = first_crossing(&segments) {
            let value = format!("a polygon whose sides {} and {} cross or touch", a + 1, b + 1);
            return refuse_points(value, "a polygon that never meets itself");
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
        if first.iter().any(|segment| second.iter().any(|other| segment.meets(other))) {
            let limit = "so small that neighboring baffles of this size neither touch nor overlap";
            return Err(Error::config("drum.baffles.count", self.count, limit));
        }
        Ok(())
    }
}

/// Refuses a polygon on the axis or wholly outside the rim.
fn validate_position(segments: &[Segment], radius: f64) -> Result<(), Error> {
    let axis = Vec2::zeros();
    if contains(segments, axis) || segments.iter().any(|segment| segment.holds(axis)) {
        return refuse_points("a polygon that covers the drum's axis", "a polygon beside the axis");
    }
    if segments.iter().all(|segment| length(segment.project(axis).point) >= radius) {
        return refuse_points("a polygon outside the rim", "a polygon that reaches into the drum");
    }
    Ok(())
}

fn refuse_points(value: impl ToString, limit: &str) -> Result<(), Error> {
    Err(Error::config("drum.baffles.points", value, limit))
}
