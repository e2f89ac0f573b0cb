//! Closing of loops by damped least squares (Levenberg 1944, Marquardt 1963).

use crate::dynamics::{Row, Workspace, CLOSED, OPEN};
use crate::gauges::ModelExpr;

/// Iterations of one attempt.
const DESCENTS: usize = 300;
/// Square of the part of a row below which damping changes no digit that counts: full steps again.
const UNDAMPED: f64 = 1e-6;
/// First damping where a full step does not help, in squares of rows of size 1, and that beyond which no step does.
const DAMPED: f64 = 1e-4;
const HOPELESS: f64 = 1e9;
/// What a step that helps makes of the damping, and one that does not: it rises as fast as it falls (Marquardt's ν).
const EASED: f64 = 0.2;
const STIFFENED: f64 = 1.0 / EASED;

/// Rows to close, loops, drives and what is held, and what is open at them.
pub(super) fn rows(workspace: &mut Workspace, held: &[(String, ModelExpr, f64)]) -> (Vec<Row>, Vec<f64>) {
    workspace.update_rows();
    let closing = workspace.rows().iter().filter_map(|row| Some((row.clone(), workspace.gap(row)?)));
    let targets = held.iter().map(|(_, gauge, value)| {
        let row = workspace.target_row(gauge, *value, 0.0);
        let gap = row.value.unwrap_or(0.0);
        (row, gap)
    });
    closing.chain(targets).unzip()
}

/// The present rows, and how far they are open, each in its own unit: at most, and by their squares.
struct Open {
    rows: Vec<Row>,
    gaps: Vec<f64>,
    worst: f64,
    norm: f64,
}

impl Open {
    fn at(workspace: &mut Workspace, held: &[(String, ModelExpr, f64)]) -> Self {
        let (rows, gaps) = rows(workspace, held);
        let sizes = rows.iter().zip(&gaps).map(|(row, gap)| (gap / workspace.row_unit(row)).abs());
        let (worst, square) = sizes.fold((0.0_f64, 0.0), |(worst, sum), size| (worst.max(size), sum + size * size));
        Open { rows, gaps, worst, norm: square.sqrt() }
    }
}

/// Damped least squares on all rows; returns the largest gap left. A step that lessens the gaps by no more than a part of `stalled` is the
/// last.
pub(super) fn descend(
    workspace: &mut Workspace,
    t: f64,
    held: &[(String, ModelExpr, f64)],
    q: &mut Vec<f64>,
    stalled: f64,
) -> f64 {
    let at_rest = vec![0.0; q.len()];
    workspace.move_to(t, q, &at_rest);
    let mut present = Open::at(workspace, held);
    // Near the solution full steps converge quadratically; where they do not help, the assembly is singular or far.
    let mut damping = 0.0;
    for _ in 0..DESCENTS {
        if present.worst <= CLOSED || !present.worst.is_finite() {
            break;
        }
        let step = workspace.damped_motion(&present.rows, &present.gaps, damping);
        let mut user = vec![0.0; q.len()];
        workspace.to_user(&step, &mut user);
        let longest = user.iter().zip(workspace.units()).map(|(d, unit)| (d / unit).abs()).fold(1.0, f64::max);
        let trial: Vec<f64> = q.iter().zip(&user).map(|(q, d)| q + d / longest).collect();
        workspace.move_to(t, &trial, &at_rest);
        let next = Open::at(workspace, held);
        if next.norm < present.norm {
            let is_stalled = next.norm > (1.0 - stalled) * present.norm;
            (*q, present) = (trial, next);
            damping = if damping < UNDAMPED { 0.0 } else { EASED * damping };
            if is_stalled {
                break;
            }
        } else {
            workspace.move_to(t, q, &at_rest);
            if present.worst <= OPEN || damping > HOPELESS {
                break;
            }
            damping = (STIFFENED * damping).max(DAMPED);
        }
    }
    present.worst
}
