//! Contracts of `pack` and `pack_mixed` on the drum of the paper, bare and with its three baffles.

use drumrs::error::Error;
use drumrs::physics::drum::baffle::BaffleParameters;
use drumrs::physics::drum::{Drum, DrumParameters};
use drumrs::physics::load::packing::{pack, pack_mixed};
use drumrs::physics::vector::{Rotation, Vec2, cross, dot};

use crate::common::{DRUM_RADIUS, RADIUS, baffles, drum_with};

/// The drum of the paper with so many triangular baffles, all lengths times a scale.
fn scaled(scale: f64, baffle_count: usize) -> Drum {
    let baffles = baffles(baffle_count);
    let (height, base) = (scale * baffles.height, scale * baffles.base);
    let radius = Some(scale * DRUM_RADIUS);
    let baffles = BaffleParameters { height, base, ..baffles };
    Drum::new(&DrumParameters { radius, shell: None, baffles: vec![baffles], walls: vec![] }).unwrap()
}

/// The bare drum and the one with baffles.
fn both() -> [Drum; 2] {
    [scaled(1.0, 0), scaled(1.0, 3)]
}

/// Distance to the rim or to the nearest baffle, by formula: negative within a solid.
fn clearance(drum: &Drum, point: Vec2) -> f64 {
    let rim = drum.radius().unwrap() - dot(point, point).sqrt();
    let baffles = drum.outlines().map(|baffle| distance_to_triangle(baffle.try_into().unwrap(), point));
    baffles.fold(rim, f64::min)
}

/// Distance to a triangle with counter-clockwise corners, negative inside.
fn distance_to_triangle(corners: &[Vec2; 3], point: Vec2) -> f64 {
    let (mut distance, mut inside) = (f64::INFINITY, true);
    for (index, start) in corners.iter().enumerate() {
        let edge = corners[(index + 1) % 3] - start;
        let along = (dot(point - start, edge) / dot(edge, edge)).clamp(0.0, 1.0);
        let apart = point - start - edge * along;
        distance = distance.min(dot(apart, apart).sqrt());
        inside &= cross(edge, point - start) > 0.0;
    }
    if inside { -distance } else { distance }
}

/// Asserts that equal discs touch neither each other nor a solid, after a turn by any odd angle too.
fn assert_valid(drum: &Drum, bed: &[Vec2], radius: f64) {
    assert_mix_valid(drum, bed, &vec![radius; bed.len()]);
}

/// Asserts the same of discs of these radii.
fn assert_mix_valid(drum: &Drum, bed: &[Vec2], radii: &[f64]) {
    assert_eq!(bed.len(), radii.len());
    assert!(bed.iter().zip(radii).all(|(center, radius)| clearance(drum, *center) >= *radius));
    let turn = Rotation::new(1.234);
    let turned: Vec<Vec2> = bed.iter().map(|center| turn.apply(*center)).collect();
    for (index, center) in turned.iter().enumerate() {
        for (other, radius) in turned[..index].iter().zip(radii) {
            assert!((center - other).norm() >= radii[index] + radius, "{center} and {other} overlap");
        }
    }
}

/// The count that an error names for a request that cannot fit.
fn most_that_fit(drum: &Drum, radius: f64) -> usize {
    match pack(drum, 5000, radius, 0) {
        Err(Error::Packing { requested: 5000, fits, diameters }) if diameters == [2.0 * radius; 2] => fits,
        other => panic!("not the error of a drum too small: {other:?}"),
    }
}

/// How much the directions to near neighbors agree with one hexagonal order throughout: 1 for a lattice.
fn hexagonal_order(bed: &[Vec2], radius: f64) -> f64 {
    let mut sum = Vec2::zeros();
    let mut pairs = 0.0;
    for center in bed {
        for other in bed {
            let apart = other - center;
            if apart.norm() > 0.0 && apart.norm() < 2.8 * radius {
                let angle = libm::atan2(apart.y, apart.x);
                sum += Rotation::new(6.0 * angle).apply(Vec2::new(1.0, 0.0));
                pairs += 1.0;
            }
        }
    }
    sum.norm() / pairs
}

