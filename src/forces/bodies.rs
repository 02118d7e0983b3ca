//! Two bodies at their contact, four contacts at a time: relative motion in a frame of contact, and the contact's step.

use crate::contact::linear::LinearLanes;
use crate::contact::{Displacement, Encounter, HistoryLanes};
use crate::integrator::Motion;
use crate::lanes::{LANES, Lanes, Vec2Lanes, lanes, transpose};
use crate::physics::energy::StepFlows;

/// Where bodies meet now.
#[derive(Debug, Clone, Copy)]
pub struct Meeting {
    /// Overlap [m]; not above zero when they have separated.
    pub overlap: Lanes,
    /// Unit normals.
    pub normal: Vec2Lanes,
}

impl Meeting {
    /// With no overlap but in the lanes that are `in_use`.
    #[inline(always)]
    pub fn within(self, in_use: Lanes) -> Self {
        Self { overlap: in_use & self.overlap, ..self }
    }
}

/// Bodies whose relative motion can be resolved in a given frame of contact.
pub trait Bodies {
    /// The step's relative displacement, resolved along `normal` with the lever arms of `overlap`. `then` tells whether
    /// that frame is the one before the step.
    fn displacement(&self, overlap: Lanes, normal: Vec2Lanes, then: bool) -> Displacement;
    /// Rate of parting at the time of the force [m/s].
    fn parting_speed(&self, meeting: Meeting) -> Lanes;
}

/// Particles in pairs and where they meet.
#[derive(Debug, Clone, Copy)]
pub struct Met {
    meeting: Meeting,
    /// Relative displacement of the step [m].
    apart: Vec2Lanes,
    /// Rate of parting at the time of the force [m/s].
    parting_speed: Lanes,
    own_turn: Lanes,
    other_turn: Lanes,
}

impl Met {
    /// Nobody.
    pub fn none() -> Self {
        let (zero, none) = (Lanes::ZERO, Vec2Lanes { x: Lanes::ZERO, y: Lanes::ZERO });
        let meeting = Meeting { overlap: zero, normal: none };
        Self { meeting, apart: none, parting_speed: zero, own_turn: zero, other_turn: zero }
    }

    /// Owners, others, the radii of both, and the time step [s].
    #[inline(always)]
    pub fn new(
        own: [&Motion; LANES],
        other: [&Motion; LANES],
        [own_radius, other_radius]: [Lanes; 2],
        time_step: f64,
    ) -> Self {
        // From the owners' centers to the others', and the displacement that changed it.
        let steps = Lanes::new([1.0, 1.0, time_step, time_step]);
        let [gap_x, gap_y, apart_x, apart_y] =
            transpose(std::array::from_fn(|lane| other[lane].place * steps - own[lane].place * steps));
        let gap = Vec2Lanes { x: gap_x, y: gap_y };
        let distance = gap.dot(gap).sqrt();
        let overlap = own_radius + other_radius - distance;
        let normal = gap * (Lanes::ONE / distance);
        let [velocity_x, velocity_y, ..] =
            transpose(std::array::from_fn(|lane| other[lane].pace - own[lane].pace));
        Self {
            meeting: Meeting { overlap, normal },
            apart: Vec2Lanes { x: apart_x, y: apart_y },
            parting_speed: Vec2Lanes { x: velocity_x, y: velocity_y }.dot(normal),
            own_turn: lanes(|lane| own[lane].spin()) * time_step,
            other_turn: lanes(|lane| other[lane].spin()) * time_step,
        }
    }
}

/// Particles in pairs; they touch halfway into the overlap.
#[derive(Debug, Clone, Copy)]
pub struct Pairs<'a> {
    /// How they met.
    pub met: &'a Met,
    /// Radii of the owners and of the others [m].
    pub radii: [Lanes; 2],
}

impl Pairs<'_> {
    /// Where they meet.
    #[inline(always)]
    pub fn meeting(&self) -> Meeting {
        self.met.meeting
    }

    /// From the owners' centers to the points of contact [m].
    #[inline(always)]
    pub fn own_arm(&self, overlap: Lanes) -> Lanes {
        self.radii[0] - overlap * 0.5
    }

    /// From the others' centers to the points of contact [m].
    #[inline(always)]
    pub fn other_arm(&self, overlap: Lanes) -> Lanes {
        self.radii[1] - overlap * 0.5
    }
}

impl Bodies for Pairs<'_> {
    #[inline(always)]
    fn displacement(&self, overlap: Lanes, normal: Vec2Lanes, _then: bool) -> Displacement {
        let Met { apart, own_turn, other_turn, .. } = *self.met;
        let spin = self.own_arm(overlap) * own_turn + self.other_arm(overlap) * other_turn;
        Displacement { parting: apart.dot(normal), slip: apart.dot(normal.perpendicular()) - spin }
    }

    #[inline(always)]
    fn parting_speed(&self, _meeting: Meeting) -> Lanes {
        self.met.parting_speed
    }
}

/// Particles at the turning drum; they touch on the drum's surface.
#[derive(Debug, Clone, Copy)]
pub struct Walls {
    position: Vec2Lanes,
    displacement: Vec2Lanes,
    velocity: Vec2Lanes,
    turn: Lanes,
    radius: Lanes,
    /// The angle that the drum turned during the step [rad].
    drum_turn: f64,
    /// Its angular velocity [rad/s].
    angular_velocity: f64,
}

