//! Which contacts of an instant hold, slide or part, with Coulomb friction; knows no mechanics.
//!
//! k contacts have the accelerations a = G λ + f, normal rows first, tangential after; G is the
//! Delassus matrix. [`solve`] finds forces and accelerations with
//!
//! - 0 ≤ λN ⟂ aN ≥ 0 at every contact;
//! - at rest: |λT| ≤ μ λN with aT = 0, or λT = −μ sgn(aT) λN;
//! - sliding with the sense s: λT = −μ s λN.
//!
//! In the plane this is a linear complementarity problem, so it can be decided: one motion, several
//! ([`Verdict::Indeterminate`]), or none ([`Verdict::Inconsistent`]); the last two are Painlevé's. [`strike`] poses the
//! same problem for velocities and impulses, and [`jam`] tells how a motion goes on that friction lets not.
//!
//! Pivoting (`lemke.rs`, on the form in `form.rs`), or relaxation where it finds nothing, proposes who carries; `modes.rs` solves the linear
//! equations of that proposal, holds them against the conditions above, and enumerates all proposals
//! where pivoting fails or uniqueness is asked for.

mod form;
mod impact;
mod impact_laws;
mod impact_without_collision;
mod lcp_block;
mod lemke;
mod mode_search;
mod modes;
mod painleve;
mod relaxation;
#[cfg(test)]
mod tests;

pub use impact::{impact, ImpactLaw, ImpactProblem, Impulses, NoImpact};
pub use impact_laws::{compliant_regularization, solve_impact, undecided, ImpactOutcome};
pub use impact_without_collision::{impact_without_collision, least};
pub use painleve::{painleve, Painleve};

use crate::solve::Matrix;
use lcp_block::LcpBlock;

/// One instant of k contacts.
#[derive(Clone, Copy, Debug)]
pub struct Problem<'a> {
    /// 2k × 2k, symmetric and positive semidefinite, possibly singular: acceleration (rows) by unit
    /// contact forces (columns), all other constraints eliminated. Row i < k is the normal of contact i,
    /// positive when it parts; row k + i its tangent.
    pub g: &'a Matrix,
    /// 2k: the accelerations without contact forces. They are judged against each other, so where nothing
    /// moves the contacts they must be zero, and not round-off of something that cancels.
    pub free: &'a [f64],
    /// k: how each contact resists sliding.
    pub friction: &'a [FrictionLaw],
}

/// How a contact resists sliding; coefficients are force over force, from zero up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FrictionLaw {
    /// No tangential force.
    Frictionless,
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

impl FrictionLaw {
    /// Whether its numbers are what they should be.
    fn is_sound(&self) -> bool {
        match *self {
            FrictionLaw::Frictionless | FrictionLaw::Rough => true,
            FrictionLaw::Sliding { sense, kinetic } => sense.abs() == 1.0 && (0.0..f64::INFINITY).contains(&kinetic),
            FrictionLaw::Resting { fixed, kinetic } => fixed.is_finite() && (0.0..=fixed).contains(&kinetic),
        }
    }
}

/// What a contact does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Status {
    /// It parts, or it carries nothing: then its acceleration may be zero, as at a redundant contact.
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
/// The answer is basic: the forces are independent but for those that are zero, on the edge of their friction cone, or friction that
/// is a given part of a normal force. Redundant contacts share the load in one of many ways; those that carry nothing are open.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// k: what each contact does.
    pub status: Vec<Status>,
    /// k: the normal forces, ≥ 0.
    pub normal: Vec<f64>,
    /// k: the tangential forces.
    pub tangent: Vec<f64>,
    /// 2k: the accelerations G λ + f; exactly zero where a condition makes them so.
    pub acceleration: Vec<f64>,
}

