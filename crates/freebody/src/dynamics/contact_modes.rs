//! Unilateral constraints that are closed: which of them hold, and what an impact does.
//!
//! All other constraints are eliminated first, by the null space of their rows; what is left is a problem of the
//! unilateral constraints alone, with the Delassus matrix of accelerations by unit contact forces. An impact is the
//! same problem with velocities and impulses (Pfeiffer & Glocker 1996, *Multibody Dynamics with Unilateral Contacts*).

use super::contact_decision::{decision, ContactDecision};
use super::minimal::{Force, Wanted};
use super::rows::{closing_rows, contact_rows, gap_row, slide_row};
use super::{generalized_force, DynamicsError, Row, Workspace};
use crate::contact::complementarity::{self, Answer, FrictionLaw, Problem, Status, Verdict};
use crate::mechanism::Friction;
use crate::mode::{ContactMode, Mode};
use crate::plane::{Vec2, Wrench};
use crate::scalar::Scalar;
use crate::solve::Matrix;

/// Part of the mechanism's own accelerations below which one is round-off.
const ACCELERATION_NOISE: f64 = 1e-13;
/// Part of the characteristic length, and of the mechanism's own speed, up to which a gap is closed and nothing moves, at
/// an instant by itself.
pub(super) const REST: f64 = 1e-9;
/// Coupling of two unilateral constraints, over their own sizes, that is round-off.
const UNCOUPLED: f64 = 1e-12;

/// What counts as slow, and what is done where nothing decides.
#[derive(Clone, Copy, Debug)]
pub struct ContactTolerances {
    /// A speed of sliding below which there is none, m/s.
    pub rest_speed: f64,
    /// The mechanism's own accelerations, m/s².
    pub acceleration: f64,
    /// Whether what can stay at rest stays, where Coulomb's law leaves it open.
    pub prefer_rest: bool,
    /// Whether touches that are almost one may contradict each other by a little.
    pub relaxed: bool,
}

/// Unilateral constraints whose gaps are closed at one state, k of them.
pub struct ClosedContacts {
    /// Which.
    pub constraints: Vec<usize>,
    /// The mode in which they are open, and all else is as it was.
    pub opened: Mode,
    pub(super) gaps: Vec<Row>,
    pub(super) slides: Vec<Option<Row>>,
    /// Joint accelerations for a unit force: of the k gaps, then of the k slides.
    responses: Vec<Vec<f64>>,
    /// Accelerations of gaps, then slides, by unit forces along them, 2k × 2k.
    pub(super) g: Matrix,
    /// Rates of the k gaps, those of angles at their levers, then of the k slides, m/s.
    pub rates: Vec<f64>,
}

impl ClosedContacts {
    pub(super) fn len(&self) -> usize {
        self.constraints.len()
    }

    /// The mode that a decision about them makes.
    fn decided(&self, decision: &ContactDecision) -> Mode {
        let mut mode = self.opened.clone();
        self.constraints.iter().zip(&decision.modes).for_each(|(&l, &held)| mode.contacts_mut()[l].mode = held);
        mode
    }

    /// Speeds of sliding, m/s.
    pub fn slips(&self) -> Vec<f64> {
        self.rates[self.len()..].to_vec()
    }

    /// Sizes of the speeds that each impulse alone gives where it acts, m/s.
    pub fn speeds_of<'a>(&'a self, normal: &'a [f64], tangent: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        normal.iter().chain(tangent).enumerate().map(|(i, p)| (self.g[(i, i)] * p).abs())
    }

    /// Change of the rate of gap `i` by a unit impulse along it, 1/kg.
    pub fn response(&self, i: usize) -> f64 {
        self.g[(i, i)]
    }

    /// Of each unilateral constraint whether it approaches faster than `rest_speed`, or is coupled to one that does.
    pub fn takes_part(&self, rest_speed: f64) -> Vec<bool> {
        let k = self.len();
        let size = |i: usize| self.g[(i, i)].max(self.g[(k + i, k + i)]).max(f64::MIN_POSITIVE);
        let coupled = |i: usize, j: usize| {
            let entries = [(i, j), (i, k + j), (k + i, j), (k + i, k + j)];
            entries.iter().any(|&at| self.g[at].abs() > UNCOUPLED * (size(i) * size(j)).sqrt())
        };
        let mut part: Vec<bool> = (0..k).map(|i| self.rates[i] < -rest_speed).collect();
        let mut found: Vec<usize> = (0..k).filter(|&i| part[i]).collect();
        while let Some(i) = found.pop() {
            for j in (0..k).filter(|&j| coupled(i, j)) {
                if !std::mem::replace(&mut part[j], true) {
                    found.push(j);
                }
            }
        }
        part
    }

    /// Row i of gaps and slides together; None for a slide that cannot have friction.
    pub(super) fn row(&self, i: usize) -> Option<&Row> {
        let k = self.len();
        if i < k {
            Some(&self.gaps[i])
        } else {
            self.slides[i - k].as_ref()
        }
    }
}

