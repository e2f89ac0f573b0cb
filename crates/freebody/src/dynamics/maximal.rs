//! Three coordinates a body and every joint a constraint: M a − Gᵀλ = f, G a = −γ, by a block-sparse factorisation that
//! is linear in the number of bodies for trees and for ladders of loops.

use super::momentum::Inertia;
use super::rows::{closing_rows_into, joint_rows, joint_tangent, pair};
use super::sparse_tree::SparseTree;
use super::{DynamicsError, Row, Solution, Source, Workspace};
use crate::kinematics::{relative, JointView, StateView};
use crate::mechanism::{Joint, Part};
use crate::plane::{vec2, Twist, Vec2, Wrench};
use crate::scalar::{Jet, Scalar};
use crate::solve::{Factor, Matrix, Orthogonal, Pattern};
use smallvec::{smallvec, SmallVec};
use std::collections::HashMap;

/// Memory of the equations of all bodies, and the sparse factors: one group of rows for each joint or drive that has any.
#[derive(Default)]
pub struct Maximal {
    sparse: Option<(Factor, Vec<Source>)>,
    /// First unknown of each body, ground left out; one entry more than bodies.
    starts: Vec<usize>,
    /// All rows of all joints and drives, those of each joint together, in the order of the groups; those of joints come first.
    rows: Vec<Row>,
    of_joints: usize,
    /// The first row of each joint.
    first: Vec<usize>,
    /// The rows outside the tree, while they are not among all.
    closing: Vec<Row>,
    side: Vec<f64>,
    found: Vec<f64>,
}

/// A body's mass matrix, or what a joint's rows do on it.
type Block = SmallVec<[f64; 9]>;

