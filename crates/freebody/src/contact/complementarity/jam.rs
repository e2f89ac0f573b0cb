//! Jams: where friction lets no motion go on, velocities jump.

use super::impact::{strike, Impulses, Law, NoImpact, Strike};
use super::search::{decide, Outcome};
use super::task::{groups, Task};
use super::{Grip, Problem};

/// Part of its speed below which what slid has stopped.
const STOPPED: f64 = 1e-9;

/// The impulses, without a collision, of the groups of touches that have no motion (or of which none was found); None where
/// there is no such group, or no sliding comes to an end.
///
/// The forces of a short `moment` and the velocities after it, with friction by these velocities, always exist: where there are
/// forces they are these times the moment, and where there are none the impulses do not vanish with the moment (Stewart 2000,
/// *SIAM Review* 42; Génot & Brogliato 1999, *European Journal of Mechanics A* 18). Energy is never created; where
/// several impulses do, they are those that leave least of it.
///
/// `slips` (k) are the speeds of sliding, which must be large beside free accelerations times the moment.
pub fn jam(problem: &Problem, slips: &[f64], moment: f64) -> Result<Option<Impulses>, NoImpact> {
    let k = problem.grips.len();
    let mut before = vec![0.0; 2 * k];
    for group in groups(problem.g) {
        let task = Task::new(problem.g, problem.free, problem.grips, &vec![0.0; k], &group);
        if matches!(decide(&task), Outcome::Found(_)) {
            continue;
        }
        for i in group {
            before[i] = moment * problem.free[i];
            before[k + i] = slip(problem.grips[i], slips[i]) + moment * problem.free[k + i];
        }
    }
    let friction: Vec<f64> = problem.grips.iter().copied().map(coefficient).collect();
    let s = Strike { g: problem.g, before: &before, restitution: &vec![0.0; k], friction: &friction };
    let impulses = match strike(&s, Law::Newton) {
        Err(NoImpact::Ambiguous(all)) => least(all),
        struck => struck?,
    };
    // Where all go on sliding, the impulses over the moment are forces that were there to be found.
    let ends = |i: usize| impulses.after[k + i] * before[k + i] <= STOPPED * before[k + i] * before[k + i];
    let slid = |i: usize| impulses.normal[i] > 0.0 && matches!(problem.grips[i], Grip::Sliding { .. });
    let jumps = (0..k).any(|i| slid(i) && ends(i));
    Ok(jumps.then_some(impulses))
}

/// Of several outcomes the one that leaves least energy.
pub fn least(all: Vec<Impulses>) -> Impulses {
    all.into_iter().min_by(|a, b| a.work.total_cmp(&b.work)).expect("several outcomes")
}

fn slip(grip: Grip, slip: f64) -> f64 {
    match grip {
        Grip::Sliding { .. } => slip,
        _ => 0.0,
    }
}

fn coefficient(grip: Grip) -> f64 {
    match grip {
        Grip::Smooth => 0.0,
        Grip::Rough => f64::INFINITY,
        Grip::Sliding { kinetic, .. } | Grip::Resting { kinetic, .. } => kinetic,
    }
}
