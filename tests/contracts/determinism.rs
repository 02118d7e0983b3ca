//! The bitwise promises: threads, skin, restart at an odd step, scaling by powers of two, mirror.

use crate::common::*;
use drumrs::engine::memory_order;
use drumrs::engine::parallel::Threads;
use drumrs::io::checkpoint;
use drumrs::io::config::SimulationConfig;
use drumrs::physics::vector::Vec2;
use drumrs::simulation::Simulation;
use drumrs::simulation::initial_state::InitialState;
use proptest::prelude::*;

/// Long enough for bundles to roll over each other, the rim and baffles once they lie in a bed.
const STEPS: u64 = 6001;

fn touching(simulation: &Simulation) -> (usize, usize) {
    simulation.contacts().counts()
}

fn packed(config: &SimulationConfig, threads: usize) -> Simulation {
    Simulation::new(config.clone(), 7, threads).expect("a load that fits")
}

fn after(config: &SimulationConfig, threads: usize, steps: u64) -> Simulation {
    let mut simulation = packed(config, threads);
    simulation.run(steps).expect("a stable run");
    simulation
}

/// The load of `config` as a bed at the bottom of the drum before it turns, with its last swing.
fn bed(config: &SimulationConfig) -> InitialState {
    let mut config = config.clone();
    config.rotation.knots = vec![[0.0, 0.0]];
    config.run.time_step = Some(1.5e-5);
    let mut simulation = packed(&config, 1);
    run(&mut simulation, 0.25);
    let p = &simulation.state().particles;
    InitialState {
        positions: p.positions.clone(),
        velocities: Some(p.velocities.clone()),
        angular_velocities: Some(p.angular_velocities.clone()),
        ..InitialState::default()
    }
}

/// A run of the load of `config` from its bed; it must hold contacts of both kinds.
fn tumbled(config: &SimulationConfig, initial: InitialState, steps: u64) -> Simulation {
    let mut simulation = start(config, initial);
    simulation.run(steps).expect("a stable run");
    let touching = touching(&simulation);
    assert!(touching.0 > 5 && touching.1 > 5, "{touching:?}");
    simulation
}

/// A drum large enough for the parallel passes.
fn large() -> SimulationConfig {
    let mut config = baseline(9000, 3);
    config.drum.radius = Some(1.8);
    config.drum.baffles[0].height = 0.3;
    config.drum.baffles[0].base = 0.38;
    config.load.start_speed = 5.0;
    config
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let config = large();
    assert!(Threads::new(2).unwrap().serve(config.load.count), "the load must be shared between threads");
    let one = after(&config, 1, 2500);
    let touching = touching(&one);
    assert!(touching.0 > 200 && touching.1 > 5, "the run must hold contacts: {touching:?}");
    for threads in [2, 3, 8] {
        let many = after(&config, threads, 2500);
        assert_eq!(bits(&one), bits(&many), "{threads} threads");
    }
}

/// A dense lattice, shaken: nearly every bundle has contacts, many of them with other chunks.
#[test]
fn threads_do_not_show_in_a_dense_load() {
    let count = 12_000;
    let spacing = 2.0 * RADIUS * (1.0 - 1e-3);
    let mut config = baseline(count, 0);
    config.drum.radius = Some(0.75 * spacing * (count as f64).sqrt());
    config.run.skin = Some(0.05 * RADIUS);
    config.run.sample_every = 53.0 * TIME_STEP;
    let side = (count as f64).sqrt() as usize;
    let place = |i: usize| {
        let (column, row) = (i % side, i / side);
        let shift = if row.is_multiple_of(2) { 0.0 } else { 0.5 };
        let (x, y) = (column as f64 + shift - 0.5 * side as f64, row as f64 - 0.5 * side as f64);
        Vec2::new(x * spacing, y * spacing * 0.75_f64.sqrt())
    };
    let wave = |i: usize, pace: usize| (i * pace % 1009) as f64 / 504.5 - 1.0;
    let initial = InitialState {
        positions: (0..count).map(place).collect(),
        velocities: Some((0..count).map(|i| Vec2::new(wave(i, 577), wave(i, 911))).collect()),
        angular_velocities: Some((0..count).map(|i| 50.0 * wave(i, 331)).collect()),
        ..Default::default()
    };
    let run = |threads: usize| {
        let mut simulation = Simulation::with_state(config.clone(), 1, threads, initial.clone()).unwrap();
        simulation.run(400).unwrap();
        simulation
    };
    let one = run(1);
    assert!(touching(&one).0 > count / 2, "the run must hold contacts: {:?}", touching(&one));
    for threads in [2, 5] {
        assert_eq!(bits(&one), bits(&run(threads)), "{threads} threads");
    }
}

