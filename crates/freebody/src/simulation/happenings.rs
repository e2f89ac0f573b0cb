//! What events do, and what a switching function is about.

use super::guards::{GUARDS, RUB_GUARDS};
use super::Machine;
use crate::balance::{Source, Trouble};
use crate::mechanism::{Deed, Event, Kink, Mechanism};

impl Machine<'_> {
    /// What switching function `i` is about, in the model's words.
    pub fn switch_name(m: &Mechanism, i: usize) -> String {
        if let Some(event) = m.events.get(i) {
            return format!("event `{}`", event.name);
        }
        let Some(guard) = (i - m.events.len()).checked_sub(m.kinks.len()) else { return "kink of a law".to_string() };
        match guard.checked_sub(GUARDS * m.limits.len()) {
            None => {
                let group = &m.groups[m.limits[guard / GUARDS].group];
                format!("{} `{}`", group.word, group.name)
            }
            Some(rub) => format!("friction of `{}`", Source::Rub(rub / RUB_GUARDS).name(m)),
        }
    }

    /// Whether all that an event would release is gone already.
    pub(super) fn is_spent(&self, event: &Event) -> bool {
        let gone = |deed: &Deed| matches!(deed, Deed::Release(part) if !self.balance.has(*part));
        event.then.iter().any(|deed| matches!(deed, Deed::Release(_))) && event.then.iter().all(gone)
    }

    /// Takes the other arm of a switch.
    pub(super) fn turn(&mut self, kink: &Kink, t: f64) {
        if let Kink::Switch(switch, _) = kink {
            let arm = self.balance.mode.arm(*switch).unwrap_or(true);
            self.balance.mode.freeze(*switch, !arm);
        }
        self.begin_stretch(t, 0.0, 0.0);
    }

    /// Does what an event asks for; answers whether the motion changes by it.
    pub(super) fn happen(&mut self, event: &Event, t: f64, y: &mut [f64]) -> Result<bool, Trouble> {
        let mut values = vec![];
        for deed in &event.then {
            if let Deed::Set(p, law) = deed {
                values.push((*p, self.read(&[law], t, y)?[0]));
            }
        }
        if !values.is_empty() {
            self.change(t, y, &values);
            if !(self.balance.m.limits.is_empty() && self.balance.m.rubs.is_empty()) {
                self.settle(t, y)?;
            }
        }
        let switched = self.switch_parts(t, y, &event.then)?;
        Ok(switched || !values.is_empty())
    }

    /// Sets parameters, lets the others follow, and notes the energy that the change put in.
    pub(super) fn change(&mut self, t: f64, y: &[f64], values: &[(usize, f64)]) {
        let before: f64 = self.energy(t, y).iter().sum();
        for &(i, x) in values {
            self.set.retain(|(j, _)| *j != i);
            self.set.push((i, x));
        }
        let p = self.balance.m.parameters_with(&self.set);
        self.balance.rebind(&p);
        let jump = self.energy(t, y).iter().sum::<f64>() - before;
        self.begin_stretch(t, jump, 0.0);
    }
}
