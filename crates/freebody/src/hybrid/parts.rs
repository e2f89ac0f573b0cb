//! Parts that are released and engaged during a motion, and rates that are given at once.

use super::mode_changes::{Impulses, ModeChange};
use super::scales::NOTHING_LOST;
use super::HybridSystem;
use crate::dynamics::DynamicsError;
use crate::expr::Env;
use crate::gauges::ModelExpr;
use crate::kinematics::State;
use crate::mechanism::{Drive, DriveKind, EventAction, Part};
use crate::mode::{ContactMode, Mode};

impl HybridSystem<'_> {
    /// Releases and engages parts and resets rates, as the actions of an event ask.
    ///
    /// # Errors
    /// As [`HybridSystem::resolve_mode`].
    pub(super) fn switch_parts(
        &mut self,
        t: f64,
        y: &mut [f64],
        actions: &[EventAction],
    ) -> Result<bool, DynamicsError> {
        let (mut switched, mut engaged) = (false, vec![]);
        let before = self.stored(t, y);
        for action in actions {
            switched |= match action {
                EventAction::Release(part) => self.put(t, *part, false)?,
                EventAction::Engage(part) => {
                    let put = self.put(t, *part, true)?;
                    engaged.extend(put.then(|| self.workspace.m.name_of(*part).to_string()));
                    put
                }
                _ => false,
            };
        }
        if switched {
            self.begin_changed_phase(t, y, before);
        }
        switched |= self.reset(t, y, actions)?;
        if switched {
            self.close_engaged(t, y, engaged)?;
            self.resolve_mode(t, y, None, None)?;
        }
        Ok(switched)
    }

    /// # Errors
    /// As [`crate::dynamics::Workspace::check_axes`].
    fn put(&mut self, t: f64, part: Part, there: bool) -> Result<bool, DynamicsError> {
        let switched = self.workspace.switch_part(part, there);
        let changed = switched.is_some();
        if let Some(mode) = switched {
            self.mode = mode;
            self.workspace.enter(&self.mode);
            if let (true, Part::Joint(joint)) = (there, part) {
                self.workspace.check_axes(joint)?;
                self.workspace.check_free_lengths()?;
            }
            let of = vec![self.workspace.m.name_of(part).to_string()];
            let kind = if there { "engaged" } else { "released" };
            self.record(ModeChange { t, kind, of, lost: 0.0, states: None, impulses: None, note: None });
        }
        Ok(changed)
    }

    /// Notes where the locks of the present mode keep their gauges: those that held already where they did.
    pub(super) fn note_locks(&mut self) {
        let at = self.workspace.at();
        let locks = at.drives().filter(|(_, drive)| drive.kind == DriveKind::Lock);
        let kept = |d: usize| self.locks.iter().position(|&lock| lock == d).map(|i| self.locked[i].clone());
        let place = |(d, drive): (usize, &Drive)| {
            (d, kept(d).unwrap_or_else(|| (drive.of.clone(), drive.of.eval(&State(at) as &dyn Env<f64, _>))))
        };
        (self.locks, self.locked) = locks.map(place).unzip();
    }

    /// Gives gauges their new rates, with the least change of momentum; answers whether any was asked for. Motions keep
    /// theirs, and do the work that it takes.
    fn reset(&mut self, t: f64, y: &mut [f64], actions: &[EventAction]) -> Result<bool, DynamicsError> {
        let mut contact = vec![];
        for action in actions {
            if let EventAction::Reset { gauge, of, rate } = action {
                contact.push((gauge.clone(), of.clone(), self.read(&[rate], t, y)?[0]));
            }
        }
        if contact.is_empty() {
            return Ok(false);
        }
        let before = y.to_vec();
        // What stands on a floor may leave it.
        let lost = match self.reset_in(&self.mode.clone(), t, y, &contact) {
            Err(_) if self.mode.contacts.iter().any(|contact| contact.mode.carries()) => {
                self.reset_in(&self.with_unloaded_contacts(), t, y, &contact)?
            }
            lost => lost?,
        };
        self.place(t, y);
        let states = Some([before, y.to_vec()]);
        let of = contact.into_iter().map(|(gauge, ..)| gauge).collect();
        self.record_jump(ModeChange { t, kind: "reset", of, lost, states, impulses: None, note: None });
        Ok(true)
    }

    /// Gives gauges their new rates in a mode; returns the energy that it takes, J.
    fn reset_in(
        &mut self,
        mode: &Mode,
        t: f64,
        y: &mut [f64],
        given: &[(String, ModelExpr, f64)],
    ) -> Result<f64, DynamicsError> {
        let (n, before) = (self.workspace.m.freedom(), y.to_vec());
        self.place_in(mode, t, y);
        let energy = self.workspace.kinetic_energy();
        let (q, rest) = y.split_at_mut(n);
        self.workspace.project_velocities_with(t, q, &mut rest[..n], given)?;
        self.place_in(mode, t, y);
        if let Err(error) = self.workspace.check_rates(given, &before[n..2 * n]) {
            y.copy_from_slice(&before);
            return Err(error);
        }
        let after = self.workspace.kinetic_energy();
        if self.works.motions.is_empty() {
            return Ok(energy - after);
        }
        let works = self.workspace.drive_works_since(&before[n..2 * n], given)?;
        Ok(energy + self.add_drive_works(y, &works) - after)
    }

    /// The present mode with no load on what is closed.
    fn with_unloaded_contacts(&self) -> Mode {
        let mut mode = self.mode.clone();
        let carrying = mode.contacts_mut().iter_mut().filter(|contact| contact.mode.carries());
        carrying.for_each(|contact| contact.mode = ContactMode::ClosedUnloaded);
        mode
    }

    /// Lets what was engaged take hold: a plastic impact of the joints.
    fn close_engaged(&mut self, t: f64, y: &mut [f64], engaged: Vec<String>) -> Result<(), DynamicsError> {
        let n = self.workspace.m.freedom();
        self.place(t, y);
        let energy = self.workspace.kinetic_energy();
        // Unilateral constraints join in afterwards; the whole is the same impact, for what they do leaves the joints
        // closed.
        let mode = self.with_unloaded_contacts();
        self.workspace.enter(&mode);
        let impact = self.workspace.engagement_impact()?;
        let before = y.to_vec();
        y[n..2 * n].iter_mut().zip(&impact.change).for_each(|(u, d)| *u += d);
        self.place_in(&mode, t, y);
        if let Err(error) = self.workspace.check_rates(&[], &before[n..2 * n]) {
            y.copy_from_slice(&before);
            return Err(error);
        }
        self.place(t, y);
        let lost = energy + self.add_drive_works(y, &impact.drive_works) - self.workspace.kinetic_energy();
        if lost.abs() <= NOTHING_LOST * energy.max(self.strength * self.workspace.length) {
            return Ok(());
        }
        let joints = impact.joints.iter().map(|l| [l.force.x, l.force.y, l.couple]).collect();
        let (drives, drive_works, groups) = (impact.drives, impact.drive_works, vec![]);
        let impulses = Some(Impulses { groups, joints, drives, drive_works, contacts: vec![], unloaded: vec![], mode });
        let states = Some([before, y.to_vec()]);
        self.record_jump(ModeChange { t, kind: "impact", of: engaged, lost, states, impulses, note: None });
        Ok(())
    }
}