/// Bundles of three sizes, whose lever arms differ.
#[test]
fn threads_do_not_show_in_a_mixed_load() {
    let config = large();
    let source = packed(&config, 1);
    let p = &source.state().particles;
    let run = |threads: usize| {
        let initial = InitialState {
            positions: p.positions.clone(),
            velocities: Some(p.velocities.clone()),
            radii: Some((0..p.len()).map(|i| RADIUS * (1.0 - 0.2 * (i % 3) as f64)).collect()),
            angular_velocities: Some((0..p.len()).map(|i| 20.0 - (i % 41) as f64).collect()),
            ..Default::default()
        };
        let mut config = config.clone();
        config.run.time_step = None;
        let mut simulation = Simulation::with_state(config, 1, threads, initial).unwrap();
        simulation.run(2500).unwrap();
        simulation
    };
    let one = run(1);
    assert!(touching(&one).0 > 50, "the run must hold contacts: {:?}", touching(&one));
    assert_eq!(bits(&one), bits(&run(3)));
    let residual = last(&one, "energy_residual");
    assert!(residual < 1e-11, "each bundle moves by its own mass: {residual:e}");
}

#[test]
fn any_skin_gives_the_same_bits() {
    for baffle_count in [0, 3] {
        let mut config = baseline(120, baffle_count);
        let bed = bed(&config);
        let reference = bits(&tumbled(&config, bed.clone(), STEPS));
        for skin in [0.0, 1e-5, 0.1 * RADIUS, 2.0 * RADIUS] {
            config.run.skin = Some(skin);
            assert_eq!(
                reference,
                bits(&tumbled(&config, bed.clone(), STEPS)),
                "{baffle_count} baffles, skin {skin}"
            );
        }
    }
}

#[test]
fn near_lists_for_any_number_of_steps_give_the_same_bits() {
    for config in [baseline(120, 0), baseline(120, 3), two_chunks(3)] {
        let bed = bed(&config);
        let bits_of = |near_steps: u32| {
            let mut simulation = start(&config, bed.clone());
            simulation.set_near_steps(near_steps);
            simulation.run(STEPS).expect("a stable run");
            bits(&simulation)
        };
        let reference = bits_of(32);
        for near_steps in [1, 7, 100] {
            assert_eq!(reference, bits_of(near_steps), "{} bundles, {near_steps} steps", config.load.count);
        }
    }
}

#[test]
fn a_restart_at_an_odd_step_gives_the_same_bits() {
    let small = baseline(120, 3);
    for mut straight in [tumbled(&small, bed(&small), 2345), after(&large(), 1, 1723)] {
        assert!(touching(&straight).0 > 5, "{:?}", touching(&straight));
        let saved = straight.to_checkpoint().unwrap();
        straight.run(400).unwrap();
        let mut resumed = Simulation::from_checkpoint(&saved, 2).unwrap();
        resumed.run(400).unwrap();
        assert_eq!(bits(&straight), bits(&resumed));
        assert_eq!(straight.to_checkpoint().unwrap(), resumed.to_checkpoint().unwrap());
    }
}

/// Bundles in a bed of two chunks, which meet across the border of the chunks.
fn two_chunks(baffle_count: usize) -> SimulationConfig {
    let mut config = baseline(700, baffle_count);
    config.drum.radius = Some(0.42);
    config
}

