//! Pair lists and near lists against brute force.

use std::collections::BTreeSet;

use crate::common::*;
use drumrs::engine::contacts::ContactRecord;
use drumrs::engine::forces::{Bodies, StepInputs};
use drumrs::engine::pair_list::PairList;
use drumrs::engine::parallel::{CHUNK, Threads};
use drumrs::io::config::SimulationConfig;
use drumrs::physics::drum::{Drum, RIM};
use drumrs::physics::particles::Particles;
use drumrs::physics::vector::{Rotation, Vec2};
use drumrs::simulation::Simulation;
use drumrs::simulation::initial_state::InitialState;
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
        let (drum, table) = (Drum::new(&config.drum).unwrap(), config.contact.table().unwrap());
        let positions: Vec<Vec2> = bundles.iter().map(|b| Vec2::new(b.0, b.1)).collect();
        let radii: Vec<f64> = bundles.iter().map(|b| if same { 0.01 } else { b.2 }).collect();
        let particles = Particles::at_rest(positions.clone(), radii.clone(), vec![0; radii.len()], |_| 1000.0, false);
        let rotation = Rotation::new(angle);
        let inputs = StepInputs {
            time: [TIME_STEP, 1.0 / TIME_STEP],
            drum: &drum,
            rotation,
            angular_velocity: 0.0,
            bodies: Bodies {
                radius: same.then_some(0.01),
                radii: &particles.radii,
                masses: &particles.masses,
                species: &particles.species,
                table: &table,
            },
            step: 0,
            records_gross_work: false,
            profile: None,
        };
        let mut list = PairList::new(particles.len(), skin, particles.largest_radius());
        list.rebuild(&particles.positions, &inputs, &Threads::new(threads).unwrap());

        for i in 0..particles.len() {
            let (positions, radii) = (&positions, &radii);
            let within = |part: f64| {
                let gap = move |j: usize| (positions[j] - positions[i]).norm() - radii[i] - radii[j];
                (i + 1..particles.len()).filter(move |&j| gap(j) < skin + part * DRUM_RADIUS).map(|j| j as u32)
            };
            let neighbors = &list.chunks[i / CHUNK];
            let pairs = &neighbors.pairs;
            let listed: Vec<u32> = pairs.of(i as u32).map(|place| pairs.pairs()[place].1).collect();
            let is_watched = |&other: &u32| {
                let chunk = other as usize / CHUNK;
                chunk == i / CHUNK || neighbors.watched.contains(&(chunk as u32))
            };
            prop_assert!(listed.iter().all(is_watched));
            prop_assert!(listed.windows(2).all(|two| two[0] < two[1]));
            prop_assert!(within(0.0).all(|other| listed.contains(&other)));
            let could_be: Vec<u32> = within(1e-5).collect();
            prop_assert!(listed.iter().all(|other| could_be.contains(other)));

            // The rim is near everybody; the near list asks for it.
            let features = &neighbors.features;
            let listed: Vec<u32> = features.of(i as u32).map(|place| features.pairs()[place].1).collect();
            prop_assert!(listed.is_sorted());
            let center = rotation.apply_inverse(positions[i]);
            for feature in 1..drum.feature_count() {
                if drum.proximity(feature, center).is_some_and(|near| near.distance <= radii[i] + skin) {
                    prop_assert!(listed.contains(&feature));
                }
            }
        }
    }
}

/// Keys of contacts: of pairs, with the drum.
type Keys = [BTreeSet<(u32, u32)>; 2];

/// Overlaps below this are round-off [m].
const ROUND_OFF: f64 = 1e-15;

/// What touches by more than `least`, found by looking at all bodies.
fn touching(simulation: &Simulation, least: f64) -> Keys {
    let (p, drum) = (&simulation.state().particles, simulation.drum());
    let rotation = Rotation::new(simulation.drum_angle());
    let [mut pairs, mut walls] = Keys::default();
    for i in 0..p.len() {
        let others = (i + 1..p.len()).filter(|&j| {
            let (apart, reach) = (p.positions[j] - p.positions[i], p.radii[i] + p.radii[j] - least);
            apart.norm_squared() < reach * reach
        });
        pairs.extend(others.map(|j| (i as u32, j as u32)));
        let center = rotation.apply_inverse(p.positions[i]);
        let rim = drum.radius().map(|rim| rim - center.norm());
        let distance = |feature: u32| match feature {
            RIM => rim,
            _ => drum.proximity(feature, center).map(|near| near.distance),
        };
        let features = (0..drum.feature_count())
            .filter(|&feature| distance(feature).is_some_and(|distance| p.radii[i] - distance > least));
        walls.extend(features.map(|feature| (i as u32, feature)));
    }
    [pairs, walls]
}

