//! Switching functions: of events, of laws that are not smooth, and guards, which stay positive as long as the mode holds.

use super::HybridSystem;
use crate::dynamics::{compliant_force, DynamicsError, Source};
use crate::mechanism::{Gap, Mechanism};
use crate::mode::ContactMode;

/// What a switching function of the motion is about.
#[derive(Clone, Copy, Debug)]
pub(super) enum SwitchingFunction {
    Event(usize),
    Discontinuity(usize),
    Contact(usize, ContactGuard),
    /// Of a joint with friction: what keeps it from beginning to slide in a sense, or sliding.
    JointFriction(usize, f64),
}

/// What keeps a unilateral constraint in its mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ContactGuard {
    /// Its gap while it is open, its force while it is closed.
    Hold,
    /// The friction left, or the speed of sliding.
    Friction,
    /// The friction left in the other sense.
    Counterfriction,
    /// The border of its feature.
    Border,
}

const CONTACT_GUARDS: [ContactGuard; 4] =
    [ContactGuard::Hold, ContactGuard::Friction, ContactGuard::Counterfriction, ContactGuard::Border];
/// Friction that is used up in a sense pushes against the sliding to come.
const SENSES: [f64; 2] = [-1.0, 1.0];

impl SwitchingFunction {
    /// All of a mechanism, in the order of their values.
    pub(super) fn all(m: &Mechanism) -> impl Iterator<Item = SwitchingFunction> {
        let laws = (0..m.discontinuities.len()).map(SwitchingFunction::Discontinuity);
        let contact = |l| CONTACT_GUARDS.map(|guard| SwitchingFunction::Contact(l, guard));
        let joint = |friction| SENSES.map(|sense| SwitchingFunction::JointFriction(friction, sense));
        let guards = (0..m.unilateral.len()).flat_map(contact).chain((0..m.joint_friction.len()).flat_map(joint));
        (0..m.events.len()).map(SwitchingFunction::Event).chain(laws).chain(guards)
    }

    /// What it is about, in the model's words.
    pub(super) fn name(self, m: &Mechanism) -> String {
        match self {
            SwitchingFunction::Event(event) => format!("event `{}`", m.events[event].name),
            SwitchingFunction::Discontinuity(law) => {
                let (word, name) = m.discontinuous_items[law].split_once('.').expect("an item is of a kind");
                format!("law of the {} `{name}`", word.trim_end_matches('s'))
            }
            SwitchingFunction::Contact(l, _) => {
                let group = &m.groups[m.unilateral[l].group];
                format!("{} `{}`", group.word, group.name)
            }
            SwitchingFunction::JointFriction(friction, _) => {
                format!("friction of `{}`", Source::JointFriction(friction).name(m))
            }
        }
    }
}

/// Gap, over the characteristic length, below which a unilateral constraint is reached.
pub(super) const CLOSED_GAP: f64 = 1e-10;
/// The same above which one that carries nothing is closed no more: beyond what is taken to be reached.
const OPENED_GAP: f64 = 10.0 * CLOSED_GAP;
/// Speed, over the mechanism's own, below which there is none.
pub(super) const REST_SPEED: f64 = 1e-10;
/// Gap, over the characteristic length, that what is kept off by another may lack: more than the other may.
const OCCLUDED_GAP: f64 = 2.0 * CLOSED_GAP;
/// How far below zero a guard of speeds or borders may go that begins at zero: less than what counts as rest and as closed, so
/// that what is found there is at rest, and not on its way back.
pub(super) const LEEWAY: f64 = 0.5 * REST_SPEED;
/// The same of forces, over the mechanism's own: more than the round-off by which they are found to hold.
const FORCE_LEEWAY: f64 = 1e-9;
/// Speed, over the mechanism's own, from which a contact with partial friction slides: well above what counts as none.
const SLIPPING: f64 = 10.0 * REST_SPEED;

/// The leeway of a guard. A gap has none: what falls through it and is lifted again would bounce for ever.
pub(super) fn leeway(guard: ContactGuard, of_forces: bool) -> f64 {
    match guard {
        _ if of_forces => FORCE_LEEWAY,
        ContactGuard::Hold => 0.0,
        _ => LEEWAY,
    }
}