/// A restart in the midst of impacts, at odd steps, goes on bit for bit: of loads of one chunk, of two, of ten.
#[test]
fn restarts_while_contacts_are_open_do_not_show() {
    let mut many = large();
    many.load.count = 5000;
    let mut many_bare = many.clone();
    many_bare.drum.baffles[0].count = 0;
    let small = [(100, 0), (100, 3), (300, 0), (240, 3)].map(|(count, baffles)| baseline(count, baffles));
    for mut config in small.into_iter().chain([two_chunks(0), two_chunks(3), many, many_bare]) {
        config.load.start_speed = 4.0;
        config.run.sample_every = 300.0 * TIME_STEP;
        let mut straight = packed(&config, 1);
        straight.run(1501).unwrap();
        for steps in [1, 33, 76, 7] {
            let case = format!("{} bundles, step {}", config.load.count, straight.state().step);
            let saved = straight.to_checkpoint().unwrap();
            let mut resumed = Simulation::from_checkpoint(&saved, 2).unwrap();
            assert_eq!(saved, resumed.to_checkpoint().unwrap(), "{case}");
            let mut open = touching(&straight);
            while open.0 + open.1 == 0 {
                straight.run(1).unwrap();
                resumed.run(1).unwrap();
                open = touching(&straight);
            }
            straight.run(steps).unwrap();
            resumed.run(steps).unwrap();
            assert_eq!(bits(&straight), bits(&resumed), "{case}");
            assert_eq!(straight.to_checkpoint().unwrap(), resumed.to_checkpoint().unwrap(), "{case}");
        }
    }
}

/// A load that is sorted in memory, with ids in no order, close to its second sort.
fn to_be_sorted(skin: Option<f64>) -> Simulation {
    let count = memory_order::LEAST_COUNT + 51;
    let mut config = baseline(count, 3);
    config.drum.radius = Some(0.8);
    config.run.skin = skin;
    config.run.frame_every = 0.02;
    let source = packed(&config, 1).state().particles.positions.clone();
    let scrambled = |k: usize| source[k * 1009 % count];
    let initial = InitialState {
        positions: (0..count).map(scrambled).collect(),
        velocities: Some((0..count).map(|k| Vec2::from(polar(6.0, (k * k) as f64))).collect()),
        ..InitialState::default()
    };
    let mut simulation = start(&config, initial);
    simulation.run(memory_order::INTERVAL - 150).expect("a stable run");
    simulation
}

#[test]
fn a_sort_in_memory_changes_no_promise() {
    let mut straight = to_be_sorted(None);
    let saved = straight.to_checkpoint().unwrap();
    let before = straight.state().particles.ids.clone();
    straight.run(300).unwrap();
    assert_ne!(before, straight.state().particles.ids, "the run must hold a sort");
    assert!(touching(&straight).0 > 50, "and contacts: {:?}", touching(&straight));
    let mut resumed = Simulation::from_checkpoint(&saved, 1).unwrap();
    resumed.run(300).unwrap();
    assert_eq!(bits(&straight), bits(&resumed));
    let mut pieces = Simulation::from_checkpoint(&saved, 1).unwrap();
    while pieces.state().step < straight.state().step {
        pieces.run(7.min(straight.state().step - pieces.state().step)).unwrap();
    }
    assert_eq!(bits(&straight), bits(&pieces), "pieces of 7 steps");
    let mut other_skin = to_be_sorted(Some(0.05 * RADIUS));
    other_skin.run(300).unwrap();
    assert_eq!(bits(&straight), bits(&other_skin));
    assert!(last(&straight, "energy_residual") < 1e-13, "{:e}", last(&straight, "energy_residual"));
}

#[test]
fn what_leaves_is_in_id_order() {
    let simulation = to_be_sorted(None);
    let (p, frames) = (&simulation.state().particles, simulation.frames());
    assert!(!p.ids.is_sorted());
    assert!(p.by_id(&p.ids).is_sorted());
    // Two frames in id order are pictures of the same bundles: nobody went far in between.
    let (count, way) = (p.len(), 8.0 * simulation.config().run.frame_every);
    assert_eq!(frames.len(), 2);
    for i in 0..2 * count {
        assert!((frames.positions[i] - frames.positions[2 * count + i]).abs() < way as f32);
    }
}

