//! Three coordinates a body and every joint a constraint: M a − Gᵀλ = f, G a = −γ, by a block-sparse factorisation that
//! is linear in the number of bodies for trees and for ladders of loops.

use super::momentum::Inertia;
use super::rows::{closing_rows, joint_rows, joint_tangent, pair};
use super::sparse_tree::SparseTree;
use super::{DynamicsError, Row, Source, Workspace};
use crate::kinematics::{relative, JointView, StateView};
use crate::mechanism::Joint;
use crate::plane::{vec2, Twist, Vec2, Wrench};
use crate::scalar::{Jet, Scalar};
use crate::solve::{Factor, Lu, Matrix, Orthogonal, Pattern};
use std::collections::HashMap;

/// Memory of the sparse solution: one group of rows for each joint or drive that has any.
pub struct Sparse {
    factor: Factor,
    groups: Vec<Source>,
}

/// Largest system with actuators of their own direction, which the symmetric factorisation cannot hold.
const DENSE_LIMIT: usize = 600;
/// Bodies and closing rows above which the dense solution is not even considered.
const DENSE_CONSIDERED: usize = 40;

impl Workspace<'_> {
    /// Whether a sparse solution costs less arithmetic than the dense one; makes that of the tree where it is the least.
    pub(super) fn prefers_sparse(&mut self) -> bool {
        let n = self.m.freedom() as f64;
        let own_way = self.m.drives.iter().any(|d| d.by.is_some() || d.feedback);
        if !self.is_closed() || self.m.is_hybrid() || own_way || n < DENSE_CONSIDERED as f64 {
            return false;
        }
        let rows = self.m.closures.iter().map(|&j| self.m.joints[j].rows.len()).sum::<usize>() + self.m.drives.len();
        let dense = 4.0 * n * n * rows as f64 + 2.0 * n * n * n;
        let sparse = self.pattern().0.flops();
        self.sparse_tree = SparseTree::of(self.m).filter(|tree| tree.flops < sparse.min(dense));
        sparse < dense || self.sparse_tree.is_some()
    }

    /// The unknowns of each body, and the groups of rows with the bodies that they touch.
    fn pattern(&self) -> (Pattern, Vec<Source>) {
        let m = self.m;
        let size = |i: usize| if m.bodies[i].particle { 2 } else { 3 };
        let bodies: Vec<usize> = (1..m.bodies.len()).map(size).collect();
        let (mut groups, mut sizes, mut edges) = (vec![], vec![], vec![]);
        for (j, joint) in m.joints.iter().enumerate() {
            if !joint.rows.is_empty() {
                for body in m.ends(joint).into_iter().filter(|&b| b > 0) {
                    edges.push((body - 1, bodies.len() + groups.len()));
                }
                groups.push(Source::Joint(j, 0));
                sizes.push(joint.rows.len());
            }
        }
        for (d, drive) in m.drives.iter().enumerate() {
            for body in m.bodies_of(&(drive.of.clone() - drive.law.clone())) {
                edges.push((body - 1, bodies.len() + groups.len()));
            }
            groups.push(Source::Drive(d));
            sizes.push(1);
        }
        (Pattern::new(&bodies, &sizes, &edges), groups)
    }

    /// All rows of all joints and drives, those of each joint together, in the order of the groups.
    fn all_rows(&self) -> Vec<Row> {
        let at = self.at();
        let mut rows = vec![];
        for (j, joint) in at.joints() {
            if !joint.rows.is_empty() {
                constraint_rows(at, j, &mut rows);
            }
        }
        let closing = closing_rows(at, None);
        rows.extend(closing.into_iter().filter(|row| !matches!(row.source, Source::Joint(..))));
        rows
    }

    pub(super) fn solve_constraints(&mut self) -> Result<(), DynamicsError> {
        let rows = self.all_rows();
        let starts = self.body_starts();
        let unknowns = starts[self.m.bodies.len() - 1] + rows.len();
        let mut rhs = self.momentum_side(&starts);
        rhs.extend(rows.iter().map(|row| -row.bias));
        let mut x = vec![0.0; unknowns];
        // The sparse pattern is that of the whole mechanism, which parts and unilateral constraints leave.
        if self.m.is_hybrid() || rows.iter().any(|row| row.force.is_some()) {
            self.solve_dense(&rows, &starts, &rhs, &mut x)?;
        } else {
            self.solve_sparse(&rows, &rhs, &mut x)?;
        }
        self.take_constraints(&rows, &starts, &x);
        Ok(())
    }

    /// First unknown of each body, ground left out; one entry more than bodies.
    fn body_starts(&self) -> Vec<usize> {
        let mut starts = vec![0];
        for body in &self.m.bodies[1..] {
            starts.push(starts[starts.len() - 1] + if body.particle { 2 } else { 3 });
        }
        starts
    }

    /// Loads less what velocities ask for, at the joint origins.
    fn momentum_side(&self, starts: &[usize]) -> Vec<f64> {
        let mut side = vec![0.0; starts[starts.len() - 1]];
        for i in 1..self.m.bodies.len() {
            let needed = self.loads[i] - super::inertia_wrench(self.at(), i, Twist::zero());
            let range = starts[i - 1]..starts[i];
            let parts = needed.parts();
            side[range.clone()].copy_from_slice(&parts[..range.len()]);
        }
        side
    }

    /// Mass matrix of a body at its joint origin, row-major, 3 × 3 or 2 × 2.
    fn body_mass(&self, i: usize) -> Vec<f64> {
        let Inertia { mass, moment, turn } = Inertia::of(self.at(), i, self.arms[i]);
        if self.m.bodies[i].particle {
            return vec![mass, 0.0, 0.0, mass];
        }
        let h = moment.perp();
        vec![mass, 0.0, h.x, 0.0, mass, h.y, h.x, h.y, turn]
    }

    /// The least motion ν (in the metric of the masses) that changes the present rows by `asked`, in their order; the last of them
    /// may be `targets`, of no joint and no drive.
    pub(super) fn sparse_correction(&mut self, asked: &[f64], targets: &[Row]) -> Result<Vec<f64>, DynamicsError> {
        let rows = self.all_rows();
        let starts = self.body_starts();
        let n = starts[starts.len() - 1];
        let known: HashMap<Source, f64> = self.rows.iter().map(|row| row.source).zip(asked.iter().copied()).collect();
        let mut rhs = vec![0.0; n];
        rhs.extend(rows.iter().map(|row| known.get(&row.source).copied().unwrap_or(0.0)));
        let mut x = vec![0.0; rhs.len()];
        self.solve_sparse(&rows, &rhs, &mut x)?;
        if !targets.is_empty() {
            let last = &asked[asked.len() - targets.len()..];
            self.meet(targets, last, &starts, &mut x).ok_or(DynamicsError::NoUniqueMotion)?;
        }
        let mut moved = vec![Twist::zero(); self.m.bodies.len()];
        for i in 1..self.m.bodies.len() {
            let part = &x[starts[i - 1]..starts[i]];
            moved[i] = Twist { v: vec2(part[0], part[1]), w: part.get(2).copied().unwrap_or(0.0) };
        }
        Ok(self.joint_motion(&moved, false))
    }

    /// Adds to a solution of the last factored equations what makes it change `targets` by `asked`, by the responses to their multipliers;
    /// none where these depend on each other or on the loops.
    fn meet(&self, targets: &[Row], asked: &[f64], starts: &[usize], x: &mut [f64]) -> Option<()> {
        let unknowns = x.len();
        let load = |row: &Row| {
            let mut load = vec![0.0; unknowns];
            for (body, wrench) in &row.motion {
                let range = starts[body - 1]..starts[*body];
                load[range].iter_mut().zip(wrench.parts()).for_each(|(sum, part)| *sum += part);
            }
            load
        };
        let along = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let loads: Vec<Vec<f64>> = targets.iter().map(load).collect();
        let mut responses = vec![vec![0.0; unknowns]; loads.len()];
        for (load, response) in loads.iter().zip(&mut responses) {
            self.sparse.as_ref()?.factor.solve(load, response).ok()?;
        }
        let split =
            Orthogonal::factor(&Matrix::from_fn(loads.len(), loads.len(), |i, j| along(&loads[i], &responses[j])));
        let left: Vec<f64> = loads.iter().zip(asked).map(|(load, asked)| asked - along(load, x)).collect();
        let mut multipliers = vec![0.0; loads.len()];
        split.add_solution(&left, &mut multipliers);
        for (response, multiplier) in responses.iter().zip(multipliers) {
            x.iter_mut().zip(response).for_each(|(x, r)| *x += multiplier * r);
        }
        (split.rank().rank == loads.len()).then_some(())
    }

    fn solve_sparse(&mut self, rows: &[Row], rhs: &[f64], x: &mut [f64]) -> Result<(), DynamicsError> {
        if self.sparse.is_none() {
            let (pattern, groups) = self.pattern();
            self.sparse = Some(Sparse { factor: Factor::new(&pattern), groups });
        }
        let bodies = self.m.bodies.len() - 1;
        let mut blocks: Vec<(usize, usize, Vec<f64>)> =
            (1..=bodies).map(|i| (i - 1, i - 1, self.body_mass(i))).collect();
        let mut row = 0;
        let sparse = self.sparse.as_ref().expect("made above");
        for (g, source) in sparse.groups.iter().enumerate() {
            let size = match source {
                Source::Joint(j, _) => self.m.joints[*j].rows.len(),
                _ => 1,
            };
            for &(body, _) in &rows[row].motion {
                let width = if self.m.bodies[body].particle { 2 } else { 3 };
                let mut block = Vec::with_capacity(size * width);
                for r in &rows[row..row + size] {
                    let load = r.motion.iter().find(|(b, _)| *b == body).map_or(Wrench::zero(), |(_, w)| *w);
                    block.extend_from_slice(&load.parts()[..width]);
                }
                blocks.push((bodies + g, body - 1, block));
            }
            row += size;
        }
        let sparse = self.sparse.as_mut().expect("made above");
        sparse.factor.refactor(blocks.iter().map(|(i, j, b)| (*i, *j, b.as_slice())));
        sparse.factor.solve(rhs, x).map_err(|stalled| {
            let bodies: Vec<usize> = (1..=bodies).collect();
            DynamicsError::stalled(self.m, &stalled, &bodies, &sparse.groups)
        })?;
        // The factorisation solves M a + Gᵀ(−λ) = f.
        x[rhs.len() - rows.len()..].iter_mut().for_each(|l| *l = -*l);
        Ok(())
    }

    /// The same equations as a full matrix, for actuators that act along another gauge than the one they drive.
    fn solve_dense(&mut self, rows: &[Row], starts: &[usize], rhs: &[f64], x: &mut [f64]) -> Result<(), DynamicsError> {
        let (n, all) = (rhs.len() - rows.len(), rhs.len());
        if all > DENSE_LIMIT {
            return Err(DynamicsError::TooManyForDense);
        }
        let mut a = Matrix::zeros(all, all);
        for i in 1..self.m.bodies.len() {
            let (start, size) = (starts[i - 1], starts[i] - starts[i - 1]);
            for (k, value) in self.body_mass(i).into_iter().enumerate() {
                a[(start + k / size, start + k % size)] = value;
            }
        }
        for (r, row) in rows.iter().enumerate() {
            let enter = |a: &mut Matrix, wrenches: &super::BodyWrenches<f64>, motion: bool| {
                for (body, load) in wrenches {
                    let (start, size) = (starts[body - 1], starts[*body] - starts[body - 1]);
                    for (k, value) in load.parts().into_iter().take(size).enumerate() {
                        if motion {
                            a[(n + r, start + k)] += value;
                        } else {
                            a[(start + k, n + r)] -= value;
                        }
                    }
                }
            };
            enter(&mut a, &row.motion, true);
            enter(&mut a, row.loads(), false);
        }
        super::newton_euler::solve_any(&a, rhs, x).map_err(|_| DynamicsError::NoUniqueMotion)
    }

    /// Reads the unknowns back: accelerations, joint accelerations, loads passed, multipliers.
    fn take_constraints(&mut self, rows: &[Row], starts: &[usize], x: &[f64]) {
        let n = starts[starts.len() - 1];
        for i in 1..self.m.bodies.len() {
            let part = &x[starts[i - 1]..starts[i]];
            self.solved.bodies[i] = Twist { v: vec2(part[0], part[1]), w: part.get(2).copied().unwrap_or(0.0) };
        }
        self.solved.nu_dot = self.joint_motion(&self.solved.bodies, true);
        self.solved.joint_wrenches.fill(Wrench::zero());
        self.solved.lambda.clear();
        let mut closing = vec![];
        for (row, &lambda) in rows.iter().zip(&x[n..]) {
            let child = match row.source {
                Source::Joint(j, _) => self.m.joints[j].child,
                _ => None,
            };
            match child {
                Some(child) => {
                    let load = row.motion.iter().find(|(b, _)| *b == child).map_or(Wrench::zero(), |(_, w)| *w);
                    self.solved.joint_wrenches[child] += load * lambda;
                }
                None => {
                    closing.push(row.clone());
                    self.solved.lambda.push(lambda);
                }
            }
        }
        self.rows = closing;
        self.order_rows();
    }

    /// Joint accelerations (or, without bias, displacements) from those of the bodies, by least squares over each
    /// joint's columns.
    fn joint_motion(&self, bodies: &[Twist], bias: bool) -> Vec<f64> {
        let mut nu = vec![0.0; self.m.freedom()];
        for i in 1..self.m.bodies.len() {
            let b = self.m.bodies[i].tree_joint.expect("every body hangs in the tree");
            let base = bodies[b.parent];
            let carried = Twist { v: base.at(self.k.arm[i]), w: if self.m.bodies[i].particle { 0.0 } else { base.w } };
            let own = bodies[i] - carried - if bias { self.k.bias_acceleration[i] } else { Twist::zero() };
            let rates = fit(&self.k.motion_subspace[i][..b.freedom], own, self.length);
            nu[b.start..b.start + b.freedom].copy_from_slice(&rates[..b.freedom]);
        }
        nu
    }

    /// Closing rows in the order of the closures, then of the drives, as the other routes have them.
    fn order_rows(&mut self) {
        let closures: HashMap<usize, usize> =
            self.m.closures.iter().enumerate().map(|(i, &joint)| (joint, i)).collect();
        let place = |row: &Row| match row.source {
            Source::Joint(j, r) => (0, closures.get(&j).copied().unwrap_or(0), r),
            Source::Drive(d) => (1, d, 0),
            Source::Gap(l) => (2, l, 0),
            Source::Friction(l) => (2, l, 1),
            Source::JointFriction(r) => (3, r, 0),
        };
        let mut order: Vec<usize> = (0..self.rows.len()).collect();
        order.sort_by_cached_key(|&i| place(&self.rows[i]));
        self.rows = order.iter().map(|&i| self.rows[i].clone()).collect();
        self.solved.lambda = order.iter().map(|&i| self.solved.lambda[i]).collect();
    }
}

