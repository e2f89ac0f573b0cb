//! What unilateral constraints do in the last solution.

use super::contact_modes::force_on_first;
use super::rows::{gap_row, slide_row};
use super::{BodyWrenches, Row, Source, Workspace};
use crate::gauges::{Axis, ContactQuantity};
use crate::mechanism::Friction;
use crate::mode::ContactMode;
use crate::plane::Vec2;
use crate::solve::{keep_above, Matrix};

impl Workspace<'_> {
    /// Of every unilateral constraint the force along its gap and its slide in the last solution, N.
    pub fn contact_forces(&self) -> Vec<[f64; 2]> {
        self.forces_of(&self.solved.lambda)
    }

    /// Where closed unilateral constraints can load each other, as a block jammed between walls, the least margin of
    /// all under the forces, of those that balance it, by which it is greatest: they hold as long as any forces hold
    /// them. What each unilateral constraint carries is not determined then. Of the last solution by
    /// [`Route::Minimal`](super::Route::Minimal); `most`, N, is enough.
    pub fn safest_margin(&self, most: f64) -> Option<f64> {
        let closed = |row: &Row| if let Source::Gap(l) = row.source { Some(l) } else { None };
        let constraints: Vec<usize> = self.rows.iter().filter_map(closed).collect();
        if constraints.is_empty() || self.rows.len() <= self.m.freedom() - self.dense.saddle.dof() {
            return None;
        }
        let stress = self.dense.saddle.self_stress();
        if stress.cols() == 0 {
            return None;
        }
        let margins = |lambda: &[f64]| {
            let forces = self.forces_of(lambda);
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

    /// The forces of all unilateral constraints by multipliers of the present rows.
    fn forces_of(&self, lambda: &[f64]) -> Vec<[f64; 2]> {
        let mut forces = vec![[0.0; 2]; self.m.unilateral.len()];
        for (row, &lambda) in self.rows.iter().zip(lambda) {
            match row.source {
                Source::Gap(l) => {
                    let friction = match (self.mode().contacts[l].mode, self.m.unilateral[l].friction) {
                        (ContactMode::Slip(sense), Some(Friction::Coulomb { kinetic, .. })) => {
                            -sense * self.n.values[kinetic]
                        }
                        (ContactMode::PartialFriction(part), _) => part,
                        _ => 0.0,
                    };
                    forces[l] = [lambda, forces[l][1] + friction * lambda];
                }
                Source::Friction(l) if self.mode().contacts[l].mode == ContactMode::Stick => forces[l][1] = lambda,
                _ => {}
            }
        }
        for l in self.compliant_contacts() {
            forces[l] = [
                self.compliant_force(l),
                self.m.joint_friction_of(l).map_or(0.0, |friction| self.joint_friction_force(friction)),
            ];
        }
        forces
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

    /// The restitution of a unilateral constraint.
    pub fn restitution(&self, constraint: usize) -> f64 {
        self.n.values[self.m.unilateral[constraint].restitution]
    }

    /// Something of a contact, stop or string.
    pub(super) fn read_contact(&self, group: usize, bound: ContactQuantity) -> f64 {
        let constraints = || self.m.groups[group].constraints.clone();
        let closed = |l: &usize| self.mode().contacts[*l].mode.touches();
        match bound {
            ContactQuantity::Gap => constraints().map(|l| self.open_gap(l)).fold(f64::INFINITY, f64::min),
            ContactQuantity::Slip => constraints().filter(closed).map(|l| self.slide_rate(l)).next().unwrap_or(0.0),
            ContactQuantity::Force => constraints().map(|l| self.contact_forces()[l][0]).sum(),
            ContactQuantity::Friction => constraints().map(|l| self.contact_forces()[l][1]).sum(),
            ContactQuantity::OnFirst(axis) => component(self.force_on_first(group), axis),
            ContactQuantity::Place(axis) => component(self.resultant_at(group), axis),
        }
    }

    /// The force of a contact on its first body, of a string on its first end, N, fixed axes.
    pub fn force_on_first(&self, group: usize) -> Vec2 {
        let (forces, at) = (self.contact_forces(), self.at());
        let mut sum = Vec2::zero();
        for l in self.m.groups[group].constraints.clone().filter(|&l| forces[l] != [0.0; 2]) {
            let along = [Some(gap_row(at, l, None)), slide_row(at, l, None)];
            for (row, force) in along.into_iter().zip(forces[l]).filter_map(|(row, f)| row.map(|row| (row, f))) {
                sum += force_on_first(self.m, l, &row.motion) * force;
            }
        }
        sum
    }

    /// The force of the spring and the damper of a unilateral constraint at the present state, N; below 0 where they
    /// would have to pull.
    pub fn compliant_force(&self, constraint: usize) -> f64 {
        let Some([stiffness, damping]) = self.m.unilateral[constraint].soft else { return 0.0 };
        let row = gap_row(self.at(), constraint, None);
        let (gap, rate) = (row.value.unwrap_or(0.0), row.rate.unwrap_or(0.0));
        -self.n.values[stiffness] * gap - self.n.values[damping] * rate
    }

    fn compliant_contacts(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.m.unilateral.len()).filter(|&l| self.mode().contacts[l].mode == ContactMode::Compliant)
    }

    /// Adds the loads of all unilateral constraints that are pressed.
    pub(super) fn add_compliant_forces(&mut self) {
        for l in self.compliant_contacts().collect::<Vec<_>>() {
            let force = self.compliant_force(l);
            for (body, load) in gap_row(self.at(), l, None).motion {
                self.loads[body] += load * force;
            }
        }
    }

    /// Power of all springs and dampers of unilateral constraints at the present state, W.
    pub fn compliant_power(&self) -> f64 {
        self.compliant_contacts()
            .map(|l| self.compliant_force(l) * gap_row(self.at(), l, None).rate.unwrap_or(0.0))
            .sum()
    }

    /// Where the resultant of a contact's normal forces acts; NaN where it does not touch.
    pub fn resultant_at(&self, group: usize) -> Vec2 {
        let (forces, mut sum, mut all) = (self.contact_forces(), Vec2::zero(), 0.0);
        for l in self.m.groups[group].constraints.clone() {
            let feature = self.mode().contacts[l].feature;
            if let Some(contact) = self.m.unilateral[l].gap.contact(self.m, &self.at(), feature) {
                sum += contact.point * forces[l][0];
                all += forces[l][0];
            }
        }
        sum * (1.0 / all)
    }
}

fn component(v: Vec2, axis: Axis) -> f64 {
    match axis {
        Axis::X => v.x,
        Axis::Y => v.y,
        _ => v.norm(),
    }
}
