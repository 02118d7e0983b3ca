//! Baffles and lifters: sets of equal solid shapes, spread evenly round the drum.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::polygon::{signed_area, vectors};
use super::rounding::rounded;
use crate::physics::vector::{Rotation, Vec2};

/// One set of baffles: `count` copies of one shape, every 2π/`count`, the first at angle `phase`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BaffleParameters {
    /// What the parts are called, each with its number behind it: "lifter 1", "lifter 2", …
    pub name: String,
    /// Number of baffles; 0 leaves the drum without.
    pub count: usize,
    /// Shape of each.
    pub shape: BaffleShape,
    /// Triangle, trapezoid: depth [m] from the rim towards the axis, measured along the baffle's axis.
    pub height: f64,
    /// Triangle, trapezoid: straight distance [m] between the two corners on the rim.
    pub base: f64,
    /// Trapezoid: distance [m] between the two inner corners; with 0 it is a triangle.
    pub tip: f64,
    /// Polygon, outline: its corners in order; the last may repeat the first.
    #[serde(deserialize_with = "Option::deserialize")]
    pub points: Option<Vec<[f64; 2]>>,
    /// Radius [m] of the arcs that replace the corners inside of the rim; 0 leaves them sharp.
    pub corner_radius: f64,
    /// Greatest distance [m] of such an arc from the chords that stand for it.
    pub chord_error: f64,
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
    /// Any simple polygon, each corner as (distance [m] inwards from the rim along the baffle's axis, distance
    /// [m] across, positive towards growing angle). It may reach through the rim.
    Polygon,
    /// Any simple polygon, each corner as (x, y) [m] in the drum's frame: a part of a liner. It may reach through
    /// the rim, and needs none.
    Outline,
}

impl BaffleParameters {
    /// The key of its points, in words of the user.
    pub(super) fn points_key(&self) -> &'static str {
        if self.shape == BaffleShape::Outline { "drum.liner.outlines" } else { "drum.baffles.points" }
    }

    /// What a user calls the number of copies.
    pub(super) fn count_key(&self) -> &'static str {
        match (self.shape, self.name.as_str()) {
            (BaffleShape::Outline, "rail") => "drum.liner.rail.count",
            (BaffleShape::Outline, _) => "drum.liner.repeat",
            _ => "drum.baffles.count",
        }
    }

    /// The corners as given, without a last one that repeats the first.
    pub(super) fn corners(&self) -> &[[f64; 2]] {
        match self.points.as_deref().unwrap_or_default() {
            [first, between @ .., last] if first == last && between.len() >= 2 => {
                &self.points.as_deref().unwrap_or_default()[..=between.len()]
            }
            corners => corners,
        }
    }

    /// Number of corners of one baffle.
    pub(super) fn corner_count(&self, radius: Option<f64>) -> usize {
        match self.shape {
            _ if self.count > 0 && self.corner_radius > 0.0 => self.profile(radius).len(),
            BaffleShape::Triangle => 3,
            BaffleShape::Trapezoid => 4,
            BaffleShape::Polygon | BaffleShape::Outline => self.corners().len(),
        }
    }

    /// The outlines of all baffles in the body frame, each counter-clockwise, for a rim of this radius [m].
    pub(super) fn outlines(&self, radius: Option<f64>) -> Vec<Vec<Vec2>> {
        let profile = if self.count > 0 { self.profile(radius) } else { Vec::new() };
        (0..self.count).map(|index| self.copy(&profile, index)).collect()
    }

    /// The baffle at `index`: the profile turned to its place.
    pub(super) fn copy(&self, profile: &[Vec2], index: usize) -> Vec<Vec2> {
        let rotation = Rotation::new(self.phase + TAU * index as f64 / self.count as f64);
        profile.iter().map(|&point| rotation.apply(point)).collect()
    }

    /// One baffle with its axis along +x, counter-clockwise.
    pub(super) fn profile(&self, radius: Option<f64>) -> Vec<Vec2> {
        let sharp = self.sharp_profile(radius);
        if self.corner_radius == 0.0 {
            return sharp;
        }
        rounded(&sharp, (self.corner_radius, self.chord_error), radius.unwrap_or(f64::INFINITY))
    }

    /// The same before its corners are rounded.
    pub(super) fn sharp_profile(&self, radius: Option<f64>) -> Vec<Vec2> {
        let radius = radius.unwrap_or(f64::INFINITY);
        let foot = half_chord(radius, 0.5 * self.base);
        let (across, inner) = (0.5 * self.base, radius - self.height);
        let corners = match self.shape {
            BaffleShape::Trapezoid if self.tip > 0.0 => {
                vec![[foot, across], [inner, 0.5 * self.tip], [inner, -0.5 * self.tip], [foot, -across]]
            }
            BaffleShape::Triangle | BaffleShape::Trapezoid => {
                vec![[foot, across], [inner, 0.0], [foot, -across]]
            }
            BaffleShape::Polygon => {
                self.corners().iter().map(|&[inwards, across]| [radius - inwards, across]).collect()
            }
            BaffleShape::Outline => self.corners().to_vec(),
        };
        let mut points = vectors(&corners);
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

/// A name for each member of some sets, given as a name and a number of members: "baffle 1", "baffle 2", … Members of sets
/// of the same name are counted on.
pub(super) fn part_names<'a>(sets: impl Iterator<Item = (&'a str, usize)>) -> Vec<String> {
    let mut counts = BTreeMap::new();
    let members = sets.flat_map(|(name, count)| std::iter::repeat_n(name, count));
    members
        .map(|name| {
            let number: &mut usize = counts.entry(name).or_default();
            *number += 1;
            format!("{name} {number}")
        })
        .collect()
}
