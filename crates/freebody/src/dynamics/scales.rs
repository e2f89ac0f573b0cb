//! The mechanism's own length and rate, by which is judged what is long, near, fast and small.

use super::tree_matrices::column_scales;
use super::Workspace;
use crate::bound_values::BoundValues;
use crate::mechanism::{FrictionSource, Mechanism};

/// Part of the way of a motion within which bodies are in one place.
const ONE_PLACE: f64 = 1e-12;
/// Part of the largest term that what is left of an acceleration has to exceed: below it what balances is off by round-off.
const BALANCED: f64 = 1e-12;

impl Mechanism {
    /// The median distance of the places from their bodies' joint origins; else of the lengths that the model tells, m.
    pub(super) fn characteristic_length(&self, n: &BoundValues) -> Option<f64> {
        median_length(n.arms.iter().chain(&n.centre).map(|arm| arm.norm()))
            .or_else(|| median_length(self.lengths.iter().map(|&id| n.values[id].abs())))
    }
}

/// The median of those that are lengths, m.
fn median_length(lengths: impl Iterator<Item = f64>) -> Option<f64> {
    let mut lengths: Vec<f64> = lengths.filter(|&l| l.is_finite() && l > 0.0).collect();
    lengths.sort_by(f64::total_cmp);
    lengths.get(lengths.len() / 2).copied()
}

impl Workspace<'_> {
    /// The median radius of gyration of the bodies; else their median distance from the origin at the present state, m; None where all
    /// are particles there.
    pub(super) fn extent(&self) -> Option<f64> {
        let turning = (1..self.m.bodies.len()).filter(|&i| !self.m.bodies[i].particle);
        median_length(turning.map(|i| (self.n.inertia[i] / self.n.mass[i]).sqrt()))
            .or_else(|| median_length(self.k.pose[1..].iter().map(|pose| pose.at.norm())))
    }

    /// What makes a length of the gap of unilateral constraint `l`, where that is an angle, and a force of its couple: the
    /// characteristic length; else 1.
    pub fn lever(&self, l: usize) -> f64 {
        if self.turning_gaps[l] {
            self.length
        } else {
            1.0
        }
    }

    /// The same for what has friction in a joint.
    pub fn friction_lever(&self, friction: usize) -> f64 {
        match self.m.joint_friction[friction].of {
            FrictionSource::Joint { radius: Some(_), .. } => self.length,
            _ => 1.0,
        }
    }

    /// Where the mechanism has no length, and its bodies are apart by round-off of its way within a time, s, takes the
    /// length of that way.
    pub fn take_length_of_motion(&mut self, time: f64) {
        if self.m.characteristic_length(&self.n).is_some() {
            return;
        }
        let accelerations = self.accelerations_unheld();
        let shifts = (0..self.placed.u.len()).filter(|&i| self.m.coordinate(i).dimension == "m");
        let ways = shifts.map(|i| time * (self.placed.u[i].abs() + time * accelerations[i].abs()));
        if let Some(way) = median_length(ways).filter(|way| self.extent().is_none_or(|apart| apart < ONE_PLACE * way)) {
            self.length = way;
        }
    }

    /// A large change of each coordinate at the present state: what turns by a radian, or shifts by the characteristic
    /// length.
    pub fn units(&self) -> Vec<f64> {
        column_scales(self.at(), self.length).collect()
    }

    /// The fastest rate at the present state, 1/s: of the coordinates, by their accelerations, or of a fall by gravity,
    /// in radians and characteristic lengths.
    pub fn natural_rate(&mut self) -> f64 {
        let (accelerations, units) = (self.accelerations_unheld(), self.units());
        let falls = accelerations.iter().zip(&units).map(|(a, unit)| (a.abs() / unit).sqrt());
        falls.fold(self.rate_of_motion(), f64::max)
    }

    /// The fastest of these without the accelerations.
    pub(super) fn rate_of_motion(&self) -> f64 {
        let (units, fall) = (self.units(), (self.n.gravity.norm() / self.length).sqrt());
        self.placed.u.iter().zip(units).map(|(u, unit)| u.abs() / unit).fold(fall, f64::max)
    }

    /// Accelerations of the coordinates at the present state in the present mode; 0 where there are none, but for round-off.
    fn accelerations_unheld(&mut self) -> Vec<f64> {
        let mut accelerations = vec![0.0; self.placed.u.len()];
        if self.solve_reactions().is_err() {
            return accelerations;
        }
        self.accelerations(&mut accelerations);
        let least = BALANCED * self.term_scales().acceleration / self.length;
        let moves = |a: f64, unit: f64| a.is_finite() && a.abs() > least * unit;
        accelerations.iter().zip(self.units()).map(|(&a, unit)| if moves(a, unit) { a } else { 0.0 }).collect()
    }
}
