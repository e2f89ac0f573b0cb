//! What switched: the record of a motion's modes.

use super::scales::NOTHING_LOST;
use super::HybridSystem;
use crate::dynamics::Source;
use crate::mode::{ContactMode, Mode};
use crate::plane::Vec2;

/// Something that switched.
#[derive(Clone, Debug)]
pub struct ModeChange {
    /// When, s.
    pub t: f64,
    /// One word: `impact`, `taut`, `lift-off`, `slack`, `contact`, `slip`, `stick`, `rest`, `released`, `engaged`,
    /// `reset`.
    pub kind: &'static str,
    /// The contacts, stops, strings or parts concerned, by name.
    pub of: Vec<String>,
    /// Energy that it took, J: the work of the drives less what the mechanism gained.
    pub lost: f64,
    /// State vectors before and after, where it jumped.
    pub states: Option<[Vec<f64>; 2]>,
    /// Impulses, where there was an impact.
    pub impulses: Option<Impulses>,
    /// What else is to be said.
    pub note: Option<String>,
}

/// The impulses of an impact.
#[derive(Clone, Debug)]
pub struct Impulses {
    /// On the first body of each contact (the first end of a string), with its name, N·s.
    pub groups: Vec<(String, Vec2)>,
    /// Of each joint on its second body, N·s and N·m·s about its point.
    pub joints: Vec<[f64; 3]>,
    /// Of each coupling, motion and lock along its gauge, N·s or N·m·s.
    pub drives: Vec<f64>,
    /// The work of these, J.
    pub drive_works: Vec<f64>,
    /// Each unilateral constraint with an impulse.
    pub contacts: Vec<ContactImpulse>,
    /// Contacts, stops and strings that were reached, and that what took part in the impact acts on, but that would
    /// have had to pull.
    pub unloaded: Vec<String>,
    /// What was in place, with what took part in the impact held as it was held during the impact.
    pub mode: Mode,
}

/// The impulse of a unilateral constraint, one of a contact's, a stop's or a string's.
#[derive(Clone, Debug)]
pub struct ContactImpulse {
    /// The name of the contact, stop or string.
    pub name: String,
    /// Along the gap, N·s (N·m·s at an angle).
    pub normal: f64,
    /// Along the slide, N·s.
    pub tangent: f64,
    /// The coefficient of restitution.
    pub restitution: f64,
    /// In which sense it slides at the end, or 0 where it sticks; none without friction.
    pub slides: Option<f64>,
}

impl HybridSystem<'_> {
    /// Goes on in another mode: notes what changes by it, and begins another phase.
    pub(super) fn enter_mode(&mut self, t: f64, after: Mode) {
        let (m, before) = (self.workspace.m, &self.mode);
        let mut found: Vec<(&'static str, String, Option<String>)> = vec![];
        let touches =
            |mode: &Mode, group: usize| m.groups[group].constraints.clone().any(|l| mode.contacts[l].mode.touches());
        for (l, constraint) in m.unilateral.iter().enumerate() {
            let group = &m.groups[constraint.group];
            let string = group.word == "string";
            let (was, is) = (before.contacts[l].mode, after.contacts[l].mode);
            let elsewhere = || {
                let stays = touches(before, constraint.group) && touches(&after, constraint.group);
                stays.then(|| "at one place; at another it touches".to_string())
            };
            let kind = match (was.touches(), is.touches()) {
                (true, false) if string => "slack",
                (true, false) => "lift-off",
                (false, true) if self.had_impact(t, &group.name) => continue,
                (false, true) if string => "taut",
                (false, true) => "contact",
                _ => match (was, is) {
                    (was, ContactMode::Slip(_)) if was.sticks() => "slip",
                    (ContactMode::Slip(_), is) if is.sticks() => "stick",
                    (ContactMode::Slip(a), ContactMode::Slip(b)) if a != b => "reversal",
                    _ => continue,
                },
            };
            if !found.iter().any(|(k, name, _)| *k == kind && *name == group.name) {
                let partial = matches!(kind, "lift-off" | "contact");
                found.push((kind, group.name.clone(), elsewhere().filter(|_| partial)));
            }
        }
        for friction in 0..m.joint_friction.len() {
            let kind = match (before.joint_friction[friction], after.joint_friction[friction]) {
                (ContactMode::Stick, ContactMode::Slip(_)) => "slip",
                (ContactMode::Slip(_), ContactMode::Stick) => "stick",
                (ContactMode::Slip(a), ContactMode::Slip(b)) if a != b => "reversal",
                _ => continue,
            };
            found.push((kind, Source::JointFriction(friction).name(m).to_string(), None));
        }
        for (kind, name, note) in found {
            self.record(ModeChange { t, kind, of: vec![name], lost: 0.0, states: None, impulses: None, note });
        }
        // A spring that is there from now on, or is no more, while it is pressed.
        self.workspace.enter(&self.mode);
        let stored = self.workspace.potential_energy();
        self.workspace.enter(&after);
        let gained = self.workspace.potential_energy() - stored;
        self.mode = after;
        self.begin_phase(t, 0.0);
        if gained.abs() > NOTHING_LOST * self.strength * self.workspace.length {
            self.phases.last_mut().expect("a phase was begun").jump = gained;
        }
    }

    /// The names of the contacts, stops and strings of unilateral constraints, each once.
    pub(super) fn names(&self, constraints: &[usize]) -> Vec<String> {
        let m = self.workspace.m;
        let mut of: Vec<String> = constraints.iter().map(|&l| m.groups[m.unilateral[l].group].name.clone()).collect();
        of.dedup();
        of
    }

    /// Whether an impact of this instant has recorded a unilateral constraint already.
    pub(super) fn had_impact(&self, t: f64, name: &String) -> bool {
        self.mode_changes.iter().rev().take_while(|c| c.t >= t).any(|c| c.impulses.is_some() && c.of.contains(name))
    }

    pub(super) fn record(&mut self, change: ModeChange) {
        self.mode_changes.push(change);
    }

    /// Notes a jump of the velocities, with the energy that it took.
    pub(super) fn record_jump(&mut self, change: ModeChange) {
        self.begin_phase(change.t, -change.lost);
        self.record(change);
    }
}
