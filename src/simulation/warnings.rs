//! What a user should know of a configuration before it runs, though nothing is wrong with it.

use std::fmt;

use super::Simulation;
use crate::physics::contact::law::BodyPair;
use crate::physics::contact::linear::{collision_time, damping_ratio, undamped_collision_time};
use crate::physics::contact::parameters::{Base, ContactParameters, Tension};
use crate::physics::particles::Particles;

/// How many times shorter than without damping "auto" may make the time step unsaid.
const MUCH_SHORTER: f64 = 10.0;
/// Steps in the shortest collision where the time step is "auto".
const STEPS_IN_A_COLLISION: f64 = 50.0;

/// What a user should know.
#[derive(Debug, Clone, PartialEq)]
pub enum Warning {
    /// Bodies that stick together once they touch: the dashpot may pull, and does so for ever.
    Overdamped {
        /// The two bodies.
        bodies: String,
        /// The table that damps them, such as `contact.bundle`.
        key: String,
        /// Its normal damping [N s/m].
        damping: f64,
        /// Damping over the critical one.
        ratio: f64,
    },
    /// Damping so strong that it makes the time step much shorter.
    ShortStep {
        /// The table that damps, such as `contact.bundle`.
        key: String,
        /// What it says.
        parameters: ContactParameters,
        /// Damping over the critical one.
        ratio: f64,
        /// The time step [s].
        time_step: f64,
        /// What it would be without damping [s].
        undamped: f64,
    },
}

impl fmt::Display for Warning {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Overdamped { bodies, key, damping, ratio } => write!(
                formatter,
                "{bodies} will stick together where they touch: {key}.normal_damping = {damping} is {ratio:.3} times the critical damping of their masses, and {key}.tension = \"allowed\" lets it pull; give {key}.restitution instead of normal_damping, or set {key}.tension = \"clipped\""
            ),
            Self::ShortStep { key, parameters, ratio, time_step, undamped } => {
                let (cause, way_out) = match (parameters.restitution, parameters.normal_damping) {
                    (Some(restitution), _) => {
                        (format!("{key}.restitution = {restitution:e} with tension = \"clipped\""), "raise")
                    }
                    (None, damping) => {
                        (format!("{key}.normal_damping = {:e}", damping.unwrap_or_default()), "lower")
                    }
                };
                write!(
                    formatter,
                    "run.time_step = \"auto\" is {time_step:.3e} s, {:.0} times shorter than {undamped:.3e} s without damping, since {cause} is {ratio:.3} times the critical damping; {way_out} it, or set run.time_step to at most {:.3e} s",
                    undamped / time_step,
                    0.1 * STEPS_IN_A_COLLISION * time_step
                )
            }
        }
    }
}

/// A contact that there may be: its bodies, and the table that is theirs.
struct Encounter<'a> {
    bodies: String,
    key: String,
    parameters: &'a ContactParameters,
    effective_mass: f64,
}

impl Encounter<'_> {
    fn ratio(&self) -> f64 {
        damping_ratio(self.parameters, self.effective_mass)
    }
}

impl Simulation {
    /// What a user should know before this simulation runs.
    pub fn warnings(&self) -> Vec<Warning> {
        let encounters = self.lightest_encounters();
        if self.derived.table.base() == Base::Hertz {
            // Its damping follows from a restitution, and has no critical value that the overlap does not change.
            return Vec::new();
        }
        let (pairs, walls) = &encounters;
        let overdamped = [pairs, walls].into_iter().filter_map(|encounters| overdamped(encounters));
        let all = || pairs.iter().chain(walls);
        let short = if self.config.run.time_step.is_none() { self.short_step(all()) } else { None };
        overdamped.chain(short).collect()
    }

    fn short_step<'a>(&self, encounters: impl Iterator<Item = &'a Encounter<'a>> + Clone) -> Option<Warning> {
        let undamped = encounters
            .clone()
            .map(|encounter| undamped_collision_time(encounter.parameters, encounter.effective_mass))
            .fold(f64::INFINITY, f64::min)
            / STEPS_IN_A_COLLISION;
        let time = |encounter: &Encounter| collision_time(encounter.parameters, encounter.effective_mass);
        let shortest = encounters.min_by(|a, b| time(a).total_cmp(&time(b)))?;
        let time_step = self.time_step();
        (undamped > MUCH_SHORTER * time_step).then(|| Warning::ShortStep {
            key: shortest.key.clone(),
            parameters: shortest.parameters.clone(),
            ratio: shortest.ratio(),
            time_step,
            undamped,
        })
    }

    /// Between any two species, and between each and the drum, the contact of the lightest bodies: none is damped more.
    fn lightest_encounters(&self) -> (Vec<Encounter<'_>>, Vec<Encounter<'_>>) {
        let (table, contact, particles) = (&self.derived.table, &self.config.contact, &self.state.particles);
        let lightest: Vec<[Option<usize>; 2]> =
            (0..table.count()).map(|species| two_lightest(particles, species as u16)).collect();
        let body = |place: usize| (particles.masses[place], particles.radii[place]);
        let species = || (0_u16..).zip(&lightest);
        let pair = |one: u16, other: u16| {
            let (first, second) = (lightest[usize::from(one)], lightest[usize::from(other)]);
            let (i, j) = (first[0]?, if one == other { second[1]? } else { second[0]? });
            let (low, high) = (self.id_of(i).min(self.id_of(j)), self.id_of(i).max(self.id_of(j)));
            Some(Encounter {
                bodies: format!("bundles {low} and {high}"),
                key: contact.pair_key(one, other),
                parameters: table.pair(one, other),
                effective_mass: BodyPair::of_discs(body(i), body(j)).effective_mass,
            })
        };
        let wall = |(own, lightest): (u16, &[Option<usize>; 2])| {
            let place = lightest[0]?;
            Some(Encounter {
                bodies: format!("bundle {} and the drum", self.id_of(place)),
                key: contact.wall_key(own),
                parameters: table.wall(own),
                effective_mass: BodyPair::at_wall(body(place)).effective_mass,
            })
        };
        let pairs =
            species().flat_map(|(one, _)| species().skip(one.into()).map(move |(other, _)| (one, other)));
        (pairs.filter_map(|(one, other)| pair(one, other)).collect(), species().filter_map(wall).collect())
    }
}

/// The most overdamped of contacts whose dashpot may pull.
fn overdamped(encounters: &[Encounter]) -> Option<Warning> {
    let pulling = encounters.iter().filter(|encounter| encounter.parameters.tension == Tension::Allowed);
    let worst = pulling.max_by(|a, b| a.ratio().total_cmp(&b.ratio()))?;
    let ratio = worst.ratio();
    (ratio >= 1.0).then(|| Warning::Overdamped {
        bodies: worst.bodies.clone(),
        key: worst.key.clone(),
        damping: worst.parameters.normal_damping.unwrap_or_default(),
        ratio,
    })
}

/// Places of the two lightest particles of a species, the lightest first.
fn two_lightest(particles: &Particles, species: u16) -> [Option<usize>; 2] {
    let order = |a: &usize, b: &usize| {
        let masses = particles.masses[*a].total_cmp(&particles.masses[*b]);
        masses.then(particles.ids[*a].cmp(&particles.ids[*b]))
    };
    let own = || (0..particles.len()).filter(|&place| particles.species[place] == species);
    let lightest = own().min_by(order);
    [lightest, own().filter(|&place| Some(place) != lightest).min_by(order)]
}
