//! The Verlet list against brute force.

mod common;

use common::*;
use drumrs::contact::table::ContactTable;
use drumrs::io::config::SimulationConfig;
use drumrs::neighbors::{Surroundings, VerletList};
use drumrs::physics::drum::{Drum, RIM};
use drumrs::physics::particles::Particles;
use drumrs::physics::vector::{Rotation, Vec2};
use drumrs::start::InitialState;
use drumrs::threads::{CHUNK, Threads};
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() })]

    /// For any load of mixed sizes at any angle of the drum, the list holds the pairs within reach, and every part of the
    /// drum within reach; of other pairs only those that round-off could have brought there.
    #[test]
    fn the_list_is_brute_force(
        bundles in proptest::collection::vec((-0.22..0.22_f64, -0.22..0.22_f64, 0.002..0.02_f64), 1..700),
        skin in 0.0..0.02_f64,
        angle in -7.0..7.0_f64,
        threads in 1..3_usize,
        same in any::<bool>(),
    ) {
        let config = baseline(1, 3);
        let drum = Drum::new(&config.drum).unwrap();
        let positions: Vec<Vec2> = bundles.iter().map(|b| Vec2::new(b.0, b.1)).collect();
        let radii: Vec<f64> = bundles.iter().map(|b| if same { 0.01 } else { b.2 }).collect();
        let particles = Particles::at_rest(positions.clone(), radii.clone(), 1000.0, false);
        let mut table = ContactTable::empty(particles.len());
        let mut list = VerletList::new(skin);
        let rotation = Rotation::new(angle);
        let around = Surroundings { particles: &particles, drum: &drum, rotation };
        list.rebuild(around, &mut table, &Threads::new(threads).unwrap());

        for i in 0..particles.len() {
            let (positions, radii) = (&positions, &radii);
            let within = |part: f64| {
                let gap = move |j: usize| (positions[j] - positions[i]).norm() - radii[i] - radii[j];
                (i + 1..particles.len()).filter(move |&j| gap(j) < skin + part * DRUM_RADIUS).map(|j| j as u32)
            };
            let slots = &table.chunks[i / CHUNK];
            let pairs = &slots.pairs.candidates;
            let listed: Vec<u32> = pairs.of(i as u32).map(|candidate| pairs.key(candidate).1).collect();
            prop_assert!(listed.windows(2).all(|two| two[0] < two[1]));
            prop_assert!(within(0.0).all(|other| listed.contains(&other)));
            let could_be: Vec<u32> = within(1e-5).collect();
            prop_assert!(listed.iter().all(|other| could_be.contains(other)));

            let walls = &slots.walls.candidates;
            let listed: Vec<u32> = walls.of(i as u32).map(|candidate| walls.key(candidate).1).collect();
            prop_assert!(listed.is_sorted());
            let center = rotation.apply_inverse(positions[i]);
            let at_rim = positions[i].norm() + radii[i] + skin > DRUM_RADIUS;
            prop_assert_eq!(listed.contains(&RIM), at_rim);
            for feature in 1..drum.feature_count() {
                if drum.proximity(feature, center).is_some_and(|near| near.distance <= radii[i] + skin) {
                    prop_assert!(listed.contains(&feature));
                }
            }
        }
    }
}

/// Two bundles, or a bundle and a turning wall, that approach from just beyond the margin: the list must be made anew
/// before they meet, whoever moves.
#[test]
fn nothing_meets_unseen() {
    let skin = 0.3 * RADIUS;
    let ending = |config: &SimulationConfig, skin: f64, initial: &InitialState| {
        let mut config = config.clone();
        config.run.skin = Some(skin);
        let mut simulation = start(&config, initial.clone());
        simulation.run(3000).unwrap();
        bits(&simulation)
    };
    for margins in [1.01, 1.3, 1.6, 1.99] {
        let gap = margins * skin;
        let half = RADIUS + 0.5 * gap;
        let paddle = {
            let mut config = free_space();
            config.drum.walls = vec![vec![[0.2, 0.0], [0.8, 0.0]]];
            config.rotation.knots = vec![[0.0, 2.0]];
            config
        };
        let cases = [
            (free_space(), several(&[([-half, 0.0], [0.5, 0.0], 0.0), ([half, 0.0], [-0.5, 0.0], 0.0)])),
            (free_space(), several(&[([-half, 0.0], [1.0, 0.0], 0.0), ([half, 0.0], [0.0, 0.0], 0.0)])),
            (paddle, single([0.5, RADIUS + gap], [0.0, 0.0], 0.0)),
        ];
        for (config, initial) in cases {
            let seen = ending(&config, 0.0, &initial);
            assert_eq!(ending(&config, skin, &initial), seen, "{margins} margins");
        }
    }
}
