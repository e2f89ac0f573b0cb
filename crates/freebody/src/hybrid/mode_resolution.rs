//! From one mode to the next: what collides, holds, slides and lets go.

use super::guards::{ContactGuard, CLOSED_GAP, REST_SPEED};
use super::impacts::{Rule, LEFT_OVER};
use super::instant::Instant;
use super::{HybridSystem, Start};
use crate::dynamics::{ContactTolerances, DynamicsError};
use crate::mode::{ContactMode, Mode};
use crate::motion::{EventRecord, Kind, System};

/// Part of the time in which the mechanism moves its own length that is short beside any of its motion.
const SHORT: f64 = 1e-6;
/// Kinetic energy, over the mechanism's own, that it takes no round-off to gain.
const ENERGY_NOISE: f64 = 1e-9;
/// Impacts that one instant may hold, and those after which ever larger speeds count as none.
const ROUNDS: usize = 100;
const PATIENT_ROUNDS: usize = 50;
/// How many moments ahead is looked where the present decides nothing, until that does: the nearest says most, but what
/// grows slowly is hidden by round-off there.
const LOOKAHEADS: [f64; 4] = [1.0, 10.0, 100.0, 1000.0];

/// A joint whose friction at rest is used up, and the sense in which it begins to slide.
#[derive(Clone, Copy, Debug)]
pub(super) struct Released {
    friction: usize,
    sense: f64,
}

