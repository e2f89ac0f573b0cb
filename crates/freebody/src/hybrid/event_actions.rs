//! What events do.

use super::guards::SwitchingFunction;
use super::HybridSystem;
use crate::dynamics::DynamicsError;
use crate::mechanism::{Event, EventAction};
use crate::motion::After;

impl HybridSystem<'_> {
    /// What happens at a zero of a switching function.
    pub(super) fn act_on(&mut self, i: usize, t: f64, y: &mut [f64]) -> Result<After, DynamicsError> {
        let m = self.workspace.m;
        let event = match self.switching_functions[i] {
            SwitchingFunction::Event(event) => &m.events[event],
            SwitchingFunction::Discontinuity(discontinuity) => {
                self.switch_branch(&m.discontinuities[discontinuity], t);
                return Ok(After::Restart);
            }
            SwitchingFunction::Contact(l, guard) => {
                self.switch_contact(l, guard, t, y)?;
                return Ok(After::Restart);
            }
            SwitchingFunction::JointFriction(friction, sense) => {
                self.switch_joint_friction(friction, sense, t, y)?;
                return Ok(After::Restart);
            }
        };
        let changed = self.perform_actions(event, t, y)?;
        let stops = event.then.iter().any(|d| matches!(d, EventAction::Stop));
        Ok(match (stops, changed) {
            (true, _) => After::Stop,
            (_, false) => After::Continue,
            _ => After::Restart,
        })
    }

    /// Whether all that an event would release is gone already.
    pub(super) fn is_spent(&self, event: &Event) -> bool {
        let mut actions = event.then.iter();
        let is_gone = |action: &EventAction| match action {
            EventAction::Release(part) => !self.mode.is_in_place(self.workspace.m, *part),
            _ => false,
        };
        !event.then.is_empty() && actions.all(is_gone)
    }

    /// Does what an event asks for; answers whether the motion changes by it.
    pub(super) fn perform_actions(&mut self, event: &Event, t: f64, y: &mut [f64]) -> Result<bool, DynamicsError> {
        let mut values = vec![];
        for action in &event.then {
            if let EventAction::Set(p, law) = action {
                values.push((*p, self.read(&[law], t, y)?[0]));
            }
        }
        if !values.is_empty() {
            let first = self.workspace.m.first_state();
            let (parameters, states): (Vec<_>, Vec<_>) = values.iter().partition(|(p, _)| *p < first);
            for (p, x) in states {
                y[self.first_state() + p - first] = x;
            }
            self.change(t, y, &parameters);
            if !(self.workspace.m.unilateral.is_empty() && self.workspace.m.joint_friction.is_empty()) {
                self.resolve_mode(t, y, None, None)?;
            }
        }
        let switched = self.switch_parts(t, y, &event.then)?;
        Ok(switched || !values.is_empty())
    }

    /// Sets parameters, lets the others follow, and notes the energy that the change put in.
    pub(super) fn change(&mut self, t: f64, y: &[f64], values: &[(usize, f64)]) {
        let before = self.stored(t, y);
        for &(i, x) in values {
            self.set.retain(|(j, _)| *j != i);
            self.set.push((i, x));
        }
        let p = self.workspace.m.parameters_with(&self.set);
        self.workspace.rebind(&p);
        self.recorded = None;
        self.begin_changed_phase(t, y, before);
    }
}
