//! Unilateral constraints that are closed and carry nothing, but could: a taut string at no tension, a contact without
//! pressure.

use super::contact_modes::{CLOSE, REST};
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
            match self.solve_by(Route::Minimal).is_ok() && self.superfluous_rows() == superfluous {
                true => held.push(l),
                false => self.enter(&alone),
            }
        }
        Ok(held)
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
        self.rows.len() - self.dense.saddle.rank().rank
    }
}
