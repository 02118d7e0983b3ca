//! Drums at rest: culls, scaling, clearance, errors; baffles, shells, proximities and joints of walls in files of their
//! own.

mod baffles;
mod joints;
mod proximity;
mod shells;

use drumrs::physics::drum::baffle::{BaffleParameters, BaffleShape};
use drumrs::physics::drum::{Drum, DrumParameters, FeatureId, Proximity, RIM};
use drumrs::physics::vector::{Vec2, cross, dot};

use crate::common::{baffles, drum_with};

/// The default drum: three triangles, 0.05 m high on a base of 0.06 m, in a rim of 0.475 m diameter.
fn triangles() -> DrumParameters {
    drum_with(baffles(3))
}

fn trapezoids() -> DrumParameters {
    let mut parameters = triangles();
    let [baffles] = &mut parameters.baffles[..] else { unreachable!() };
    (baffles.shape, baffles.count, baffles.phase) = (BaffleShape::Trapezoid, 4, 0.3);
    parameters
}

/// Hooks with a narrow slot, reaching through the rim.
fn hooks() -> DrumParameters {
    let mut parameters = triangles();
    let hook = [[-0.01, 0.02], [0.06, 0.01], [0.07, -0.03], [0.05, -0.03], [0.05, 0.0], [-0.01, -0.01]];
    parameters.baffles[0].shape = BaffleShape::Polygon;
    parameters.baffles[0].points = Some(hook.to_vec());
    parameters
}

/// No rim: an acute zigzag, a closed square, a straight floor, a spiral.
fn walls() -> DrumParameters {
    let zigzag = vec![[-0.2, 0.1], [0.0, 0.1], [-0.15, 0.13], [0.0, 0.2], [0.1, 0.2]];
    let square = vec![[0.1, -0.1], [0.2, -0.1], [0.2, 0.0], [0.1, 0.0], [0.1, -0.1]];
    let mut parameters = DrumParameters { radius: None, walls: vec![zigzag, square], ..triangles() };
    parameters.walls.push(vec![[-0.2, -0.2], [0.2, -0.2]]);
    let spiral = [[-0.2, 0.0], [-0.05, 0.0], [-0.05, -0.12], [-0.15, -0.12], [-0.15, -0.05], [-0.1, -0.05]];
    parameters.walls.push(spiral.to_vec());
    parameters.baffles[0].count = 0;
    parameters
}

fn all() -> [DrumParameters; 4] {
    [triangles(), trapezoids(), hooks(), walls()]
}

fn drum(parameters: &DrumParameters) -> Drum {
    Drum::new(parameters).unwrap()
}

/// A wall alone, as a drum.
fn wall(points: &[[f64; 2]]) -> Drum {
    drum(&DrumParameters { walls: vec![points.to_vec()], ..DrumParameters { walls: vec![], ..walls() } })
}

/// Evenly spread points of the square |x|, |y| < 0.25.
fn cloud(count: u32) -> impl Iterator<Item = Vec2> {
    let spread = |k: u32, step: f64| 0.5 * ((f64::from(k) * step) % 1.0) - 0.25;
    (0..count).map(move |k| Vec2::new(spread(k, 0.754_877_666_246_692_8), spread(k, 0.569_840_290_998_053_3)))
}

/// Start and end of the edges of an outline, by boundary order.
fn edges_of(drum: &Drum, outline: usize) -> Vec<(Vec2, Vec2)> {
    let points: Vec<Vec2> = drum.outlines().nth(outline).unwrap().to_vec();
    let mut edges: Vec<(Vec2, Vec2)> = points.windows(2).map(|pair| (pair[0], pair[1])).collect();
    if outline < drum.baffle_count() {
        edges.push((points[points.len() - 1], points[0]));
    }
    edges
}

/// Distance from a point to an edge, by formula.
fn distance(point: Vec2, (start, end): (Vec2, Vec2)) -> f64 {
    let along = (dot(point - start, end - start) / (end - start).norm_squared()).clamp(0.0, 1.0);
    (start + (end - start) * along - point).norm()
}

