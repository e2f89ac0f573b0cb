//! How the rates after an impact change with the state before it and parameters, exactly.

use super::derivatives::{Lane, Lanes, Seeded, LANES};
use super::minimal::Force;
use super::{
    add_multipliers, closing_rows, generalized_force, momentum, Direction, DynamicsError, Row, Source, Workspace,
};
use crate::kinematics::StateView;
use crate::plane::{Twist, Wrench};
use crate::scalar::Scalar;

/// What impulses leave of the balances, and of the rates at which the rows are to part.
struct ImpulseBalances<S> {
    bodies: Vec<Twist<S>>,
    /// Along each joint coordinate.
    force: Vec<S>,
    /// Of each row: −e times its rate before, less its rate after.
    rates: Vec<S>,
}

impl<S: Scalar> ImpulseBalances<S> {
    fn of(at: StateView<'_, S>, jump: &[S], lambda: &[S]) -> Self {
        let mut bodies = vec![Twist::zero(); at.m.bodies.len()];
        at.k.propagate_motion(at.m, jump, false, &mut bodies);
        let rows = closing_rows(at, None);
        let unbalanced = |body: usize| {
            let arm = at.centre_arm(body);
            -momentum(at, body, bodies[body].at(arm), bodies[body].w).seen_from(arm)
        };
        let mut left: Vec<Wrench<S>> = (0..bodies.len()).map(unbalanced).collect();
        add_multipliers(&rows, lambda, &mut left);
        let mut force = vec![S::zero(); jump.len()];
        generalized_force(at, left.into_iter().enumerate().skip(1), &mut force);
        let gained = |row: &Row<S>| row.motion.iter().fold(S::zero(), |sum, &(body, w)| sum + w.power(bodies[body]));
        let rate = |row: &Row<S>| row.rate.unwrap_or(S::zero()) * (S::of(1.0) + restitution(at, row));
        let rates = rows.iter().map(|row| -(rate(row) + gained(row))).collect();
        ImpulseBalances { bodies, force, rates }
    }
}

/// The coefficient of restitution of a row: that of the gap of a unilateral constraint; 0 of what stays closed.
fn restitution<S: Scalar>(at: StateView<'_, S>, row: &Row<S>) -> S {
    match row.source {
        Source::Gap(constraint) => at.n.values[at.m.unilateral[constraint].restitution],
        _ => S::zero(),
    }
}

impl Workspace<'_> {
    /// The rates after an impact in which the rows of the present mode take part, each parting at −e times the rate of its
    /// approach, and their derivatives along each direction. The present state is the one before it.
    ///
    /// # Errors
    /// As [`Workspace::solve`].
    pub fn impact_derivatives(&mut self, along: &[Direction]) -> Result<(Vec<f64>, Vec<Vec<f64>>), DynamicsError> {
        let (n, zero) = (self.m.freedom(), vec![0.0; self.m.freedom()]);
        self.update_rows();
        let mut arms = std::mem::take(&mut self.arms);
        super::loads::centre_arms(self.at(), &mut arms);
        self.arms = arms;
        self.factor(Force::ActuatorDirection)?;
        let asked = ImpulseBalances::of(self.at(), &zero, &vec![0.0; self.rows.len()]).rates;
        let impact = self.dense.saddle.solve(&zero, &asked);
        let mut after = vec![0.0; n];
        self.to_user(&impact.a, &mut after);
        after.iter_mut().zip(self.at().u).for_each(|(after, before)| *after += before);
        let lanes: Vec<Lane> = along.iter().map(Lane::Along).collect();
        let mut found = vec![];
        for lanes in lanes.chunks(LANES) {
            let now = self.at();
            let state = Seeded::of(now, lanes);
            let at = state.view(now);
            let mut jump: Vec<Lanes> = impact.a.iter().map(|&x| Lanes::of(x)).collect();
            let lambda: Vec<Lanes> = impact.lambda.iter().map(|&x| Lanes::of(x)).collect();
            let left = ImpulseBalances::of(at, &jump, &lambda);
            let part = |of: &[Lanes], lane: usize| of.iter().map(|x| x.du[lane]).collect::<Vec<f64>>();
            for lane in 0..lanes.len() {
                let more = self.dense.saddle.solve(&part(&left.force, lane), &part(&left.rates, lane));
                jump.iter_mut().zip(more.a).for_each(|(x, d)| x.du[lane] = d);
            }
            let bodies = ImpulseBalances::of(at, &jump, &lambda).bodies;
            let mut rates = vec![Lanes::zero(); n];
            at.k.user_rates(at.m, at.n, &bodies, &jump, &mut rates);
            rates.iter_mut().zip(at.u).for_each(|(rate, &before)| *rate += before);
            found.extend((0..lanes.len()).map(|lane| part(&rates, lane)));
        }
        Ok((after, found))
    }
}
