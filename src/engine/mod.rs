//! How it is fast: nothing here changes a bit of what happens.
//!
//! | word         | is                                                                                                 |
//! |--------------|----------------------------------------------------------------------------------------------------|
//! | lane         | one of four numbers that are worked on at once (`simd`)                                            |
//! | block        | four contacts, column by column (`contacts`)                                                       |
//! | vacant lane  | one without a contact: it refers to bodies that never touch, and adds nothing to any sum           |
//! | group        | eight blocks, which go through the stages of a pass together (`forces`)                            |
//! | quad         | four particles, which drift together (`motion::verlet`)                                            |
//! | offset       | twice the number of a particle: where its vectors are in flat arrays (`motion`)                    |
//! | chunk        | 512 particles in a row in memory, and the contacts that they own (`parallel`)                      |
//! | pair list    | pairs that may touch before any particle has moved half the skin (`pair_list`)                     |
//! | skin         | the margin of the pair list, 0.8 mean radii of the particles unless `run.skin` is set               |
//! | slack        | how far any particle may still move before the pair list has to be checked                         |
//! | near list    | those pairs of the pair list that may touch within the next 32 steps                               |
//! | horizon      | for how long a near list holds: 32 steps, or until changes of displacements use up its budget      |
//! | key          | the bodies of a contact: (particle, later particle), or (particle, feature of the drum)            |
//! | reaction     | what a contact does to a particle of a later chunk (`forces`)                                      |
//! | fused pass   | forces, kick and drift chunk by chunk on one thread: each chunk once through the cache             |
//! | fold         | bringing the sums over contacts since the last sample to the ledger (`forces`)                     |
//! | memory order | the order of particles along Hilbert's curve, from 2048 on, anew every 8192 steps (`memory_order`) |
//!
//! `docs/internals/` has a page with a drawing on each of the mechanisms.

pub mod contacts;
pub mod forces;
pub mod memory_order;
pub mod motion;
pub mod pair_list;
pub mod parallel;
pub mod simd;

use contacts::ContactRecord;
use forces::{Bodies, ForcePass, Lists, StepInputs, new_pass};
use motion::verlet::{DriftSums, FINISH, Part, START, Verlet, WHOLE};
use motion::{Arrays, MotionArrays, with_arrays};
use pair_list::PairList;
use parallel::{Threads, chunk_count};

use crate::physics::contact::model::Model;
use crate::physics::contact::species::SpeciesTable;
use crate::physics::drum::Drum;
use crate::physics::drum::bins::ArcBins;
use crate::physics::particles::Particles;
use crate::physics::vector::{Rotation, Vec2};

/// What does the steps of one simulation. It holds the contacts; all else in it follows from the particles.
#[derive(Debug)]
pub struct Engine {
    pass: Box<dyn ForcePass>,
    list: PairList,
    verlet: Verlet,
    sums: Vec<DriftSums>,
    /// Where the particles move while steps are done.
    arrays: Arrays,
    count: usize,
    /// The radius where all particles have the same.
    radius: Option<f64>,
    threads: Threads,
}

/// What an engine is made for, and what a step needs of it.
#[derive(Debug, Clone, Copy)]
pub struct World<'a> {
    /// Rim and outlines.
    pub drum: &'a Drum,
    /// What acts between species, and between them and the drum.
    pub table: &'a SpeciesTable,
    /// Whether gross work is summed up.
    pub records_gross_work: bool,
    /// Whether what each contact does is recorded.
    pub records_contacts: bool,
    /// The bins of a profile along the drum's outline, where one is recorded.
    pub profile: Option<&'a ArcBins>,
    /// Length of a step [s].
    pub time_step: f64,
    /// Gravity [m/s²].
    pub gravity: Vec2,
}