/// Signed distance from a point to an outline, by formula: negative inside a baffle.
fn signed_distance(drum: &Drum, outline: usize, point: Vec2) -> f64 {
    let edges = edges_of(drum, outline);
    let nearest = edges.iter().map(|&edge| distance(point, edge)).fold(f64::INFINITY, f64::min);
    let crosses_ray = |&&(start, end): &&(Vec2, Vec2)| {
        let is_upward = end.y > start.y;
        let spans = (start.y <= point.y) != (end.y <= point.y);
        spans && (cross(end - start, point - start) > 0.0) == is_upward
    };
    let is_inside = edges.iter().filter(crosses_ray).count() % 2 == 1;
    if outline < drum.baffle_count() && is_inside { -nearest } else { nearest }
}

/// Distance from a point to each feature in order of its id, by formula.
fn distances(drum: &Drum, point: Vec2) -> Vec<f64> {
    let mut found = vec![];
    for outline in 0..drum.outlines().count() {
        let edges = edges_of(drum, outline);
        for &(start, end) in &edges {
            found.extend([(start - point).norm(), distance(point, (start, end))]);
        }
        if edges[0].0 != edges[edges.len() - 1].1 {
            found.push((edges[edges.len() - 1].1 - point).norm());
        }
    }
    found
}

fn features(drum: &Drum) -> std::ops::Range<FeatureId> {
    1..drum.feature_count()
}

/// The features that answer, with their proximities.
fn answers(drum: &Drum, center: Vec2) -> Vec<(FeatureId, Proximity)> {
    features(drum).filter_map(|feature| Some((feature, drum.proximity(feature, center)?))).collect()
}

#[test]
fn features_near_are_those_within_reach() {
    for parameters in all() {
        let drum = drum(&parameters);
        for (point, reach) in cloud(1000).zip([0.0, 0.01, 0.05, 0.2].into_iter().cycle()) {
            let mut found = vec![7];
            drum.features_near(point, reach, &mut found);
            let expected = distances(&drum, point);
            let near = features(&drum).filter(|&feature| expected[feature as usize - 1] <= reach);
            assert!(found.into_iter().eq(std::iter::once(7).chain(near)));
        }
    }
}

#[test]
fn a_drum_four_times_as_large_gives_the_same_bits() {
    for parameters in all().into_iter().chain([joints::drawing()]) {
        let mut large = parameters.clone();
        large.radius = large.radius.map(|radius| 4.0 * radius);
        let baffles = &mut large.baffles[0];
        for length in [&mut baffles.height, &mut baffles.base, &mut baffles.tip] {
            *length *= 4.0;
        }
        let points = baffles.points.iter_mut().flatten().chain(large.walls.iter_mut().flatten());
        points.flatten().for_each(|length| *length *= 4.0);
        let (drum, large) = (drum(&parameters), drum(&large));
        for point in cloud(2000) {
            let (mut near, mut large_near) = (vec![], vec![]);
            drum.features_near(point, 0.03, &mut near);
            large.features_near(4.0 * point, 0.12, &mut large_near);
            assert_eq!(near, large_near);
            assert_eq!((4.0 * drum.clearance(point)).to_bits(), large.clearance(4.0 * point).to_bits());
            let scaled = answers(&drum, point)
                .into_iter()
                .map(|(feature, p)| (feature, Proximity { distance: 4.0 * p.distance, ..p }));
            assert!(scaled.eq(answers(&large, 4.0 * point)));
        }
    }
}

#[test]
fn clearance_is_negative_in_solids_only() {
    let drum = drum(&triangles());
    assert!((drum.clearance(Vec2::zeros()) - 0.1875).abs() < 1e-15);
    assert!((drum.clearance(Vec2::new(-0.2, 0.0)) - 0.0375).abs() < 1e-15);
    assert!(drum.clearance(Vec2::new(0.2, 0.0)) < -0.005 && drum.clearance(Vec2::new(-0.24, 0.0)) < 0.0);
    assert!((drum.clearance(Vec2::new(0.18, 0.0)) - 0.0075).abs() < 1e-15);
    let floor = wall(&[[0.0, 0.0], [1.0, 0.0]]);
    assert_eq!((floor.clearance(Vec2::new(0.5, -0.2)), floor.clearance(Vec2::new(0.5, 0.2))), (0.2, 0.2));
    let nothing = DrumParameters { walls: vec![], ..walls() };
    assert_eq!(Drum::new(&nothing).unwrap().clearance(Vec2::zeros()), f64::INFINITY);
}

