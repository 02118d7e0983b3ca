//! Walls that meet: felt as one outline, however they are drawn.

use std::f64::consts::TAU;

use drumrs::physics::vector::perpendicular;

use super::proximity::blocks;
use super::*;

type Wall = Vec<[f64; 2]>;

/// Walls alone, as a drum.
fn network(walls: &[Wall]) -> Drum {
    drum(&DrumParameters { walls: walls.to_vec(), ..walls_free() })
}

/// A wall of two points.
fn line(start: [f64; 2], end: [f64; 2]) -> Wall {
    vec![start, end]
}

/// The polyline in single lines: all in order, or every other one turned round and the second half first.
fn loose(polyline: &[[f64; 2]], shuffled: bool) -> Vec<Wall> {
    let mut lines: Vec<Wall> = polyline.windows(2).map(<[_]>::to_vec).collect();
    if shuffled {
        lines.iter_mut().step_by(2).for_each(|line| line.reverse());
        let half = lines.len() / 2;
        lines.rotate_left(half);
    }
    lines
}

/// A closed polygon of 60 corners.
fn circle(radius: f64) -> Wall {
    let corner = |k: u32| TAU * f64::from(k % 60) / 60.0;
    (0..=60).map(|k| [radius * libm::cos(corner(k)), radius * libm::sin(corner(k))]).collect()
}

/// A T, an X, a star, lines that overlap, a bow tie and a circle of loose lines.
pub(super) fn drawing() -> DrumParameters {
    let mut walls = vec![line([-0.2, 0.15], [0.0, 0.17]), line([-0.1, 0.16 + 1e-9], [-0.07, 0.24])];
    walls.extend([line([0.05, 0.1], [0.2, 0.22]), line([0.06, 0.21], [0.17, 0.11])]);
    for angle in [0.2, 0.5, 1.9, 4.0, 5.5] {
        walls.push(line([-0.15, -0.15], [-0.15 + 0.07 * libm::cos(angle), -0.15 + 0.07 * libm::sin(angle)]));
    }
    walls.extend([line([0.0, -0.24], [0.1, -0.2]), line([0.2, -0.16], [0.05, -0.22])]);
    walls.push(vec![[0.12, -0.1], [0.22, 0.0], [0.22, -0.1], [0.12, 0.0]]);
    walls.extend(loose(&circle(0.05), true));
    DrumParameters { walls, ..walls_free() }
}

/// The answers without their features, nearest first.
fn felt(drum: &Drum, center: Vec2) -> Vec<Proximity> {
    let mut felt: Vec<Proximity> = answers(drum, center).into_iter().map(|answer| answer.1).collect();
    felt.sort_by(|a, b| {
        a.distance
            .total_cmp(&b.distance)
            .then(a.direction.x.total_cmp(&b.direction.x))
            .then(a.direction.y.total_cmp(&b.direction.y))
    });
    felt
}

/// Fails unless both drums answer alike round the origin, up to a shift of `tolerance` [m].
fn feel_alike(one: &Drum, other: &Drum, tolerance: f64) {
    // The first point lies on the extension of a wall, where round-off tells whether one sees past it.
    for center in cloud(4000).skip(1) {
        let (one, other) = (felt(one, center), felt(other, center));
        assert_eq!(one.len(), other.len(), "{center} {one:?} {other:?}");
        for (a, b) in one.iter().zip(&other) {
            assert!((a.distance - b.distance).abs() <= tolerance, "{center} {a:?} {b:?}");
            let shift = a.direction * a.distance - b.direction * b.distance;
            assert!(shift.norm() <= 4.0 * tolerance, "{center} {a:?} {b:?}");
        }
    }
}

const CORNERS: [[[f64; 2]; 3]; 4] = [
    [[-0.1, -0.1], [0.0, 0.0], [0.1, -0.1]],
    [[-0.1, -0.07], [0.0, 0.0], [0.1, 0.07]],
    [[-0.1, 0.0], [0.0, 0.0], [0.1, 0.0]],
    [[-0.1, 0.0], [0.0, 0.0], [-0.07, 0.03]],
];

#[test]
fn two_walls_that_share_a_point_are_a_polyline() {
    for corner in CORNERS {
        let [a, o, b] = corner;
        let polyline = wall(&corner);
        let in_order = network(&[line(a, o), line(o, b)]);
        for center in cloud(4000) {
            assert_eq!(answers(&in_order, center), answers(&polyline, center));
        }
        for walls in [[line(o, a), line(o, b)], [line(b, o), line(a, o)], [line(b, o), line(o, a)]] {
            feel_alike(&network(&walls), &polyline, 1e-15);
        }
    }
}

