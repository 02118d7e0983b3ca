//! Two bodies at their contact, four contacts at a time: relative motion in a frame of contact, and the contact's step.

use crate::contact::linear::LinearLanes;
use crate::contact::{Displacement, Encounter, HistoryLanes};
use crate::energy::StepFlows;
use crate::integrator::Motion;
use crate::lanes::{LANES, Lanes, Vec2Lanes, lanes, transpose};

/// Where bodies meet now.
#[derive(Debug, Clone, Copy)]
pub struct Meeting {
    /// Overlap [m]; not above zero when they have separated.
    pub overlap: Lanes,
    /// Unit normals.
    pub normal: Vec2Lanes,
}

/// Bodies whose relative motion can be resolved in a given frame of contact.
pub trait Bodies {
    /// The step's relative displacement, resolved along `normal` with the lever arms of `overlap`. `then` tells whether
    /// that frame is the one before the step.
    fn displacement(&self, overlap: Lanes, normal: Vec2Lanes, then: bool) -> Displacement;
    /// Rate of approach at the time of the force [m/s].
    fn closing_speed(&self, meeting: Meeting) -> Lanes;
    /// Radius against which an overlap is judged [m].
    fn radius(&self) -> Lanes;
}

/// Particles in pairs; they touch halfway into the overlap.
#[derive(Debug, Clone, Copy)]
pub struct Pairs {
    /// Relative displacement of the step [m].
    apart: Vec2Lanes,
    /// Rate of approach at the time of the force [m/s].
    closing_speed: Lanes,
    own_turn: Lanes,
    other_turn: Lanes,
    own_radius: Lanes,
    other_radius: Lanes,
}

impl Pairs {
    /// Nobody.
    pub fn none() -> Self {
        let (zero, none) = (Lanes::ZERO, Vec2Lanes { x: Lanes::ZERO, y: Lanes::ZERO });
        Self {
            apart: none,
            closing_speed: zero,
            own_turn: zero,
            other_turn: zero,
            own_radius: zero,
            other_radius: zero,
        }
    }

    /// Owners, others, the radii of both, and where they meet.
    #[inline(always)]
    pub fn meet(
        own: [&Motion; LANES],
        other: [&Motion; LANES],
        [own_radius, other_radius]: [Lanes; 2],
    ) -> (Self, Meeting) {
        // From the owners' centers to the others', and the displacement that changed it.
        let [gap_x, gap_y, apart_x, apart_y] =
            transpose(std::array::from_fn(|lane| other[lane].place - own[lane].place));
        let gap = Vec2Lanes { x: gap_x, y: gap_y };
        let distance = gap.dot(gap).sqrt();
        let overlap = own_radius + other_radius - distance;
        let normal = gap * (Lanes::ONE / distance);
        let [velocity_x, velocity_y, ..] =
            transpose(std::array::from_fn(|lane| other[lane].pace - own[lane].pace));
        let bodies = Self {
            apart: Vec2Lanes { x: apart_x, y: apart_y },
            closing_speed: -Vec2Lanes { x: velocity_x, y: velocity_y }.dot(normal),
            own_turn: lanes(|lane| own[lane].turn()),
            other_turn: lanes(|lane| other[lane].turn()),
            own_radius,
            other_radius,
        };
        (bodies, Meeting { overlap, normal })
    }

    /// From the owners' centers to the points of contact [m].
    #[inline(always)]
    pub fn own_arm(&self, overlap: Lanes) -> Lanes {
        self.own_radius - overlap * 0.5
    }

    /// From the others' centers to the points of contact [m].
    #[inline(always)]
    pub fn other_arm(&self, overlap: Lanes) -> Lanes {
        self.other_radius - overlap * 0.5
    }
}

impl Bodies for Pairs {
    #[inline(always)]
    fn displacement(&self, overlap: Lanes, normal: Vec2Lanes, _then: bool) -> Displacement {
        let spin = self.own_arm(overlap) * self.own_turn + self.other_arm(overlap) * self.other_turn;
        Displacement {
            approach: -self.apart.dot(normal),
            slip: self.apart.dot(normal.perpendicular()) - spin,
        }
    }

