//! Which features answer, and how far away they are.

use drumrs::physics::vector::perpendicular;

use super::*;

#[test]
fn closest_answer_is_the_distance_to_the_outlines() {
    for parameters in all() {
        let drum = drum(&parameters);
        let is_free = |point| (0..drum.outlines().count()).all(|o| signed_distance(&drum, o, point) > 0.0);
        for point in cloud(4000).filter(|&point| is_free(point)) {
            let mut near = vec![];
            drum.features_near(point, 1.0, &mut near);
            let found = near.iter().filter_map(|&feature| drum.proximity(feature, point));
            let closest = found.map(|proximity| proximity.distance).fold(f64::INFINITY, f64::min);
            let expected = distances(&drum, point).into_iter().fold(f64::INFINITY, f64::min);
            assert!((closest - expected).abs() < 1e-15, "{point} {closest} {expected}");
        }
    }
}

/// Whether the line between two points, its ends apart, meets an edge.
pub(super) fn blocks((start, end): (Vec2, Vec2), from: Vec2, to: Vec2) -> bool {
    let (ray, edge) = (to - from, end - start);
    let scale = cross(ray, edge);
    let (along, across) = (cross(start - from, edge) / scale, cross(start - from, ray) / scale);
    along > 1e-9 && along < 1.0 - 1e-9 && (0.0..=1.0).contains(&across)
}

fn is_closed(edges: &[(Vec2, Vec2)]) -> bool {
    edges[0].0 == edges[edges.len() - 1].1
}

/// Number of vertices and edges together.
fn place_count(edges: &[(Vec2, Vec2)]) -> usize {
    2 * edges.len() + usize::from(!is_closed(edges))
}

/// The features of an outline that ought to answer, as places along it, by definition.
fn expected_answers(drum: &Drum, outline: usize, point: Vec2) -> Vec<usize> {
    if signed_distance(drum, outline, point) < 0.0 {
        return vec![];
    }
    let edges = edges_of(drum, outline);
    let closed = is_closed(&edges);
    let along = |edge: usize| {
        let (start, end) = edges[edge];
        dot(point - start, end - start) / (end - start).norm_squared()
    };
    let before = |vertex: usize| if vertex > 0 { Some(vertex - 1) } else { closed.then(|| edges.len() - 1) };
    let mut places = vec![];
    for place in 0..place_count(&edges) {
        let (index, is_edge) = (place / 2, place % 2 == 1);
        let target = if is_edge {
            edges[index].0 + (edges[index].1 - edges[index].0) * along(index)
        } else {
            edges.get(index).map_or(edges[edges.len() - 1].1, |edge| edge.0)
        };
        let own = if is_edge {
            along(index) > 0.0 && along(index) < 1.0
        } else {
            before(index).is_none_or(|edge| along(edge) >= 1.0)
                && (index == edges.len() || along(index) <= 0.0)
        };
        if own && !edges.iter().any(|&edge| blocks(edge, point, target)) {
            places.push(place);
        }
    }
    places
}

#[test]
fn visible_features_answer_and_no_others() {
    for parameters in all() {
        let drum = drum(&parameters);
        for point in cloud(4000) {
            let answering: Vec<FeatureId> =
                answers(&drum, point).into_iter().map(|answer| answer.0).collect();
            let mut expected = vec![];
            let mut first = 1;
            for outline in 0..drum.outlines().count() {
                let places = expected_answers(&drum, outline, point);
                expected.extend(places.into_iter().map(|place| first + place as FeatureId));
                first += place_count(&edges_of(&drum, outline)) as FeatureId;
            }
            assert_eq!(answering, expected, "{point}");
        }
    }
}

#[test]
fn every_answer_points_to_its_own_feature() {
    for parameters in all() {
        let drum = drum(&parameters);
        for point in cloud(1000) {
            let expected = distances(&drum, point);
            for (feature, Proximity { distance, direction }) in answers(&drum, point) {
                assert!((direction.norm() - 1.0).abs() < 1e-15);
                assert!((distance - expected[feature as usize - 1]).abs() < 1e-15);
                // The closest point is part of the boundary.
                let foot = point + direction * distance;
                let on = |outline| signed_distance(&drum, outline, foot).abs() < 1e-15;
                assert!((0..drum.outlines().count()).any(on));
            }
        }
    }
}

#[test]
fn solids_answer_once_around_a_convex_baffle() {
    for parameters in [triangles(), trapezoids()] {
        let drum = drum(&parameters);
        for point in cloud(4000) {
            for index in 0..drum.baffle_count() {
                let answers =
                    answers(&drum, point).iter().filter(|a| drum.surface_of(a.0) == index + 1).count();
                assert_eq!(answers, usize::from(signed_distance(&drum, index, point) > 0.0));
            }
        }
    }
}

#[test]
fn distance_and_direction_are_continuous_round_a_tip() {
    let drum = drum(&triangles());
    let steps = 4000;
    // A straight path past the tip at (0.1875, 0), 0.0125 m in front of it.
    let height = |k: i32| 0.08 * f64::from(k) / f64::from(steps) - 0.04;
    let mut passed = vec![];
    let mut previous: Option<Proximity> = None;
    for center in (0..=steps).map(|k| Vec2::new(0.175, height(k))) {
        let near: Vec<_> = answers(&drum, center).into_iter().filter(|a| drum.surface_of(a.0) == 1).collect();
        let &[(feature, now)] = near.as_slice() else { panic!("{} answers at {center}", near.len()) };
        if let Some(before) = previous.replace(now) {
            assert!((now.distance - before.distance).abs() <= 2.1e-5);
            assert!((now.direction - before.direction).norm() <= 2.1e-5 / 0.0125);
        }
        passed.push(feature);
    }
    passed.dedup();
    // Lower edge, tip, upper edge.
    assert_eq!(passed, [4, 3, 2]);
}

