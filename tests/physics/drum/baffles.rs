//! Shapes of baffles, and which are refused.

use std::f64::consts::TAU;

use drumrs::physics::vector::{Rotation, cross};

use super::*;
use crate::common::{self, DRUM_RADIUS};

/// Three baffles of the drum of Table 1.
fn baffles(shape: BaffleShape) -> BaffleParameters {
    BaffleParameters { shape, ..common::baffles(3) }
}

fn polygon(points: &[[f64; 2]]) -> BaffleParameters {
    BaffleParameters { points: Some(points.to_vec()), ..baffles(BaffleShape::Polygon) }
}

fn in_rim(baffles: &BaffleParameters) -> DrumParameters {
    drum_with(baffles.clone())
}

fn outlines(baffles: &BaffleParameters) -> Vec<Vec<Vec2>> {
    drum(&in_rim(baffles)).outlines().map(<[_]>::to_vec).collect()
}

/// Twice the area inside a polygon: positive when its points run counter-clockwise.
fn doubled_area(points: &[Vec2]) -> f64 {
    points.iter().zip(points.iter().cycle().skip(1)).map(|(&one, &next)| cross(one, next)).sum()
}

#[test]
fn triangles_stand_on_the_rim() {
    let outlines = outlines(&baffles(BaffleShape::Triangle));
    assert_eq!(outlines.len(), 3);
    for (index, outline) in outlines.iter().enumerate() {
        assert_eq!(outline.len(), 3);
        let [left, tip, right] = [outline[0], outline[1], outline[2]];
        assert!((left.norm() - DRUM_RADIUS).abs() < 1e-16 && (right.norm() - DRUM_RADIUS).abs() < 1e-16);
        assert!(((left - right).norm() - 0.06).abs() < 1e-16 && (tip.norm() - 0.1875).abs() < 1e-16);
        let axis = Rotation::new(TAU / 3.0 * index as f64).apply(Vec2::new(0.1875, 0.0));
        assert!((tip - axis).norm() < 1e-16 && doubled_area(outline) > 0.0);
    }
}

#[test]
fn trapezoids_have_two_inner_corners() {
    let turned = BaffleParameters { count: 1, phase: TAU / 4.0, ..baffles(BaffleShape::Trapezoid) };
    let outline = &outlines(&turned)[0];
    let foot = (DRUM_RADIUS * DRUM_RADIUS - 0.03 * 0.03).sqrt();
    let expected = [[-0.03, foot], [-0.01, 0.1875], [0.01, 0.1875], [0.03, foot]].map(Vec2::from);
    assert!(outline.iter().zip(expected).all(|(point, corner)| (point - corner).norm() < 1e-15));
    assert!(outline.len() == 4 && doubled_area(outline) > 0.0);
}

#[test]
fn polygons_are_given_inwards_from_the_rim_and_made_counter_clockwise() {
    let points = [[0.0, 0.02], [0.05, 0.01], [0.04, -0.02]];
    let reversed: Vec<[f64; 2]> = points.into_iter().rev().collect();
    let outline = &outlines(&polygon(&points))[0];
    assert_eq!(*outline, points.map(|[x, y]| Vec2::new(DRUM_RADIUS - x, y)));
    assert_eq!(*outline, outlines(&polygon(&reversed))[0]);
    assert!(in_rim(&polygon(&points)).validate().is_ok());
}

#[test]
fn without_baffles_only_the_numbers_are_checked() {
    let none = BaffleParameters { count: 0, height: 9.0, base: 9.0, ..baffles(BaffleShape::Polygon) };
    assert!(without_rim(&none).validate().is_ok() && outlines(&none).is_empty());
    assert!(without_rim(&BaffleParameters { height: -1.0, ..none }).validate().is_err());
}

fn without_rim(baffles: &BaffleParameters) -> DrumParameters {
    DrumParameters { radius: None, ..in_rim(baffles) }
}