/// Runs on and looks now and then, at steps in no order, whether the contacts are what touches. Returns how many pairs
/// and walls were seen to open.
fn watch(simulation: &mut Simulation, looks: u64, longest: u64) -> [usize; 2] {
    let (mut opened, mut last) = ([0; 2], Keys::default());
    for look in 0..looks {
        simulation.run(1 + look * 7919 % longest).expect("a stable run");
        let contacts = simulation.contacts();
        let found =
            [contacts.pairs, contacts.walls].map(|list| list.iter().map(ContactRecord::key).collect());
        let [clearly, barely] = [ROUND_OFF, -ROUND_OFF].map(|least| touching(simulation, least));
        let step = simulation.state().step;
        for kind in 0..2 {
            let unseen: Vec<_> = clearly[kind].difference(&found[kind]).collect();
            assert!(unseen.is_empty(), "step {step}: {unseen:?} touch and are no contacts");
            let apart: Vec<_> = found[kind].difference(&barely[kind]).collect();
            assert!(apart.is_empty(), "step {step}: {apart:?} are contacts and do not touch");
            opened[kind] += found[kind].difference(&last[kind]).count();
        }
        last = found;
    }
    opened
}

/// A drum that throws its load about, and turns back again and again.
fn thrown(count: usize, baffle_count: usize, radius: f64) -> SimulationConfig {
    let mut config = baseline(count, baffle_count);
    config.drum.radius = Some(radius);
    config.load.start_speed = 3.0;
    let speed = |k: u32| if k.is_multiple_of(2) { 3.0 * SPEED } else { -2.0 * SPEED };
    config.rotation.knots = (0..40).map(|k| [0.002 * f64::from(k), speed(k)]).collect();
    config
}

/// The same load with radii of many sizes.
fn mixed(config: &SimulationConfig) -> Simulation {
    let source = Simulation::new(config.clone(), 7, 1).expect("a load that fits");
    let p = &source.state().particles;
    let initial = InitialState {
        positions: p.positions.clone(),
        velocities: Some(p.velocities.clone()),
        radii: Some((0..p.len()).map(|i| RADIUS * (1.0 - 0.02 * (i * 37 % 31) as f64)).collect()),
        angular_velocities: Some((0..p.len()).map(|i| 20.0 - (i % 41) as f64).collect()),
        ..InitialState::default()
    };
    let mut config = config.clone();
    config.run.time_step = None;
    start(&config, initial)
}

#[test]
fn whatever_touches_is_a_contact() {
    for baffle_count in [0, 3] {
        let config = thrown(300 - 20 * baffle_count, baffle_count, DRUM_RADIUS);
        let mut equal = Simulation::new(config.clone(), 7, 1).expect("a load that fits");
        let mut unequal = mixed(&config);
        for simulation in [&mut equal, &mut unequal] {
            let opened = watch(simulation, 2000, 5);
            assert!(opened[0] > 100 && opened[1] > 20, "{baffle_count} baffles: {opened:?}");
        }
    }
}

/// Several chunks, which hold their near lists for different times, and a sort in memory.
#[test]
fn whatever_touches_is_a_contact_in_several_chunks() {
    let config = thrown(3000, 3, 0.9);
    let mut equal = Simulation::new(config.clone(), 7, 1).expect("a load that fits");
    let mut unequal = mixed(&config);
    for simulation in [&mut equal, &mut unequal] {
        let opened = watch(simulation, 200, 90);
        assert!(opened[0] > 1000 && opened[1] > 50, "{opened:?}");
        assert!(simulation.state().step > drumrs::engine::memory_order::INTERVAL, "the run must hold a sort");
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