#[test]
fn discs_are_free_at_every_fill() {
    for drum in both() {
        for tenths in 1..=8 {
            let bed = pack(&drum, 40 * tenths, RADIUS, 5).unwrap();
            assert_eq!(bed.len(), 40 * tenths);
            assert_valid(&drum, &bed, RADIUS);
        }
    }
}

#[test]
fn the_densest_beds_of_the_paper_fit() {
    for (drum, at_least) in both().iter().zip([330, 321]) {
        let fits = most_that_fit(drum, RADIUS);
        assert!(fits >= at_least, "only {fits} fit");
        for seed in 0..4 {
            let bed = pack(drum, fits, RADIUS, seed).unwrap();
            assert_eq!(bed.len(), fits);
            assert_valid(drum, &bed, RADIUS);
            let error = Error::Packing { requested: fits + 1, fits, diameters: [2.0 * RADIUS; 2] };
            assert_eq!(pack(drum, fits + 1, RADIUS, seed), Err(error));
        }
    }
}

#[test]
fn few_large_discs_fit_at_the_reported_count() {
    for drum in both() {
        for ratio in [1.5, 2.2, 2.5, 2.75, 3.4, 4.1, 6.0, 9.0] {
            let radius = DRUM_RADIUS / ratio;
            let fits = most_that_fit(&drum, radius);
            for (seed, count) in (1..=fits).enumerate() {
                assert_valid(&drum, &pack(&drum, count, radius, seed as u64).unwrap(), radius);
            }
            assert!(pack(&drum, fits + 1, radius, 1).is_err());
        }
    }
}

#[test]
fn few_large_discs_lie_in_rings_where_these_hold_more() {
    let drum = scaled(1.0, 0);
    for (ratio, count) in [(1.5, 1), (2.2, 3), (2.5, 4), (2.75, 5), (3.01, 7), (3.4, 8), (5.0, 17)] {
        assert_eq!(most_that_fit(&drum, DRUM_RADIUS / ratio), count, "drum {ratio} times as wide");
    }
}

#[test]
fn a_seed_decides_every_bit() {
    for drum in both() {
        for count in [100, 240, 320] {
            let bed = pack(&drum, count, RADIUS, 1).unwrap();
            assert_eq!(bed, pack(&drum, count, RADIUS, 1).unwrap());
            let other = pack(&drum, count, RADIUS, 2).unwrap();
            assert!(bed.iter().all(|center| !other.contains(center)));
        }
    }
}

#[test]
fn beds_have_the_same_bits_on_every_machine() {
    let drum = scaled(1.0, 3);
    let sums = [100, 300].map(|count| {
        let bed = pack(&drum, count, RADIUS, 1).unwrap();
        bed.iter().fold(0u64, |sum, center| sum.rotate_left(1) ^ center.x.to_bits() ^ center.y.to_bits())
    });
    assert_eq!(sums, [1_452_182_670_960_276_796, 3_294_468_466_642_155_409]);
}

#[test]
fn lengths_scale_bit_for_bit() {
    for baffles in [0, 3] {
        for count in [100, 240, 320] {
            let bed = pack(&scaled(1.0, baffles), count, RADIUS, 3).unwrap();
            let expected: Vec<Vec2> = bed.iter().map(|center| center * 4.0).collect();
            assert_eq!(pack(&scaled(4.0, baffles), count, RADIUS * 4.0, 3).unwrap(), expected);
        }
    }
}

