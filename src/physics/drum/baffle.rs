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
