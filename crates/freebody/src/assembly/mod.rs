//! Assembly: coordinates and rates that close all loops and keep what was asked for.

mod closing;
mod continuation;
mod released;

use crate::dynamics::{DynamicsError, Workspace, OPEN};
use crate::gauges::ModelExpr;
use crate::kinematics::{jet, MotionView};
use crate::mechanism::Mechanism;
use crate::scalar::real;
use closing::{descend, rows};
use continuation::follow;

/// What an initial state is asked to be.
#[derive(Clone, Debug, Default)]
pub struct AssemblyRequest {
    /// Starting values of the tree's coordinates, in the order of `q`.
    pub start: Vec<f64>,
    /// Starting values of their rates.
    pub start_rates: Vec<f64>,
    /// Gauges that must have a value.
    pub held: Vec<(String, ModelExpr, f64)>,
    /// Gauges that should be near a value, to choose an assembly.
    pub near: Vec<(String, ModelExpr, f64)>,
    /// Gauges whose rate must have a value.
    pub held_rates: Vec<(String, ModelExpr, f64)>,
    /// Expressions that must be positive (+1) or negative (−1).
    pub branch: Vec<(String, ModelExpr, i8)>,
    /// Of each coordinate, whether another assembly may be looked for by changing its start.
    pub free: Vec<bool>,
    /// A state from which the one asked for is to be reached, so that it is of the same assembly.
    pub from: Option<Closed>,
}

impl AssemblyRequest {
    /// Asks for another value of a gauge that is held, or of its rate.
    pub fn ask(&mut self, m: &Mechanism, name: &str, value: f64, of_rate: bool) {
        let (held, start) = match of_rate {
            false => (&mut self.held, &mut self.start),
            true => (&mut self.held_rates, &mut self.start_rates),
        };
        held.iter_mut().filter(|(gauge, ..)| gauge == name).for_each(|(.., asked)| *asked = value);
        let own = start.iter_mut().enumerate().filter(|(i, _)| m.coordinate(*i).name == name);
        own.for_each(|(_, start)| *start = value);
    }
}

/// A state with all loops closed.
#[derive(Clone, Debug)]
pub struct Closed {
    /// Parameters.
    pub p: Vec<f64>,
    /// Time, s.
    pub t: f64,
    /// Coordinates.
    pub q: Vec<f64>,
}

/// An assembled state.
#[derive(Clone, Debug)]
pub struct Assembled {
    /// Coordinates.
    pub q: Vec<f64>,
    /// Rates.
    pub u: Vec<f64>,
    /// Gauges that should be near a value, with the one they have.
    pub near: Vec<(String, f64)>,
    /// Largest gap, m or rad over the unit of its row.
    pub gap: f64,
    /// Coordinates of the other assemblies that were found, when the state is fully determined.
    pub others: Vec<Vec<f64>>,
    /// A sentence for each contact on whose wrong side a body seems to be.
    pub behind: Vec<String>,
}

/// Part of a radian, or of the characteristic length, within which two configurations are the same.
const SAME_PLACE: f64 = 1e-6;
/// Attempts from other starts.
const ATTEMPTS: usize = 64;
/// Part by which a step must lessen the gaps there: one that does not nears a place where they are least, but open.
const STALLED: f64 = 1e-5;

/// Assembles a mechanism at time `t`.
///
/// Positions by damped least squares from the starting values, or step by step from a state of the assembly that is wished
/// for; then velocities by the least correction.
///
/// # Errors
/// `cannot_assemble` with the gap at each joint, `branch_not_found`, `branch_lost`, `inconsistent_velocities`.
pub fn assemble(workspace: &mut Workspace, t: f64, request: &AssemblyRequest) -> Result<Assembled, DynamicsError> {
    let [q, u] = state(workspace, t, request)?;
    let others = match request.from {
        Some(_) => vec![],
        None => other_assemblies(workspace, t, request, &q),
    };
    workspace.move_to(t, &q, &u);
    let gap = workspace.worst_gap();
    let laws: Vec<&ModelExpr> = request.near.iter().map(|(_, law, _)| law).collect();
    let values = workspace.evaluate(&laws, &[])?;
    let near = request.near.iter().map(|(name, ..)| name.clone()).zip(values).collect();
    let behind = workspace.behind_lines();
    Ok(Assembled { q, u, near, gap, others, behind })
}

/// The coordinates and rates of [`assemble`] alone.
///
/// # Errors
/// As [`assemble`].
pub fn state(workspace: &mut Workspace, t: f64, request: &AssemblyRequest) -> Result<[Vec<f64>; 2], DynamicsError> {
    let q = match &request.from {
        Some(from) => follow(workspace, t, request, from)?,
        None => {
            let start = released::start(workspace, t, request);
            match attempt(workspace, t, request, &start, 0.0) {
                Ok(q) if on_branch(workspace, t, &q, request) => q,
                first => {
                    let first = first.map_err(|q| cannot_assemble(workspace, t, request, &q));
                    search(workspace, t, request, first)?
                }
            }
        }
    };
    let u = velocities(workspace, t, request, &q)?;
    Ok([q, u])
}

/// One attempt from one start, given up where it is `stalled`: first drawn to what should be near, then closed exactly, or as nearly as it
/// goes.
fn attempt(
    workspace: &mut Workspace,
    t: f64,
    request: &AssemblyRequest,
    start: &[f64],
    stalled: f64,
) -> Result<Vec<f64>, Vec<f64>> {
    let mut q = start.to_vec();
    if !request.near.is_empty() {
        let all: Vec<_> = request.held.iter().chain(&request.near).cloned().collect();
        descend(workspace, t, &all, &mut q, 0.0);
    }
    match descend(workspace, t, &request.held, &mut q, stalled) <= OPEN {
        true => Ok(q),
        false => Err(q),
    }
}