#[test]
fn a_loose_bed_is_uniform() {
    let drum = scaled(1.0, 0);
    let reach = DRUM_RADIUS - RADIUS;
    let mut sum = 0.0;
    let mut mean = Vec2::zeros();
    for seed in 0..400 {
        for center in pack(&drum, 10, RADIUS, seed).unwrap() {
            sum += dot(center, center) / (reach * reach) / 4000.0;
            mean += center / reach / 4000.0;
        }
    }
    assert!((sum - 0.5).abs() < 0.02, "mean square distance {sum}");
    assert!(mean.norm() < 0.02, "mean position {mean}");
}

#[test]
fn shuffling_melts_the_pattern() {
    let drum = scaled(1.0, 0);
    for seed in 0..4 {
        let order = hexagonal_order(&pack(&drum, 240, RADIUS, seed).unwrap(), RADIUS);
        assert!(order < 0.3, "order {order} at 60 % fill");
    }
}

#[test]
fn a_disc_may_be_barely_smaller_than_the_drum() {
    let drum = scaled(1.0, 0);
    let radius = DRUM_RADIUS * 0.999_999;
    for seed in 0..20 {
        assert_valid(&drum, &pack(&drum, 1, radius, seed).unwrap(), radius);
    }
    assert_eq!(most_that_fit(&drum, radius), 1);
    assert_eq!(most_that_fit(&drum, DRUM_RADIUS), 0);
    assert_eq!(most_that_fit(&drum, DRUM_RADIUS * 3.0), 0);
    let baffled = scaled(1.0, 3);
    assert_valid(&baffled, &pack(&baffled, 1, 0.187, 1).unwrap(), 0.187);
}

#[test]
fn few_tiny_discs_cost_little() {
    let drum = scaled(1.0, 3);
    let radius = DRUM_RADIUS * 1e-7;
    assert_valid(&drum, &pack(&drum, 7, radius, 1).unwrap(), radius);
}

#[test]
fn nothing_is_placed_where_nothing_is_asked_for() {
    assert_eq!(pack(&scaled(1.0, 3), 0, RADIUS, 1), Ok(Vec::new()));
}

#[test]
fn a_drum_without_bounds_and_a_disc_without_size_are_refused() {
    let without_rim = DrumParameters { radius: None, ..drum_with(baffles(0)) };
    let error = pack(&Drum::new(&without_rim).unwrap(), 1, RADIUS, 1).unwrap_err();
    assert_eq!(error.to_string(), "drum.diameter is none, but must be given when no initial state is");
    for radius in [0.0, -1.0, f64::NAN] {
        let error = pack(&scaled(1.0, 0), 1, radius, 1).unwrap_err();
        assert!(error.to_string().starts_with("load.diameter is "));
    }
}

/// Radii of two sizes in turn, one `ratio` times the other, that cover as much as `count` discs of `RADIUS`.
fn two_sizes(count: f64, ratio: f64) -> Vec<f64> {
    let count = (2.0 * count / (1.0 + ratio * ratio)).ceil() as usize;
    (0..count).map(|index| if index % 2 == 0 { RADIUS } else { RADIUS * ratio }).collect()
}

#[test]
fn equal_radii_are_packed_as_one_size() {
    for drum in both() {
        for count in [100, 300] {
            let bed = pack_mixed(&drum, &vec![RADIUS; count], 7);
            assert_eq!(bed, pack(&drum, count, RADIUS, 7));
        }
    }
}

#[test]
fn discs_of_several_sizes_are_free() {
    for drum in both() {
        for (count, ratio) in [(40.0, 1.4), (200.0, 1.4), (270.0, 1.01), (270.0, 2.0), (200.0, 5.0)] {
            let radii = two_sizes(count, ratio);
            assert_mix_valid(&drum, &pack_mixed(&drum, &radii, 2).unwrap(), &radii);
        }
    }
}

#[test]
fn small_discs_fill_the_pores_of_large_ones() {
    let drum = scaled(1.0, 3);
    let radii: Vec<f64> = (0..600).map(|index| if index % 30 == 0 { 0.03 } else { 0.003 }).collect();
    assert_mix_valid(&drum, &pack_mixed(&drum, &radii, 1).unwrap(), &radii);
}

