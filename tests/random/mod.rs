//! Valid configurations at random: drums of any size, baffles of any shape, springs over six decades, any program.

use std::f64::consts::PI;

use drumrs::io::config::{ContactTables, LoadParameters, RunParameters, SimulationConfig};
use drumrs::observe::recorder::Recording;
use drumrs::physics::contact::parameters::{Base, ContactParameters, Tension};
use drumrs::physics::contact::species::SpeciesTable;
use drumrs::physics::drum::DrumParameters;
use drumrs::physics::drum::baffle::{BaffleParameters, BaffleShape};
use drumrs::physics::load::shares::Measure;
use drumrs::physics::rotation::RotationSchedule;
use proptest::collection::vec;
use proptest::prelude::*;

/// A configuration and what to hold its outcome against.
#[derive(Debug, Clone)]
pub struct Drawn {
    pub config: SimulationConfig,
    pub seed: u64,
    /// Time steps in the shortest collision.
    pub steps_a_collision: f64,
    /// The greatest speed that the drum, a fall and the start make [m/s].
    pub speed: f64,
}

/// Lengths and speeds as shares of the drum's radius and of √(g R), before they are put together.
#[derive(Debug, Clone)]
struct Draw {
    radius: f64,
    size: f64,
    fill: f64,
    density: f64,
    gravity: [f64; 2],
    start: f64,
    spin_locked: bool,
    speeds: Vec<f64>,
    hardness: [f64; 2],
    laws: [Law; 2],
    steps_a_collision: f64,
    skin: Option<f64>,
    records: bool,
    seed: u64,
}

#[derive(Debug, Clone)]
struct Law {
    stiffness_ratio: f64,
    /// Restitution, or the damping ratio.
    loss: Result<f64, f64>,
    friction: f64,
    clipped: bool,
}

prop_compose! {
    fn law()(
        stiffness_ratio in 0.2..1.5_f64,
        loss in prop_oneof![(0.01..=1.0_f64).prop_map(Ok), (0.0..1.5_f64).prop_map(Err)],
        friction in prop_oneof![Just(0.0), 0.0..2.0_f64],
        clipped in any::<bool>(),
    ) -> Law {
        Law { stiffness_ratio, loss, friction, clipped }
    }
}

/// All that is recorded of contacts, and fields.
pub const CONTACT_RECORDS: [Recording; 5] = [
    Recording::Contacts,
    Recording::WallProfile,
    Recording::LedgerSplit,
    Recording::Discs,
    Recording::Fields,
];

/// A number of any of these powers of ten.
fn decades(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low..high).prop_map(|power| libm::pow(10.0, power))
}

prop_compose! {
    fn draw()(
        (radius, size, fill, density) in (decades(-2.0, 1.0), 4.0..24.0_f64, 0.02..0.75_f64, decades(0.0, 4.0)),
        gravity in prop_oneof![3 => Just([0.0, -9.81]), 1 => Just([0.0, 0.0]), 1 => [-9.0..9.0_f64, -9.0..9.0_f64]],
        start in prop_oneof![Just(0.0), 0.0..2.0_f64],
        spin_locked in any::<bool>(),
        speeds in vec(-3.0..3.0_f64, 1..6),
        hardness in [decades(2.5, 8.5), decades(2.5, 8.5)],
        laws in [law(), law()],
        steps_a_collision in prop_oneof![Just(50.0), 10.5..80.0_f64],
        skin in prop_oneof![Just(None), Just(Some(0.0)), (0.0..1.0_f64).prop_map(Some)],
        records in any::<bool>(),
        seed in 0..1000_u64,
    ) -> Draw {
        Draw {
            radius, size, fill, density, gravity, start, spin_locked, speeds, hardness, laws, steps_a_collision, skin,
            records, seed,
        }
    }
}

prop_compose! {
    /// Baffles of a drum of radius 1: many shapes, not all of which fit.
    fn baffles()(
        count in prop_oneof![Just(0_usize), 1..9_usize],
        shape in prop_oneof![Just(BaffleShape::Triangle), Just(BaffleShape::Trapezoid), Just(BaffleShape::Polygon)],
        (height, base, tip) in (0.02..0.7_f64, 0.02..0.6_f64, 0.01..0.4_f64),
        points in vec([-0.1..0.7_f64, -0.3..0.3_f64], 3..7),
        phase in -7.0..7.0_f64,
    ) -> BaffleParameters {
        BaffleParameters {
            name: "baffle".into(), count, shape, height, base, tip, points: Some(points), corner_radius: 0.0,
            chord_error: 1e-3, phase,
        }
    }
}

