//! What must hold for any bytes: shared by the fuzz targets (`fuzz/`) and, over kept bytes, by the ordinary tests.

use drumrs::error::Error;
use drumrs::io::config::SimulationConfig;
use drumrs::physics::drum::{Drum, DrumParameters};
use drumrs::physics::rotation::RotationSchedule;
use drumrs::physics::vector::Vec2;
use drumrs::simulation::Simulation;

/// More bundles are a large simulation, not a strange one.
const MOST_BUNDLES: usize = 300;
const STEPS: u64 = 20;

/// Bytes as a configuration: a typed error, or a simulation that runs.
pub fn config(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let Ok(config) = SimulationConfig::from_json(text) else { return };
    assert_eq!(SimulationConfig::from_json(&config.to_json()).as_ref(), Ok(&config));
    if config.load.count > MOST_BUNDLES {
        return;
    }
    if let Ok(mut simulation) = Simulation::new(config, 1, 1) {
        steps(&mut simulation);
    }
}

/// Bytes as a checkpoint, as they are and with a digest that fits: a typed error, or a simulation that goes on.
pub fn checkpoint(bytes: &[u8]) {
    for bytes in [bytes.to_vec(), resealed(bytes)] {
        if let Ok(mut simulation) = Simulation::from_checkpoint(&bytes, 1) {
            steps(&mut simulation);
        }
    }
}

/// Magic, version and a digest of the rest put before whatever follows the first 44 bytes.
pub fn resealed(bytes: &[u8]) -> Vec<u8> {
    use sha2::{Digest, Sha256};
    let body = bytes.get(44..).unwrap_or_default();
    let mut sealed = b"DRUMRS\r\n".to_vec();
    sealed.extend_from_slice(&drumrs::io::checkpoint::FORMAT_VERSION.to_le_bytes());
    sealed.extend_from_slice(&Sha256::digest(body));
    sealed.extend_from_slice(body);
    sealed
}

fn steps(simulation: &mut Simulation) {
    match simulation.run(STEPS) {
        Ok(()) => {
            let _ = (simulation.contact_log(), simulation.open_rows(), simulation.dissipated());
            let state = simulation.state();
            assert!(state.particles.first_non_finite().is_none(), "a run that ends well ends with numbers");
            let bytes = simulation.to_checkpoint().expect("a good simulation has a checkpoint");
            assert!(Simulation::from_checkpoint(&bytes, 1).is_ok(), "its own checkpoint is accepted");
        }
        Err(
            Error::NonFinite { .. } | Error::Overlap { .. } | Error::Escaped { .. } | Error::TooFast { .. },
        ) => {}
        Err(other) => panic!("no error of a run: {other}"),
    }
}

/// Bytes as a drum's outlines: a typed error, or distances that agree with each other wherever one asks.
pub fn outline(bytes: &[u8]) {
    let Ok(parameters) = serde_json::from_slice::<DrumParameters>(bytes) else { return };
    let Ok(drum) = Drum::new(&parameters) else { return };
    let size = parameters.radius.unwrap_or(1.0);
    let mut near = Vec::new();
    for place in 0..64_u32 {
        let (x, y) = (f64::from(place % 8) / 3.5 - 1.0, f64::from(place / 8) / 3.5 - 1.0);
        let center = Vec2::new(x * size, y * size);
        let clearance = drum.clearance(center);
        assert!(!clearance.is_nan(), "the clearance at {center} is a number");
        near.clear();
        drum.features_near(center, size, &mut near);
        assert!(near.is_sorted(), "features come in order");
        for &feature in &near {
            assert!(feature < drum.feature_count());
            if let Some(seen) = drum.proximity(feature, center) {
                assert!(seen.distance >= 0.0 && seen.direction.iter().all(|part| part.is_finite()));
            }
        }
    }
}

/// Bytes as a program of speeds: a typed error, or angles that add up.
pub fn rotation(bytes: &[u8]) {
    let knots = bytes.chunks_exact(16).map(|knot| [number(&knot[..8]), number(&knot[8..])]);
    let schedule = RotationSchedule { knots: knots.take(64).collect() };
    if schedule.validate().is_err() {
        return;
    }
    let last = schedule.knots.last().map_or(0.0, |knot| knot[0]);
    for part in 0..16_u32 {
        let (from, to) = (last * f64::from(part) / 12.0, last * f64::from(part + 1) / 12.0);
        let (whole, parts) = (schedule.angle(to), schedule.angle(from) + schedule.angle_increment(from, to));
        // Numbers below the smallest normal one have few digits left.
        let fastest = schedule.knots.iter().fold(1e-290_f64, |most, knot| most.max(knot[1].abs()));
        let most = fastest * to.max(1.0);
        if most.is_finite() {
            assert!(schedule.angular_velocity(to).is_finite());
            assert!(
                (whole - parts).abs() <= 1e-9 * most,
                "{whole} is not {parts}: {schedule:?} at {from}, {to}"
            );
        }
    }
}

fn number(bytes: &[u8]) -> f64 {
    f64::from_le_bytes(bytes.try_into().expect("eight bytes"))
}
