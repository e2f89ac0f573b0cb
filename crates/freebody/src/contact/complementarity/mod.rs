//! Which touches of an instant hold, slide or part, with Coulomb friction; knows no mechanics.
//!
//! k touches have the accelerations a = G λ + f, normal rows first, tangential after; G is the
//! Delassus matrix. [`solve`] finds forces and accelerations with
//!
//! - 0 ≤ λN ⟂ aN ≥ 0 at every touch;
//! - at rest: |λT| ≤ μ λN with aT = 0, or λT = −μ sgn(aT) λN;
//! - sliding with the sense s: λT = −μ s λN.
//!
//! In the plane this is a linear complementarity problem, so it can be decided: one motion, several
//! ([`Verdict::Indeterminate`]), or none ([`Verdict::Inconsistent`]); the last two are Painlevé's.
//! [`strike`] poses the same problem for velocities and impulses, and [`jam`] tells how a motion goes on that friction lets
//! not.
//!
//! Pivoting (`lemke.rs`, on the form in `form.rs`) proposes who carries; `modes.rs` solves the linear
//! equations of that proposal, holds them against the conditions above, and enumerates all proposals
//! where pivoting fails or uniqueness is asked for.

mod form;
mod impact;
mod jam;
mod laws;
mod lemke;
mod modes;
mod painleve;
mod search;
mod task;
#[cfg(test)]
mod tests;

pub use impact::{strike, Impulses, Law, NoImpact, Strike};
pub use jam::{jam, least};
pub use laws::{settle, undecided, yielding, Settled};
pub use painleve::{painleve, Painleve};

use crate::solve::Matrix;
use task::Task;

/// One instant of k touches.
#[derive(Clone, Copy, Debug)]
pub struct Problem<'a> {
    /// 2k × 2k, symmetric and positive semidefinite, possibly singular: acceleration (rows) by unit
    /// contact forces (columns), all other constraints eliminated. Row i < k is the normal of touch i,
    /// positive when it parts; row k + i its tangent.
    pub g: &'a Matrix,
    /// 2k: the accelerations without contact forces. They are judged against each other, so where nothing
    /// moves the touches they must be zero, and not round-off of something that cancels.
    pub free: &'a [f64],
    /// k: how each touch resists sliding.
    pub grips: &'a [Grip],
}

/// How a touch resists sliding; coefficients are force over force, from zero up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Grip {
    /// No tangential force.
    Smooth,
    /// Never slides while closed: friction without bound.
    Rough,
    /// Slides now.
    Sliding {
        /// ±1, the sign of the slip speed.
        sense: f64,
        /// The coefficient μ of kinetic friction.
        kinetic: f64,
    },
    /// Its slip speed is zero now.
    Resting {
        /// The coefficient of static friction, at least the kinetic one.
        fixed: f64,
        /// The coefficient once it slides.
        kinetic: f64,
    },
}

impl Grip {
    /// Whether its numbers are what they should be.
    fn is_sound(&self) -> bool {
        match *self {
            Grip::Smooth | Grip::Rough => true,
            Grip::Sliding { sense, kinetic } => sense.abs() == 1.0 && (0.0..f64::INFINITY).contains(&kinetic),
            Grip::Resting { fixed, kinetic } => fixed.is_finite() && (0.0..=fixed).contains(&kinetic),
        }
    }
}

/// What a touch does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Status {
    /// It parts, or it carries nothing: then its acceleration may be zero, as at a redundant touch.
    Open,
    /// It holds by its normal force alone.
    Closed,
    /// It holds and does not slide.
    Stick,
    /// It holds and slides, or begins to slide, in the direction ±1.
    Slip(f64),
}

/// Forces and accelerations that satisfy all conditions.
///
/// The answer is basic: the forces that are neither zero nor on the edge of their friction cone are
/// independent. Redundant touches share the load in one of many ways; those that carry nothing are open.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// k: what each touch does.
    pub status: Vec<Status>,
    /// k: the normal forces, ≥ 0.
    pub normal: Vec<f64>,
    /// k: the tangential forces.
    pub tangent: Vec<f64>,
    /// 2k: the accelerations G λ + f; exactly zero where a condition makes them so.
    pub acceleration: Vec<f64>,
}

/// What an instant of touches has as its answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// An answer. For up to three coupled touches, and without friction, its accelerations are the only ones.
    Solved(Answer),
    /// Answers with different accelerations, all of them valid. Where touches that do not influence each
    /// other are concerned, one group is varied at a time.
    Indeterminate(Vec<Answer>),
    /// No forces satisfy the conditions.
    Inconsistent,
    /// Pivoting found nothing and there are too many touches to try all modes; or masses differ so much that the
    /// rank of G is in doubt; or a number is not what it should be: not finite, a negative coefficient, a
    /// static one below the kinetic.
    Unknown,
}

/// Decides the instant.
///
/// Static friction has precedence over kinetic: a touch that can stay at rest under its static
/// coefficient stays. Those that cannot slide under the kinetic one, and the rest is decided again.
pub fn solve(problem: &Problem) -> Verdict {
    let k = problem.grips.len();
    resolve(problem.g, problem.free, problem.grips, &vec![0.0; k], &task::EXACT)
}

/// As [`solve`], where accelerations may contradict each other by a little: those of touches that are almost one, as where two
/// corners meet.
pub fn solve_roughly(problem: &Problem) -> Verdict {
    let k = problem.grips.len();
    resolve(problem.g, problem.free, problem.grips, &vec![0.0; k], &task::ROUGH)
}

/// The same with normal forces that are at least `pressed` (k): aN ⟂ λN − pressed.
fn resolve(g: &Matrix, free: &[f64], grips: &[Grip], pressed: &[f64], tolerances: &'static [f64]) -> Verdict {
    let k = grips.len();
    assert_eq!((g.rows(), g.cols(), free.len()), (2 * k, 2 * k, 2 * k), "a normal and a tangential row for each touch");
    let finite = g.data().iter().chain(free).chain(pressed).all(|v| v.is_finite());
    if !finite || !grips.iter().all(Grip::is_sound) {
        return Verdict::Unknown;
    }
    let nothing = Answer {
        status: vec![Status::Open; k],
        normal: vec![0.0; k],
        tangent: vec![0.0; k],
        acceleration: free.to_vec(),
    };
    let (mut answers, mut unknown) = (vec![nothing], false);
    for group in task::groups(g) {
        let task = Task::new(g, free, grips, pressed, &group).within(tolerances);
        match search::decide(&task) {
            search::Outcome::Found(found) => answers = combine(answers, &task, &found),
            search::Outcome::Nothing if !task.rank_is_doubtful() => return Verdict::Inconsistent,
            search::Outcome::Nothing | search::Outcome::Unknown => unknown = true,
        }
    }
    match answers.len() {
        _ if unknown => Verdict::Unknown,
        1 => Verdict::Solved(answers.remove(0)),
        _ => Verdict::Indeterminate(answers),
    }
}

/// Writes what a group does into the answers: its first finding into all, the others into the first.
fn combine(mut answers: Vec<Answer>, task: &Task, found: &[modes::Found]) -> Vec<Answer> {
    let base = answers[0].clone();
    answers.iter_mut().for_each(|a| task.write(&found[0], a));
    for other in &found[1..] {
        let mut answer = base.clone();
        task.write(other, &mut answer);
        answers.push(answer);
    }
    answers
}
