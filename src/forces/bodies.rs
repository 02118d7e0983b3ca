//! Two bodies at their contact: relative motion in a frame of contact, and the contact's step.

use crate::contact::{Displacement, Encounter, History, Response};
use crate::energy::StepFlows;
use crate::integrator::Motion;
use crate::vector::{Vec2, dot, perpendicular, smaller};

/// Where two bodies meet now.
#[derive(Debug, Clone, Copy)]
pub struct Meeting {
    pub overlap: f64,
    pub normal: Vec2,
}

/// Two bodies whose relative motion can be resolved in a given frame of contact.
pub trait Bodies {
    /// The step's relative displacement, resolved along `normal` with the lever arms of `overlap`. `then` tells whether
    /// that frame is the one before the step.
    fn displacement(&self, overlap: f64, normal: Vec2, then: bool) -> Displacement;
    /// Rate of approach at the time of the force.
    fn closing_speed(&self, overlap: f64, normal: Vec2) -> f64;
    /// Radius against which an overlap is judged.
    fn radius(&self) -> f64;
}

/// Two particles; they touch halfway into the overlap.
pub struct Pair<'a> {
    pub own: &'a Motion,
    pub other: &'a Motion,
}

impl Pair<'_> {
    #[inline]
    pub fn own_arm(&self, overlap: f64) -> f64 {
        self.own.radius - 0.5 * overlap
    }

    #[inline]
    pub fn other_arm(&self, overlap: f64) -> f64 {
        self.other.radius - 0.5 * overlap
    }
}

impl Bodies for Pair<'_> {
    #[inline]
    fn displacement(&self, overlap: f64, normal: Vec2, _then: bool) -> Displacement {
        let apart = self.other.displacement - self.own.displacement;
        let spin = self.own_arm(overlap) * self.own.turn + self.other_arm(overlap) * self.other.turn;
        Displacement { approach: -dot(apart, normal), slip: dot(apart, perpendicular(normal)) - spin }
    }

    #[inline]
    fn closing_speed(&self, _overlap: f64, normal: Vec2) -> f64 {
        dot(self.own.velocity - self.other.velocity, normal)
    }

    #[inline]
    fn radius(&self) -> f64 {
        smaller(self.own.radius, self.other.radius)
    }
}

/// A particle and the turning drum; they touch on the drum's surface.
pub struct Wall<'a> {
    pub own: &'a Motion,
    pub turn: f64,
    pub angular_velocity: f64,
}

impl Wall<'_> {
    #[inline]
    pub fn arm(&self, overlap: f64) -> f64 {
        self.own.radius - overlap
    }
}

impl Bodies for Wall<'_> {
    #[inline]
    fn displacement(&self, overlap: f64, normal: Vec2, then: bool) -> Displacement {
        let center = if then { self.own.position - self.own.displacement } else { self.own.position };
        let point = center + normal * self.arm(overlap);
        let apart = perpendicular(point) * self.turn - self.own.displacement;
        let spin = self.arm(overlap) * self.own.turn;
        Displacement { approach: -dot(apart, normal), slip: dot(apart, perpendicular(normal)) - spin }
    }

    #[inline]
    fn closing_speed(&self, overlap: f64, normal: Vec2) -> f64 {
        let point = self.own.position + normal * self.arm(overlap);
        dot(self.own.velocity - perpendicular(point) * self.angular_velocity, normal)
    }

    #[inline]
    fn radius(&self) -> f64 {
        self.own.radius
    }
}

/// One contact's step: encounter, law, work, new history.
#[inline]
pub fn settle(
    bodies: &impl Bodies,
    meeting: Meeting,
    (damping, step_rate): (f64, f64),
    history: &mut History,
    flows: &mut StepFlows,
    respond: impl Fn(&Encounter, &History) -> Response,
) {
    let Meeting { overlap, normal } = meeting;
    let displacement = bodies.displacement(overlap, normal, false);
    let closing_speed = bodies.closing_speed(overlap, normal);
    let encounter = Encounter { overlap, displacement, closing_speed, damping, step_rate };
    let response = respond(&encounter, history);
    let mut work_normal = response.normal_force * displacement.approach;
    let mut work_tangential = response.tangential_force * displacement.slip;
    if history.is_touching() {
        let before = bodies.displacement(history.overlap, history.normal, true);
        work_normal += history.normal_force * before.approach;
        work_tangential += history.tangential_force * before.slip;
    }
    flows.work_normal += 0.5 * work_normal;
    flows.work_tangential += 0.5 * work_tangential;
    flows.dissipated_normal += response.dissipated_normal;
    flows.dissipated_sliding += response.dissipated_sliding;
    if overlap > flows.overlap_ratio * bodies.radius() {
        flows.overlap_ratio = overlap / bodies.radius();
    }
    *history = if overlap > 0.0 {
        History {
            overlap,
            tangential_displacement: response.tangential_displacement,
            normal_force: response.normal_force,
            tangential_force: response.tangential_force,
            normal,
        }
    } else {
        History::default()
    };
}
