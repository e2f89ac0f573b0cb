//! What switched: the record of a motion's modes.

use super::Machine;
use crate::balance::{Source, Trouble};
use crate::mode::{Hold, Mode};
use crate::plane::Vec2;

/// Something that switched.
#[derive(Clone, Debug)]
pub struct Change {
    /// When, s.
    pub t: f64,
    /// One word: `impact`, `taut`, `lift-off`, `slack`, `contact`, `slip`, `stick`, `rest`, `released`, `engaged`, `reset`.
    pub kind: &'static str,
    /// The contacts, stops, strings or parts concerned, by name.
    pub of: Vec<String>,
    /// Energy that it took, J.
    pub lost: f64,
    /// State vectors before and after, where it jumped.
    pub states: Option<[Vec<f64>; 2]>,
    /// Impulses, where there was a blow.
    pub impulses: Option<Impulses>,
    /// What else is to be said.
    pub note: Option<String>,
}

/// The impulses of a blow.
#[derive(Clone, Debug)]
pub struct Impulses {
    /// On the first body of each contact (the first end of a string), with its name, N·s.
    pub limits: Vec<(String, Vec2)>,
    /// Of each joint on its second body, N·s and N·m·s about its point.
    pub joints: Vec<[f64; 3]>,
    /// Each limit with an impulse.
    pub struck: Vec<Struck>,
    /// Contacts, stops and strings that were reached, and that what was struck acts on, but that would have had to pull.
    pub spared: Vec<String>,
    /// What was in place, with what was struck held as it was held during the blow.
    pub mode: Mode,
}

/// The impulse of a limit, one of a contact's, a stop's or a string's.
#[derive(Clone, Debug)]
pub struct Struck {
    /// The name of the contact, stop or string.
    pub name: String,
    /// Along the gap, N·s (N·m·s at an angle).
    pub normal: f64,
    /// Along the slide, N·s.
    pub tangent: f64,
    /// The coefficient of restitution.
    pub restitution: f64,
}

impl Machine<'_> {
    /// Notes what changed of the mode, and begins another stretch.
    pub(super) fn take_mode(&mut self, t: f64, before: &crate::mode::Mode) -> Result<(), Trouble> {
        let m = self.balance.m;
        let (mut told, after): (Vec<(&'static str, String, Option<String>)>, _) = (vec![], &self.balance.mode);
        let touches = |mode: &Mode, group: usize| m.groups[group].limits.clone().any(|l| mode.limits[l].hold.touches());
        for (l, limit) in m.limits.iter().enumerate() {
            let group = &m.groups[limit.group];
            let string = group.word == "string";
            let (was, is) = (before.limits[l].hold, after.limits[l].hold);
            let elsewhere = || {
                let stays = touches(before, limit.group) && touches(after, limit.group);
                stays.then(|| "at one place; at another it touches".to_string())
            };
            let kind = match (was.touches(), is.touches()) {
                (true, false) if string => "slack",
                (true, false) => "lift-off",
                (false, true) if self.has_struck(t, &group.name) => continue,
                (false, true) if string => "taut",
                (false, true) => "contact",
                _ => match (was, is) {
                    (was, Hold::Sliding(_)) if was.sticks() => "slip",
                    (Hold::Sliding(_), is) if is.sticks() => "stick",
                    (Hold::Sliding(a), Hold::Sliding(b)) if a != b => "reversal",
                    _ => continue,
                },
            };
            if !told.iter().any(|(k, name, _)| *k == kind && *name == group.name) {
                let partial = matches!(kind, "lift-off" | "contact");
                told.push((kind, group.name.clone(), elsewhere().filter(|_| partial)));
            }
        }
        for rub in 0..m.rubs.len() {
            let kind = match (before.rubs[rub], self.balance.mode.rubs[rub]) {
                (Hold::Stuck, Hold::Sliding(_)) => "slip",
                (Hold::Sliding(_), Hold::Stuck) => "stick",
                (Hold::Sliding(a), Hold::Sliding(b)) if a != b => "reversal",
                _ => continue,
            };
            told.push((kind, Source::Rub(rub).name(m).to_string(), None));
        }
        for (kind, name, note) in told {
            self.note(Change { t, kind, of: vec![name], lost: 0.0, states: None, impulses: None, note });
        }
        self.begin_stretch(t, 0.0, 0.0);
        Ok(())
    }

    /// The names of the contacts, stops and strings of limits, each once.
    pub(super) fn names(&self, limits: &[usize]) -> Vec<String> {
        let m = self.balance.m;
        let mut of: Vec<String> = limits.iter().map(|&l| m.groups[m.limits[l].group].name.clone()).collect();
        of.dedup();
        of
    }

    /// Whether a blow of this instant has told of a limit already.
    pub(super) fn has_struck(&self, t: f64, name: &String) -> bool {
        self.changes.iter().rev().take_while(|c| c.t >= t).any(|c| c.impulses.is_some() && c.of.contains(name))
    }

    pub(super) fn note(&mut self, change: Change) {
        self.changes.push(change);
    }

    /// Notes a jump of the velocities, with the energy that it took.
    pub(super) fn note_jump(&mut self, change: Change) {
        self.begin_stretch(change.t, 0.0, -change.lost);
        self.note(change);
    }
}
