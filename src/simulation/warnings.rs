//! What a user should know of a configuration before it runs, though nothing is wrong with it.

use super::Simulation;
use crate::physics::contact::law::BodyPair;
use crate::physics::contact::linear::{collision_time, damping_ratio, undamped_collision_time};
use crate::physics::contact::parameters::{Base, ContactParameters, Tension};
use crate::physics::particles::Particles;

/// How many times shorter than without damping "auto" may make the time step unsaid.
const MUCH_SHORTER: f64 = 10.0;
/// Steps in the shortest collision where the time step is "auto".
const STEPS_IN_A_COLLISION: f64 = 50.0;

/// A contact that there may be.
struct Encounter<'a> {
    /// The two bodies.
    bodies: String,
    /// The table that is theirs, such as `contact.bundle`.
    key: String,
    parameters: &'a ContactParameters,
    effective_mass: f64,
}

impl Encounter<'_> {
    /// Damping over the critical one.
    fn ratio(&self) -> f64 {
        damping_ratio(self.parameters, self.effective_mass)
    }

    /// How long a collision lasts [s].
    fn time(&self) -> f64 {
        collision_time(self.parameters, self.effective_mass)
    }
}

impl Simulation {
    /// What a user should know before this simulation runs.
    pub fn warnings(&self) -> Vec<String> {
        if self.derived.table.base() == Base::Hertz {
            // Its damping follows from a restitution, and has no critical value that the overlap does not change.
            return Vec::new();
        }
        let (pairs, walls) = self.lightest_encounters();
        let stuck = [overdamped(&pairs), overdamped(&walls)];
        let all: Vec<_> = pairs.into_iter().chain(walls).collect();
        let is_auto = self.config.run.time_step.is_none();
        let short = is_auto.then(|| short_step(&all, self.time_step())).flatten();
        stuck.into_iter().chain([short]).flatten().collect()
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

/// That bodies stick together once they touch, as the dashpot may pull and does so for ever: of the most overdamped.
fn overdamped(encounters: &[Encounter]) -> Option<String> {
    let pulling = encounters.iter().filter(|encounter| encounter.parameters.tension == Tension::Allowed);
    let worst = pulling.max_by(|a, b| a.ratio().total_cmp(&b.ratio()))?;
    let (Encounter { bodies, key, parameters, .. }, ratio) = (worst, worst.ratio());
    let damping = parameters.normal_damping.unwrap_or_default();
    (ratio >= 1.0).then(|| {
        format!(
            "{bodies} will stick together where they touch: {key}.normal_damping = {damping} is {ratio:.3} times the critical damping of their masses, and {key}.tension = \"allowed\" lets it pull; give {key}.restitution instead of normal_damping, or set {key}.tension = \"clipped\""
        )
    })
}

/// That damping is so strong that it makes the time step [s] much shorter.
fn short_step(encounters: &[Encounter], time_step: f64) -> Option<String> {
    let time =
        |encounter: &Encounter| undamped_collision_time(encounter.parameters, encounter.effective_mass);
    let undamped = encounters.iter().map(time).fold(f64::INFINITY, f64::min) / STEPS_IN_A_COLLISION;
    let shortest = encounters.iter().min_by(|a, b| a.time().total_cmp(&b.time()))?;
    let (Encounter { key, parameters, .. }, ratio) = (shortest, shortest.ratio());
    let (cause, way_out) = match (parameters.restitution, parameters.normal_damping) {
        (Some(restitution), _) => {
            (format!("{key}.restitution = {restitution:e} with tension = \"clipped\""), "raise")
        }
        (None, damping) => (format!("{key}.normal_damping = {:e}", damping.unwrap_or_default()), "lower"),
    };
    let (times, greatest) = (undamped / time_step, 0.1 * STEPS_IN_A_COLLISION * time_step);
    (undamped > MUCH_SHORTER * time_step).then(|| {
        format!(
            "run.time_step = \"auto\" is {time_step:.3e} s, {times:.0} times shorter than {undamped:.3e} s without damping, since {cause} is {ratio:.3} times the critical damping; {way_out} it, or set run.time_step to at most {greatest:.3e} s"
        )
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