/// A valid configuration as far as its numbers go; baffles may not fit, and bundles neither.
pub fn drawn() -> impl Strategy<Value = Drawn> {
    let walls = vec(vec([-0.6..0.6_f64, -0.6..0.6_f64], 2..5), 0..2);
    (draw(), baffles(), walls).prop_map(|(draw, baffles, walls)| put_together(&draw, baffles, walls))
}

fn put_together(draw: &Draw, mut baffles: BaffleParameters, mut walls: Vec<Vec<[f64; 2]>>) -> Drawn {
    let (radius, diameter) = (draw.radius, 2.0 * draw.radius / draw.size);
    for length in [&mut baffles.height, &mut baffles.base, &mut baffles.tip] {
        *length *= radius;
    }
    let points = walls.iter_mut().flatten().chain(baffles.points.iter_mut().flatten());
    points.flatten().for_each(|coordinate| *coordinate *= radius);
    let natural = (9.81 * radius).sqrt();
    let fastest = draw.speeds.iter().fold(0.0_f64, |most, speed| most.max(speed.abs()));
    let speed = natural * (fastest + draw.start + 2.0);
    let mass = draw.density * PI * diameter * diameter / 4.0;
    let parameters =
        |which: usize| parameters(&draw.laws[which], draw.hardness[which], mass, speed, diameter);
    let contact = ContactTables {
        bundle: parameters(0),
        drum: parameters(1),
        species: 1,
        pairs: Vec::new(),
        walls: Vec::new(),
    };
    let (pairs, rim) =
        SpeciesTable::new(1, &contact.bundle, &contact.drum).collision_times(&[Some((mass, 0.5 * diameter))]);
    let time_step = pairs.min(rim) / draw.steps_a_collision;
    // Knots all over the run's 2 000 steps, the last beyond them.
    let knot = |(index, speed): (usize, &f64)| [500.0 * index as f64 * time_step, speed * natural / radius];
    let run = RunParameters {
        time_step: Some(time_step),
        sample_every: 100.0 * time_step,
        frame_every: 1000.0 * time_step,
        skin: draw.skin.map(|skin| skin * diameter),
        record: if draw.records { CONTACT_RECORDS.to_vec() } else { Vec::new() },
        contact_floor: 0.0,
        arc_bin: None,
        cell: None,
        zones: Vec::new(),
        sums_from: 0.0,
        overlap_limit: 0.5,
    };
    let load = LoadParameters {
        count: ((draw.fill * draw.size * draw.size) as usize).max(1),
        diameter,
        density: draw.density,
        species: Vec::new(),
        share_by: Measure::Mass,
        start_speed: draw.start * natural,
        spin_locked: draw.spin_locked,
    };
    let config = SimulationConfig {
        drum: DrumParameters { radius: Some(radius), shell: None, baffles: vec![baffles], walls },
        rotation: RotationSchedule { knots: draw.speeds.iter().enumerate().map(knot).collect() },
        load,
        contact,
        gravity: draw.gravity,
        run,
    };
    Drawn { config, seed: draw.seed, steps_a_collision: draw.steps_a_collision, speed }
}

/// Springs of a hardness k d² / (m v²): at 1000 a bundle that hits another at the greatest speed is pressed by a thirtieth of its size.
fn parameters(law: &Law, hardness: f64, mass: f64, speed: f64, diameter: f64) -> ContactParameters {
    let normal_stiffness = hardness * mass * (speed / diameter) * (speed / diameter);
    let critical = 2.0 * (normal_stiffness * mass).sqrt();
    ContactParameters {
        base: Base::Linear,
        normal_stiffness,
        young_modulus: None,
        poisson_ratio: 0.3,
        stiffness_ratio: law.stiffness_ratio,
        restitution: law.loss.ok(),
        normal_damping: law.loss.err().map(|ratio| ratio * critical),
        friction: law.friction,
        tension: if law.clipped { Tension::Clipped } else { Tension::Allowed },
        adhesion: 0.0,
        tangential_damping_ratio: 0.0,
        rolling_friction: 0.0,
    }
}
