//! What unilateral constraints do in the last solution.

use super::contact_modes::force_on_first;
use super::rows::{gap_row, slide_row};
use super::{BodyWrenches, Row, SolvedView, Source, Workspace};
use crate::gauges::{Axis, ContactQuantity};
use crate::kinematics::{StateView, ValuesView};
use crate::mechanism::Friction;
use crate::mode::ContactMode;
use crate::plane::{Vec2, Wrench};
use crate::scalar::Scalar;
use crate::solve::{keep_above, Matrix};

impl Workspace<'_> {
    /// Where closed unilateral constraints can load each other, as a block jammed between walls, the least margin of
    /// all under the forces, of those that balance it, by which it is greatest: they hold as long as any forces hold
    /// them. What each unilateral constraint carries is not determined then. Of the last solution by
    /// [`Route::Minimal`](super::Route::Minimal), or of the motion alone; `most`, N, is enough.
    pub fn safest_margin(&self, most: f64) -> Option<f64> {
        let closed = |row: &Row| if let Source::Gap(l) = row.source { Some(l) } else { None };
        let constraints: Vec<usize> = self.rows.iter().filter_map(closed).collect();
        if constraints.is_empty() {
            return None;
        }
        let stress = self.dense.self_stress();
        if stress.cols() == 0 {
            return None;
        }
        let margins = |lambda: &[f64]| {
            let forces = SolvedView { lambda, ..self.solved_view() }.contact_forces();
            let of = |&l: &usize| self.margins(l, forces[l]);
            constraints.iter().flat_map(of).collect::<Vec<f64>>()
        };
        let column = |j: usize| (0..stress.rows()).map(|i| stress[(i, j)]).collect::<Vec<f64>>();
        let by: Vec<Vec<f64>> = (0..stress.cols()).map(|j| margins(&column(j))).collect();
        let now = margins(&self.solved.lambda);
        let a = Matrix::from_fn(now.len(), by.len(), |i, j| by[j][i]);
        Some(keep_above(&a, &now, most).1)
    }

    /// What must not fall below zero for a unilateral constraint to go on as it does under a force along its gap and
    /// its slide, N; of a couple the force at its lever.
    pub fn margins(&self, constraint: usize, [normal, tangent]: [f64; 2]) -> Vec<f64> {
        match (self.mode().contacts[constraint].mode, self.m.unilateral[constraint].friction) {
            (ContactMode::Stick, Some(Friction::Coulomb { fixed, .. })) => {
                let most = self.n.values[fixed] * normal;
                vec![normal, most - tangent, most + tangent]
            }
            _ => vec![normal / self.lever(constraint)],
        }
    }

    /// How a unilateral constraint is held, as one sees it: what is pressed sticks or slides, with friction.
    pub(super) fn mode_seen(&self, l: usize) -> ContactMode {
        match (
            self.mode().contacts[l].mode,
            self.m.joint_friction_of(l).map(|friction| self.mode().joint_friction[friction]),
        ) {
            (ContactMode::Compliant, Some(mode)) if mode != ContactMode::Open => mode,
            (mode, _) => mode,
        }
    }

    /// Power of all friction in the last solution, W; never positive.
    pub fn friction_power(&self) -> f64 {
        let friction =
            self.rows.iter().zip(&self.solved.lambda).filter(|(row, _)| matches!(row.source, Source::Gap(_)));
        let power = |loads: &BodyWrenches<f64>| -> f64 { loads.iter().map(|(b, w)| w.power(self.k.twist[*b])).sum() };
        let contacts: f64 = friction.filter_map(|(row, &l)| row.force.as_ref().map(|loads| l * power(loads))).sum();
        contacts + self.joint_friction_power()
    }

    /// The speed of sliding of a unilateral constraint at the present state, m/s; 0 where it cannot have friction.
    pub fn slide_rate(&self, constraint: usize) -> f64 {
        slide_row(self.at(), constraint, None).and_then(|row| row.rate).unwrap_or(0.0)
    }

    /// The speed at which a gap opens at the present state, m/s.
    pub fn gap_rate(&self, constraint: usize) -> f64 {
        gap_row(self.at(), constraint, None).rate.unwrap_or(0.0)
    }

    /// Accelerations of gaps in the last solution, those of angles at their levers, m/s².
    pub fn gap_accelerations(&self, constraints: &[usize]) -> Vec<f64> {
        let acceleration = |&l: &usize| gap_row(self.at(), l, Some(&self.solved.bodies)).bias * self.lever(l);
        constraints.iter().map(acceleration).collect()
    }

    /// The acceleration of sliding of a unilateral constraint in the last solution, m/s²; 0 where it cannot have friction.
    pub fn slide_acceleration(&self, constraint: usize) -> f64 {
        slide_row(self.at(), constraint, Some(&self.solved.bodies)).map_or(0.0, |row| row.bias)
    }

    /// The restitution of a unilateral constraint.
    pub fn restitution(&self, constraint: usize) -> f64 {
        self.n.values[self.m.unilateral[constraint].restitution]
    }

    /// Power of all springs with dampers of unilateral constraints at the present state, W.
    pub fn compliant_power(&self) -> f64 {
        compliant_contacts(self.at())
            .filter(|&l| !self.m.unilateral[l].is_conservative(self.m))
            .map(|l| compliant_force(self.at(), l) * gap_row(self.at(), l, None).rate.unwrap_or(0.0))
            .sum()
    }
}