#[test]
fn a_mix_gets_as_dense_as_equal_discs_less_three_percent() {
    for drum in both() {
        let radii = two_sizes(0.97 * most_that_fit(&drum, RADIUS) as f64, 1.4);
        for seed in 0..3 {
            assert_mix_valid(&drum, &pack_mixed(&drum, &radii, seed).unwrap(), &radii);
        }
    }
}

#[test]
fn the_count_that_an_error_names_for_a_mix_fits() {
    let drum = scaled(1.0, 3);
    let radii = two_sizes(420.0, 4.0);
    let fits = match pack_mixed(&drum, &radii, 1) {
        Err(Error::Packing { requested, fits, diameters }) => {
            assert_eq!((requested, diameters), (radii.len(), [2.0 * RADIUS, 8.0 * RADIUS]));
            fits
        }
        other => panic!("not the error of a drum too small: {other:?}"),
    };
    assert!((30..radii.len()).contains(&fits), "{fits} of {}", radii.len());
    assert_mix_valid(&drum, &pack_mixed(&drum, &radii[..fits], 1).unwrap(), &radii[..fits]);
}

#[test]
fn the_bits_of_a_mix_follow_from_its_seed_and_scale_with_the_drum() {
    for (count, baffles) in [(100.0, 0), (100.0, 3), (280.0, 3)] {
        let radii = two_sizes(count, 1.4);
        let bed = pack_mixed(&scaled(1.0, baffles), &radii, 1).unwrap();
        let larger: Vec<f64> = radii.iter().map(|radius| 4.0 * radius).collect();
        let expected: Vec<Vec2> = bed.iter().map(|center| center * 4.0).collect();
        assert_eq!(pack_mixed(&scaled(4.0, baffles), &larger, 1).unwrap(), expected);
        let other = pack_mixed(&scaled(1.0, baffles), &radii, 2).unwrap();
        assert!(bed.iter().all(|center| !other.contains(center)));
    }
}

#[test]
fn mixes_have_the_same_bits_on_every_machine() {
    let sums = [100.0, 280.0].map(|count| {
        let bed = pack_mixed(&scaled(1.0, 3), &two_sizes(count, 1.4), 1).unwrap();
        bed.iter().fold(0u64, |sum, center| sum.rotate_left(1) ^ center.x.to_bits() ^ center.y.to_bits())
    });
    assert_eq!(sums, [16_369_372_995_867_056_353, 8_161_018_893_944_569_310]);
}

#[test]
fn a_mix_keeps_clear_of_walls() {
    let wall = vec![[-0.15, -0.1], [0.0, 0.02], [0.17, -0.08]];
    let parameters = DrumParameters { walls: vec![wall], ..drum_with(baffles(0)) };
    let drum = Drum::new(&parameters).unwrap();
    let radii = two_sizes(260.0, 1.4);
    let bed = pack_mixed(&drum, &radii, 1).unwrap();
    assert!(bed.iter().zip(&radii).all(|(center, radius)| drum.is_clear(*center, *radius)));
}

#[test]
fn mixes_that_no_drum_holds_are_refused() {
    let drum = scaled(1.0, 0);
    assert_eq!(pack_mixed(&drum, &[], 1), Ok(Vec::new()));
    let too_large = Error::Packing { requested: 2, fits: 0, diameters: [2.0 * RADIUS, 2.0 * DRUM_RADIUS] };
    assert_eq!(pack_mixed(&drum, &[RADIUS, DRUM_RADIUS], 1), Err(too_large));
    for radius in [0.0, -1.0, f64::NAN] {
        let error = pack_mixed(&drum, &[RADIUS, radius], 1).unwrap_err();
        assert!(error.to_string().starts_with("load.diameter is "));
    }
}