impl HybridSystem<'_> {
    /// Finds what only the start tells of unilateral constraints, lets the events of the start happen and begins the
    /// first phase; where the motion goes on from another, both are done already.
    ///
    /// # Errors
    /// `penetration`; `backward`, for what switches cannot be undone; what [`HybridSystem::resolve_mode`] finds.
    pub fn begin(&mut self, start: &Start, until: f64, y: &mut [f64]) -> Result<(), DynamicsError> {
        let (m, t) = (self.workspace.m, start.t);
        if m.is_hybrid() && until < t {
            return Err(DynamicsError::Backward);
        }
        self.open(t, y);
        self.place(t, y);
        self.workspace.check_free_lengths()?;
        if !(m.unilateral.is_empty() && m.joint_friction.is_empty()) {
            if start.mode.is_none() {
                self.mode = self.workspace.start_contacts()?;
            }
            self.resolve_mode(t, y, None, None)?;
        }
        for (i, event) in m.events.iter().enumerate().filter(|(_, e)| e.opening && start.mode.is_none()) {
            if self.armed(i, t, y)? {
                self.initial_events.push(EventRecord { t, y: y.to_vec(), index: i, kind: Kind::Opening, direction: 0 });
                self.perform_actions(event, t, y)?;
            }
        }
        // The ledger begins after the events of the start.
        let states = self.first_state();
        y[2 * m.freedom()..states].fill(0.0);
        self.open(t, y);
        Ok(())
    }

    /// A guard of unilateral constraint `l` fell to zero.
    pub(super) fn switch_contact(
        &mut self,
        l: usize,
        guard: ContactGuard,
        t: f64,
        y: &mut [f64],
    ) -> Result<(), DynamicsError> {
        // Where forces balance each other one guard is of them all.
        let about = (!self.is_force(l, guard)).then_some(l);
        self.place(t, y);
        let (constraint, mut mode) = (&self.workspace.m.unilateral[l], self.mode.clone());
        let contact = &mut mode.contacts_mut()[l];
        // Without a load it opens without a change of any force.
        if contact.mode == ContactMode::ClosedUnloaded && self.workspace.open_gap(l) > 0.0 {
            contact.mode = ContactMode::Open;
            self.enter_mode(t, mode);
            return Ok(());
        }
        if guard == ContactGuard::Border {
            let (_, beyond) = self.workspace.border(l).expect("a guard of a border belongs to one");
            contact.feature.index = beyond;
            if constraint.gap.can_close(beyond) {
                self.mode = mode;
            } else {
                contact.mode = ContactMode::Open;
                self.enter_mode(t, mode);
            }
        } else if constraint.soft.is_some() {
            contact.mode = if contact.mode == ContactMode::Open { ContactMode::Compliant } else { ContactMode::Open };
            let mode = self.start_joint_friction(&mode, None)?;
            let mode = self.decide_modes(mode, t, y, &[], None, self.tolerances())?;
            self.enter_mode(t, mode);
            return Ok(());
        }
        self.resolve_mode(t, y, about, None)
    }

    /// A guard of a joint with friction fell to zero: it sticks no more and slides in a sense, or it stopped.
    pub(super) fn switch_joint_friction(
        &mut self,
        friction: usize,
        sense: f64,
        t: f64,
        y: &mut [f64],
    ) -> Result<(), DynamicsError> {
        let slides = self.mode.joint_friction[friction] == ContactMode::Stick;
        self.resolve_mode(t, y, None, slides.then_some(Released { friction, sense }))
    }

    /// Impacts until nothing approaches, then the mode in which the motion goes on: which unilateral constraints hold
    /// and which joints stick, the one `released` left out. What hangs together with no body of the constraint `about` goes on as it
    /// does.
    ///
    /// # Errors
    /// `simultaneous_impact` and the paradoxes of Painlevé, by name.
    pub(super) fn resolve_mode(
        &mut self,
        t: f64,
        y: &mut [f64],
        about: Option<usize>,
        released: Option<Released>,
    ) -> Result<(), DynamicsError> {
        let (known, earlier) = ([self.mode_changes.len(), self.phases.len()], y.to_vec());
        match self.next_mode(t, y, about, released) {
            Ok(mode) => {
                self.enter_mode(t, mode);
                Ok(())
            }
            Err(error) => {
                // The motion ends with the state before.
                y.copy_from_slice(&earlier);
                self.mode_changes.truncate(known[0]);
                self.phases.truncate(known[1]);
                Err(error)
            }
        }
    }

    fn next_mode(
        &mut self,
        t: f64,
        y: &mut [f64],
        about: Option<usize>,
        released: Option<Released>,
    ) -> Result<Mode, DynamicsError> {
        let mut mode = self.mode.clone();
        mode.resting = false;
        let (mut tolerances, mut instant) = (self.tolerances(), Instant::about(about, self.workspace.m));
        for round in 0..ROUNDS {
            if round > PATIENT_ROUNDS {
                // What comes to rest here sets off what rests there, ever more slowly.
                tolerances.rest_speed = (2.0 * tolerances.rest_speed).min(LEFT_OVER * self.speed);
            }
            // Joints pass impulses on without friction.
            mode.joint_friction.fill(ContactMode::Open);
            self.place_in(&mode, t, y);
            self.workspace.enter(&self.workspace.find_features(self.lookahead()));
            let touching = self.workspace.touching(CLOSED_GAP * self.workspace.length);
            let touching = self.concerned(&mut instant, touching);
            let rest_speed = tolerances.rest_speed;
            let contacts = self.workspace.movable_contacts(touching, rest_speed)?;
            mode = contacts.opened.clone();
            let k = contacts.constraints.len();
            if contacts.rates[..k].iter().any(|&rate| rate < -rest_speed) {
                let (hit, rest_speed) = self.impact(t, y, &contacts, rest_speed)?;
                instant.impacting.extend(hit);
                tolerances.rest_speed = rest_speed;
                continue;
            }
            let (parting, staying): (Vec<usize>, Vec<usize>) = (0..k).partition(|&i| contacts.rates[i] > rest_speed);
            let staying: Vec<usize> = staying.iter().map(|&i| contacts.constraints[i]).collect();
            mode = self.start_joint_friction(&mode, released)?;
            mode = match self.decide_modes(mode.clone(), t, y, &staying, released, tolerances) {
                Err(error) if self.jam_by_impact && error.is_jam() => {
                    if tolerances.relaxed {
                        return Err(error);
                    }
                    // Where nothing jumps there are forces, and what contradicts them is not known exactly enough.
                    tolerances.relaxed = !self.impact_without_collision(&mode, t, y, &staying, tolerances)?;
                    continue;
                }
                decided => decided?,
            };
            // What bounces back does so from where it is: to shift it would turn its way.
            let at_rest: Vec<usize> =
                contacts.constraints.iter().copied().filter(|l| !instant.impacting.contains(l)).collect();
            mode = self.close_contacts(mode, t, y, &at_rest, &contacts.constraints, &instant)?;
            match self.come_to_rest(&mode, t, y, &contacts, &parting, &mut instant)? {
                Some(at_rest) => mode = at_rest,
                None => return self.rejoin(mode, t, y, &instant),
            }
        }
        Err(DynamicsError::EndlessImpacts(ROUNDS))
    }

    /// A mode with friction in joints as it starts from the state placed, the one `released` sliding.
    fn start_joint_friction(&mut self, mode: &Mode, released: Option<Released>) -> Result<Mode, DynamicsError> {
        self.workspace.enter(mode);
        let mut mode = self.workspace.start_joint_friction(REST_SPEED * self.speed)?;
        if let Some(Released { friction, sense }) = released {
            let held = &mut mode.joint_friction[friction];
            *held = if *held == ContactMode::Stick { ContactMode::Slip(sense) } else { *held };
        }
        Ok(mode)
    }

    /// Decides which unilateral constraints hold and which joints stick.
    fn decide_modes(
        &mut self,
        mut mode: Mode,
        t: f64,
        y: &[f64],
        constraints: &[usize],
        released: Option<Released>,
        tolerances: ContactTolerances,
    ) -> Result<Mode, DynamicsError> {
        let scale = ContactTolerances { rest_speed: REST_SPEED * self.speed, ..tolerances };
        for _ in 0..=self.workspace.friction_switch_limit() {
            if !constraints.is_empty() {
                mode = self.decide_contact_modes(&mode, t, y, constraints, tolerances)?;
            }
            if self.workspace.m.joint_friction.is_empty() {
                break;
            }
            self.workspace.enter(&mode);
            match self.workspace.switch_joint_friction(scale, released.map(|released| released.friction))? {
                Some(switched) => mode = switched,
                None => break,
            }
        }
        Ok(mode)
    }

    /// Brings the state exactly onto the unilateral constraints that hold. What speed, and what height, that takes
    /// away, where unilateral constraints all but depend on each other, is in the ledger.
    fn close_contacts(
        &mut self,
        mode: Mode,
        t: f64,
        y: &mut [f64],
        at_rest: &[usize],
        contacts: &[usize],
        instant: &Instant,
    ) -> Result<Mode, DynamicsError> {
        let before = self.energy(t, y);
        let work = self.project_onto_contacts(&mode, t, y, at_rest, contacts, instant)?;
        let after = self.energy(t, y);
        let [speed, height] = [after[0] - before[0] - work, after[1] - before[1]];
        if speed > ENERGY_NOISE * self.strength * self.workspace.length {
            return Err(DynamicsError::CreatesEnergy(self.workspace.names_of(contacts), speed));
        }
        if speed + height != 0.0 {
            self.begin_phase(t, speed + height);
        }
        Ok(mode)
    }

    /// Brings the state exactly onto the unilateral constraints that hold, and out of those that open from rest. Where
    /// nothing that is concerned can move then, it is at rest. Returns the work of the drives in that.
    fn project_onto_contacts(
        &mut self,
        mode: &Mode,
        t: f64,
        y: &mut [f64],
        at_rest: &[usize],
        contacts: &[usize],
        instant: &Instant,
    ) -> Result<f64, DynamicsError> {
        let n = self.workspace.m.freedom();
        self.place_in(mode, t, y);
        let is_open = |l: usize| mode.contacts[l].mode == ContactMode::Open;
        let inside = |l: &usize| is_open(*l) && self.workspace.constraint_gap(*l) < 0.0;
        let opening: Vec<usize> = at_rest.iter().copied().filter(inside).collect();
        let carries = mode.contacts.iter().any(|contact| contact.mode.carries());
        if opening.is_empty() && !carries && self.workspace.m.joint_friction.is_empty() {
            return Ok(0.0);
        }
        let (q, rest) = y.split_at_mut(n);
        let shut = mode.with_contacts(&opening, ContactMode::Frictionless);
        self.workspace.project_positions(&shut, t, q, &rest[..n])?;
        // What begins to slide does so from rest, and not the other way by round-off.
        let turned = |l: &usize| match mode.contacts[*l].mode {
            ContactMode::Slip(sense) => sense * self.workspace.slide_rate(*l) < 0.0,
            _ => false,
        };
        let turned: Vec<usize> = (0..mode.contacts.len()).filter(turned).collect();
        // What opens does not approach any more, by however little.
        self.workspace.move_to(t, q, &rest[..n]);
        let approaching = |l: &usize| is_open(*l) && self.workspace.gap_rate(*l) < 0.0;
        let approaching: Vec<usize> = contacts.iter().copied().filter(approaching).collect();
        let unmoved =
            mode.with_contacts(&turned, ContactMode::Stick).with_contacts(&approaching, ContactMode::Frictionless);
        let work = self.project_velocities(&unmoved, t, y)?;
        self.place_in(mode, t, y);
        self.workspace.update_rows();
        let own = instant.coordinates(self.workspace.m);
        if self.workspace.rows().len() >= own.len() {
            self.workspace.solve()?;
            if self.workspace.dof() == n - own.len() {
                // Nothing can move: not even by round-off.
                own.into_iter().for_each(|i| y[n + i] = 0.0);
            }
        }
        Ok(work)
    }

    /// Brings the velocities onto what holds, by impulses; returns the work of the drives in that.
    pub(super) fn project_velocities(&mut self, mode: &Mode, t: f64, y: &mut [f64]) -> Result<f64, DynamicsError> {
        let n = self.workspace.m.freedom();
        let before = y[n..2 * n].to_vec();
        let (q, rest) = y.split_at_mut(n);
        self.workspace.project_velocities(mode, t, q, &mut rest[..n])?;
        self.place_in(mode, t, y);
        if self.works.motions.is_empty() || y[n..2 * n] == before {
            return Ok(0.0);
        }
        let works = self.workspace.drive_works_since(&before, &[])?;
        Ok(self.add_drive_works(y, &works))
    }

    /// Decides how unilateral constraints that neither approach nor part go on.
    fn decide_contact_modes(
        &mut self,
        mode: &Mode,
        t: f64,
        y: &[f64],
        constraints: &[usize],
        tolerances: ContactTolerances,
    ) -> Result<Mode, DynamicsError> {
        self.place_in(mode, t, y);
        let contacts = self.workspace.closed_contacts(constraints.to_vec())?;
        let slips = contacts.slips();
        let mut decision = self.workspace.decide_contact_modes(&contacts, &slips, tolerances)?;
        // In a pile many contacts are redundant: what the first look ahead leaves in doubt, the others leave, too.
        let looks = if self.is_pile(&contacts) { 1 } else { LOOKAHEADS.len() };
        for moments in &LOOKAHEADS[..looks] {
            if !decision.is_doubtful() {
                break;
            }
            // What nothing decides now is decided by what comes next.
            let (mode, ahead) = (self.workspace.share_friction(&contacts, &decision)?, moments * self.lookahead());
            let (q, u) = self.extrapolate(&mode, t, y, ahead)?;
            self.workspace.place(&mode, t + ahead, &q, &u);
            let next = self.workspace.closed_contacts(contacts.constraints.clone())?;
            let next = self.workspace.decide_contact_modes(&next, &slips, tolerances)?;
            // Taken as a whole: parts of two answers are none.
            if decision.is_settled_by(&next) {
                decision = next;
            }
            self.place_in(&mode, t, y);
        }
        self.workspace.share_friction(&contacts, &decision)
    }

    /// What counts as slow, and what is done where nothing decides.
    fn tolerances(&self) -> ContactTolerances {
        let rate = self.speed * self.speed / self.workspace.length;
        ContactTolerances {
            rest_speed: REST_SPEED * self.speed,
            acceleration: rate,
            prefer_rest: self.rule != Rule::Stop,
            relaxed: false,
        }
    }

    /// A time that is short beside any of the motion, s.
    fn lookahead(&self) -> f64 {
        SHORT * self.workspace.length / self.speed
    }

    /// The state a little later, by h, in a mode.
    fn extrapolate(&mut self, mode: &Mode, t: f64, y: &[f64], h: f64) -> Result<(Vec<f64>, Vec<f64>), DynamicsError> {
        let n = self.workspace.m.freedom();
        let mut u_dot = vec![0.0; n];
        self.place_in(mode, t, y);
        self.solve_stage(t, y)?;
        self.workspace.accelerations(&mut u_dot);
        let q = (0..n).map(|i| y[i] + h * y[n + i] + 0.5 * h * h * u_dot[i]).collect();
        let u = (0..n).map(|i| y[n + i] + h * u_dot[i]).collect();
        Ok((q, u))
    }
}
