//! How what is read of an instant changes with its state and parameters, exactly.
//!
//! The balances and rows, read over dual numbers at the accelerations and multipliers found, say what these leave when
//! the state changes; the factored equations say by how much accelerations and multipliers must follow (implicit
//! differentiation; Griewank & Walther, *Evaluating Derivatives*, 2nd ed., §15.1). The friction of joints that slide,
//! which is found by iteration, follows in the same way. The mode stays as it is.

use super::minimal::{joint_wrenches, Force};
use super::rows::closing_rows;
use super::{
    contact_forces, generalized_force, joint_friction, loads, residual, DynamicsError, Route, Row, SolvedView, Source,
    Workspace,
};
use crate::bound_values::BoundValues;
use crate::gauges::ModelExpr;
use crate::kinematics::{Kinematics, Observed, StateView};
use crate::plane::{Twist, Vec2, Wrench};
use crate::scalar::{Dual, Scalar};
use crate::solve::{Lu, Matrix};

/// Directions that one sweep of dual numbers carries.
pub(super) const LANES: usize = 4;
pub(super) type Lanes = Dual<LANES>;

/// A change of a state, per unit of whatever it is a direction of; no entries for no change.
#[derive(Clone, Debug, Default)]
pub struct Direction {
    /// Of time.
    pub t: f64,
    /// Of the coordinates.
    pub q: Vec<f64>,
    /// Of their rates.
    pub u: Vec<f64>,
    /// Of the parameters.
    pub p: Vec<f64>,
    /// Of the works since the start.
    pub works: Vec<f64>,
}

/// What one lane of dual numbers carries: a direction, or a unit of the friction of a joint that slides.
#[derive(Clone, Copy)]
pub(super) enum Lane<'a> {
    Along(&'a Direction),
    Friction(usize),
}

impl<'a> Lane<'a> {
    fn part(self, of: impl Fn(&'a Direction) -> &'a [f64], i: usize) -> f64 {
        match self {
            Lane::Along(direction) => of(direction).get(i).copied().unwrap_or(0.0),
            Lane::Friction(_) => 0.0,
        }
    }
}

/// How a row of [`closing_rows`] changes along directions: what must vanish, and its rate, where they are prescribed.
pub struct RowDerivatives {
    /// Where the row comes from.
    pub source: Source,
    /// Of its value, along each direction.
    pub value: Option<Vec<f64>>,
    /// Of its rate, along each direction.
    pub rate: Option<Vec<f64>>,
}

/// A state whose numbers carry directions.
pub(super) struct Seeded {
    n: BoundValues<Lanes>,
    k: Kinematics<Lanes>,
    q: Vec<Lanes>,
    u: Vec<Lanes>,
    t: Lanes,
}

impl Seeded {
    pub(super) fn of(now: StateView<'_, f64>, along: &[Lane]) -> Self {
        let n = now.m.bind(&seeded(&now.n.p, along, |d| &d.p));
        let (q, u) = (seeded(now.q, along, |d| &d.q), seeded(now.u, along, |d| &d.u));
        let mut k = Kinematics::of(now.m);
        k.forward_kinematics(now.m, &n, &q, &u);
        Seeded { n, k, q, u, t: seeded(&[now.t], along, |d| std::slice::from_ref(&d.t))[0] }
    }

