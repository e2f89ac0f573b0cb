//! As few equations as degrees of freedom: loops and drives eliminated by the null space of their rows.

use super::momentum::{residual_into, Inertia};
use super::rows::closing_rows_into;
use super::{
    generalized_force, size_of_power, visit_ancestors, BodyWrenches, DynamicsError, Row, Source, Workspace, CANCELLED,
};
use crate::kinematics::StateView;
use crate::mode::ContactMode;
use crate::plane::{Twist, Vec2, Wrench};
use crate::scalar::Scalar;
use crate::solve::{IslandMemory, Islands, Matrix, Orthogonal, SaddleError, Solution};

/// Memory of the dense solution.
#[derive(Clone, Debug, Default)]
pub struct Dense {
    pub(super) mass: Matrix,
    pub(super) g: Matrix,
    b: Matrix,
    pub(super) saddle: Islands,
    /// Units of the coordinates, and what makes the rows of order one.
    columns: Vec<f64>,
    scales: Vec<f64>,
    /// The size of what is summed in a row, before it cancels.
    sizes: Matrix,
    /// Inertia of each body with all that hangs on it.
    whole: Vec<Inertia>,
}

/// Memory of the right-hand sides and of what is found.
#[derive(Clone, Debug, Default)]
pub struct Memory {
    force: Vec<f64>,
    asked: Vec<f64>,
    /// What the solution leaves of both.
    left: Vec<f64>,
    gap: Vec<f64>,
    found: Solution,
    islands: IslandMemory,
}

/// Along what the multipliers act.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Force {
    /// The gradient of their rows.
    Gradient,
    /// Each actuator its own gauge.
    ActuatorDirection,
}

/// Share of a row in a dependence, or of a body in a motion, whose size is 1, below which it is round-off.
const PART: f64 = 1e-6;
/// A body spins about its joint where its turn moves points at the characteristic length so many times as far as the joint.
const SPINS: f64 = 1e3;
/// Largest contradiction of the rows, over the largest of their terms, that is put down to round-off.
pub(super) const CONTRADICTION: f64 = 1e-7;

