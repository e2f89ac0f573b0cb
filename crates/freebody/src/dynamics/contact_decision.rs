//! What was decided about contacts that are closed, and what of it was a close thing.

use crate::contact::complementarity::{inside, Answer, FrictionLaw, Problem, Status};
use crate::mode::ContactMode;
use crate::solve::Matrix;

/// Part of the largest acceleration below which one, or a force that would cause it, is too small to decide by.
pub(super) const CLOSE: f64 = 1e-8;

/// How unilateral constraints go on.
pub struct ContactDecision {
    /// Of each unilateral constraint reached.
    pub modes: Vec<ContactMode>,
    /// Of each whether something that decides was too small to be sure of.
    pub doubtful: Vec<bool>,
    /// The forces and accelerations that decide it.
    answer: Answer,
    /// The accelerations without contact forces and the laws of friction, with which they were found.
    free: Vec<f64>,
    friction: Vec<FrictionLaw>,
}

impl ContactDecision {
    /// Whether it was a close thing.
    pub fn is_doubtful(&self) -> bool {
        self.doubtful.contains(&true)
    }

    /// Part of its normal force that is the friction of each, of contacts that act on each other by `g`; well inside its cone
    /// where they share it.
    pub(super) fn friction_ratios(&self, g: &Matrix) -> impl Iterator<Item = f64> {
        let problem = Problem { g, free: &self.free, friction: &self.friction };
        let Answer { normal, tangent, .. } = inside(&problem, self.answer.clone());
        normal.into_iter().zip(tangent).map(|(n, t)| if n > 0.0 { t / n } else { 0.0 })
    }

    /// Whether `next` decides something that is in doubt here. What is in doubt for ever, as a touch that others make
    /// redundant, is no reason to follow it.
    pub fn is_settled_by(&self, next: &ContactDecision) -> bool {
        self.doubtful.iter().zip(&next.doubtful).any(|(&here, &there)| here && !there)
    }
}

/// The modes of an answer, and whether it was a close thing.
pub(super) fn decision(answer: Answer, problem: &Problem, acceleration: f64) -> ContactDecision {
    let k = answer.status.len();
    let fastest = problem.free.iter().chain(&answer.acceleration).fold(acceleration, |most, x| most.max(x.abs()));
    let weak = |i: usize| answer.normal[i] * problem.g[(i, i)] <= CLOSE * fastest;
    let slow = |x: f64| x.abs() <= CLOSE * fastest;
    let mode = |i: usize| match answer.status[i] {
        Status::Open if slow(answer.acceleration[i]) => ContactMode::ClosedUnloaded,
        Status::Open => ContactMode::Open,
        Status::Closed => ContactMode::Frictionless,
        Status::Stick => ContactMode::Stick,
        Status::Slip(sense) => ContactMode::Slip(sense),
    };
    let close = |i: usize| match (answer.status[i], problem.friction[i]) {
        (Status::Open, _) => slow(answer.acceleration[i]),
        (Status::Stick, FrictionLaw::Resting { fixed, .. }) => {
            let most = fixed * answer.normal[i];
            weak(i) || most - answer.tangent[i].abs() <= CLOSE * most
        }
        (Status::Slip(_), FrictionLaw::Resting { .. }) => weak(i) || slow(answer.acceleration[k + i]),
        _ => weak(i),
    };
    let (modes, doubtful) = ((0..k).map(mode).collect(), (0..k).map(close).collect());
    let (free, friction) = (problem.free.to_vec(), problem.friction.to_vec());
    ContactDecision { modes, doubtful, answer, free, friction }
}
