//! From one mode to the next: what collides, holds, slides and lets go.

use super::impacts::{Rule, LEFT_OVER};
use super::{HybridSystem, Start};
use crate::dynamics::{ContactTolerances, Trouble};
use crate::mode::ContactMode;
use crate::motion::{EventRecord, Kind, System};

/// Gap, over the characteristic length, below which a unilateral constraint is reached.
pub(super) const CLOSED_GAP: f64 = 1e-10;
/// Speed, over the mechanism's own, below which there is none.
pub(super) const REST_SPEED: f64 = 1e-10;
/// Kinetic energy, over the mechanism's own, that it takes no round-off to gain.
const GAIN: f64 = 1e-9;
/// Impacts that one instant may hold, and those after which ever larger speeds count as none.
const ROUNDS: usize = 100;
const MANY: usize = 50;

impl HybridSystem<'_> {
    /// Finds what only the start tells of unilateral constraints, lets the events of the start happen and begins the
    /// first phase; where the motion goes on from another, both are done already.
    ///
    /// # Errors
    /// `penetration`; `backward`, for what switches cannot be undone; what [`HybridSystem::resolve_mode`] finds.
    pub fn begin(&mut self, start: &Start, until: f64, y: &mut [f64]) -> Result<(), Trouble> {
        let (m, t) = (self.workspace.m, start.t);
        if m.is_hybrid() && until < t {
            return Err(Trouble::Backward);
        }
        if !(m.unilateral.is_empty() && m.joint_friction.is_empty()) {
            self.place(t, y);
            if start.mode.is_none() {
                self.workspace.start_contacts()?;
            }
            self.resolve_mode(t, y)?;
        }
        for (i, event) in m.events.iter().enumerate().filter(|(_, e)| e.opening && start.mode.is_none()) {
            if self.armed(i, t, y)? {
                self.initial_events.push(EventRecord { t, y: y.to_vec(), index: i, kind: Kind::Opening, direction: 0 });
                self.perform_actions(event, t, y)?;
            }
        }
        self.open();
        Ok(())
    }

    /// A guard of unilateral constraint `l` fell to zero.
    pub(super) fn switch_contact(&mut self, l: usize, guard: usize, t: f64, y: &mut [f64]) -> Result<(), Trouble> {
        self.place(t, y);
        let constraint = &self.workspace.m.unilateral[l];
        if guard == 3 {
            let (_, beyond) = self.workspace.border(l).expect("a guard of a border belongs to one");
            self.workspace.mode.contacts[l].feature.index = beyond;
            if !constraint.gap.can_close(beyond) {
                let before = self.workspace.mode.clone();
                self.workspace.mode.contacts[l].mode = ContactMode::Open;
                self.record_mode_changes(t, &before)?;
            }
        } else if constraint.soft.is_some() {
            let before = self.workspace.mode.clone();
            let contact = &mut self.workspace.mode.contacts[l];
            contact.mode = if contact.mode == ContactMode::Open { ContactMode::Compliant } else { ContactMode::Open };
            self.decide_modes(t, y, &[], None)?;
            return self.record_mode_changes(t, &before);
        }
        self.resolve_mode(t, y)
    }

    /// A guard of a joint with friction fell to zero: it sticks no more, or stopped.
    pub(super) fn switch_joint_friction(
        &mut self,
        friction: usize,
        guard: usize,
        t: f64,
        y: &mut [f64],
    ) -> Result<(), Trouble> {
        let slides = self.workspace.mode.joint_friction[friction] == ContactMode::Stick;
        // The friction that is used up pushes against the sliding to come.
        let sense = if guard == 0 { -1.0 } else { 1.0 };
        self.resolve_mode_releasing(t, y, slides.then_some((friction, sense)))
    }

    /// Impacts until nothing approaches, then which unilateral constraints hold and which joints stick.
    ///
    /// # Errors
    /// `simultaneous_impact` and the paradoxes of Painlevé, by name.
    pub(super) fn resolve_mode(&mut self, t: f64, y: &mut [f64]) -> Result<(), Trouble> {
        self.resolve_mode_releasing(t, y, None)
    }

    fn resolve_mode_releasing(&mut self, t: f64, y: &mut [f64], released: Option<(usize, f64)>) -> Result<(), Trouble> {
        let (known, earlier) = ([self.mode_changes.len(), self.phases.len()], y.to_vec());
        (self.rest_speed, self.relaxed) = (REST_SPEED * self.speed, false);
        let resolved = self.resolve_mode_from(t, y, released);
        if resolved.is_err() {
            // The motion ends with the state before.
            y.copy_from_slice(&earlier);
            self.mode_changes.truncate(known[0]);
            self.phases.truncate(known[1]);
        }
        resolved
    }

    fn resolve_mode_from(&mut self, t: f64, y: &mut [f64], released: Option<(usize, f64)>) -> Result<(), Trouble> {
        let before = self.workspace.mode.clone();
        self.workspace.mode.resting = false;
        let mut impacting = vec![];
        for round in 0..ROUNDS {
            if round > MANY {
                // What comes to rest here sets off what rests there, ever more slowly.
                self.rest_speed = (2.0 * self.rest_speed).min(LEFT_OVER * self.speed);
            }
            // Joints pass impulses on without friction.
            self.workspace.mode.joint_friction.fill(ContactMode::Open);
            self.place(t, y);
            self.workspace.find_features(self.lookahead());
            let touching = self.workspace.touching(CLOSED_GAP * self.workspace.length);
            let contacts = self.workspace.closed_contacts(touching)?;
            let (k, rest_speed) = (contacts.constraints.len(), self.rest_speed);
            if contacts.rates[..k].iter().any(|&rate| rate < -rest_speed) {
                impacting.extend(self.impact(t, y, &contacts)?);
                continue;
            }
            let (parting, staying): (Vec<usize>, Vec<usize>) = (0..k).partition(|&i| contacts.rates[i] > rest_speed);
            let staying: Vec<usize> = staying.iter().map(|&i| contacts.constraints[i]).collect();
            match self.decide_modes(t, y, &staying, released) {
                Err(error) if self.jam_by_impact && error.is_jam() => {
                    if self.relaxed {
                        return Err(error);
                    }
                    // Where nothing jumps there are forces, and what contradicts them is not told exactly enough.
                    self.relaxed = !self.impact_without_collision(t, y, &staying)?;
                    continue;
                }
                done => done?,
            }
            // What bounces back does so from where it is: to shift it would turn its way.
            let at_rest: Vec<usize> = contacts.constraints.iter().copied().filter(|l| !impacting.contains(l)).collect();
            self.close_contacts(t, y, &at_rest, &contacts.constraints)?;
            match parting.is_empty() {
                true => self.bounce_interval = None,
                false if self.zeno_limit(t, y, &contacts, &parting, &impacting)? => continue,
                false => {}
            }
            return self.record_mode_changes(t, &before);
        }
        Err(Trouble::EndlessImpacts(ROUNDS))
    }

    /// Decides which unilateral constraints hold and which joints stick.
    fn decide_modes(
        &mut self,
        t: f64,
        y: &[f64],
        limits: &[usize],
        released: Option<(usize, f64)>,
    ) -> Result<(), Trouble> {
        self.workspace.start_joint_friction(REST_SPEED * self.speed)?;
        if let Some((friction, sense)) =
            released.filter(|(friction, _)| self.workspace.mode.joint_friction[*friction] == ContactMode::Stick)
        {
            self.workspace.mode.joint_friction[friction] = ContactMode::Slip(sense);
        }
        let scale = ContactTolerances { rest_speed: REST_SPEED * self.speed, ..self.tolerances() };
        for _ in 0..=self.workspace.friction_switch_limit() {
            if !limits.is_empty() {
                self.decide_contact_modes(t, y, limits)?;
            }
            if self.workspace.m.joint_friction.is_empty()
                || !self.workspace.switch_joint_friction(scale, released.map(|(friction, _)| friction))?
            {
                break;
            }
        }
        Ok(())
    }

    /// Brings the state exactly onto the unilateral constraints that hold. What speed, and what height, that takes
    /// away, where unilateral constraints all but depend on each other, is in the ledger.
    fn close_contacts(&mut self, t: f64, y: &mut [f64], at_rest: &[usize], contacts: &[usize]) -> Result<(), Trouble> {
        let before = self.energy(t, y);
        self.project_onto_contacts(t, y, at_rest, contacts)?;
        let after = self.energy(t, y);
        let [speed, height] = [0, 1].map(|i| after[i] - before[i]);
        if speed > GAIN * self.strength * self.workspace.length {
            return Err(Trouble::CreatesEnergy(self.workspace.names_of(contacts), speed));
        }
        if speed + height != 0.0 {
            self.begin_phase(t, 0.0, speed + height);
        }
        Ok(())
    }

    /// Brings the state exactly onto the unilateral constraints that hold, and out of those that open from rest.
    fn project_onto_contacts(
        &mut self,
        t: f64,
        y: &mut [f64],
        at_rest: &[usize],
        contacts: &[usize],
    ) -> Result<(), Trouble> {
        let n = self.workspace.m.freedom();
        self.place(t, y);
        let inside = |l: &&usize| {
            self.workspace.mode.contacts[**l].mode == ContactMode::Open && self.workspace.constraint_gap(**l) < 0.0
        };
        let opening: Vec<usize> = at_rest.iter().filter(inside).copied().collect();
        let carries = self.workspace.mode.contacts.iter().any(|contact| contact.mode.carries());
        if opening.is_empty() && !carries && self.workspace.m.joint_friction.is_empty() {
            return Ok(());
        }
        let (q, rest) = y.split_at_mut(n);
        opening.iter().for_each(|&l| self.workspace.mode.contacts[l].mode = ContactMode::Frictionless);
        let closed = self.workspace.project_positions(t, q, &rest[..n]);
        opening.iter().for_each(|&l| self.workspace.mode.contacts[l].mode = ContactMode::Open);
        closed?;
        // What begins to slide does so from rest, and not the other way by round-off.
        let modes: Vec<ContactMode> = self.workspace.mode.contacts.iter().map(|contact| contact.mode).collect();
        for (l, &mode) in modes.iter().enumerate() {
            if matches!(mode, ContactMode::Slip(sense) if sense * self.workspace.slide_rate(l) < 0.0) {
                self.workspace.mode.contacts[l].mode = ContactMode::Stick;
            }
        }
        // What opens does not approach any more, by however little.
        self.workspace.place(t, q, &rest[..n]);
        let opening = contacts.iter().filter(|&&l| modes[l] == ContactMode::Open && self.workspace.gap_rate(l) < 0.0);
        let opening: Vec<usize> = opening.copied().collect();
        opening.iter().for_each(|&l| self.workspace.mode.contacts[l].mode = ContactMode::Frictionless);
        let aligned = self.workspace.project_velocities(t, q, &mut rest[..n]);
        self.workspace.mode.contacts.iter_mut().zip(modes).for_each(|(contact, mode)| contact.mode = mode);
        aligned?;
        self.place(t, y);
        self.workspace.solve()?;
        if self.workspace.is_locked() {
            // Nothing can move: not even by round-off.
            y[n..2 * n].fill(0.0);
            self.workspace.mode.resting = true;
            self.place(t, y);
        }
        Ok(())
    }

    /// Decides how unilateral constraints that neither approach nor part go on.
    fn decide_contact_modes(&mut self, t: f64, y: &[f64], limits: &[usize]) -> Result<(), Trouble> {
        let scale = self.tolerances();
        self.place(t, y);
        let contacts = self.workspace.closed_contacts(limits.to_vec())?;
        let slips = contacts.slips();
        let mut decision = self.workspace.decide_contact_modes(&contacts, &slips, scale)?;
        if decision.is_doubtful {
            // What nothing decides now is decided by what comes next.
            self.workspace.apply_contact_modes(&contacts, &decision);
            self.place(t, y);
            self.workspace.share_friction(&contacts, &decision)?;
            let (q, u) = self.extrapolate(t, y)?;
            self.workspace.place(t + self.lookahead(), &q, &u);
            let next = self.workspace.closed_contacts(contacts.constraints.clone())?;
            decision = self.workspace.decide_contact_modes(&next, &slips, scale)?;
        }
        self.workspace.apply_contact_modes(&contacts, &decision);
        self.place(t, y);
        self.workspace.share_friction(&contacts, &decision)
    }

    /// What counts as slow, and what is done where nothing decides.
    pub(super) fn tolerances(&self) -> ContactTolerances {
        let rate = self.speed * self.speed / self.workspace.length;
        ContactTolerances {
            rest_speed: self.rest_speed,
            acceleration: rate,
            prefer_rest: self.rule != Rule::Stop,
            relaxed: self.relaxed,
        }
    }

    /// A time that is short beside any of the motion, s.
    fn lookahead(&self) -> f64 {
        1e-6 * self.workspace.length / self.speed
    }

    /// The state a glimpse later, in the present mode.
    fn extrapolate(&mut self, t: f64, y: &[f64]) -> Result<(Vec<f64>, Vec<f64>), Trouble> {
        let (n, h) = (self.workspace.m.freedom(), self.lookahead());
        let mut dy = vec![0.0; y.len()];
        self.rate(t, y, &mut dy)?;
        let q = (0..n).map(|i| y[i] + h * y[n + i] + 0.5 * h * h * dy[n + i]).collect();
        let u = (n..2 * n).map(|i| y[i] + h * dy[i]).collect();
        Ok((q, u))
    }
}
