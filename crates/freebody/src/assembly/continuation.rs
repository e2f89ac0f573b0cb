//! From one closed state to another along the mechanism. Loops that can be closed in several ways, such as a parallelogram
//! and the crossed one, change over only in singular positions; between these a mechanism stays in one assembly.

use super::closing::{descend, rows};
use super::{AssemblyRequest, Closed};
use crate::dynamics::{DynamicsError, Workspace, OPEN};
use crate::gauges::ModelExpr;
use crate::solve::Matrix;

/// Independence of the rows, over that at the beginning, below which a singular position is near.
const BESIDE: f64 = 0.1;
/// Change of the rows in a step, over the least combination of them: below 1 they stay independent on the way, since no
/// singular value changes by more than the matrix does (Weyl 1912).
const SAFE: f64 = 0.5;
/// Radians, or characteristic lengths, that a step makes at most.
const LONGEST: f64 = 0.5;
/// Part of the way below which no step helps.
const SHORTEST: f64 = 1e-3;

/// The coordinates asked for, reached by evenly changing parameters, time, what is held and where else to start.
///
/// # Errors
/// `branch_lost` where the way comes near a singular position.
pub(super) fn follow(
    workspace: &mut Workspace,
    t: f64,
    request: &AssemblyRequest,
    from: &Closed,
) -> Result<Vec<f64>, DynamicsError> {
    let way = Way::new(workspace, t, request, from);
    let (mut done, mut part, mut q) = (0.0, 1.0, from.q.clone());
    way.go_to(workspace, 0.0, &mut q);
    let mut beginning = Independence::of(workspace, &way.held_at(0.0));
    let mut here = beginning.clone();
    while done < 1.0 {
        if part < SHORTEST {
            return Err(DynamicsError::SingularWay);
        }
        let at = f64::min(done + part, 1.0);
        let mut next: Vec<f64> = (0..q.len()).map(|i| q[i] + (at - done) * (request.start[i] - from.q[i])).collect();
        let closed = way.go_to(workspace, at, &mut next);
        let there = Independence::of(workspace, &way.held_at(at));
        let units = workspace.units();
        let near = (0..q.len()).all(|i| (next[i] - q[i]).abs() <= LONGEST * units[i]);
        // From a singular position every way out is one.
        let leaves = done == 0.0 && there.rank > beginning.rank;
        if closed && near && (leaves || there.joins(&here) && there.least >= BESIDE * beginning.least) {
            if leaves {
                beginning = there.clone();
            }
            (done, q, here) = (at, next, there);
            part *= 2.0;
        } else {
            part /= 2.0;
        }
    }
    Ok(q)
}

/// From a state to what is asked for.
struct Way<'a> {
    t: [f64; 2],
    /// The parameters that follow from no others.
    given: Vec<(usize, [f64; 2])>,
    held: Vec<(&'a (String, ModelExpr, f64), f64)>,
}

impl<'a> Way<'a> {
    fn new(workspace: &mut Workspace, t: f64, request: &'a AssemblyRequest, from: &Closed) -> Self {
        let (m, p) = (workspace.m, workspace.at().n.p.clone());
        let own = m.overruled(&p).into_iter().chain(m.overruled(&from.p)).map(|(i, _)| i);
        let given = own.chain(m.first_state()..p.len()).map(|i| (i, [from.p[i], p[i]])).collect();
        workspace.rebind(&from.p);
        workspace.move_to(from.t, &from.q, &vec![0.0; from.q.len()]);
        let begins = |gauge| workspace.target_row(gauge, 0.0, 0.0).value.unwrap_or(0.0);
        let held = request.held.iter().map(|each| (each, begins(&each.1))).collect();
        Way { t: [from.t, t], given, held }
    }

    fn held_at(&self, part: f64) -> Vec<(String, ModelExpr, f64)> {
        let value = |end: f64, begins: f64| between([begins, end], part);
        self.held
            .iter()
            .map(|((name, gauge, end), begins)| (name.clone(), gauge.clone(), value(*end, *begins)))
            .collect()
    }

    /// Whether loops close, with what is held, when a part of the way is done.
    fn go_to(&self, workspace: &mut Workspace, part: f64, q: &mut Vec<f64>) -> bool {
        let given: Vec<(usize, f64)> = self.given.iter().map(|&(i, ends)| (i, between(ends, part))).collect();
        workspace.rebind(&workspace.m.parameters_with(&given));
        descend(workspace, between(self.t, part), &self.held_at(part), q, 0.0) <= OPEN
    }
}

/// The end itself, not only to round-off.
fn between([a, b]: [f64; 2], part: f64) -> f64 {
    if part < 1.0 {
        a + part * (b - a)
    } else {
        b
    }
}

/// The rows of a state, and how independent they are.
#[derive(Clone)]
struct Independence {
    rows: Matrix,
    rank: usize,
    least: f64,
}

impl Independence {
    /// Of the present state: of loops, drives and what is held.
    fn of(workspace: &mut Workspace, held: &[(String, ModelExpr, f64)]) -> Self {
        let (present, _) = rows(workspace, held);
        let (rows, rank) = workspace.independence_of(&present);
        let largest = (0..rows.rows()).map(|i| size(rows.row(i))).fold(0.0, f64::max);
        Independence { rank: rank.rank, least: rank.kept * largest, rows }
    }

    /// Whether rows stay independent on the way from another state.
    fn joins(&self, before: &Self) -> bool {
        let change = |i| self.rows.row(i).iter().zip(before.rows.row(i)).map(|(a, b)| a - b).collect::<Vec<_>>();
        let changes: Vec<f64> = (0..self.rows.rows()).map(|i| size(&change(i))).collect();
        self.rank == before.rank && size(&changes) <= SAFE * before.least
    }
}

fn size(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}
