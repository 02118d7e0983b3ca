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

#[cfg(test)]
mod tests {
    use super::*;

    const RADIUS: f64 = 0.2375;

    fn baffles(shape: BaffleShape) -> BaffleParameters {
        BaffleParameters { count: 3, shape, height: 0.05, base: 0.06, tip: 0.02, points: None, phase: 0.0 }
    }

    fn polygon(points: &[[f64; 2]]) -> BaffleParameters {
        BaffleParameters { points: Some(points.to_vec()), ..baffles(BaffleShape::Polygon) }
    }

    #[test]
    fn without_baffles_only_the_numbers_are_checked() {
        let none = BaffleParameters { count: 0, height: 9.0, base: 9.0, ..baffles(BaffleShape::Polygon) };
        assert!(none.validate(None).is_ok() && none.outlines(RADIUS).is_empty());
        assert!(BaffleParameters { height: -1.0, ..none }.validate(None).is_err());
    }

    /// Each message must read "drum.baffles." + the text.
    fn refuses(cases: &[(BaffleParameters, &str)]) {
        for (parameters, text) in cases {
            let message = parameters.validate(Some(RADIUS)).unwrap_err().to_string();
            assert_eq!(message.strip_prefix("drum.baffles."), Some(*text));
        }
    }

    #[test]
    fn sizes_that_do_not_fit_the_rim_are_refused() {
        let (triangle, trapezoid) = (baffles(BaffleShape::Triangle), baffles(BaffleShape::Trapezoid));
        let foot = half_chord(RADIUS, 0.03);
        let shallow = format!(
            "height is 0.001, but must be greater than {}, the depth of the rim behind the base",
            RADIUS - foot
        );
        let widest = format!(
            "tip is 0.4, but must be smaller than {}, the width of the drum at that height",
            2.0 * half_chord(RADIUS, RADIUS - 0.05)
        );
        refuses(&[
            (
                BaffleParameters { height: 0.3, ..triangle.clone() },
                "height is 0.3, but must be smaller than the drum's radius 0.2375, so that it ends before the axis",
            ),
            (BaffleParameters { height: 0.001, ..triangle.clone() }, &shallow),
            (
                BaffleParameters { base: 0.475, ..trapezoid.clone() },
                "base is 0.475, but must be smaller than the drum's diameter 0.475",
            ),
            (BaffleParameters { tip: 0.4, ..trapezoid.clone() }, &widest),
            (BaffleParameters { count: 1001, ..triangle.clone() }, "count is 1001, but must be at most 1000"),
            (
                BaffleParameters { count: 25, ..triangle },
                "count is 25, but must be so small that neighboring baffles of this size neither touch nor overlap",
            ),
        ]);
        let message = trapezoid.validate(None).unwrap_err().to_string();
        assert_eq!(message, "drum.baffles.count is 3, but must be 0 where the drum has no rim");
    }

    #[test]
    fn unusable_numbers_are_refused() {
        let (triangle, trapezoid) = (baffles(BaffleShape::Triangle), baffles(BaffleShape::Trapezoid));
        refuses(&[
            (BaffleParameters { tip: 0.0, ..trapezoid }, "tip is 0, but must be a positive finite number"),
            (
                BaffleParameters { tip: -1.0, ..triangle.clone() },
                "tip is -1, but must be a finite number of at least 0",
            ),
            (
                BaffleParameters { base: f64::INFINITY, ..triangle.clone() },
                "base is inf, but must be a positive finite number",
            ),
            (
                BaffleParameters { height: 0.0, ..triangle.clone() },
                "height is 0, but must be a positive finite number",
            ),
            (BaffleParameters { phase: f64::NAN, ..triangle }, "phase is NaN, but must be a finite number"),
        ]);
    }

    #[test]
    fn unusable_polygons_are_refused() {
        let hooked = [[0.0, 0.0], [0.15, 0.0], [0.15, 0.15], [0.14, 0.15], [0.14, 0.01]];
        refuses(&[
            (baffles(BaffleShape::Polygon), "points is missing, but must be given for the shape 'polygon'"),
            (
                polygon(&[[0.0, 0.0], [0.1, 0.0]]),
                "points is a list of length 2, but must be a list of at least 3 points",
            ),
            (
                polygon(&[[0.0, 0.0], [0.1, 0.0], [0.0, f64::NAN]]),
                "points is NaN, but must be a finite number",
            ),
            (
                polygon(&[[0.0, 0.0], [0.1, 0.0], [0.1, 0.0]]),
                "points is a polygon whose side 2 has no length, but must be a polygon of distinct corners",
            ),
            (
                polygon(&[[0.0, 0.0], [0.1, 0.0], [0.0, 0.1], [0.1, 0.1]]),
                "points is a polygon whose sides 2 and 4 cross or touch, but must be a polygon that never meets itself",
            ),
            (
                polygon(&[[0.0, -0.1], [0.0, 0.1], [0.3, 0.0]]),
                "points is a polygon that covers the drum's axis, but must be a polygon beside the axis",
            ),
            (
                polygon(&[[0.0, 0.0], [RADIUS, 0.0], [0.0, -0.01]]),
                "points is a polygon that covers the drum's axis, but must be a polygon beside the axis",
            ),
            (
                polygon(&[[-0.1, 0.0], [0.0, 0.0], [-0.1, 0.01]]),
                "points is a polygon outside the rim, but must be a polygon that reaches into the drum",
            ),
            (
                BaffleParameters { count: 8, ..polygon(&hooked) },
                "count is 8, but must be so small that neighboring baffles of this size neither touch nor overlap",
            ),
        ]);
        assert!(polygon(&hooked).validate(Some(RADIUS)).is_ok());
    }
}