/// Each message must read "drum.baffles." + the text.
fn refuses(cases: &[(BaffleParameters, &str)]) {
    for (parameters, text) in cases {
        let message = in_rim(parameters).validate().unwrap_err().to_string();
        assert_eq!(message.strip_prefix("drum.baffles."), Some(*text));
    }
}

#[test]
fn sizes_that_do_not_fit_the_rim_are_refused() {
    let (triangle, trapezoid) = (baffles(BaffleShape::Triangle), baffles(BaffleShape::Trapezoid));
    let half_chord = |distance: f64| ((DRUM_RADIUS - distance) * (DRUM_RADIUS + distance)).sqrt();
    let shallow = format!(
        "height is 0.001, but must be greater than {:.4}, the depth of the rim behind the base",
        DRUM_RADIUS - half_chord(0.03)
    );
    let widest = format!(
        "tip is 0.4, but must be smaller than {:.4}, the width of the drum at that height",
        2.0 * half_chord(DRUM_RADIUS - 0.05)
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
            "count is 25, but must be so small that no baffle touches or overlaps the next",
        ),
    ]);
    let message = without_rim(&trapezoid).validate().unwrap_err().to_string();
    assert_eq!(message, "drum.baffles.count is 3, but must be 0 where the drum has no rim");
}

#[test]
fn unusable_numbers_are_refused() {
    let triangle = baffles(BaffleShape::Triangle);
    refuses(&[
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
        (polygon(&[[0.0, 0.0], [0.1, 0.0], [0.0, f64::NAN]]), "points is NaN, but must be a finite number"),
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
            polygon(&[[0.0, 0.0], [DRUM_RADIUS, 0.0], [0.0, -0.01]]),
            "points is a polygon that covers the drum's axis, but must be a polygon beside the axis",
        ),
        (
            polygon(&[[-0.1, 0.0], [0.0, 0.0], [-0.1, 0.01]]),
            "points is a polygon outside the rim, but must be a polygon that reaches into the drum",
        ),
        (
            BaffleParameters { count: 8, ..polygon(&hooked) },
            "count is 8, but must be so small that no baffle touches or overlaps the next",
        ),
    ]);
    assert!(in_rim(&polygon(&hooked)).validate().is_ok());
}

#[test]
fn a_trapezoid_without_a_tip_is_a_triangle() {
    let pointed = BaffleParameters { tip: 0.0, ..baffles(BaffleShape::Trapezoid) };
    assert_eq!(outlines(&pointed), outlines(&baffles(BaffleShape::Triangle)));
}

#[test]
fn a_last_point_may_repeat_the_first() {
    let points = [[0.0, 0.02], [0.05, 0.01], [0.04, -0.02]];
    let closed = [points[0], points[1], points[2], points[0]];
    assert_eq!(outlines(&polygon(&closed)), outlines(&polygon(&points)));
    assert!(in_rim(&polygon(&closed)).validate().is_ok());
    let wedge = [[0.0, 0.02], [0.05, 0.01], [0.0, 0.02]];
    let message = in_rim(&polygon(&wedge)).validate().unwrap_err().to_string();
    assert!(message.starts_with("drum.baffles.points is a polygon whose side"), "{message}");
}

#[test]
fn rounded_corners_lie_inside_of_the_sharp_ones_and_the_base_stays_on_the_rim() {
    let sharp = baffles(BaffleShape::Trapezoid);
    let round = BaffleParameters { corner_radius: 0.005, chord_error: 1e-5, ..sharp.clone() };
    let (sharp, round) = (outlines(&sharp), outlines(&round));
    assert!(round[0].len() > 8 && round[0].first() == sharp[0].first() && round[0].last() == sharp[0].last());
    // The arcs stay as high as the baffle, and cut its corners.
    let innermost = round[0].iter().map(|point| point.x).fold(1.0, f64::min);
    assert!((innermost - 0.1875).abs() < 1e-15);
    assert!(0.97 * doubled_area(&sharp[0]) < doubled_area(&round[0]));
    assert!(doubled_area(&round[0]) < doubled_area(&sharp[0]));
}

