//! The decision on a task: pivoting, enumeration, and the order of static before kinetic friction.

use super::form::{propose, Proposal};
use super::modes::{admissible, basic, choices, evaluate, vertices, Found, Mode, Refusal, Tangent};
use super::task::{Hold, Task};
use super::{Grip, Status};

/// Up to this many coupled touches all modes are tried, to see whether the answer is the only one.
const ALWAYS: usize = 3;
/// Up to this many all modes are tried when pivoting fails.
const ENUMERABLE: usize = 6;
/// Accelerations that differ by less are the same.
const SAME: f64 = 1e-9;

/// Where touches oppose each other, round-off can leave no motion that opens or closes all; so pivoting is
/// tried again with touches moved apart by this, and what it proposes is judged without.
const APART: [f64; 4] = [0.0, 1e-9, 1e-7, 1e-5];

/// Paths of pivoting tried: where many touches are redundant, round-off leads some of them astray.
const PATHS: usize = 6;

/// Vertices tried of forces that their equations do not determine: all, for six touches.
const TRIES: usize = 4_096;

/// What there is to find.
#[derive(Clone, Debug)]
pub(super) enum Outcome {
    /// At least one finding, with different accelerations.
    Found(Vec<Found>),
    /// Certainly none.
    Nothing,
    /// None was found, but not all modes were tried.
    Unknown,
}

/// Decides a task.
pub(super) fn decide(task: &Task) -> Outcome {
    let at_rest = task.held(|_, hold| match hold {
        Hold::Grip(Grip::Resting { fixed, .. }) => Hold::Grip(Grip::Resting { fixed, kinetic: fixed }),
        _ => hold,
    });
    let first = bounded(&at_rest);
    if at_rest.holds == task.holds {
        return first;
    }
    let mut all = Vec::new();
    match first {
        Outcome::Found(found) => found.into_iter().for_each(|f| slide(task, f, &mut all)),
        // Proved without regard to friction.
        Outcome::Nothing if task.len() > ENUMERABLE => return Outcome::Nothing,
        Outcome::Nothing | Outcome::Unknown => {}
    }
    match all.len() {
        0 if task.len() <= ENUMERABLE => most_at_rest(task),
        0 => Outcome::Unknown,
        _ => Outcome::Found(all),
    }
}

/// Lets the touches that slipped under their static coefficients slide under the kinetic ones, and decides
/// the others again, until no more slip.
fn slide(task: &Task, found: Found, all: &mut Vec<Found>) {
    let starts = |i: usize, hold: Hold| match (hold, found.status[i]) {
        (Hold::Grip(Grip::Resting { fixed, kinetic }), Status::Slip(s)) if kinetic < fixed => {
            Hold::Starting(s, kinetic)
        }
        _ => hold,
    };
    let next = task.held(starts);
    if next.holds == task.holds {
        return add(all, found);
    }
    if let Outcome::Found(found) = decide(&next) {
        found.into_iter().for_each(|f| add(all, f));
    }
}

/// Of all findings with static friction at rest and kinetic in motion, those with most touches at rest.
fn most_at_rest(task: &Task) -> Outcome {
    let at_rest = |f: &Found| f.status.iter().filter(|s| **s == Status::Stick).count();
    let all = task.tolerances.iter().map(|t| enumerate(task, Vec::new(), *t)).find(|all| !all.is_empty());
    let Some(mut all) = all else { return Outcome::Nothing };
    let most = all.iter().map(at_rest).max();
    all.retain(|f| Some(at_rest(f)) == most);
    Outcome::Found(all)
}

/// Decides a task in which static and kinetic friction are the same.
fn bounded(task: &Task) -> Outcome {
    let unique = task.holds.iter().all(|h| *h == Hold::Grip(Grip::Smooth));
    let few = task.len() <= ALWAYS && !unique;
    for tolerance in task.tolerances.iter().filter(|_| !few) {
        match pivot(task, *tolerance) {
            Outcome::Unknown => {}
            decided => return decided,
        }
    }
    if task.len() > ENUMERABLE {
        return Outcome::Unknown;
    }
    for &tolerance in task.tolerances {
        let pivoted = match pivot(task, tolerance) {
            Outcome::Found(found) => found,
            Outcome::Nothing => return Outcome::Nothing,
            Outcome::Unknown => Vec::new(),
        };
        let all = enumerate(task, pivoted, tolerance);
        if !all.is_empty() {
            return Outcome::Found(all);
        }
    }
    Outcome::Nothing
}

/// What pivoting alone finds.
pub(super) fn pivot(task: &Task, tolerance: f64) -> Outcome {
    for (path, apart) in (0..PATHS).flat_map(|path| APART.map(|apart| (path, apart))) {
        match propose(task, apart, path) {
            Proposal::Modes(modes) => {
                if let Some(found) = vertex(task, &modes, tolerance) {
                    return Outcome::Found(vec![found]);
                }
            }
            Proposal::Impossible => return Outcome::Nothing,
            Proposal::None => {}
        }
    }
    Outcome::Unknown
}

/// What all modes add to the findings.
pub(super) fn enumerate(task: &Task, mut all: Vec<Found>, tolerance: f64) -> Vec<Found> {
    let lists: Vec<Vec<Mode>> = (0..task.len()).map(|i| admissible(task.holds[i], task.pressed[i])).collect();
    choices(&lists, |modes| {
        vertex(task, modes, tolerance).into_iter().for_each(|found| add(&mut all, found));
        false
    });
    all
}

/// The finding of these modes; where they do not determine the forces, the first of its vertices, with more touches one near
/// the middle.
fn vertex(task: &Task, modes: &[Mode], tolerance: f64) -> Option<Found> {
    let mut result = evaluate(task, modes, tolerance);
    let is_singular = matches!(result, Err(Refusal::Singular));
    if is_singular && task.len() > ALWAYS {
        result = basic(task, modes, tolerance);
    }
    if result.is_err() && is_singular && task.len() <= ENUMERABLE {
        let lists: Vec<Vec<Mode>> = modes.iter().zip(&task.holds).map(|(m, h)| vertices(*h, *m)).collect();
        let mut tries = 0;
        choices(&lists, |modes| {
            tries += 1;
            result = evaluate(task, modes, tolerance);
            result.is_ok() || tries == TRIES
        });
    }
    let found = result.ok()?;
    // On the edge of its cone but held by others, a touch may not need a tangential force at all.
    match held(task, modes, &found).filter(|_| task.len() <= ENUMERABLE) {
        Some(modes) => vertex(task, &modes, tolerance).or(Some(found)),
        None => Some(found),
    }
}

/// The modes with the touches stuck that were to slip and do not, if there are such.
fn held(task: &Task, modes: &[Mode], found: &Found) -> Option<Vec<Mode>> {
    let resting = |i: usize| matches!(task.holds[i], Hold::Grip(Grip::Resting { .. }));
    let still =
        |i: usize| matches!(modes[i].tangent, Tangent::Slip(_)) && found.status[i] == Status::Stick && resting(i);
    let stick = |i: usize| if still(i) { Mode { tangent: Tangent::Stick, ..modes[i] } } else { modes[i] };
    (0..modes.len()).any(still).then(|| (0..modes.len()).map(stick).collect())
}

/// Adds a finding whose accelerations are new.
fn add(all: &mut Vec<Found>, found: Found) {
    let size = found.acceleration.iter().fold(1.0_f64, |m, a| m.max(a.abs()));
    let same = |f: &Found| f.acceleration.iter().zip(&found.acceleration).all(|(a, b)| (a - b).abs() <= SAME * size);
    if !all.iter().any(same) {
        all.push(found);
    }
}