/// Points above the corner of a wall or solid on the borders of its regions, and next to them by round-off.
pub(super) fn borders(corner: Vec2, normals: [Vec2; 2]) -> impl Iterator<Item = Vec2> {
    let shifts = (-3..=3).flat_map(|i| (-3..=3).map(move |j| Vec2::new(f64::from(i), f64::from(j)) * 1e-17));
    let heights = (1..40).map(|k| 3.7e-4 * f64::from(k));
    normals.into_iter().flat_map(move |normal| {
        let shifts = shifts.clone();
        heights
            .clone()
            .flat_map(move |height| shifts.clone().map(move |shift| corner + normal * height + shift))
    })
}

#[test]
fn exactly_one_answers_on_the_borders_of_its_regions() {
    // Bends from none at all, through some that only round-off can tell from it, to an acute one.
    for bend in [0.0, 1e-17, 1e-16, 1e-15, 1e-12, 1e-3, 0.3, 0.8, 3.0] {
        let end = Vec2::new(0.1, 0.07 - 0.1 * bend);
        let wall = wall(&[[-0.1, -0.07], [0.0, 0.0], end.into()]);
        let normals = [Vec2::new(0.1, 0.07), end].map(|along| perpendicular(along).normalize());
        for point in borders(Vec2::zeros(), normals) {
            assert_eq!(answers(&wall, point).len(), 1, "bend {bend} at {point}");
        }
    }
}

#[test]
fn exactly_one_answers_on_the_borders_round_a_turned_baffle() {
    for parameters in [triangles(), trapezoids()] {
        let drum = drum(&parameters);
        for baffle in 0..drum.baffle_count() {
            let edges = edges_of(&drum, baffle);
            for (one, next) in edges.iter().zip(edges.iter().cycle().skip(1)) {
                let normals = [one, next].map(|&(start, end)| perpendicular(start - end).normalize());
                for point in borders(one.1, normals) {
                    let answering = answers(&drum, point);
                    assert_eq!(answering.iter().filter(|a| drum.surface_of(a.0) == baffle + 1).count(), 1);
                }
            }
        }
    }
}

#[test]
fn a_concave_corner_is_two_contacts() {
    let bent = wall(&[[0.0, 0.1], [0.0, 0.0], [0.1, 0.0]]);
    let inside = answers(&bent, Vec2::new(0.02, 0.01));
    assert_eq!(inside.iter().map(|answer| answer.0).collect::<Vec<_>>(), [2, 4]);
    for ((_, proximity), offset) in inside.into_iter().zip([Vec2::new(-0.02, 0.0), Vec2::new(0.0, -0.01)]) {
        assert!((proximity.direction * proximity.distance - offset).norm() < 1e-16);
    }
    let outside = answers(&bent, Vec2::new(-0.03, -0.04));
    assert_eq!(outside.iter().map(|answer| answer.0).collect::<Vec<_>>(), [3]);
    assert!((outside[0].1.distance - 0.05).abs() < 1e-16);
    assert!((outside[0].1.direction - Vec2::new(0.6, 0.8)).norm() < 1e-15);
    // The slot of a hook: the tooth and the stem.
    let hooks = drum(&hooks());
    let slot: Vec<FeatureId> = answers(&hooks, Vec2::new(0.1915, -0.012))
        .into_iter()
        .filter(|(_, proximity)| proximity.distance < 0.02)
        .map(|(feature, _)| feature)
        .collect();
    assert_eq!(slot.len(), 2);
    assert!(slot.iter().all(|feature| feature % 2 == 0));
}

#[test]
fn nothing_is_felt_through_a_wall() {
    // A disc below the lower leg of an acute bend, one above a thin box, one beyond the end of a wall.
    let bend = wall(&[[0.1, 0.0], [0.0, 0.0], [0.1, 0.03]]);
    assert_eq!(answers(&bend, Vec2::new(0.05, -0.01)).iter().map(|a| a.0).collect::<Vec<_>>(), [2]);
    let above = Vec2::new(0.05, 0.015) + Vec2::new(-0.003, 0.01);
    assert_eq!(answers(&bend, above).iter().map(|a| a.0).collect::<Vec<_>>(), [4]);
    assert_eq!(answers(&bend, Vec2::new(0.05, 0.007)).iter().map(|a| a.0).collect::<Vec<_>>(), [2, 4]);
    let thin = wall(&[[0.0, 0.0], [0.1, 0.0], [0.1, 0.001], [0.0, 0.001], [0.0, 0.0]]);
    assert_eq!(answers(&thin, Vec2::new(0.05, 0.01)).iter().map(|a| a.0).collect::<Vec<_>>(), [6]);
    assert_eq!(answers(&thin, Vec2::new(-0.01, 0.01)).iter().map(|a| a.0).collect::<Vec<_>>(), [7]);
    assert_eq!(answers(&wall(&[[0.0, 0.0], [0.1, 0.0]]), Vec2::new(0.13, 0.04))[0].1.distance, 0.05);
}

#[test]
fn a_center_on_the_boundary_still_has_a_direction() {
    let bent = wall(&[[0.0, 0.1], [0.0, 0.0], [0.1, 0.0]]);
    for (point, feature) in [([0.0, 0.0], 3), ([0.05, 0.0], 4), ([0.1, 0.0], 5)] {
        let proximity = bent.proximity(feature, point.into()).unwrap();
        assert_eq!((proximity.distance, proximity.direction.norm()), (0.0, 1.0));
    }
}