/// How the drum moves in a step.
#[derive(Debug, Clone, Copy)]
pub struct DrumMotion {
    /// Its rotation at the end of the step.
    pub rotation: Rotation,
    /// Its mean angular velocity [rad/s].
    pub angular_velocity: f64,
    /// The number of the step.
    pub step: u64,
    /// The length of the step [s]: 0 where a load has just been started and has not moved yet.
    pub duration: f64,
}

impl Engine {
    /// For these particles, with a pair list of the margin `skin` [m].
    pub fn new(particles: &Particles, world: World, skin: f64, threads: Threads) -> Self {
        let count = particles.len();
        let radii = &particles.radii;
        let radius = radii.windows(2).all(|two| two[0] == two[1]).then(|| particles.largest_radius());
        let bodies = bodies(particles, radius, world.table);
        let free = world.drum.radius().map_or(1.0, |rim| rim - particles.largest_radius());
        Self {
            pass: new_pass(
                Model::of(world.table, world.records_gross_work || world.records_contacts),
                world.drum.surface_count(),
                &bodies,
                world.records_contacts,
            ),
            list: PairList::new(count, skin, particles.largest_radius()),
            verlet: Verlet::new(particles, world.time_step, world.gravity),
            sums: vec![DriftSums::default(); chunk_count(count)],
            // Lanes without a contact at the rim refer to a place halfway to it.
            arrays: Arrays::new(count, 0.5 * free),
            count,
            radius,
            threads,
        }
    }

    /// The contacts, and what the ledger is told of them.
    pub fn pass(&self) -> &dyn ForcePass {
        &*self.pass
    }

    /// The same, to change.
    pub fn pass_mut(&mut self) -> &mut dyn ForcePass {
        &mut *self.pass
    }

    /// The threads.
    pub fn threads(&self) -> &Threads {
        &self.threads
    }

    /// Makes near lists for so many steps from now on. No result depends on it.
    pub fn set_near_steps(&mut self, steps: u32) {
        self.list.set_near_steps(steps);
    }

    /// Adds contacts as they are.
    pub fn insert(&mut self, contacts: &Lists, particles: &Particles, world: World) {
        self.pass.insert(contacts, &bodies(particles, self.radius, world.table));
    }

    /// Begins a run of steps: takes over what moves, and drifts to the next step.
    pub fn begin(&mut self, particles: &mut Particles) {
        self.arrays.motion(self.count).copy_from(&MotionArrays::of(particles));
        self.start();
    }

    /// Brings the particles up to date.
    pub fn write_back(&mut self, particles: &mut Particles) {
        MotionArrays::of(particles).copy_from(&self.arrays.motion(self.count));
    }

    /// Brings their positions up to date.
    pub fn write_back_positions(&mut self, particles: &mut Particles) {
        MotionArrays::of(particles).vectors[0].copy_from_slice(self.arrays.motion(self.count).vectors[0]);
    }

    /// Ends a step: the velocities are then those at the time of the positions.
    pub fn finish(&mut self) {
        self.drift::<FINISH>();
    }

    /// Begins the next step.
    pub fn start(&mut self) {
        self.drift::<START>();
    }

    /// Ends a step and begins the next.
    pub fn advance(&mut self) {
        self.drift::<WHOLE>();
    }

    fn drift<const PART: Part>(&mut self) {
        let Self { arrays, verlet, sums, threads, count, .. } = self;
        threads.for_each(*count, arrays.motion(*count).chunks().zip(sums), |(own, sums)| {
            let sums_of_chunk = verlet.advance::<PART>(own);
            if PART != FINISH {
                *sums = sums_of_chunk;
            }
        });
    }

    /// Σ m x after the last drift [kg].
    pub fn mass_moment(&self) -> Vec2 {
        match &self.sums[..] {
            // Most loads have one chunk, and a loop takes a while to begin.
            [only] => Vec2::from(only.mass_moment),
            sums => sums.iter().fold(Vec2::zeros(), |sum, part| sum + Vec2::from(part.mass_moment)),
        }
    }

