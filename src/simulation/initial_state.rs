//! How a simulation starts: a load that is packed at random, or a given state.

use std::collections::BTreeSet;

use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

use crate::engine::contacts::ContactRecord;
use crate::engine::forces::Lists;
use crate::error::{Error, require, require_finite};
use crate::io::config::{MOST_BUNDLES, SimulationConfig};
use crate::physics::drum::{Drum, RIM};
use crate::physics::energy::SurfaceLoad;
use crate::physics::load::composition::Discs;
use crate::physics::load::packing::unit;
use crate::physics::particles::Particles;
use crate::physics::vector::{Rotation, Vec2, cross};

/// A given initial state; what is left out is zero, radii that are left out are the configured ones.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct InitialState {
    /// Centers [m], in the frame at rest.
    pub positions: Vec<Vec2>,
    /// Velocities [m/s].
    pub velocities: Option<Vec<Vec2>>,
    /// Angles [rad].
    pub angles: Option<Vec<f64>>,
    /// Angular velocities [rad/s].
    pub angular_velocities: Option<Vec<f64>>,
    /// Radii [m].
    pub radii: Option<Vec<f64>>,
    /// Species.
    pub species: Option<Vec<u16>>,
    /// Angle of the drum [rad].
    pub drum_angle: f64,
    /// The contacts, by id, where the state is that of a simulation; those whose bodies do not meet as they say are left out.
    pub contacts: Lists,
}

impl InitialState {
    /// The particles of this state.
    pub fn particles(&self, config: &SimulationConfig, species_count: usize) -> Result<Particles, Error> {
        let count = self.positions.len();
        require(count > 0, "state.positions", "empty", "of at least one bundle")?;
        let (found, limit) = (format!("of {count} bundles"), format!("of at most {MOST_BUNDLES} bundles"));
        require(count <= MOST_BUNDLES, "state.positions", found, limit)?;
        let length = |count: usize| format!("of length {count}");
        let species = self.species.clone().unwrap_or_else(|| vec![0; count]);
        require(species.len() == count, "state.species", length(species.len()), length(count))?;
        if let Some(i) = species.iter().position(|&own| usize::from(own) >= species_count) {
            let limit = format!("below {species_count}, the number of species");
            return Err(Error::config(format!("state.species[{i}]"), species[i], limit));
        }
        let load = &config.load;
        let configured = || species.iter().map(|&own| load.radius_of(own)).collect::<Option<Vec<_>>>();
        let radii = self.radii.clone().or_else(configured);
        let limit = "given where the bundles of a species differ in size";
        let radii = radii.ok_or_else(|| Error::config("state.radii", "missing", limit))?;
        require(radii.len() == count, "state.radii", length(radii.len()), length(count))?;
        let locked = load.spin_locked;
        let density = |own| load.density_of(own);
        let mut particles = Particles::at_rest(self.positions.clone(), radii, species, density, locked);
        if let Some(velocities) = &self.velocities {
            particles.velocities.clone_from(velocities);
        }
        if let Some(angles) = &self.angles {
            particles.angles.clone_from(angles);
        }
        if let Some(spins) = &self.angular_velocities {
            let limit = "0 while load.spin_locked is true";
            let is_possible = !locked || spins.iter().all(|&spin| spin == 0.0);
            require(is_possible, "state.angular_velocities", "not 0", limit)?;
            particles.angular_velocities.clone_from(spins);
        }
        require_finite("state.drum_angle", self.drum_angle)?;
        let Lists { pairs, walls, .. } = &self.contacts;
        let are_finite = pairs.iter().chain(walls).all(ContactRecord::is_finite);
        require(are_finite, "state.contacts", "not finite", "finite")?;
        particles.validate()?;
        Ok(particles)
    }
}

/// The deepest overlap of two bodies at the start, over the smaller radius, that no contact of the state accounts for. The
/// springs of Table 1 throw bundles apart that overlap by as much with 12 m/s.
pub const START_OVERLAP_LIMIT: f64 = 0.1;

/// Refuses bundles as large as the drum, and such whose centers are outside of it, in a baffle or on a wall.
pub fn require_inside(drum: &Drum, particles: &Particles, rotation: Rotation) -> Result<(), Error> {
    let (radii, positions) = (&particles.radii, &particles.positions);
    let rim = drum.bounding_radius().unwrap_or(f64::INFINITY);
    if let Some(i) = radii.iter().position(|&radius| radius >= rim) {
        let limit = format!("smaller than the drum's radius {rim}");
        return Err(Error::config(format!("state.radii[{i}]"), radii[i], limit));
    }
    let in_frame = |i: usize| rotation.apply_inverse(positions[i]);
    match (0..positions.len()).find(|&i| drum.clearance(in_frame(i)) <= 0.0) {
        None => Ok(()),
        Some(i) => {
            let (x, y) = (positions[i].x, positions[i].y);
            let on_wall = || (0..drum.feature_count()).find(|&f| drum.distance_to(f, in_frame(i)) == 0.0);
            let surface = drum.solid_at(in_frame(i)).or_else(|| Some(drum.surface_of(on_wall()?)));
            let limit = "inside the drum and outside of its baffles";
            let limit = format!("{limit}: there is the {}", drum.surface_name(surface.unwrap_or(0)));
            Err(Error::config(format!("state.positions[{i}]"), format!("[{x}, {y}]"), limit))
        }
    }
}