impl Workspace<'_> {
    pub(super) fn solve_minimal(&mut self) -> Result<(), DynamicsError> {
        let mut memory = std::mem::take(&mut self.memory);
        let done = self.solve_minimal_with(&mut memory);
        self.memory = memory;
        done
    }

    fn solve_minimal_with(&mut self, memory: &mut Memory) -> Result<(), DynamicsError> {
        let Memory { force, asked, left, gap, found, islands } = memory;
        self.set_up(force)?;
        asked.clear();
        asked.extend(self.rows.iter().map(|row| -row.bias));
        self.dense.saddle.solve_into(force, asked, found, islands);
        self.check_consistent(found.inconsistency, asked, &found.a)?;
        self.solved.nu_dot.copy_from_slice(&found.a);
        self.solved.lambda.clone_from(&found.lambda);
        self.recover_body_motion();
        self.unbalanced_by(asked, left, gap);
        self.dense.saddle.solve_into(left, gap, found, islands);
        self.solved.nu_dot.iter_mut().zip(&found.a).for_each(|(x, d)| *x += d);
        self.solved.lambda.iter_mut().zip(&found.lambda).for_each(|(x, d)| *x += d);
        self.recover_body_motion();
        Ok(())
    }

    /// Bodies and loads of the joint accelerations and multipliers found.
    fn recover_body_motion(&mut self) {
        self.k.propagate_motion(self.m, &self.solved.nu_dot, true, &mut self.solved.bodies);
        self.propagate_joint_wrenches();
    }

    /// For one step of iterative refinement, what the balance of the bodies leaves along the freedom of each joint, which
    /// can pass nothing there, and what is open of the rows: asked of the factored equations again, small masses behind large
    /// ones keep their digits.
    fn unbalanced_by(&self, asked: &[f64], left: &mut Vec<f64>, gap: &mut Vec<f64>) {
        left.clear();
        left.resize(self.m.freedom(), 0.0);
        for (i, body) in self.m.bodies.iter().enumerate() {
            let Some(b) = body.tree_joint else { continue };
            for k in 0..b.freedom {
                left[b.start + k] = -self.solved.joint_wrenches[i].power(self.k.motion_subspace[i][k]);
            }
        }
        self.dense.g.mul_vec_into(&self.solved.nu_dot, gap);
        gap.iter_mut().zip(asked).for_each(|(gap, asked)| *gap = asked - *gap);
    }

    /// Sets up and factors the equations of the present state; finds the generalized forces.
    fn set_up(&mut self, force: &mut Vec<f64>) -> Result<(), DynamicsError> {
        force.clear();
        force.resize(self.m.freedom(), 0.0);
        self.k.propagate_motion(self.m, force, true, &mut self.solved.bodies);
        let mut rows = std::mem::take(&mut self.rows);
        closing_rows_into(self.at(), Some(&self.solved.bodies), &mut rows);
        self.rows = rows;
        let at = self.placed.view(self.m, &self.n, &self.k);
        let unbalanced = &mut self.solved.joint_wrenches;
        residual_into(at, &self.loads, &self.solved.bodies, &[], &[], unbalanced);
        generalized_force(at, unbalanced.iter().copied().enumerate().skip(1), force);
        self.factor(Force::ActuatorDirection)
    }

    /// Factors mass matrix and rows of the present state.
    pub(super) fn factor(&mut self, force: Force) -> Result<(), DynamicsError> {
        let at = self.placed.view(self.m, &self.n, &self.k);
        let d = &mut self.dense;
        mass_matrix(at, &self.arms, &mut d.whole, &mut d.mass);
        rows_in_coordinates(at, &self.rows, self.length, [&mut d.g, &mut d.b, &mut d.sizes]);
        d.columns.clear();
        d.columns.extend(column_scales(at, self.length));
        d.scales.clear();
        d.scales.extend(row_scales(&d.g, &d.columns));
        let own = force == Force::ActuatorDirection && self.rows.iter().any(|row| row.force.is_some());
        let b = own.then_some(&d.b);
        d.saddle.refactor(&d.mass, &d.g, b, &d.scales, &d.columns).map_err(|error| self.explain(error))
    }

    /// Says in the model's words why there is no unique motion.
    fn explain(&self, error: SaddleError) -> DynamicsError {
        match error {
            SaddleError::ZeroInertia { direction } => {
                let (what, first) = self.describe_motion(&direction);
                DynamicsError::ZeroInertia(what, first)
            }
            SaddleError::InsufficientActuation { direction } => {
                let (what, first) = self.describe_motion(&direction);
                DynamicsError::OutOfReach(what, first)
            }
            SaddleError::RankMismatch { motion, force } => match &self.dependent()[..] {
                [] => DynamicsError::TooFewActuators { asked: motion, ways: force },
                dependent => self.indeterminate_contact(dependent),
            },
        }
    }

    /// Unilateral constraints that slide and of which one is redundant: their gaps depend on each other.
    fn dependent(&self) -> Vec<usize> {
        let dependence = Orthogonal::factor(&self.dense.g);
        let (y, rank) = (dependence.y(), dependence.rank().rank);
        let is_part = |i: usize| (rank..y.rows()).any(|k| y[(k, i)].abs() > PART);
        let slides = |l: &usize| matches!(self.mode().contacts[*l].mode, ContactMode::Slip(_));
        let constraint = |row: &Row| if let Source::Gap(l) = row.source { Some(l) } else { None };
        let parts = self.rows.iter().enumerate().filter(|(i, _)| is_part(*i));
        parts.filter_map(|(_, row)| constraint(row)).filter(slides).collect()
    }

    /// Unilateral constraints that slide press against each other: the balance equations leave open how hard.
    fn indeterminate_contact(&self, dependent: &[usize]) -> DynamicsError {
        let group = &self.m.groups[self.m.unilateral[dependent[0]].group];
        DynamicsError::UndecidedPress(self.names_of(dependent), group.path())
    }

    /// Which bodies take part in a motion of the tree, in words, and where the first of them stands in the model.
    fn describe_motion(&self, direction: &[f64]) -> (String, Option<String>) {
        let mut bodies = vec![Twist::zero(); self.m.bodies.len()];
        self.k.propagate_motion(self.m, direction, false, &mut bodies);
        let size = |t: &Twist| t.v.norm() / self.length + t.w.abs();
        let most = bodies.iter().map(size).fold(0.0, f64::max);
        let moving: Vec<usize> = (1..bodies.len()).filter(|&i| size(&bodies[i]) > PART * most).collect();
        let words: Vec<String> = moving
            .iter()
            .map(|&i| {
                let turning = bodies[i].w.abs() * self.length > SPINS * bodies[i].v.norm();
                let joint = self.m.bodies[i].tree_joint.map_or("", |b| self.m.joints[b.joint].name.as_str());
                if turning {
                    format!("`{}` can spin about `{joint}`", self.m.bodies[i].name)
                } else {
                    format!("`{}` can move", self.m.bodies[i].name)
                }
            })
            .collect();
        (words.join(" and "), moving.first().map(|&i| format!("bodies.{}", self.m.bodies[i].name)))
    }

    fn check_consistent(&self, inconsistency: f64, asked: &[f64], found: &[f64]) -> Result<(), DynamicsError> {
        let (columns, scales) = (&self.dense.columns, &self.dense.scales);
        // What is asked is a difference of squares of rates, and is met by what loads and constraints accelerate.
        let rate = self.placed.u.iter().zip(columns).map(|(u, c)| (u / c).abs()).fold(0.0, f64::max);
        let over = |load: f64, inertia: f64| if inertia > 0.0 { load / inertia } else { 0.0 };
        let fall = |(body, load): (usize, &Wrench)| {
            let inertia = Inertia::of(self.at(), body, self.arms[body]);
            over(load.f.norm(), inertia.mass * self.length).max(over(load.m.abs(), inertia.turn))
        };
        let least = self.loads.iter().enumerate().map(fall).fold(rate * rate, f64::max);
        let meets = |i: usize| self.dense.g.row(i).iter().zip(found).map(|(g, a)| (g * a).abs());
        let most = |i: usize| scales[i] * meets(i).fold(asked[i].abs(), f64::max);
        let most = (0..asked.len()).map(most).fold(least, f64::max);
        if inconsistency <= CONTRADICTION * most {
            return Ok(());
        }
        let mut names: Vec<String> = self.rows.iter().map(|row| row.source.name(self.m).to_string()).collect();
        names.dedup();
        Err(DynamicsError::Contradiction(names, self.rows.last().map(|row| row.source.path(self.m))))
    }

    /// The load that each body's joint passes, from the balance of all that hangs on it.
    pub(super) fn propagate_joint_wrenches(&mut self) {
        let (at, s) = (self.placed.view(self.m, &self.n, &self.k), &mut self.solved);
        residual_into(at, &self.loads, &s.bodies, &self.rows, &s.lambda, &mut s.joint_wrenches);
        pass_to_ground(at, &mut s.joint_wrenches);
    }
}