impl Walls {
    /// The particles, their radii, the time step [s], and how the drum turns.
    #[inline(always)]
    pub fn new(
        own: [&Motion; LANES],
        radius: Lanes,
        time_step: f64,
        (drum_turn, angular_velocity): (f64, f64),
    ) -> Self {
        let [x, y, pace_x, pace_y] = transpose(own.map(|motion| motion.place));
        let [velocity_x, velocity_y, spin, _] = transpose(own.map(|motion| motion.pace));
        Self {
            position: Vec2Lanes { x, y },
            displacement: Vec2Lanes { x: pace_x, y: pace_y } * Lanes::splat(time_step),
            velocity: Vec2Lanes { x: velocity_x, y: velocity_y },
            turn: spin * time_step,
            radius,
            drum_turn,
            angular_velocity,
        }
    }

    /// Where they meet a rim of radius `rim` about the axis.
    #[inline(always)]
    pub fn meet_rim(&self, rim: f64) -> Meeting {
        let distance = self.position.dot(self.position).sqrt();
        let overlap = self.radius - (Lanes::splat(rim) - distance);
        Meeting { overlap, normal: self.position * (Lanes::ONE / distance) }
    }

    /// From the centers to the points of contact [m].
    #[inline(always)]
    pub fn arm(&self, overlap: Lanes) -> Lanes {
        self.radius - overlap
    }

    /// The points of contact.
    #[inline(always)]
    pub fn point(&self, overlap: Lanes, normal: Vec2Lanes) -> Vec2Lanes {
        self.position + normal * self.arm(overlap)
    }
}

impl Bodies for Walls {
    #[inline(always)]
    fn displacement(&self, overlap: Lanes, normal: Vec2Lanes, then: bool) -> Displacement {
        let center = if then { self.position - self.displacement } else { self.position };
        let point = center + normal * self.arm(overlap);
        let apart = point.perpendicular() * Lanes::splat(self.drum_turn) - self.displacement;
        let spin = self.arm(overlap) * self.turn;
        Displacement { parting: apart.dot(normal), slip: apart.dot(normal.perpendicular()) - spin }
    }

    #[inline(always)]
    fn parting_speed(&self, meeting: Meeting) -> Lanes {
        let surface = self.point(meeting.overlap, meeting.normal).perpendicular();
        (surface * Lanes::splat(self.angular_velocity) - self.velocity).dot(meeting.normal)
    }
}

/// Sums over contacts, lane by lane.
#[derive(Debug, Clone, Copy)]
pub struct FlowLanes {
    work_normal: Lanes,
    work_tangential: Lanes,
    dissipated_normal: Lanes,
    dissipated_sliding: Lanes,
    /// Greatest depth, as `settle` is told it.
    depth: Lanes,
    /// All ones where all still touch.
    touching: Lanes,
}

impl FlowLanes {
    /// Nothing so far.
    #[inline(always)]
    pub fn zero() -> Self {
        let zero = Lanes::ZERO;
        Self {
            work_normal: zero,
            work_tangential: zero,
            dissipated_normal: zero,
            dissipated_sliding: zero,
            depth: zero,
            touching: all_ones(),
        }
    }

    /// Whether all contacts still touch.
    pub fn all_touch(&self) -> bool {
        self.touching.all()
    }

    /// The sums over the lanes, in their order. Depths are in units of `unit`.
    pub fn total(&self, unit: f64) -> StepFlows {
        let sum = |lanes: Lanes| lanes.to_array().into_iter().fold(0.0, |sum, value| sum + value);
        StepFlows {
            work_normal: 0.5 * sum(self.work_normal),
            work_tangential: 0.5 * sum(self.work_tangential),
            dissipated_normal: sum(self.dissipated_normal),
            dissipated_sliding: sum(self.dissipated_sliding),
            overlap_ratio: self.depth.to_array().into_iter().fold(0.0, f64::max) / unit,
        }
    }
}

/// All ones in every lane.
#[inline(always)]
fn all_ones() -> Lanes {
    Lanes::splat(f64::from_bits(u64::MAX))
}

/// One step of four contacts: encounter, law, work, new history. Vacant lanes have no overlap and no past, hence neither
/// force nor work; `in_use` is all ones in the others. `depth` is what overlaps are judged by.
#[inline(always)]
pub fn settle(
    bodies: &impl Bodies,
    (meeting, history): (Meeting, &HistoryLanes),
    (law, damping, step_rate): (&LinearLanes, Lanes, f64),
    (in_use, depth): (Lanes, impl Fn(Lanes) -> Lanes),
    flows: &mut FlowLanes,
) -> HistoryLanes {
    let Meeting { overlap, normal } = meeting;
    let displacement = bodies.displacement(overlap, normal, false);
    let parting_speed = bodies.parting_speed(meeting);
    let encounter = Encounter { overlap, displacement, parting_speed, damping, step_rate };
    let response = law.respond(&encounter, history);
    // Each force is charged half of the displacement resolved in its own frame; a contact without past had no force.
    let before = bodies.displacement(history.overlap, history.normal, true);
    let work_normal = response.normal_force * displacement.parting + history.normal_force * before.parting;
    let work_tangential =
        response.tangential_force * displacement.slip + history.tangential_force * before.slip;
    flows.work_normal -= work_normal;
    flows.work_tangential += work_tangential;
    flows.dissipated_normal += response.dissipated_normal;
    flows.dissipated_sliding += response.dissipated_sliding;
    flows.depth = depth(overlap).fast_max(flows.depth);
    let touching = overlap.simd_gt(Lanes::ZERO);
    flows.touching &= touching | !in_use;
    HistoryLanes {
        overlap: touching & overlap,
        tangential_displacement: response.tangential_displacement,
        normal_force: response.normal_force,
        tangential_force: response.tangential_force,
        normal,
    }
}
