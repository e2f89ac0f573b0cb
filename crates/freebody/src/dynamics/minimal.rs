//! As few equations as degrees of freedom: loops and drives eliminated by the null space of their rows.

use super::momentum::{residual_into, Inertia};
use super::rows::closing_rows_into;
use super::tree_matrices::{column_scales, mass_matrix, row_scales, rows_in_coordinates};
use super::{DynamicsError, Row, Source, Workspace};
use crate::kinematics::StateView;
use crate::mode::ContactMode;
use crate::plane::{Twist, Wrench};
use crate::scalar::Scalar;
use crate::solve::{
    Condensed, Equations, IslandMemory, IslandRank, Islands, Matrix, Orthogonal, Quasidefinite, SaddleError, Solution,
};

/// Memory of the dense solution.
#[derive(Clone, Debug, Default)]
pub struct Dense {
    pub(super) mass: Matrix,
    pub(super) g: Matrix,
    b: Matrix,
    pub(super) saddle: Islands,
    /// The same equations, where only their solution was asked for, every motion has inertia and it is clear which rows depend on others.
    condensed: Condensed,
    /// And where they are few.
    quasidefinite: Quasidefinite,
    form: Form,
    /// Units of the coordinates, and what makes the rows of order one.
    pub(super) columns: Vec<f64>,
    scales: Vec<f64>,
    /// The size of what is summed in a row, before it cancels.
    pub(super) sizes: Vec<f64>,
    /// Inertia of each body with all that hangs on it.
    pub(super) carried: Vec<Inertia>,
    factored: Factored,
    /// Memory of the rank of the rows, and of the rows in units of the characteristic length.
    pub(super) independence: IslandRank,
    pub(super) rows_in_units: Matrix,
}

/// In which form the equations were factored last.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Form {
    #[default]
    Islands,
    Condensed,
    Quasidefinite,
}

/// Of what the equations were factored last.
#[derive(Clone, Debug, Default)]
struct Factored {
    /// Whether it is still known: neither numbers nor mode have changed since, and all multipliers act along their rows.
    is_known: bool,
    /// Whether it was in the sparse form of the tree.
    sparse: bool,
    t: f64,
    q: Vec<f64>,
    rows: Vec<Source>,
}

impl Dense {
    /// Solves the equations factored last, into `found`; where rows contradict others they are factored again, in the form that meets
    /// all as nearly as possible.
    pub(super) fn solve_into(
        &mut self,
        f: &[f64],
        r: &[f64],
        found: &mut Solution,
        memory: &mut IslandMemory,
    ) -> Result<(), SaddleError> {
        match self.form {
            Form::Quasidefinite => self.quasidefinite.solve_into(f, r, found),
            Form::Condensed => self.condensed.solve_into(f, r, found),
            Form::Islands => self.saddle.solve_into(f, r, found, memory),
        }
        if self.form == Form::Condensed && found.inconsistency > 0.0 {
            self.factor_scaled(self.condensed.has_own_forces())?;
            self.saddle.solve_into(f, r, found, memory);
        }
        Ok(())
    }

    /// The multipliers that balance themselves in the equations factored last, m × d; the largest entry of each column is 1.
    pub(super) fn self_stress(&self) -> Matrix {
        match self.form {
            Form::Quasidefinite => Matrix::zeros(self.g.rows(), 0),
            Form::Condensed => self.condensed.self_stress(),
            Form::Islands => self.saddle.self_stress(),
        }
    }

    /// Factors mass matrix and rows where nothing is in doubt, and says whether it is not.
    fn factor_clear(&mut self, own: bool) -> bool {
        if !own && self.quasidefinite.refactor(&self.mass, &self.g, &self.columns) {
            self.form = Form::Quasidefinite;
            return true;
        }
        self.form = Form::Condensed;
        self.condensed.refactor(&self.mass, &self.g, own.then_some(&self.b))
    }

    /// Factors mass matrix and rows, made of order one, where nothing is known of them; `own`: the multipliers act along others.
    fn factor_scaled(&mut self, own: bool) -> Result<(), SaddleError> {
        self.form = Form::Islands;
        self.scales.clear();
        self.scales.extend(row_scales(&self.g, &self.columns));
        let b = own.then_some(&self.b);
        self.saddle.refactor(Equations {
            mass: &self.mass,
            g: &self.g,
            b,
            row_scale: &self.scales,
            col_scale: &self.columns,
        })
    }
}

