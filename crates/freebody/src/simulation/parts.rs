//! Parts that are released and engaged during a motion, and rates that are given at once.

use super::changes::{Change, Impulses};
use super::Machine;
use crate::balance::Trouble;
use crate::mechanism::{Deed, Part};
use crate::mode::Hold;

impl Machine<'_> {
    /// Releases and engages parts and resets rates, as deeds ask.
    ///
    /// # Errors
    /// As [`Machine::settle`].
    pub(super) fn switch_parts(&mut self, t: f64, y: &mut [f64], deeds: &[Deed]) -> Result<bool, Trouble> {
        let (mut switched, mut engaged) = (false, vec![]);
        let before: f64 = self.energy(t, y).iter().sum();
        for deed in deeds {
            switched |= match deed {
                Deed::Release(part) => self.put(t, *part, false),
                Deed::Engage(part) => {
                    let put = self.put(t, *part, true);
                    engaged.extend(put.then(|| self.balance.m.name_of(*part).to_string()));
                    put
                }
                _ => false,
            };
        }
        let jump = self.energy(t, y).iter().sum::<f64>() - before;
        if jump != 0.0 {
            self.begin_stretch(t, jump, 0.0);
        }
        switched |= self.reset(t, y, deeds)?;
        if switched {
            self.close_up(t, y, engaged)?;
            self.settle(t, y)?;
        }
        Ok(switched)
    }

    fn put(&mut self, t: f64, part: Part, there: bool) -> bool {
        let changed = self.balance.put(part, there);
        if changed {
            let of = vec![self.balance.m.name_of(part).to_string()];
            let kind = if there { "engaged" } else { "released" };
            self.note(Change { t, kind, of, lost: 0.0, states: None, impulses: None, note: None });
        }
        changed
    }

    /// Gives gauges their new rates, with the least change of momentum; answers whether any was asked for.
    fn reset(&mut self, t: f64, y: &mut [f64], deeds: &[Deed]) -> Result<bool, Trouble> {
        let n = self.balance.m.freedom();
        let mut held = vec![];
        for deed in deeds {
            if let Deed::Reset { gauge, of, rate } = deed {
                held.push((gauge.clone(), of.clone(), self.read(&[rate], t, y)?[0]));
            }
        }
        if held.is_empty() {
            return Ok(false);
        }
        let before = y.to_vec();
        self.place(t, y);
        let energy = self.balance.kinetic_energy();
        let (q, rest) = y.split_at_mut(n);
        self.balance.align_with(t, q, &mut rest[..n], &held)?;
        self.place(t, y);
        let lost = energy - self.balance.kinetic_energy();
        let states = Some([before, y.to_vec()]);
        let of = held.into_iter().map(|(gauge, ..)| gauge).collect();
        self.note_jump(Change { t, kind: "reset", of, lost, states, impulses: None, note: None });
        Ok(true)
    }

    /// Lets what was engaged take hold: a plastic impact of the joints.
    fn close_up(&mut self, t: f64, y: &mut [f64], engaged: Vec<String>) -> Result<(), Trouble> {
        let n = self.balance.m.freedom();
        self.place(t, y);
        let energy = self.balance.kinetic_energy();
        // Limits join in afterwards; the whole is the same impact, for what they do leaves the joints closed.
        let mut limits = std::mem::take(&mut self.balance.mode.limits);
        let held = limits.clone();
        limits.iter_mut().filter(|h| h.hold.carries()).for_each(|h| h.hold = Hold::Idle);
        self.balance.mode.limits = limits;
        let blow = self.balance.joining_blow()?;
        let mode = self.balance.mode.clone();
        self.balance.mode.limits = held;
        let before = y.to_vec();
        y[n..2 * n].iter_mut().zip(&blow.change).for_each(|(u, d)| *u += d);
        self.place(t, y);
        let lost = energy - self.balance.kinetic_energy();
        if lost.abs() <= 1e-14 * energy {
            return Ok(());
        }
        let joints = blow.joints.iter().map(|l| [l.force.x, l.force.y, l.couple]).collect();
        let impulses = Some(Impulses { limits: vec![], joints, struck: vec![], spared: vec![], mode });
        let states = Some([before, y.to_vec()]);
        self.note_jump(Change { t, kind: "impact", of: engaged, lost, states, impulses, note: None });
        Ok(())
    }
}