/// What an instant of contacts has as its answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// An answer. For up to three coupled contacts, and without friction, its accelerations are the only ones.
    Solved(Answer),
    /// Answers with different accelerations, all of them valid. Where contacts that do not influence each
    /// other are concerned, one group is varied at a time.
    Indeterminate(Vec<Answer>),
    /// No forces satisfy the conditions.
    Inconsistent,
    /// Pivoting found nothing and there are too many contacts to try all modes; or masses differ so much that the
    /// rank of G is in doubt; or a number is not what it should be: not finite, a negative coefficient, a
    /// static one below the kinetic.
    Unknown,
}

/// Decides the instant.
///
/// Static friction has precedence over kinetic: a contact that can stay at rest under its static
/// coefficient stays. Those that cannot slide under the kinetic one, and the rest is decided again.
pub fn solve(problem: &Problem) -> Verdict {
    let k = problem.friction.len();
    resolve(problem.g, problem.free, problem.friction, &vec![0.0; k], &lcp_block::EXACT)
}

/// The answer with the friction that contacts share, without being determined, well inside its cones: on the edge it gives way at
/// once. What each contact does stays as it is, and so does all where that is no answer.
pub fn inside(problem: &Problem, mut answer: Answer) -> Answer {
    let Problem { g, free, friction } = *problem;
    for group in lcp_block::groups(g) {
        let block = LcpBlock::new(g, free, friction, &vec![0.0; friction.len()], &group);
        let status: Vec<Status> = group.iter().map(|&i| answer.status[i]).collect();
        let modes: Vec<modes::Mode> = status.iter().map(|&does| modes::Mode::of(does)).collect();
        let basic = |&tolerance: &f64| modes::basic(&block, &modes, false, tolerance).ok();
        let found = block.tolerances.iter().find_map(basic).filter(|found| found.status == status);
        found.iter().for_each(|found| block.write(found, &mut answer));
    }
    answer
}

/// As [`solve`], where accelerations may contradict each other by a little: those of contacts that are almost one, as
/// where two corners meet.
pub fn solve_relaxed(problem: &Problem) -> Verdict {
    let k = problem.friction.len();
    resolve(problem.g, problem.free, problem.friction, &vec![0.0; k], &lcp_block::RELAXED)
}

/// The same with normal forces that are at least `pressed` (k): aN ⟂ λN − pressed.
fn resolve(
    g: &Matrix,
    free: &[f64],
    friction: &[FrictionLaw],
    least_normal: &[f64],
    tolerances: &'static [f64],
) -> Verdict {
    let k = friction.len();
    assert_eq!((g.rows(), g.cols(), free.len()), (2 * k, 2 * k, 2 * k), "a normal and a tangential row for each touch");
    let finite = g.data().iter().chain(free).chain(least_normal).all(|v| v.is_finite());
    if !finite || !friction.iter().all(FrictionLaw::is_sound) {
        return Verdict::Unknown;
    }
    let nothing = Answer {
        status: vec![Status::Open; k],
        normal: vec![0.0; k],
        tangent: vec![0.0; k],
        acceleration: free.to_vec(),
    };
    let (mut answers, mut unknown) = (vec![nothing], false);
    for group in lcp_block::groups(g) {
        let block = LcpBlock::new(g, free, friction, least_normal, &group).within(tolerances);
        match mode_search::decide(&block) {
            mode_search::Outcome::Found(found) => answers = combine(answers, &block, &found),
            mode_search::Outcome::Nothing if !block.rank_is_doubtful() => return Verdict::Inconsistent,
            mode_search::Outcome::Nothing | mode_search::Outcome::Unknown => unknown = true,
        }
    }
    match answers.len() {
        _ if unknown => Verdict::Unknown,
        1 => Verdict::Solved(answers.remove(0)),
        _ => Verdict::Indeterminate(answers),
    }
}

/// Writes what a group does into the answers: its first finding into all, the others into the first.
fn combine(mut answers: Vec<Answer>, block: &LcpBlock, found: &[lcp_block::Found]) -> Vec<Answer> {
    let base = answers[0].clone();
    answers.iter_mut().for_each(|a| block.write(&found[0], a));
    for other in &found[1..] {
        let mut answer = base.clone();
        block.write(other, &mut answer);
        answers.push(answer);
    }
    answers
}
