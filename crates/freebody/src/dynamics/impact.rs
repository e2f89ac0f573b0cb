//! Impacts: what impulses through unilateral constraints and joints do.

use super::contact_modes::force_on_first;
use super::minimal::{joint_wrenches, Force};
use super::{ClosedContacts, ContactTolerances, DynamicsError, JointLoad, Row, SolvedView, Workspace};
use crate::contact::complementarity::{self, ImpactProblem, Problem};
use crate::gauges::ModelExpr;
use crate::mechanism::Friction;
use crate::plane::{Twist, Vec2, Wrench};

/// Within an impact without collision loads act for this part of the time in which they would bring about a speed that
/// counts.
const LOAD_TIME: f64 = 0.1;

/// An impact: what impulses through unilateral constraints did.
#[derive(Clone, Debug)]
pub struct ImpactSolution {
    /// Change of the user's rates.
    pub change: Vec<f64>,
    /// Impulses along each reached gap, N·s.
    pub normal: Vec<f64>,
    /// Impulses along each slide, N·s.
    pub tangent: Vec<f64>,
    /// The impulse of each unilateral constraint on its contact's first body, N·s, fixed axes.
    pub on_first: Vec<Vec2>,
    /// Impulsive reaction of every joint, N·s and N·m·s.
    pub joints: Vec<JointLoad>,
    /// Impulse of every coupling, motion and lock along its gauge.
    pub drives: Vec<f64>,
    /// Work of these impulses, J.
    pub drive_works: Vec<f64>,
    /// What was to be said of the law.
    pub note: Option<String>,
}