/// The rates along `columns` that give a motion, by least squares in the metric of unit length `length`.
/// Normal equations are enough: the columns of a joint are far from parallel.
fn fit(columns: &[Twist], motion: Twist, length: f64) -> [f64; 3] {
    let dot = |a: Twist, b: Twist| a.v.dot(b.v) + a.w * b.w * length * length;
    let mut a = Matrix::zeros(columns.len(), columns.len());
    let mut b = vec![0.0; columns.len()];
    for (i, &c) in columns.iter().enumerate() {
        b[i] = dot(c, motion);
        for (j, &d) in columns.iter().enumerate() {
            a[(i, j)] = dot(c, d);
        }
    }
    let mut rates = [0.0; 3];
    if let Ok(lu) = Lu::factor(&a) {
        rates[..columns.len()].copy_from_slice(&lu.solve(&b));
    }
    rates
}

/// The rows of a joint, of the tree or not, expressed as a constraint; where its reaction acts, fixed axes.
pub fn constraint_rows<S: Scalar>(at: StateView<'_, S>, index: usize, out: &mut Vec<Row<S>>) -> Vec2<S> {
    let joint = &at.m.joints[index];
    if joint.curve.is_some() && !joint.rows.is_empty() {
        let (row, place) = curve_row(at, index);
        out.push(row);
        return place;
    }
    joint_rows(at, index, None, out);
    joint_place(at, index)
}

