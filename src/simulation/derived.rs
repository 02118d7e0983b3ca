//! What follows from a configuration: of a simulation, whose particles are known, and of the configuration alone.

use serde::Serialize;

use crate::engine::World;
use crate::error::Error;
use crate::io::config::SimulationConfig;
use crate::observe::fields::FieldGrid;
use crate::observe::recorder::Recording;
use crate::physics::contact::law::BodyPair;
use crate::physics::contact::linear;
use crate::physics::contact::parameters::{Base, ContactParameters};
use crate::physics::contact::species::{self, SpeciesTable};
use crate::physics::drum::Drum;
use crate::physics::drum::bins::ArcBins;
use crate::physics::drum::zone::Zone;
use crate::physics::load::composition::Discs;
use crate::physics::particles::Particles;
use crate::physics::vector::Vec2;

/// What follows from the configuration and the particles' sizes.
#[derive(Debug)]
pub(super) struct Derived {
    pub(super) drum: Drum,
    pub(super) table: SpeciesTable,
    pub(super) records_gross_work: bool,
    /// Whether what each contact does is recorded.
    pub(super) records_contacts: bool,
    /// The bins of a profile along the drum's outline, where one is recorded.
    pub(super) profile: Option<ArcBins>,
    /// The cells of fields, where they are recorded.
    pub(super) grid: Option<FieldGrid>,
    /// The zones whose visits are counted.
    pub(super) zones: Vec<Zone>,
    /// The step from which fields are summed up and visits counted.
    pub(super) first_summed: u64,
    pub(super) time_step: f64,
    pub(super) gravity: Vec2,
    pub(super) mass: f64,
    pub(super) least_radius: f64,
    pub(super) sample_steps: u64,
    pub(super) frame_steps: u64,
    /// The drum's speed where it is constant.
    pub(super) steady_speed: Option<f64>,
    /// Its angle at the knots of its schedule.
    pub(super) angles_at_knots: Vec<f64>,
}

impl Derived {
    pub(super) fn new(config: &SimulationConfig, particles: &Particles) -> Result<Self, Error> {
        let table = config.contact.table()?;
        let time_step = time_step(config, &table, particles)?;
        let drum = Drum::new(&config.drum)?;
        let every = |interval: f64| ((interval / time_step).round() as u64).max(1);
        Ok(Self {
            table,
            records_gross_work: config.run.record.contains(&Recording::GrossWork),
            records_contacts: config.run.record.iter().any(|recording| recording.needs_contacts()),
            profile: profile(config, &drum)?,
            grid: grid(config, &drum, particles)?,
            zones: config.run.zones.iter().map(Zone::new).collect(),
            first_summed: (config.run.sums_from / time_step).ceil() as u64,
            drum,
            time_step,
            gravity: Vec2::new(config.gravity[0], config.gravity[1]),
            mass: particles.total_mass(),
            least_radius: particles.radii.iter().copied().fold(f64::INFINITY, f64::min),
            sample_steps: every(config.run.sample_every),
            frame_steps: every(config.run.frame_every),
            steady_speed: config.rotation.is_constant().then(|| config.rotation.angular_velocity(0.0)),
            angles_at_knots: config.rotation.angles_at_knots(),
        })
    }

    /// What the engine needs of it.
    pub(super) fn world(&self) -> World<'_> {
        World {
            drum: &self.drum,
            table: &self.table,
            records_gross_work: self.records_gross_work,
            records_contacts: self.records_contacts,
            profile: self.profile.as_ref(),
            time_step: self.time_step,
            gravity: self.gravity,
        }
    }
}

/// Bins in the radius of a drum.
const BINS_PER_RADIUS: f64 = 20.0;

/// The bins of the profile along the drum's outline, if one is recorded.
///
/// # Errors
/// `Error::Config` where they would be too many, or their width is not known.
fn profile(config: &SimulationConfig, drum: &Drum) -> Result<Option<ArcBins>, Error> {
    if !config.run.record.contains(&Recording::WallProfile) {
        return Ok(None);
    }
    let width = config.run.arc_bin.or_else(|| drum.bounding_radius().map(|radius| radius / BINS_PER_RADIUS));
    let unknown = || {
        Error::config(
            "run.arc_bin",
            "not given",
            "given in a drum without rim and shell, which has no radius",
        )
    };
    ArcBins::new(drum, width.ok_or_else(unknown)?).map(Some)
}