#[test]
fn ends_that_gape_or_overlap_by_nanometers_are_one_point() {
    for [a, o, b] in CORNERS {
        for (dx, dy) in [(1e-9, 0.0), (-1e-9, 0.0), (0.0, 1e-9), (1e-9, -1e-9)] {
            let drawn = network(&[line(a, o), line([o[0] + dx, o[1] + dy], b)]);
            feel_alike(&drawn, &wall(&[a, o, b]), 1e-9);
            assert_eq!(drawn.feature_count(), 6);
        }
    }
}

#[test]
fn exactly_one_answers_on_the_borders_at_a_joint() {
    for bend in [0.0, 1e-17, 1e-16, 1e-15, 1e-12, 1e-3, 0.3, 0.8, 3.0] {
        let end = Vec2::new(0.1, 0.07 - 0.1 * bend);
        let normals = [Vec2::new(0.1, 0.07), end].map(|along| perpendicular(along).normalize());
        let (a, o, b) = ([-0.1, -0.07], [0.0, 0.0], end.into());
        // The third wall stands on the other side.
        let below = line(o, [0.02, -0.09]);
        for walls in
            [vec![line(a, o), line(b, o)], vec![line(b, o), line(a, o)], vec![below, line(a, o), line(o, b)]]
        {
            let joined = network(&walls);
            for point in proximity::borders(Vec2::zeros(), normals) {
                assert_eq!(answers(&joined, point).len(), 1, "bend {bend} at {point}");
            }
        }
    }
}

#[test]
fn a_floor_of_loose_lines_is_one_wall() {
    let at = |k: i32| [0.05 * f64::from(k) - 0.5, 0.013 * f64::from(k)];
    let points: Wall = (0..=20).map(at).collect();
    let whole = wall(&[points[0], points[20]]);
    let (along, up) = (Vec2::new(0.05, 0.013), perpendicular(Vec2::new(0.05, 0.013)).normalize());
    for shuffled in [false, true] {
        let floor = network(&loose(&points, shuffled));
        for k in 0..=2000 {
            let foot = Vec2::from(points[0]) + along * (0.01 * f64::from(k));
            for height in [-0.03, -1e-4, 1e-4, 0.011, 0.03] {
                let center = foot + up * height;
                let (loose, one) = (felt(&floor, center), felt(&whole, center));
                assert_eq!((loose.len(), one.len()), (1, 1), "{center}");
                assert!((loose[0].distance - one[0].distance).abs() < 1e-15);
                assert!((loose[0].direction - one[0].direction).norm() * height.abs() < 1e-15);
            }
        }
    }
}

#[test]
fn a_circle_of_loose_lines_is_a_closed_wall() {
    let circle = circle(0.2);
    let closed = wall(&circle);
    for shuffled in [false, true] {
        let lines = network(&loose(&circle, shuffled));
        assert_eq!(lines.feature_count(), 1 + 120);
        feel_alike(&lines, &closed, 1e-15);
    }
}

#[test]
fn a_wall_on_which_another_ends_is_whole_from_behind() {
    let whole = wall(&[[-0.2, 0.0], [0.2, 0.0]]);
    for (gap, lean) in [0.0, 1e-9, -1e-9].into_iter().flat_map(|gap| [(gap, 0.0), (gap, -0.1), (gap, -0.3)]) {
        let joint = network(&[line([-0.2, 0.0], [0.2, 0.0]), line([0.03, gap], [0.03 + lean, 0.1])]);
        for center in cloud(4000).filter(|center| center.y < 0.0 && center.x.abs() < 0.2) {
            let (joined, flat) = (felt(&joint, center), felt(&whole, center));
            assert_eq!((joined.len(), flat.len()), (1, 1), "{center}");
            assert!((joined[0].distance - flat[0].distance).abs() < 1e-15);
        }
        // Beside the stem both are felt.
        let [foot, stem] = [[0.03, 0.0], [lean, 0.1]].map(Vec2::from);
        let beside = foot + 0.2 * stem + 0.03 * perpendicular(stem);
        let distances: Vec<f64> = felt(&joint, beside).iter().map(|proximity| proximity.distance).collect();
        assert_eq!(distances.len(), 2);
        assert!((distances[0] - 0.03 * stem.norm()).abs() < 1e-9 && (distances[1] - beside.y).abs() < 1e-15);
    }
}

#[test]
fn overlapping_walls_are_one() {
    let whole = wall(&[[-0.2, -0.1], [0.2, 0.1]]);
    let overlapping = network(&[line([-0.2, -0.1], [0.1, 0.05]), line([0.2, 0.1], [-0.1, -0.05])]);
    let doubled = network(&[line([-0.2, -0.1], [0.2, 0.1]), line([0.2, 0.1], [-0.2, -0.1])]);
    for drawn in [&overlapping, &doubled] {
        feel_alike(drawn, &whole, 1e-15);
    }
    assert_eq!((doubled.feature_count(), doubled.surface_count()), (4, 3));
}

