//! Baffles: equal solid shapes on the rim, spread evenly round the drum.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::polygon::signed_area;
use crate::physics::vector::{Rotation, Vec2};

/// The baffles of a drum: `count` copies of one shape, every 2π/`count`, the first at angle `phase`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BaffleParameters {
    /// Number of baffles; 0 leaves the drum without.
    pub count: usize,
    /// Shape of each.
    pub shape: BaffleShape,
    /// Triangle, trapezoid: depth [m] from the rim towards the axis, measured along the baffle's axis.
    pub height: f64,
    /// Triangle, trapezoid: straight distance [m] between the two corners on the rim.
    pub base: f64,
    /// Trapezoid: distance [m] between the two inner corners.
    pub tip: f64,
    /// Polygon: its corners in order, each as (distance [m] inwards from the rim along the baffle's axis,
    /// distance [m] across, positive towards growing angle). They may reach through the rim.
    #[serde(deserialize_with = "Option::deserialize")]
    pub points: Option<Vec<[f64; 2]>>,
    /// Angle [rad] of the first baffle's axis when the drum's angle is 0, counter-clockwise from +x.
    pub phase: f64,
}

/// The shape of a baffle's cross-section.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BaffleShape {
    /// Isosceles, with its base corners on the rim.
    Triangle,
    /// Symmetric, with its base corners on the rim.
    Trapezoid,
    /// Any simple polygon.
    Polygon,
}

impl BaffleParameters {
    /// Number of corners of one baffle.
    pub(super) fn corner_count(&self) -> usize {
        match self.shape {
            BaffleShape::Triangle => 3,
            BaffleShape::Trapezoid => 4,
            BaffleShape::Polygon => self.points.as_ref().map_or(0, Vec::len),
        }
    }

    /// The outlines of all baffles in the body frame, each counter-clockwise, for a rim of this radius [m].
    pub(super) fn outlines(&self, radius: f64) -> Vec<Vec<Vec2>> {
        let profile = self.profile(radius);
        (0..self.count).map(|index| self.copy(&profile, index)).collect()
    }

    /// The baffle at `index`: the profile turned to its place.
    pub(super) fn copy(&self, profile: &[Vec2], index: usize) -> Vec<Vec2> {
        let rotation = Rotation::new(self.phase + TAU * index as f64 / self.count as f64);
        profile.iter().map(|&point| rotation.apply(point)).collect()
    }

    /// One baffle with its axis along +x, counter-clockwise.
    pub(super) fn profile(&self, radius: f64) -> Vec<Vec2> {
        let foot = half_chord(radius, 0.5 * self.base);
        let (across, inner) = (0.5 * self.base, radius - self.height);
        let corners = match self.shape {
            BaffleShape::Triangle => vec![[foot, across], [inner, 0.0], [foot, -across]],
            BaffleShape::Trapezoid => {
                vec![[foot, across], [inner, 0.5 * self.tip], [inner, -0.5 * self.tip], [foot, -across]]
            }
            BaffleShape::Polygon => {
                self.points.iter().flatten().map(|&[inwards, across]| [radius - inwards, across]).collect()
            }
        };
        let mut points: Vec<Vec2> = corners.into_iter().map(Vec2::from).collect();
        if signed_area(&points) < 0.0 {
            points.reverse();
        }
        points
    }
}

/// Half the length [m] of the chord of a circle at this distance from its center; with half a chord given it
/// returns the distance.
pub(super) fn half_chord(radius: f64, distance: f64) -> f64 {
    ((radius - distance) * (radius + distance)).sqrt()
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
    fn triangles_stand_on_the_rim() {
        let outlines = baffles(BaffleShape::Triangle).outlines(RADIUS);
        assert_eq!(outlines.len(), 3);
        for (index, outline) in outlines.iter().enumerate() {
            assert_eq!(outline.len(), 3);
            let [left, tip, right] = [outline[0], outline[1], outline[2]];
            assert!((left.norm() - RADIUS).abs() < 1e-16 && (right.norm() - RADIUS).abs() < 1e-16);
            assert!(((left - right).norm() - 0.06).abs() < 1e-16 && (tip.norm() - 0.1875).abs() < 1e-16);
            let axis = Rotation::new(TAU / 3.0 * index as f64).apply(Vec2::new(0.1875, 0.0));
            assert!((tip - axis).norm() < 1e-16 && signed_area(outline) > 0.0);
        }
    }

    #[test]
    fn trapezoids_have_two_inner_corners() {
        let turned = BaffleParameters { count: 1, phase: TAU / 4.0, ..baffles(BaffleShape::Trapezoid) };
        let outline = &turned.outlines(RADIUS)[0];
        let foot = (RADIUS * RADIUS - 0.03 * 0.03).sqrt();
        let expected = [[-0.03, foot], [-0.01, 0.1875], [0.01, 0.1875], [0.03, foot]].map(Vec2::from);
        assert!(outline.iter().zip(expected).all(|(point, corner)| (point - corner).norm() < 1e-15));
        assert!(outline.len() == 4 && signed_area(outline) > 0.0);
    }

    #[test]
    fn polygons_are_given_inwards_from_the_rim_and_made_counter_clockwise() {
        let points = [[0.0, 0.02], [0.05, 0.01], [0.04, -0.02]];
        let reversed: Vec<[f64; 2]> = points.into_iter().rev().collect();
        let outline = &polygon(&points).outlines(RADIUS)[0];
        assert_eq!(*outline, points.map(|[x, y]| Vec2::new(RADIUS - x, y)));
        assert_eq!(*outline, polygon(&reversed).outlines(RADIUS)[0]);
        assert!(polygon(&points).validate(Some(RADIUS)).is_ok());
    }
}
