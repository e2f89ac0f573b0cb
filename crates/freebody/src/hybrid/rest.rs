//! The end of bounces without end, and in a pile of whatever is over within a moment.

use super::guards::REST_SPEED;
use super::instant::{Ended, Instant};
use super::mode_changes::ModeChange;
use super::HybridSystem;
use crate::dynamics::{ClosedContacts, DynamicsError};
use crate::mode::{ContactMode, ContactState, Mode};

/// Flight between bounces, over the time in which the mechanism moves its own length, that is not followed any more:
/// its height comes near the round-off of the gap.
const SHORTEST_FLIGHT: f64 = 1e-5;
/// The same of flights and slides in a pile, of more contacts than this, where each sets off others and none is of
/// consequence.
const SHORTEST_IN_PILE: f64 = 2e-2;
const PILE: usize = 8;
/// Change of a rate over the speeds that end beyond which they are not what it would end.
const UNRELATED: f64 = 1e4;
/// Largest ratio of one bounce to the one before of which a series is summed: nearer to 1 its end would be infinitely far.
const SUMMABLE: f64 = 0.999;

/// Whether so many contacts that touch are a pile: where it goes is open by far more than the tolerance of a step.
pub(super) fn is_pile(touching: usize) -> bool {
    touching > PILE
}

/// Something that would be over soon.
struct Passing {
    constraint: usize,
    /// How long it would last, s.
    lasts: f64,
    /// Its speed, m/s.
    speed: f64,
    /// Whether it slides, and does not fly.
    slides: bool,
}

