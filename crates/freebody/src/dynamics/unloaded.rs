//! Unilateral constraints that are closed and carry nothing, but could: a taut string at no tension, a contact without
//! pressure.

use super::contact_decision::CLOSE;
use super::contact_modes::REST;
use super::rows::slide_row;
use super::{DynamicsError, Route, Workspace};
use crate::contact::complementarity::FrictionLaw;
use crate::mode::ContactMode;

impl Workspace<'_> {
    /// Enters the present mode with what could carry a load by itself held closed, its force being 0 by the balances, and
    /// answers what that is. What others hold closed as well stays without load: how they would share it is not
    /// determined.
    ///
    /// # Errors
    /// As [`Workspace::solve`].
    pub fn hold_unloaded(&mut self) -> Result<Vec<usize>, DynamicsError> {
        let mut held = vec![];
        let is_unloaded = |l: &usize| self.mode().contacts[*l].mode == ContactMode::ClosedUnloaded;
        for l in (0..self.m.unilateral.len()).filter(is_unloaded).collect::<Vec<_>>() {
            self.solve_by(Route::Minimal)?;
            let (alone, superfluous) = (self.mode().clone(), self.superfluous_rows());
            let Some(mode) = self.mode_under_load(l) else { continue };
            self.enter(&alone.with_contacts(&[l], mode));
            held.push(l);
            let holds = self.solve_by(Route::Minimal).is_ok() && self.superfluous_rows() == superfluous;
            if !(holds && self.carry_nothing(&held)) {
                held.pop();
                self.enter(&alone);
            }
        }
        Ok(held)
    }

    /// Whether the forces of unilateral constraints in the last solution are round-off, beside the loads and beside what moves the
    /// masses. What carries a load at the present rates, in a mode that it has from others, is not without load.
    fn carry_nothing(&mut self, held: &[usize]) -> bool {
        let rate = self.natural_rate();
        let inertial = self.n.mass.iter().sum::<f64>() * self.length * rate * rate;
        let (forces, most) = (self.solved_view().contact_forces(), self.term_scales().load.max(inertial));
        let size = |l: usize| (forces[l][0] / self.lever(l)).abs().max(forces[l][1].abs());
        held.iter().all(|&l| size(l) <= CLOSE * most)
    }

    /// How a unilateral constraint would be held under load in the last solution; None where that is not known.
    fn mode_under_load(&mut self, l: usize) -> Option<ContactMode> {
        let slides = slide_row(self.at(), l, Some(&self.solved.bodies)).map_or(0.0, |row| row.bias);
        let rate = self.natural_rate();
        let is_slow = slides.abs() <= CLOSE * rate * rate * self.length;
        match self.friction_law(l, self.slide_rate(l), REST * self.length * rate) {
            FrictionLaw::Frictionless => Some(ContactMode::Frictionless),
            FrictionLaw::Sliding { sense, .. } => Some(ContactMode::Slip(sense)),
            FrictionLaw::Rough | FrictionLaw::Resting { .. } if is_slow => Some(ContactMode::Stick),
            FrictionLaw::Resting { .. } => Some(ContactMode::Slip(slides.signum())),
            FrictionLaw::Rough => None,
        }
    }

    /// Rows of the last solution that follow from the others.
    fn superfluous_rows(&self) -> usize {
        self.rows.len() - if self.rows.is_empty() { 0 } else { self.dense.saddle.rank().rank }
    }
}