/// Runs `config` for `steps` in pieces of these lengths, again and again.
fn in_pieces(config: &SimulationConfig, steps: u64, lengths: &[u64]) -> Simulation {
    let mut simulation = packed(config, 1);
    let mut lengths = lengths.iter().cycle();
    while simulation.state().step < steps {
        let left = steps - simulation.state().step;
        let length = left.min(*lengths.next().unwrap());
        simulation.run(length).unwrap();
    }
    simulation
}

/// Whoever looks, whenever: a run in pieces is the run at once, and what is read in between is what a run to there gives.
#[test]
fn pieces_of_a_run_do_not_show() {
    for baffle_count in [0, 3] {
        let mut config = baseline(300 - 20 * baffle_count, baffle_count);
        config.load.start_speed = 3.0;
        config.rotation.knots = vec![[0.0, SPEED], [0.003, -SPEED], [0.006, 0.0]];
        let steps = 3000;
        let at_once = after(&config, 1, steps);
        assert!(last(&at_once, "dissipated_normal") > 0.0 && last(&at_once, "rim_work") != 0.0);
        for lengths in [&[1][..], &[7], &[50], &[1, 10, 989]] {
            let pieces = in_pieces(&config, steps, lengths);
            assert_eq!(bits(&at_once), bits(&pieces), "{baffle_count} baffles, pieces of {lengths:?}");
            assert_eq!(at_once.to_checkpoint().unwrap(), pieces.to_checkpoint().unwrap());
        }
    }
}

/// Lengths × 4, times × 2, g unchanged, masses × 2^k with stiffness and damping to match.
fn scaled(config: &SimulationConfig, mass_factor: f64) -> SimulationConfig {
    let mut scaled = config.clone();
    scaled.drum.radius = scaled.drum.radius.map(|radius| 4.0 * radius);
    scaled.drum.baffles[0].height *= 4.0;
    scaled.drum.baffles[0].base *= 4.0;
    scaled.drum.baffles[0].tip *= 4.0;
    scaled.load.diameter *= 4.0;
    scaled.load.density *= mass_factor / 16.0;
    scaled.load.start_speed *= 2.0;
    for law in [&mut scaled.contact.bundle, &mut scaled.contact.drum] {
        // Force / length = mass / time².
        law.normal_stiffness *= mass_factor / 4.0;
        law.normal_damping = law.normal_damping.map(|damping| damping * mass_factor / 2.0);
    }
    for knot in &mut scaled.rotation.knots {
        *knot = [2.0 * knot[0], 0.5 * knot[1]];
    }
    scaled.run.time_step = scaled.run.time_step.map(|step| 2.0 * step);
    scaled.run.sample_every *= 2.0;
    scaled.run.frame_every *= 2.0;
    scaled
}

#[test]
fn scaling_by_powers_of_two_scales_every_bit() {
    for baffle_count in [0, 3] {
        let mut config = baseline(120, baffle_count);
        config.load.start_speed = 1.0;
        config.contact.drum.restitution = None;
        config.contact.drum.normal_damping = Some(7.74e3);
        config.rotation.knots = vec![[0.0, SPEED], [0.01, -SPEED], [0.02, 0.5 * SPEED]];
        let steps = 5 * STEPS;
        let plain = after(&config, 1, steps);
        for mass_factor in [1.0, 64.0] {
            let large = after(&scaled(&config, mass_factor), 1, steps);
            let (one, other) = (&plain.state().particles, &large.state().particles);
            for i in 0..one.len() {
                assert_eq!(one.positions[i] * 4.0, other.positions[i]);
                assert_eq!(one.velocities[i] * 2.0, other.velocities[i]);
                assert_eq!(one.angular_velocities[i] * 0.5, other.angular_velocities[i]);
            }
            let energy = mass_factor * 4.0;
            assert_eq!(last(&plain, "drum_work") * energy, last(&large, "drum_work"));
        }
    }
}

