//! The numbers beside the symbols, by which branches are decided: those of the state, but for what has no direction there.

use crate::dynamics::Workspace;
use crate::kinematics::{gradient, Kinematics, StateView};
use crate::mechanism::Gap;

/// Change of a coordinate, over its unit, by which a spring of no length, or a string of no free length, gets a direction.
const ASIDE: f64 = 1e-3;

/// The coordinates of the state, or those of one a little aside, where each takes another change, so that they differ.
pub(super) fn coordinates(workspace: &Workspace<'_>) -> Vec<f64> {
    let (at, mut q) = (workspace.at(), workspace.at().q.to_vec());
    let mut left = without_direction(at);
    if left == 0 {
        return q;
    }
    for (i, unit) in workspace.units().into_iter().enumerate() {
        let by = ASIDE * unit * (1.0 + (i % 7) as f64 / 3.0);
        for change in [by, -by] {
            let mut moved = q.clone();
            moved[i] += change;
            let mut k = Kinematics::of(at.m);
            k.forward_kinematics(at.m, at.n, &moved, at.u);
            let found = without_direction(StateView { k: &k, q: &moved, ..at });
            if found <= left {
                (q, left) = (moved, found);
                break;
            }
        }
    }
    q
}

/// How many pulls and strings in place have no direction.
fn without_direction(at: StateView<'_, f64>) -> usize {
    let pulls = at.forces().flat_map(|(_, force)| &force.gauge_forces);
    let points = pulls.filter(|pull| {
        let mut along = pull.bodies.iter().flat_map(|&body| gradient(at, &pull.gauge, body).parts());
        !along.all(f64::is_finite)
    });
    let strings = at.m.unilateral.iter().zip(at.mode.contacts.iter()).filter(|(constraint, contact)| {
        let Gap::Cable(cable) = &constraint.gap else { return false };
        contact.mode.is_closed() && cable.is_without_free_length(at.m, &at, contact.feature)
    });
    points.count() + strings.count()
}