/// The cells of fields, if they are recorded.
///
/// # Errors
/// `Error::Config` where they would be too many, or what they would cover has no end.
fn grid(config: &SimulationConfig, drum: &Drum, particles: &Particles) -> Result<Option<FieldGrid>, Error> {
    if !config.run.record.contains(&Recording::Fields) {
        return Ok(None);
    }
    let Some(radius) = drum.bounding_radius() else {
        let limit = "without \"fields\" in a drum without rim and shell, which has no radius";
        return Err(Error::config("run.record", "a list with \"fields\"", limit));
    };
    FieldGrid::new(config.run.cell.unwrap_or_else(|| particles.mean_radius()), radius).map(Some)
}

/// The configured time step, or the shortest collision time / 50.
///
/// # Errors
/// `Error::Config` for a step above a tenth of the shortest collision time, which could not resolve a contact.
fn time_step(config: &SimulationConfig, table: &SpeciesTable, particles: &Particles) -> Result<f64, Error> {
    let (bundle, drum) = collision_times(table, particles);
    let shortest = bundle.min(drum);
    match config.run.time_step {
        None if (shortest / 50.0).is_normal() => Ok(shortest / 50.0),
        None => Err(Error::config(
            "the shortest collision time",
            format!("{shortest:e} s"),
            "a positive finite number: change load.density, load.diameter or the stiffness",
        )),
        Some(time_step) if time_step <= shortest / 10.0 => Ok(time_step),
        Some(time_step) => {
            let greatest = shortest / 10.0;
            Err(Error::Config {
                key: "run.time_step".into(),
                value: time_step.into(),
                limit: format!("at most {}, a tenth of the shortest collision time", rounded_down(greatest)),
                bound: Some(greatest),
                hint: "or set run.time_step = \"auto\"",
            })
        }
    }
}

/// Four digits of a number, none of them rounded up, so that what is written is within the limit, too.
fn rounded_down(number: f64) -> String {
    let rounded = format!("{number:.3e}");
    match rounded.parse::<f64>() {
        Ok(above) if above > number => format!("{:.3e}", number - (above - number)),
        _ => rounded,
    }
}

/// Shortest collision times [s]: (between bundles, with the drum).
pub(super) fn collision_times(table: &SpeciesTable, particles: &Particles) -> (f64, f64) {
    table.collision_times(&particles.lightest(table.count()))
}

/// What places a case among others.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Facts {
    /// Mass of all bundles [kg/m].
    pub load_mass: f64,
    /// Time steps in the shortest collision.
    pub steps_per_collision: f64,
    /// √(g/(R − r)) [rad/s], from which on a bundle stays on the rim all the way round. R is the radius of the rim, or of
    /// the smallest circle round a shell; without either there is none. Of several sizes r is the greatest.
    pub critical_angular_velocity: Option<f64>,
    /// The greatest |Ω| over the critical one, where there is one above 0.
    pub critical_share: Option<f64>,
    /// Ω² R / g of the greatest |Ω|, likewise.
    pub froude_number: Option<f64>,
}

impl Facts {
    /// Of a load, and of a time step [s] that resolves its collisions.
    pub(super) fn new(
        config: &SimulationConfig,
        table: &SpeciesTable,
        particles: &Particles,
        time_step: f64,
    ) -> Self {
        let gravity = config.gravity[0].hypot(config.gravity[1]);
        let fastest = config.rotation.greatest_speed();
        let largest = particles.radii.iter().copied().fold(0.0, f64::max);
        let (bundle, drum) = collision_times(table, particles);
        let outer = config.drum.bounding_radius();
        let heavy = outer.filter(|_| gravity > 0.0);
        let critical = |radius: f64| (gravity / (radius - largest)).sqrt();
        Self {
            load_mass: particles.total_mass(),
            steps_per_collision: bundle.min(drum) / time_step,
            critical_angular_velocity: outer.map(critical),
            critical_share: heavy.map(|radius| fastest / critical(radius)),
            froude_number: heavy.map(|radius| fastest * fastest * radius / gravity),
        }
    }
}

/// What follows from a configuration before anything is packed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DerivedParameters {
    /// Mass of a bundle, on average [kg/m].
    pub bundle_mass: f64,
    /// What there is of each species.
    pub species: Vec<DerivedSpecies>,
    /// Time step [s].
    pub time_step: f64,
    /// Angular velocity Ω [rad/s] where it is constant.
    pub angular_velocity: Option<f64>,
    /// What places the case among others.
    #[serde(flatten)]
    pub facts: Facts,
    /// A contact of two bundles; of several species, that which is over first.
    pub bundle: DerivedContact,
    /// A contact of a bundle and the drum, likewise.
    pub drum: DerivedContact,
}