/// Memory of the right-hand sides and of what is found.
#[derive(Clone, Debug, Default)]
pub struct Memory {
    pub(super) force: Vec<f64>,
    pub(super) asked: Vec<f64>,
    /// What the solution leaves open of the rows.
    gap: Vec<f64>,
    pub(super) found: Solution,
    pub(super) islands: IslandMemory,
}

/// What is wanted of a solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wanted {
    /// Accelerations and multipliers.
    Motion,
    /// All reactions too.
    Reactions,
    /// The rank of the rows too, and the motions that they leave.
    Rank,
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
    /// Solves for what is wanted.
    pub(super) fn solve_minimal(&mut self, wanted: Wanted) -> Result<(), DynamicsError> {
        let mut memory = self.memory.take().unwrap_or_default();
        let done = self.solve_minimal_with(&mut memory, wanted);
        self.memory = Some(memory);
        done
    }

    fn solve_minimal_with(&mut self, memory: &mut Memory, wanted: Wanted) -> Result<(), DynamicsError> {
        let Memory { force, asked, gap, found, islands } = memory;
        self.set_forces(force);
        self.factor_for(wanted, Force::ActuatorDirection)?;
        asked.clear();
        asked.extend(self.rows.iter().map(|row| -row.bias));
        let solved = self.dense.solve_into(force, asked, found, islands);
        solved.map_err(|error| self.explain(error))?;
        self.solved.nu_dot.copy_from_slice(&found.a);
        self.solved.lambda.clone_from(&found.lambda);
        self.k.propagate_motion(self.m, &self.solved.nu_dot, true, &mut self.solved.bodies);
        if self.dense.form == Form::Islands || wanted != Wanted::Motion {
            self.propagate_joint_wrenches();
        }
        if self.dense.form != Form::Islands {
            return Ok(());
        }
        // One step of iterative refinement: what is left of the balances and open of the rows, asked of the factored equations
        // again. Small masses behind large ones keep their digits.
        powers_along_joints(self.at(), &self.solved.joint_wrenches, force);
        self.dense.g.mul_vec_into(&self.solved.nu_dot, gap);
        gap.iter_mut().zip(&*asked).for_each(|(gap, asked)| *gap = asked - *gap);
        self.check_consistent(asked, gap)?;
        let refined = self.dense.solve_into(force, gap, found, islands);
        refined.map_err(|error| self.explain(error))?;
        self.solved.nu_dot.iter_mut().zip(&found.a).for_each(|(x, d)| *x += d);
        self.solved.lambda.iter_mut().zip(&found.lambda).for_each(|(x, d)| *x += d);
        self.k.propagate_motion(self.m, &self.solved.nu_dot, true, &mut self.solved.bodies);
        if wanted != Wanted::Motion {
            self.propagate_joint_wrenches();
        }
        Ok(())
    }

    /// Finds the closing rows of the present state, and the generalized forces less what velocities ask for.
    pub(super) fn set_forces(&mut self, force: &mut Vec<f64>) {
        force.clear();
        force.resize(self.m.freedom(), 0.0);
        self.k.propagate_motion(self.m, force, true, &mut self.solved.bodies);
        let mut rows = std::mem::take(&mut self.rows);
        closing_rows_into(self.at(), Some(&self.solved.bodies), &mut rows);
        self.rows = rows;
        let at = self.placed.view(self.m, &self.n, &self.k);
        let wrenches = &mut self.solved.joint_wrenches;
        residual_into(at, &self.loads, &self.solved.bodies, &[], &[], wrenches);
        pass_to_ground(at, wrenches);
        powers_along_joints(at, wrenches, force);
    }

    /// Whether elimination in the order given solved the present state.
    pub(crate) fn is_clear(&self) -> bool {
        self.dense.form == Form::Quasidefinite && self.is_factored(0.0, false)
    }

    /// Factors mass matrix and rows of the present state.
    pub(super) fn factor(&mut self, force: Force) -> Result<(), DynamicsError> {
        self.factor_for(Wanted::Rank, force)
    }

    /// The same, where the rank of the rows need not be wanted.
    pub(super) fn factor_for(&mut self, wanted: Wanted, force: Force) -> Result<(), DynamicsError> {
        self.placed.is_solved = false;
        let at = self.placed.view(self.m, &self.n, &self.k);
        let d = &mut self.dense;
        mass_matrix(at, &self.arms, &mut d.carried, &mut d.mass);
        rows_in_coordinates(at, &self.rows, self.length, |row| &row.motion, &mut d.g, &mut d.sizes);
        d.columns.clear();
        d.columns.extend(column_scales(at, self.length));
        let own = force == Force::ActuatorDirection && self.rows.iter().any(|row| row.force.is_some());
        if own {
            rows_in_coordinates(at, &self.rows, self.length, Row::loads, &mut d.b, &mut d.sizes);
        }
        let factored = match wanted != Wanted::Rank && d.factor_clear(own) {
            true => Ok(()),
            false => d.factor_scaled(own),
        };
        self.note_factored(factored.is_ok() && !own, false);
        factored.map_err(|error| self.explain(error))
    }

    /// Notes of what the equations were factored, if they were and all multipliers act along their rows.
    pub(super) fn note_factored(&mut self, is_known: bool, sparse: bool) {
        let is_target = |row: &Row| row.source == Source::TARGET;
        let of = &mut self.dense.factored;
        of.is_known = is_known && self.placed.bearing.is_none() && !self.rows.iter().any(is_target);
        (of.sparse, of.t) = (sparse, self.placed.t);
        of.q.clone_from(&self.placed.q);
        of.rows.clear();
        of.rows.extend(self.rows.iter().map(|row| row.source));
    }

    /// Whether the equations factored last are, in the form of the tree or in another, those of the present rows at a state that is no farther than `near`, in the units of
    /// the coordinates.
    pub(super) fn is_factored(&self, near: f64, sparse: bool) -> bool {
        let (of, columns) = (&self.dense.factored, &self.dense.columns);
        let moved = || self.placed.q.iter().zip(&of.q).zip(columns).map(|((a, b), unit)| ((a - b) / unit).abs());
        of.is_known
            && of.sparse == sparse
            && of.t == self.placed.t
            && of.rows.iter().eq(self.rows.iter().map(|row| &row.source))
            && moved().all(|moved| moved <= near)
    }

    /// Forgets what was factored: something else than the state has changed.
    pub(super) fn forget_factors(&mut self) {
        self.placed.is_solved = false;
        self.dense.factored.is_known = false;
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

    /// Refuses rows that contradict each other: what the accelerations found leave open of what is asked is more than round-off.
    fn check_consistent(&self, asked: &[f64], gap: &[f64]) -> Result<(), DynamicsError> {
        let (columns, scales) = (&self.dense.columns, &self.dense.scales);
        let is_met = |most: f64| gap.iter().zip(scales).all(|(gap, scale)| (gap * scale).abs() <= CONTRADICTION * most);
        // What is asked is a difference of squares of rates, and is met by what loads and constraints accelerate.
        let rate = self.placed.u.iter().zip(columns).map(|(u, c)| (u / c).abs()).fold(0.0, f64::max);
        if is_met(rate * rate) {
            return Ok(());
        }
        let over = |load: f64, inertia: f64| if inertia > 0.0 { load / inertia } else { 0.0 };
        let fall = |(body, load): (usize, &Wrench)| {
            let inertia = Inertia::of(self.at(), body, self.arms[body]);
            over(load.f.norm(), inertia.mass * self.length).max(over(load.m.abs(), inertia.turn))
        };
        let least = self.loads.iter().enumerate().map(fall).fold(rate * rate, f64::max);
        let found = &self.solved.nu_dot;
        let meets = |i: usize| self.dense.g.row(i).iter().zip(found).map(|(g, a)| (g * a).abs());
        let most = |i: usize| scales[i] * meets(i).fold(asked[i].abs(), f64::max);
        let most = (0..asked.len()).map(most).fold(least, f64::max);
        if is_met(most) {
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

/// What the loads that the joints of the tree must pass do along their freedom, where they can pass nothing: what is left of the
/// balances.
pub(super) fn powers_along_joints<S: Scalar>(at: StateView<'_, S>, wrenches: &[Wrench<S>], out: &mut [S]) {
    for (i, body) in at.m.bodies.iter().enumerate() {
        let Some(b) = body.tree_joint else { continue };
        for k in 0..b.freedom {
            out[b.start + k] = -wrenches[i].power(at.k.motion_subspace[i][k]);
        }
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
