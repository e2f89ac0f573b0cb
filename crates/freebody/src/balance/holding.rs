//! What limits do in the last solution.

use super::limits::force_on_first;
use super::rows::{gap_row, slide_row};
use super::{Balance, Row, Source, Spread};
use crate::gauges::{Axis, Bound};
use crate::mechanism::Friction;
use crate::mode::Hold;
use crate::plane::Vec2;
use crate::solve::{keep_above, Matrix};

impl Balance<'_> {
    /// Of every limit the force along its gap and its slide in the last solution, N.
    pub fn limit_forces(&self) -> Vec<[f64; 2]> {
        self.forces_of(&self.solved.lambda)
    }

    /// Where closed limits can load each other, as a block jammed between walls, the least margin of all under the forces,
    /// of those that balance it, by which it is greatest: they hold as long as any forces hold them. What each limit carries
    /// is not determined then. Of the last solution by [`Route::Minimal`](super::Route::Minimal); `most`, N, is enough.
    pub fn safest_margin(&self, most: f64) -> Option<f64> {
        let closed = |row: &Row| if let Source::Limit(l) = row.source { Some(l) } else { None };
        let limits: Vec<usize> = self.rows.iter().filter_map(closed).collect();
        if limits.is_empty() || self.rows.len() <= self.m.freedom() - self.dense.saddle.dof() {
            return None;
        }
        let stress = self.dense.saddle.self_stress();
        if stress.cols() == 0 {
            return None;
        }
        let margins = |lambda: &[f64]| {
            let forces = self.forces_of(lambda);
            let of = |&l: &usize| self.margins(l, forces[l]);
            limits.iter().flat_map(of).collect::<Vec<f64>>()
        };
        let column = |j: usize| (0..stress.rows()).map(|i| stress[(i, j)]).collect::<Vec<f64>>();
        let by: Vec<Vec<f64>> = (0..stress.cols()).map(|j| margins(&column(j))).collect();
        let now = margins(&self.solved.lambda);
        let a = Matrix::from_fn(now.len(), by.len(), |i, j| by[j][i]);
        Some(keep_above(&a, &now, most).1)
    }

    /// What must not fall below zero for a limit to go on as it does under a force along its gap and its slide, N.
    pub fn margins(&self, limit: usize, [normal, tangent]: [f64; 2]) -> Vec<f64> {
        match (self.mode.limits[limit].hold, self.m.limits[limit].friction) {
            (Hold::Stuck, Some(Friction::Coulomb { fixed, .. })) => {
                let most = self.n.slots[fixed] * normal;
                vec![normal, most - tangent, most + tangent]
            }
            _ => vec![normal],
        }
    }

    /// The forces of all limits by multipliers of the present rows.
    fn forces_of(&self, lambda: &[f64]) -> Vec<[f64; 2]> {
        let mut forces = vec![[0.0; 2]; self.m.limits.len()];
        for (row, &lambda) in self.rows.iter().zip(lambda) {
            match row.source {
                Source::Limit(l) => {
                    let rub = match (self.mode.limits[l].hold, self.m.limits[l].friction) {
                        (Hold::Sliding(sense), Some(Friction::Coulomb { kinetic, .. })) => {
                            -sense * self.n.slots[kinetic]
                        }
                        (Hold::Leaning(part), _) => part,
                        _ => 0.0,
                    };
                    forces[l] = [lambda, forces[l][1] + rub * lambda];
                }
                Source::Friction(l) if self.mode.limits[l].hold == Hold::Stuck => forces[l][1] = lambda,
                _ => {}
            }
        }
        for l in self.pressed() {
            forces[l] = [self.press(l), self.m.rub_of(l).map_or(0.0, |rub| self.rub_force(rub))];
        }
        forces
    }

    /// How a limit is held, as one sees it: what is pressed sticks or slides, if it rubs.
    pub(super) fn hold_seen(&self, l: usize) -> Hold {
        match (self.mode.limits[l].hold, self.m.rub_of(l).map(|rub| self.mode.rubs[rub])) {
            (Hold::Pressed, Some(hold)) if hold != Hold::Open => hold,
            (hold, _) => hold,
        }
    }

    /// Power of all friction in the last solution, W; never positive.
    pub fn friction_power(&self) -> f64 {
        let rubs = self.rows.iter().zip(&self.solved.lambda).filter(|(row, _)| matches!(row.source, Source::Limit(_)));
        let power = |loads: &Spread<f64>| -> f64 { loads.iter().map(|(b, w)| w.power(self.k.twist[*b])).sum() };
        let contacts: f64 = rubs.filter_map(|(row, &l)| row.force.as_ref().map(|loads| l * power(loads))).sum();
        contacts + self.rub_power()
    }

    /// The speed of sliding of a limit at the present state, m/s; 0 where it cannot rub.
    pub fn slide_rate(&self, limit: usize) -> f64 {
        slide_row(self.at(), limit, None).and_then(|row| row.rate).unwrap_or(0.0)
    }

    /// The speed at which a gap opens at the present state, m/s.
    pub fn gap_rate(&self, limit: usize) -> f64 {
        gap_row(self.at(), limit, None).rate.unwrap_or(0.0)
    }

    /// Accelerations of gaps in the last solution, m/s².
    pub fn gap_accelerations(&self, limits: &[usize]) -> Vec<f64> {
        limits.iter().map(|&l| gap_row(self.at(), l, Some(&self.solved.bodies)).bias).collect()
    }

    /// The restitution of a limit.
    pub fn restitution(&self, limit: usize) -> f64 {
        self.n.slots[self.m.limits[limit].restitution]
    }

    /// Something of a contact, stop or string.
    pub(super) fn read_limit(&self, group: usize, bound: Bound) -> f64 {
        let limits = || self.m.groups[group].limits.clone();
        let closed = |l: &usize| self.mode.limits[*l].hold.touches();
        match bound {
            Bound::Gap => limits().map(|l| self.open_gap(l)).fold(f64::INFINITY, f64::min),
            Bound::Slip => limits().filter(closed).map(|l| self.slide_rate(l)).next().unwrap_or(0.0),
            Bound::Force => limits().map(|l| self.limit_forces()[l][0]).sum(),
            Bound::Friction => limits().map(|l| self.limit_forces()[l][1]).sum(),
            Bound::OnFirst(axis) => component(self.force_on_first(group), axis),
            Bound::Place(axis) => component(self.resultant_at(group), axis),
        }
    }

    /// The force of a contact on its first body, of a string on its first end, N, fixed axes.
    pub fn force_on_first(&self, group: usize) -> Vec2 {
        let (forces, at) = (self.limit_forces(), self.at());
        let mut sum = Vec2::zero();
        for l in self.m.groups[group].limits.clone().filter(|&l| forces[l] != [0.0; 2]) {
            let along = [Some(gap_row(at, l, None)), slide_row(at, l, None)];
            for (row, force) in along.into_iter().zip(forces[l]).filter_map(|(row, f)| row.map(|row| (row, f))) {
                sum += force_on_first(self.m, l, &row.motion) * force;
            }
        }
        sum
    }

    /// The force of the spring and the damper of a limit at the present state, N; below 0 where they would have to pull.
    pub fn press(&self, limit: usize) -> f64 {
        let Some([stiffness, damping]) = self.m.limits[limit].soft else { return 0.0 };
        let row = gap_row(self.at(), limit, None);
        let (gap, rate) = (row.value.unwrap_or(0.0), row.rate.unwrap_or(0.0));
        -self.n.slots[stiffness] * gap - self.n.slots[damping] * rate
    }

    fn pressed(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.m.limits.len()).filter(|&l| self.mode.limits[l].hold == Hold::Pressed)
    }

    /// Adds the loads of all limits that are pressed.
    pub(super) fn add_pressed(&mut self) {
        for l in self.pressed().collect::<Vec<_>>() {
            let force = self.press(l);
            for (body, load) in gap_row(self.at(), l, None).motion {
                self.loads[body] += load * force;
            }
        }
    }

    /// Power of all springs and dampers of limits at the present state, W.
    pub fn pressed_power(&self) -> f64 {
        self.pressed().map(|l| self.press(l) * gap_row(self.at(), l, None).rate.unwrap_or(0.0)).sum()
    }

    /// Where the resultant of a contact's normal forces acts; NaN where it does not touch.
    pub fn resultant_at(&self, group: usize) -> Vec2 {
        let (forces, mut sum, mut all) = (self.limit_forces(), Vec2::zero(), 0.0);
        for l in self.m.groups[group].limits.clone() {
            let piece = self.mode.limits[l].piece;
            if let Some(contact) = self.m.limits[l].gap.contact(self.m, &self.at(), piece) {
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
