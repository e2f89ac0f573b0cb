//! Impact without collision: where friction lets no motion go on, velocities jump.

use super::impact::{impact, ImpactLaw, ImpactProblem, Impulses, NoImpact};
use super::lcp_block::{groups, LcpBlock};
use super::mode_search::{decide, Outcome};
use super::{FrictionLaw, Problem};

/// Part of its speed below which what slid has stopped.
const STOPPED: f64 = 1e-9;

/// The impulses, without a collision, of the groups of contacts that have no motion (or of which none was found); None
/// where there is no such group, or no sliding comes to an end.
///
/// The forces of a short `moment` and the velocities after it, with friction by these velocities, always exist: where
/// there are forces they are these times the moment, and where there are none the impulses do not vanish with the
/// moment (Stewart 2000,
/// *SIAM Review* 42; Génot & Brogliato 1999, *European Journal of Mechanics A* 18). Energy is never created; where
/// several impulses do, they are those that leave least of it.
///
/// `slips` (k) are the speeds of sliding, which must be large beside free accelerations times the moment.
pub fn impact_without_collision(problem: &Problem, slips: &[f64], moment: f64) -> Result<Option<Impulses>, NoImpact> {
    let k = problem.friction.len();
    let mut before = vec![0.0; 2 * k];
    for group in groups(problem.g) {
        let block = LcpBlock::new(problem.g, problem.free, problem.friction, &vec![0.0; k], &group);
        if matches!(decide(&block), Outcome::Found(_)) {
            continue;
        }
        for i in group {
            before[i] = moment * problem.free[i];
            before[k + i] = slip(problem.friction[i], slips[i]) + moment * problem.free[k + i];
        }
    }
    let friction: Vec<f64> = problem.friction.iter().copied().map(coefficient).collect();
    let s = ImpactProblem { g: problem.g, before: &before, restitution: &vec![0.0; k], friction: &friction };
    let impulses = match impact(&s, ImpactLaw::Newton) {
        Err(NoImpact::Ambiguous(all)) => least(all),
        impulses => impulses?,
    };
    // Where all go on sliding, the impulses over the moment are forces that were there to be found.
    let ends = |i: usize| impulses.after[k + i] * before[k + i] <= STOPPED * before[k + i] * before[k + i];
    let slid = |i: usize| impulses.normal[i] > 0.0 && matches!(problem.friction[i], FrictionLaw::Sliding { .. });
    let jumps = (0..k).any(|i| slid(i) && ends(i));
    Ok(jumps.then_some(impulses))
}

/// Of several outcomes the one that leaves least energy.
pub fn least(all: Vec<Impulses>) -> Impulses {
    all.into_iter().min_by(|a, b| a.work.total_cmp(&b.work)).expect("several outcomes")
}

fn slip(friction_law: FrictionLaw, slip: f64) -> f64 {
    match friction_law {
        FrictionLaw::Sliding { .. } => slip,
        _ => 0.0,
    }
}

fn coefficient(friction_law: FrictionLaw) -> f64 {
    match friction_law {
        FrictionLaw::Frictionless => 0.0,
        FrictionLaw::Rough => f64::INFINITY,
        FrictionLaw::Sliding { kinetic, .. } | FrictionLaw::Resting { kinetic, .. } => kinetic,
    }
}