/// Vertices, and edges as pairs of them.
type Joined = (Vec<Vec2>, Vec<[usize; 2]>);

/// The index of a point among `vertices`, added if it is none of them.
fn index_of(point: Vec2, vertices: &mut Vec<Vec2>) -> usize {
    vertices.iter().position(|vertex| (vertex - point).norm() < 1e-8).unwrap_or_else(|| {
        vertices.push(point);
        vertices.len() - 1
    })
}

/// Lines cut at every end and every crossing of any two, by trying all: what lies upon each other counts once.
fn cut(walls: &[Wall]) -> Joined {
    let lines: Vec<(Vec2, Vec2)> =
        walls.iter().flat_map(|wall| wall.windows(2)).map(|ends| (ends[0].into(), ends[1].into())).collect();
    let crossing = |(start, end): (Vec2, Vec2), (other, far): (Vec2, Vec2)| {
        let fraction = cross(other - start, far - other) / cross(end - start, far - other);
        start + (end - start) * fraction
    };
    let crossings = lines.iter().flat_map(|&one| lines.iter().map(move |&other| crossing(one, other)));
    let points: Vec<Vec2> = lines.iter().flat_map(|&(start, end)| [start, end]).chain(crossings).collect();
    let (mut vertices, mut edges): Joined = (vec![], vec![]);
    for &(start, end) in &lines {
        let is_on = |point: &&Vec2| distance(**point, (start, end)) < 1e-8;
        let mut along: Vec<Vec2> = points.iter().filter(is_on).copied().collect();
        along.sort_by(|a, b| dot(a - start, end - start).total_cmp(&dot(b - start, end - start)));
        let mut along: Vec<usize> = along.into_iter().map(|point| index_of(point, &mut vertices)).collect();
        along.dedup();
        for ends in along.windows(2).map(|pair| [pair[0], pair[1]]) {
            let is_known = edges.iter().any(|&[a, b]| [a, b] == ends || [b, a] == ends);
            if !is_known {
                edges.push(ends);
            }
        }
    }
    (vertices, edges)
}

/// The closest points of the features that ought to answer, by definition.
fn expected_feet((vertices, edges): &Joined, center: Vec2) -> Vec<Vec2> {
    let lines: Vec<(Vec2, Vec2)> = edges.iter().map(|ends| (vertices[ends[0]], vertices[ends[1]])).collect();
    let along = |start: Vec2, end: Vec2| dot(center - start, end - start) / (end - start).norm_squared();
    let of_edges = lines.iter().filter_map(|&(start, end)| {
        let fraction = along(start, end);
        (fraction > 0.0 && fraction < 1.0).then(|| start + (end - start) * fraction)
    });
    let of_vertices = vertices.iter().enumerate().filter_map(|(index, &vertex)| {
        let others = edges.iter().filter(|ends| ends.contains(&index));
        let mut others = others.map(|ends| vertices[if ends[0] == index { ends[1] } else { ends[0] }]);
        others.all(|other| along(vertex, other) <= 0.0).then_some(vertex)
    });
    let is_visible = |foot: &Vec2| !lines.iter().any(|&line| blocks(line, center, *foot));
    of_edges.chain(of_vertices).filter(is_visible).collect()
}

#[test]
fn visible_features_of_networks_answer_and_no_others() {
    let parameters = drawing();
    let drum = drum(&parameters);
    // T, X, star, overlapping lines, bow tie, circle: each is hidden by itself only.
    let mut walls = parameters.walls.as_slice();
    let mut parts = vec![];
    for count in [2, 2, 5, 2, 1, 60] {
        let (own, others) = walls.split_at(count);
        parts.push(cut(own));
        walls = others;
    }
    let features: usize = parts.iter().map(|(vertices, edges)| vertices.len() + edges.len()).sum();
    assert_eq!((walls.len(), drum.feature_count() as usize), (0, 1 + features));
    for center in cloud(8000) {
        let expected: Vec<Vec2> = parts.iter().flat_map(|part| expected_feet(part, center)).collect();
        let found = answers(&drum, center);
        assert_eq!(found.len(), expected.len(), "{center}");
        for (feature, Proximity { distance, direction }) in found {
            let foot = center + direction * distance;
            assert!(expected.iter().any(|other| (foot - other).norm() < 1e-8), "{center}");
            assert!((drum.distance_to(feature, center) - distance).abs() < 1e-15);
        }
    }
}

