//! The motion over any scalar of a mechanism in which nothing happens, to be recorded.

use super::articulated_body::ArticulatedBody;
use super::elimination::Elimination;
use super::loads::{centre_arms, loads, unaccounted_power};
use super::minimal::{joint_wrenches, powers_along_joints};
use super::momentum::residual;
use super::tree_matrices::visit_mass;
use super::{closing_rows, reaction_names, visit_ancestors, DynamicsError, Row, SolvedView};
use crate::bound_values::BoundValues;
use crate::gauges::ModelExpr;
use crate::joints::Joint as _;
use crate::kinematics::{Kinematics, State, StateView};
use crate::mechanism::{Drive, DriveGauges, Force, Joint, Level, Mechanism, Recording};
use crate::mode::Mode;
use crate::plane::{Twist, Vec2, Wrench};
use crate::scalar::Scalar;

impl Mechanism {
    /// Whether nothing but the tree constrains its motion where nothing happens.
    pub fn is_tree(&self) -> bool {
        self.closures.is_empty() && self.drives.is_empty()
    }
}

/// A mechanism in motion.
pub struct SmoothMotion<'m, S> {
    /// The mechanism.
    pub m: &'m Mechanism,
    /// Its numbers.
    pub n: BoundValues<S>,
    mode: Mode,
    k: Kinematics<S>,
    arms: Vec<Vec2<S>>,
    loads: Vec<Wrench<S>>,
    sweep: ArticulatedBody<S>,
    nu_dot: Vec<S>,
    bodies: Vec<Twist<S>>,
    rows: Vec<Row<S>>,
    lambda: Vec<S>,
    pivots: Vec<S>,
}

impl<'m, S: Scalar> SmoothMotion<'m, S> {
    /// Whether the motion of a mechanism is the same operations whatever its numbers, and nothing happens in it.
    pub fn fits(m: &Mechanism) -> bool {
        m.events.is_empty() && !m.is_hybrid() && Self::fits_while_free(m)
    }

    /// Whether it is so as long as its mode [is free](Mode::is_free).
    pub fn fits_while_free(m: &Mechanism) -> bool {
        let holds_axes = |&joint: &usize| m.joints[joint].kind.held().is_some();
        let is_plain = |(drive, gauges): (&Drive, &DriveGauges)| {
            let is_uniform = drive.of.is_uniform() && drive.law.is_uniform();
            drive.level == Level::Position && gauges.force.is_none() && is_uniform
        };
        Self::roughness(m).is_none()
            && !m.has_parts_that_come_and_go()
            && m.closures.iter().all(holds_axes)
            && m.drives.iter().zip(&m.drive_gauges).all(is_plain)
    }