#[test]
fn a_mirrored_drum_gives_the_mirrored_trajectory() {
    for baffle_count in [0, 3] {
        let mut config = baseline(100, baffle_count);
        config.load.start_speed = 1.0;
        let source = packed(&config, 1);
        let p = &source.state().particles;
        let mirrored = |sign: f64, vectors: &[Vec2]| -> Vec<_> {
            vectors.iter().map(|v| Vec2::new(sign * v.x, v.y)).collect()
        };
        let initial = |sign: f64| InitialState {
            positions: mirrored(sign, &p.positions),
            velocities: Some(mirrored(sign, &p.velocities)),
            ..Default::default()
        };
        let mut plain = start(&config, initial(1.0));
        let mut mirrored_config = config.clone();
        mirrored_config.rotation.knots = vec![[0.0, -SPEED]];
        // The first baffle's axis at phase 0 mirrors to π.
        mirrored_config.drum.baffles[0].phase = std::f64::consts::PI;
        let mut mirrored = start(&mirrored_config, initial(-1.0));
        let steps = if baffle_count == 0 { STEPS } else { 4000 };
        plain.run(steps).unwrap();
        mirrored.run(steps).unwrap();
        let (one, other) = (&plain.state().particles, &mirrored.state().particles);
        // Baffle corners at mirrored angles differ by round-off, so only the bare drum mirrors bit for bit.
        let tolerance = if baffle_count == 0 { 0.0 } else { 1e-10 };
        for i in 0..one.len() {
            assert!((one.positions[i].x + other.positions[i].x).abs() <= tolerance);
            assert!((one.positions[i].y - other.positions[i].y).abs() <= tolerance);
            assert!((one.angular_velocities[i] + other.angular_velocities[i]).abs() <= tolerance * 1e6);
        }
    }
}

/// Permuting the bundles permutes the result, to round-off that grows with chaos; hence few steps.
#[test]
fn relabelling_permutes_the_result() {
    let config = baseline(100, 3);
    let source = after(&config, 1, 4000);
    let p = &source.state().particles;
    let order: Vec<usize> = (0..100).map(|k| (k * 37 + 11) % 100).collect();
    let initial = |order: &[usize]| InitialState {
        positions: order.iter().map(|&i| p.positions[i]).collect(),
        velocities: Some(order.iter().map(|&i| p.velocities[i]).collect()),
        ..Default::default()
    };
    let identity: Vec<usize> = (0..100).collect();
    let mut plain = start(&config, initial(&identity));
    let mut relabelled = start(&config, initial(&order));
    plain.run(2000).unwrap();
    relabelled.run(2000).unwrap();
    for (k, &i) in order.iter().enumerate() {
        let apart = relabelled.state().particles.positions[k] - plain.state().particles.positions[i];
        assert!(apart.norm() < 1e-9, "{}", apart.norm());
    }
}

#[test]
fn damaged_checkpoints_are_refused() {
    let mut simulation = packed(&baseline(20, 0), 1);
    simulation.run(100).unwrap();
    let good = simulation.to_checkpoint().unwrap();
    let refusal = |bytes: &[u8]| Simulation::from_checkpoint(bytes, 1).unwrap_err().to_string();
    assert!(refusal(b"").contains("not a drumrs checkpoint"));
    assert!(refusal(&good[..good.len() - 7]).contains("damaged or cut short"));
    let mut other_version = good.clone();
    other_version[8] += 1;
    assert!(refusal(&other_version).contains(&format!("format version {}", checkpoint::FORMAT_VERSION + 1)));
    for position in (0..good.len()).step_by(good.len() / 97) {
        let mut flipped = good.clone();
        flipped[position] ^= 0x10;
        assert!(refusal(&flipped).starts_with("cannot use this checkpoint"));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn any_bytes_as_a_checkpoint_are_a_clear_error(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        prop_assert!(Simulation::from_checkpoint(&bytes, 1).is_err());
    }
}