#[test]
fn the_closest_point_of_a_network_is_felt_once_or_in_a_concave_corner() {
    let parameters = drawing();
    let drum = drum(&parameters);
    for center in cloud(4000) {
        let lines = parameters.walls.iter().flat_map(|wall| wall.windows(2));
        let closest = lines.map(|ends| distance(center, (ends[0].into(), ends[1].into())));
        let expected = closest.fold(f64::INFINITY, f64::min);
        assert!((felt(&drum, center)[0].distance - expected).abs() < 2e-9);
        assert!((drum.clearance(center) - expected).abs() < 2e-9);
        let mut near = vec![];
        drum.features_near(center, 0.05, &mut near);
        let within = answers(&drum, center).into_iter().filter(|answer| answer.1.distance <= 0.05);
        assert!(within.into_iter().all(|answer| near.contains(&answer.0)) && near.is_sorted());
    }
}

/// Lines between points of a lattice of 5 × 5, which meet in every way.
fn lattice_lines(seed: u64, count: usize) -> Vec<Wall> {
    let mut state = seed;
    let mut draw = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let cell = state >> 33;
        [0.1 * (cell % 5) as f64 - 0.2, 0.1 * (cell / 5 % 5) as f64 - 0.2]
    };
    let lines = std::iter::repeat_with(|| line(draw(), draw()));
    lines.filter(|line| line[0] != line[1]).take(count).collect()
}

#[test]
fn what_is_felt_does_not_depend_on_how_it_is_drawn() {
    for seed in 1..60 {
        let lines = lattice_lines(seed, 3 + seed as usize % 6);
        let mut shuffled = lines.clone();
        shuffled.iter_mut().step_by(2).for_each(|line| line.reverse());
        shuffled.rotate_left(2);
        shuffled.push(lines[1].clone());
        let (one, other) = (network(&lines), network(&shuffled));
        assert_eq!(one.feature_count(), other.feature_count());
        for center in cloud(400).skip(1) {
            let (felt, again) = (felt(&one, center), felt(&other, center));
            let closest = lines.iter().map(|line| distance(center, (line[0].into(), line[1].into())));
            assert!((felt[0].distance - closest.fold(f64::INFINITY, f64::min)).abs() < 1e-15);
            assert_eq!(felt.len(), again.len(), "drawing {seed} at {center}");
            let foot = |proximity: &Proximity| proximity.direction * proximity.distance;
            let close = |a: &Proximity, b: &Proximity| (foot(a) - foot(b)).norm() < 1e-15;
            assert!(
                felt.iter().all(|a| again.iter().any(|b| close(a, b))),
                "{felt:?} {again:?} {seed} {center}"
            );
        }
    }
}

#[test]
fn history_passes_through_a_joint() {
    // Wall 1 is cut at the joint: vertex 1, edge 2, joint 3, edge 4, vertex 5; wall 2: edge 6, vertex 7.
    let joint = network(&[line([-0.2, 0.0], [0.2, 0.0]), line([0.0, 0.0], [0.0, 0.1])]);
    let near =
        |feature: FeatureId| (0..10).filter(|&other| joint.adjacent(feature, other)).collect::<Vec<_>>();
    assert_eq!(near(2), [1, 2, 3, 4, 6]);
    assert_eq!(near(3), [1, 2, 3, 4, 5, 6, 7]);
    assert_eq!(near(6), [2, 3, 4, 6, 7]);
    assert_eq!(near(7), [3, 6, 7]);
    let surfaces: Vec<usize> = (0..8).map(|feature| joint.surface_of(feature)).collect();
    assert_eq!(surfaces, [0, 1, 1, 1, 1, 1, 2, 2]);
}

#[test]
fn walls_too_many_to_join_are_refused() {
    let ray = |k: u32| line([0.0, 0.0], Vec2::new(libm::cos(f64::from(k)), libm::sin(f64::from(k))).into());
    let walls = (0..4000).map(ray).collect();
    let message = DrumParameters { walls, ..walls_free() }.validate().unwrap_err().to_string();
    assert_eq!(message, "drum.walls is of 4001 corners in walls that meet, but must be of at most 4000");
}

#[test]
fn too_many_joints_are_refused() {
    let grid = |count: u32| {
        let lines = (0..count).flat_map(|k| {
            let at = f64::from(k) / f64::from(count);
            [line([-1.0, at], [2.0, at]), line([at, -1.0], [at, 2.0])]
        });
        let drum = Drum::new(&DrumParameters { walls: lines.collect(), ..walls_free() });
        drum.map(|drum| drum.feature_count()).map_err(|error| error.to_string())
    };
    // Crossings, ends and the edges between them.
    assert_eq!(grid(50), Ok(1 + 50 * 50 + 4 * 50 + 2 * 50 * 51));
    let corners = "drum.walls is of 5180 corners in walls that meet, but must be of at most 4000";
    assert_eq!(grid(70).unwrap_err(), corners);
    let places =
        "drum.walls is of walls that meet in more than 20000 places, but must be of walls that meet in fewer";
    assert_eq!(grid(400), Err(places.to_owned()));
}