impl Workspace<'_> {
    /// What impulses along the unilateral constraints that are closed would do, by `settle` of the impact problem that
    /// it is given.
    ///
    /// # Errors
    /// What `settle` finds.
    pub fn solve_impact(
        &mut self,
        contacts: &ClosedContacts,
        restitution: &[f64],
        solve: impl FnOnce(&ImpactProblem) -> Result<(complementarity::Impulses, Option<String>), DynamicsError>,
    ) -> Result<ImpactSolution, DynamicsError> {
        let friction: Vec<f64> = contacts.constraints.iter().map(|&l| self.friction_of(l)).collect();
        let problem = ImpactProblem { g: &contacts.g, before: &contacts.rates, restitution, friction: &friction };
        let (impulses, note) = solve(&problem)?;
        Ok(self.impact_solution(contacts, impulses, note))
    }

    /// The impact by which unilateral constraints that have no motion under Coulomb's law come to one; None where each
    /// has one already.
    ///
    /// # Errors
    /// `no_impact`; as [`Workspace::solve`].
    pub fn impact_without_collision(
        &mut self,
        contacts: &ClosedContacts,
        scale: ContactTolerances,
    ) -> Result<Option<ImpactSolution>, DynamicsError> {
        let (free, slips) = (self.free_accelerations(contacts)?, contacts.slips());
        let friction = self.friction_laws(contacts, &slips, scale.rest_speed);
        let problem = Problem { g: &contacts.g, free: &free, friction: &friction };
        let fastest = free.iter().fold(scale.acceleration, |most, a| most.max(a.abs()));
        let impulses =
            complementarity::impact_without_collision(&problem, &slips, LOAD_TIME * scale.rest_speed / fastest)
                .map_err(|e| {
                    DynamicsError::NoImpulses(self.names_of(&contacts.constraints), "end the jam", e.to_string())
                })?;
        let note = Some("the contact jammed: an impact without a collision".to_string());
        Ok(impulses.map(|impulses| self.impact_solution(contacts, impulses, note)))
    }

    fn impact_solution(
        &mut self,
        contacts: &ClosedContacts,
        impulses: complementarity::Impulses,
        note: Option<String>,
    ) -> ImpactSolution {
        let p: Vec<f64> = impulses.normal.iter().chain(&impulses.tangent).copied().collect();
        let mut force = vec![0.0; self.m.freedom()];
        for (i, &p) in p.iter().enumerate() {
            self.along(contacts.row(i)).iter().zip(&mut force).for_each(|(f, sum)| *sum += p * f);
        }
        let solution = self.dense.saddle.solve(&force, &vec![0.0; self.rows.len()]);
        let mut change = vec![0.0; self.m.freedom()];
        self.to_user(&solution.a, &mut change);
        let jumps = self.jumps(&solution.a);
        let joints = self.impulsive_loads(contacts, &p, &jumps, &solution.lambda);
        let k = contacts.len();
        let on_first = (0..k).map(|i| self.on_first(contacts, i, p[i], p[k + i])).collect();
        let (normal, tangent) = (impulses.normal, impulses.tangent);
        let by_impulses = SolvedView { lambda: &solution.lambda, ..self.solved_view() };
        let drives = by_impulses.drive_forces();
        // Of an actuator with a direction of its own the rate along it jumps: then the mean counts.
        let drive_works = by_impulses.drive_powers_of(|body| self.k.twist[body] + jumps[body] * 0.5);
        ImpactSolution { change, normal, tangent, on_first, joints, drives, drive_works, note }
    }

    /// The impulses by which the present closing rows come to rest, unilateral constraints apart from those that carry.
    ///
    /// # Errors
    /// As [`Workspace::solve`].
    pub fn engagement_impact(&mut self) -> Result<ImpactSolution, DynamicsError> {
        let nothing = self.closed_contacts(vec![])?;
        self.factor_closing_rows()?;
        let asked: Vec<f64> = self.rows.iter().map(|row| -row.rate.unwrap_or(0.0)).collect();
        let solution = self.dense.saddle.solve(&vec![0.0; self.m.freedom()], &asked);
        let mut change = vec![0.0; self.m.freedom()];
        self.to_user(&solution.a, &mut change);
        let jumps = self.jumps(&solution.a);
        let joints = self.impulsive_loads(&nothing, &[], &jumps, &solution.lambda);
        let by_impulses = SolvedView { lambda: &solution.lambda, ..self.solved_view() };
        let drives = by_impulses.drive_forces();
        // A drive that is engaged has its own rate from the first.
        let drive_works = by_impulses.drive_powers_of(|body| self.k.twist[body] + jumps[body]);
        let (normal, tangent, on_first) = (vec![], vec![], vec![]);
        Ok(ImpactSolution { change, normal, tangent, on_first, joints, drives, drive_works, note: None })
    }

    /// Work of each drive in a jump of the rates at (t, q), from `u` to those placed, that the closing rows bring about, and
    /// `given` gauges that get rates at once.
    ///
    /// # Errors
    /// As [`Workspace::solve`].
    pub fn drive_works_since(
        &mut self,
        u: &[f64],
        given: &[(String, ModelExpr, f64)],
    ) -> Result<Vec<f64>, DynamicsError> {
        let (t, q, after) = (self.placed.t, self.placed.q.clone(), self.placed.u.clone());
        self.move_to(t, &q, u);
        let before = self.k.twist.clone();
        self.move_to(t, &q, &after);
        self.update_rows();
        let closing = self.rows.len();
        let targets: Vec<Row> = given.iter().map(|(_, gauge, rate)| self.target_row(gauge, 0.0, *rate)).collect();
        self.rows.extend(targets);
        super::loads::centre_arms(self.placed.view(self.m, &self.n, &self.k), &mut self.arms);
        self.factor(Force::Gradient)?;
        let jump = |body: usize| self.k.twist[body] - before[body];
        let rate = |row: &Row| row.motion.iter().map(|(body, w)| w.power(jump(*body))).sum();
        let jumps: Vec<f64> = self.rows.iter().map(rate).collect();
        let lambda = self.dense.saddle.solve(&vec![0.0; self.m.freedom()], &jumps).lambda;
        Ok(SolvedView { lambda: &lambda[..closing], ..self.solved_view() }.drive_powers())
    }

    /// Jumps of the velocities of all bodies by those of the joints of the tree.
    fn jumps(&self, change: &[f64]) -> Vec<Twist> {
        let mut bodies = vec![Twist::zero(); self.m.bodies.len()];
        self.k.propagate_motion(self.m, change, false, &mut bodies);
        bodies
    }

    /// The coefficient of friction of a unilateral constraint that slides: 0 where it is smooth, infinite where it
    /// cannot slide.
    pub fn friction_of(&self, constraint: usize) -> f64 {
        match self.m.unilateral[constraint].friction {
            None => 0.0,
            Some(Friction::Rough) => f64::INFINITY,
            Some(Friction::Coulomb { kinetic, .. }) => self.n.values[kinetic],
        }
    }

    /// The force on the first body of a unilateral constraint's contact (of a string, on its first end), for forces
    /// along gap and slide.
    fn on_first(&self, contacts: &ClosedContacts, i: usize, normal: f64, tangent: f64) -> Vec2 {
        let mut sum = Vec2::zero();
        let parts = [(Some(&contacts.gaps[i]), normal), (contacts.slides[i].as_ref(), tangent)];
        for (row, p) in parts.into_iter().filter_map(|(row, p)| row.map(|row| (row, p))) {
            sum += force_on_first(self.m, contacts.constraints[i], &row.motion) * p;
        }
        sum
    }

    /// Reactions of all joints to impulses: the balance of momentum of all that hangs on them.
    fn impulsive_loads(&self, contacts: &ClosedContacts, p: &[f64], jumps: &[Twist], lambda: &[f64]) -> Vec<JointLoad> {
        let momentum = |i: usize| {
            let arm = self.arms[i];
            super::momentum(self.at(), i, jumps[i].at(arm), jumps[i].w).seen_from(arm)
        };
        let mut unbalanced: Vec<Wrench> = (0..jumps.len()).map(|i| -momentum(i)).collect();
        for (i, &p) in p.iter().enumerate() {
            for &(body, load) in contacts.row(i).map_or(&[][..], |row| &row.motion) {
                unbalanced[body] += load * p;
            }
        }
        super::add_multipliers(&self.rows, lambda, &mut unbalanced);
        let joint_wrenches = joint_wrenches(self.at(), &unbalanced);
        SolvedView { joint_wrenches: &joint_wrenches, lambda, ..self.solved_view() }.joint_loads()
    }
}