/// Refuses bodies that overlap by more than `START_OVERLAP_LIMIT` at the start.
///
/// # Errors
/// `Error::StartOverlap` naming the two that overlap most.
pub fn require_apart(contacts: &Lists, particles: &Particles, drum: &Drum) -> Result<(), Error> {
    let name = |place: u32| particles.ids[place as usize];
    match contacts.deepest(&particles.radii) {
        Some((ratio, (particle, other), is_pair)) if ratio > START_OVERLAP_LIMIT => {
            let (one, other) = if is_pair {
                let (one, other) = (name(particle), name(other));
                (one.min(other), format!("[{}]", one.max(other)))
            } else {
                (name(particle), format!("the {}", drum.surface_name(drum.surface_of(other))))
            };
            let limit = START_OVERLAP_LIMIT;
            Err(Error::StartOverlap { one: format!("state.positions[{one}]"), other, ratio, limit })
        }
        _ => Ok(()),
    }
}

/// Of the contacts `found` those that are not among the `given`.
pub fn missing(found: Lists, given: &Lists) -> Lists {
    let fresh = |mut records: Vec<ContactRecord>, given: &[ContactRecord]| {
        let known = sorted_keys(given);
        records.retain(|record| known.binary_search(&record.key()).is_err());
        records
    };
    Lists {
        pairs: fresh(found.pairs, &given.pairs),
        walls: fresh(found.walls, &given.walls),
        ..Lists::default()
    }
}

/// The keys of contacts, in order.
pub fn sorted_keys(records: &[ContactRecord]) -> Vec<(u32, u32)> {
    let mut keys: Vec<_> = records.iter().map(ContactRecord::key).collect();
    keys.sort_unstable();
    keys
}

/// Leaves out contacts whose key an earlier one has.
fn without_repeats(mut records: Vec<ContactRecord>) -> Vec<ContactRecord> {
    if sorted_keys(&records).windows(2).any(|two| two[0] == two[1]) {
        let mut known = BTreeSet::new();
        records.retain(|record| known.insert(record.key()));
    }
    records
}

/// The configured load at packed positions, each bundle with the start speed in a random direction.
pub fn packed(config: &SimulationConfig, discs: Discs, positions: Vec<Vec2>, seed: u64) -> Particles {
    let load = &config.load;
    let density = |own| load.density_of(own);
    let mut particles = Particles::at_rest(positions, discs.radii, discs.species, density, load.spin_locked);
    if load.start_speed > 0.0 {
        // A stream of its own, so that the speed does not change where the bundles lie.
        let mut random = Pcg64Mcg::seed_from_u64(!seed);
        for velocity in &mut particles.velocities {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * unit(&mut random));
            *velocity = Vec2::new(cos, sin) * load.start_speed;
        }
    }
    particles
}

/// Of some contacts those whose bodies, at these places, overlap as the contacts say; of equal keys the first.
pub fn matching(contacts: &Lists, particles: &Particles, drum: &Drum, rotation: Rotation) -> Lists {
    let count = particles.len();
    let is_same =
        |overlap: f64, found: f64, radius: f64| (overlap - found).abs() <= 1e-9 * radius && overlap > 0.0;
    let pairs = contacts.pairs.iter().filter(|record| {
        let (i, j) = (record.particle as usize, record.other as usize);
        i < j && j < count && {
            let distance = (particles.positions[j] - particles.positions[i]).norm();
            is_same(record.overlap, particles.radii[i] + particles.radii[j] - distance, particles.radii[i])
        }
    });
    let walls = contacts.walls.iter().filter(|record| {
        let i = record.particle as usize;
        i < count && record.other < drum.feature_count() && {
            let center = rotation.apply_inverse(particles.positions[i]);
            let distance = match (record.other, drum.radius()) {
                (RIM, rim) => rim.map(|rim| rim - center.norm()),
                (feature, _) => drum.proximity(feature, center).map(|near| near.distance),
            };
            distance.is_some_and(|distance| {
                is_same(record.overlap, particles.radii[i] - distance, particles.radii[i])
            })
        }
    });
    Lists {
        pairs: without_repeats(pairs.copied().collect()),
        walls: without_repeats(walls.copied().collect()),
        ..Lists::default()
    }
}

/// Adds what contacts do to the forces and torques of their particles. Returns what the drum's surfaces do to the load.
pub fn add_forces(contacts: &Lists, particles: &mut Particles, drum: &Drum) -> Vec<SurfaceLoad> {
    for record in &contacts.pairs {
        let (i, j, force) = (record.particle as usize, record.other as usize, Vec2::from(record.force));
        particles.forces[i] -= force;
        particles.forces[j] += force;
        particles.torques[i] += record.moments[0];
        particles.torques[j] += record.moments[1];
    }
    let mut surfaces = vec![SurfaceLoad::default(); drum.surface_count()];
    for record in &contacts.walls {
        let (i, force) = (record.particle as usize, Vec2::from(record.force));
        particles.forces[i] -= force;
        particles.torques[i] += record.moments[0];
        let surface = &mut surfaces[drum.surface_of(record.other)];
        surface.force -= force;
        surface.moment += record.moments[0] - cross(particles.positions[i], force);
    }
    surfaces
}
