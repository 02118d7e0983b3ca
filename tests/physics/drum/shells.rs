//! Drums that are not round: a closed outline round the axis for a rim.

use std::f64::consts::TAU;

use drumrs::physics::load::packing::pack;
use drumrs::physics::rotation::RotationSchedule;

use super::*;
use crate::common::{DRUM_RADIUS, RADIUS, baseline, polar, single, start};

/// A regular polygon of so many sides whose corners lie on the rim of Table 1, a side at the bottom.
fn polygon_drum(sides: u32) -> DrumParameters {
    let corner = |k: u32| polar(DRUM_RADIUS, TAU * ((f64::from(k) + 0.5) / f64::from(sides) - 0.25));
    DrumParameters { radius: None, shell: Some((0..sides).map(corner).collect()), ..drum_with(baffles(0)) }
}

#[test]
fn free_space_is_inside_of_the_shell() {
    let square = drum(&polygon_drum(4));
    let apothem = DRUM_RADIUS / 2.0_f64.sqrt();
    let free = [[0.0, 0.0], [0.1, -0.1], [0.0, 0.9 * apothem]].map(Vec2::from);
    let solid = [[0.0, 0.2], [0.17, 0.0], [0.0, -3.0], [DRUM_RADIUS, 0.0]].map(Vec2::from);
    for point in free {
        assert!(square.clearance(point) > 0.0 && square.solid_at(point).is_none());
        assert!((square.clearance(point) - (apothem - point.x.abs().max(point.y.abs()))).abs() < 1e-15);
    }
    for point in solid {
        assert!(square.clearance(point) < 0.0 && square.solid_at(point) == Some(0), "{point}");
        assert!(!square.is_clear(point, 0.001));
    }
    assert!((square.clear_radius() - apothem).abs() < 1e-15);
    assert!((square.bounding_radius().unwrap() - DRUM_RADIUS).abs() < 1e-15);
    assert_eq!((square.surface_names(), square.feature_count()), (&["rim".to_owned()][..], 9));
    // The order of its points does not matter, nor whether the last repeats the first.
    let mut other = polygon_drum(4);
    let corners = other.shell.as_mut().unwrap();
    corners.reverse();
    corners.push(corners[0]);
    assert!((drum(&other).clearance(free[1]) - square.clearance(free[1])).abs() < 1e-16);
}

#[test]
fn outlines_that_are_no_shell_are_refused() {
    let found = |shell: Vec<[f64; 2]>| {
        DrumParameters { shell: Some(shell), ..polygon_drum(4) }.validate().unwrap_err().to_string()
    };
    let beside = vec![[0.1, 0.1], [0.2, 0.1], [0.2, 0.2]];
    let limit = "an outline round the axis for a shell";
    assert_eq!(
        found(beside),
        format!("drum.liner is an outline beside the drum's axis, but must be {limit}")
    );
    let bow_tie = vec![[-1.0, -1.0], [1.0, 1.0], [1.0, -1.0], [-1.0, 1.0]];
    assert!(found(bow_tie).contains("whose sides 1 and 3 cross or touch"));
    let both = DrumParameters { radius: Some(1.0), ..polygon_drum(4) };
    let message = both.validate().unwrap_err().to_string();
    assert_eq!(message, "drum.rim is true, but must be false where a closed outline is the drum itself");
}

#[test]
fn a_load_packs_itself_into_a_shell() {
    let mut parameters = polygon_drum(6);
    parameters.baffles[0] = BaffleParameters {
        count: 6,
        points: Some(vec![[0.15, -0.01], [0.24, -0.01], [0.24, 0.01], [0.15, 0.01]]),
        shape: BaffleShape::Outline,
        ..baffles(6)
    };
    let drum = drum(&parameters);
    let bed = pack(&drum, 120, RADIUS, 1).unwrap();
    assert!(bed.iter().all(|&center| drum.clearance(center) >= RADIUS));
    // In parts of the corners, beyond what a circle within would leave.
    assert!(
        bed.iter().any(|center| center.norm() > drum.shell().unwrap()[0].norm() * 0.75_f64.sqrt() - RADIUS)
    );
}

/// Where a bundle comes to rest in a drum that stands still, as a height above that on a round rim.
fn rest(drum: DrumParameters) -> f64 {
    let mut config = baseline(1, 0);
    config.drum = drum;
    config.rotation = RotationSchedule { knots: vec![[0.0, 0.0]] };
    let mut simulation = start(&config, single([0.0, -0.2], [0.0, 0.0], 0.0));
    simulation.run(200_000).unwrap();
    simulation.state().particles.positions[0].y
}

#[test]
fn a_bundle_rests_on_the_bottom_side_as_the_geometry_says() {
    let round = rest(drum_with(baffles(0)));
    let differences = [16, 32, 64].map(|sides| rest(polygon_drum(sides)) - round);
    for (sides, difference) in [16.0, 32.0, 64.0].into_iter().zip(differences) {
        let expected = DRUM_RADIUS * (1.0 - libm::cos(TAU / 2.0 / sides));
        assert!((difference / expected - 1.0).abs() < 1e-6, "{sides} sides: {difference:e} for {expected:e}");
    }
    // As 1/n².
    assert!((differences[0] / differences[1] / 4.0 - 1.0).abs() < 0.01);
    assert!((differences[1] / differences[2] / 4.0 - 1.0).abs() < 0.003);
}