fn on_branch(workspace: &mut Workspace, t: f64, q: &[f64], request: &AssemblyRequest) -> bool {
    workspace.move_to(t, q, &vec![0.0; q.len()]);
    let going = MotionView { at: workspace.at(), bodies: None, accelerations: None };
    request.branch.iter().all(|(_, law, sign)| jet(&going, law).d0 * f64::from(*sign) > 0.0)
}

/// Other starts, until one closes on the branch wished for.
fn search(
    workspace: &mut Workspace,
    t: f64,
    request: &AssemblyRequest,
    first: Result<Vec<f64>, DynamicsError>,
) -> Result<Vec<f64>, DynamicsError> {
    for k in 1..=ATTEMPTS {
        let start = scattered(workspace, request, k);
        if let Ok(q) = attempt(workspace, t, request, &start, STALLED) {
            if on_branch(workspace, t, &q, request) {
                return Ok(q);
            }
        }
    }
    first?;
    Err(DynamicsError::BranchNotFound(request.branch.iter().map(|(text, ..)| text.clone()).collect()))
}

/// Start `k` of a sequence that covers angles and lengths evenly (a lattice of square roots of primes).
fn scattered(workspace: &Workspace, request: &AssemblyRequest, k: usize) -> Vec<f64> {
    const PRIMES: [f64; 12] = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0, 23.0, 29.0, 31.0, 37.0];
    let place = |i: usize| {
        let x = k as f64 * PRIMES[i % 12].sqrt() * (1.0 + (i / 12) as f64);
        2.0 * (x - x.floor()) - 1.0
    };
    let units = workspace.units();
    (0..request.start.len())
        .map(|i| {
            let is_angle = workspace.m.coordinate(i).dimension == "rad";
            let reach = if is_angle { std::f64::consts::PI } else { units[i] };
            request.start[i] + if request.free[i] { reach * place(i) } else { 0.0 }
        })
        .collect()
}

/// The other assemblies of a small, fully determined mechanism with loops.
fn other_assemblies(workspace: &mut Workspace, t: f64, request: &AssemblyRequest, q: &[f64]) -> Vec<Vec<f64>> {
    let free = request.free.iter().filter(|f| **f).count();
    if workspace.m.closures.is_empty() || free == 0 || free > 6 || q.len() > 12 {
        return vec![];
    }
    workspace.move_to(t, q, &vec![0.0; q.len()]);
    let (determined, _) = rows(workspace, &request.held);
    if workspace.rank_of(&determined) < q.len() {
        return vec![];
    }
    let open = AssemblyRequest { near: vec![], branch: vec![], ..request.clone() };
    let mut found = vec![q.to_vec()];
    for k in 1..=ATTEMPTS / 4 {
        let start = scattered(workspace, request, k);
        if let Ok(other) = attempt(workspace, t, &open, &start, STALLED) {
            if !found.iter().any(|known| same(workspace, known, &other)) {
                found.push(other);
            }
        }
    }
    found.split_off(1)
}

/// Whether two sets of coordinates are the same place, angles up to whole turns.
fn same(workspace: &Workspace, a: &[f64], b: &[f64]) -> bool {
    let units = workspace.units();
    (0..a.len()).all(|i| {
        let d = a[i] - b[i];
        let turn = std::f64::consts::TAU;
        let d = if workspace.m.coordinate(i).dimension == "rad" { d - turn * (d / turn).round() } else { d };
        d.abs() < SAME_PLACE * units[i]
    })
}

/// Rates that keep the loops closed and what is held, nearest to the starting rates.
fn velocities(
    workspace: &mut Workspace,
    t: f64,
    request: &AssemblyRequest,
    q: &[f64],
) -> Result<Vec<f64>, DynamicsError> {
    let mut u = request.start_rates.clone();
    for _ in 0..3 {
        let before = u.clone();
        workspace.project_velocities_with(t, q, &mut u, &request.held_rates)?;
        if u == before {
            break;
        }
    }
    workspace.move_to(t, q, &u);
    workspace.check_rates(&request.held_rates, &request.start_rates)?;
    Ok(u)
}

fn cannot_assemble(workspace: &mut Workspace, t: f64, request: &AssemblyRequest, q: &[f64]) -> DynamicsError {
    workspace.move_to(t, q, &vec![0.0; q.len()]);
    // Name and, for what is no wish, place in the model; how far open.
    let mut gaps: Vec<(String, Option<String>, f64)> = vec![];
    let (rows, open) = rows(workspace, &request.held);
    for (i, (row, gap)) in rows.iter().zip(&open).enumerate() {
        let closing = workspace.rows().iter().filter(|r| workspace.gap(r).is_some()).count();
        let (name, path) = match i.checked_sub(closing) {
            None => (row.source.name(workspace.m).to_string(), Some(row.source.path(workspace.m))),
            Some(k) => (request.held[k].0.clone(), None),
        };
        match gaps.iter_mut().find(|known| known.0 == name) {
            Some((_, _, g)) => *g = real::hypot(*g, *gap),
            None => gaps.push((name, path, gap.abs())),
        }
    }
    gaps.retain(|(_, _, gap)| *gap > OPEN * workspace.length);
    let open = gaps.iter().map(|(name, _, gap)| (name.clone(), *gap)).collect();
    let widest = gaps.into_iter().filter(|g| g.1.is_some()).max_by(|a, b| a.2.total_cmp(&b.2));
    DynamicsError::CannotAssemble(open, widest.and_then(|(_, path, _)| path))
}