impl HybridSystem<'_> {
    /// The values of the guards of all unilateral constraints that are watched: positive as long as the mode holds.
    pub(super) fn guard_values(
        &mut self,
        t: f64,
        y: &[f64],
        watched: &[usize],
        out: &mut [f64],
    ) -> Result<(), DynamicsError> {
        self.place(t, y);
        let m = self.workspace.m;
        let of_forces = |&i: &usize| match self.switching_functions[i] {
            SwitchingFunction::Contact(l, guard) => self.is_force(l, guard),
            _ => false,
        };
        let is_pressed = watched.iter().any(of_forces);
        if is_pressed || !m.joint_friction.is_empty() {
            self.workspace.solve_motion()?;
        }
        let shared = if is_pressed { self.workspace.safest_margin(self.strength) } else { None };
        let forces =
            if is_pressed && shared.is_none() { self.workspace.solved_view().contact_forces() } else { vec![] };
        let (out, friction) = out.split_at_mut(CONTACT_GUARDS.len() * m.unilateral.len());
        self.joint_friction_guards(friction);
        let apart = self.workspace.apart();
        let constraint = |&i: &usize| match self.switching_functions[i] {
            SwitchingFunction::Contact(l, _) => Some(l),
            _ => None,
        };
        let mut constraints: Vec<usize> = watched.iter().filter_map(constraint).collect();
        constraints.dedup();
        for l in constraints {
            let values = &mut out[CONTACT_GUARDS.len() * l..][..CONTACT_GUARDS.len()];
            match apart[m.unilateral[l].group] {
                // Apart, as their bodies are.
                Some(least) if self.mode.contacts[l].mode == ContactMode::Open => {
                    values.copy_from_slice(&[least / self.workspace.length, 1.0, 1.0, 1.0]);
                }
                _ => self.guards_of(l, forces.get(l).copied(), values),
            }
        }
        // One guard is of them all.
        let first = self.mode.contacts.iter().position(|contact| contact.mode.carries());
        if let Some((first, shared)) = first.zip(shared) {
            out[CONTACT_GUARDS.len() * first] = shared / self.strength;
        }
        Ok(())
    }

    /// The guards of one unilateral constraint under given forces along its gap and its slide, where there are such, at
    /// the state placed.
    fn guards_of(&self, l: usize, forces: Option<[f64; 2]>, values: &mut [f64]) {
        let (constraint, contact) = (&self.workspace.m.unilateral[l], self.mode.contacts[l]);
        let unit = self.workspace.length / self.workspace.lever(l);
        values.fill(1.0);
        match contact.mode {
            ContactMode::Off => return,
            ContactMode::Open if constraint.soft.is_some() => values[0] = self.compliant_gap(l),
            ContactMode::Compliant => values[0] = self.compliant_contact(l),
            // What another keeps off is at zero with it.
            ContactMode::Open => {
                let occluded = || self.workspace.open_gap(l) / unit + OCCLUDED_GAP;
                let closing = self.workspace.closing_gap(l).map(|gap| gap / unit);
                values[0] = closing.unwrap_or_else(occluded);
            }
            ContactMode::ClosedUnloaded => {
                let gap = self.workspace.open_gap(l) / unit;
                values[0] = (gap + CLOSED_GAP).min(OPENED_GAP - gap);
            }
            ContactMode::Frictionless | ContactMode::Stick | ContactMode::PartialFriction(_) | ContactMode::Slip(_) => {
                let margins = forces.map_or(vec![], |forces| self.workspace.margins(l, forces));
                for (value, margin) in values.iter_mut().zip(margins) {
                    *value = margin / self.strength;
                }
                match contact.mode {
                    ContactMode::Slip(sense) => {
                        values[ContactGuard::Friction as usize] = sense * self.workspace.slide_rate(l) / self.speed
                    }
                    ContactMode::PartialFriction(_) => {
                        values[ContactGuard::Friction as usize] =
                            SLIPPING - self.workspace.slide_rate(l).abs() / self.speed
                    }
                    _ => {}
                }
            }
        }
        // A string keeps count of its turns, slack or taut.
        if contact.mode.touches() || matches!(constraint.gap, Gap::Cable(_)) {
            values[ContactGuard::Border as usize] =
                self.workspace.border(l).map_or(1.0, |(value, _)| value / self.workspace.length);
        }
    }

    /// The values of the guards of all joints with friction, at the state of the last solution.
    fn joint_friction_guards(&self, out: &mut [f64]) {
        for (friction, values) in out.chunks_exact_mut(SENSES.len()).enumerate() {
            let lever = self.workspace.friction_lever(friction);
            values.fill(1.0);
            match self.mode.joint_friction[friction] {
                ContactMode::Stick => {
                    let reserve = self.workspace.joint_friction_reserve(friction).map(|r| r / (lever * self.strength));
                    values.copy_from_slice(&reserve);
                }
                ContactMode::Slip(sense) => {
                    values[0] = sense * lever * self.workspace.joint_sliding_rate(friction) / self.speed
                }
                _ => {}
            }
        }
    }

    /// Positive while the gap of a unilateral constraint with a spring is open, or its damper would have to pull.
    fn compliant_gap(&self, l: usize) -> f64 {
        let [gap, force] = self.compliant_state(l);
        gap.max(-force)
    }

    /// Positive while the gap of a unilateral constraint with a spring is violated and the spring pushes.
    fn compliant_contact(&self, l: usize) -> f64 {
        let [gap, force] = self.compliant_state(l);
        (-gap).min(force)
    }

    /// Gap and force of a unilateral constraint with a spring, over the mechanism's own.
    fn compliant_state(&self, l: usize) -> [f64; 2] {
        let lever = self.workspace.lever(l);
        let gap = self.workspace.constraint_gap(l) * lever / self.workspace.length;
        [gap, compliant_force(self.workspace.at(), l) / (lever * self.strength)]
    }

    /// Whether a guard of a contact is of the forces there.
    pub(super) fn is_force(&self, l: usize, guard: ContactGuard) -> bool {
        match self.mode.contacts[l].mode {
            ContactMode::Stick => guard != ContactGuard::Border,
            mode => mode.carries() && guard == ContactGuard::Hold,
        }
    }

    /// One guard of a contact, if it is of places and speeds alone: then nothing needs to be solved.
    pub(super) fn guard_value(&mut self, l: usize, guard: ContactGuard, t: f64, y: &[f64]) -> Option<f64> {
        if self.is_force(l, guard) {
            return None;
        }
        self.place(t, y);
        let mut values = [0.0; CONTACT_GUARDS.len()];
        self.guards_of(l, None, &mut values);
        Some(values[guard as usize])
    }
}