    #[inline(always)]
    fn closing_speed(&self, _meeting: Meeting) -> Lanes {
        self.closing_speed
    }

    #[inline(always)]
    fn radius(&self) -> Lanes {
        self.own_radius.fast_min(self.other_radius)
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
    /// The particles, their radii, and how the drum turns.
    #[inline(always)]
    pub fn new(own: [&Motion; LANES], radius: Lanes, drum_turn: f64, angular_velocity: f64) -> Self {
        let [x, y, displacement_x, displacement_y] = transpose(own.map(|motion| motion.place));
        let [velocity_x, velocity_y, turn, _] = transpose(own.map(|motion| motion.pace));
        Self {
            position: Vec2Lanes { x, y },
            displacement: Vec2Lanes { x: displacement_x, y: displacement_y },
            velocity: Vec2Lanes { x: velocity_x, y: velocity_y },
            turn,
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
        Displacement { approach: -apart.dot(normal), slip: apart.dot(normal.perpendicular()) - spin }
    }

    #[inline(always)]
    fn closing_speed(&self, meeting: Meeting) -> Lanes {
        let surface = self.point(meeting.overlap, meeting.normal).perpendicular();
        (self.velocity - surface * Lanes::splat(self.angular_velocity)).dot(meeting.normal)
    }

    #[inline(always)]
    fn radius(&self) -> Lanes {
        self.radius
    }
}

/// Sums of the flows, lane by lane.
#[derive(Debug, Clone, Copy)]
pub struct FlowLanes {
    work_normal: Lanes,
    work_tangential: Lanes,
    dissipated_normal: Lanes,
    dissipated_sliding: Lanes,
    overlap_ratio: Lanes,
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
            overlap_ratio: zero,
        }
    }

    /// The sums over the lanes, in their order.
    pub fn total(&self) -> StepFlows {
        let sum = |lanes: Lanes| lanes.to_array().into_iter().fold(0.0, |sum, value| sum + value);
        StepFlows {
            work_normal: 0.5 * sum(self.work_normal),
            work_tangential: 0.5 * sum(self.work_tangential),
            dissipated_normal: sum(self.dissipated_normal),
            dissipated_sliding: sum(self.dissipated_sliding),
            overlap_ratio: self.overlap_ratio.to_array().into_iter().fold(0.0, f64::max),
        }
    }
}

/// One step of four contacts: encounter, law, work, new history. `in_use` is all ones where a lane counts.
#[inline(always)]
pub fn settle(
    bodies: &impl Bodies,
    (meeting, history): (Meeting, &HistoryLanes),
    (law, damping, step_rate): (&LinearLanes, Lanes, f64),
    in_use: Lanes,
    flows: &mut FlowLanes,
) -> HistoryLanes {
    let Meeting { overlap, normal } = meeting;
    let displacement = bodies.displacement(overlap, normal, false);
    let closing_speed = bodies.closing_speed(meeting);
    let encounter = Encounter { overlap, displacement, closing_speed, damping, step_rate };
    let response = law.respond(&encounter, history);
    // Each force is charged half of the displacement resolved in its own frame; a contact without past had no force.
    let before = bodies.displacement(history.overlap, history.normal, true);
    let work_normal = response.normal_force * displacement.approach + history.normal_force * before.approach;
    let work_tangential =
        response.tangential_force * displacement.slip + history.tangential_force * before.slip;
    flows.work_normal += in_use & work_normal;
    flows.work_tangential += in_use & work_tangential;
    flows.dissipated_normal += in_use & response.dissipated_normal;
    flows.dissipated_sliding += in_use & response.dissipated_sliding;
    let touching = overlap.simd_gt(Lanes::ZERO);
    // The division waits for an overlap deeper than any before.
    let deepest = flows.overlap_ratio * bodies.radius();
    if (in_use & overlap.simd_gt(deepest)).any() {
        flows.overlap_ratio = flows.overlap_ratio.fast_max(in_use & (overlap / bodies.radius()));
    }
    HistoryLanes {
        overlap: touching & overlap,
        tangential_displacement: response.tangential_displacement,
        normal_force: response.normal_force,
        tangential_force: response.tangential_force,
        normal: Vec2Lanes { x: touching & normal.x, y: touching & normal.y },
    }
}