/// The load that each body's joint in the tree passes, for what all else leaves of the balance of each body.
pub(super) fn joint_wrenches<S: Scalar>(at: StateView<'_, S>, unbalanced: &[Wrench<S>]) -> Vec<Wrench<S>> {
    let mut loads = unbalanced.to_vec();
    pass_to_ground(at, &mut loads);
    loads
}

/// The same in place of what is unbalanced.
fn pass_to_ground<S: Scalar>(at: StateView<'_, S>, loads: &mut [Wrench<S>]) {
    loads.iter_mut().for_each(|load| *load = -*load);
    for i in (1..loads.len()).rev() {
        let b = at.m.bodies[i].tree_joint.expect("every body hangs in the tree");
        if at.m.bodies[i].particle {
            loads[i].m = S::zero();
        }
        let passed = loads[i].seen_from(at.k.arm[i]);
        loads[b.parent] += passed;
    }
    loads[0] = Wrench::zero();
}

/// Unit of each coordinate: a radian for angles, the characteristic length for lengths, and for the parameter of a curve
/// what shifts or turns a body by as much.
pub(super) fn column_scales(at: StateView<'_>, length: f64) -> impl Iterator<Item = f64> + '_ {
    let of_curve = move |joint: usize, k: usize| {
        let column = at.k.motion_subspace[at.m.joints[joint].child?][k];
        let size = column.v.norm().max(length * column.w.abs());
        (size > 0.0).then(|| length / size)
    };
    let unit = move |&(joint, k): &(usize, usize)| match at.m.joints[joint].coordinates[k].dimension {
        "m" => length,
        "rad" => 1.0,
        _ => of_curve(joint, k).unwrap_or(1.0),
    };
    at.m.coordinates.iter().map(unit)
}

/// Makes every row of order one in scaled coordinates.
pub(super) fn row_scales<'a>(g: &'a Matrix, columns: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
    (0..g.rows()).map(move |i| {
        let norm = g.row(i).iter().zip(columns).map(|(x, c)| (x * c) * (x * c)).sum::<f64>().sqrt();
        if norm > 0.0 {
            1.0 / norm
        } else {
            1.0
        }
    })
}