#[test]
fn corners_too_round_for_their_sides_are_refused() {
    let most = |shape, corner_radius| {
        let round = BaffleParameters { corner_radius, ..baffles(shape) };
        in_rim(&round).validate().map_err(|error| error.to_string())
    };
    let message = most(BaffleShape::Triangle, 0.05).unwrap_err();
    let (start, end) = ("drum.baffles.corner_radius is 0.05, but must be smaller than 0.0", "straight");
    assert!(message.starts_with(start) && message.ends_with(end), "{message}");
    assert!(most(BaffleShape::Triangle, 0.01).is_ok());
    assert!(most(BaffleShape::Trapezoid, f64::NAN).is_err());
}

/// Two sets of lifters in turn: rails of the drum's frame, one set higher than the other.
fn high_and_low(phase: f64) -> DrumParameters {
    let rail = |name: &str, inner: f64, phase: f64| BaffleParameters {
        name: name.into(),
        count: 4,
        phase,
        points: Some(vec![[inner, -0.01], [0.24, -0.02], [0.24, 0.02], [inner, 0.01]]),
        ..baffles(BaffleShape::Outline)
    };
    DrumParameters {
        baffles: vec![rail("high", 0.17, 0.0), rail("low", 0.2, phase), baffles(BaffleShape::Triangle)],
        ..triangles()
    }
}

#[test]
fn several_sets_stand_in_one_drum() {
    let mut parameters = high_and_low(TAU / 8.0);
    (parameters.baffles[2].count, parameters.baffles[2].phase) = (1, TAU / 16.0);
    let drum = drum(&parameters);
    let names =
        ["rim", "high 1", "high 2", "high 3", "high 4", "low 1", "low 2", "low 3", "low 4", "baffle 1"];
    assert_eq!(drum.surface_names(), names);
    let first = drum.outlines().next().unwrap();
    assert_eq!(first[0], Vec2::new(0.17, -0.01));
    assert_eq!(drum.solid_at(Vec2::new(0.0, 0.2)), Some(2));
    assert_eq!(drum.solid_at(Vec2::new(0.18, 0.0)), Some(1));
}

#[test]
fn sets_that_meet_are_refused_by_the_names_of_the_two() {
    let found = |parameters: &DrumParameters| parameters.validate().unwrap_err().to_string();
    let limit = "touch or overlap, but must be so placed that all parts are apart";
    assert_eq!(found(&high_and_low(0.1)), format!("drum.liner is so placed that high 1 and low 1 {limit}"));
    let crossing = high_and_low(TAU / 8.0);
    assert_eq!(found(&crossing), format!("drum.baffles is so placed that high 1 and baffle 1 {limit}"));
    // One within the other, without a common point of their sides.
    let mut nested = high_and_low(0.0);
    nested.baffles[1].points = Some(vec![[0.21, -0.005], [0.22, -0.005], [0.22, 0.005]]);
    assert_eq!(found(&nested), format!("drum.liner is so placed that high 1 and low 1 {limit}"));
}

#[test]
fn lengths_in_millimeters_are_told() {
    let hint = "lengths are in meters: are these centimeters or millimeters?";
    let mut parameters = in_rim(&polygon(&[[0.0, 20.0], [50.0, 10.0], [40.0, -20.0]]));
    let message = parameters.validate().unwrap_err().to_string();
    let found = "as far as 50.7573 m from the axis";
    let limit = "in or near the drum, whose radius is 0.2375 m";
    assert_eq!(message, format!("drum.baffles.points is {found}, but must be {limit}; {hint}"));
    parameters = DrumParameters { walls: vec![vec![[0.0, -50.0], [100.0, -50.0]]], ..triangles() };
    let message = parameters.validate().unwrap_err().to_string();
    assert!(message.starts_with("drum.walls[0] is as far as 111.8") && message.ends_with(hint), "{message}");
    let tall = BaffleParameters { height: 40.0, ..baffles(BaffleShape::Triangle) };
    let message = in_rim(&tall).validate().unwrap_err().to_string();
    assert!(message.starts_with("drum.baffles.height is 40,") && message.ends_with(hint), "{message}");
}