    pub(super) fn view<'a>(&'a self, now: StateView<'a, f64>) -> StateView<'a, Lanes> {
        StateView { m: now.m, n: &self.n, k: &self.k, q: &self.q, u: &self.u, t: self.t, mode: now.mode }
    }
}

/// Values with what directions make of them.
fn seeded(values: &[f64], along: &[Lane], part: fn(&Direction) -> &[f64]) -> Vec<Lanes> {
    let change = |i: usize, lane: usize| along.get(lane).map_or(0.0, |lane| lane.part(part, i));
    let seed = |(i, &re): (usize, &f64)| Dual { re, du: std::array::from_fn(|lane| change(i, lane)) };
    values.iter().enumerate().map(seed).collect()
}

/// The balances of one state with given accelerations and multipliers.
struct Balances<S> {
    bodies: Vec<Twist<S>>,
    rows: Vec<Row<S>>,
    /// What is left on each body, at its joint origin.
    left: Vec<Wrench<S>>,
}

impl<S: Scalar> Balances<S> {
    fn of(at: StateView<'_, S>, nu_dot: &[S], lambda: &[S], friction: &[S]) -> Self {
        let count = at.m.bodies.len();
        let mut bodies = vec![Twist::zero(); count];
        at.k.propagate_motion(at.m, nu_dot, true, &mut bodies);
        let rows = closing_rows(at, Some(&bodies));
        let (mut arms, mut acting) = (vec![Vec2::zero(); count], vec![Wrench::zero(); count]);
        loads::centre_arms(at, &mut arms);
        loads::loads(at, &arms, &mut acting);
        joint_friction::add_joint_friction(at, friction, &mut acting);
        contact_forces::add_compliant_forces(at, &mut acting);
        let left = residual(at, &acting, &bodies, &rows, lambda);
        Balances { bodies, rows, left }
    }
}

/// The derivatives along one direction: of each expression, and of each friction that its law asks for.
#[derive(Clone)]
struct Response {
    of_laws: Vec<f64>,
    of_friction: Vec<f64>,
}

impl Workspace<'_> {
    /// Units of time, of every coordinate, of every rate, and of every parameter with those that follow from it.
    pub fn unit_directions(&self) -> Vec<Direction> {
        let (n, p) = (self.m.freedom(), &self.n.p);
        let unit = |i: usize| -> Vec<f64> { (0..n).map(|j| if i == j { 1.0 } else { 0.0 }).collect() };
        let time = [Direction { t: 1.0, ..Direction::default() }].into_iter();
        let places = (0..n).map(|i| Direction { q: unit(i), ..Direction::default() });
        let rates = (0..n).map(|i| Direction { u: unit(i), ..Direction::default() });
        let parameters =
            (0..p.len()).map(|i| Direction { p: self.m.parameter_direction(p, i), ..Direction::default() });
        time.chain(places).chain(rates).chain(parameters).collect()
    }

    /// The derivatives of expressions along each direction, in the present mode; `works` as those of
    /// [`Workspace::evaluate`]. NaN where an expression is not determinate or has no derivative. Where rows depend on each
    /// other only directions that keep them consistent have a meaning.
    ///
    /// # Errors
    /// As [`Workspace::solve`].
    pub fn derivatives(
        &mut self,
        laws: &[&ModelExpr],
        works: &[f64],
        along: &[Direction],
    ) -> Result<Vec<Vec<f64>>, DynamicsError> {
        let determinacy = self.determinacy();
        self.solve_by(Route::Minimal)?;
        self.factor(Force::ActuatorDirection)?;
        let sliding = self.joint_friction_forces.len();
        let all: Vec<Lane> = along.iter().map(Lane::Along).chain((0..sliding).map(Lane::Friction)).collect();
        let mut responses = vec![];
        for lanes in all.chunks(LANES) {
            responses.extend(self.respond(laws, works, lanes, &determinacy));
        }
        let by_friction = responses.split_off(along.len());
        if sliding > 0 {
            // The friction asked for is the friction there is: (1 − ∂law/∂friction) d friction = ∂law/∂state.
            let unit = |i, j| if i == j { 1.0 } else { 0.0 };
            let own = Matrix::from_fn(sliding, sliding, |i, j| unit(i, j) - by_friction[j].of_friction[i]);
            let own = Lu::factor(&own).map_err(|_| self.self_locking())?;
            for response in &mut responses {
                let change = own.solve(&response.of_friction);
                for (by, change) in by_friction.iter().zip(change) {
                    response.of_laws.iter_mut().zip(&by.of_laws).for_each(|(sum, by)| *sum += by * change);
                }
            }
        }
        Ok(responses.into_iter().map(|response| response.of_laws).collect())
    }

    /// How the rows that hold in the present mode change along each direction.
    ///
    /// # Errors
    /// As [`Workspace::solve`].
    pub fn row_derivatives(&mut self, along: &[Direction]) -> Result<Vec<RowDerivatives>, DynamicsError> {
        self.solve()?; // which decides on which flank teeth bear
        let lanes: Vec<Lane> = along.iter().map(Lane::Along).collect();
        let mut found: Vec<RowDerivatives> = vec![];
        for lanes in lanes.chunks(LANES) {
            let now = self.at();
            for (i, row) in closing_rows(Seeded::of(now, lanes).view(now), None).into_iter().enumerate() {
                let new = |of: Option<Lanes>| of.map(|_| vec![]);
                if found.len() == i {
                    found.push(RowDerivatives { source: row.source, value: new(row.value), rate: new(row.rate) });
                }
                let so_far = &mut found[i];
                for (list, of) in [(&mut so_far.value, row.value), (&mut so_far.rate, row.rate)] {
                    list.iter_mut().zip(of).for_each(|(list, of)| list.extend(&of.du[..lanes.len()]));
                }
            }
        }
        Ok(found)
    }

