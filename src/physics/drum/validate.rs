//! Which baffles are possible: their numbers, their shape inside the rim, and the space between them and others.

use super::baffle::{BaffleParameters, BaffleShape, half_chord, part_names};
use super::outline::Bounds;
use super::polygon::{contains, empty_segment, first_crossing, length, segments};
use super::rounding::greatest_radius;
use super::segment::Segment;
use crate::error::{Error, require, require_finite, require_non_negative, require_positive};
use crate::physics::vector::Vec2;

/// The most baffles a drum may have; each has columns of its own in the recorded series.
pub const MOST_BAFFLES: usize = 1000;

impl BaffleParameters {
    /// Checks the numbers, and that the shape stands free of the axis inside a rim of this radius [m], itself
    /// validated, or in a drum without one.
    pub(super) fn validate(&self, radius: Option<f64>) -> Result<(), Error> {
        self.validate_numbers()?;
        if self.count == 0 {
            return Ok(());
        }
        let limit = format!("at most {MOST_BAFFLES}");
        require(self.count <= MOST_BAFFLES, "drum.baffles.count", self.count, limit)?;
        match (self.shape, radius) {
            (BaffleShape::Outline, _) | (BaffleShape::Polygon, Some(_)) => self.validate_points(radius)?,
            (_, None) => {
                return Err(Error::config("drum.baffles.count", self.count, "0 where the drum has no rim"));
            }
            (BaffleShape::Triangle, Some(radius)) => self.validate_base(radius)?,
            (BaffleShape::Trapezoid, Some(radius)) => {
                self.validate_base(radius).and_then(|()| self.validate_tip(radius))?;
            }
        }
        self.validate_rounding(radius)
    }

    fn validate_numbers(&self) -> Result<(), Error> {
        require_positive("drum.baffles.height", self.height)?;
        require_positive("drum.baffles.base", self.base)?;
        require_non_negative("drum.baffles.tip", self.tip)?;
        require_non_negative("drum.baffles.corner_radius", self.corner_radius)?;
        require_positive("drum.baffles.chord_error", self.chord_error)?;
        require_finite("drum.baffles.phase", self.phase)?;
        self.points.as_ref().map_or(Ok(()), |points| require_all_finite(self.points_key(), points))
    }

    fn validate_base(&self, radius: f64) -> Result<(), Error> {
        let diameter = 2.0 * radius;
        let limit = format!("smaller than the drum's diameter {diameter}");
        require_shorter("drum.baffles.base", self.base, diameter, limit)?;
        let limit = format!("smaller than the drum's radius {radius}, so that it ends before the axis");
        require_shorter("drum.baffles.height", self.height, radius, limit)?;
        let foot = half_chord(radius, 0.5 * self.base);
        let limit = format!("greater than {:.4}, the depth of the rim behind the base", radius - foot);
        require(radius - self.height < foot, "drum.baffles.height", self.height, limit)
    }

    fn validate_tip(&self, radius: f64) -> Result<(), Error> {
        let widest = 2.0 * half_chord(radius, radius - self.height);
        let limit = format!("smaller than {widest:.4}, the width of the drum at that height");
        require_shorter("drum.baffles.tip", self.tip, widest, limit)
    }

    fn validate_points(&self, radius: Option<f64>) -> Result<(), Error> {
        let key = self.points_key();
        if self.points.is_none() {
            return Err(Error::config(key, "missing", "given for the shape 'polygon'"));
        }
        let points = self.corners();
        let found = format!("a list of length {}", points.len());
        require(points.len() >= 3, key, found, "a list of at least 3 points")?;
        // In the user's order, which `profile` may reverse: the messages count segments.
        let corner = |&[x, y]: &[f64; 2]| match (self.shape, radius) {
            (BaffleShape::Polygon, Some(radius)) => Vec2::new(radius - x, y),
            _ => Vec2::new(x, y),
        };
        let corners: Vec<Vec2> = points.iter().map(corner).collect();
        if let Some(radius) = radius {
            validate_unit(key, &corners, radius)?;
        }
        let segments = simple_polygon(key, &corners)?;
        let (axis, covered) = (Vec2::zeros(), "a polygon that covers the drum's axis");
        let covers = contains(&segments, axis) || segments.iter().any(|segment| segment.holds(axis));
        require(!covers, key, covered, "a polygon beside the axis")?;
        let reaches =
            segments.iter().any(|side| length(side.project(axis).point) < radius.unwrap_or(f64::INFINITY));
        require(reaches, key, "a polygon outside the rim", "a polygon that reaches into the drum")
    }