/// Least part of a column of a joint that the columns before it leave, below which these are one motion.
const ONE_MOTION: f64 = 1e-14;

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

    /// The rows of the present state, and where the unknowns of each body begin.
    fn enter_rows(&self, of: &mut Maximal) {
        let at = self.at();
        of.starts.clear();
        of.starts.push(0);
        for (i, body) in self.m.bodies[1..].iter().enumerate() {
            of.starts.push(of.starts[i] + if body.particle { 2 } else { 3 });
        }
        of.rows.clear();
        of.first.clear();
        of.first.resize(self.m.joints.len(), 0);
        for (j, _) in at.joints().filter(|(_, joint)| !joint.rows.is_empty()) {
            of.first[j] = of.rows.len();
            constraint_rows(at, j, &mut of.rows);
        }
        of.of_joints = of.rows.len();
        closing_rows_into(at, None, &mut of.closing);
        let joints = of.closing.iter().take_while(|row| matches!(row.source, Source::Joint(..))).count();
        of.rows.extend(of.closing.drain(joints..));
    }

    pub(super) fn solve_constraints(&mut self) -> Result<(), DynamicsError> {
        let mut of = std::mem::take(&mut self.maximal);
        self.enter_rows(&mut of);
        self.enter_momentum(&mut of);
        of.side.extend(of.rows.iter().map(|row| -row.bias));
        // The sparse pattern is that of the whole mechanism, which parts and unilateral constraints leave.
        let solved = match self.m.is_hybrid() || of.rows.iter().any(|row| row.force.is_some()) {
            true => self.solve_dense(&mut of),
            false => self.solve_sparse(&mut of),
        };
        if solved.is_ok() {
            self.take_constraints(&mut of);
        }
        self.maximal = of;
        solved
    }

    /// Loads less what velocities ask for, at the joint origins.
    fn enter_momentum(&self, of: &mut Maximal) {
        of.side.clear();
        for (i, unknowns) in (1..).zip(of.starts.windows(2)) {
            let needed = self.loads[i] - super::inertia_wrench(self.at(), i, Twist::zero());
            of.side.extend_from_slice(&needed.parts()[..unknowns[1] - unknowns[0]]);
        }
    }

    /// Mass matrix of a body at its joint origin, row-major, 3 × 3 or 2 × 2.
    fn body_mass(&self, i: usize) -> Block {
        let Inertia { mass, moment, turn } = Inertia::of(self.at(), i, self.arms[i]);
        if self.m.bodies[i].particle {
            return smallvec![mass, 0.0, 0.0, mass];
        }
        let h = moment.perp();
        smallvec![mass, 0.0, h.x, 0.0, mass, h.y, h.x, h.y, turn]
    }

    /// The least motion ν (in the metric of the masses) that changes the present rows by `asked`, in their order; the last of them
    /// may be `targets`, of no joint and no drive.
    pub(super) fn sparse_correction(&mut self, asked: &[f64], targets: &[Row]) -> Result<Vec<f64>, DynamicsError> {
        let mut of = std::mem::take(&mut self.maximal);
        self.enter_rows(&mut of);
        let known: HashMap<Source, f64> = self.rows.iter().map(|row| row.source).zip(asked.iter().copied()).collect();
        of.side.clear();
        of.side.resize(of.starts[self.m.bodies.len() - 1], 0.0);
        of.side.extend(of.rows.iter().map(|row| known.get(&row.source).copied().unwrap_or(0.0)));
        let mut solved = self.solve_sparse(&mut of);
        if solved.is_ok() && !targets.is_empty() {
            let last = &asked[asked.len() - targets.len()..];
            solved = of.meet(targets, last).ok_or(DynamicsError::NoUniqueMotion);
        }
        let (mut moved, mut nu) = (vec![Twist::zero(); self.m.bodies.len()], vec![0.0; self.m.freedom()]);
        of.motions().zip(&mut moved[1..]).for_each(|(found, motion)| *motion = found);
        self.joint_motion(&moved, false, &mut nu);
        self.maximal = of;
        solved.map(|()| nu)
    }

    fn solve_sparse(&self, of: &mut Maximal) -> Result<(), DynamicsError> {
        let Maximal { sparse, rows, side, found, .. } = of;
        let (factor, groups) = sparse.get_or_insert_with(|| {
            let (pattern, groups) = self.pattern();
            (Factor::new(&pattern), groups)
        });
        let bodies = self.m.bodies.len() - 1;
        let masses = (1..=bodies).map(|i| (i - 1, i - 1, self.body_mass(i)));
        let mut rest = &rows[..];
        let levers = groups.iter().enumerate().flat_map(|(g, source)| {
            let size = if let Source::Joint(j, _) = source { self.m.joints[*j].rows.len() } else { 1 };
            let own = rest.split_off(..size).expect("rows for each group");
            own[0].motion.iter().map(move |&(body, _)| (bodies + g, body - 1, self.levers(own, body)))
        });
        factor.refactor(masses.chain(levers));
        found.clear();
        found.resize(side.len(), 0.0);
        factor.solve(side, found).map_err(|stalled| {
            let bodies: Vec<usize> = (1..=bodies).collect();
            DynamicsError::stalled(self.m, &stalled, &bodies, groups)
        })?;
        // The factorisation solves M a + Gᵀ(−λ) = f.
        found[side.len() - rows.len()..].iter_mut().for_each(|l| *l = -*l);
        Ok(())
    }

    /// What rows do on a body, row-major.
    fn levers(&self, rows: &[Row], body: usize) -> Block {
        let width = if self.m.bodies[body].particle { 2 } else { 3 };
        rows.iter().flat_map(|row| row.on(body).parts().into_iter().take(width)).collect()
    }

    /// The same equations as a full matrix, for actuators that act along another gauge than the one they drive.
    fn solve_dense(&self, of: &mut Maximal) -> Result<(), DynamicsError> {
        let Maximal { starts, rows, side, found, .. } = of;
        let (n, all) = (side.len() - rows.len(), side.len());
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
        found.clear();
        found.resize(all, 0.0);
        super::newton_euler::solve_any(&a, side, found).map_err(|_| DynamicsError::NoUniqueMotion)
    }

    /// Reads the unknowns back: accelerations, joint accelerations, loads passed, multipliers.
    fn take_constraints(&mut self, of: &mut Maximal) {
        of.motions().zip(&mut self.solved.bodies[1..]).for_each(|(found, motion)| *motion = found);
        let mut nu_dot = std::mem::take(&mut self.solved.nu_dot);
        self.joint_motion(&self.solved.bodies, true, &mut nu_dot);
        self.solved.nu_dot = nu_dot;
        let multipliers = &of.found[of.side.len() - of.rows.len()..];
        let Solution { joint_wrenches, lambda, .. } = &mut self.solved;
        joint_wrenches.fill(Wrench::zero());
        for (row, &multiplier) in of.rows[..of.of_joints].iter().zip(multipliers) {
            let Source::Joint(j, _) = row.source else { continue };
            if let Some(child) = self.m.joints[j].child {
                joint_wrenches[child] += row.on(child) * multiplier;
            }
        }
        lambda.clear();
        for &j in self.m.closures.iter().filter(|&&j| self.placed.mode.has(Part::Joint(j))) {
            lambda.extend_from_slice(&multipliers[of.first[j]..][..self.m.joints[j].rows.len()]);
        }
        lambda.extend_from_slice(&multipliers[of.of_joints..]);
        of.closing.extend(of.rows.drain(of.of_joints..));
        std::mem::swap(&mut self.rows, &mut of.closing);
    }

    /// Joint accelerations (or, without bias, displacements) from those of the bodies, by least squares over each
    /// joint's columns.
    fn joint_motion(&self, bodies: &[Twist], bias: bool, nu: &mut [f64]) {
        for i in 1..self.m.bodies.len() {
            let b = self.m.bodies[i].tree_joint.expect("every body hangs in the tree");
            let base = bodies[b.parent];
            let carried = Twist { v: base.at(self.k.arm[i]), w: if self.m.bodies[i].particle { 0.0 } else { base.w } };
            let own = bodies[i] - carried - if bias { self.k.bias_acceleration[i] } else { Twist::zero() };
            let rates = fit(&self.k.motion_subspace[i][..b.freedom], own, self.length);
            nu[b.start..b.start + b.freedom].copy_from_slice(&rates[..b.freedom]);
        }
    }
}