/// Where the reaction of a joint acts, fixed axes.
pub fn joint_place<S: Scalar>(at: StateView<'_, S>, index: usize) -> Vec2<S> {
    let joint = &at.m.joints[index];
    let (axes, place) = relative(joint, at.m, &at);
    axes.place(JointView::new(at.m, at.n, joint, |x| x).contact(&place))
}

/// The row of a joint along a curve, which has no residual: a force across the curve, to its left. The second body's
/// marker has, against that force, the acceleration that the coordinates give it as they go on at their rates. With it
/// the place where the force acts.
fn curve_row<S: Scalar>(at: StateView<'_, S>, index: usize) -> (Row<S>, Vec2<S>) {
    let joint = &at.m.joints[index];
    let child = joint.child.expect("a joint along a curve is in the tree");
    let start = at.m.bodies[child].tree_joint.expect("a body of the tree").start;
    let view = JointView::new(at.m, at.n, joint, Jet::constant);
    let (axes, _) = relative(joint, at.m, &at);
    let fixed = |x: S, y: S| axes.turn.apply(vec2(x, y));
    let across = axes.turn.apply(joint_tangent(at, index)).perp();
    // The marker, as the coordinates go on; a turn about it moves nothing.
    let mut q = [Jet::constant(S::zero()); 2];
    for (k, c) in joint.coordinates.iter().enumerate().filter(|(_, c)| c.dimension != "rad") {
        q[c.card] = Jet { d1: at.k.nu[start + k], ..own_place(at, joint, start, k) };
    }
    let going = view.pose(&q[..joint.size], false);
    let place = axes.at + fixed(going.x.d0, going.y.d0);
    let [first, second] = at.m.ends(joint).map(|body| {
        let (arm, w) = (place - at.k.pose[body].at, at.k.twist[body].w);
        -arm * (w * w)
    });
    let w = at.k.twist[at.m.ends(joint)[0]].w;
    let along = fixed(going.x.d2, going.y.d2) + fixed(going.x.d1, going.y.d1).perp() * w.scale(2.0);
    let row = Row {
        source: Source::Joint(index, 0),
        value: None,
        rate: None,
        bias: across.dot(second - first - along),
        motion: pair(at, joint, place, Wrench { f: across, m: S::zero() }),
        force: None,
    };
    (row, place)
}

/// Coordinate `k` of a joint of the tree by the joint's own measure, at rest.
fn own_place<S: Scalar>(at: StateView<'_, S>, joint: &Joint, start: usize, k: usize) -> Jet<S> {
    let c = &joint.coordinates[k];
    Jet::constant(at.n.values[c.zero] + at.q[start + k].scale(c.sense))
}