    /// The time derivatives of expressions along the motion from the present state; `works` as those of
    /// [`Workspace::evaluate`].
    ///
    /// # Errors
    /// As [`Workspace::solve`].
    pub(super) fn rates_along_motion(&mut self, of: &[&ModelExpr], works: &[f64]) -> Result<Vec<f64>, DynamicsError> {
        if of.is_empty() {
            return Ok(vec![]);
        }
        self.solve()?;
        let mut accelerations = vec![0.0; self.m.freedom()];
        if !self.mode().resting {
            self.accelerations(&mut accelerations);
        }
        let mut powers: Vec<f64> = (0..self.m.forces.len()).map(|f| loads::unaccounted_power(self.at(), f)).collect();
        powers.extend(self.solved_view().drive_powers());
        powers.push(self.friction_power());
        let mut p = vec![0.0; self.m.first_state()];
        p.extend(self.state_rates());
        let along = Direction { t: 1.0, q: self.at().u.to_vec(), u: accelerations, p, works: powers };
        Ok(self.derivatives(of, works, &[along])?.remove(0))
    }

    /// The derivatives along up to [`LANES`] directions, those of friction by its law not yet followed.
    fn respond(
        &self,
        laws: &[&ModelExpr],
        works: &[f64],
        along: &[Lane],
        determinacy: &super::Determinacy,
    ) -> Vec<Response> {
        let (m, now) = (self.m, self.at());
        let state = Seeded::of(now, along);
        let at = state.view(now);
        let mut friction = seeded(&self.joint_friction_forces, along, |_| &[]);
        for (i, lane) in along.iter().enumerate() {
            if let Lane::Friction(of) = lane {
                friction[*of].du[i] = 1.0;
            }
        }
        let (nu_dot, lambda) = self.follow(at, &friction, along.len());
        let found = Balances::of(at, &nu_dot, &lambda, &friction);
        let mut accelerations = vec![Lanes::zero(); m.freedom()];
        state.k.user_rates(m, &state.n, &found.bodies, &nu_dot, &mut accelerations);
        let wrenches = joint_wrenches(at, &found.left);
        let seen = SolvedView {
            at,
            joint_wrenches: &wrenches,
            rows: &found.rows,
            lambda: &lambda,
            sliding_friction: &friction,
            length: self.length,
        };
        let works = seeded(works, along, |d| &d.works);
        let read = |reading| seen.read(reading, &works, Some(determinacy));
        let observed = Observed { at, bodies: &found.bodies, accelerations: &accelerations, read: &read, rates: &[] };
        let laws: Vec<Lanes> = laws.iter().map(|law| law.eval(&observed)).collect();
        let by_law = seen.friction_by_law();
        let lane =
            |of: &[Lanes], lane: usize| of.iter().map(|x| if x.re.is_nan() { x.re } else { x.du[lane] }).collect();
        (0..along.len()).map(|i| Response { of_laws: lane(&laws, i), of_friction: lane(&by_law, i) }).collect()
    }

    /// Accelerations and multipliers as they follow a change of the state.
    fn follow(&self, at: StateView<'_, Lanes>, friction: &[Lanes], lanes: usize) -> (Vec<Lanes>, Vec<Lanes>) {
        let fixed = |values: &[f64]| values.iter().map(|&x| Lanes::of(x)).collect::<Vec<Lanes>>();
        let (mut nu_dot, mut lambda) = (fixed(&self.solved.nu_dot), fixed(&self.solved.lambda));
        let left = Balances::of(at, &nu_dot, &lambda, friction);
        let mut force = vec![Lanes::zero(); nu_dot.len()];
        generalized_force(at, left.left.into_iter().enumerate().skip(1), &mut force);
        for lane in 0..lanes {
            let force: Vec<f64> = force.iter().map(|x| x.du[lane]).collect();
            let asked: Vec<f64> = left.rows.iter().map(|row| -row.bias.du[lane]).collect();
            let more = self.dense.saddle.solve(&force, &asked);
            nu_dot.iter_mut().zip(more.a).for_each(|(x, d)| x.du[lane] = d);
            lambda.iter_mut().zip(more.lambda).for_each(|(x, d)| x.du[lane] = d);
        }
        (nu_dot, lambda)
    }
}