    /// Why the motion of a mechanism is not that of a tree by the same operations whatever its numbers, to follow "because".
    pub fn obstacle(m: &Mechanism) -> Option<&'static str> {
        match (m.closures.is_empty(), m.drives.is_empty()) {
            (false, _) => Some("joints close a loop"),
            (_, false) => Some("a motion or a coupling is prescribed"),
            _ if m.is_hybrid() => Some("there are contacts, stops, strings, joint friction or parts that come and go"),
            _ => Self::roughness(m),
        }
    }

    fn roughness(m: &Mechanism) -> Option<&'static str> {
        let is_plain =
            |joint: &Joint| joint.curve.is_none() && !joint.coordinates.iter().any(|c| joint.kind.unsigned(c.card));
        let is_smooth = |force: &Force| force.plate.is_none() && force.laws().all(ModelExpr::is_uniform);
        let obstacles = [
            (!m.discontinuities.is_empty(), "a law switches"),
            (!m.joints.iter().all(is_plain), "a joint runs along a curve, or its coordinate has no sign"),
            (!m.forces.iter().all(is_smooth), "a law of a force is looked up, or its formula has branches"),
            (
                !m.state_rates.iter().all(ModelExpr::is_uniform),
                "a law of a state is looked up, or its formula has branches",
            ),
        ];
        obstacles.iter().find(|(stands, _)| *stands).map(|(_, why)| *why)
    }

    /// A mechanism with its numbers.
    pub fn new(m: &'m Mechanism, n: BoundValues<S>) -> Self {
        let (bodies, freedom) = (m.bodies.len(), m.freedom());
        SmoothMotion {
            m,
            n,
            mode: Mode::free(m),
            k: Kinematics::of(m),
            arms: vec![Vec2::zero(); bodies],
            loads: vec![Wrench::zero(); bodies],
            sweep: ArticulatedBody::new(),
            nu_dot: vec![S::zero(); freedom],
            bodies: vec![Twist::zero(); bodies],
            rows: vec![],
            lambda: vec![],
            pivots: vec![],
        }
    }

    /// What is read at y and a time; `zeros`: what the closing rows are where the loops are closed.
    ///
    /// # Errors
    /// `singular_mass`.
    pub fn read(&mut self, what: Recording, t: S, y: &[S], zeros: &[S]) -> Result<Vec<S>, DynamicsError> {
        match what {
            Recording::Rates => {
                let mut read = vec![S::zero(); y.len()];
                self.rate(t, y, &mut read)?;
                read.extend_from_slice(&self.pivots);
                let forces = (0..self.m.forces.len()).filter(|&force| !self.m.forces[force].is_conservative());
                read.extend(forces.map(|force| self.unaccounted_power(t, y, force)));
                let (motions, solved) =
                    ((0..self.m.drives.len()).filter(|&d| self.m.drives[d].is_motion()), self.solved(t, y, &[]));
                read.extend(motions.map(|drive| solved.drive_power(drive)));
                Ok(read)
            }
            Recording::Corrections if self.m.is_tree() => Ok(vec![]),
            Recording::Corrections => Ok(self.corrections(t, y, zeros)),
            Recording::Solution => self.solution(t, y),
        }
    }

    /// Writes the rates of y at a time.
    ///
    /// # Errors
    /// `singular_mass`.
    pub fn rate(&mut self, t: S, y: &[S], dy: &mut [S]) -> Result<(), DynamicsError> {
        let n = self.m.freedom();
        self.solve(t, y, &mut dy[n..2 * n])?;
        dy[..n].copy_from_slice(&y[n..2 * n]);
        for (rate, law) in dy[2 * n..].iter_mut().zip(&self.m.state_rates) {
            *rate = law.eval(&State(self.at(t, y)));
        }
        Ok(())
    }

    /// Writes the accelerations at y and a time.
    fn solve(&mut self, t: S, y: &[S], accelerations: &mut [S]) -> Result<(), DynamicsError> {
        self.place(y);
        let m = self.m;
        let (q, u) = y[..2 * m.freedom()].split_at(m.freedom());
        let at = StateView { m, n: &self.n, k: &self.k, q, u, t, mode: &self.mode };
        loads(at, &self.arms, &mut self.loads);
        match m.is_tree() {
            true => self.sweep.solve(at, &self.arms, &self.loads, &mut self.nu_dot, &mut self.bodies, |_, _| {})?,
            false => {
                self.nu_dot.fill(S::zero());
                self.k.propagate_motion(m, &self.nu_dot, true, &mut self.bodies);
                self.rows = closing_rows(at, Some(&self.bodies));
                let unbalanced = joint_wrenches(at, &residual(at, &self.loads, &self.bodies, &[], &[]));
                powers_along_joints(at, &unbalanced, &mut self.nu_dot);
                let factored = eliminated(at, &self.arms, &self.rows);
                let asked = self.rows.iter().map(|row| -row.bias);
                let found = factored.solve(self.nu_dot.iter().copied().chain(asked).collect());
                self.nu_dot.copy_from_slice(&found[..m.freedom()]);
                self.lambda = found[m.freedom()..].iter().map(|&x| -x).collect();
                self.pivots = factored.pivots;
                self.k.propagate_motion(m, &self.nu_dot, true, &mut self.bodies);
            }
        }
        self.k.user_rates(m, &self.n, &self.bodies, &self.nu_dot, accelerations);
        Ok(())
    }

    fn corrections(&mut self, t: S, y: &[S], zeros: &[S]) -> Vec<S> {
        self.place(y);
        let (at, n) = (self.at(t, y), self.m.freedom());
        let rows = closing_rows(at, None);
        let factored = eliminated(at, &self.arms, &rows);
        let gaps = rows.iter().zip(zeros).map(|(row, &zero)| zero - row.value.expect("it is of places")).collect();
        let rates = rows.iter().map(|row| -row.rate.expect("it is of places")).collect();
        let correction = |asked: Vec<S>| {
            let found = factored.solve([vec![S::zero(); n], asked].concat());
            let (mut bodies, mut user) = (vec![Twist::zero(); self.m.bodies.len()], vec![S::zero(); n]);
            self.k.propagate_motion(self.m, &found[..n], false, &mut bodies);
            self.k.user_rates(self.m, &self.n, &bodies, &found[..n], &mut user);
            user
        };
        [correction(gaps), correction(rates)].concat()
    }

    fn solution(&mut self, t: S, y: &[S]) -> Result<Vec<S>, DynamicsError> {
        let n = self.m.freedom();
        let mut read = vec![S::zero(); n + reaction_names(self.m).len()];
        self.solve(t, y, &mut read[..n])?;
        let at = self.at(t, y);
        let wrenches = joint_wrenches(at, &residual(at, &self.loads, &self.bodies, &self.rows, &self.lambda));
        self.solved(t, y, &wrenches).write_reactions(None, &mut read[n..]);
        Ok(read)
    }

    /// What was solved last; `joint_wrenches`: where they are wanted. No length is.
    fn solved<'a>(&'a self, t: S, y: &'a [S], joint_wrenches: &'a [Wrench<S>]) -> SolvedView<'a, S> {
        let (at, rows, lambda) = (self.at(t, y), &self.rows, &self.lambda);
        SolvedView { at, joint_wrenches, rows, lambda, sliding_friction: &[], length: f64::NAN }
    }

    /// Goes to y.
    fn place(&mut self, y: &[S]) {
        let (m, n) = (self.m, self.m.freedom());
        self.n.p[m.first_state()..].copy_from_slice(&y[2 * n..]);
        self.k.forward_kinematics(m, &self.n, &y[..n], &y[n..2 * n]);
        let at = StateView { m, n: &self.n, k: &self.k, q: &y[..n], u: &y[n..2 * n], t: S::zero(), mode: &self.mode };
        centre_arms(at, &mut self.arms);
    }

    /// The state that was placed last.
    fn at<'a>(&'a self, t: S, y: &'a [S]) -> StateView<'a, S> {
        let (q, u) = y[..2 * self.m.freedom()].split_at(self.m.freedom());
        StateView { m: self.m, n: &self.n, k: &self.k, q, u, t, mode: &self.mode }
    }

    /// The power of a force without what its potential accounts for, where the rates were written last, W.
    pub fn unaccounted_power(&self, t: S, y: &[S], force: usize) -> S {
        unaccounted_power(self.at(t, y), force)
    }
}

/// Masses and rows at a state.
fn eliminated<S: Scalar>(at: StateView<'_, S>, arms: &[Vec2<S>], rows: &[Row<S>]) -> Elimination<S> {
    let n = at.m.freedom();
    let mut a = vec![vec![S::zero(); n + rows.len()]; n + rows.len()];
    visit_mass(at, arms, &mut vec![], |row, column, inertia| a[row.min(column)][row.max(column)] = inertia);
    for (i, row) in rows.iter().enumerate() {
        visit_ancestors(at, row.motion.iter().copied(), |j, load, column| a[j][n + i] += load.power(column));
    }
    Elimination::new(a)
}