/// What there is of a species.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DerivedSpecies {
    /// Number of its bundles.
    pub count: usize,
    /// Mass of all of them [kg/m].
    pub mass: f64,
    /// Diameter of the smallest [m].
    pub smallest: f64,
    /// Diameter of the largest [m].
    pub largest: f64,
}

/// What follows for contacts that obey one table.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DerivedContact {
    /// m* [kg/m].
    pub effective_mass: f64,
    /// Normal damping νₙ [N s/m]; none for a base law whose damping changes with the overlap.
    pub normal_damping: Option<f64>,
    /// νₙ / (2 √(kₙ m*)), likewise.
    pub damping_ratio: Option<f64>,
    /// Coefficient of restitution e of a head-on impact.
    pub restitution: f64,
    /// Duration of a collision [s].
    pub collision_time: f64,
}

impl DerivedParameters {
    /// What follows from `config`.
    ///
    /// # Errors
    /// `Error::Config` for a bad configuration.
    pub fn new(config: &SimulationConfig, seed: u64) -> Result<Self, Error> {
        config.validate()?;
        let load = &config.load;
        // A load of equal bundles is as many times one of them.
        let (discs, times) = match load.species.len() {
            0 => (Discs::equal(1, 0.5 * load.diameter), load.count),
            _ => (load.discs(seed)?, 1),
        };
        let origin = vec![Vec2::zeros(); discs.radii.len()];
        let density = |own| load.density_of(own);
        let particles = Particles::at_rest(origin, discs.radii, discs.species, density, load.spin_locked);
        let load_mass = times as f64 * particles.total_mass();
        let angular_velocity = config.rotation.is_constant().then(|| config.rotation.angular_velocity(0.0));
        let table = config.contact.table()?;
        let time_step = time_step(config, &table, &particles)?;
        let facts = Facts::new(config, &table, &particles, time_step);
        let (bundle, drum) = quickest(&table, &particles);
        Ok(Self {
            bundle_mass: particles.total_mass() / particles.len() as f64,
            species: (0..load.species.len()).map(|own| DerivedSpecies::of(own, &particles)).collect(),
            time_step,
            angular_velocity,
            facts: Facts { load_mass, ..facts },
            bundle,
            drum,
        })
    }
}

impl DerivedSpecies {
    fn of(species: usize, particles: &Particles) -> Self {
        let own = || (0..particles.len()).filter(|&i| usize::from(particles.species[i]) == species);
        let diameters = || own().map(|i| 2.0 * particles.radii[i]);
        Self {
            count: own().count(),
            mass: own().map(|i| particles.masses[i]).sum(),
            smallest: diameters().fold(f64::INFINITY, f64::min),
            largest: diameters().fold(0.0, f64::max),
        }
    }
}

/// The contacts of two bundles, and of a bundle with the drum, that are over first.
fn quickest(table: &SpeciesTable, particles: &Particles) -> (DerivedContact, DerivedContact) {
    let lightest = particles.lightest(table.count());
    let bodies = || (0_u16..).zip(&lightest).filter_map(|(species, body)| Some((species, (*body)?)));
    let pairs = bodies().flat_map(|(one, body)| {
        bodies().map(move |(other, second)| {
            let equal = one == other;
            let bodies = if equal { BodyPair::of_equals(body) } else { BodyPair::of_discs(body, second) };
            DerivedContact::new(table.pair(one, other), bodies)
        })
    });
    let walls = bodies().map(|(own, body)| DerivedContact::new(table.wall(own), BodyPair::at_wall(body)));
    let first = |a: &DerivedContact, b: &DerivedContact| a.collision_time.total_cmp(&b.collision_time);
    let found = (pairs.min_by(first), walls.min_by(first));
    let (Some(pair), Some(wall)) = found else { unreachable!("a load of at least one bundle") };
    (pair, wall)
}

impl DerivedContact {
    fn new(parameters: &ContactParameters, bodies: BodyPair) -> Self {
        let mass = bodies.effective_mass;
        let is_linear = parameters.base == Base::Linear;
        Self {
            effective_mass: mass,
            normal_damping: is_linear.then(|| linear::damping(parameters, mass)),
            damping_ratio: is_linear.then(|| linear::damping_ratio(parameters, mass)),
            restitution: linear::restitution(parameters, mass),
            collision_time: species::collision_time(parameters, bodies),
        }
    }
}