impl Maximal {
    /// Those found of the bodies, ground left out.
    fn motions(&self) -> impl Iterator<Item = Twist> + '_ {
        let parts = self.starts.windows(2).map(|unknowns| &self.found[unknowns[0]..unknowns[1]]);
        parts.map(|part| Twist { v: vec2(part[0], part[1]), w: part.get(2).copied().unwrap_or(0.0) })
    }

    /// Adds to a solution of the last factored equations what makes it change `targets` by `asked`, by the responses to their multipliers;
    /// none where these depend on each other or on the loops.
    fn meet(&mut self, targets: &[Row], asked: &[f64]) -> Option<()> {
        let unknowns = self.found.len();
        let load = |row: &Row| {
            let mut load = vec![0.0; unknowns];
            for (body, wrench) in &row.motion {
                let range = self.starts[body - 1]..self.starts[*body];
                load[range].iter_mut().zip(wrench.parts()).for_each(|(sum, part)| *sum += part);
            }
            load
        };
        let along = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let loads: Vec<Vec<f64>> = targets.iter().map(load).collect();
        let mut responses = vec![vec![0.0; unknowns]; loads.len()];
        for (load, response) in loads.iter().zip(&mut responses) {
            self.sparse.as_mut()?.0.solve(load, response).ok()?;
        }
        let split =
            Orthogonal::factor(&Matrix::from_fn(loads.len(), loads.len(), |i, j| along(&loads[i], &responses[j])));
        let left: Vec<f64> = loads.iter().zip(asked).map(|(load, asked)| asked - along(load, &self.found)).collect();
        let mut multipliers = vec![0.0; loads.len()];
        split.add_solution(&left, &mut multipliers);
        for (response, multiplier) in responses.iter().zip(multipliers) {
            self.found.iter_mut().zip(response).for_each(|(x, r)| *x += multiplier * r);
        }
        (split.rank().rank == loads.len()).then_some(())
    }
}

/// The rates along `columns` that give a motion, by least squares in the metric of unit length `length`; 0 where these
/// are one motion. Normal equations are enough: the columns of a joint are far from parallel.
fn fit(columns: &[Twist], motion: Twist, length: f64) -> [f64; 3] {
    let dot = |a: Twist, b: Twist| a.v.dot(b.v) + a.w * b.w * length * length;
    let (n, mut a) = (columns.len(), [[0.0; 4]; 3]);
    for (row, &c) in a.iter_mut().zip(columns) {
        columns.iter().zip(&mut *row).for_each(|(&d, entry)| *entry = dot(c, d));
        row[3] = dot(c, motion);
    }
    for k in 0..n {
        if a[k][k] <= ONE_MOTION * dot(columns[k], columns[k]) {
            return [0.0; 3];
        }
        let pivot = a[k].map(|entry| entry / a[k][k]);
        a[k] = pivot;
        for row in a[..n].iter_mut().enumerate().filter(|(i, _)| *i != k).map(|(_, row)| row) {
            let by = row[k];
            row.iter_mut().zip(pivot).for_each(|(entry, of)| *entry -= by * of);
        }
    }
    a.map(|row| row[3])
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
