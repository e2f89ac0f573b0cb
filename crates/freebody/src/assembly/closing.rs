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

/// Rows to close: loops, drives and what is held.
pub(super) fn rows(workspace: &mut Workspace, held: &[(String, ModelExpr, f64)]) -> Vec<(Row, f64)> {
    workspace.update_rows();
    let mut rows: Vec<(Row, f64)> =
        workspace.rows().iter().filter_map(|row| workspace.gap(row).map(|gap| (row.clone(), gap))).collect();
    for (_, gauge, value) in held {
        let row = workspace.target_row(gauge, *value, 0.0);
        let gap = row.value.unwrap_or(0.0);
        rows.push((row, gap));
    }
    rows
}

fn worst(workspace: &Workspace, rows: &[(Row, f64)]) -> f64 {
    rows.iter().map(|(row, gap)| gap.abs() / workspace.row_unit(row)).fold(0.0, f64::max)
}

/// Damped least squares on all rows; returns the largest gap left.
pub(super) fn descend(workspace: &mut Workspace, t: f64, held: &[(String, ModelExpr, f64)], q: &mut Vec<f64>) -> f64 {
    let at_rest = vec![0.0; q.len()];
    workspace.move_to(t, q, &at_rest);
    let mut present = rows(workspace, held);
    // Near the solution full steps converge quadratically; where they do not help, the assembly is singular or far.
    let mut damping = 0.0;
    for _ in 0..DESCENTS {
        let (gap, size) = (worst(workspace, &present), norm(workspace, &present));
        if gap <= CLOSED || !gap.is_finite() {
            break;
        }
        let step = workspace.damped_motion(&present, damping);
        let mut user = vec![0.0; q.len()];
        workspace.to_user(&step, &mut user);
        let longest = user.iter().zip(workspace.units()).map(|(d, unit)| (d / unit).abs()).fold(1.0, f64::max);
        let trial: Vec<f64> = q.iter().zip(&user).map(|(q, d)| q + d / longest).collect();
        workspace.move_to(t, &trial, &at_rest);
        let next = rows(workspace, held);
        if norm(workspace, &next) < size {
            (*q, present) = (trial, next);
            damping = if damping < UNDAMPED { 0.0 } else { EASED * damping };
        } else {
            workspace.move_to(t, q, &at_rest);
            if gap <= OPEN || damping > HOPELESS {
                break;
            }
            damping = (STIFFENED * damping).max(DAMPED);
        }
    }
    worst(workspace, &present)
}

fn norm(workspace: &Workspace, rows: &[(Row, f64)]) -> f64 {
    let square = |(row, gap): &(Row, f64)| (gap / workspace.row_unit(row)) * (gap / workspace.row_unit(row));
    rows.iter().map(square).sum::<f64>().sqrt()
}