/// Rows by joint coordinates, n columns, and the loads of their multipliers; with memory for their sizes.
pub(super) fn rows_in_coordinates(at: StateView<'_>, rows: &[Row], length: f64, [g, b, sizes]: [&mut Matrix; 3]) {
    let n = at.m.freedom();
    g.reset(rows.len(), n);
    b.reset(rows.len(), n);
    for (i, row) in rows.iter().enumerate() {
        let mut clean = |loads: &BodyWrenches<f64>, out: &mut [f64]| {
            sizes.reset(1, n);
            generalized_force_clean(at, loads, length, out, sizes.row_mut(0));
        };
        clean(&row.motion, g.row_mut(i));
        match &row.force {
            Some(force) => clean(force, b.row_mut(i)),
            None => b.row_mut(i).copy_from_slice(g.row(i)),
        }
    }
}

/// As [`generalized_force`], but 0 where loads cancel, or pass through a joint origin, but for round-off: such a row asks for
/// nothing of that coordinate, and must not be scaled up to a constraint. `size`, 0 before, is what does not cancel.
fn generalized_force_clean(
    at: StateView<'_>,
    wrenches: &BodyWrenches<f64>,
    length: f64,
    out: &mut [f64],
    size: &mut [f64],
) {
    visit_ancestors(at, wrenches.iter().copied(), |i, load, column| {
        out[i] += load.power(column);
        size[i] += size_of_power(load, column, length);
    });
    for (sum, size) in out.iter_mut().zip(size) {
        if sum.abs() <= CANCELLED * *size {
            *sum = 0.0;
        }
    }
}

/// The mass matrix of the tree by joint coordinates, n × n, from the inertia of each body with all that hangs on it
/// (composite rigid bodies; Featherstone ch. 6).
pub(super) fn mass_matrix(at: StateView<'_>, arms: &[Vec2], whole: &mut Vec<Inertia>, out: &mut Matrix) {
    let bodies = at.m.bodies.len();
    out.reset(at.m.freedom(), at.m.freedom());
    whole.clear();
    whole.resize(bodies, Inertia::default());
    for i in (1..bodies).rev() {
        let (body, own) = (Inertia::of(at, i, arms[i]), &mut whole[i]);
        own.mass += body.mass;
        own.moment += body.moment;
        own.turn += body.turn;
        let own = *own;
        let tree_joint = at.m.bodies[i].tree_joint.expect("every body hangs in the tree");
        let particle = at.m.bodies[i].particle;
        for k in 0..tree_joint.freedom {
            let mut load = own.momentum(at.k.motion_subspace[i][k]);
            if particle {
                load.m = 0.0;
            }
            couple(at, i, tree_joint.start + k, load, out);
        }
        let r = at.k.arm[i];
        let up = &mut whole[tree_joint.parent];
        up.mass += own.mass;
        if particle {
            // A particle resists the turning of its parent by its place only.
            up.moment += r * own.mass;
            up.turn += own.mass * r.dot(r);
        } else {
            up.moment += own.moment + r * own.mass;
            up.turn += own.turn + 2.0 * r.dot(own.moment) + own.mass * r.dot(r);
        }
    }
}

/// Enters what the load of coordinate `j` does on every coordinate from body `i` down to ground.
fn couple(at: StateView<'_>, i: usize, j: usize, load: Wrench, out: &mut Matrix) {
    let (mut body, mut load) = (i, load);
    while let Some(b) = at.m.bodies[body].tree_joint {
        for k in 0..b.freedom {
            let value = load.power(at.k.motion_subspace[body][k]);
            out[(b.start + k, j)] = value;
            out[(j, b.start + k)] = value;
        }
        if at.m.bodies[body].particle {
            load.m = 0.0;
        }
        load = load.seen_from(at.k.arm[body]);
        body = b.parent;
    }
}