    /// Takes note of the last drift, in which the drum turned by `turn` [rad]. Returns a displacement that no particle has exceeded as
    /// seen from the drum [m].
    pub fn follow(&mut self, turn: f64) -> f64 {
        self.list.advance(&self.sums, turn)
    }

    /// Whether the next look at the pair list needs to know the drum's rotation.
    pub fn needs_rotation(&self, world: World) -> bool {
        world.drum.has_outlines() || world.profile.is_some() || self.list.is_due()
    }

    /// The longest displacement of a particle in the last drift, as seen from the drum [m].
    pub fn measure_displacements(&mut self, particles: &Particles, world: World, drum: DrumMotion) -> f64 {
        let inputs = self.inputs(particles, world, drum);
        with_arrays!(&mut self.arrays, arrays => {
            self.list.measure_displacements(arrays.lend::<false>().0, &inputs)
        })
    }

    /// Brings the pair list up to date with the positions.
    #[inline]
    pub fn update_list(&mut self, particles: &mut Particles, world: World, drum: DrumMotion) {
        if self.list.is_due() {
            self.check_list(particles, world, drum);
        }
    }

    /// Makes the pair list anew unless displacements show that it still holds.
    #[cold]
    fn check_list(&mut self, particles: &mut Particles, world: World, drum: DrumMotion) {
        self.write_back_positions(particles);
        if self.list.still_holds(&particles.positions, drum.rotation, &self.threads) {
            return;
        }
        let inputs = self.inputs(particles, world, drum);
        self.list.rebuild(&particles.positions, &inputs, &self.threads);
        self.pass.link(&mut self.list);
    }

    /// First forces of particles that have not moved yet, in a drum that begins to turn at an angular velocity [rad/s].
    pub fn open(
        &mut self,
        particles: &mut Particles,
        world: World,
        rotation: Rotation,
        angular_velocity: f64,
    ) {
        let drum = DrumMotion { rotation, angular_velocity, step: 0, duration: 0.0 };
        self.arrays.motion(self.count).copy_from(&MotionArrays::of(particles));
        self.update_list(particles, world, drum);
        self.evaluate(particles, world, drum);
        // What the near lists know of displacements does not hold once the particles move.
        self.list.end_near_lists();
        self.write_back(particles);
    }

    fn inputs<'a>(&self, particles: &'a Particles, world: World<'a>, drum: DrumMotion) -> StepInputs<'a> {
        StepInputs {
            time: [drum.duration, 1.0 / world.time_step],
            drum: world.drum,
            rotation: drum.rotation,
            angular_velocity: drum.angular_velocity,
            bodies: bodies(particles, self.radius, world.table),
            step: drum.step,
            records_gross_work: world.records_gross_work,
            profile: world.profile,
        }
    }

    /// Puts particle `order[k]` at place `k` in memory, between two runs of steps.
    pub fn reorder(&mut self, particles: &mut Particles, order: &[u32], world: World) {
        particles.reorder(order);
        let mut contacts = self.pass.drain();
        relabel(&mut contacts, &memory_order::places(order));
        self.insert(&contacts, particles, world);
        self.verlet = Verlet::new(particles, world.time_step, world.gravity);
        self.list.invalidate();
    }
}

/// Contacts of particles that are at other places in memory: particle `i` is now at `places[i]`.
pub fn relabel(contacts: &mut Lists, places: &[u32]) {
    let place = |particle: u32| places[particle as usize];
    for record in &mut contacts.pairs {
        *record = record.between(place(record.particle), place(record.other));
    }
    for record in &mut contacts.walls {
        *record = ContactRecord { particle: place(record.particle), ..*record };
    }
}

fn bodies<'a>(particles: &'a Particles, radius: Option<f64>, table: &'a SpeciesTable) -> Bodies<'a> {
    let Particles { radii, masses, species, .. } = particles;
    Bodies { radius, radii, masses, species, table }
}