impl HybridSystem<'_> {
    /// The mode after what is over within a moment: bounces without end, and in a pile single flights and slides.
    ///
    /// A flight after a bounce lasts twice the speed of parting over the acceleration of return, and each of a series
    /// lasts a constant part of the one before. Longer flights are noted, for a step must not be so long that it does
    /// not see them.
    pub(super) fn come_to_rest(
        &mut self,
        mode: &Mode,
        t: f64,
        y: &mut [f64],
        contacts: &ClosedContacts,
        parting: &[usize],
        instant: &mut Instant,
    ) -> Result<Option<Mode>, DynamicsError> {
        let is_pile = self.is_pile(contacts);
        if parting.is_empty() && !is_pile {
            self.bounce_interval = None;
            return Ok(None);
        }
        self.place_in(mode, t, y);
        self.workspace.solve_motion()?;
        let shortest = if is_pile { SHORTEST_IN_PILE } else { SHORTEST_FLIGHT };
        let (brief, before) = (shortest * self.workspace.length / self.speed, self.bounce_interval.take());
        let mut over = self.flights(contacts, parting);
        if let Some(next) = over.iter().min_by(|a, b| a.lasts.total_cmp(&b.lasts)).filter(|next| next.lasts > brief) {
            let of = instant.impacting.iter().copied().chain([next.constraint]).collect();
            self.bounce_interval = next.lasts.is_finite().then_some((of, next.lasts));
        }
        over.extend(if is_pile { self.slides(mode, contacts) } else { vec![] });
        over.retain(|each| each.lasts <= brief && instant.may_end(each.constraint, each.speed));
        if over.is_empty() {
            return Ok(None);
        }
        let of: Vec<usize> = over.iter().map(|each| each.constraint).collect();
        let lasts = over.iter().map(|each| each.lasts).fold(0.0, f64::max);
        // What rocks alternates between its feet.
        let same = before.filter(|(earlier, _)| of.iter().any(|l| earlier.contains(l)));
        let part = same.map_or(0.0, |(_, before)| (lasts / before).min(SUMMABLE));
        let rates = || parting.iter().map(|&i| (contacts.constraints[i], contacts.rates[i]));
        let fastest = rates().map(|(_, rate)| rate).fold(0.0, f64::max);
        instant
            .ended
            .retain(|ended| contacts.constraints.contains(&ended.constraint) && !of.contains(&ended.constraint));
        let held =
            |each: &Passing| Ended { constraint: each.constraint, held: self.held(each, fastest), speed: each.speed };
        instant.ended.extend(over.iter().map(held));
        let at_rest = |mode: Mode, ended: &Ended| match ended.held {
            // Its friction holds, too, by now.
            ContactMode::Frictionless if mode.contacts[ended.constraint].mode.sticks() => mode,
            held => mode.with_contacts(&[ended.constraint], held),
        };
        let (mode, earlier) = (instant.ended.iter().fold(mode.clone(), at_rest), y.to_vec());
        let ends = over.iter().filter(|each| each.slides).map(|each| each.speed);
        let most = rates().map(|(l, rate)| rate * self.workspace.lever(l)).chain(ends).fold(0.0, f64::max);
        let rested = self.rest(&mode, t, y, contacts, instant).ok();
        let Some(lost) = rested.filter(|_| self.fastest_change(&earlier, y) <= UNRELATED * most) else {
            // Then it flies, or slides, as long as it does.
            y.copy_from_slice(&earlier);
            return Ok(None);
        };
        self.begin_phase(t, -lost);
        let note = match is_pile {
            true => format!("what is over within a moment of t = {t:.12} s has come to an end"),
            false => format!("the bounces from t = {t:.12} s on, infinitely many, have come to an end"),
        };
        self.record(ModeChange {
            t: t + lasts / (1.0 - part),
            kind: "rest",
            of: self.names(&of),
            lost,
            states: Some([earlier, y.to_vec()]),
            impulses: None,
            note: Some(note),
        });
        Ok(Some(mode))
    }

    /// The flights of contacts that part, in the motion placed and solved.
    fn flights(&self, contacts: &ClosedContacts, parting: &[usize]) -> Vec<Passing> {
        let constraints: Vec<usize> = parting.iter().map(|&i| contacts.constraints[i]).collect();
        let back = self.workspace.gap_accelerations(&constraints);
        let flight = |((&constraint, &i), &a): ((&usize, &usize), &f64)| {
            let speed = contacts.rates[i];
            Passing { constraint, lasts: if a < 0.0 { -2.0 * speed / a } else { f64::INFINITY }, speed, slides: false }
        };
        constraints.iter().zip(parting).zip(&back).map(flight).collect()
    }

    /// The slides that friction brings to an end, in the motion placed and solved.
    fn slides(&self, mode: &Mode, contacts: &ClosedContacts) -> Vec<Passing> {
        let slide = |(i, &constraint): (usize, &usize)| match mode.contacts[constraint].mode {
            ContactMode::Slip(_) => {
                let (rate, a) = (contacts.slips()[i], self.workspace.slide_acceleration(constraint));
                let slows = (rate * a < 0.0 && rate.abs() > REST_SPEED * self.speed).then(|| (rate / a).abs());
                slows.map(|lasts| Passing { constraint, lasts, speed: rate.abs(), slides: true })
            }
            _ => None,
        };
        contacts.constraints.iter().enumerate().filter_map(slide).collect()
    }

    /// How something that ends is held: what rocks comes to rest as a whole; what slides faster than all that parts goes
    /// on sliding.
    fn held(&self, over: &Passing, fastest: f64) -> ContactMode {
        let has_friction = self.workspace.m.unilateral[over.constraint].friction.is_some();
        let rocks = || has_friction && self.workspace.slide_rate(over.constraint).abs() <= fastest;
        if over.slides || rocks() {
            ContactMode::Stick
        } else {
            ContactMode::Frictionless
        }
    }

    /// Brings what a mode holds to rest, and what this makes approach, without restitution; returns what that loses.
    fn rest(
        &mut self,
        mode: &Mode,
        t: f64,
        y: &mut [f64],
        contacts: &ClosedContacts,
        instant: &Instant,
    ) -> Result<f64, DynamicsError> {
        let energy = self.workspace.kinetic_energy();
        let work = self.project_velocities(mode, t, y)?;
        let lost = energy + work - self.workspace.kinetic_energy();
        let others = contacts.constraints.iter().copied().filter(|&l| !instant.has_ended(l)).collect();
        let others = self.workspace.closed_contacts(others)?;
        let k = others.constraints.len();
        if others.rates[..k].iter().all(|&rate| rate >= -REST_SPEED * self.speed) {
            return Ok(lost);
        }
        Ok(lost + self.collide(t, y, &others, &vec![0.0; k])?.1)
    }

    /// The largest change of a rate between two states, as a speed.
    fn fastest_change(&self, a: &[f64], b: &[f64]) -> f64 {
        let n = self.workspace.m.freedom();
        let change = |i: usize| (b[n + i] - a[n + i]).abs() / self.units[i] * self.workspace.length;
        (0..n).map(change).fold(0.0, f64::max)
    }

    /// Whether those that touch, with all that held before, are a pile.
    pub(super) fn is_pile(&self, contacts: &ClosedContacts) -> bool {
        let held =
            |&(l, contact): &(usize, &ContactState)| contact.mode.is_closed() && !contacts.constraints.contains(&l);
        is_pile(contacts.constraints.len() + self.mode.contacts.iter().enumerate().filter(held).count())
    }

    /// The restitution of each closed contact. In a pile it is 0 where the contact would not fly for longer than a moment, and where its
    /// last collision was no more than a moment ago, as of a body that rattles between others.
    pub(super) fn restitutions(&self, t: f64, contacts: &ClosedContacts) -> Vec<f64> {
        let (slowest, moment) = (0.5 * SHORTEST_IN_PILE * self.speed, SHORTEST_IN_PILE * self.time);
        let returns = |l: usize| t - self.collided[self.workspace.m.unilateral[l].group] <= moment;
        let is_pile = self.is_pile(contacts);
        let of = |(&l, &rate): (&usize, &f64)| match self.workspace.restitution(l) {
            e if is_pile && rate < 0.0 && (-e * rate <= slowest || returns(l)) => 0.0,
            e => e,
        };
        contacts.constraints.iter().zip(&contacts.rates).map(of).collect()
    }
}