#[test]
fn solids_contain_what_has_negative_clearance() {
    for parameters in all() {
        let drum = drum(&parameters);
        for point in cloud(4000) {
            let solid = drum.solid_at(point);
            let outside = drum.radius().is_some_and(|radius| point.norm() > radius);
            let baffle = (0..drum.baffle_count()).find(|&index| signed_distance(&drum, index, point) < 0.0);
            assert_eq!(solid, if outside { Some(0) } else { baffle.map(|index| index + 1) });
            assert_eq!(solid.is_some(), drum.clearance(point) < 0.0);
        }
    }
    let triangles = drum(&triangles());
    let points = [[0.2, 0.0], [-0.1, 0.173], [-0.1, -0.173], [0.0, 0.24], [0.1, 0.1], [0.0, 0.0]];
    let expected = [Some(1), Some(2), Some(3), Some(0), None, None];
    assert_eq!(points.map(|point| triangles.solid_at(point.into())), expected);
    assert_eq!(drum(&walls()).solid_at(Vec2::new(0.15, -0.05)), None);
}

#[test]
fn surfaces_have_names() {
    let wall = vec![[0.0, 0.0], [0.01, 0.0]];
    let drum = drum(&DrumParameters { walls: vec![wall.clone(), wall], ..triangles() });
    let names = drum.surface_names();
    assert_eq!(names, ["rim", "baffle 1", "baffle 2", "baffle 3", "wall 1", "wall 2"]);
}

#[test]
fn neighbors_are_at_most_two_places_apart_in_one_outline() {
    let baffles = drum(&triangles());
    let near_first: Vec<FeatureId> = (0..20).filter(|&feature| baffles.adjacent(1, feature)).collect();
    assert_eq!(near_first, [1, 2, 3, 5, 6]);
    assert!(baffles.adjacent(RIM, RIM) && !baffles.adjacent(RIM, 1));
    let walls = drum(&walls());
    let near_end: Vec<FeatureId> = (0..40).filter(|&feature| walls.adjacent(9, feature)).collect();
    assert_eq!(near_end, [7, 8, 9]);
}

#[test]
fn features_know_their_surface() {
    let drum = drum(&DrumParameters { walls: vec![vec![[0.0, 0.0], [0.01, 0.0]]], ..triangles() });
    let surfaces: Vec<usize> = (0..22).map(|feature| drum.surface_of(feature)).collect();
    assert_eq!(surfaces, [0, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 3, 3, 3, 3, 3, 3, 4, 4, 4]);
    assert_eq!((drum.baffle_count(), drum.surface_count()), (3, 5));
    assert_eq!(drum.proximity(RIM, Vec2::zeros()), None);
}

#[test]
fn unusable_walls_are_refused() {
    let message = |wall: &[[f64; 2]]| {
        let walls = vec![vec![[0.0, 0.0], [1.0, 0.0]], wall.to_vec()];
        DrumParameters { walls, ..walls_free() }.validate().unwrap_err().to_string()
    };
    assert_eq!(
        message(&[[0.0, 0.0]]),
        "drum.walls[1] is a line of 1 points, but must be a line of at least 2 points"
    );
    assert_eq!(
        message(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0]]),
        "drum.walls[1] is a line whose points 2 and 3 are the same, but must be a line of distinct points"
    );
    assert_eq!(
        message(&[[0.0, 0.0], [1.0, 0.0], [0.5, 0.0]]),
        "drum.walls[1] is a line that folds back on itself at point 2, but must be a line that does not"
    );
    assert_eq!(
        message(&[[0.0, f64::INFINITY], [1.0, 0.0]]),
        "drum.walls[1] is inf, but must be a finite number"
    );
}

fn walls_free() -> DrumParameters {
    DrumParameters { walls: vec![], ..walls() }
}

#[test]
fn the_diameter_has_to_be_positive() {
    let message =
        |radius| DrumParameters { radius: Some(radius), ..walls_free() }.validate().unwrap_err().to_string();
    assert_eq!(message(-0.2), "drum.diameter is -0.4, but must be a positive finite number");
    assert_eq!(message(f64::NAN), "drum.diameter is NaN, but must be a positive finite number");
}

#[test]
fn parameters_keep_their_bits_in_json() {
    for parameters in all() {
        let json = serde_json::to_string(&parameters).unwrap();
        assert_eq!(serde_json::from_str::<DrumParameters>(&json).unwrap(), parameters);
    }
    assert!(serde_json::from_str::<DrumParameters>(r#"{"radius": 1.0}"#).is_err());
}