    fn validate_rounding(&self, radius: Option<f64>) -> Result<(), Error> {
        if self.corner_radius == 0.0 {
            return Ok(());
        }
        let most = greatest_radius(&self.sharp_profile(radius), radius.unwrap_or(f64::INFINITY));
        let limit =
            format!("smaller than {most:.4}, so that rounded corners leave a part of every side straight");
        require_shorter("drum.baffles.corner_radius", self.corner_radius, most, limit)
    }
}

/// Refuses baffles that touch or overlap each other, of whatever set; `sets` are validated one by one.
///
/// Of one set it is enough to compare two neighbors: by Hopf's theorem on the chords of plane continua, a shape that is
/// clear of its copy one step on is clear of every other copy. Congruent shapes cannot contain one another, so
/// comparing their edges is enough; those of two sets can.
pub(super) fn validate_spacing(sets: &[BaffleParameters], radius: Option<f64>) -> Result<(), Error> {
    let names = part_names(sets.iter().map(|set| (set.name.as_str(), set.count)));
    let mut earlier: Vec<(String, Vec<Segment>, Bounds)> = Vec::new();
    let mut names = names.into_iter();
    for set in sets {
        let profile = set.profile(radius);
        let copies: Vec<Vec<Segment>> =
            (0..set.count).map(|index| segments(&set.copy(&profile, index), true)).collect();
        if let [first, second, ..] = copies.as_slice() {
            let limit = format!("so small that no {} touches or overlaps the next", set.name);
            require(are_apart(first, second), set.count_key(), set.count, limit)?;
        }
        let known = earlier.len();
        for (copy, name) in copies.into_iter().zip(names.by_ref()) {
            let bounds = Bounds::of_segments(&copy);
            let meets = |(_, other, around): &&(String, Vec<Segment>, Bounds)| {
                bounds.overlaps(around)
                    && (!are_apart(&copy, other)
                        || contains(other, copy[0].start)
                        || contains(&copy, other[0].start))
            };
            if let Some((other, ..)) = earlier[..known].iter().find(meets) {
                let found = format!("so placed that {other} and {name} touch or overlap");
                let key = set.count_key().rsplit_once('.').map_or("drum", |(table, _)| table);
                return Err(Error::config(key, found, "so placed that all parts are apart"));
            }
            earlier.push((name, copy, bounds));
        }
    }
    Ok(())
}

fn are_apart(one: &[Segment], other: &[Segment]) -> bool {
    !one.iter().any(|segment| other.iter().any(|side| segment.meets(side)))
}

/// Refuses points that are not finite.
pub(super) fn require_all_finite(key: &str, points: &[[f64; 2]]) -> Result<(), Error> {
    points.iter().flatten().try_for_each(|&coordinate| require_finite(key, coordinate))
}

/// The sides of a closed polygon; refuses one that is not simple.
pub(super) fn simple_polygon(key: &str, corners: &[Vec2]) -> Result<Vec<Segment>, Error> {
    let segments = segments(corners, true);
    if let Some(index) = empty_segment(&segments) {
        let found = format!("a polygon whose side {} has no length", index + 1);
        return Err(Error::config(key, found, "a polygon of distinct corners"));
    }
    if let Some((a, b)) = first_crossing(&segments) {
        let found = format!("a polygon whose sides {} and {} cross or touch", a + 1, b + 1);
        return Err(Error::config(key, found, "a polygon that never meets itself"));
    }
    Ok(segments)
}

/// What is this many times too long is in another unit than meters.
const FARTHEST: f64 = 3.0;
const UNITS: &str = "lengths are in meters: are these centimeters or millimeters?";

/// Refuses a length [m] that is not smaller than the longest there may be.
fn require_shorter(key: &str, length: f64, longest: f64, limit: String) -> Result<(), Error> {
    let refused = require(length < longest, key, length, limit);
    if length > FARTHEST * longest { refused.map_err(|error| error.with_hint(UNITS)) } else { refused }
}

/// Refuses points so far outside of a rim of this radius [m] that they must be in another unit.
pub(super) fn validate_unit(key: &str, points: &[Vec2], radius: f64) -> Result<(), Error> {
    let farthest = points.iter().copied().map(length).fold(0.0, f64::max);
    if farthest <= FARTHEST * radius {
        return Ok(());
    }
    let found = format!("as far as {farthest:.4} m from the axis");
    let limit = format!("in or near the drum, whose radius is {radius} m");
    Err(Error::config(key, found, limit).with_hint(UNITS))
}