impl Workspace<'_> {
    /// How `constraints`, freed, act on one another at the present state.
    ///
    /// # Errors
    /// As [`Workspace::solve`]: the mechanism without them must have a motion.
    pub fn closed_contacts(&mut self, constraints: Vec<usize>) -> Result<ClosedContacts, DynamicsError> {
        let opened = self.mode().with_contacts(&constraints, ContactMode::Open);
        self.enter(&opened);
        let at = self.at();
        let rows = |&l: &usize| {
            let (gap, slide) = contact_rows(at, l, None);
            (gap.scaled(self.lever(l)), slide.filter(|_| self.m.unilateral[l].friction.is_some()))
        };
        let (gaps, slides): (Vec<Row>, Vec<Option<Row>>) = constraints.iter().map(rows).unzip();
        let k = constraints.len();
        if k > 0 {
            self.factor_closing_rows()?;
        }
        let rates = gaps.iter().map(|r| r.rate.unwrap_or(0.0));
        let rates = rates.chain(slides.iter().map(|s| s.as_ref().and_then(|r| r.rate).unwrap_or(0.0))).collect();
        let mut contacts = ClosedContacts {
            constraints,
            opened,
            gaps,
            slides,
            responses: vec![],
            g: Matrix::zeros(2 * k, 2 * k),
            rates,
        };
        let along: Vec<Vec<f64>> = (0..2 * k).map(|i| self.along(contacts.row(i))).collect();
        let rest_speed = vec![0.0; self.rows.len()];
        contacts.responses = along.iter().map(|f| self.dense.saddle.solve(f, &rest_speed).a).collect();
        let felt = |force: &Vec<f64>| force.iter().copied().enumerate().filter(|(_, x)| *x != 0.0).collect();
        let felt: Vec<Vec<(usize, f64)>> = along.iter().map(felt).collect();
        let moved = |i: usize, by: &[f64]| felt[i].iter().map(|&(k, x)| x * by[k]).sum::<f64>();
        contacts.g = Matrix::from_fn(2 * k, 2 * k, |i, j| moved(i, &contacts.responses[j]));
        Ok(contacts)
    }

    /// Factors the masses with the rows of all that is closed in the present mode.
    pub(super) fn factor_closing_rows(&mut self) -> Result<(), DynamicsError> {
        self.rows = closing_rows(self.at(), None);
        super::loads::centre_arms(self.placed.view(self.m, &self.n, &self.k), &mut self.arms);
        self.factor(Force::ActuatorDirection)
    }

    /// The same without those that all else keeps as they are, as a stop at which a lock holds: they are left closed, without
    /// load. What has friction stays, and so does what parts or approaches faster than `rest_speed`.
    ///
    /// # Errors
    /// As [`Workspace::closed_contacts`].
    pub fn movable_contacts(
        &mut self,
        constraints: Vec<usize>,
        rest_speed: f64,
    ) -> Result<ClosedContacts, DynamicsError> {
        let contacts = self.closed_contacts(constraints)?;
        let k = contacts.len();
        let moves = |i: usize| self.dense.saddle.moves(&self.along(contacts.row(i)));
        let stays = |&i: &usize| contacts.rates[i].abs() > rest_speed || moves(i) || contacts.row(k + i).is_some();
        let (movable, kept): (Vec<usize>, Vec<usize>) = (0..k).partition(stays);
        if kept.is_empty() {
            return Ok(contacts);
        }
        let named = |list: Vec<usize>| list.iter().map(|&i| contacts.constraints[i]).collect::<Vec<_>>();
        self.enter(&contacts.opened.with_contacts(&named(kept), ContactMode::ClosedUnloaded));
        self.closed_contacts(named(movable))
    }

    /// What a unit force along a row does on each joint coordinate.
    pub(super) fn along(&self, row: Option<&Row>) -> Vec<f64> {
        let mut force = vec![0.0; self.m.freedom()];
        if let Some(row) = row {
            generalized_force(self.at(), row.motion.iter().copied(), &mut force);
        }
        force
    }

    /// Accelerations of gaps, then slides, that the unilateral constraints that are closed would have without force,
    /// m/s².
    ///
    /// # Errors
    /// As [`Workspace::solve`].
    pub fn free_accelerations(&mut self, contacts: &ClosedContacts) -> Result<Vec<f64>, DynamicsError> {
        self.enter(&contacts.opened);
        self.solve_by(super::Route::Minimal)?;
        let at = self.at();
        let bodies = Some(self.solved.bodies.as_slice());
        let gaps = contacts.constraints.iter().map(|&l| gap_row(at, l, bodies).bias * self.lever(l));
        let slides = contacts
            .constraints
            .iter()
            .zip(&contacts.slides)
            .map(|(&l, slide)| slide.as_ref().and_then(|_| slide_row(at, l, bodies)).map_or(0.0, |row| row.bias));
        Ok(gaps.chain(slides).collect())
    }

    /// How the unilateral constraints that are closed go on from the present state: what parts, what sticks, what
    /// slides, for given speeds of sliding; one below `rest_speed` is none. An acceleration far below `acceleration`
    /// decides nothing by itself. Where several motions satisfy Coulomb's law, as where a block in a gap may jam or go
    /// down, `prefer_rest` takes the one in which most unilateral constraints stick: what can stay at rest stays.
    ///
    /// # Errors
    /// `painleve_inconsistent`, `painleve_indeterminate`; as [`Workspace::solve`].
    pub fn decide_contact_modes(
        &mut self,
        contacts: &ClosedContacts,
        slips: &[f64],
        scale: ContactTolerances,
    ) -> Result<ContactDecision, DynamicsError> {
        let mut free = self.free_accelerations(contacts)?;
        if !free.iter().all(|a| a.is_finite()) {
            return Err(DynamicsError::NoFiniteAcceleration);
        }
        // Round-off is no reason to part.
        free.iter_mut().filter(|a| a.abs() <= ACCELERATION_NOISE * scale.acceleration).for_each(|a| *a = 0.0);
        let friction = self.friction_laws(contacts, slips, scale.rest_speed);
        let problem = Problem { g: &contacts.g, free: &free, friction: &friction };
        let solve = if scale.relaxed { complementarity::solve_relaxed } else { complementarity::solve };
        match solve(&problem) {
            Verdict::Solved(answer) => Ok(decision(answer, &problem, scale.acceleration)),
            Verdict::Indeterminate(answers) if scale.prefer_rest => {
                let sticks = |a: &&Answer| a.status.iter().filter(|s| **s == Status::Stick).count();
                let most = answers.iter().rev().max_by_key(sticks).expect("several answers");
                Ok(decision(most.clone(), &problem, scale.acceleration))
            }
            verdict => Err(self.painleve_error(contacts, &free, &friction, &verdict)),
        }
    }

    /// The mode of an instant by itself: the unilateral constraints hold that are closed, and friction acts in the
    /// joints that move. There is no impact.
    ///
    /// # Errors
    /// `penetration`; as [`Workspace::decide_contact_modes`].
    pub fn initial_mode(&mut self) -> Result<Mode, DynamicsError> {
        self.check_free_lengths()?;
        if self.m.unilateral.is_empty() && self.m.joint_friction.is_empty() {
            return Ok(self.mode().clone());
        }
        let mode = self.start_contacts()?;
        self.enter(&mode);
        let rate = self.natural_rate();
        let rest_speed = REST * self.length * rate;
        let mut mode = self.start_joint_friction(rest_speed)?;
        let scale = ContactTolerances {
            rest_speed,
            acceleration: rate * rate * self.length,
            prefer_rest: false,
            relaxed: false,
        };
        for _ in 0..=self.friction_switch_limit() {
            self.enter(&mode);
            mode = self.modes_of_closed_contacts(scale)?;
            if self.m.joint_friction.is_empty() {
                break;
            }
            self.enter(&mode);
            match self.switch_joint_friction(scale, None)? {
                Some(switched) => mode = switched,
                None => break,
            }
        }
        Ok(mode)
    }

    fn modes_of_closed_contacts(&mut self, scale: ContactTolerances) -> Result<Mode, DynamicsError> {
        let touching = self.touching(REST * self.length);
        let contacts = self.movable_contacts(touching, scale.rest_speed)?;
        let staying = (0..contacts.len())
            .filter(|&i| contacts.rates[i] <= scale.rest_speed)
            .map(|i| contacts.constraints[i])
            .collect();
        let contacts = self.closed_contacts(staying)?;
        let decision = self.decide_contact_modes(&contacts, &contacts.slips(), scale)?;
        Ok(contacts.decided(&decision))
    }

    /// The mode decided. Of unilateral constraints that stick, though others that slide keep them from it, as many as
    /// there are forces too many for the motions that are excluded keep part of their normal force as friction, well inside
    /// its bounds. What holds them does not say how much.
    ///
    /// # Errors
    /// As [`Workspace::solve`].
    pub fn share_friction(
        &mut self,
        contacts: &ClosedContacts,
        decision: &ContactDecision,
    ) -> Result<Mode, DynamicsError> {
        let mut mode = contacts.decided(decision);
        self.enter(&mode);
        if self.solve_motion().is_ok() || !decision.modes.contains(&ContactMode::Stick) {
            return Ok(mode);
        }
        let ratios = contacts.constraints.iter().copied().zip(decision.friction_ratios(&contacts.g));
        let sticking: Vec<(usize, f64)> =
            ratios.filter(|&(l, _)| mode.contacts[l].mode == ContactMode::Stick).collect();
        for &(l, friction) in &sticking {
            mode.contacts_mut()[l].mode = ContactMode::PartialFriction(friction);
        }
        for &(l, friction) in &sticking {
            mode.contacts_mut()[l].mode = ContactMode::Stick;
            self.enter(&mode);
            let fails = self.solve_once(super::Route::Minimal, Wanted::Motion).is_err();
            if fails && self.dense.saddle.actuation_rank() >= self.dense.saddle.rank().rank {
                mode.contacts_mut()[l].mode = ContactMode::PartialFriction(friction);
            }
        }
        self.enter(&mode);
        self.solve_by(super::Route::Minimal)?;
        Ok(mode)
    }

    pub(super) fn friction_laws(&self, contacts: &ClosedContacts, slips: &[f64], rest_speed: f64) -> Vec<FrictionLaw> {
        contacts.constraints.iter().zip(slips).map(|(&l, &slip)| self.friction_law(l, slip, rest_speed)).collect()
    }

    pub(super) fn friction_law(&self, constraint: usize, slip: f64, rest_speed: f64) -> FrictionLaw {
        match self.m.unilateral[constraint].friction {
            None => FrictionLaw::Frictionless,
            Some(Friction::Rough) => FrictionLaw::Rough,
            Some(Friction::Coulomb { fixed, kinetic }) => {
                let (fixed, kinetic) = (self.n.values[fixed], self.n.values[kinetic]);
                match slip.abs() <= rest_speed {
                    true => FrictionLaw::Resting { fixed, kinetic },
                    false => FrictionLaw::Sliding { sense: slip.signum(), kinetic },
                }
            }
        }
    }

    /// The names of the contacts, stops and strings of unilateral constraints, each once.
    pub fn names_of(&self, constraints: &[usize]) -> String {
        let mut names: Vec<String> =
            constraints.iter().map(|&l| format!("`{}`", self.m.groups[self.m.unilateral[l].group].name)).collect();
        names.dedup();
        names.join(" and ")
    }
}

/// The force that loads put on the first body of a unilateral constraint's group; ground takes the opposite of what the
/// others get.
pub(super) fn force_on_first<S: Scalar>(
    m: &crate::mechanism::Mechanism,
    constraint: usize,
    loads: &[(usize, Wrench<S>)],
) -> Vec2<S> {
    let first = m.groups[m.unilateral[constraint].group].ends[0];
    match loads.iter().find(|(body, _)| *body == first) {
        Some((_, load)) => load.f,
        None => -loads.iter().fold(Vec2::zero(), |sum, (_, load)| sum + load.f),
    }
}