/// The force of the spring and the damper of a unilateral constraint, N; below 0 where they would have to pull.
pub fn compliant_force<S: Scalar>(at: StateView<'_, S>, constraint: usize) -> S {
    let Some([stiffness, damping]) = at.m.unilateral[constraint].soft else { return S::zero() };
    let row = gap_row(at, constraint, None);
    let (gap, rate) = (row.value.unwrap_or(S::zero()), row.rate.unwrap_or(S::zero()));
    -at.n.values[stiffness] * gap - at.n.values[damping] * rate
}

/// Potential energy of all unilateral constraints on a spring without a damper that are pressed, J.
pub(super) fn compliant_potential<S: Scalar>(at: StateView<'_, S>) -> S {
    let mut sum = S::zero();
    for l in compliant_contacts(at).filter(|&l| at.m.unilateral[l].is_conservative(at.m)) {
        let Some(([stiffness, _], gap)) = at.m.unilateral[l].soft.zip(gap_row(at, l, None).value) else { continue };
        sum += (at.n.values[stiffness] * gap * gap).scale(0.5);
    }
    sum
}

fn compliant_contacts<S: Scalar>(at: StateView<'_, S>) -> impl Iterator<Item = usize> + '_ {
    (0..at.m.unilateral.len()).filter(move |&l| at.mode.contacts[l].mode == ContactMode::Compliant)
}

/// Adds the loads of all unilateral constraints with a spring that are pressed.
pub(super) fn add_compliant_forces<S: Scalar>(at: StateView<'_, S>, loads: &mut [Wrench<S>]) {
    for l in compliant_contacts(at) {
        let force = compliant_force(at, l);
        for (body, load) in gap_row(at, l, None).motion {
            loads[body] += load * force;
        }
    }
}

impl<S: Scalar> SolvedView<'_, S> {
    /// Of every unilateral constraint the force along its gap and its slide, N.
    pub fn contact_forces(&self) -> Vec<[S; 2]> {
        let (m, at) = (self.at.m, self.at);
        let mut forces = vec![[S::zero(); 2]; m.unilateral.len()];
        for (row, lambda) in self.multipliers() {
            match row.source {
                Source::Gap(l) => {
                    let friction = match (at.mode.contacts[l].mode, m.unilateral[l].friction) {
                        (ContactMode::Slip(sense), Some(Friction::Coulomb { kinetic, .. })) => {
                            at.n.values[kinetic].scale(-sense)
                        }
                        (ContactMode::PartialFriction(part), _) => S::of(part),
                        _ => S::zero(),
                    };
                    forces[l] = [lambda, forces[l][1] + friction * lambda];
                }
                Source::Friction(l) if at.mode.contacts[l].mode == ContactMode::Stick => forces[l][1] = lambda,
                _ => {}
            }
        }
        for l in compliant_contacts(at) {
            let friction = m.joint_friction_of(l).map_or(S::zero(), |friction| self.joint_friction_force(friction));
            forces[l] = [compliant_force(at, l), friction];
        }
        forces
    }

    /// Something of a contact, stop or string.
    pub(super) fn read_contact(&self, group: usize, quantity: ContactQuantity) -> S {
        let (m, at) = (self.at.m, self.at);
        let constraints = || m.groups[group].constraints.clone();
        let along = |i: usize| {
            let forces = self.contact_forces();
            constraints().fold(S::zero(), |sum, l| sum + forces[l][i])
        };
        match quantity {
            ContactQuantity::Gap => self.least_gap(group),
            ContactQuantity::Slip => {
                let sliding = constraints().find(|&l| at.mode.contacts[l].mode.touches());
                sliding.and_then(|l| slide_row(at, l, None)?.rate).unwrap_or(S::zero())
            }
            ContactQuantity::Force => along(0),
            ContactQuantity::Friction => along(1),
            ContactQuantity::OnFirst(axis) => component(self.force_on_first(group), axis),
            ContactQuantity::Place(axis) => component(self.resultant_at(group), axis),
        }
    }

    /// The least gap of a contact, each on whichever feature it now is, m; without bound where there is none.
    fn least_gap(&self, group: usize) -> S {
        let (m, at) = (self.at.m, self.at);
        let gap = |l: usize| {
            let (gap, last) = (&m.unilateral[l].gap, at.mode.contacts[l].feature);
            gap.gap(m, at.mode, &at, gap.feature(m, &ValuesView(at), last))
        };
        let least = |least: S, gap: S| S::select(gap.value() < least.value(), gap, least);
        m.groups[group].constraints.clone().map(gap).fold(S::of(f64::INFINITY), least)
    }

    /// The force of a contact on its first body, of a string on its first end, N, fixed axes.
    pub fn force_on_first(&self, group: usize) -> Vec2<S> {
        let (forces, at) = (self.contact_forces(), self.at);
        let mut sum = Vec2::zero();
        let acts = |l: &usize| forces[*l].iter().any(|force| force.value() != 0.0);
        for l in at.m.groups[group].constraints.clone().filter(acts) {
            let along = [Some(gap_row(at, l, None)), slide_row(at, l, None)];
            for (row, force) in along.into_iter().zip(forces[l]).filter_map(|(row, f)| row.map(|row| (row, f))) {
                sum += force_on_first(at.m, l, &row.motion) * force;
            }
        }
        sum
    }

    /// Where the resultant of a contact's normal forces acts; NaN where it does not touch.
    pub fn resultant_at(&self, group: usize) -> Vec2<S> {
        let (forces, mut sum, mut all) = (self.contact_forces(), Vec2::zero(), S::zero());
        for l in self.at.m.groups[group].constraints.clone() {
            let feature = self.at.mode.contacts[l].feature;
            if let Some(contact) = self.at.m.unilateral[l].gap.contact(self.at.m, &self.at, feature) {
                sum += contact.point * forces[l][0];
                all += forces[l][0];
            }
        }
        sum * (S::one() / all)
    }
}

fn component<S: Scalar>(v: Vec2<S>, axis: Axis) -> S {
    match axis {
        Axis::X => v.x,
        Axis::Y => v.y,
        _ => v.norm(),
    }
}
