//! Rounded corners: arcs that touch both sides of a corner, broken into chords.

use super::polygon::length;
use crate::physics::vector::{Rotation, Vec2, cross, dot};

/// A corner is on the rim, and stays sharp, from this fraction of its radius outwards.
const ON_RIM: f64 = 1.0 - 1e-9;

/// The most chords of an arc, beyond those that a baffle may have.
const MOST_CHORDS: f64 = 1001.0;

/// A corner with the directions of its two sides.
struct Corner {
    point: Vec2,
    back: Vec2,
    ahead: Vec2,
}

impl Corner {
    /// The corner at `index` of a closed polygon.
    fn of(points: &[Vec2], index: usize) -> Self {
        let (point, count) = (points[index], points.len());
        let towards = |other: Vec2| (other - point) / length(other - point);
        let [back, ahead] = [index + count - 1, index + 1].map(|other| towards(points[other % count]));
        Self { point, back, ahead }
    }

    /// How far from the corner an arc of radius 1 touches its sides; 0 for a corner that stays sharp.
    fn reach(&self, rim: f64) -> f64 {
        if length(self.point) >= rim * ON_RIM {
            return 0.0;
        }
        // The cotangent of half the angle between the sides.
        let cosine = dot(self.back, self.ahead);
        ((1.0 + cosine) / (1.0 - cosine)).max(0.0).sqrt()
    }
}

/// The polygon with the corners inside of the rim replaced by arcs of a radius [m], whose chords are nowhere
/// farther from them than an error [m].
pub(super) fn rounded(points: &[Vec2], (radius, error): (f64, f64), rim: f64) -> Vec<Vec2> {
    let mut round = Vec::with_capacity(4 * points.len());
    for index in 0..points.len() {
        let corner = Corner::of(points, index);
        let reach = radius * corner.reach(rim);
        if reach == 0.0 {
            round.push(corner.point);
            continue;
        }
        let (first, last) = (corner.point + corner.back * reach, corner.point + corner.ahead * reach);
        // From the first point to the center the way is square to the side.
        let side = if cross(corner.back, corner.ahead) > 0.0 { 1.0 } else { -1.0 };
        let center = first + Vec2::new(-corner.back.y, corner.back.x) * (side * radius);
        let turn = 2.0 * libm::atan2(reach, radius);
        let per_chord = 2.0 * libm::acos((1.0 - error / radius).max(0.0));
        let chords = (turn / per_chord).ceil().clamp(1.0, MOST_CHORDS) as usize;
        round.push(first);
        for chord in 1..chords {
            let angle = -side * turn * chord as f64 / chords as f64;
            round.push(center + Rotation::new(angle).apply(first - center));
        }
        round.push(last);
    }
    round
}

/// The greatest radius [m] with which the arcs of neighboring corners leave a piece of every side straight.
pub(super) fn greatest_radius(points: &[Vec2], rim: f64) -> f64 {
    let count = points.len();
    let reaches: Vec<f64> = (0..count).map(|index| Corner::of(points, index).reach(rim)).collect();
    let fits = |index: usize| {
        let next = (index + 1) % count;
        length(points[next] - points[index]) / (reaches[index] + reaches[next])
    };
    (0..count).map(fits).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arcs_touch_both_sides_and_chords_stay_close_to_them() {
        let square: Vec<Vec2> = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(Vec2::from).to_vec();
        assert!((greatest_radius(&square, 9.0) - 0.5).abs() < 1e-15);
        let round = rounded(&square, (0.25, 1e-3), 9.0);
        let center = Vec2::new(0.25, 0.25);
        let corner: Vec<&Vec2> = round.iter().filter(|p| p.x <= 0.25 && p.y <= 0.25).collect();
        assert!(corner.len() > 5);
        assert!(corner.iter().all(|point| (length(*point - center) - 0.25).abs() < 1e-15));
        for two in corner.windows(2) {
            assert!(length((two[0] + two[1]) * 0.5 - center) >= 0.25 - 1e-3);
        }
        // As few as the error allows: with one chord less it would be exceeded.
        let turn = std::f64::consts::FRAC_PI_4 / (corner.len() - 2) as f64;
        assert!(0.25 * (1.0 - libm::cos(turn)) > 1e-3);
    }

    #[test]
    fn concave_corners_are_rounded_too_and_those_on_the_rim_are_not() {
        let notched: Vec<Vec2> =
            [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 1.0], [0.0, 4.0]].map(Vec2::from).to_vec();
        let round = rounded(&notched, (0.1, 1e-3), 5.0);
        assert!(round.contains(&notched[2]) && !round.contains(&notched[3]));
        let near = round.iter().filter(|point| length(*point - notched[3]) < 0.5);
        assert!(near.clone().count() > 4 && near.clone().all(|point| point.y > 1.0));
    }
}
